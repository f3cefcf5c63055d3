void mainImage(out vec4 field, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float f = at(iChannel0, p).y;
    field = vec4(solved(iChannel0, p, f), f, 0.0, 1.0);
}
