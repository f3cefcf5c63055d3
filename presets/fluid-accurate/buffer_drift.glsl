// The velocity in the middle of the step, from the last two frames, times the step's pace: what carries, in xy; and the
// velocity now, in zw. Channel 0 is the velocity of the last frame, channel 1 this buffer, channel 2 the pace.

void mainImage(out vec4 drift, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec4 now = texelFetch(iChannel0, p, 0);
    vec2 before = texelFetch(iChannel1, p, 0).zw;
    float pace = paceIn(iChannel2);
    vec2 middle = now.xy + 0.5 * stepRatio(now.w, stepNow(iChannel2)) * (now.xy - before);
    drift = vec4(pace * (now.w > 0.0 ? middle : now.xy), now.xy);
    if (!isFinite(drift)) drift = vec4(0.0);
}
