// Small programs, each file of one after a line `//= NAME`: numbers, vectors and matrices. See docs/drivers.md.
// None depends on what the language leaves open, or on the last bits of a float.

//= integer_arithmetic.glsl
void mainImage(out vec4 o, in vec2 p) {
    ivec2 n = ivec2(p) - ivec2(32, 18);
    int q = n.x * n.y + n.x;
    o = vec4(float(q & 255) / 255.0, float(abs(q) % 17) / 17.0, float(sign(n.x) + 1) / 2.0, 1.0);
}

//= unsigned_wrap.glsl
void mainImage(out vec4 o, in vec2 p) {
    uvec2 n = uvec2(p);
    uint a = (n.x - 40u) >> 24u, b = n.y * 0x01000193u ^ 0x811c9dc5u;
    o = vec4(float(a) / 255.0, float(b & 0xffu) / 255.0, float((b >> 8) & 0xffu) / 255.0, 1.0);
}

//= shifts.glsl
void mainImage(out vec4 o, in vec2 p) {
    int s = int(p.x) % 31;
    int a = -1000000 >> s;
    uint b = 0xf0f0f0f0u >> uint(s);
    int c = 1 << s;
    o = vec4(float(a & 255), float(b & 255u), float((c >> 3) & 255), 255.0) / 255.0;
}

//= bit_patterns.glsl
void mainImage(out vec4 o, in vec2 p) {
    int bits = floatBitsToInt(p.x);
    float back = intBitsToFloat(bits + (1 << 22));
    o = vec4(float((bits >> 23) - 126) / 8.0, back / 128.0, uintBitsToFloat(0x3f000000u), 1.0);
}

//= pcg_hash.glsl
uvec3 hash(uvec3 v) {
    // pcg3d: M. Jarzynski, M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020.
    v = v * 1664525u + 1013904223u;
    v += v.yzx * v.zxy;
    v ^= v >> 16u;
    return v + v.yzx * v.zxy;
}
void mainImage(out vec4 o, in vec2 p) { o = vec4(vec3(hash(uvec3(uvec2(p), iFrame)) >> 8u) / 16777216.0, 1.0); }

//= integer_vectors.glsl
void mainImage(out vec4 o, in vec2 p) {
    ivec3 a = ivec3(p, 7), b = ivec3(5, 11, int(p.x));
    ivec3 m = max(min(a, b), ivec3(3)), c = clamp(a - b, -20, 20);
    o = vec4(vec3(m + (c & 7)) / 24.0, 1.0);
}

//= conversions.glsl
void mainImage(out vec4 o, in vec2 p) {
    float x = p.x * 3.25 - 100.125;
    o = vec4(float(int(x) & 255) / 255.0, float(bool(int(p.y) & 1)), float(uint(abs(x))) / 110.0, 1.0);
}

//= booleans.glsl
void mainImage(out vec4 o, in vec2 p) {
    bvec3 b = lessThan(vec3(p, 20.0), vec3(30.2, 10.2, p.x)), n = not(b);
    o = vec4(any(b) ? 1.0 : 0.0, all(n) ? 1.0 : 0.25, vec2(equal(ivec2(p) % 4, ivec2(1, 2))) * 0.5);
    o.a = 1.0;
}

//= rounding.glsl
void mainImage(out vec4 o, in vec2 p) {
    float x = (p.x - 32.0) * 0.3 + 0.01;
    o = vec4(floor(x) / 20.0 + 0.5, ceil(x) / 20.0 + 0.5, trunc(x) / 20.0 + 0.5, 1.0);
    if (p.y > 12.0) o.rgb = vec3(round(x) / 20.0 + 0.5, fract(x), mod(x, 3.0) / 3.0);
    if (p.y > 24.0) { float whole; o.r = modf(x, whole) * 0.5 + 0.5; o.g = whole / 20.0 + 0.5; o.b = sign(x) * 0.5 + 0.5; }
}

//= trigonometry.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec2 u = p / iResolution.xy * 6.0 - 3.0;
    o = vec4(sin(u.x) * 0.5 + 0.5, cos(u.y) * 0.5 + 0.5, atan(u.y + 0.1, u.x + 0.1) / 6.5 + 0.5, 1.0);
    if (p.y > 18.0) o.rgb = vec3(asin(u.x / 3.1) / 3.2 + 0.5, acos(u.y / 3.1) / 3.2, atan(u.x) / 3.2 + 0.5);
}

//= hyperbolic.glsl
void mainImage(out vec4 o, in vec2 p) {
    float x = p.x / iResolution.x * 4.0 - 2.0, y = p.y / iResolution.y;
    o = vec4(sinh(x) / 8.0 + 0.5, cosh(x) / 4.0, tanh(x) * 0.5 + 0.5, 1.0);
    if (p.y > 18.0) o.rgb = vec3(asinh(x) / 4.0 + 0.5, acosh(1.1 + y) / 2.0, atanh(x * 0.45) / 4.0 + 0.5);
}

//= exponents.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec2 u = p / iResolution.xy;
    o = vec4(pow(u.x, 2.2), exp(-3.0 * u.y), exp2(u.x) - 1.0, 1.0);
    if (p.y > 18.0) o.rgb = vec3(log(1.0 + u.x), log2(1.0 + u.y), inversesqrt(1.0 + 3.0 * u.x));
}

//= interpolation.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec2 u = p / iResolution.xy;
    vec3 c = mix(vec3(1, 0.2, 0), vec3(0, 0.4, 1), smoothstep(0.2, 0.8, u.x));
    c = mix(c, 1.0 - c, vec3(step(0.503, u.y)));
    o = vec4(mix(c, c.zyx, bvec3(u.x > 0.301, false, u.y > 0.701)), 1.0);
}

//= geometry_functions.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec3 n = normalize(vec3(p / iResolution.xy - 0.5, 0.7)), l = normalize(vec3(1, 2, 3));
    vec3 r = reflect(-l, n), t = refract(-l, n, 0.7), c = cross(n, l);
    o = vec4(dot(n, l), r.x * 0.5 + 0.5, t.y * 0.5 + 0.5, 1.0);
    if (p.y > 18.0) o.rgb = abs(c) + 0.1 * faceforward(n, -l, n) + 0.2 * distance(n, l);
}

//= matrix_products.glsl
void mainImage(out vec4 o, in vec2 p) {
    float a = p.x * 0.05;
    mat3 m = mat3(cos(a), sin(a), 0, -sin(a), cos(a), 0, 0.1, 0.2, 1), n = m * transpose(m);
    vec3 v = m * vec3(p / iResolution.xy, 1), w = v * n;
    o = vec4(abs(w) / 3.0, 1.0);
}

//= matrix_inverse.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec2 u = p / iResolution.xy;
    mat4 m = mat4(2, u.x, 0, 0.5, 0, 3, u.y, 0, 1, 0, 2, 0.25, 0, 0, u.x, 4), i = inverse(m), e = m * i;
    o = vec4(determinant(m) / 64.0, i[0][0], e[1][1] * 0.5 + e[2][0], 1.0);
}

//= matrix_columns.glsl
void mainImage(out vec4 o, in vec2 p) {
    mat4x2 m = mat4x2(0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8);
    m[int(p.x) % 4] = p / iResolution.xy;
    m[2][int(p.y) % 2] *= 0.5;
    mat2x4 t = transpose(m);
    mat2 q = m * t, k = outerProduct(vec2(0.5, 1.0), vec2(0.25, 0.75)), h = matrixCompMult(q, k);
    o = vec4(h[0][0] / 2.0, h[0][1] / 2.0, t[1].z, 1.0);
}

//= swizzles.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec4 v = vec4(p / iResolution.xy, 0.3, 0.7);
    v.wx = v.xy;
    v.stp *= vec3(0.5, 1.0, 2.0);
    v.gb = v.bg;
    v[int(p.x) % 3] += 0.1;
    o = vec4(v.xzy, 1.0);
}

//= increments.glsl
void mainImage(out vec4 o, in vec2 p) {
    int i = int(p.x), j = i++ + ++i;
    float f = p.y;
    f -= float(i--) * 0.25;
    i <<= 1; i |= 5; i ^= j; i %= 97;
    o = vec4(float(i) / 97.0, float(j & 63) / 64.0, f / 64.0 + 0.4, 1.0);
}

//= packing.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec2 u = p / iResolution.xy;
    uint a = packUnorm2x16(u), b = packSnorm2x16(u * 2.0 - 1.0), c = packHalf2x16(u);
    o = vec4(unpackUnorm2x16(a).x, unpackSnorm2x16(b).y * 0.5 + 0.5, unpackHalf2x16(c).x, 1.0);
}

//= infinities.glsl
void mainImage(out vec4 o, in vec2 p) {
    float big = uintBitsToFloat(0x7f800000u) * (p.x > 32.0 ? 1.0 : -1.0), none = uintBitsToFloat(0x7fc00000u + uint(p.x));
    o = vec4(isinf(big) ? 0.75 : 0.0, isnan(none) ? 0.5 : 0.0, big > 1e30 ? 1.0 : 0.0, 1.0);
}

//= large_times.glsl
void mainImage(out vec4 o, in vec2 p) {
    float t = iTime + float(iFrame) + iTimeDelta * 60.0;
    o = vec4(fract(t * 0.25 + p.x / 100.0), float(iFrame) / 8.0, iResolution.z * 0.5, 1.0);
}
