// Along the rows. Channel 0 is Buffer A; both passes of method 3 are one fetch, made in Buffer C.

void mainImage(out vec4 blurred, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    ivec3 panel = panelOf(p.x, int(iResolution.x));
    int last = panel.x + panel.y - 1; // the panel's edge goes on for ever: nothing comes over from the neighbour
    float sum = bellSum();
    blurred = texelFetch(iChannel0, p, 0);
    if (panel.z == 1) {
        blurred *= bell(0.0);
        for (int i = 1; i <= REACH; i++) {
            vec4 pair = texelFetch(iChannel0, ivec2(max(p.x - i, panel.x), p.y), 0)
                      + texelFetch(iChannel0, ivec2(min(p.x + i, last), p.y), 0);
            blurred += bell(float(i)) * pair;
        }
        blurred /= sum;
    } else if (panel.z == 2) {
        blurred *= bell(0.0);
        for (int i = 1; i < REACH; i += 2) {
            float near = bell(float(i)), far = bell(float(i + 1)), both = near + far;
            float off = (near * float(i) + far * float(i + 1)) / max(both, 1e-30);
            float left = max(fragCoord.x - off, float(panel.x) + 0.5), right = min(fragCoord.x + off, float(last) + 0.5);
            blurred += both * (textureLod(iChannel0, vec2(left, fragCoord.y) / iResolution.xy, 0.0)
                             + textureLod(iChannel0, vec2(right, fragCoord.y) / iResolution.xy, 0.0));
        }
        blurred /= sum;
    }
}
