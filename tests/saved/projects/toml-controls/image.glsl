#iUniform float level = 0.5 in { 0.0, 1.0 }
#iUniform color3 tint = color3(1.0, 0.5, 0.2)
#iUniform float stick = 0.1 in { 0.0, 1.0 }
#iUniform float bend = 0.1 in { 0.0, 1.0 }
#iUniform float note = 0.1 in { 0.0, 1.0 }
void mainImage(out vec4 o, in vec2 p) { o = vec4(tint * level + stick + bend + note, 1.0); }
