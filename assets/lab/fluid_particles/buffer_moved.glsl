// Where each particle is after the step, from the corner of the cell that it was in: along the velocity of the
// middle of the step, by the midpoint rule, and not beyond the cells around. And its velocity.
void mainImage(out vec4 moved, in vec2 fragCoord) {
    ivec2 slot = ivec2(fragCoord), cell = slot / SIDE;
    moved = texelFetch(iChannel0, slot, 0);
    if (isEmpty(moved)) return;
    vec2 velocity = splined(iChannel2, cell, moved.xy).xy;
#if METHOD == FLIP
    if (moved.z < UNKNOWN) velocity += moved.zw - splined(iChannel3, cell, moved.xy).xy;
#endif
    vec2 middle = moved.xy + clamp(0.5 * dt * splined(iChannel1, cell, moved.xy).xy, -1.0, 1.0);
    vec2 path = dt * splined(iChannel1, cell, middle).xy;
    moved = vec4(moved.xy + clamp(path, -1.0, 1.0), velocity);
}
