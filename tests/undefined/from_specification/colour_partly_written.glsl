void mainImage(out vec4 c, in vec2 f) {
    c.rb = f;
    c.a = 1.0;
    if (f.x < 4.0) c.g = 0.5;
}
