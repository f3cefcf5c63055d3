#iUniform float noise = 0.1 in { 0.0, 0.3 }             // standard deviation of what is added, of 1
#iUniform int method = 2 in { 0, 2 }                     // 0 none, 1 bilateral, 2 non-local means
#iUniform float strength = 1.0 in { 0.2, 2.0 }           // of the filter, in standard deviations of the noise
#iUniform int radius = 6 in { 1, 10 }                    // of the window in which likeness is sought, in texels

// pcg3d (M. Jarzynski, M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020).
uvec3 hash(uvec3 p) {
    p = p * 1664525u + 1013904223u;
    p.x += p.y * p.z;
    p.y += p.z * p.x;
    p.z += p.x * p.y;
    p ^= p >> 16u;
    p.x += p.y * p.z;
    p.y += p.z * p.x;
    p.z += p.x * p.y;
    return p;
}

// Three numbers of a normal distribution (G. E. P. Box, M. E. Muller, 1958).
vec3 normal3(uvec3 seed) {
    vec3 a = (vec3(hash(seed) >> 8u) + 0.5) / 16777216.0, b = vec3(hash(seed + 101u) >> 8u) / 16777216.0;
    return sqrt(-2.0 * log(a)) * cos(6.2831853 * b);
}
