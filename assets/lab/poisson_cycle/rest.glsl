// What is left of the equation on the finer grid (p, f), for a grid of twice the spacing, which counts as 1 there too.
float p_at(ivec2 p) {
    ivec2 size = textureSize(iChannel0, 0);
#ifdef CAVITY
    return texelFetch(iChannel0, clamp(p, ivec2(0), size - 1), 0).x;
#else
    return texelFetch(iChannel0, (p + size) % size, 0).x;
#endif
}

float left(ivec2 p) {
    float sum = p_at(p + ivec2(1, 0)) + p_at(p - ivec2(1, 0)) + p_at(p + ivec2(0, 1)) + p_at(p - ivec2(0, 1));
    return texelFetch(iChannel0, p, 0).y - sum + 4.0 * p_at(p);
}

void mainImage(out vec4 rest, in vec2 fragCoord) {
    ivec2 p = 2 * ivec2(fragCoord);
    rest = vec4(left(p) + left(p + ivec2(1, 0)) + left(p + ivec2(0, 1)) + left(p + ivec2(1, 1)), 0.0, 0.0, 1.0);
}
