vec2 place(int i, ivec2 pixel) {
#if METHOD == HALTON
    return vec2(radicalInverse(i + 1, 2), radicalInverse(i + 1, 3));
#else
    vec2 cell = vec2(i % SIDE, i / SIDE), within = vec2(0.5);
#if METHOD == JITTER
    within = vec2(pcg(uvec3(pixel, i)).xy >> 8) / 16777216.0;
#endif
    return (cell + within) / float(SIDE);
#endif
}

void mainImage(out vec4 mean, in vec2 fragCoord) {
    float sum = 0.0, h = 0.5 * iResolution.y / ZOOM;
    vec2 corner = floor(fragCoord);
    for (int i = 0; i < SIDE * SIDE; i++) {
        sum += scene((corner + place(i, ivec2(fragCoord))) / ZOOM, h);
    }
    mean = vec4(vec3(sum / float(SIDE * SIDE)), 1.0);
}
