// Small programs, each file of one after a line `//= NAME`: control flow, functions and types. See docs/drivers.md.
// None depends on what the language leaves open, or on the last bits of a float.

//= for_sum.glsl
void mainImage(out vec4 o, in vec2 p) {
    float sum = 0.0;
    for (int i = 1; i <= int(p.x); i++) sum += 1.0 / float(i * i);
    o = vec4(sum / 2.0, p / iResolution.xy, 1.0);
}

//= while_collatz.glsl
void mainImage(out vec4 o, in vec2 p) {
    int n = int(p.x) + 64 * int(p.y) + 1, steps = 0;
    while (n != 1 && steps < 200) {
        n = n % 2 == 0 ? n / 2 : 3 * n + 1;
        steps++;
    }
    o = vec4(vec3(float(steps) / 130.0), 1.0);
}

//= do_while.glsl
void mainImage(out vec4 o, in vec2 p) {
    int n = int(p.x), bits = 0;
    do {
        bits += n & 1;
        n >>= 1;
    } while (n > 0);
    o = vec4(float(bits) / 7.0, p.y / iResolution.y, 0.0, 1.0);
}

//= break_continue.glsl
void mainImage(out vec4 o, in vec2 p) {
    int found = -1, skipped = 0;
    for (int i = 0; i < 64; i++) {
        if (i % 3 == 0) { skipped++; continue; }
        if (i * 2 > int(p.x)) { found = i; break; }
    }
    o = vec4(float(found + 1) / 40.0, float(skipped) / 20.0, p.y / iResolution.y, 1.0);
}

//= nested_loops.glsl
void mainImage(out vec4 o, in vec2 p) {
    int count = 0;
    for (int y = 0; y < 12; y++) {
        for (int x = 0; x < 12; x++) {
            if (x + y > int(p.x) / 4) break;
            if ((x ^ y) % 3 == int(p.y) % 3) count++;
        }
    }
    o = vec4(vec3(float(count) / 60.0), 1.0);
}

//= value_after_exit.glsl
void mainImage(out vec4 o, in vec2 p) {
    // The loop ends after another number of rounds in each pixel; what it computed first in its last round is used.
    float last = 0.0, kept = 0.0;
    for (int i = 0; i < 40; i++) {
        last = float(i * i % 37) / 37.0;
        if (i >= int(p.x) % 17 + int(p.y) % 5) break;
        kept += last / 40.0;
    }
    o = vec4(last, kept, 0.0, 1.0);
}

//= switch_fallthrough.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec3 c = vec3(0.0);
    switch (int(p.x) / 8) {
        case 0: c.r += 0.5;
        case 1: c.g += 0.5; break;
        case 2: { c.b = 1.0; break; }
        case 5: c = vec3(1.0);
        default: c *= 0.5; c += 0.25;
    }
    o = vec4(c, 1.0);
}

//= switch_in_loop.glsl
void mainImage(out vec4 o, in vec2 p) {
    int state = 0, steps = 0;
    for (int i = 0; i < 30; i++) {
        switch (state) {
            case 0: state = int(p.x) % 2 == 0 ? 1 : 2; break;
            case 1: state = (int(p.y) + i) % 5 == 0 ? 3 : 2; continue;
            case 2: state = (int(p.x) + i) % 7 == 0 ? 3 : 1; break;
            default: break;
        }
        if (state == 3) break;
        steps = i;
    }
    o = vec4(float(steps) / 30.0, float(state) / 3.0, 0.0, 1.0);
}

//= short_circuit.glsl
int calls;
bool called(bool result) { calls++; return result; }
void mainImage(out vec4 o, in vec2 p) {
    calls = 0;
    bool left = int(p.x) % 2 == 0, top = int(p.y) % 3 == 0;
    bool both = called(left) && called(top), either = called(top) || called(left);
    bool one = called(left) ^^ called(top);
    o = vec4(float(calls) / 6.0, both || one ? 1.0 : 0.0, either ? 1.0 : 0.0, 1.0);
}

//= conditional_chain.glsl
void mainImage(out vec4 o, in vec2 p) {
    int n = int(p.x) / 10;
    o = n == 0 ? vec4(1, 0, 0, 1) : n == 1 ? vec4(0, 1, 0, 1) : n == 2 ? vec4(0, 0, 1, 1) : vec4(vec3(p.y / iResolution.y), 1);
}

//= early_return.glsl
float shade(vec2 p) {
    for (int i = 0; i < 20; i++) {
        if (length(p - vec2(i * 3 + 2, i + 8)) < 3.3) return float(i + 1) / 20.0;
    }
    return 0.0;
}
void mainImage(out vec4 o, in vec2 p) {
    o = vec4(vec3(shade(p)), 1.0);
    if (p.x > 60.0) return;
    o.b = 0.5;
}

//= out_and_inout.glsl
void twice(inout float a, out vec2 b, const in float c) { a *= 2.0; b = vec2(a, c); a += c; }
void mainImage(out vec4 o, in vec2 p) {
    float a = p.x / 256.0;
    vec3 v = vec3(0.25, 0.5, 0.75);
    twice(a, v.zx, v.y);
    twice(v.y, o.xy, a);
    o = vec4(o.xy / 2.0, v.x, 1.0);
}

//= swizzle_arguments.glsl
void turn(inout vec2 v) { v = vec2(-v.y, v.x) + 1.0; }
void mainImage(out vec4 o, in vec2 p) {
    o = vec4(p / iResolution.xy, 0.25, 1.0);
    turn(o.zx);
    turn(o.yz);
    o = vec4(abs(o.xyz) / 2.0, 1.0);
}

//= overloads.glsl
float f(float x) { return x * 0.5; }
float f(vec2 x) { return x.x + x.y; }
float f(int x) { return float(x) / 64.0; }
float f(mat2 m) { return m[0][1] - m[1][0]; }
void mainImage(out vec4 o, in vec2 p) {
    vec2 u = p / iResolution.xy;
    o = vec4(f(u.x), f(u * 0.4), f(int(p.x)) * f(mat2(u.x, u.y, 0.1, 1.0)) + 0.3, 1.0);
}

//= globals.glsl
float total = 0.25;
const int N = 5;
vec3 marks[N];
void add(int i) { total += float(i) * 0.01; marks[i] = vec3(total, float(i) / 5.0, 1.0 - total); }
void mainImage(out vec4 o, in vec2 p) {
    for (int i = 0; i < N; i++) add(i);
    o = vec4(marks[int(p.x) % N] * (p.y / iResolution.y), 1.0);
}

//= macros.glsl
#define SQUARE(x) ((x) * (x))
#if defined(SQUARE) && !defined(CUBE)
#define PART(u) SQUARE(u.x)
#else
#error SQUARE is defined
#endif
void mainImage(out vec4 o, in vec2 p) {
    vec2 u1 = p / iResolution.xy, u2 = 1.0 - u1;
    o = vec4(PART(u1), PART(u2.yx), float(__VERSION__) / 600.0, 1.0);
}

//= structs.glsl
struct Inner { vec2 at; float w[2]; };
struct Outer { Inner a; Inner b; int n; };
Outer make(vec2 u) { return Outer(Inner(u, float[2](0.1, 0.6)), Inner(1.0 - u, float[](0.3, 0.9)), 1); }
void mainImage(out vec4 o, in vec2 p) {
    Outer x = make(p / iResolution.xy), y = x;
    y.b.w[int(p.x) % 2] = 0.0;
    y.a = x.b;
    o = vec4(y.a.at.x, y.b.w[x.n], x == y ? 1.0 : y.b.at.y, 1.0);
}

//= struct_arrays.glsl
struct Ball { vec2 at; float size; vec3 color; };
void mainImage(out vec4 o, in vec2 p) {
    Ball balls[3] = Ball[3](Ball(vec2(12, 10), 9.3, vec3(1, 0.2, 0)), Ball(vec2(34, 20), 12.3, vec3(0, 1, 0.2)), Ball(vec2(50, 12), 7.3, vec3(0.2, 0, 1)));
    o = vec4(0, 0, 0, 1);
    for (int i = 0; i < balls.length(); i++) {
        Ball b = balls[(i + iFrame) % 3];
        if (distance(p, b.at) < b.size) o.rgb += b.color * 0.7;
    }
}

//= array_index.glsl
void mainImage(out vec4 o, in vec2 p) {
    int v[16];
    for (int i = 0; i < 16; i++) v[i] = (i * 7 + int(p.y)) % 16;
    for (int i = 0; i < 15; i++)
        for (int j = 0; j < 15 - i; j++)
            if (v[j] > v[j + 1]) { int t = v[j]; v[j] = v[j + 1]; v[j + 1] = t; }
    o = vec4(float(v[int(p.x) / 4]) / 16.0, float(v[15 - int(p.x) / 4]) / 16.0, 0.0, 1.0);
}

//= arrays_in_structs.glsl
struct Row { float at[4]; };
void mainImage(out vec4 o, in vec2 p) {
    Row t[3];
    for (int i = 0; i < 3; i++) for (int j = 0; j < 4; j++) t[i].at[j] = float(i * 4 + j) / 12.0;
    Row row = t[int(p.y) % 3];
    t[1] = row;
    float whole[4] = t[int(p.x) % 3].at;
    o = vec4(row.at[int(p.x) % 4], t[1].at[3], whole == row.at ? 1.0 : 0.0, 1.0);
}

//= array_arguments.glsl
float[4] shifted(float v[4], int by) {
    float r[4];
    for (int i = 0; i < 4; i++) r[i] = v[(i + by) % 4];
    return r;
}
void mainImage(out vec4 o, in vec2 p) {
    float v[4] = float[](0.0, 0.3, 0.6, 0.9);
    v = shifted(shifted(v, int(p.x)), 1);
    o = vec4(v[0], v[1], v[2], 1.0);
}

//= constant_table.glsl
const vec3 TABLE[8] = vec3[](vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), vec3(1, 1, 0), vec3(0, 0, 1), vec3(1, 0, 1), vec3(0, 1, 1), vec3(1));
void mainImage(out vec4 o, in vec2 p) {
    int i = int(p.x) / 8;
    o = vec4(mix(TABLE[i], TABLE[(i + 3) & 7], p.y / iResolution.y), 1.0);
}

//= discard_pixels.glsl
void mainImage(out vec4 o, in vec2 p) {
    o = vec4(p / iResolution.xy, 1.0, 1.0);
    if ((int(p.x) / 4 + int(p.y) / 4) % 2 == 0) discard;
    for (int i = 0; i < 8; i++) if (int(p.x) == i * 9) discard;
    o.b = 0.5;
}

//= recursion_by_hand.glsl
void mainImage(out vec4 o, in vec2 p) {
    // A walk through a tree with a stack.
    int stack[8], top = 0, sum = 0;
    stack[top++] = 1;
    while (top > 0) {
        int n = stack[--top];
        sum += n % 5;
        if (n * 2 < int(p.x) + 2 && top < 6) { stack[top++] = n * 2; stack[top++] = n * 2 + 1; }
    }
    o = vec4(vec3(float(sum) / 150.0), 1.0);
}
