// The sum over levels that stands for the solution of lap p = div u. Channel 0: vorticity and divergence, with mips.

// A level by its cubic B-spline: four bilinear looks at places between the texels that stand for sixteen (C. Sigg,
// M. Hadwiger, "Fast Third-Order Texture Filtering", GPU Gems 2, chapter 20). Bilinear alone has kinks, whose gradient
// is a jump in the velocity along the edges of the coarse levels' texels.
float smoothly(vec2 uv, int level) {
    vec2 size = vec2(textureSize(iChannel0, level)), at = uv * size - 0.5, i = floor(at), f = at - i;
    vec2 f2 = f * f, f3 = f2 * f;
    vec2 w0 = (1.0 - 3.0 * f + 3.0 * f2 - f3) / 6.0, w1 = (4.0 - 6.0 * f2 + 3.0 * f3) / 6.0, w3 = f3 / 6.0;
    vec2 low = w0 + w1, high = 1.0 - low;
    vec2 a = (i + 0.5 - w0 / low) / size, b = (i + 1.5 + w3 / high) / size;
    float l = float(level);
    return low.y * (low.x * textureLod(iChannel0, a, l).y + high.x * textureLod(iChannel0, vec2(b.x, a.y), l).y)
         + high.y * (low.x * textureLod(iChannel0, vec2(a.x, b.y), l).y + high.x * textureLod(iChannel0, b, l).y);
}

void mainImage(out vec4 pressure, in vec2 fragCoord) {
    vec2 size = iResolution.xy, uv = fragCoord / size;
    float sum = 0.0, weight = 1.0;
    for (int l = 0; l < MAX_SCALES; l++) {
        if (l >= levelsOf(size)) break;
        float level = float(l);
        float mean = l == 0 ? textureLod(iChannel0, uv, 0.0).y : smoothly(uv, l);
        sum += (l == 0 ? 1.0 : weight * (1.0 - 1.0 / pressure_slope)) * mean;
        weight *= pressure_slope;
    }
    // In heights squared a second: a texel is 1 / size.y heights.
    pressure = vec4(-pressure_strength * sum / (size.y * size.y), 0.0, 0.0, 0.0);
    if (!isFinite(pressure)) pressure = vec4(0.0);
}
