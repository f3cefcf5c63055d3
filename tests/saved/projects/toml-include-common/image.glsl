void mainImage(out vec4 o, in vec2 p) { o = vec4(a(), b(), 0.0, 1.0); }
