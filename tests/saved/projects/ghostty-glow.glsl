void mainImage(out vec4 o, in vec2 p) { vec2 q = p / iResolution.xy; o = texture(iChannel0, q) + 0.2 * vec4(iBackgroundColor, 1.0) + 0.1 * iCurrentCursorColor; }
