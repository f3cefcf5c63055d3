// The functions and constants of twigl's mode geekest (https://github.com/doxas/twigl). The noise is that of I. McEwan,
// D. Sheets, M. Richardson and S. Gustavson, "Efficient computational noise in GLSL", Journal of Graphics Tools 16(2),
// 2012: simplex noise whose gradients are chosen by a permutation polynomial.
#define FC gl_FragCoord
#define F4 ((sqrt(5.0) - 1.0) / 4.0)
const float PI = 3.141592653589793;
const float PI2 = 2.0 * PI;

float mod289(float x) { return mod(x, 289.0); }
vec2 mod289(vec2 x) { return mod(x, 289.0); }
vec3 mod289(vec3 x) { return mod(x, 289.0); }
vec4 mod289(vec4 x) { return mod(x, 289.0); }
float permute(float x) { return mod289((34.0 * x + 1.0) * x); }
vec3 permute(vec3 x) { return mod289((34.0 * x + 1.0) * x); }
vec4 permute(vec4 x) { return mod289((34.0 * x + 1.0) * x); }
float taylorInvSqrt(float r) { return 1.79284291400159 - 0.85373472095314 * r; }
vec4 taylorInvSqrt(vec4 r) { return 1.79284291400159 - 0.85373472095314 * r; }

float snoise2D(vec2 v) {
    const float skew = (sqrt(3.0) - 1.0) / 2.0, back = (3.0 - sqrt(3.0)) / 6.0;
    vec2 cell = floor(v + skew * (v.x + v.y));
    vec2 first = v - cell + back * (cell.x + cell.y);
    vec2 middle = first.x > first.y ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    cell = mod289(cell);
    float sum = 0.0;
    for (int corner = 0; corner < 3; corner++) {
        vec2 at = corner == 0 ? vec2(0.0) : corner == 1 ? middle : vec2(1.0);
        vec2 d = first - at + back * float(corner);
        float x = 2.0 * fract(permute(permute(cell.y + at.y) + cell.x + at.x) / 41.0) - 1.0;
        vec2 gradient = vec2(x - floor(x + 0.5), abs(x) - 0.5);
        float falloff = max(0.5 - dot(d, d), 0.0);
        falloff *= falloff;
        sum += falloff * falloff * taylorInvSqrt(dot(gradient, gradient)) * dot(gradient, d);
    }
    return 130.0 * sum;
}

float snoise3D(vec3 v) {
    vec3 cell = floor(v + (v.x + v.y + v.z) / 3.0);
    vec3 first = v - cell + (cell.x + cell.y + cell.z) / 6.0;
    // The number of coordinates that each one exceeds.
    vec3 over = step(first.yzx, first), under = 1.0 - over;
    vec3 rank = over + under.zxy;
    cell = mod289(cell);
    float sum = 0.0;
    for (int corner = 0; corner < 4; corner++) {
        vec3 at = step(2.5 - float(corner), rank);
        vec3 d = first - at + float(corner) / 6.0;
        float hash = permute(permute(permute(cell.z + at.z) + cell.y + at.y) + cell.x + at.x);
        float j = hash - 49.0 * floor(hash / 49.0);
        vec2 xy = vec2(floor(j / 7.0), floor(j - 7.0 * floor(j / 7.0))) * 2.0 / 7.0 + 0.5 / 7.0 - 1.0;
        float z = 1.0 - abs(xy.x) - abs(xy.y);
        vec3 gradient = vec3(xy - (2.0 * floor(xy) + 1.0) * step(z, 0.0), z);
        float falloff = max(0.6 - dot(d, d), 0.0);
        falloff *= falloff;
        sum += falloff * falloff * taylorInvSqrt(dot(gradient, gradient)) * dot(gradient, d);
    }
    return 42.0 * sum;
}

vec4 grad4(float j, vec4 ip) {
    vec3 p = floor(fract(vec3(j) * ip.xyz) * 7.0) * ip.z - 1.0;
    float w = 1.5 - dot(abs(p), vec3(1.0));
    vec4 negative = vec4(lessThan(vec4(p, w), vec4(0.0)));
    return vec4(p + (2.0 * negative.xyz - 1.0) * negative.w, w);
}

float snoise4D(vec4 v) {
    const float back = (5.0 - sqrt(5.0)) / 20.0;
    vec4 cell = floor(v + F4 * dot(v, vec4(1.0)));
    vec4 first = v - cell + back * dot(cell, vec4(1.0));
    vec3 x = step(first.yzw, first.xxx), yz = step(first.zww, first.yyz);
    // The number of coordinates that each one exceeds.
    vec4 rank = vec4(
        x.x + x.y + x.z,
        1.0 - x.x + yz.x + yz.y,
        1.0 - x.y + 1.0 - yz.x + yz.z,
        3.0 - x.z - yz.y - yz.z
    );
    cell = mod289(cell);
    float sum = 0.0;
    for (int corner = 0; corner < 5; corner++) {
        vec4 at = step(3.5 - float(corner), rank);
        vec4 d = first - at + back * float(corner);
        float hash = permute(permute(permute(permute(cell.w + at.w) + cell.z + at.z) + cell.y + at.y) + cell.x + at.x);
        vec4 gradient = grad4(hash, vec4(1.0 / 294.0, 1.0 / 49.0, 1.0 / 7.0, 0.0));
        float falloff = max(0.6 - dot(d, d), 0.0);
        falloff *= falloff;
        sum += falloff * falloff * taylorInvSqrt(dot(gradient, gradient)) * dot(gradient, d);
    }
    return 49.0 * sum;
}

float fsnoise(vec2 c) { return fract(sin(dot(c, vec2(12.9898, 78.233))) * 43758.5453); }
float fsnoiseDigits(vec2 c) { return fract(sin(dot(c, vec2(0.129898, 0.78233))) * 437.585453); }

vec3 hsv(float h, float s, float v) {
    vec3 hue = clamp(abs(fract(h + vec3(1.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return v * mix(vec3(1.0), hue, s);
}

mat2 rotate2D(float angle) {
    float c = cos(angle), s = sin(angle);
    return mat2(c, s, -s, c);
}

mat3 rotate3D(float angle, vec3 axis) {
    vec3 a = normalize(axis);
    mat3 cross_ = mat3(0.0, a.z, -a.y, -a.z, 0.0, a.x, a.y, -a.x, 0.0);
    return cos(angle) * mat3(1.0) + sin(angle) * cross_ + (1.0 - cos(angle)) * outerProduct(a, a);
}
