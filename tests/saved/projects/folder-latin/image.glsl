// café, 流体, no newline at the end
void mainImage(out vec4 o, in vec2 p) { o = vec4(0.2, 0.4, p.x / iResolution.x, 1.0); }