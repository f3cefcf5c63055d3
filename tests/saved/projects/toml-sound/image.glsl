void mainImage(out vec4 o, in vec2 p) { o = vec4(p / iResolution.xy, 0.25 + 0.5 * fract(iTime), 1.0); }
