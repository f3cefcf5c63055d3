void mainImage(out vec4 c, in vec2 f) {
    vec3 v;
    v.xz = f;
    switch (int(f.x) & 3) {
        case 0: v.x = 1.0;
        case 1: v.y = 1.0; break;
        case 2: v.z = 2.0; break;
    }
    c = vec4(v, 1.0);
}
