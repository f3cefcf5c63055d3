#iChannel0 "buffer_b"
void mainImage(out vec4 o, in vec2 p) { o = 0.5 * texelFetch(iChannel0, ivec2(p), 0) + vec4(0.30000000000000004, p.x / 64.0, 0.1, 1.0); }
