// Blurs every tile along its columns. Channel 0 is Buffer C.

void mainImage(out vec4 blurred, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    Tile t = tileAt(p, ivec2(iResolution.xy));
    blurred = vec4(0.0);
    if (t.level == 0) return;
    int low = t.from.y, high = t.from.y + t.size.y - 1;
    blurred = WEIGHT[0] * texelFetch(iChannel0, p, 0);
    for (int i = 1; i <= PAD; i++) {
        blurred += WEIGHT[i] * (texelFetch(iChannel0, ivec2(p.x, max(p.y - i, low)), 0)
                              + texelFetch(iChannel0, ivec2(p.x, min(p.y + i, high)), 0));
    }
}
