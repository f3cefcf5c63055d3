// Row 0: the kernel, 64 points of the hemisphere of radius 1 about z. Row 1: the cosine and sine of 16 turns about z.

// The digits of n to a base, mirrored at the point: J. Halton, "On the efficiency of certain quasi-random sequences of points
// in evaluating multi-dimensional integrals", Numerische Mathematik 2, 1960. Such points are spread more evenly than random ones.
float halton(int n, int base) {
    float value = 0.0, digit = 1.0;
    for (; n > 0; n /= base) {
        digit /= float(base);
        value += digit * float(n % base);
    }
    return value;
}

void mainImage(out vec4 value, in vec2 fragCoord) {
    int n = int(fragCoord.x);
    if (fragCoord.y > 1.0) {
        float turn = 6.28318531 * (float(n & 15) + 0.5) / 16.0;
        value = vec4(cos(turn), sin(turn), 0.0, 0.0);
        return;
    }
    // Uniform on the disc, and so weighted by the cosine on the hemisphere (N. Malley's method); near points are denser.
    float r = sqrt((float(n) + 0.5) / 64.0), phi = 6.28318531 * halton(n, 2), u = halton(n + 1, 3);
    vec3 direction = vec3(r * cos(phi), r * sin(phi), sqrt(1.0 - r * r));
    value = vec4(direction * mix(0.1, 1.0, u * u), 0.0);
}
