#iChannel0 "buffer_d"
#iChannel1 "buffer_a"
void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 0.1 * texelFetch(iChannel1, ivec2(p), 0); }
