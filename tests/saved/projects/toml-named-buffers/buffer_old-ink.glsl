void mainImage(out vec4 o, in vec2 p) { o = 1.0 - texelFetch(iChannel0, ivec2(p), 0); }
