// PCG of three integers (Jarzynski and Olano, JCGT 9(3), 2020).
uvec3 pcg(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v += v.yzx * v.zxy;
    v ^= v >> 16;
    return v + v.yzx * v.zxy;
}
