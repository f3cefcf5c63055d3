// One grid of the V-cycle: the equation lap q = f on cells of size h, with nothing flowing through the walls.
//
// A grid has half the cells of the finer one each way, rounded, so a cell is as large as it must be: h is 2.1 or 1.9
// where 2 does not go. Coarse cells take the mean of what they cover (nothing is lost, which the equation needs to have
// a solution), and give back by bilinear interpolation. CELLS is the finest grid's size and SIZE this one's.

const float DAMPING = 0.8; // weighted Jacobi's best for the short half of the waves, in two dimensions

vec2 stiffnessOf(ivec2 size, ivec2 finest) {
    vec2 h = vec2(finest) / vec2(size);
    return 1.0 / (h * h);
}

// The cell a step away, and whether there is one: beyond a wall there is not. Grids without walls repeat.
ivec2 cellAt(ivec2 p, ivec2 size) {
    if (walls == PERIODIC) return p - size * ivec2(floor(vec2(p) / vec2(size)));
    return clamp(p, ivec2(0), size - 1);
}

bool hasCell(ivec2 p, ivec2 size) {
    return walls == PERIODIC || all(greaterThanEqual(p, ivec2(0))) && all(lessThan(p, size));
}

// Sum of the weights of a cell's neighbours, which is less at a wall; 0 for a grid of one cell.
float diagonal(ivec2 p, ivec2 size, vec2 w) {
    if (walls == PERIODIC) return 2.0 * dot(w, vec2(greaterThan(size, ivec2(1))));
    return w.x * (float(p.x > 0) + float(p.x < size.x - 1)) + w.y * (float(p.y > 0) + float(p.y < size.y - 1));
}

float orZero(float v) {
    return isFinite(vec4(v)) ? v : 0.0;
}
