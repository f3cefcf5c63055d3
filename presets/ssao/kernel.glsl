// Row 0: 64 points of the hemisphere of radius 1 about z. Row 1: the cosine and sine of 16 turns about z. Row 2: 64
// points of the sphere. Row 3: 16 rays of the hemisphere with four points each, the nearest first.

const float GOLDEN = 2.39996323;

// Uniform on the disc, and so weighted by the cosine on the hemisphere (N. Malley's method): rings of one area, golden
// angles (H. Vogel, "A better way to construct the sunflower head", 1979).
vec3 raised(float square, float phi) {
    return vec3(sqrt(square) * cos(phi), sqrt(square) * sin(phi), sqrt(1.0 - square));
}

void mainImage(out vec4 value, in vec2 fragCoord) {
    int n = int(fragCoord.x), row = int(fragCoord.y);
    float at = (float(n) + 0.5) / 64.0, phi = GOLDEN * float(n);
    // Lengths go over the rings by a lattice (N. Korobov, 1959), so that each has near and far points; 55 is the
    // generator with the least error beside a wall. Near points are denser.
    float u = (float(55 * n & 63) + 0.5) / 64.0;
    if (row == 1) {
        float turn = 6.28318531 * (float(n & 15) + 0.5) / 16.0;
        value = vec4(cos(turn), sin(turn), 0.0, 0.0);
    } else if (row == 2) {
        float z = 1.0 - 2.0 * at;
        value = vec4(vec3(sqrt(1.0 - z * z) * vec2(cos(phi), sin(phi)), z) * mix(0.1, 1.0, u * u), 0.0);
    } else if (row == 3) {
        int ray = n >> 2;
        float part = (float(n & 3) + (float(11 * ray & 15) + 0.5) / 16.0) / 4.0;
        value = vec4(raised((float(ray) + 0.5) / 16.0, GOLDEN * float(ray)) * mix(0.1, 1.0, part * part), 0.0);
    } else {
        value = vec4(raised(at, phi) * mix(0.1, 1.0, u * u), 0.0);
    }
}
