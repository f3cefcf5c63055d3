struct S { float a; float b; };
float write(S s) { s.b = s.a; return s.b; }
void mainImage(out vec4 c, in vec2 f) {
    float k = 1.0;
    S s;
    s.a = k;
    float w = write(s);
    c = vec4(w, s.a, s.b, 1.0);
}
