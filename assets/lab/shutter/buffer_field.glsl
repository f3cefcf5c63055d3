void mainImage(out vec4 mean, in vec2 fragCoord) {
#if METHOD == OPENING
    float late = 0.0;
#elif METHOD == MIDDLE
    float late = 0.5;
#else
    float late = float(pcg(uvec3(fragCoord, 0)).x >> 8) / 16777216.0;
#endif
    float sum = 0.0;
    for (int i = 0; i < PARTS; i++) sum += scene(fragCoord, 0.5 * iResolution.y, (float(i) + late) / float(PARTS));
    mean = vec4(vec3(sum / float(PARTS)), 1.0);
}
