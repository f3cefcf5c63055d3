// A sweep of Gauss and Seidel over red texels, then black ones, in one pass: p of iChannel0, f of iChannel1. A black texel
// computes its four red neighbours itself. TURN is the colour that goes first: 0 for red, x + y even.
#ifndef F
#define F y
#endif
#ifndef TURN
#define TURN 0
#endif

ivec2 wrapped(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return (p + size) % size;
}

float guess(ivec2 p) {
    return texelFetch(iChannel0, wrapped(p), 0).x;
}

float source(ivec2 p) {
    return texelFetch(iChannel1, wrapped(p), 0).F;
}

float once(ivec2 p) {
    float sum = guess(p + ivec2(1, 0)) + guess(p - ivec2(1, 0)) + guess(p + ivec2(0, 1)) + guess(p - ivec2(0, 1));
    return 0.25 * (sum - source(p));
}

void mainImage(out vec4 swept, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float f = source(p);
    if (((p.x + p.y) & 1) == TURN) {
        swept = vec4(once(p), f, 0.0, 1.0);
    } else {
        float sum = once(p + ivec2(1, 0)) + once(p - ivec2(1, 0)) + once(p + ivec2(0, 1)) + once(p - ivec2(0, 1));
        swept = vec4(0.25 * (sum - f), f, 0.0, 1.0);
    }
}
