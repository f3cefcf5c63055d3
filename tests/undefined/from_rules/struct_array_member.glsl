struct S { vec2 at; float w[3]; };
float one() { return 1.0; }
void mainImage(out vec4 c, in vec2 f) {
    S s[2];
    for (int i = 0; i < 2; i++) for (int j = 0; j < 3; j++) if (i + j < 3) s[i].w[j] = one();
    s[0].at = s[1].at = f;
    c = vec4(s[1].w[2], s[1].w[1], s[0].w[2], 1.0);
}
