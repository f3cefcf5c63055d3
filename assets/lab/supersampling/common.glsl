#ifndef SAMPLES
#define SAMPLES 4
#endif

#include "radical_inverse.glsl"

// The first points of the Halton sequence in bases 2 and 3, from 0 to 1.
vec2 halton(int i) {
    return vec2(radicalInverse(i + 1, 2), radicalInverse(i + 1, 3));
}
