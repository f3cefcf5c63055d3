void mainImage(out vec4 c, in vec2 f) {
    switch (f.x < 4.0 ? 0 : 1) {
        case 0: float x = 0.5; c = vec4(x); break;
        case 1: c = vec4(x); break;
    }
}
