//ok 4.1 every basic type
bool a; int b; uint c; float d; vec2 e; bvec3 f; ivec4 g; uvec2 h; mat2 i; mat3x2 j; mat4x4 k;
//error 4.1.1 void variable | cannot be of type `void`
void x;
//error 4.1.1 local void variable | cannot be of type `void`
void f() { void x; }
//error 4.1.3 int to float | write `1.0`
float x = 1;
//error 4.1.3 float to int | cannot initialise the `int` `x` with `float`
int x = 1.0;
//error 4.1.3 uint to int | write `1`
int x = 1u;
//error 4.1.3 int to uint | write `1u`
uint x = 1;
//error 4.1.3 bool from int | write `true`
bool x = 1;
//ok 4.1.3 literals of all kinds
int a = 0x1F; int b = 017; uint c = 0xFFFFFFFFu; float d = .5, e = 1e3, f = 2.f; int g = 0xFFFFFFFF;
//ok 4.1.7 samplers as parameters
vec4 f(sampler2D s, vec2 p) { return texture(s, p); }
vec4 g() { return f(iChannel0, vec2(0)); }
//ok 4.1.7 samplers through two functions
vec4 f(sampler2D s) { return texelFetch(s, ivec2(0), 0); } vec4 g(sampler2D t) { return f(t); } vec4 h() { return g(iChannel1); }
//error 4.1.7 local sampler | cannot be a local variable
void f() { sampler2D s; }
//error 4.1.7 local sampler initialised | cannot be a local variable
void f() { sampler2D s = iChannel0; }
//error 4.1.7 global sampler | must be a uniform or a parameter
sampler2D s;
//error 4.1.7 sampler as out parameter | only be passed `in`
void f(out sampler2D s) { }
//error 4.1.7 sampler returned | cannot return
sampler2D f(sampler2D s) { return s; }
//error 4.1.7 sampler assigned | is a sampler and cannot be assigned
void f(sampler2D s) { s = iChannel0; }
//error 4.1.7 sampler compared | takes no samplers
bool f(sampler2D s) { return s == iChannel0; }
//error 4.1.7 sampler arithmetic | takes no samplers
void f(sampler2D s) { s + s; }
//error 4.1.7 wrong sampler passed | argument 1 of `f` must be a `samplerCube`
void f(samplerCube s) { } void g() { f(iChannel0); }
//error 4.1.7 struct with sampler as a local | cannot be a local variable
struct S { sampler2D s; }; void f() { S x; }
//error 4.1.8 missing member | `S` has no member `c`
struct S { float a, b; }; float f(S s) { return s.c; }
//ok 4.1.8 structs in structs
struct A { vec3 p; float r[2]; }; struct B { A a; int n; }; float f(B b) { return b.a.r[1] + b.a.p.y; }
//error 4.1.8 struct defined in a struct | cannot be defined inside another struct
struct A { struct B { float x; } b; };
//error 4.1.8 member twice | already has a member `x`
struct A { float x; int x; };
//error 4.1.8 member void | cannot be of type `void`
struct A { void x; };
//error 4.1.8 struct holds itself | there is no type `A`
struct A { A a; };
//error 4.1.8 qualifier on a member | is not allowed on a struct's member
struct A { const float x; };
//ok 4.1.8 precision on a member
struct A { highp float x; lowp vec3 y; };
//ok 4.1.8 unnamed struct
struct { float a; } s; float f() { return s.a; }
//ok 4.1.8 struct and variable at once
struct S { float a; } x, y[2]; float f() { return x.a + y[1].a; }
//ok 4.1.8 local struct
float f() { struct S { float a; }; S s = S(1.0); return s.a; }
//error 4.1.8 local struct outside its function | there is no type `S`
float f() { struct S { float a; }; return 1.0; } S g;
//error 4.1.8 struct declared again | already declared in this scope
struct S { float a; }; struct S { float b; };
//error 4.1.8 equal structs of two names | cannot initialise
struct A { float x; }; struct B { float x; }; A a = B(1.0);
//error 4.1.8 nested too deep | nested
struct A { int x; }; struct B { A a; }; struct C { B b; }; struct D { C c; }; struct E { D d; };
//ok 4.1.8 nested four deep
struct A { int x; }; struct B { A a; }; struct C { B b; }; struct D { C c; };
//ok 4.1.9 arrays
float a[3]; const int N = 2; vec3 b[N + 1]; float[4] c; int d[] = int[](1, 2, 3); int[] e = int[2](1, 2); int f[d.length()];
//error 4.1.9 array without a size | needs a size between the brackets
float a[];
//error 4.1.9 size zero | greater than zero
float a[0];
//error 4.1.9 negative size | greater than zero
float a[-1];
//error 4.1.9 float size | must be an `int` or `uint`
float a[2.0];
//error 4.1.9 size not constant | must be a constant expression
void f(int n) { float a[n]; }
//error 4.1.9 size from a non-const global | must be a constant expression
int n = 3; float a[n];
//error 4.1.9 array of arrays | no arrays of arrays
float a[2][2];
//error 4.1.9 array of arrays by type and name | no arrays of arrays
float[2] a[2];
//error 4.1.9 array too short | cannot initialise
float a[3] = float[](1.0, 2.0);
//error 4.1.9 parameter without size | needs a size
void f(float a[]) { }
//error 4.1.9 index past the end | index 3 is out of range
float f() { float a[3]; return a[3]; }
//error 4.1.9 negative index | index -1 is out of range
float f() { float a[3]; return a[-1]; }
//error 4.1.9 constant expression past the end | index 4 is out of range
const int N = 2; float f() { float a[3]; return a[N * 2]; }
//ok 4.1.9 varying index
float f(int i) { float a[3]; return a[i] + a[uint(i)]; }
//error 4.1.9 float index | an index must be
float f(float i) { float a[3]; return a[i]; }
//ok 4.1.9 length of an array
const float a[3] = float[](1.0, 2.0, 3.0); const int n = a.length(); float b[a.length()];
//error 4.1.9 length of a vector | `.length()` is for arrays
int f(vec3 v) { return v.length(); }
//ok 4.1.9 arrays assigned, compared, passed and returned
float[2] f(float a[2], out float b[2]) { b = a; if (a == b && !(a != b)) return b; return float[2](1.0, 2.0); }
float g() { float x[2]; return f(float[](1.0, 2.0), x)[0]; }
//error 4.1.9 arrays of two sizes assigned | cannot assign
void f() { float a[2]; float b[3]; a = b; }
//error 4.1.9 array too large | the limit is 16 MiB
float a[1000000000];
//error 4.2.1 unknown name | `x` is not declared
float f() { return x; }
//ok 4.2.2 scopes
float x = 1.0; float f(float y) { { float y = x; { float x = y; } } for (int y = 0; y < 2; y++) { } return y; }
//error 4.2.2 parameter declared again in the body | already the name of a parameter
float f(float x) { float x = 1.0; return x; }
//ok 4.2.2 parameter hidden in a block
float f(float x) { { float x = 1.0; } return x; }
//error 4.2.2 declared twice | already declared in this scope
void f() { float x; int x; }
//error 4.2.2 global declared twice | already declared in this scope
float x; float x;
//error 4.2.2 out of scope | declared in another scope
float f() { { float inner = 1.0; } return inner; }
//error 4.2.2 loop variable after the loop | declared in another scope
float f() { for (int idx = 0; idx < 3; idx++) { } return float(idx); }
//error 4.2.2 loop variable declared again in the body | already declared in this scope
void f() { for (int i = 0; i < 3; i++) { int i = 2; } }
//error 4.2.2 while variable declared again in the body | already declared in this scope
void f(int n) { while (bool b = n > 0) { int b = 2; } }
//ok 4.2.2 initialiser sees the outer variable
float x = 1.0; float f() { float x = x; return x; }
//error 4.2.2 initialiser does not see itself | `zz` is not declared
float f() { float zz = zz; return zz; }
//error 4.2.2 use before declaration | `x` is not declared
float f() { return x; } float x;
//ok 4.2.2 variable hides a function
float f(float x) { return x; } float g() { float f = f(1.0); return f; }
//error 4.2.2 hidden function called | is a variable here and cannot be called
float f(float x) { return x; } float g() { float f = 1.0; return f(f); }
//error 4.2.2 global and function of one name | already declared in this scope
float f() { return 1.0; } float f;
//error 4.2.2 function and global of one name | already declared in this scope
float f; float f() { return 1.0; }
//error 4.2.2 struct and function of one name | already declared in this scope
struct f { float a; }; float f() { return 1.0; }
//ok 4.2.2 variable named like a built-in
float sin = 1.0; float f() { float cos = sin; return cos; }
//error 4.2.2 hidden built-in called | is a variable here and cannot be called
float f() { float sin = 1.0; return sin(sin); }
//ok 4.2.2 if branches are scopes
void f(bool b) { if (b) int x = 1; else int x = 2; }
//ok 4.2.2 a switch is a scope
void f(int n) { switch (n) { case 0: int x = 1; break; case 1: x = 2; break; } int x; }
//ok 4.2.2 condition of do-while does not see the body
void f() { bool b = true; do { bool b = false; } while (b); }
//error 4.2.2 condition of do-while outside the body | declared in another scope
void f() { do { bool again = false; } while (again); }
//error 4.3 uniform in a function | is not allowed on a local variable
void f() { uniform float x; }
//error 4.3 in on a local | is not allowed on a local variable
void f() { in float x; }
//ok 4.3 constant initialisers of globals
const float a = 1.0; float b = a * 2.0; vec3 c = vec3(a, a == a ? 1.0 : 2.0, 0.0).xyz;
//error 4.3 global initialised by a uniform | constant expression
float t = iTime;
//error 4.3 global initialised by a function | constant expression
float g() { return 1.0; } float t = g();
//error 4.3 global initialised by a global | constant expression
float a = 1.0; float b = a;
//ok 4.3 global initialised by a built-in
float a = sin(1.0) + max(2.0, pow(2.0, 0.5)); mat2 m = inverse(mat2(2.0)); vec2 v = normalize(vec2(1.0));
//error 4.3.2 const without a value | needs a value
const float a;
//error 4.3.2 local const without a value | needs a value
void f() { const vec2 a; }
//error 4.3.2 const assigned | is `const` and cannot be assigned
const float a = 1.0; void f() { a = 2.0; }
//error 4.3.2 const component assigned | is `const` and cannot be assigned
void f() { const vec3 a = vec3(1); a.x = 2.0; }
//error 4.3.2 const incremented | cannot be changed
void f() { const int i = 0; i++; }
//error 4.3.3 const from a uniform | not a constant expression
void f() { const float a = iTime; }
//error 4.3.3 const from a variable | not a constant expression
void f(float x) { const float a = x; }
//error 4.3.3 const from a const parameter | not a constant expression
void f(const float x) { const float a = x; }
//error 4.3.3 const from a function | not a constant expression
float g() { return 1.0; } const float a = g();
//error 4.3.3 const from a texture | not a constant expression
const vec4 a = texture(iChannel0, vec2(0));
//error 4.3.3 const from a comma | not a constant expression
const float a = (1.0, 2.0);
//ok 4.3.3 constants of all kinds
struct S { float a; int b[2]; }; const S s = S(1.0, int[](1, 2)); const int i = s.b[1]; const float t[2] = float[](s.a, 2.0);
float a[i]; const bool b = s == s; const float c = b ? t[1] : t[0]; const mat2 m = mat2(1.0) * mat2(2.0); const vec2 v = m[1];
//ok 4.3.3 an index that varies into a constant array
const float t[3] = float[](1.0, 2.0, 3.0); float f(int i) { return t[i]; }
//ok 4.3.4 unused input
in vec2 v_uv;
//error 4.3.4 integer input not flat | must be `flat`
in int x;
//ok 4.3.4 flat integer input
flat in int x;
//error 4.3.4 bool input | an input cannot be a `bool`
in bool x;
//error 4.3.4 input assigned | is an input and cannot be assigned
in vec2 v; void f() { v = vec2(0); }
//ok 4.3.5 uniform of one's own
uniform float zoom; uniform vec3 p[2]; float f() { return zoom + p[1].x; }
//error 4.3.5 uniform with a value | cannot have an initialiser
uniform float zoom = 1.0;
//error 4.3.5 uniform assigned | is a uniform and cannot be assigned
uniform float zoom; void f() { zoom = 1.0; }
//error 4.3.5 the site's uniform assigned | `iTime` is a uniform
void f() { iTime = 1.0; }
//ok 4.3.5 the site's uniform declared again
uniform float iTime;
//error 4.3.5 the site's uniform declared again with another type | `iTime` is a `float`, but this declares a `vec2`
uniform vec2 iTime;
//ok 4.3.5 the site's uniform hidden by a local
float f() { float iTime = 2.0; return iTime; }
//ok 4.3.6 output of one's own that nothing names
out vec4 colour;
//error 4.3.6 output of one's own | cannot be an output
out vec4 colour; void f() { colour = vec4(1); }
//ok 4.3.7 uniform block
uniform Block { float a; vec3 b[2]; }; float f() { return a + b[1].x; }
//ok 4.3.7 uniform block with a name
uniform Block { float a; } block; float f() { return block.a; }
//error 4.3.7 in block | only `uniform` blocks
in Block { float a; } block;
//error 4.3.7 member of a uniform block assigned | is a uniform and cannot be assigned
uniform Block { float a; } block; void f() { block.a = 1.0; }
//error 4.3.7 block name as the type of a variable | `Block` is a uniform block, not a type
uniform Block { float a; } block; Block b;
//error 4.3.7 block name as the type of a result | `Block` is a uniform block, not a type
uniform Block { float a; } block; Block f() { return block; }
//error 4.3.7 block name as a value | is a uniform block
uniform Block { float a; } block; float f() { return Block.a; }
//error 4.3.7 block name called | cannot be called
uniform Block { float a; } block; float f() { return Block(1.0); }
//error 4.3.7 block name given to something else | already
uniform Block { float a; } block; float Block;
//error 4.3.9 flat on a plain global | only allowed on inputs and outputs
flat float x;
//error 4.5 precision on a bool | only numbers and samplers
highp bool b;
//error 4.5 precision on a struct | only numbers and samplers
struct S { float a; }; highp S s;
//ok 4.5 precision
highp float a; mediump vec3 b; lowp ivec2 c; float f(lowp float x, const mediump vec2 y, in highp float z, out lowp vec4 w) { return x; }
//ok 4.5.3 default precisions
precision highp float; precision mediump int; precision lowp sampler2D; void f() { precision lowp float; float x; }
//error 4.5.3 precision of a vector | no default precision to set
precision highp vec3;
//error 4.5.3 precision of bool | no default precision to set
precision highp bool;
//error 4.5.3 precision of uint | no default precision to set
precision highp uint;
//error 4.5.3 sampler without a default | has no default precision
void f(sampler2DArray s) { }
//ok 4.5.3 sampler with its precision
void f(highp sampler2DArray s, lowp isampler2D t) { }
//ok 4.5.3 sampler with a default precision that was set
precision highp usampler2D; void f(usampler2D s) { }
//error 4.6.1 invariant global | only allowed on outputs
invariant float x;
//error 4.6.1 invariant local | is not allowed on a local variable
void f() { invariant float x; }
//error 4.6.1 invariant of a variable | is not an output
float x; invariant x;
//error 4.7 const after in | must come before `in`
float f(in const float x) { return x; }
//error 4.7 precision before in | must come before `highp`
float f(highp in float x) { return x; }
//ok 4.7 const in
float f(const in float x) { return x; }
//error 4.7 const twice | is repeated
const const float x = 1.0;
//error 4.7 const out | cannot be combined
void f(const out float x) { }
//error 4.7 in and out | cannot be combined
void f(in out float x) { }
//error 4.7 const uniform | cannot be combined
const uniform float x;
//error 3.9 name with two underscores | two underscores in a row
float a__b;
//error 3.9 function with two underscores | two underscores in a row
float a__b() { return 1.0; }
//error 3.9 name with gl_ | reserved
float gl_x;
//ok 4.3.8 layout of blocks
layout(std140) uniform; layout(column_major) uniform A { layout(row_major) mat4 m; mat3 n; }; layout(std140, row_major) uniform B { mat2 m; } b;
//error 4.3.8 layout of a plain uniform | only for blocks
layout(std140) uniform float x;
//error 4.3.8 packed block | WebGL has no layout `packed`
layout(packed) uniform A { float x; };
//error 4.3.8 unknown layout | GLSL ES 3.00 has no layout
layout(std430) uniform A { float x; };
//error 4.3.8 location of a uniform | only for outputs
layout(location = 1) uniform float x;
//error 4.3.8 location of an input | only for outputs
layout(location = 0) in vec2 x;
//error 4.3.8 layout of a global | needs `in`, `out` or `uniform`
layout(std140) float x;
//error 4.3.8 packing of a member | only for whole blocks
uniform A { layout(std140) float x; };
