// The mouse in this frame and in the frame before, so that the brush draws a stroke and not dots:
// (x, y before; x, y now). All negative where there is nothing to join up with.

void mainImage(out vec4 memory, in vec2 fragCoord) {
    vec4 before = texelFetch(iChannel0, ivec2(0), 0);
    bool held = iMouse.z > 0.0;
    vec2 now = held ? iMouse.xy + 0.5 : vec2(-1e4);
    memory = vec4(iFrame > 0 && isFinite(before) && before.z > 0.0 ? before.zw : now, now);
}
