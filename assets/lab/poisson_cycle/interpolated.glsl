// Begins a grid with the solution of the coarser one in iChannel0, by the cubic through four texels each way; f of iChannel1.
// Cubics, as nested iteration wants an interpolation of a higher order than that of the equation.
float coarse(ivec2 p) {
    ivec2 size = textureSize(iChannel0, 0);
    return texelFetch(iChannel0, (p + size) % size, 0).x;
}

void mainImage(out vec4 begun, in vec2 fragCoord) {
    // Lagrange's weights at a quarter of the way from the second to the third.
    const vec4 WEIGHTS = vec4(-7.0, 105.0, 35.0, -5.0) / 128.0;
    ivec2 p = ivec2(fragCoord), c = p / 2, d = 2 * (p & 1) - 1;
    float sum = 0.0;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
            sum += WEIGHTS[x] * WEIGHTS[y] * coarse(c + d * (ivec2(x, y) - 1));
        }
    }
    begun = vec4(sum, texelFetch(iChannel1, p, 0).F, 0.0, 1.0);
}
