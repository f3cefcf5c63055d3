// Chebyshev's semi-iteration (Saad, Iterative Methods for Sparse Linear Systems, algorithm 12.1), which needs no sums over
// the grid: a texel is (p, f, the last change of p, sweeps done).
void mainImage(out vec4 field, in vec2 fragCoord) {
    ivec2 here = ivec2(fragCoord);
    vec4 w = texelFetch(iChannel0, here, 0);
    vec2 ends = spectrum();
    float middle = 0.5 * (ends.y + ends.x), half_width = 0.5 * (ends.y - ends.x);
    // The s of ratio() is middle / half_width, so that cosh(a) - 1 = 2 sinh^2(a / 2).
    float a = 2.0 * asinh(sqrt(0.5 * ends.x / half_width));
    float rest = 4.0 * (solved(iChannel0, here, w.y) - w.x), sweep = w.w;
    float change = sweep == 0.0
        ? rest / middle
        : ratio(sweep, a) * (ratio(sweep - 1.0, a) * w.z + 2.0 / half_width * rest);
    field = vec4(w.x + change, w.y, change, sweep + 1.0);
}
