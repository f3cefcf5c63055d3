// Amplitude of a checkerboard on top of the spot: what an unstable scheme amplifies first.
#iUniform float noise = 0.0 in { 0.0, 1.0 }

float checker(vec2 p) {
    return 1.0 - 2.0 * mod(floor(p.x) + floor(p.y), 2.0);
}

// A Gaussian of standard deviation 1/32 of the width, and its images on the torus.
float spot(vec2 p) {
    float s = iResolution.x / 32.0, sum = 0.0;
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
            vec2 d = p - iResolution.xy * (0.5 + vec2(i, j));
            sum += exp(-0.5 * dot(d, d) / (s * s));
        }
    }
    return sum;
}
