#iChannel0 "cube_a"
void mainImage(out vec4 o, in vec2 p) { vec2 q = 2.0 * p / iResolution.xy - 1.0; o = texture(iChannel0, vec3(q, 1.0)); }
