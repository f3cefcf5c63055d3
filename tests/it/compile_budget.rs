//! The cost of compiling a text: at most proportional to its length, and within documented limits. Programs that would
//! take a driver minutes are rejected, or emitted in a form that the driver compiles quickly.

use crate::support::{clock::Clock, first_frame::first_frame};
use eddy::{
    diag::Diagnostic,
    glsl::{self, Compiled, PassSource},
};
use std::{fmt::Write, time::Duration};

fn compile(text: &str) -> Result<Compiled, Vec<Diagnostic>> {
    Ok(glsl::compile(&PassSource::image(text))?)
}

/// Concatenates `n` pieces.
fn repeat(n: usize, piece: impl Fn(usize) -> String) -> String {
    (0..n).map(piece).collect()
}

fn main_image(body: &str) -> String {
    format!("void mainImage(out vec4 o, in vec2 p) {{ float x = p.x; {body} }}\n")
}

/// Joins `n` terms with `+`.
fn sum(n: usize, term: impl Fn(usize) -> String) -> String {
    (0..n).map(term).collect::<Vec<_>>().join(" + ")
}

/// Texts that grow with a number of pieces; a piece has about ten bytes.
type TextPattern = (&'static str, fn(usize) -> String);

const TEXT_PATTERNS: &[TextPattern] = &[
    ("a sum of one variable", |n| main_image(&format!("o = vec4({});", sum(n, |_| "x".into())))),
    ("a sum of products", |n| main_image(&format!("o = vec4({});", sum(n, |i| format!("x * {i}.5"))))),
    ("a sum of calls", |n| main_image(&format!("o = vec4({});", sum(n, |i| format!("sin(x + {i}.)"))))),
    ("all operators", |n| {
        main_image(&format!("o = vec4({} x);", repeat(n, |i| format!("x {} ", ["+", "*", "-", "/"][i % 4]))))
    }),
    ("a chain of &&", |n| {
        main_image(&format!("o = vec4({} x > 1. ? 1. : 0.);", repeat(n, |i| format!("x > {i}. && "))))
    }),
    ("commas", |n| main_image(&format!("{} x; o = vec4(x);", repeat(n, |_| "x += 1., ".into())))),
    ("functions", |n| {
        let functions = repeat(n, |i| format!("float f{i}(float x) {{ return x * {i}.; }}\n"));
        functions + &main_image(&format!("o = vec4({});", sum(n, |i| format!("f{i}(x)"))))
    }),
    ("a chain of functions", |n| {
        let functions = repeat(n, |i| format!("float f{}(float x) {{ return f{i}(x) + 1.; }}\n", i + 1));
        format!("float f0(float x) {{ return x; }}\n{functions}") + &main_image(&format!("o = vec4(f{n}(x));"))
    }),
    ("a chain of functions that hand an array on", |n| {
        let prototypes = repeat(n + 1, |i| format!("float f{i}(float a[4]);\n"));
        let entry = main_image(&format!("float a[4]; a[1] = x; o = vec4(f{n}(a));"));
        let functions =
            (0..n).rev().map(|i| format!("float f{}(float a[4]) {{ float b[4] = a; return f{i}(b); }}\n", i + 1));
        prototypes + &entry + &functions.collect::<String>() + "float f0(float a[4]) { return a[int(a[1])]; }\n"
    }),
    ("functions and globals that each writes", |n| {
        let functions = repeat(n, |i| {
            format!("float g{0}; float f{1}(float x) {{ g{0} += x; return f{0}(x) + g{0}; }}\n", i, i + 1)
        });
        format!("float f0(float x) {{ return x; }}\n{functions}") + &main_image(&format!("o = vec4(f{n}(x));"))
    }),
    ("locals", |n| {
        let locals = repeat(n, |i| format!("float a{i} = x * {i}.; a{i} += p.y; "));
        main_image(&format!("{locals} o = vec4({});", sum(n, |i| format!("a{i}"))))
    }),
    ("a zero copied from local to local", |n| {
        let locals = repeat(n, |i| format!("float a{} = a{i}; ", i + 1));
        main_image(&format!("float a0 = 0.; {locals} o = vec4(1. / a{n});"))
    }),
    ("globals", |n| {
        let globals = repeat(n, |i| format!("float g{i} = {i}.;\n"));
        let writes = repeat(n, |i| format!("g{i} += x; "));
        globals + &main_image(&format!("{writes} o = vec4({});", sum(n, |i| format!("g{i}"))))
    }),
    ("calls between writes of globals", |n| {
        let globals = repeat(n, |i| format!("float g{i} = {i}.;\n"));
        let function = "void f() { for (int i = 0; i < int(g0); i++) if (g1 > 0.) g1 += sin(g0); else discard; }\n";
        globals + function + &main_image(&repeat(n, |i| format!("g{i} += x; f(); ")))
    }),
    ("branches", |n| main_image(&(repeat(n, |i| format!("if (x > {i}.) x = sin(x + {i}.);\n")) + "o = vec4(x);"))),
    ("returns", |n| main_image(&repeat(n, |i| format!("if (x == {i}.) {{ o = vec4({i}); return; }}\n")))),
    ("loops", |n| {
        main_image(&(repeat(n, |i| format!("for (int i = 0; i < int(x); i++) x = sin(x + {i}.);\n")) + "o = vec4(x);"))
    }),
    ("loops over globals", |n| {
        let globals = repeat(n, |i| format!("float g{i};\n"));
        let loops = repeat(n, |i| format!("g{i} = x; for (int i = 0; i < int(x); i++) g{i} = sin(g{i});\n"));
        globals + &main_image(&(loops + "o = vec4(g0);"))
    }),
    ("do-while loops over locals", |n| {
        main_image(&repeat(n, |i| format!("float a{i} = x; do {{ a{i} = sin(a{i}); }} while (a{i} > .5);\n")))
    }),
    ("cases", |n| {
        let cases = repeat(n, |i| format!("case {i}: x = sin(x + {i}.); break;\n"));
        main_image(&format!("switch (int(x)) {{ {cases} }} o = vec4(x);"))
    }),
    ("cases that run into the next", |n| {
        let cases = repeat(n, |i| format!("case {i}: x = sin(x + {i}.);\n"));
        main_image(&format!("switch (int(x)) {{ {cases} }} o = vec4(x);"))
    }),
    ("a table", |n| {
        let numbers = vec!["1.5"; 10 * n].join(", ");
        format!("const float A[] = float[]({numbers});\n") + &main_image("o = vec4(A[int(x)]);")
    }),
    ("an array of what varies", |n| {
        let numbers = (0..n).map(|i| format!("x + {i}.")).collect::<Vec<_>>().join(", ");
        main_image(&format!("float a[] = float[]({numbers}); o = vec4(a[int(x)]);"))
    }),
    ("members of a structure", |n| {
        let members = repeat(n, |i| format!("float a{i}; "));
        let writes = repeat(n, |i| format!("s.a{i} = x + {i}.; "));
        let reads = sum(n, |i| format!("s.a{i}"));
        format!("struct S {{ {members} }};\n") + &main_image(&format!("S s; {writes} o = vec4({reads});"))
    }),
    ("a structure of many members that is copied", |n| {
        let members = repeat(n, |i| format!("float a{i}; "));
        let copies = repeat(32, |i| format!("S t{i} = s; t{i}.a1 = s.a0; s = t{i}; "));
        format!("struct S {{ {members} }};\n") + &main_image(&format!("S s; s.a0 = x; {copies} o = vec4(s.a1);"))
    }),
    ("structures", |n| {
        let structs = repeat(n, |i| format!("struct S{i} {{ float a; vec3 b; }};\n"));
        structs + &main_image(&repeat(n, |i| format!("S{i} s{i}; s{i}.a = x; ")))
    }),
    ("uses of a macro", |n| {
        "#define A(x) sin(x)\n".to_owned() + &main_image(&repeat(n, |i| format!("x += A(x * {i}.);\n")))
    }),
    ("macros that name each other", |n| {
        let macros = repeat(n, |i| format!("#define A{} A{i}\n", i + 1));
        format!("#define A0 p.x\n{macros}") + &main_image(&format!("o = vec4(A{n});"))
    }),
    ("parameters of a macro", |n| {
        let names = (0..n).map(|i| format!("a{i}")).collect::<Vec<_>>().join(",");
        let values = vec!["x"; n].join(",");
        format!("#define F({names}) {}\n", names.replace(',', "+")) + &main_image(&format!("o = vec4(F({values}));"))
    }),
    ("line numbers out of order", |n| {
        let lines = repeat(n, |_| "x += F(__LINE__,\n__LINE__);\n".into());
        "#define F(a, b) float(b - a)\n".to_owned() + &main_image(&lines)
    }),
    ("groups that are left out", |n| repeat(n, |i| format!("#ifdef A{i}\nfoo\n#else\n#endif\n")) + &main_image("")),
    ("overloads", |n| {
        let functions = repeat(n, |i| format!("float f(float a[{}]) {{ return a[0]; }}\n", i + 1));
        functions + &main_image(&format!("float a[1]; o = vec4({});", sum(n, |_| "f(a)".into())))
    }),
    ("arguments", |n| {
        let params = (0..n).map(|i| format!("inout float a{i}")).collect::<Vec<_>>().join(", ");
        let args = (0..n).map(|i| format!("a{i}")).collect::<Vec<_>>().join(", ");
        let function = format!("void f({params}) {{ {} }}\n", repeat(n, |i| format!("a{i} += 1.; ")));
        function + &main_image(&(repeat(n, |i| format!("float a{i} = x; ")) + &format!("f({args}); f({args});")))
    }),
    ("swizzles", |n| main_image(&format!("vec4 v = p.xyxy; o = v + v{};", ".wzyx".repeat(n)))),
    ("a line", |n| main_image(&" x = x * 1.5 + 2.; ".repeat(n))),
    ("a comment", |n| format!("/* {} */", "abc ".repeat(100 * n)) + &main_image("")),
    // Invalid texts are checked in linear time, too.
    ("brackets of the wrong kind", |n| main_image(&("(".repeat(10 * n) + &"]".repeat(10 * n)))),
    ("unknown names", |n| {
        let globals = repeat(n, |i| format!("float foob{i};\n"));
        globals + &main_image(&repeat(n, |i| format!("fooc{i} = 1.;\n")))
    }),
    ("mistakes in macros", |n| {
        let macros = repeat(n, |i| format!("#define A{i} (1 + 1.)\n"));
        macros + &main_image(&repeat(n, |i| format!("x = A{i};\n")))
    }),
    ("circles of calls", |n| {
        let prototypes = repeat(n, |i| format!("void f{i}();\n"));
        let functions = repeat(n, |i| format!("void f{i}() {{ f{}(); f0(); }}\n", (i + 1) % n));
        prototypes + &functions + &main_image("")
    }),
];

fn time(text: &str) -> Duration {
    let clock = Clock::now();
    let result = compile(text);
    let taken = clock.elapsed();
    drop(result);
    taken
}

/// Four times the text takes four times as long; quadratic work would be sixteen times.
#[test]
fn time_grows_with_the_text() {
    const PIECES: usize = 2500;
    const MAX_RATIO: f64 = 9.0;
    const ATTEMPTS: usize = 6;
    let mut slow = String::new();
    for (name, text) in TEXT_PATTERNS {
        let (small, large) = (text(PIECES), text(4 * PIECES));
        let mut ratios = Vec::new();
        while ratios.len() < ATTEMPTS && ratios.iter().all(|&ratio| ratio > MAX_RATIO) {
            let (first, second) = (time(&small), time(&large));
            // Very short times are too noisy to compare.
            let is_short = second < Duration::from_millis(30);
            ratios.push(if is_short { 0.0 } else { second.as_secs_f64() / first.as_secs_f64().max(0.004) });
            if std::env::var_os("EDDY_SHOW_TIMES").is_some() {
                eprintln!("{name}: {first:.0?}, {second:.0?}");
            }
        }
        if ratios.iter().all(|&ratio| ratio > MAX_RATIO) {
            let _ = writeln!(slow, "{name}: four times the text takes {ratios:.1?} times as long");
        }
    }
    assert!(slow.is_empty(), "{slow}");
}

/// The size of the program that a driver receives.
#[test]
fn programs_grow_with_the_text() {
    for (name, text) in TEXT_PATTERNS {
        let count = |pieces| compile(&text(pieces)).ok().map(|compiled| expressions(&compiled.module));
        let (Some(small), Some(large)) = (count(1000), count(4000)) else { continue };
        assert!(large <= 5 * small + 100, "{name}: {small} expressions, {large} for four times the text");
    }
}

fn expressions(module: &naga::Module) -> usize {
    let functions = module.functions.iter().map(|(_, f)| f.expressions.len());
    functions.chain(module.entry_points.iter().map(|e| e.function.expressions.len())).sum()
}

#[test]
fn exponential_inlining_is_an_error_at_the_function() {
    let swapped = repeat(30, |i| {
        let call = |a, b| format!("s{i}({a}, {b}, p)");
        let (one, other) = (call("a", "b"), call("b", "a"));
        format!("float s{}(sampler2D a, sampler2D b, vec2 p) {{ return {one} + {other}; }}\n", i + 1)
    });
    let first = "float s0(sampler2D a, sampler2D b, vec2 p) { return texture(a, p).x + texture(b, p).y; }\n";
    let plain = repeat(30, |i| format!("float s{}(vec2 p) {{ return s{i}(p) + s{i}(p * 1.1); }}\n", i + 1));
    for text in [
        format!("{first}{swapped}") + &main_image("o = vec4(s30(iChannel0, iChannel1, p));"),
        format!("float s0(vec2 p) {{ return p.x; }}\n{plain}") + &main_image("o = vec4(s30(p));"),
    ] {
        let errors = compile(&text).expect_err("a billion copies are rejected");
        assert_eq!(errors.len(), 1, "{errors:?}");
        assert!(errors[0].message.contains("with all calls inlined"), "{}", errors[0].message);
        let span = errors[0].span.expect("a place");
        assert!(text[span.range()].starts_with('s'), "{span:?}");
        assert_eq!(glsl::diagnose(&PassSource::image(&text)), errors);
    }
    // Unreachable calls are not an error.
    let text = format!("float s0(vec2 p) {{ return p.x; }}\n{plain}");
    assert!(compile(&(text.clone() + &main_image("o = vec4(1);"))).is_ok());
    assert!(compile(&(text + &main_image("o = vec4(1); if (false) o = vec4(s30(p));"))).is_ok());
}

#[test]
fn nested_constants_beyond_the_limit_are_an_error() {
    let big = "struct S { float a[100000]; float b; };\nconst float A[100000] = float[100000]";
    let numbers = vec!["1."; 100_000].join(",");
    let copies = repeat(1000, |i| format!("const S s{i} = S(A, {i}.);\n"));
    let text = format!("{big}({numbers});\n{copies}") + &main_image("o = vec4(s999.b);");
    let errors = compile(&text).expect_err("100 million numbers");
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert!(errors[0].message.contains("16777216 numbers"), "{}", errors[0].message);
}

/// A scene as written in GLSL ES 1.00: an array of structures, filled by one statement per member.
fn scene(parts: usize, first: &str) -> String {
    let fill = repeat(parts, |i| {
        format!(
            "c[{i}].a = vec3({0}.5, {1}, -1.5); c[{i}].b.yx = vec2(2, {0}); c[{i}].b.z = {0}.25; c[{i}].r = .5; \
             c[{i}].m = M(vec3(.{0}), vec2(1, {1}), {0}.);\n",
            i % 10,
            i % 7
        )
    });
    format!(
        "struct M {{ vec3 colour; vec2 shine; float k; }};\nstruct C {{ vec3 a; vec3 b; float r; M m; }};\nC \
         c[{parts}];\n\
         void fill() {{\n{fill}}}\nvoid mainImage(out vec4 o, in vec2 p) {{ {first} fill(); vec3 s = vec3(0);\n\
         for (int i = 0; i < {parts}; i++) s += c[i].a * c[i].r + c[i].b * c[i].m.k + c[i].m.colour * c[i].m.shine.x;\n\
         int at = int(p.x) % {parts}; o = vec4(s * .001 + c[at].b, 1); }}\n"
    )
}

#[test]
fn a_scene_in_an_array_of_structures_is_a_table() {
    let compiled = compile(&scene(54, "")).unwrap();
    assert_eq!(compiled.tables.len() % (54 * 16), 0);
    assert!(!compiled.tables.is_empty());
    // An array that is read before it is filled, or that is only partly filled, stays in memory.
    for first in ["o.x = c[int(p.y)].r;", "if (p.x > 9.) return;", "c[int(p.x)].r = 1.;", "c[3].r = p.x;"] {
        let is_table = !compile(&scene(54, first)).unwrap().tables.is_empty();
        assert_eq!(is_table, first.contains("return"), "{first}");
    }
}

#[test]
fn a_scene_in_an_array_of_structures_compiles_quickly() {
    let Some(table) = first_frame("a scene of 300 parts", &scene(300, ""), Duration::from_secs(10)) else { return };
    // A small scene is drawn the same as a table and as memory; a store that depends on the pixel makes it memory.
    let as_memory = scene(24, "if (p.x < -1.) c[0].r = p.x;");
    let [a, b] = [scene(24, ""), as_memory].map(|text| first_frame("24 parts", &text, Duration::from_secs(60)));
    assert_eq!(a, b);
    assert_ne!(a, Some(table));
}

#[test]
fn an_array_that_is_sorted_compiles_quickly() {
    let sorted = "struct S { vec2 at; float key; float kind; };\nvoid mainImage(out vec4 o, in vec2 p) {\nS s[24];\n\
                  for (int i = 0; i < 24; i++) s[i] = S(p * float(i), sin(p.x * float(i) + p.y), float(i));\n\
                  for (int i = 0; i < 24; i++) for (int j = 0; j < 24; j++)\n\
                  if (s[i].key < s[j].key) { S t = s[j]; s[j] = s[i]; s[i] = t; }\n\
                  int at = int(p.x) % 24; o = vec4(s[at].at * .01, s[at].key, s[at].kind / 24.); }\n";
    let Some(drawn) = first_frame("24 structures that are sorted", sorted, Duration::from_secs(20)) else { return };
    // The same with loops that a compiler cannot unroll.
    let plain = sorted.replace("i < 24", "i < 24 + min(iFrame, 0)").replace("j < 24", "j < 24 + min(iFrame, 0)");
    assert_eq!(first_frame("the same by loops", &plain, Duration::from_secs(60)), Some(drawn));
}
