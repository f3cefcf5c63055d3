void mainImage(out vec4 c, in vec2 f) {
    int k;
    float a = 1.0;
    switch (k) { case 1: a = 2.0; break; case 2: a = 3.0; break; }
    c = vec4(a, 0.0, 0.0, 1.0);
}
