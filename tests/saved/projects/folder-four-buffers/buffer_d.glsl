#iChannel0 "buffer_c"
void mainImage(out vec4 o, in vec2 p) { o = 0.5 * texelFetch(iChannel0, ivec2(p), 0) + vec4(0.4, p.x / 64.0, 0.1, 1.0); }
