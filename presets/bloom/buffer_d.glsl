// Blurs the first levels along their columns, and the others, which are small, along both axes at once. Channel 0 is
// Buffer C.

void mainImage(out vec4 blurred, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), canvas = ivec2(iResolution.xy);
    Tile t = tileAt(p, canvas);
    blurred = vec4(0.0);
    if (t.level == 0) return;
    ivec2 i = p - t.from;
    int across = t.level > DIRECT ? REACH : 0;
    for (int y = -REACH; y <= REACH; y++) {
        for (int x = -across; x <= across; x++) {
            float weight = WEIGHT[abs(y)] * (across > 0 ? WEIGHT[abs(x)] : 1.0);
            blurred += weight * texelFetch(iChannel0, t.from + mirrored(i + ivec2(x, y), t.size), 0);
        }
    }
}
