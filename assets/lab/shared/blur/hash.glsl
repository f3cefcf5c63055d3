// A number in 0..1 for a square of the chequer, of integers alone and so the same on every GPU: pcg2d (M. Jarzynski, M.
// Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020).
float hash(ivec2 cell) {
    uvec2 v = uvec2(cell) * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    return float(v.x >> 8u) / 16777216.0;
}
