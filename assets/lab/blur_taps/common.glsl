#define NINE 0
#define NORMALISED 1
#define FIVE 2
#define GAUSSIAN 3
#define PAIRED 4
#ifndef METHOD
#define METHOD GAUSSIAN
#endif
// Standard deviation in texels, and where the Gaussian is cut off, in standard deviations.
#iUniform float sigma = 2.14 in { 0.1, 40.0 }
#iUniform float reach = 3.0 in { 0.5, 5.0 }

vec4 at(sampler2D picture, vec2 p) {
    return textureLod(picture, p / iResolution.xy, 0.0);
}

float gauss(float x) {
    return exp(-0.5 * x * x / (sigma * sigma));
}

vec4 blurred(sampler2D picture, vec2 p, vec2 along) {
#if METHOD == NINE || METHOD == NORMALISED
    // Its weights sum to .98.
    vec4 sum = 0.16 * at(picture, p);
    float weights[4] = float[](0.15, 0.12, 0.09, 0.05);
    for (int i = 0; i < 4; ++i) {
        vec2 d = float(i + 1) * along;
        sum += weights[i] * (at(picture, p + d) + at(picture, p - d));
    }
#if METHOD == NORMALISED
    sum /= 0.98;
#endif
    return sum;
#elif METHOD == FIVE
    // The same by four filtered reads between two texels each.
    return 0.16 * at(picture, p) + 0.27 * (at(picture, p + 1.4444444 * along) + at(picture, p - 1.4444444 * along))
        + 0.14 * (at(picture, p + 3.3571429 * along) + at(picture, p - 3.3571429 * along));
#elif METHOD == GAUSSIAN
    vec4 sum = at(picture, p);
    float weights = 1.0;
    int radius = int(ceil(reach * sigma));
    for (int i = 1; i <= radius; ++i) {
        float weight = gauss(float(i));
        sum += weight * (at(picture, p + float(i) * along) + at(picture, p - float(i) * along));
        weights += 2.0 * weight;
    }
    return sum / weights;
#else
    vec4 sum = at(picture, p);
    float weights = 1.0;
    int radius = int(ceil(reach * sigma));
    for (int i = 1; i <= radius; i += 2) {
        float near = gauss(float(i)), far = gauss(float(i + 1)), weight = near + far;
        vec2 d = (float(i) + far / weight) * along;
        sum += weight * (at(picture, p + d) + at(picture, p - d));
        weights += 2.0 * weight;
    }
    return sum / weights;
#endif
}

#include "hash.glsl"
