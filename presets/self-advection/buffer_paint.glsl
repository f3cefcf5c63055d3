// The paint: xy the vector that stirs, zw what it carries besides. Channel 0 is this buffer in the last frame,
// repeating; channel 1 the flow, channel 2 the mouse.

vec4 paintOf(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    p = ivec2(mod(vec2(p), vec2(size)));
    vec4 q = texelFetch(iChannel0, p, 0);
    return isFinite(q) ? q : vec4(0.0);
}

// Keys' cubic (see the comment in the fluid): bilinear would blur the filaments away.
vec4 cubic(float f) {
    float f2 = f * f, f3 = f2 * f;
    return 0.5 * vec4(-f + 2.0 * f2 - f3, 2.0 - 5.0 * f2 + 3.0 * f3, f + 4.0 * f2 - 3.0 * f3, f3 - f2);
}

// The part of the paint that is looked up by a linear filter. Without it fronts, where the flow presses paints
// together, end as steps from texel to texel.
#iUniform float blur = 0.2 in { 0.0, 1.0 }

// The 4 x 4 without its corners, the sum of the weights made 1; cut to the range of the four nearest.
vec4 paintAt(vec2 at) {
    ivec2 i = ivec2(floor(at));
    vec4 wx = cubic(at.x - float(i.x)), wy = cubic(at.y - float(i.y));
    vec4 a = paintOf(i), b = paintOf(i + ivec2(1, 0)), c = paintOf(i + ivec2(0, 1)), d = paintOf(i + 1);
    vec4 sum = wy.y * (wx.x * paintOf(i + ivec2(-1, 0)) + wx.y * a + wx.z * b + wx.w * paintOf(i + ivec2(2, 0)))
             + wy.z * (wx.x * paintOf(i + ivec2(-1, 1)) + wx.y * c + wx.z * d + wx.w * paintOf(i + ivec2(2, 1)))
             + wy.x * (wx.y * paintOf(i + ivec2(0, -1)) + wx.z * paintOf(i + ivec2(1, -1)))
             + wy.w * (wx.y * paintOf(i + ivec2(0, 2)) + wx.z * paintOf(i + ivec2(1, 2)));
    sum /= 1.0 - (wx.x + wx.w) * (wy.x + wy.w);
    vec2 f = at - vec2(i);
    sum = mix(sum, mix(mix(a, b, f.x), mix(c, d, f.x), f.y), blur);
    return clamp(sum, min(min(a, b), min(c, d)), max(max(a, b), max(c, d)));
}

// A vector after a time t, whose length s grows by ds/dt = s (1 - s^2). The equation's own solution and no step of it:
// however long t is, none passes the length 1.
vec2 grown(vec2 v, float t) {
    float size2 = dot(v, v);
    return v * inversesqrt(max(mix(1.0, size2, 1.0 - exp(-2.0 * t)), 1e-20));
}

// Smooth noise at frame 0: four octaves of random values, interpolated.
vec4 noise(vec2 uv) {
    vec4 sum = vec4(0.0);
    float weight = 0.5, across = 3.0;
    for (int octave = 0; octave < 4; octave++) {
        vec2 at = uv * across;
        ivec2 i = ivec2(floor(at));
        vec2 f = at - vec2(i);
        f = f * f * (3.0 - 2.0 * f);
        vec3 n = mix(mix(hash(ivec3(i, octave)), hash(ivec3(i + ivec2(1, 0), octave)), f.x),
                     mix(hash(ivec3(i + ivec2(0, 1), octave)), hash(ivec3(i + 1, octave)), f.x), f.y);
        sum += weight * vec4(2.0 * n - 1.0, 2.0 * n.x * n.z - 0.5);
        weight *= 0.6;
        across *= 2.0;
    }
    return sum;
}

void mainImage(out vec4 paint, in vec2 fragCoord) {
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    ivec2 p = ivec2(fragCoord);
    if (iFrame == 0 || texelFetch(iChannel0, p, 0) == vec4(0.0)) { // or what a resize has just uncovered
        paint = noise(uv + 8.0);
        return;
    }
    vec2 flow = textureLod(iChannel1, fragCoord / iResolution.xy, 0.0).xy;
    paint = paintAt(vec2(p) - strength * iResolution.y / 270.0 * flow);

    // Vectors grow towards length 1; what they carry follows more slowly, so that colours do not all end in the
    // corners.
    paint.xy = grown(paint.xy, vigour * iTimeDelta);
    paint.zw = grown(paint.zw, 0.3 * vigour * iTimeDelta);

    vec4 mouse = texelFetch(iChannel2, ivec2(0), 0);
    if (mouse.z > 0.0) {
        // The brush combs: vectors under it turn the way it goes.
        vec2 along = mouse.zw - mouse.xy;
        float d = segmentDistance(fragCoord, mouse.xy, mouse.zw) / (brush_size * iResolution.y + 1.0);
        vec2 way = along / max(length(along), 1e-6) * min(length(along), 1.0);
        paint = mix(paint, vec4(way, 0.9 * sin(iTime), 0.9 * cos(0.7 * iTime)),
                    0.4 * exp(-d * d) * min(length(along), 1.0));
    } else {
        // Two wheels at work while nobody combs.
        for (int i = 0; i < 2; i++) {
            float turn = 0.21 * iTime + 3.14159265 * float(i);
            vec2 at = vec2(0.55 * cos(turn), 0.26 * sin(2.0 * turn));
            vec2 off = (uv - at) / 0.09;
            vec4 wheel = vec4(perp(off) * (i == 0 ? 1.3 : -1.3), sin(0.37 * iTime), cos(0.29 * iTime + float(i)));
            paint = mix(paint, wheel, 0.03 * wheels * exp(-dot(off, off)));
        }
    }
    paint = clamp(paint, -1.5, 1.5);
    if (!isFinite(paint)) paint = vec4(0.0);
}
