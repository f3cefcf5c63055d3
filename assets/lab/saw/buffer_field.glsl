// The residual of a band-limited step (V. Valimaki, J. Pekonen, J. Nam, "Perceptually informed synthesis of bandlimited
// classical waveforms using integrated polynomial interpolation", JASA 131(1), 2012): of two samples and of four.
float blep2(float t, float dt) {
    if (t < dt) {
        float x = t / dt;
        return x + x - x * x - 1.0;
    }
    if (t > 1.0 - dt) {
        float x = (t - 1.0) / dt;
        return x * x + x + x + 1.0;
    }
    return 0.0;
}

// The integral of the cubic B-spline less the step, at a distance in samples.
float blep4(float t, float dt) {
    float x = (t < 0.5 ? t : t - 1.0) / dt, a = abs(x);
    if (a >= 2.0) return 0.0;
    // The spline's integral from a to 2, twice, as the step is of height 2.
    float tail = a < 1.0 ? 0.5 - (2.0 / 3.0 * a - a * a * a / 3.0 + a * a * a * a / 8.0) : pow(2.0 - a, 4.0) / 24.0;
    return x < 0.0 ? 2.0 * tail : -2.0 * tail;
}

float saw(float phase, float dt) {
    float x = 6.2831853 * phase;
#if METHOD == NAIVE
    return 2.0 * phase - 1.0;
#elif METHOD == BLEP
    return 2.0 * phase - 1.0 - (setting < 3.0 ? blep2(phase, dt) : blep4(phase, dt));
#elif METHOD == CLOSED
    // Harmonic k by r^k: so many decibels down at half the sample rate.
    float r = exp2(-setting / 6.0206 * 2.0 * dt);
    return -atan(r * sin(x), 1.0 - r * cos(x)) * 0.6366;
#else
    float sum = 0.0;
    int most = int(setting * 0.5 / dt);
    for (int k = 1; k <= most; k++) sum -= sin(6.2831853 * fract(float(k) * phase)) / float(k);
    return sum * 0.6366;
#endif
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 size = ivec2(iResolution.xy), at = ivec2(fragCoord);
    uint count = uint(size.x * size.y), n = uint(at.y * size.x + at.x);
    // Whole numbers, so that the phase is exact: n times the periods, modulo the samples.
    uint turn = (n * uint(periods)) % count;
    fragColor = vec4(saw(float(turn) / float(count), float(periods) / float(count)));
}
