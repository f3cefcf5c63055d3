void mainImage(out vec4 c, in vec2 f) {
    mat3 m;
    m[0] = vec3(1.0); m[1] = vec3(2.0); m[2].xy = f;
    mat3 n = 2.0 * m + m;
    c = vec4(n[0].x, n[2].xy, 1.0);
}
