//! Calls of functions that are inlined because they are small or called once: they behave like other calls.
//!
//! `Z` is a zero that a compiler cannot see through, so that constant folding does not apply.

use crate::support::compute::*;

/// Section 6.1.1: a parameter is a variable of its own, initialised for each call; so are locals.
#[test]
fn parameters_are_copies() {
    check(&[
        with(
            "float twice(float x) { x *= 2.0; return x; }",
            "float a = Z + 3.0; r = vec4(twice(a), a, twice(twice(a)), a);",
            [6., 3., 12., 3.],
        ),
        with(
            "float count() { float n; n += 1.0; return n; }",
            "float n = 0.0; for (int i = 0; i < 3 + I; i++) n += count(); r = vec4(n, count(), 0, 0);",
            [3., 1., 0., 0.],
        ),
        with(
            "float f(float a, float b) { a += b; b += a; return a * 10.0 + b; }",
            "float a = Z + 1.0; r = vec4(f(a, a), f(a++, a++), a, 0);",
            [23., 35., 3., 0.],
        ),
        with(
            "float pick(float a[3], int i) { return a[i]; } float set(float a[3]) { a[1] = 7.0; return a[1]; }",
            "float a[3] = float[3](Z + 1.0, 2.0, 3.0); r = vec4(pick(a, I + 2), set(a), a[1], pick(a, I + 1));",
            [3., 7., 2., 2.],
        ),
    ]);
}

#[test]
fn out_parameters_are_copied_back() {
    check(&[
        with(
            "void split(float x, out float a, inout float b) { b += x; a += b; }",
            "float a = 5.0, b = Z + 2.0; split(1.0, a, b); vec2 v = vec2(Z + 4.0); split(1.0, v.x, v.y); r = vec4(a, \
             b, v);",
            [3., 3., 5., 5.],
        ),
        with(
            "void swap(inout float a, inout float b) { float t = a; a = b; b = t; }",
            "vec3 v = Z + vec3(1, 2, 3); swap(v.x, v.z); float s = Z + 1.0; swap(s, s); r = vec4(v, s);",
            [3., 2., 1., 1.],
        ),
        with("float g; void set(out float x) { x = 1.0; g += x; }", "g = Z + 5.0; set(g); r = vec4(g); ", [1.; 4]),
        with(
            "float g; float touch() { return ++g; }",
            "g = Z; float a = g, b = touch(), c = g; if (b > 0.0) touch(); r = vec4(a, b, c, g);",
            [0., 1., 1., 2.],
        ),
    ]);
}

/// A return leaves the function, whatever follows it.
#[test]
fn early_returns_skip_the_rest_of_a_function() {
    check(&[
        with(
            "float sort(float x) { if (x < 0.0) return -1.0; if (x > 10.0) { x *= 2.0; return x; } x += 1.0; return x; \
             }",
            "r = vec4(sort(Z - 3.0), sort(Z + 11.0), sort(Z + 4.0), sort(sort(Z + 9.5)));",
            [-1., 22., 5., 21.],
        ),
        with(
            "float g; void step_(float x) { g += 1.0; if (x > 0.0) return; g += 10.0; }",
            "g = Z; step_(Z + 1.0); step_(Z - 1.0); r = vec4(g, 0, 0, 0);",
            [12., 0., 0., 0.],
        ),
        with(
            "float both(float x) { float y = x; if (x > 0.0) { y *= 3.0; return y; } else { return -y; } }",
            "r = vec4(both(Z + 2.0), both(Z - 2.0), 0, 0);",
            [6., 2., 0., 0.],
        ),
        with(
            "float first(float x) { for (int i = 0; i < 9; i++) { if (float(i) > x) return float(i); } return -1.0; }",
            "r = vec4(first(Z + 3.5), first(Z + 20.0), 0, 0);",
            [4., -1., 0., 0.],
        ),
        with(
            "float odd(int n) { float s = 0.0; for (int i = 0; i < n; i++) { if ((i & 1) == 0) continue; if (i > 6) \
             break; s += float(i); } return s; }",
            "float s = 0.0; for (int i = 0; i < 3; i++) { if (i == I + 1) continue; s += odd(I + 9); } r = vec4(s, 0, \
             0, 0);",
            [18., 0., 0., 0.],
        ),
    ]);
}

/// A return inside loops leaves all of them and skips the code after them; the next call starts with fresh locals.
#[test]
fn returns_leave_all_enclosing_loops() {
    check(&[
        with(
            "int find(int x) { int n = 0; for (int i = 0; i < 4; i++) { for (int j = 0; j < 4; j++) { if (n++ == x) \
             return i * 10 + j; }\n\
             if (i == 2) return -n; } return -1; }",
            "r = vec4(find(I), find(I + 6), find(I + 11), find(I + 12));",
            [0., 12., 23., -12.],
        ),
        with(
            "float g; void fill(inout float a, float x) { do { a += 1.0; g += 1.0; if (a > x) return; } while (a < \
             6.0); a = -a; g += 10.0; }",
            "g = Z; float a = Z, b = Z + 3.0; fill(a, 2.5); fill(b, 8.0); r = vec4(a, b, g, 0);",
            [3., -6., 16., 0.],
        ),
        with(
            "float f(float x) { { if (x > 0.0) { if (x > 5.0) return 5.0; x += 1.0; } else if (x < -5.0) { x = 0.0; } \
             }\n\
             x *= 2.0; while (true) { if (x > 3.0) return x; x += 4.0; } }",
            "r = vec4(f(Z + 6.0), f(Z + 2.0), f(Z - 6.0), f(Z + 0.1));",
            [5., 6., 4., 6.2],
        ),
        with(
            "float f(int n) { for (int i = 0; i < 3; i++) { for (int j = i; j < 9; j++) { if (j == n) return float(j); \
             if (j > i + 2) break; }\n\
             if (i == n - 9) continue; for (int j = 0; j < n; j++) if (j > 3) return 20.0 + float(i); } return -1.0; }",
            "r = vec4(f(I + 1), f(I + 4), f(I + 9), f(I + 10));",
            [1., 4., 21., 20.],
        ),
        with(
            "float f(float x) { for (int i = 0; i < 3; i++) { if (x > 1.0) return x; x += 0.25; } }",
            "r = vec4(0); for (int i = 0; i < 3; i++) { r.x = f(Z + float(2 - i)); r.y += f(Z + 0.75); r.z += f(Z + \
             float(i)); }",
            [0., 3.75, 3.25, 0.],
        ),
        with(
            "struct Hit { float t; vec2 n; }; Hit meet(float x) { Hit h; h.t = -1.0; for (int i = 0; i < 5; i++) { h.n \
             += x;\n\
             if (h.n.x > 2.0) { h.t = float(i); return h; } } return h; }",
            "Hit a = meet(Z + 1.0), b = meet(Z); r = vec4(a.t, a.n.y, b.t, b.n.y);",
            [2., 3., -1., 0.],
        ),
        with(
            "float f(int n) { for (int i = 0; i < 3; i++) switch (i + n) { case 1: return 7.0; case 4: break; default: \
             n++; } return float(n); }",
            "r = vec4(f(I + 1), f(I + 2), f(I), f(I + 4));",
            [7., 4., 2., 6.],
        ),
        with(
            "float f(int n) { float x = 1.0; switch (n) { case 0: x = 5.0; case 1: for (int i = 0; ; i++) { switch (i) \
             { case 2: return x + 10.0; } x += 1.0; }\n\
             case 2: break; default: if (n > 4) return 40.0; x = 8.0; } x *= 2.0; return x; }",
            "r = vec4(f(I), f(I + 1), f(I + 2) + 100.0 * f(I + 3), f(I + 5));",
            [17., 13., 1602., 40.],
        ),
    ]);
}

/// The known value of a variable is valid from one write to the next: in a branch, in a loop, or through a component.
#[test]
fn variables_have_their_last_value_after_branches_and_loops() {
    check(&[
        case(
            "float a = Z + 1.0; float b = a; if (Z < 1.0) { b += a; a = 5.0; b += a; } r = vec4(a, b, 0, 0);",
            [5., 7., 0., 0.],
        ),
        case(
            "float a = Z + 1.0, b = 0.0; for (int i = 0; i < 3 + I; i++) { b += a; a += 1.0; } r = vec4(a, b, a + b, \
             0);",
            [4., 6., 10., 0.],
        ),
        case(
            "vec3 v = Z + vec3(1, 2, 3); float s = v.y; v.y = 9.0; vec3 w = v; v[I + 2] = 7.0; r = vec4(s + w.z, v);",
            [5., 1., 9., 7.],
        ),
        case(
            "float a = Z; switch (I) { case 0: a = 1.0; case 1: a += 2.0; break; default: a = 9.0; } r = vec4(a, a + \
             1.0, 0, 0);",
            [3., 4., 0., 0.],
        ),
        case("float a = Z + 2.0; float b = (a = 3.0) + a; r = vec4(b, a += a, a, 0);", [6., 6., 6., 0.]),
    ]);
}

/// The known value of a member of a structure stays valid while another member is written, and no longer.
#[test]
fn members_have_the_value_that_was_written_last() {
    const LENS: &str = "struct Lens { float focus; vec2 size; float list[2]; }; struct Eye { Lens lens; float far; };\n\
        Lens shared_lens;\n\
        float power(Lens l) { return 1.0 / (1.0 / l.focus - 1.0 / l.size.x); }\n\
        void widen(inout Lens l) { l.size.x *= 2.0; }\n\
        float both(Eye e) { e.lens.focus += 1.0; return e.lens.focus + e.far; }";
    check(&[
        with(
            LENS,
            "Lens l; l.focus = 2.0; l.size = vec2(4.0, 1.0); r = vec4(power(l), l.focus, l.size);",
            [4., 2., 4., 1.],
        ),
        with(
            LENS,
            "Lens l; l.focus = 2.0; l.size.x = 4.0; float a = power(l); l.focus = 1.0; float b = l.focus;\n\
             l.size.x = 2.0; r = vec4(a, power(l), b, l.size.x);",
            [4., 2., 1., 2.],
        ),
        with(
            LENS,
            "Lens l; l.size = vec2(3.0); widen(l); l.size[I] += 1.0; r = vec4(l.size, l.focus, 0);",
            [7., 3., 0., 0.],
        ),
        with(
            LENS,
            "Lens l; l.list[0] = 1.0; l.list[I] += 2.0; l.focus = 5.0; r = vec4(l.list[0], l.list[I + 1], l.focus, 0);",
            [3., 0., 5., 0.],
        ),
        with(
            LENS,
            "Eye e; e.lens.focus = 2.0; e.far = 9.0; float a = both(e); Lens m = e.lens; m.focus = 4.0; e.lens = m;\n\
             r = vec4(a, e.lens.focus, e.far, m.focus);",
            [12., 4., 9., 4.],
        ),
        with(
            LENS,
            "shared_lens.focus = 1.0; for (int i = 0; i < 2; i++) { r.x = shared_lens.focus; shared_lens.focus += 1.0; \
             }\n\
             if (I == 0) shared_lens.focus = 8.0; else shared_lens.size.x = 1.0; r = vec4(r.x, shared_lens.focus, \
             shared_lens.size);",
            [2., 8., 0., 0.],
        ),
    ]);
}

/// A chain of 60 functions with so many statements that they are merged into one: `link` is the body of each, which
/// calls `f(..)`, the previous function. A longer chain would nest `if`s deeper than llvmpipe allows
/// (`LP_MAX_TGSI_NESTING`).
fn chain(link: &str) -> &'static str {
    let idle = "x += 1.0; x -= 1.0; ".repeat(20);
    let mut text = "float f0(float x) { return x; }\n".to_owned();
    for i in 1..=60 {
        let body = link.replace("f(", &format!("f{}(", i - 1));
        text += &format!("float f{i}(float x) {{ {idle}{body} }}\n");
    }
    text.leak()
}

#[test]
fn functions_of_a_long_chain_return_the_same_values_as_alone() {
    check(&[
        with(chain("return f(x) + 1.0;"), "r = vec4(f60(Z), f60(Z + 2.0), 0, 0);", [60., 62., 0., 0.]),
        with(
            chain(
                "if (x > 1e6) return -1.0; float y = f(x + 1.0); if (y < 0.0) { if (y < -9.0) return 0.0; return y; } \
                 return y + 1.0;",
            ),
            "r = vec4(f60(Z), f60(Z + 1e6 - 30.5), 0, 0);",
            [120., -1., 0., 0.],
        ),
        with(
            chain(
                "float y = f(x); for (int i = 0; i < 3; i++) { if (float(i) >= x) return y + float(i); } return y - \
                 1.0;",
            ),
            "r = vec4(f60(Z + 1.0), 0, 0, 0); r.y = f60(Z + 9.0);",
            [61., -51., 0., 0.],
        ),
        with(
            chain(
                "float y = f(x); switch (int(x)) { case 0: return y; case 1: y += 2.0; break; default: for (int i = 0; \
                 ; i++) { if (i > 1) return y + 3.0; } } return y;",
            ),
            "r = vec4(0); for (int i = 0; i < 3; i++) r[i] = f60(Z + float(i));",
            [0., 121., 182., 0.],
        ),
        with(
            chain("float n; n += 1.0; if (x > 1e6) discard; return f(x) + n;"),
            "r = vec4(0); for (int i = 0; i < 2 + I; i++) r.x += f60(Z + float(i));",
            [121., 0., 0., 0.],
        ),
        with(
            chain(
                "float y = 0.0; for (int i = 0; i < 1 + int(x * 0.0); i++) { float t; t += 1.0; y += f(x) + t; } return y;",
            ),
            "r = vec4(f60(Z + 1.0), 0, 0, 0);",
            [61., 0., 0., 0.],
        ),
    ]);
}
