void mainImage(out vec4 o, in vec2 p) { vec2 q = p / iResolution.xy; o = texture(iChannel0, q) * 0.5 + texture(iChannel1, q) * 0.5 + vec4(iChannelResolution[0].xy / 64.0, 0.0, 0.0); }
