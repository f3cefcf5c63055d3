#iChannel0 "keyboard"
void mainImage(out vec4 o, in vec2 p) { o = vec4(texelFetch(iChannel0, ivec2(65, 0), 0).x, texelFetch(iChannel0, ivec2(65, 1), 0).x, texelFetch(iChannel0, ivec2(65, 2), 0).x, 1.0); }
