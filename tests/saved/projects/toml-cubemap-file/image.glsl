void mainImage(out vec4 o, in vec2 p) { vec3 d = vec3(2.0 * p / iResolution.xy - 1.0, 0.4); o = 0.5 * texture(iChannel0, d) + 0.5 * texture(iChannel1, d.zxy); }
