// A wave as long as a texel of level l is divided by a square of its wave number, which is as 4^-l.
void mainImage(out vec4 field, in vec2 fragCoord) {
    float sum = 0.0, weight = -0.25;
    int levels = int(log2(max(iResolution.x, iResolution.y)));
    for (int level = 0; level < levels; ++level) {
        sum += weight * textureLod(iChannel0, fragCoord / iResolution.xy, float(level)).x;
        weight *= 4.0;
    }
    field = vec4(sum, 0.0, 0.0, 1.0);
}
