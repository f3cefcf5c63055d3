// A texel is (p, f): lap p = f with h = 1, on a torus.
vec2 at(sampler2D field, ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(field, (p + size) % size, 0).xy;
}

// The p that the equation asks for here, given those beside.
float solved(sampler2D field, ivec2 p, float f) {
    float sum = at(field, p + ivec2(1, 0)).x + at(field, p - ivec2(1, 0)).x + at(field, p + ivec2(0, 1)).x
        + at(field, p - ivec2(0, 1)).x;
    return 0.25 * (sum - f);
}
