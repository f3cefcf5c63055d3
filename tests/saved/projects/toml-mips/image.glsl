void mainImage(out vec4 o, in vec2 p) { o = textureLod(iChannel0, 2.0 * p / iResolution.xy, 2.0 * p.x / iResolution.x); }
