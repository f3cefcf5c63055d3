void mainImage(out vec4 o, in vec2 p) { vec2 q = p / iResolution.xy; o = texture(iChannel0, q) / 3.0 + texture(iChannel1, vec3(q - 0.5, 1.0)) / 3.0 + texture(iChannel2, vec3(q, 0.3)) / 3.0; }
