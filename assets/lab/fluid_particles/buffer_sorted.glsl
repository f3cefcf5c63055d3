// The particles that are in each cell now, in the order in which they are found in it and the eight around it.
// Those for which it has no place are dropped.
void mainImage(out vec4 particle, in vec2 fragCoord) {
    ivec2 texel = ivec2(fragCoord), cell = texel / SIDE, place = texel % SIDE;
    int wanted = place.x + SIDE * place.y, found = 0;
    for (int i = 0; i < 9; ++i) {
        ivec2 other = ivec2(i % 3, i / 3) - 1;
        for (int slot = 0; slot < MOST; ++slot) {
            vec4 moved = particleAt(iChannel0, cell + other, slot);
            if (isEmpty(moved) || ivec2(floor(moved.xy)) != -other) continue;
            if (found == wanted) {
                particle = vec4(min(moved.xy + vec2(other), 1.0 - 1.0 / 16777216.0), moved.zw);
                return;
            }
            ++found;
        }
    }
    particle = wanted < LEAST ? newParticle(texel, iFrame + 1) : EMPTY;
}
