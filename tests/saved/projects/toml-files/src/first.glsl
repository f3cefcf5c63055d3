void mainImage(out vec4 o, in vec2 p) { o = vec4(K, p / iResolution.xy, 1.0); }
