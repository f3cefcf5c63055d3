void mainImage(out vec4 o, in vec2 p) { o = vec4(p / iResolution.xy, 1.5, 0.5); }
