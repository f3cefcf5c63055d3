// Included twice, and inserted once.
float circle(vec2 at, float radius) { return 1.0 - length(at) / radius; }
