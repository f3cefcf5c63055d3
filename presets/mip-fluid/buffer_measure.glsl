// x: the vorticity, the mean of that of every scale by its weight, in turns of a radian a second. y: divergence, in 1 /
// seconds. Channel 0 is the velocity just moved, with mips.

vec2 velocityAt(vec2 uv, float level) {
    return textureLod(iChannel0, uv, level).xy;
}

void mainImage(out vec4 measure, in vec2 fragCoord) {
    vec2 size = iResolution.xy, uv = fragCoord / size;
    float sum = 0.0, total = 1e-6, divergence = 0.0;
    for (int l = 0; l < MAX_SCALES; l++) {
        if (l >= max(levelsOf(size), 1)) break;
        float level = float(l), reach = exp2(level), w = weightOf(l);
        vec2 x = vec2(reach / size.x, 0.0), y = vec2(0.0, reach / size.y);
        vec2 across = velocityAt(uv + x, level) - velocityAt(uv - x, level);
        vec2 upwards = velocityAt(uv + y, level) - velocityAt(uv - y, level);
        float perHeight = 0.5 * size.y / reach;
        sum += w * perHeight * (across.y - upwards.x);
        if (l == 0) divergence = perHeight * (across.x + upwards.y);
        total += w;
    }
    measure = vec4(sum / total, divergence, 0.0, 0.0);
    if (!isFinite(measure)) measure = vec4(0.0);
}
