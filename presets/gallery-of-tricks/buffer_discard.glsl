// Balls in the first texels of row 0, drawn every frame. Above them, texels that are drawn once and then discarded:
// those on the left in the first frame only, those on the right in the first two. Channel 0 is this buffer in the last
// frame.

void mainImage(out vec4 state, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    int frame = iFrame % restart;
    state = vec4(0.0);
    if (p.y == 0) {
        if (p.x >= BALLS) discard;
        state = ballStep(texelFetch(iChannel0, p, 0), p.x, frame == 0);
        return;
    }
    bool left = 2.0 * fragCoord.x < iResolution.x;
    if (frame > (left ? 0 : 1)) discard;
    if (left && iFrame > 0) discard; // not even when everything else starts again: that would mend the other texture
    vec2 q = fract(fragCoord / iResolution.xy * vec2(2.0, 1.0)) - 0.5;
    float d = abs(length(q) - 0.28);
    float petals = abs(length(q) - 0.28 - 0.09 * cos(7.0 * atan(q.y, q.x)));
    state = vec4(smoothstep(0.05, 0.02, petals), smoothstep(0.02, 0.01, d), 0.0, 1.0);
}
