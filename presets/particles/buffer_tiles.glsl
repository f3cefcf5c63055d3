// The particles of each tile. Channel 0 is this frame's motion, channel 1 anything as large as the canvas.
//
// A texel goes through all particles, counts those whose streak may shine into its tile, and keeps the numbers (plus
// one; 0 is none) of those whose turn is its own: the first texel of a tile the first four, and so on. Sixty-four have
// room; where more crowd, as on canvases of under 90 rows, where a pixel is large, the picture loses the last, and
// nothing else does: nothing to be seen on 54 rows, 0.2 % of the light on 36, 8 % on 18.

void mainImage(out vec4 numbers, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), tile = p / TILE, slot = p - TILE * tile;
    numbers = vec4(0.0);

    // The tile in heights from the middle.
    vec2 canvas = iChannelResolution[1].xy, wide = vec2(canvas.x / canvas.y, 1.0);
    vec2 low = (vec2(tile) / vec2(TILES) - 0.5) * wide, high = (vec2(tile + 1) / vec2(TILES) - 0.5) * wide;
    float seconds = clamp(speed * iTimeDelta, 0.0, 0.5);
    int first = 4 * (slot.y * TILE + slot.x), count = 0;
    for (int n = 0; n < COUNT; n++) {
        vec4 m = texelFetch(iChannel0, texelOf(n), 0);
        vec2 before = m.xy - seconds * m.zw, reach = vec2(REACH * radiusOf(typeOf(n), canvas.y));
        if (all(greaterThan(max(m.xy, before) + reach, low)) && all(lessThan(min(m.xy, before) - reach, high))) {
            int mine = count - first;
            if (mine == 0) numbers.x = float(n + 1);
            if (mine == 1) numbers.y = float(n + 1);
            if (mine == 2) numbers.z = float(n + 1);
            if (mine == 3) numbers.w = float(n + 1);
            count++;
            if (mine >= 3) break;
        }
    }
}
