void mainImage(out vec4 o, in vec2 p) { o = fract(texelFetch(iChannel0, ivec2(p), 0) * 1.1 + vec4(p.x * 0.01, 0.03, 0.05, 1.0)); }
