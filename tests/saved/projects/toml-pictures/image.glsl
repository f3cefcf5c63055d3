void mainImage(out vec4 o, in vec2 p) { vec2 q = 2.0 * p / iResolution.xy; o = q.x < 0.7 ? texture(iChannel0, q) : q.x < 1.4 ? texture(iChannel1, q) : texture(iChannel2, q); }
