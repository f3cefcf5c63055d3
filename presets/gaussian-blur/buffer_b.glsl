// Along the rows. Channel 0 is Buffer A, channel 1 the weights; both passes of a mip level are one fetch, made in
// Buffer C.

void mainImage(out vec4 blurred, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    ivec3 panel = panelOf(p.x, int(iResolution.x));
    int last = panel.x + panel.y - 1; // the panel's edge goes on for ever: nothing comes over from the neighbour
    int row = rowOf(panel.z), most = reach(panel.z);
    blurred = texelFetch(iChannel0, p, 0);
    if (isTaps(panel.z)) {
        blurred *= texelFetch(iChannel1, ivec2(0, row), 0).x;
        for (int i = 1; i <= most; i++) {
            vec4 pair = texelFetch(iChannel0, ivec2(max(p.x - i, panel.x), p.y), 0)
                      + texelFetch(iChannel0, ivec2(min(p.x + i, last), p.y), 0);
            blurred += texelFetch(iChannel1, ivec2(i, row), 0).x * pair;
        }
    } else if (panel.z != MIP) {
        blurred *= texelFetch(iChannel1, ivec2(0, row), 0).x;
        for (int i = 1; i <= most; i += 2) {
            float near = texelFetch(iChannel1, ivec2(i, row), 0).x, far = texelFetch(iChannel1, ivec2(i + 1, row), 0).x;
            float both = near + far, off = float(i) + far / max(both, 1e-30);
            float left = max(fragCoord.x - off, float(panel.x) + 0.5),
                right = min(fragCoord.x + off, float(last) + 0.5);
            blurred += both * (textureLod(iChannel0, vec2(left, fragCoord.y) / iResolution.xy, 0.0)
                             + textureLod(iChannel0, vec2(right, fragCoord.y) / iResolution.xy, 0.0));
        }
    }
}
