// The height of the surface. Channel 0 is this frame's fluid, channel 1 this buffer in the last frame.
//
// The flow carries it, eddies dent it (left-handed ones raise it), and it settles to a slow swell, h0:
//     h' = h0 + ((h + tension / 8 lap h)(upstream) - h0) exp(-dt / settle_seconds) + dent * vorticity * dt
// The Laplacian is upstream too. What is carried is then a mean of heights with positive weights, so that no height is
// made by carrying; taken here, it would be of cells that have left, and where the flow is fast it feeds what
// alternates. y is the height a frame ago, for whoever wants its rate. There is no mouse here, but row 0 is not fluid
// and stays flat.

float heightOf(ivec2 p) {
    vec4 q = texelFetch(iChannel1, nearestCell(p, ivec2(iResolution.xy)), 0);
    return isFinite(q) ? q.x : 0.0;
}

// A height after surface tension.
float smoothed(float here, float a, float b, float c, float d) {
    return here + 0.125 * tension * ((a - here) + (b - here) + (c - here) + (d - here));
}

// 0 at the walls, where the fluid is held and what shears there is no eddy.
float open(ivec2 p, ivec2 size) {
    vec2 toWall = min(vec2(p) - vec2(0.0, 1.0), vec2(size - 1 - p));
    return smoothstep(0.0, 16.0, min(toWall.x, toWall.y));
}

// Three long waves that cross; `at` in canvas heights.
float swellAt(vec2 at, float time) {
    return swell / 3.0 * (sin(dot(at, vec2(7.1, 4.3)) + 0.50 * time) + sin(dot(at, vec2(-4.2, 8.7)) - 0.37 * time + 1.0)
                          + sin(dot(at, vec2(11.5, -3.1)) + 0.61 * time + 2.5));
}

void mainImage(out vec4 height, in vec2 fragCoord) {
    ivec2 size = ivec2(iResolution.xy), p = ivec2(fragCoord);
    height = vec4(0.0);
    if (p.y == 0) return;

    vec4 fluid = CELL(iChannel0, p, size);
    vec2 from = upstream(p, fluid.xy, SUBSTEPS * dt, size);
    ivec2 i = ivec2(floor(from));
    vec2 f = from - vec2(i);
    float a = heightOf(i), b = heightOf(i + ivec2(1, 0)), c = heightOf(i + ivec2(0, 1)), d = heightOf(i + 1);
    float smoothA = smoothed(a, b, c, heightOf(i - ivec2(1, 0)), heightOf(i - ivec2(0, 1)));
    float smoothB = smoothed(b, a, d, heightOf(i + ivec2(2, 0)), heightOf(i + ivec2(1, -1)));
    float smoothC = smoothed(c, a, d, heightOf(i + ivec2(-1, 1)), heightOf(i + ivec2(0, 2)));
    float smoothD = smoothed(d, b, c, heightOf(i + ivec2(2, 1)), heightOf(i + ivec2(1, 2)));
    float lower = smoothA + f.x * (smoothB - smoothA), upper = smoothC + f.x * (smoothD - smoothC);
    float carried = lower + f.y * (upper - lower);
    // Vorticity is in 1 / unit of time, and falls as the canvas grows: an eddy has the same speed and more pixels.
    float dented = dent * fluid.w * iTimeDelta * iResolution.y / 90.0;
    float still = swellAt(fragCoord / iResolution.y, iTime);
    if (iFrame == 0) carried = still;
    float now = still + (carried - still) * exp(-iTimeDelta / max(settle_seconds, 1e-3)) + dented * open(p, size);
    height = vec4(now, heightOf(p), 0.0, 0.0);
    if (!isFinite(height)) height = vec4(0.0);
}
