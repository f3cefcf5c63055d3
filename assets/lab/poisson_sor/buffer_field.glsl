void mainImage(out vec4 field, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 w = at(iChannel0, p);
    bool turn = ((p.x + p.y) & 1) == 1;
    field = vec4(turn ? mix(w.x, solved(iChannel0, p, w.y), relaxation) : w.x, w.y, 0.0, 1.0);
}
