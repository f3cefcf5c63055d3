// The particles of each tile. Channel 0 is this frame's motion.
//
// A texel goes through all particles, counts those whose streak may shine into its tile, and keeps the numbers (plus one;
// 0 is none) of those whose turn is its own: the first texel of a tile the first four, and so on. Sixty-four have room.

void mainImage(out vec4 numbers, in vec2 fragCoord) {
    ivec2 texels = ivec2(iResolution.xy), p = ivec2(fragCoord);
    ivec2 tiles = tileCount(texels), slots = tileSlots(texels);
    ivec2 tile = min(p / 4, tiles - 1), slot = p - 4 * tile;
    numbers = vec4(0.0);
    if (slot.x >= slots.x || slot.y >= slots.y) return; // left over at the right and upper edge

    // The tile in heights from the middle.
    float aspect = iResolution.x / iResolution.y;
    vec2 low = (vec2(tile) / vec2(tiles) - 0.5) * vec2(aspect, 1.0), high = (vec2(tile + 1) / vec2(tiles) - 0.5) * vec2(aspect, 1.0);
    float seconds = clamp(speed * iTimeDelta, 0.0, 0.5);
    int first = 4 * (slot.y * slots.x + slot.x), count = 0;
    for (int n = 0; n < COUNT; n++) {
        vec4 m = texelFetch(iChannel0, texelOf(n), 0);
        vec2 before = m.xy - seconds * m.zw, reach = vec2(reachOf(typeOf(n)));
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
