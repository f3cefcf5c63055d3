// Blurs every tile along its rows. Channel 0 is Buffer B.

void mainImage(out vec4 blurred, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    Tile t = tileAt(p, ivec2(iResolution.xy));
    blurred = vec4(0.0);
    if (t.level == 0) return;
    int low = t.from.x, high = t.from.x + t.size.x - 1; // only the padding's own blur, which nobody reads, meets these
    blurred = WEIGHT[0] * texelFetch(iChannel0, p, 0);
    for (int i = 1; i <= PAD; i++) {
        blurred += WEIGHT[i] * (texelFetch(iChannel0, ivec2(max(p.x - i, low), p.y), 0)
                              + texelFetch(iChannel0, ivec2(min(p.x + i, high), p.y), 0));
    }
}
