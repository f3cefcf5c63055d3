void mainImage(out vec4 o, in vec2 p) { o = textureLod(iChannel0, p / iResolution.xy, 1.0); }
