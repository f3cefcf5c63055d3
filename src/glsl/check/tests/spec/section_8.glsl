//ok 8.1 angles
vec3 f(vec3 v) { return sin(v) + radians(v) + degrees(cos(v)) + tan(asin(acos(atan(v, v)))) + atan(v) + sinh(cosh(tanh(asinh(acosh(atanh(v)))))); }
//error 8.1 atan2 | write `atan(y, x)`
float f(float x) { return atan2(x, x); }
//error 8.1 sin of an int | argument 1 of `sin` must be a `float`
float f() { return sin(1); }
//error 8.1 sin of two | takes 1 argument, 2 are given
float f() { return sin(1.0, 2.0); }
//ok 8.2 exponentials
vec2 f(vec2 v) { return pow(v, v) + exp(log(exp2(log2(sqrt(inversesqrt(v)))))); }
//error 8.2 pow with an int | argument 2 of `pow` must be a `float`
float f(float x) { return pow(x, 2); }
//error 8.2 pow of vector and scalar | argument 2 of `pow` must be a `vec3`
vec3 f(vec3 x) { return pow(x, 2.0); }
//ok 8.3 common
vec2 f(vec2 v, float x, ivec2 i, uvec2 u, bvec2 b) { i = abs(sign(i)); i = min(i, 1) + max(i, i) + clamp(i, 0, 1) + clamp(i, i, i); u = min(u, 1u) + max(u, u) + clamp(u, 0u, u.x); return floor(v) + trunc(v) + round(v) + roundEven(v) + ceil(v) + fract(v) + mod(v, v) + mod(v, x) + min(v, x) + max(v, v) + clamp(v, x, x) + clamp(v, v, v) + mix(v, v, x) + mix(v, v, v) + mix(v, v, b) + step(v, v) + step(x, v) + smoothstep(x, x, v) + smoothstep(v, v, v) + vec2(isnan(v)) + vec2(isinf(v)) + intBitsToFloat(floatBitsToInt(v)) + uintBitsToFloat(floatBitsToUint(v)); }
//ok 8.3 modf
float f(float x) { float whole; return modf(x, whole) + whole; }
//error 8.3 modf into an expression | cannot be passed as `out`
float f(float x) { return modf(x, 1.0); }
//error 8.3 max of vector and vector of another size | no overload of `max` takes (vec3, vec2)
vec3 f(vec3 a, vec2 b) { return max(a, b); }
//error 8.3 max with scalar first | argument 1 of `max` must be a `vec3`
vec3 f(vec3 a) { return max(1.0, a); }
//error 8.3 clamp with ints | argument 2 of `clamp` must be a `float`
float f(float x) { return clamp(x, 0, 1); }
//error 8.3 mix with an int | argument 3 of `mix` must be a `float`
vec3 f(vec3 a) { return mix(a, a, 1); }
//error 8.3 mix of ints by bools | argument 1 of `mix` must be a `float`
int f(bool b) { return mix(1, 2, b); }
//error 8.3 abs of uint | candidate: `int abs(int)`
uint f(uint u) { return abs(u); }
//error 8.3 saturate | write `clamp(x, 0.0, 1.0)`
float f(float x) { return saturate(x); }
//error 8.3 lerp | write `mix(a, b, t)`
float f(float x) { return lerp(x, x, x); }
//error 8.3 smoothStep | did you mean `smoothstep`?
float f(float x) { return smoothStep(0.0, 1.0, x); }
//ok 8.4 packing
uint f(vec2 v) { return packSnorm2x16(v) + packUnorm2x16(unpackUnorm2x16(packHalf2x16(unpackHalf2x16(packSnorm2x16(unpackSnorm2x16(1u)))))); }
//ok 8.5 geometry
float f(vec3 v, float x) { return length(v) + length(x) + distance(v, v) + distance(x, x) + dot(v, v) + dot(x, x) + cross(v, v).x + normalize(v).x + normalize(x) + faceforward(v, v, v).x + reflect(v, v).x + refract(v, v, x).x + reflect(x, x) + refract(x, x, x); }
//error 8.5 cross of two components | no overload of `cross`
void f(vec2 v) { cross(v, v); }
//error 8.5 dot of two sizes | no overload of `dot`
float f(vec2 a, vec3 b) { return dot(a, b); }
//ok 8.6 matrices
mat3 f(mat3 m, mat2x3 n, vec3 v, vec2 w) { mat3x2 t = transpose(n); float d = determinant(m); mat2x3 o = outerProduct(v, w); mat3x2 p = outerProduct(w, v); return matrixCompMult(m, m) + inverse(m) + transpose(m); }
//error 8.6 determinant of a matrix that is not square | no overload of `determinant`
float f(mat2x3 m) { return determinant(m); }
//error 8.6 inverse of a matrix that is not square | no overload of `inverse`
void f(mat4x2 m) { inverse(m); }
//error 8.6 product of two shapes | no overload of `matrixCompMult`
void f(mat2x3 a, mat3x2 b) { matrixCompMult(a, b); }
//ok 8.7 vector relations
bool f(vec2 a, ivec2 b, uvec2 c, bvec2 d) { d = lessThan(a, a); d = lessThanEqual(b, b); d = greaterThan(c, c); d = greaterThanEqual(a, a); d = equal(d, d); d = notEqual(d, d); d = equal(a, a); d = not(d); return any(d) || all(d); }
//error 8.7 lessThan of scalars | no overload of `lessThan`
void f(float x) { lessThan(x, x); }
//error 8.7 any of a bool | no overload of `any`
bool f(bool b) { return any(b); }
//error 8.7 lessThan of bools | no overload of `lessThan`
void f(bvec2 b) { lessThan(b, b); }
//ok 8.8 textures of two dimensions
vec4 f(vec2 p, vec3 q, vec4 r) { return texture(iChannel0, p) + texture(iChannel0, p, 1.0) + textureLod(iChannel0, p, 1.0) + texelFetch(iChannel0, ivec2(p), 0) + vec4(textureSize(iChannel0, 0), 0, 0) + textureGrad(iChannel0, p, p, p) + textureProj(iChannel0, q) + textureProj(iChannel0, r, 1.0) + textureOffset(iChannel0, p, ivec2(1, -8)) + textureOffset(iChannel0, p, ivec2(7), 1.0) + texelFetchOffset(iChannel0, ivec2(p), 0, ivec2(1)) + textureProjOffset(iChannel0, q, ivec2(1)) + textureLodOffset(iChannel0, p, 1.0, ivec2(1)) + textureProjLod(iChannel0, q, 1.0) + textureProjLod(iChannel0, r, 1.0) + textureProjLodOffset(iChannel0, r, 1.0, ivec2(1)) + textureGradOffset(iChannel0, p, p, p, ivec2(1)) + textureProjGrad(iChannel0, q, p, p) + textureProjGradOffset(iChannel0, r, p, p, ivec2(1)); }
//ok 8.8 other samplers
vec4 f(samplerCube c, sampler3D v, highp sampler2DArray a, highp isampler2D i, highp usampler3D u, highp sampler2DShadow s, highp samplerCubeShadow d, highp sampler2DArrayShadow e, vec3 p, vec4 q) { ivec4 w = texture(i, p.xy); uvec4 x = texelFetch(u, ivec3(p), 0); return texture(c, p, 1.0) + textureLod(c, p, 0.0) + texture(v, p) + texelFetch(v, ivec3(p), 0) + textureOffset(v, p, ivec3(1)) + textureProj(v, q) + texture(a, p) + textureOffset(a, p, ivec2(1)) + vec4(texture(s, p) + texture(d, q) + texture(e, q) + textureGrad(e, q, p.xy, p.xy) + textureProj(s, q)) + vec4(textureSize(v, 0), 0) + vec4(textureSize(c, 0), textureSize(s, 0)) + textureGrad(c, p, p, p); }
//error 8.8 texture2D | write `texture(..)`
vec4 f() { return texture2D(iChannel0, vec2(0)); }
//error 8.8 texture with three coordinates | no overload of `texture` takes (sampler2D, vec3)
vec4 f(vec3 p) { return texture(iChannel0, p); }
//error 8.8 texelFetch without a level | takes 3 arguments, 2 are given
vec4 f() { return texelFetch(iChannel0, ivec2(0)); }
//error 8.8 texelFetch with floats | write `ivec2(p)`
vec4 f(vec2 p) { return texelFetch(iChannel0, p, 0); }
//error 8.8 texelFetch of a cube | no overload of `texelFetch`
vec4 f(samplerCube c) { return texelFetch(c, ivec3(0), 0); }
//error 8.8 texture with an int bias | argument 3 of `texture` must be a `float`
vec4 f() { return texture(iChannel0, vec2(0), 1); }
//error 8.8 offset that varies | must be a constant expression
vec4 f(ivec2 o) { return textureOffset(iChannel0, vec2(0), o); }
//error 8.8 offset out of range | the offset 8 is out of range
vec4 f() { return textureOffset(iChannel0, vec2(0), ivec2(8, 0)); }
//error 8.8 offset out of range below | the offset -9 is out of range
vec4 f() { return texelFetchOffset(iChannel0, ivec2(0), 0, ivec2(0, -9)); }
//error 8.8 texture of a float | no overload of `texture`
vec4 f() { return texture(1.0, vec2(0)); }
//error 8.8 textureSize without a level | takes 2 arguments, 1 is given
ivec2 f() { return textureSize(iChannel0); }
//error 8.8 textureGather | is not in GLSL ES 3.00
vec4 f() { return textureGather(iChannel0, vec2(0)); }
//error 8.8 cube offset | no overload of `textureOffset`
vec4 f(samplerCube c) { return textureOffset(c, vec3(0), ivec2(1)); }
//ok 8.9 derivatives
vec2 f(vec2 p) { return dFdx(p) + dFdy(p) + fwidth(p) + fwidth(p.x); }
//error 8.9 derivative of an int | argument 1 of `dFdx` must be a `float`
void f(int i) { dFdx(i); }
