// Row 0: the kernel, 64 points of the hemisphere of radius 1 about z. Row 1: the cosine and sine of 16 turns about z.

void mainImage(out vec4 value, in vec2 fragCoord) {
    int n = int(fragCoord.x);
    if (fragCoord.y > 1.0) {
        float turn = 6.28318531 * (float(n & 15) + 0.5) / 16.0;
        value = vec4(cos(turn), sin(turn), 0.0, 0.0);
        return;
    }
    // Uniform on the disc, and so weighted by the cosine on the hemisphere (N. Malley's method): rings of one area, golden angles
    // (H. Vogel, "A better way to construct the sunflower head", 1979). Lengths go over the rings by a lattice (N. Korobov,
    // 1959), so that each has near and far points; 55 is the generator with the least error beside a wall. Near points are denser.
    float r = sqrt((float(n) + 0.5) / 64.0), phi = 2.39996323 * float(n), u = (float(55 * n & 63) + 0.5) / 64.0;
    vec3 direction = vec3(r * cos(phi), r * sin(phi), sqrt(1.0 - r * r));
    value = vec4(direction * mix(0.1, 1.0, u * u), 0.0);
}
