// As swept.glsl, beginning with p = 0: f of iChannel0.
float once(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return -0.2 * texelFetch(iChannel0, (p + size) % size, 0).x;
}

void mainImage(out vec4 swept, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float f = texelFetch(iChannel0, p, 0).x;
    float sum = once(p + ivec2(1, 0)) + once(p - ivec2(1, 0)) + once(p + ivec2(0, 1)) + once(p - ivec2(0, 1));
    swept = vec4(mix(once(p), 0.25 * (sum - f), 0.8), f, 0.0, 1.0);
}
