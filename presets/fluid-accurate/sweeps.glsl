// Two Jacobi sweeps in one pass: each of five cells is swept once, then the one in the middle again. The text that
// includes this says where to read: INSIDE(p) is (q, f) of a cell of this grid, FINEST a texture of the finest one.

ivec2 size;
vec2 w;

// Beyond a wall lies the cell itself: no gradient.
vec2 cell(ivec2 p) {
    return INSIDE(cellAt(p, size));
}

float swept(ivec2 p, vec2 here, vec2 left, vec2 right, vec2 down, vec2 up) {
    float d = diagonal(p, size, w);
    float lap = w.x * ((left.x - here.x) + (right.x - here.x)) + w.y * ((down.x - here.x) + (up.x - here.x));
    return d > 0.0 ? here.x + DAMPING * (lap - here.y) / d : 0.0;
}

void mainImage(out vec4 result, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    size = textureSize(iChannel0, 0);
    w = stiffnessOf(size, textureSize(FINEST, 0));
    ivec2 x = ivec2(1, 0), y = ivec2(0, 1);
    vec2 c = cell(p), l = cell(p - x), r = cell(p + x), d = cell(p - y), u = cell(p + y);
    vec2 dl = cell(p - x - y), dr = cell(p + x - y), ul = cell(p - x + y), ur = cell(p + x + y);
    float q = swept(p, c, l, r, d, u);
    float ql = hasCell(p - x, size) ? swept(p - x, l, cell(p - 2 * x), c, dl, ul) : q;
    float qr = hasCell(p + x, size) ? swept(p + x, r, c, cell(p + 2 * x), dr, ur) : q;
    float qd = hasCell(p - y, size) ? swept(p - y, d, dl, dr, cell(p - 2 * y), c) : q;
    float qu = hasCell(p + y, size) ? swept(p + y, u, ul, ur, c, cell(p + 2 * y)) : q;
    result = vec4(orZero(swept(p, vec2(q, c.y), vec2(ql), vec2(qr), vec2(qd), vec2(qu))), 0.0, 0.0, 0.0);
}
