// Blurs the first levels along their rows, and packs the others, each straight from the last of the first ones.
// Channel 0 is Buffer B.

void mainImage(out vec4 packed, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), canvas = ivec2(iResolution.xy);
    Tile t = tileAt(p, canvas);
    packed = vec4(0.0);
    if (t.level == 0) return;
    ivec2 i = p - t.from;
    if (t.level > DIRECT) {
        Tile source = directTile(canvas);
        packed = gathered(iChannel0, source.from, source.size, i, t.size, 1e30);
        return;
    }
    packed = WEIGHT[0] * texelFetch(iChannel0, p, 0);
    for (int j = 1; j <= REACH; j++) {
        packed += WEIGHT[j] * (texelFetch(iChannel0, t.from + mirrored(i - ivec2(j, 0), t.size), 0)
                             + texelFetch(iChannel0, t.from + mirrored(i + ivec2(j, 0), t.size), 0));
    }
}
