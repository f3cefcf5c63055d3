// Along the columns. Channel 0 is Buffer B; channel 1 is Buffer A with its mip levels.

void mainImage(out vec4 blurred, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    ivec3 panel = panelOf(p.x, int(iResolution.x));
    int last = int(iResolution.y) - 1;
    float sum = bellSum();
    if (panel.z == 3) {
        blurred = textureLod(iChannel1, fragCoord / iResolution.xy, levelOfSigma());
        return;
    }
    blurred = bell(0.0) * texelFetch(iChannel0, p, 0);
    if (panel.z == 1) {
        for (int i = 1; i <= REACH; i++) {
            vec4 pair = texelFetch(iChannel0, ivec2(p.x, max(p.y - i, 0)), 0)
                      + texelFetch(iChannel0, ivec2(p.x, min(p.y + i, last)), 0);
            blurred += bell(float(i)) * pair;
        }
    } else {
        for (int i = 1; i < REACH; i += 2) {
            float near = bell(float(i)), far = bell(float(i + 1)), both = near + far;
            vec2 off = vec2(0.0, (near * float(i) + far * float(i + 1)) / max(both, 1e-30));
            blurred += both * (textureLod(iChannel0, (fragCoord - off) / iResolution.xy, 0.0)
                             + textureLod(iChannel0, (fragCoord + off) / iResolution.xy, 0.0));
        }
    }
    blurred /= sum;
}
