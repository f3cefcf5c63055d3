//! Arrays and tables: where they are stored, how often they are filled, and that reads from them are correct.
//!
//! Filling and copying memory is expensive: a software driver stores each element once per pixel and component.

use crate::support::{compiled, compute::*, ir};
use eddy::glsl::{Compiled, Driver};

/// Returns the compiled Image pass.
fn compiled(code: &str) -> Compiled {
    compiled::compiled(code, Driver::default())
}

fn list(count: usize, element: &dyn Fn(usize) -> String) -> String {
    (0..count).map(element).collect::<Vec<_>>().join(", ")
}

/// Returns the program of an Image pass as text, after the last pass of the optimiser.
fn optimised(code: &str) -> String {
    ir::optimised(code, Driver::default())
}

#[test]
fn tables_of_numbers_are_in_slots_of_a_uniform_buffer() {
    for (count, bytes) in [(33, 33 * 16), (32, 0)] {
        let table = compiled(&format!(
            "const float T[{count}] = float[]({}); void mainImage(out vec4 o, vec2 p) {{ o = vec4(T[int(p.x)]); }}",
            list(count, &|i| format!("{i}."))
        ));
        assert_eq!(table.uniform_tables.len(), bytes, "{count}");
        // The first word of the sixth slot.
        assert!(table.uniform_tables.get(80..84).is_none_or(|word| word == 5f32.to_ne_bytes()));
        assert!(table.tables.is_empty());
    }
}

#[test]
fn a_table_after_a_full_uniform_buffer_is_in_the_storage_buffer() {
    let full = compiled(&format!(
        "const float T[1024] = float[]({}); const float N[300] = float[]({});\n\
         void mainImage(out vec4 o, vec2 p) {{ o = vec4(T[int(p.x)], N[int(p.x)], 0, 0); }}",
        list(1024, &|i| format!("{i}.")),
        list(300, &|i| format!("{i}."))
    ));
    assert_eq!((full.uniform_tables.len(), full.tables.len()), (1024 * 16, 300 * 4));
}

#[test]
fn an_array_is_initialised_once_per_call() {
    let code = |declared: &str| {
        format!(
            // A `discard` keeps a function from being inlined.
            "float f(int i) {{ {declared} a[i] += 1.0; if (i > 9) discard; return a[i + 1]; }}\n\
                 void mainImage(out vec4 o, vec2 p) {{ o = vec4(f(int(p.x))); }}"
        )
    };
    insta::assert_snapshot!("begins_with_its_value", optimised(&code("float a[3] = float[](1., 2., 3.);")));
    insta::assert_snapshot!("begins_with_zeros", optimised(&code("float a[3];")));
}

#[test]
fn an_array_handed_on_through_calls_is_not_copied_on_the_way() {
    // `last` and `middle` take a pointer; only `mainImage` has the array.
    insta::assert_snapshot!(optimised(
        "float last(float a[4], int i) { if (i > 9) discard; return a[i]; }\n\
         float middle(float a[4], int i) { if (i > 9) discard; return last(a, i) + last(a, i + 1); }\n\
         void mainImage(out vec4 o, vec2 p) { float a[4]; a[1] = p.x; o = vec4(middle(a, int(p.y))); }",
    ));
}

/// A global or a table is read in place: the function has no parameter for it.
#[test]
fn what_all_functions_see_is_not_handed_over() {
    // `last` is specialised for its pointer parameter, the global and the table, `middle` for the global and the
    // table; `mainImage` has the array of four numbers.
    insta::assert_snapshot!(optimised(
        "float G[4]; const float T[4] = float[](1., 2., 3., 4.);\n\
         float last(float a[4], int i) { if (i > 9) discard; return a[i]; }\n\
         float middle(float a[4], int i) { if (i > 9) discard; return last(a, i) + last(a, i + 1); }\n\
         void mainImage(out vec4 o, vec2 p) {\n\
             int i = int(p.x); G[i] = p.x;\n\
             o = vec4(middle(G, i), middle(T, i), last(T, 0), last(float[](5., 6., 7., 8.), i));\n\
         }",
    ));
}

#[test]
fn globals_passed_as_arguments_keep_their_value() {
    const INLINED: &str = "float G[3]; float[3] H = float[](1.0, 2.0, 3.0); mat2 M; struct S { float a[2]; }; S s;\n\
        float last(float a[3], int i) { return a[i]; }\n\
        float set(float x) { G[0] = x; return x; }\n\
        float later(float a[3], float x, int i) { return a[i] + x; }\n\
        float within(float a[3], int i) { set(9.0); return last(a, i); }\n\
        float both(float a[3], float b[3], int i) { return a[i] * 10.0 + b[i + 1]; }\n\
        float change(inout float a[3], float b[3], int i) { a[i] = 7.0; return b[i]; }\n\
        float column(mat2 m, int i) { return m[i].y; }\n\
        float member(S s, int i) { return s.a[i]; }\n\
        float whole(float a[3], int i) { float b[3] = a; b[i] += 0.5; return a[i] + b[i]; }";
    // The same functions, which a `discard` keeps from being inlined.
    let not_inlined: &'static str =
        Box::leak(INLINED.replace("{ return", "{ if (i > 9) discard; return").into_boxed_str());
    for calls in [INLINED, not_inlined] {
        check(&[
            with(
                calls,
                "G[I] = 4.0; r = vec4(last(G, I), last(H, I + 2), both(G, H, I), both(H, G, I));",
                [4., 3., 42., 10.],
            ),
            // The copy is made after a later argument writes the global, and before the function itself writes it.
            with(calls, "G[0] = 4.0; r.x = later(G, set(5.0), I); r.y = G[I]; r.zw = vec2(0);", [10., 5., 0., 0.]),
            with(calls, "G[0] = 4.0; r.x = within(G, I); r.y = G[I]; r.zw = vec2(0);", [4., 9., 0., 0.]),
            with(calls, "G[0] = 4.0; r.x = change(G, G, I); r.y = G[I]; r.zw = vec2(0);", [4., 7., 0., 0.]),
            with(
                calls,
                "M[I] = vec2(1, 2); s.a[I + 1] = 6.0; r = vec4(column(M, I), member(s, I + 1), whole(H, I + 1), H[I + \
                 1]);",
                [2., 6., 4.5, 2.],
            ),
        ]);
    }
    check(&[
        // A different global replaces the parameter at each call.
        with(
            "float A[2], B[2]; float inner(float a[2], int i) { return a[i]; }\n\
             float outer(float a[2], float b[2], int i) { return inner(a, i) * 10.0 + inner(b, i); }",
            "A[I] = 1.0; B[I] = 2.0; float c[2]; c[I] = 3.0;\n\
             r = vec4(outer(A, B, I), outer(B, A, I), outer(A, A, I), outer(c, A, I));",
            [12., 21., 11., 31.],
        ),
    ]);
}

#[test]
fn an_array_handed_on_to_what_becomes_part_of_its_caller_is_not_copied() {
    // Only `mainImage` with `a`.
    insta::assert_snapshot!(optimised(
        "float last(float a[4], int i) { return a[i]; }\n\
         float middle(float a[4], int i) { return last(a, i) + last(a, i + 1); }\n\
         void mainImage(out vec4 o, vec2 p) { float a[4]; a[1] = p.x; o = vec4(middle(a, int(p.y))); }",
    ));
}

#[test]
fn tables_in_uniform_slots_have_their_values() {
    // Leaking is fine here: a case needs a text that lives as long as the program.
    let tables: &'static str = Box::leak(
        format!(
            "const float F[40] = float[]({});\nconst int N[40] = int[]({});\nconst vec2 TWO[40] = vec2[]({});\n\
             const uvec3 THREE[40] = uvec3[]({});\nconst vec4 FOUR[40] = vec4[]({});\n\
             float total(float a[40]) {{ float s = 0.0; for (int i = 0; i < 40; i++) s += a[i]; return s; }}",
            list(40, &|i| format!("{i}.")),
            list(40, &|i| format!("-{i}")),
            list(40, &|i| format!("vec2({i}, {i}.5)")),
            list(40, &|i| format!("uvec3({i}, {}, {})", i + 1, i + 2)),
            list(40, &|i| format!("vec4({i}, {}, {}, {})", i + 1, i + 2, i + 3)),
        )
        .into_boxed_str(),
    );
    check(&[
        with(tables, "r = vec4(F[I + 6], N[I + 3], TWO[I + 2].y, TWO[I + 3][I]);", [6., -3., 2.5, 3.]),
        with(tables, "r = vec4(TWO[I + 1].yx, THREE[I + 2].zx);", [1.5, 1., 4., 2.]),
        with(tables, "r = FOUR[I + 1].wzyx + vec4(FOUR[I].x, FOUR[I][I + 1], 0, 0);", [4., 4., 2., 1.]),
        with(tables, "r = vec4(TWO[I + 99].y, F[I + 99], F[I - 5], total(F));", [39.5, 39., 0., 780.]),
        with(
            tables,
            "float a[40] = F; a[I + 2] = 9.0; r = vec4(a[I + 2], a[I + 3], a == F, F == F);",
            [9., 3., 0., 1.],
        ),
    ]);
}

#[test]
fn arrays_start_fresh_and_do_not_alias() {
    const CALLS: &str = "float last(float a[3], int i) { return a[i]; }\n\
        float middle(float a[3], int i) { return last(a, i) * 10.0 + last(a, i + 1); }\n\
        float change(float a[3], int i) { a[i] = 7.0; return last(a, i); }\n\
        float counted(int i) { float a[3]; a[i] += 1.0; return a[i]; }\n\
        float both(inout float a[3], float b[3], int i) { a[i] = 9.0; return last(b, i); }";
    check(&[
        with(
            CALLS,
            "float a[3] = float[](1.0, 2.0, 3.0); float m = middle(a, I); a[I] = 5.0; r = vec4(m, middle(a, I), 0, 0);",
            [12., 52., 0., 0.],
        ),
        with(
            CALLS,
            "float a[3] = float[](1.0, 2.0, 3.0); float c = change(a, I); r = vec4(c, a[I], middle(a, I + 1), 0);",
            [7., 1., 23., 0.],
        ),
        with(
            CALLS,
            "for (int k = 0; k < 3; k++) { r.x = counted(I); float a[2]; a[I] += 1.0; r.y = a[I]; } r.zw = vec2(0);",
            [1., 1., 0., 0.],
        ),
        // The copy of the second argument is made before the first argument is written.
        with(
            CALLS,
            "float a[3] = float[](1.0, 2.0, 3.0); float b = both(a, a, I); r = vec4(b, a[I], 0, 0);",
            [1., 9., 0., 0.],
        ),
        with(CALLS, "r = vec4(middle(float[](4.0, 5.0, 6.0), I), 0, 0, 0);", [45., 0., 0., 0.]),
        case(
            "float a[3]; mat2 m; m[I][I] += 2.0; r = vec4(a[I + 2], m[I], 0); m = mat2(1); r.w = m[I + 1].y;",
            [0., 2., 0., 1.],
        ),
    ]);
}

/// Returns the loops of a list, each with the indices at which it reads an array of four floats after the optimiser.
fn indices_in(loops: &[String]) -> String {
    let with_indices = |text: &String| {
        let program = optimised(&format!(
            "void mainImage(out vec4 o, vec2 p) {{ float a[4] = float[](p.x, p.y, 3., 4.); float s;\n\
             {text} o = vec4(s); }}"
        ));
        format!("{text}\n{}", ir::indices(&program))
    };
    loops.iter().map(with_indices).collect::<Vec<_>>().join("\n")
}

/// `while (n >= 1) { .. n--; }` keeps n between 0 and its initial value; with one more write its range is unknown.
#[test]
fn loop_counters_need_no_clamp() {
    let loops = |parts: &[(&str, &str, &str, &str)]| {
        let one = |&(before, test, step, index): &(&str, &str, &str, &str)| {
            format!("{before} while ({test}) {{ s += a[{index}]; {step} }}")
        };
        indices_in(&parts.iter().map(one).collect::<Vec<_>>())
    };
    // The last value of a counter is outside the array: it is known to be excluded only where the loop's own condition
    // does.
    insta::assert_snapshot!(
        "known_counters",
        loops(&[
            ("int n = 4;", "n >= 1", "n--;", "n - 1"),
            ("int n;", "n < 4", "n += 2;", "n"),
            ("uint n = 1u; const int last = 3;", "n <= uint(last)", "n++;", "n & 3u"),
            ("int n = 3, m = n;", "n > 0", "n--;", "m"),
        ])
    );
    insta::assert_snapshot!(
        "unknown_counters",
        loops(&[
            // Half of a condition does not count: `&&` is a branch.
            ("int n = 4;", "1 <= n && s < 9.0", "if (p.x > 2.) --n; else s++;", "n - 1"),
            ("int n = 4;", "n >= 1", "n--; if (s > 2.) n = int(p.x);", "n - 1"),
            ("int n = int(p.x);", "n >= 1", "n--;", "n - 1"),
            ("int n = 4;", "n >= 1", "for (int i = 0; i < 3; i++) n--;", "n - 1"),
            ("int n = 3;", "s < 9.0", "n--;", "n"),
        ])
    );
}

/// An inner loop whose bound is the counter of the outer loop: the bound is known to be small.
#[test]
fn loops_within_counting_loops() {
    let body = "vec2 p1[4] = vec2[](vec2(Z), vec2(1, 2), vec2(3, 5), vec2(4, 1)), p2[4] = p1; int n = 4;\n\
                while (n >= 1) { for (int i = 0; i < n - 1; i++) p2[i] = mix(p1[i], p1[i + 1], 0.25); n--; p1 = p2; }";
    insta::assert_snapshot!(optimised(&format!(
        "void mainImage(out vec4 o, vec2 p) {{ float Z = p.x; {body} o = p1[0].xyxy; }}"
    )));
    let bezier =
        |p: [f32; 4]| (0..3).fold(p.to_vec(), |p, _| p.windows(2).map(|w| w[0] + 0.25 * (w[1] - w[0])).collect())[0];
    let expected = [bezier([0., 1., 3., 4.]), bezier([0., 2., 5., 1.]), 0., 0.];
    check(&[case(Box::leak(format!("{body} r = vec4(p1[0], float(n), 0);").into_boxed_str()), expected)]);
}

/// `for (float x = 0.; x < 4.; x++)` keeps `int(x)` between the literals.
#[test]
fn float_loop_counters_need_no_clamp() {
    let loops = |heads: &[&str]| {
        indices_in(&heads.iter().map(|head| format!("for ({head}) s += a[int(x)];")).collect::<Vec<_>>())
    };
    insta::assert_snapshot!(
        "known_floats",
        loops(&[
            "float x = 0.; x < 4.; x++",
            "float x = 0.5; x <= 3.9; x += 0.1",
            "float x = 0.; x < 3.5; x += 1.",
            "float x = 3.; x > -1.; x -= 1.",
            "float x = 3.9; x >= 0.; --x",
        ])
    );
    insta::assert_snapshot!(
        "known_floats_of_a_function",
        ir::indices(&optimised(
            "const int order = clamp(9, 1, 30); const float n = float(order - 1); float A[order], B[order];\n\
             void fill(inout float a[order], inout float b[order], vec2 p) {\n\
                 for (float x = 0.; x <= n; x += 1.) { a[int(x)] = p.x * x; b[int(x)] = a[int(x)] + p.y; }\n\
             }\n\
             void mainImage(out vec4 o, vec2 p) { fill(A, B, p); o = vec4(A[0] + B[8]); }",
        ))
    );
    insta::assert_snapshot!(
        "unknown_floats",
        loops(&[
            "float x = 0.; x <= 4.; x++",
            "float x = -1.; x < 4.; x++",
            "float x = 0.; x < 4.; x += p.x",
            "float x = p.x; x < 4.; x++",
            "float x = 0.; x < p.x; x++",
            "float x = 0.; x < 4.; x--",
            "float x = 3.; x > -2.; x--",
            "float x = 4.; x > 0.; x--",
        ])
    );
    check(&[case(
        "float a[4] = float[](1.0, 2.0, 4.0, 8.0 + Z); r = vec4(0); for (float x = 0.; x < 4.; x++) r.x += a[int(x)];\n\
         for (float x = 3.; x > -1.; x -= 1.) r.y = r.y * 2.0 + a[int(x)]; for (float x = 0.; x <= 5.; x += 1.) r.z += \
         a[int(x)];",
        [15., 85., 31., 0.],
    )]);
}
