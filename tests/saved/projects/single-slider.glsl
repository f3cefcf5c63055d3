#iUniform float level = 0.5 in { 0.0, 1.0 }
void mainImage(out vec4 o, in vec2 p) { o = vec4(p / iResolution.xy, level + 0.5 * fract(iTime), 1.0); }
