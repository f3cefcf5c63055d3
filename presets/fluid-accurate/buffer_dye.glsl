// Three dyes, one a jet, in rgb; what was poured of them in this frame, in a. Channel 0 is the velocity, channel 1 this
// buffer in the last frame, channel 2 the mouse, channel 3 how much dye there should be, and the step.
#include "staggered.glsl"

const float STRONGEST = 1.3; // of what is poured

vec3 dyeOf(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    p = walls == PERIODIC ? p - size * ivec2(floor(vec2(p) / vec2(size))) : clamp(p, ivec2(0), size - 1);
    vec4 q = texelFetch(iChannel1, p, 0);
    return isFinite(q) ? q.rgb : vec3(0.0);
}

// R. Keys, "Cubic Convolution Interpolation for Digital Image Processing", IEEE ASSP 29(6), 1981, with a = -1/2.
vec4 keys(float f) {
    float f2 = f * f, f3 = f2 * f;
    return 0.5 * vec4(-f + 2.0 * f2 - f3, 2.0 - 5.0 * f2 + 3.0 * f3, f + 4.0 * f2 - 3.0 * f3, f3 - f2);
}

// The 4 x 4 without its corners, the sum of the weights made 1; cut to the range of the four nearest.
vec3 dyeAt(vec2 at) {
    ivec2 i = ivec2(floor(at));
    vec4 wx = keys(at.x - float(i.x)), wy = keys(at.y - float(i.y));
    vec3 a = dyeOf(i), b = dyeOf(i + ivec2(1, 0)), c = dyeOf(i + ivec2(0, 1)), d = dyeOf(i + 1);
    vec3 sum = wy.y * (wx.x * dyeOf(i + ivec2(-1, 0)) + wx.y * a + wx.z * b + wx.w * dyeOf(i + ivec2(2, 0)))
             + wy.z * (wx.x * dyeOf(i + ivec2(-1, 1)) + wx.y * c + wx.z * d + wx.w * dyeOf(i + ivec2(2, 1)))
             + wy.x * (wx.y * dyeOf(i + ivec2(0, -1)) + wx.z * dyeOf(i + ivec2(1, -1)))
             + wy.w * (wx.y * dyeOf(i + ivec2(0, 2)) + wx.z * dyeOf(i + ivec2(1, 2)));
    sum /= 1.0 - (wx.x + wx.w) * (wy.x + wy.w);
    return clamp(sum, min(min(a, b), min(c, d)), max(max(a, b), max(c, d)));
}

void mainImage(out vec4 dye, in vec2 fragCoord) {
    vec2 canvas = iResolution.xy, toGrid = vec2(textureSize(iChannel0, 0)) / canvas;
    vec4 ledger = texelFetch(iChannel3, ivec2(0), 0);
    if (!isFinite(ledger)) ledger = vec4(0.0, 1.0, 1.0, speed * iTimeDelta);
    vec2 from = quickPath(iChannel0, fragCoord * toGrid, ledger.w * iChannelResolution[0].y);
    vec3 carried = min(dyeAt(from / toGrid - 0.5) * ledger.y, STRONGEST) * ledger.z, now = carried;

    vec2 at = (fragCoord - 0.5 * canvas) / canvas.y;
    vec4 mouse = texelFetch(iChannel2, ivec2(0), 0);
    if (mouse.z > 0.0) {
        vec3 colour = max(vec3(sin(iTime), sin(iTime + 2.0943951), sin(iTime + 4.1887902)), 0.0);
        now = mix(now, STRONGEST * colour, share(0.4 * brush(at, mouse, canvas), iTimeDelta));
    } else {
        for (int i = 0; i < JETS; i++) {
            float w = jets * jetWeight(at, jet(i, iTime, canvas.x / canvas.y));
            vec3 colour = vec3(i == 0, i == 1, i == 2);
            now = mix(now, STRONGEST * colour, share(0.4 * w, ledger.w));
        }
    }
    vec3 poured = now - carried;
    dye = vec4(now, poured.r + poured.g + poured.b);
}
