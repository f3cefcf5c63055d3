void mainImage(out vec4 c, in vec2 f) {
    mat3 m;
    m[0] = vec3(f, 1.0);
    m[2] = vec3(1.0);
    c = vec4(m[0].xy, m[1].xy) + m[2].xxxx + vec4(m[1], 1.0);
}
