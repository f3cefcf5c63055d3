void mainImage(out vec4 o, in vec2 p) { vec2 q = p / iResolution.xy; o = vec4(texture(iChannel1, q).x, texelFetch(iChannel2, ivec2(0), 0).x, texelFetch(iChannel3, ivec2(65, 0), 0).x, 1.0); }
