void mainImage(out vec4 o, in vec2 p) { o = 0.5 * texelFetch(iChannel0, ivec2(p), 0) + 0.5 * texelFetch(iChannel1, ivec2(p), 0); }
