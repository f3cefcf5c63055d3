// The height of the surface. Channel 0 is this frame's fluid, channel 1 this buffer in the last frame.
//
// The flow carries it, eddies dent it (left-handed ones raise it), and it settles:
//     h' = (h + tension / 8 lap h)(upstream) exp(-dt / settle_seconds) + dent * vorticity * dt
// y is the height a frame ago, for whoever wants its rate. There is no mouse here, but row 0 is not fluid and stays flat.

vec4 heightOf(ivec2 p) {
    return texelFetch(iChannel1, nearestCell(p, ivec2(iResolution.xy)), 0);
}

// Flat at the walls, where the fluid is held.
float open(ivec2 p, ivec2 size) {
    vec2 toWall = min(vec2(p) - vec2(0.0, 1.0), vec2(size - 1 - p));
    return mix(0.9, 1.0, smoothstep(0.0, 12.0, min(toWall.x, toWall.y)));
}

void mainImage(out vec4 height, in vec2 fragCoord) {
    ivec2 size = ivec2(iResolution.xy), p = ivec2(fragCoord);
    height = vec4(0.0);
    if (p.y == 0) return;

    vec4 fluid = CELL(iChannel0, p, size);
    vec2 from = upstream(p, fluid.xy, SUBSTEPS * dt, size);
    ivec2 i = ivec2(floor(from));
    vec2 f = from - vec2(i);
    float carried = mix(mix(heightOf(i).x, heightOf(i + ivec2(1, 0)).x, f.x),
                        mix(heightOf(i + ivec2(0, 1)).x, heightOf(i + 1).x, f.x), f.y);
    float around = heightOf(p - ivec2(1, 0)).x + heightOf(p + ivec2(1, 0)).x + heightOf(p - ivec2(0, 1)).x + heightOf(p + ivec2(0, 1)).x;
    carried += 0.125 * tension * (around - 4.0 * heightOf(p).x);
    // Vorticity is in 1 / unit of time, and falls as the canvas grows: an eddy has the same speed and more pixels.
    float now = carried * open(p, size) * exp(-iTimeDelta / max(settle_seconds, 1e-3)) + dent * fluid.w * iTimeDelta * iResolution.y / 90.0;
    height = vec4(now, heightOf(p).x, 0.0, 0.0);
    if (!isFinite(height)) height = vec4(0.0);
}
