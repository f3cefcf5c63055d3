// Along the columns. Channel 0 is Buffer B; channel 1 is Buffer A with its mip levels, channel 2 the weights.

void mainImage(out vec4 blurred, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    ivec3 panel = panelOf(p.x, int(iResolution.x));
    int last = int(iResolution.y) - 1, row = rowOf(panel.z), most = reach(panel.z);
    if (panel.z == MIP) {
        blurred = textureLod(iChannel1, fragCoord / iResolution.xy, levelOfSigma());
        return;
    }
    blurred = texelFetch(iChannel2, ivec2(0, row), 0).x * texelFetch(iChannel0, p, 0);
    if (isTaps(panel.z)) {
        for (int i = 1; i <= most; i++) {
            vec4 pair = texelFetch(iChannel0, ivec2(p.x, max(p.y - i, 0)), 0)
                      + texelFetch(iChannel0, ivec2(p.x, min(p.y + i, last)), 0);
            blurred += texelFetch(iChannel2, ivec2(i, row), 0).x * pair;
        }
    } else {
        for (int i = 1; i <= most; i += 2) {
            float near = texelFetch(iChannel2, ivec2(i, row), 0).x, far = texelFetch(iChannel2, ivec2(i + 1, row), 0).x;
            float both = near + far;
            vec2 off = vec2(0.0, float(i) + far / max(both, 1e-30));
            blurred += both * (textureLod(iChannel0, (fragCoord - off) / iResolution.xy, 0.0)
                             + textureLod(iChannel0, (fragCoord + off) / iResolution.xy, 0.0));
        }
    }
}
