// The dye: rgb. Channel 0 is this frame's fluid, channel 1 this buffer in the last frame. Row 0 is the mouse's memory.
//
// dye' = dye(where this fluid was) * exp(-dt / decay_seconds) + what is poured in during the frame.
// In still fluid an emitter's total therefore tends to pours * pi * radius^2 * decay_seconds.

vec3 dyeOf(ivec2 p) {
    vec4 q = texelFetch(iChannel1, nearestCell(p, ivec2(iResolution.xy)), 0);
    return isFinite(q) ? q.rgb : vec3(0.0);
}

vec2 velocityOf(vec2 at) {
    ivec2 size = ivec2(iResolution.xy), i = ivec2(floor(at));
    vec2 f = at - vec2(i);
    return mix(mix(CELL(iChannel0, i, size).xy, CELL(iChannel0, i + ivec2(1, 0), size).xy, f.x),
               mix(CELL(iChannel0, i + ivec2(0, 1), size).xy, CELL(iChannel0, i + ivec2(1, 1), size).xy, f.x), f.y);
}

// Weights of the four texels around a point at fraction f between the middle two. R. Keys, "Cubic Convolution
// Interpolation for Digital Image Processing", IEEE ASSP 29(6), 1981, with a = -1/2.
vec4 cubic(float f) {
    float f2 = f * f, f3 = f2 * f;
    return 0.5 * vec4(-f + 2.0 * f2 - f3, 2.0 - 5.0 * f2 + 3.0 * f3, f + 4.0 * f2 - 3.0 * f3, f3 - f2);
}

// The twelve texels of the 4 x 4 without its corners, whose weights are the smallest; the sum of the rest is made 1.
// Cut to the range of the four nearest, so that no colour appears that was not there.
vec3 dyeAt(vec2 at) {
    ivec2 i = ivec2(floor(at));
    vec4 wx = cubic(at.x - float(i.x)), wy = cubic(at.y - float(i.y));
    vec3 a = dyeOf(i), b = dyeOf(i + ivec2(1, 0)), c = dyeOf(i + ivec2(0, 1)), d = dyeOf(i + 1);
    vec3 sum = wy.y * (wx.x * dyeOf(i + ivec2(-1, 0)) + wx.y * a + wx.z * b + wx.w * dyeOf(i + ivec2(2, 0)))
             + wy.z * (wx.x * dyeOf(i + ivec2(-1, 1)) + wx.y * c + wx.z * d + wx.w * dyeOf(i + ivec2(2, 1)))
             + wy.x * (wx.y * dyeOf(i + ivec2(0, -1)) + wx.z * dyeOf(i + ivec2(1, -1)))
             + wy.w * (wx.y * dyeOf(i + ivec2(0, 2)) + wx.z * dyeOf(i + ivec2(1, 2)));
    sum /= 1.0 - (wx.x + wx.w) * (wy.x + wy.w);
    return clamp(sum, min(min(a, b), min(c, d)), max(max(a, b), max(c, d)));
}

void mainImage(out vec4 dye, in vec2 fragCoord) {
    ivec2 size = ivec2(iResolution.xy), p = ivec2(fragCoord);
    vec4 before = texelFetch(iChannel1, MOUSE, 0);
    if (p.y == 0) {
        dye = p == MOUSE ? rememberMouse(before, iMouse, iTimeDelta) : vec4(0.0);
        return;
    }

    // Midpoint rule: look half a frame upstream for the velocity that carries the dye here.
    float frame = SUBSTEPS * dt;
    vec2 middle = upstream(p, velocityOf(vec2(p)), 0.5 * frame, size);
    vec3 now = dyeAt(upstream(p, velocityOf(middle), frame, size));
    now *= exp(-iTimeDelta / max(decay_seconds, 1e-3));

    float pouring = 0.0;
    for (int i = 0; i < EMITTERS; i++) {
        pouring += emitterWeight(fragCoord, emitter(i, iTime, iResolution.xy), iResolution.xy) * idleness(before);
    }
    pouring += 2.0 * brush(fragCoord, before, iMouse, emitterRadius(iResolution.xy));
    dye = vec4(now + pouring * pours * iTimeDelta, 1.0);
}
