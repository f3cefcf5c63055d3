// The velocity in the middle of the step, from the last two: what carries, in xy; and the velocity now, in zw.
void mainImage(out vec4 drift, in vec2 fragCoord) {
    vec2 now = texelFetch(iChannel0, ivec2(fragCoord), 0).xy, before = texelFetch(iChannel1, ivec2(fragCoord), 0).zw;
    drift = vec4(1.5 * now - 0.5 * before, now);
}
