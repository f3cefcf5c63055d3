// One sub-step. Channel 0 is the state before it.

void mainImage(out vec4 state, in vec2 fragCoord) {
    ivec2 size = ivec2(iResolution.xy);
    ivec2 p = ivec2(fragCoord);
    vec4 before = texelFetch(iChannel0, MOUSE, 0);
    if (p.y == 0) {
        state = p == MOUSE ? rememberMouse(before, iMouse, iTimeDelta / SUBSTEPS) : vec4(0.0);
        return;
    }

    Stencil s;
    s.centre = CELL(iChannel0, p, size);
    s.left = CELL(iChannel0, p - ivec2(1, 0), size);
    s.right = CELL(iChannel0, p + ivec2(1, 0), size);
    s.down = CELL(iChannel0, p - ivec2(0, 1), size);
    s.up = CELL(iChannel0, p + ivec2(0, 1), size);
    if (form != CLASSIC) {
        s.farLeft = CELL(iChannel0, p - ivec2(2, 0), size);
        s.farRight = CELL(iChannel0, p + ivec2(2, 0), size);
        s.farDown = CELL(iChannel0, p - ivec2(0, 2), size);
        s.farUp = CELL(iChannel0, p + ivec2(0, 2), size);
        s.downLeft = CELL(iChannel0, p - ivec2(1, 1), size);
        s.downRight = CELL(iChannel0, p + ivec2(1, -1), size);
        s.upLeft = CELL(iChannel0, p + ivec2(-1, 1), size);
        s.upRight = CELL(iChannel0, p + ivec2(1, 1), size);
    }

    // Bilinear by hand: exact weights on every device, and the mirrored ghosts beyond the walls.
    vec2 from = upstream(p, s.centre.xy, dt, size);
    ivec2 i = ivec2(floor(from));
    vec2 f = from - vec2(i);
    vec2 arriving = mix(mix(CELL(iChannel0, i, size).xy, CELL(iChannel0, i + ivec2(1, 0), size).xy, f.x),
                        mix(CELL(iChannel0, i + ivec2(0, 1), size).xy, CELL(iChannel0, i + ivec2(1, 1), size).xy, f.x),
                    f.y);

    state = fluidStep(s, arriving, p, size);
    state.xy = emit(state.xy, fragCoord, iTime, idleness(before), iResolution.xy);
    state.xy = drag(state, fragCoord, before, iMouse, iResolution.xy);
}
