//ok 6.1 overloads, prototypes, unnamed parameters
float f(float); float f(vec2 x); float f(float x) { return x; } float f(vec2 x) { return x.x; } float g(float, int i) { return f(1.0) + f(vec2(1)); }
//ok 6.1 prototype twice
float f(); float f(); float f() { return 1.0; }
//error 6.1 two bodies | already has a body
float f() { return 1.0; } float f() { return 2.0; }
//error 6.1 only the result differs | was declared to return
float f() { return 1.0; } int f() { return 2; }
//error 6.1 qualifiers differ | another qualifier
void f(in float x); void f(out float x) { x = 1.0; }
//error 6.1 const differs | another qualifier
void f(float x); void f(const float x) { }
//error 6.1 overload that differs in a qualifier only | another qualifier
void f(in float x) { } void f(inout float x) { }
//error 6.1 built-in defined | is a built-in function
float cross(float x) { return x; }
//error 6.1 built-in overloaded | is a built-in function
float sin(int x) { return 1.0; }
//error 6.1 built-in of version 3.00 defined | is a built-in function
float round(float x) { return x; }
//ok 6.1 built-ins the site lets be overloaded
struct S { float a; }; S mix(S a, S b, float t) { return S(mix(a.a, b.a, t)); } vec4 texelFetch(sampler2D s, int i) { return texelFetch(s, ivec2(i), 0); }
//error 6.1 used before its declaration | declared before its first use
float f() { return g(); } float g() { return 1.0; }
//error 6.1 never defined | never defined
float g(); float f() { return g(); }
//ok 6.1 never defined, never called
float g();
//error 6.1 function in a function | cannot be declared inside another
float f() { float g(); return 1.0; }
//error 6.1 void parameter among others | cannot be of type `void`
void f(float a, void b) { }
//error 6.1 parameter twice | already the name of a parameter
void f(float a, float a) { }
//error 6.1 struct in a parameter list | cannot be defined in a parameter list
void f(struct S { float a; } s) { }
//error 6.1 qualified result | is not allowed on a function's result
const float f() { return 1.0; }
//ok 6.1 precision of a result
highp float f() { return 1.0; }
//error 6.1 main | not `main`
void main() { }
//error 6.1.1 int for float | argument 1 of `f` must be a `float`
void f(float x) { } void g() { f(1); }
//error 6.1.1 too few arguments | takes 2 arguments, 1 is given
void f(float x, float y) { } void g() { f(1.0); }
//error 6.1.1 too many arguments | takes 1 argument, 2 are given
void f(float x) { } void g() { f(1.0, 2.0); }
//error 6.1.1 no overload fits | no overload of `f` takes (ivec2)
void f(float x) { } void f(vec2 x) { } void g() { f(ivec2(1)); }
//error 6.1.1 literal for out | cannot be passed as `out`
void f(out float x) { x = 1.0; } void g() { f(1.0); }
//error 6.1.1 const for inout | cannot be passed as `inout`
void f(inout float x) { x = 1.0; } void g(const float y) { f(y); }
//error 6.1.1 uniform for out | cannot be passed as `out`
void f(out float x) { x = 1.0; } void g() { f(iTime); }
//error 6.1.1 expression for out | cannot be passed as `out`
void f(out float x) { x = 1.0; } void g(float y) { f(y + 1.0); }
//error 6.1.1 out of another type | argument 1 of `f` must be a `float`
void f(out float x) { x = 1.0; } void g() { int i; f(i); }
//error 6.1.1 void as argument | returns nothing
void v() { } void f(float x) { } void g() { f(v()); }
//error 6.1.1 variable called | is a variable here and cannot be called
float x; float f() { return x(1.0); }
//error 6.1.1 function as a value | is a function, not a value
float g() { return 1.0; } float f() { return g; }
//error 6.1.1 const parameter assigned | is `const` and cannot be assigned
void f(const float x) { x = 1.0; }
//ok 6.1.1 in parameter assigned
float f(float x) { x *= 2.0; return x; }
//error 6.1 recursion | calls itself
float f(float x) { return x > 0.0 ? f(x - 1.0) : 0.0; }
//error 6.1 mutual recursion | recursively
float f(float x); float g(float x) { return f(x); } float f(float x) { return g(x); }
//ok 6.2 conditions
void f(int i) { if (i > 0) { } else if (i < 0) ; else { } }
//error 6.2 if on an int | must be a `bool`
void f(int i) { if (i) { } }
//error 6.2 if on a vector | `all(..)` or `any(..)`
void f(bvec2 i) { if (i) { } }
//error 6.2 assignment for comparison | write `==`
void f(float x) { if (x = 1.0) { } }
//ok 6.2 switch
int f(int i) { switch (i) { case 0: case 1: i++; break; case -2: { i--; } default: return 1; case 5: break; } return 0; }
//ok 6.2 switch on uint with constants
const uint A = 3u; void f(uint i) { switch (i) { case A: break; case A + 1u: break; } }
//ok 6.2 empty switch
void f(int i) { switch (i) { } }
//error 6.2 switch on a float | must be an `int` or `uint`
void f(float i) { switch (i) { case 0: break; } }
//error 6.2 label of another type | this switch is over `int`
void f(int i) { switch (i) { case 0u: break; } }
//error 6.2 float label | a `case` must be
void f(int i) { switch (i) { case 0.0: break; } }
//error 6.2 label not constant | must be a constant expression
void f(int i, int j) { switch (i) { case j: break; } }
//error 6.2 label twice | already has a `case 1`
void f(int i) { switch (i) { case 1: break; case 2 - 1: break; } }
//error 6.2 default twice | already has a `default:`
void f(int i) { switch (i) { default: break; default: break; } }
//error 6.2 statement before the first label | before the first `case`
void f(int i) { switch (i) { i++; case 0: break; } }
//error 6.2 nothing after the last label | nothing follows the last label
void f(int i) { switch (i) { case 0: break; case 1: } }
//error 6.2 label in a block | directly in its switch
void f(int i) { switch (i) { case 0: { case 1: break; } } }
//error 6.2 case outside | `case` outside a switch
void f(int i) { case 0: i++; }
//error 6.2 continue in a switch | `continue` outside a loop
void f(int i) { switch (i) { case 0: continue; } }
//ok 6.2 continue in a switch in a loop
void f(int i) { while (i < 3) { switch (i++) { case 0: continue; default: break; } } }
//ok 6.3 loops
void f(int n) { for (;;) { break; } for (int i = 0, j = 1; i < n; i++, j++) continue; while (n > 0) n--; do n++; while (n < 3); for (n = 0; bool b = n < 3; n++) { } while (bool b = n < 5) { n++; } }
//error 6.3 for on an int | must be a `bool`
void f() { for (int i = 3; i; i--) { } }
//error 6.3 while on a float | must be a `bool`
void f(float x) { while (x) { } }
//error 6.3 do while on an int | must be a `bool`
void f(int x) { do { } while (x); }
//error 6.3 while declares an int | must be a `bool`
void f(int x) { while (int i = x) { } }
//error 6.4 break outside | `break` outside a loop or switch
void f() { break; }
//error 6.4 continue outside | `continue` outside a loop
void f() { continue; }
//error 6.4 break in an if | `break` outside a loop or switch
void f(bool b) { if (b) break; }
//ok 6.4 discard
void f() { if (gl_FragCoord.x < 1.0) discard; }
//error 6.4 no value returned | `return` needs a value
float f() { return; }
//error 6.4 value returned by void | is `void` and cannot return a value
void f() { return 1.0; }
//error 6.4 void call returned by void | is `void` and cannot return a value
void g() { } void f() { return g(); }
//error 6.4 wrong type returned | returns `float`, not `int`
float f() { return 1; }
//error 6.4 never returns | never returns a value
float f() { }
//ok 6.4 returns on one path
float f(bool b) { if (b) return 1.0; }
//error 6.4 array of another size returned | returns `float[2]`
float[2] f() { return float[3](1.0, 2.0, 3.0); }
//ok loops without a condition that something leaves
int f(int n) { for (;;) { if (n > 3) { break; } n++; } while (true) { for (;;) { if (n == 0) return 1; n--; } } return 2; }
int g(int n) { do { n++; } while (true); return n; }
void h() { for (;;) { if (true) continue; break; } while (true, true) { } while (bool b = true) { } }
//error a loop that nothing leaves | this loop never ends
void f() { for (int i = 0; ; i++) { continue; } }
//error a break that leaves only what is inside the loop | this loop never ends
void f(int n) { while (1 < 2) { switch (n) { case 1: break; } for (;;) { break; } do { break; } while (true); } }
//error discard ends no loop on the site | this loop never ends
void f() { const bool on = true; while (on) { discard; } }
