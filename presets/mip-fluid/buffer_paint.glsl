// Marbling: bands of paint that the flow folds and that slowly return, each to its place. Channel 0: the velocity;
// channel 1: this buffer in the last frame. xyz: three paints; w: how strongly the flow turned here, for Image.

vec4 paintOf(ivec2 p) {
    vec4 q = texelFetch(iChannel1, ivec2(mod(vec2(p), iResolution.xy)), 0);
    return isFinite(q) ? q : vec4(0.0);
}

vec4 cubic(float f) { // R. Keys, IEEE ASSP 29(6), 1981, with a = -1/2
    float f2 = f * f, f3 = f2 * f;
    return 0.5 * vec4(-f + 2.0 * f2 - f3, 2.0 - 5.0 * f2 + 3.0 * f3, f + 4.0 * f2 - 3.0 * f3, f3 - f2);
}

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
    return clamp(sum, min(min(a, b), min(c, d)), max(max(a, b), max(c, d)));
}

// The bands, in whole numbers of waves: they meet where the torus closes.
vec3 bands(vec2 uv) {
    float t = 6.2831853 * (4.0 * uv.y + 0.12 * sin(6.2831853 * uv.x) + 0.05 * sin(6.2831853 * (3.0 * uv.x + uv.y)));
    return smoothstep(-0.25, 0.85, vec3(sin(t), sin(0.5 * t + 0.7), sin(2.0 * t + 2.0)));
}

vec2 velocityAt(vec2 uv) {
    return textureLod(iChannel0, uv, 0.0).xy;
}

void mainImage(out vec4 paint, in vec2 fragCoord) {
    vec2 size = iResolution.xy, uv = fragCoord / size;
    float seconds = speed * iTimeDelta;
    vec2 heights = vec2(size.y / size.x, 1.0);
    vec3 home = bands(uv);
    if (iFrame == 0 || texelFetch(iChannel1, ivec2(fragCoord), 0) == vec4(0.0)) {
        paint = vec4(home, 1e-6);
        return;
    }
    vec2 middle = uv - 0.5 * seconds * velocityAt(uv) * heights;
    vec2 from = uv - seconds * velocityAt(middle) * heights;
    paint = paintAt(from * size - 0.5);
    paint.xyz = mix(home, paint.xyz, exp(-seconds / repaint_seconds));
    paint.w = mix(length(velocityAt(uv)), paint.w, exp(-4.0 * iTimeDelta)) + 1e-6;
    if (!isFinite(paint)) paint = vec4(home, 1e-6);
}
