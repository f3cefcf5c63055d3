// The state blurred along its rows, drawn only where diffusion is a blur in two passes. Channel 0 is the state.

void mainImage(out vec4 state, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    int last = int(iResolution.x) - 1;
    vec2 weight[TAPS + 1];
    gaussian(min(dt, LONGEST_BLUR), weight);
    vec2 here = texelFetch(iChannel0, p, 0).xy;
    state = vec4(here, 0.0, 0.0);
    for (int i = 1; i <= TAPS; i++) {
        // Beyond the wall lies the mirror image, so that what leaves comes back.
        int left = p.x - i, right = p.x + i;
        left = max(left, -1 - left);
        right = min(right, 2 * last + 1 - right);
        state.xy += weight[i] * ((texelFetch(iChannel0, ivec2(clamp(left, 0, last), p.y), 0).xy - here)
                               + (texelFetch(iChannel0, ivec2(clamp(right, 0, last), p.y), 0).xy - here));
    }
}
