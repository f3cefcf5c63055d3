#ifndef SAMPLES
#define SAMPLES 4
#endif

float radicalInverse(int i, int base) {
    float result = 0.0, digit = 1.0 / float(base);
    for (; i > 0; i /= base) {
        result += float(i % base) * digit;
        digit /= float(base);
    }
    return result;
}

// The first points of the Halton sequence in bases 2 and 3, from 0 to 1.
vec2 halton(int i) {
    return vec2(radicalInverse(i + 1, 2), radicalInverse(i + 1, 3));
}
