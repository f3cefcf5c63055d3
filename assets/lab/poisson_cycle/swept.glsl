// Two sweeps of Jacobi's iteration, damped by .8, in one pass: p of iChannel0, f of iChannel1. On a torus, or in a box
// (CAVITY) whose walls p meets without a gradient.
#ifndef F
#define F y
#endif

ivec2 wrapped(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
#ifdef CAVITY
    return clamp(p, ivec2(0), size - 1);
#else
    return (p + size) % size;
#endif
}

float guess(ivec2 p) {
    return texelFetch(iChannel0, wrapped(p), 0).x;
}

float source(ivec2 p) {
    return texelFetch(iChannel1, wrapped(p), 0).F;
}

float once(ivec2 p) {
#ifdef CAVITY
    // At a wall the image of a texel is that texel.
    p = wrapped(p);
#endif
    float sum = guess(p + ivec2(1, 0)) + guess(p - ivec2(1, 0)) + guess(p + ivec2(0, 1)) + guess(p - ivec2(0, 1));
    return mix(guess(p), 0.25 * (sum - source(p)), 0.8);
}

void mainImage(out vec4 swept, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float f = source(p);
    float sum = once(p + ivec2(1, 0)) + once(p - ivec2(1, 0)) + once(p + ivec2(0, 1)) + once(p - ivec2(0, 1));
    swept = vec4(mix(once(p), 0.25 * (sum - f), 0.8), f, 0.0, 1.0);
}
