// The velocity in the middle of the step, from the last two frames: what carries, in xy; and the velocity now, in zw.
// Channel 0 is the velocity of the last frame, channel 1 this buffer.

void mainImage(out vec4 drift, in vec2 fragCoord) {
    vec4 now = texelFetch(iChannel0, ivec2(fragCoord), 0);
    vec2 before = texelFetch(iChannel1, ivec2(fragCoord), 0).zw;
    float ratio = stepRatio(now.w, iTimeDelta * speed);
    vec2 middle = now.xy + 0.5 * ratio * (now.xy - before);
    drift = vec4(now.w > 0.0 ? middle : now.xy, now.xy);
    if (!isFinite(drift)) drift = vec4(0.0);
}
