//ok 5.1 everything that can be indexed
float f(vec4 v, mat4 m, int i) { vec4 a[2]; return v[i] + m[i][i] + a[i][i] + v[3u] + m[3][3]; }
//error 5.1 a float indexed | cannot be indexed
float f(float x) { return x[0]; }
//error 5.1 vector index out of range | 3 components, 0 to 2
float f(vec3 v) { return v[3]; }
//error 5.1 matrix index out of range | 2 columns, 0 to 1
vec3 f(mat2x3 m) { return m[2]; }
//error 5.2 assignment between types | cannot assign `int` to a `float`
void f(float x, int i) { x = i; }
//ok 5.4.1 conversions
int a = int(1.5); uint b = uint(-1); float c = float(3); bool d = bool(2.0); float e = float(true); int g = int(true); uint h = uint(1.5);
//ok 5.4.1 scalars from vectors and matrices
float f(vec3 v, mat3 m, ivec2 i) { return float(v) + float(m) + float(i) + float(int(v)) + float(bool(i)); }
//error 5.4.1 scalar from two | too many arguments
float f() { return float(1.0, 2.0); }
//error 5.4.1 scalar from nothing | needs at least one argument
float f() { return float(); }
//error 5.4.1 scalar from an array | cannot be built from
float f(float a[2]) { return float(a); }
//error 5.4.1 scalar from a struct | cannot be built from
struct S { float a; }; float f(S s) { return float(s); }
//error 5.4.1 scalar from void | returns nothing
void g() { } float f() { return float(g()); }
//error 5.4.1 scalar from a sampler | cannot be built from
float f() { return float(iChannel0); }
//ok 5.4.2 vectors
vec4 f(vec2 a, vec3 b, float c, int i, bool t) { return vec4(1) + vec4(a, a) + vec4(b, c) + vec4(c, b) + vec4(i, t, c, 1u) + vec4(vec2(b), ivec2(b)); }
//ok 5.4.2 shortened vectors
vec2 f(vec4 a, mat2 m) { return vec2(a) + vec2(m) + vec2(m[0]) + vec2(a.x, a); }
//ok 5.4.2 int vectors from floats and matrices
ivec4 f(vec4 v, mat2 m) { return ivec4(v) + ivec4(m) + ivec4(1, m) + ivec4(bvec4(m)); }
//error 5.4.2 too few | needs 3 components, the arguments have 2
vec3 f(vec2 a) { return vec3(a); }
//error 5.4.2 too few of several | needs 4 components, the arguments have 3
vec4 f(vec2 a) { return vec4(a, 1); }
//error 5.4.2 too many | too many arguments
vec2 f(vec2 a) { return vec2(a, 1.0); }
//error 5.4.2 too many scalars | too many arguments
vec3 f() { return vec3(1, 2, 3, 4); }
//ok 5.4.2 matrices
mat3 f(vec3 v, float x, mat4 m, mat2x4 n) { return mat3(x) + mat3(v, v, v) + mat3(1, 2, 3, 4, 5, 6, 7, 8, 9) + mat3(m) + mat3(n) + mat3(v.xy, v, v, x); }
//ok 5.4.2 matrix from one vector
mat2 f(vec4 v) { return mat2(v) + mat2(v.xyz, v); }
//error 5.4.2 matrix from too few | needs 9 components, the arguments have 6
mat3 f(vec3 v) { return mat3(v, v); }
//error 5.4.2 matrix from too many | too many arguments
mat2 f() { return mat2(1, 2, 3, 4, 5); }
//error 5.4.2 matrix and more | must be the only argument
mat3 f(mat2 m) { return mat3(m, 1, 1, 1, 1, 1); }
//error 5.4.2 matrix from a vector that is too short | needs 9 components
mat3 f(vec3 v) { return mat3(v); }
//ok 5.4.3 struct constructor
struct S { vec3 p; float r; }; S f() { return S(vec3(0), 1.0); }
//error 5.4.3 wrong member type | the member `r` of `S` is a `float`, not `int`
struct S { vec3 p; float r; }; S f() { return S(vec3(0), 1); }
//error 5.4.3 wrong number of members | needs 2 arguments, one per member; 1 is given
struct S { vec3 p; float r; }; S f() { return S(vec3(0)); }
//ok 5.4.4 array constructors
float[3] a = float[3](1.0, 2.0, 3.0); struct S { int x; }; S b[] = S[](S(1), S(2)); vec2 c = vec2[](vec2(1), vec2(2))[1];
//error 5.4.4 wrong number of elements | needs 3 arguments, 2 are given
float a[3] = float[3](1.0, 2.0);
//error 5.4.4 wrong element type | an element of `float[]` cannot be `int`
float a[2] = float[](1, 2);
//error 5.4.4 no elements | needs an argument for each element
float a[2] = float[]();
//ok 5.5 swizzles
vec4 f(vec4 v) { v.xy = v.zw; v.rgb = v.bgr; v.stpq = v.qpts; v.x = v.yyyy.x; return v.xxyy; }
//error 5.5 sets mixed | mixes the component names
vec2 f(vec4 v) { return v.xg; }
//error 5.5 component missing | has no component `.z`
float f(vec2 v) { return v.z; }
//error 5.5 unknown component | has no component `.m`
float f(vec2 v) { return v.m; }
//error 5.5 five components | more than four components
vec4 f(vec4 v) { return v.xyzwx; }
//error 5.5 component of a scalar | has no `.x`
float f(float x) { return x.x; }
//error 5.5 swizzle assigned twice | has a component twice
void f(vec4 v) { v.xx = vec2(1); }
//error 5.5 swizzle with repetition as out argument | has a component twice
void g(out vec2 v) { v = vec2(1); } void f(vec4 v) { g(v.xx); }
//ok 5.5 swizzle as out argument
void g(out vec2 v) { v = vec2(1); } void f(vec4 v) { g(v.zx); }
//error 5.5 components of a matrix | a matrix is indexed
float f(mat2 m) { return m.x; }
//ok 5.8 assignments
void f(int i, uint u, float x, vec3 v, mat3 m) { i += 1; i -= 1; i *= 2; i /= 2; i %= 3; i <<= 1; i >>= 1u; i &= 1; i |= 2; i ^= 3; u <<= 1; x *= 2.0; v *= 2.0; v *= m; v += v; m *= m; m *= 2.0; m += m; v = v * 2.0; }
//error 5.8 compound that changes the type | cannot be stored in a `float`
void f(float x, vec3 v) { x *= v; }
//error 5.8 matrix product that changes the type | cannot be stored in a `vec2`
void f(vec2 v, mat3x2 m) { v *= m; }
//error 5.8 literal assigned | a constant cannot be assigned
void f() { 1 = 2; }
//error 5.8 call assigned | the result of a call cannot be assigned
float g() { return 1.0; } void f() { g() = 2.0; }
//error 5.8 expression assigned | the result of an expression cannot be assigned
void f(float x) { x + 1.0 = 2.0; }
//error 5.8 constructor assigned | a copy made by a constructor
void f(vec3 v) { vec3(v) = vec3(1); }
//error 5.8 ternary assigned | the result of an expression cannot be assigned
void f(bool b, float x, float y) { (b ? x : y) = 1.0; }
//error 5.8 swizzle of a uniform assigned | is a uniform and cannot be assigned
void f() { iMouse.xy = vec2(0); }
//error 5.8 assignment as a place | cannot be assigned
void f(float x) { (x = 1.0) = 2.0; }
//ok 5.8 assignment as a value
void f(float x, float y) { x = y = 1.0; if ((x = 2.0) > y) { } }
//error 5.8 gl_FragCoord assigned | is an input and cannot
void f() { gl_FragCoord.x = 1.0; }
//ok 5.9 arithmetic
void f(int i, uint u, float x, vec3 v, ivec3 w, mat3 m, mat3x2 n) { i = i + i * i / i - i % i; u = u % 2u; v = v + x; v = x - v; v = v * v; v = v / x; w = w * i; w = i % w; m = m * x; m = m + m; m = m / m; v = m * v; v = v * m; m = m * m; vec2 q = n * v; v = q * n; mat3x2 r = n * m; m = x + m; m = -m; }
//error 5.9 int times float | write `2.0`
float f(float x) { return x * 2; }
//error 5.9 float plus int variable | write `float(i)`
float f(float x, int i) { return x + i; }
//error 5.9 vectors of two sizes | `+` cannot combine `vec2` and `vec3`
void f(vec2 a, vec3 b) { a + b; }
//error 5.9 float vector times int | `*` cannot combine `vec2` and `int`
vec2 f(vec2 a) { return a * 2; }
//error 5.9 int and uint | `+` cannot combine `int` and `uint`
void f(int a, uint b) { a + b; }
//error 5.9 bools added | cannot combine
void f(bool a) { a + a; }
//error 5.9 modulus of floats | write `mod(a, b)`
float f(float x) { return x % 2.0; }
//error 5.9 matrix times wrong vector | cannot combine
vec3 f(mat3 m, vec2 v) { return m * v; }
//error 5.9 matrices that do not fit | cannot combine
void f(mat2x3 a, mat2x3 b) { a * b; }
//error 5.9 matrices of two shapes added | cannot combine
void f(mat2x3 a, mat3x2 b) { a + b; }
//error 5.9 arrays added | cannot combine
void f(float a[2]) { a + a; }
//error 5.9 structs added | cannot combine
struct S { float a; }; void f(S a) { a + a; }
//ok 5.9 increments
void f(int i, uint u, float x, vec3 v, mat2 m) { i++; ++i; u--; x++; --v; m++; v.x++; }
//error 5.9 increment of a bool | cannot be applied to a `bool`
void f(bool b) { b++; }
//error 5.9 increment of a literal | cannot be changed
void f() { 1++; }
//error 5.9 increment twice | cannot be changed
void f(int i) { (i++)++; }
//error 5.9 minus of a bool | cannot be applied to a `bool`
void f(bool b) { -b; }
//error 5.9 minus of an array | cannot be applied
void f(float a[2]) { -a; }
//ok 5.9 comparisons
void f(int i, uint u, float x, vec3 v, mat2 m, float a[2], bool b, bvec2 c) { b = i < i; b = u >= u; b = x > x; b = v == v; b = m != m; b = a == a; b = b == b; b = c == c; }
//error 5.9 vectors ordered | `lessThan(a, b)`
bool f(vec3 v) { return v < v; }
//error 5.9 bools ordered | cannot combine
bool f(bool b) { return b < b; }
//error 5.9 int compared with float | write `1.0`
bool f(float x) { return x < 1; }
//error 5.9 float equal to int | `==` cannot combine
bool f(float x, int i) { return x == i; }
//error 5.9 vectors of two sizes compared | cannot combine
bool f(vec2 a, vec3 b) { return a == b; }
//ok 5.9 structs with arrays compared
struct S { float a[2]; }; bool f(S a, S b) { return a == b || a != b; }
//error 5.9 structs with samplers compared | takes no samplers
struct S { sampler2D s; float a; }; uniform S a; uniform S b; bool f() { return a == b; }
//ok 5.9 logic
bool f(bool a, bool b) { return a && b || !a ^^ b; }
//error 5.9 logic on ints | each side of `&&` must be a `bool`
bool f(bool a, int b) { return a && b; }
//error 5.9 logic on vectors | each side of `||` must be a `bool`
bool f(bvec2 a) { return a || a; }
//error 5.9 not on an int | compare it
bool f(int a) { return !a; }
//error 5.9 not on a vector | write `not(..)`
bvec2 f(bvec2 a) { return !a; }
//ok 5.9 ternary
vec3 f(bool b, vec3 v) { return b ? v : v.zyx; }
//error 5.9 ternary of two types | must have the same type
float f(bool b) { return b ? 1.0 : 2; }
//error 5.9 ternary on an int | must be a `bool`
float f(int i) { return i ? 1.0 : 2.0; }
//error 5.9 ternary on a vector | must be a `bool`
float f(bvec2 i) { return i ? 1.0 : 2.0; }
//error 5.9 ternary of arrays | cannot choose
void f(bool b, float x[2]) { float y[2] = b ? x : x; }
//error 5.9 ternary of void | cannot choose
void g() { } void f(bool b) { b ? g() : g(); }
//error 5.9 ternary of samplers | cannot choose
vec4 f(bool b) { return texture(b ? iChannel0 : iChannel1, vec2(0)); }
//ok 5.9 comma
float f(float x) { return x += 1.0, x * 2.0; }
//error 5.9 comma with void | comma operator
void g() { } void f() { g(), g(); }
//error 5.9 comma with arrays | comma operator
void f(float a[2]) { float b[2] = (a, a); }
//error 5.9 comma as a place | cannot be assigned
void f(float a, float b) { (a, b) = 1.0; }
//ok 5.9 bits
void f(int i, uint u, ivec2 v, uvec2 w) { i = i & 1 | i ^ ~i; u = ~u << 3 >> 1u; v = v & 3; v = 3 | v; w = w ^ w; v = v << w; v = v << 2u; i = i << u; w >>= v; }
//error 5.9 bits of floats | bits are for ints
void f(float x) { x & 1.0; }
//error 5.9 power by caret | write `pow(a, b)`
float f(float x) { return x ^ 2.0; }
//error 5.9 bits of int and uint | cannot combine
void f(int i, uint u) { i & u; }
//error 5.9 not bits of a float | cannot be applied to a `float`
void f(float x) { ~x; }
//error 5.9 single ampersand on bools | write `&&`
bool f(bool a, bool b) { return a & b; }
//error 5.9 scalar shifted by a vector | cannot combine
void f(int i, ivec2 v) { i << v; }
//error 5.9 vectors of two sizes shifted | cannot combine
void f(ivec3 i, ivec2 v) { i << v; }
//error 5.9 void operand | returns nothing
void g() { } float f() { return 1.0 + g(); }
