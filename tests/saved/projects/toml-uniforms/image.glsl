#iUniform float level = 0.5 in { 0.0, 1.0 }
#iUniform int count = 1 in { 0, 9 }
#iUniform color3 tint = color3(1.0)
#iUniform bool on = false
uniform vec2 kernel[2];
void mainImage(out vec4 o, in vec2 p) { o = vec4(tint * level * float(count) / 3.0, 1.0); if (on) o.xy += kernel[1]; }
