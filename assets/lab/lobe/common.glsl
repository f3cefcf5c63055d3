// METHOD: MIRROR reads once, PLAIN reads level 0 in drawn directions, FILTERED the level that a direction's share covers.
#define MIRROR 0
#define PLAIN 1
#define FILTERED 2
#ifndef METHOD
#define METHOD FILTERED
#endif

#iUniform int samples = 16
#iUniform float alpha = 0.16
#iUniform bool even = false          // a sky that is 1 everywhere

const float PI = 3.14159265;
const float SIDE = 1024.0;

vec3 halfVector(vec2 u) {
    float cosTheta = sqrt((1.0 - u.x) / (1.0 + (alpha * alpha - 1.0) * u.x));
    float sinTheta = sqrt(max(1.0 - cosTheta * cosTheta, 0.0));
    return vec3(sinTheta * cos(2.0 * PI * u.y), sinTheta * sin(2.0 * PI * u.y), cosTheta);
}

float ggx(float cosTheta) {
    float a2 = alpha * alpha, d = cosTheta * cosTheta * (a2 - 1.0) + 1.0;
    return a2 / (PI * d * d);
}

vec2 hammersley(int i, int n) {
    uint bits = uint(i);
    bits = (bits << 16u) | (bits >> 16u);
    bits = ((bits & 0x00ff00ffu) << 8u) | ((bits & 0xff00ff00u) >> 8u);
    bits = ((bits & 0x0f0f0f0fu) << 4u) | ((bits & 0xf0f0f0f0u) >> 4u);
    bits = ((bits & 0x33333333u) << 2u) | ((bits & 0xccccccccu) >> 2u);
    bits = ((bits & 0x55555555u) << 1u) | ((bits & 0xaaaaaaaau) >> 1u);
    return vec2((float(i) + 0.5) / float(n), float(bits >> 8u) / 16777216.0);
}
