// Channel 0: the velocity of the last frame; channel 1: its vorticity and divergence, with mips; channel 2: the mouse.

vec2 velocityAt(vec2 uv) {
    vec2 u = textureLod(iChannel0, uv, 0.0).xy;
    return isFinite(vec4(u, 0.0, 0.0)) ? u : vec2(0.0);
}

float vorticity(vec2 uv, float level) {
    return textureLod(iChannel1, uv, level).x;
}

void mainImage(out vec4 moved, in vec2 fragCoord) {
    vec2 size = iResolution.xy, uv = fragCoord / size;
    float aspect = size.x / size.y, seconds = speed * iTimeDelta;
    vec2 heights = vec2(1.0 / aspect, 1.0); // from heights to uv

    // Carried along, by the midpoint rule.
    vec2 middle = uv - 0.5 * seconds * velocityAt(uv) * heights;
    vec2 u = velocityAt(uv - seconds * velocityAt(middle) * heights);

    // On every scale: the slope of the vorticity's strength points into the eddies, at a right angle to it lies the way
    // round them. Confinement (R. Fedkiw, J. Stam, H. Jensen, "Visual Simulation of Smoke", SIGGRAPH 2001) pushes that
    // way; turbulence pushes along the lines of equal vorticity, which sharpens what large eddies blur out.
    vec2 confined = vec2(0.0), turbulent = vec2(0.0);
    float total = 1e-6;
    for (int l = 0; l < MAX_SCALES; l++) {
        if (l >= levelsOf(size)) break;
        float level = float(l), reach = exp2(level), w = weightOf(l);
        vec2 x = vec2(reach / size.x, 0.0), y = vec2(0.0, reach / size.y);
        float left = vorticity(uv - x, level), right = vorticity(uv + x, level);
        float down = vorticity(uv - y, level), up = vorticity(uv + y, level);
        vec2 inward = 0.5 * vec2(abs(right) - abs(left), abs(up) - abs(down));
        float here = 0.25 * (left + right + down + up);
        // Softened: noise far below one turn a second is not woken.
        confined -= w * here * perp(inward) / (length(inward) + 0.5);
        vec2 slope = 0.5 * vec2(right - left, up - down);
        turbulent += w * perp(slope) / (1.0 + length(slope));
        total += w;
    }
    u += seconds * (0.05 * confinement * confined + 0.25 * turbulence * turbulent) / total;
    u *= exp(-seconds / drag_seconds);

    // The hand, or two slow wheels while there is none.
    vec2 at = vec2(uv.x * aspect, uv.y);
    vec4 mouse = texelFetch(iChannel2, ivec2(0), 0);
    if (mouse.z > 0.0) {
        vec2 canvas = 2.0 * size;
        vec2 way = (mouse.zw - mouse.xy) / (canvas.y * max(iTimeDelta, 1e-3));
        float d = segmentDistance(at, mouse.xy / canvas.y, mouse.zw / canvas.y) / brush_size;
        float quick = length(way);
        if (quick > 1e-3) u = mix(u, way * min(1.0, MAX_SPEED / quick), 0.5 * exp(-d * d));
    } else {
        for (int i = 0; i < 3; i++) {
            float turn = 0.13 * iTime * (1.0 + 0.2 * float(i)) + 2.1 * float(i);
            vec2 centre = vec2(0.5 * aspect, 0.5) + vec2(0.40 * aspect * cos(turn), 0.33 * sin(1.7 * turn + 0.5));
            vec2 off = wayRound(at - centre, vec2(aspect, 1.0)) / 0.10;
            u += seconds * stirring * (i == 1 ? -1.5 : 1.5) * perp(off) * exp(-dot(off, off));
        }
    }
    u *= min(1.0, MAX_SPEED / max(length(u), 1e-6));
    moved = isFinite(vec4(u, 0.0, 0.0)) ? vec4(u, 0.0, 0.0) : vec4(0.0);
}
