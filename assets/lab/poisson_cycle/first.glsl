// As swept.glsl, beginning with p = 0: f of iChannel0.
#ifndef F
#define F x
#endif

float once(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
#ifdef CAVITY
    return -0.2 * texelFetch(iChannel0, clamp(p, ivec2(0), size - 1), 0).F;
#else
    return -0.2 * texelFetch(iChannel0, (p + size) % size, 0).F;
#endif
}

void mainImage(out vec4 swept, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float f = texelFetch(iChannel0, p, 0).F;
    float sum = once(p + ivec2(1, 0)) + once(p - ivec2(1, 0)) + once(p + ivec2(0, 1)) + once(p - ivec2(0, 1));
    swept = vec4(mix(once(p), 0.25 * (sum - f), 0.8), f, 0.0, 1.0);
}
