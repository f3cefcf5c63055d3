void mainImage(out vec4 o, in vec2 p) { vec2 q = p / iResolution.xy; o = vec4(texture(iChannel0, vec2(q.x, 0.25)).x, texture(iChannel0, vec2(q.x, 0.75)).x, iChannelTime[0], 1.0); }
