vec2 bilinear(sampler2D field, vec2 p) {
#ifdef CAVITY
    p = clamp(p, vec2(0.0), iResolution.xy - 1e-3);
#endif
    vec2 base = floor(p - 0.5), t = p - 0.5 - base;
    ivec2 i = ivec2(base);
    vec2 a = at(field, i), b = at(field, i + ivec2(1, 0)), c = at(field, i + ivec2(0, 1)), d = at(field, i + ivec2(1, 1));
    vec2 low = a + t.x * (b - a), high = c + t.x * (d - c);
    return low + t.y * (high - low);
}
