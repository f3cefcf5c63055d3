//! Measures how the time of a check grows with a text of one kind, at one, two and four times a size: `cargo bench --bench
//! growth`. A ratio near the size's is linear; four times the text in sixteen times the time is quadratic.

use eddy::glsl::{PassSource, diagnose};
use std::time::Instant;

/// Bytes of the smallest text of a kind, about.
const BYTES: usize = 100_000;

type Text = fn(usize) -> String;

fn main() {
    let kinds: [(&str, Text); 6] = [
        ("unknown functions", |n| {
            repeated(n / 100, |i| format!("float name_of_function_{i}(float x) {{ return x; }}\n"))
                + &entry(&repeated(n / 100, |i| format!("color.x = nam_of_functio_{i}x(1.0);\n")))
        }),
        ("unknown members", |n| {
            format!("struct S {{ {} }};\n", repeated(n / 80, |i| format!("float member_name_{i};\n")))
                + &entry(&format!("S s; {}", repeated(n / 80, |i| format!("color.x = s.membr_nam_{i};\n"))))
        }),
        ("#if 0", |n| repeated(n / 17, |_| "#if 0\nx\n#endif\n".into()) + &entry("")),
        ("#error", |n| format!("#error {}\n", "x".repeat(n)) + &entry("")),
        ("macros", |n| repeated(n / 20, |i| format!("#define M{i} {i}.0\n")) + &entry("")),
        ("statements", |n| entry(&repeated(n / 16, |_| "color.x += 1.0;\n".into()))),
    ];
    for (name, text) in kinds {
        let times = [1, 2, 4].map(|times| {
            let text = text(times * BYTES);
            let mut all: Vec<f64> = (0..5).map(|_| timed(&text)).collect();
            all.sort_by(f64::total_cmp);
            all[2]
        });
        println!(
            "{name:<20} {:8.2} ms, 2x the text: {:.1}x, 4x: {:.1}x",
            times[0] * 1e3,
            times[1] / times[0],
            times[2] / times[0]
        );
    }
}

fn timed(text: &str) -> f64 {
    let start = Instant::now();
    std::hint::black_box(diagnose(&PassSource::image(text)));
    start.elapsed().as_secs_f64()
}

fn repeated(count: usize, one: impl Fn(usize) -> String) -> String {
    (0..count).map(one).collect()
}

fn entry(body: &str) -> String {
    format!("void mainImage(out vec4 color, in vec2 at) {{ color = vec4(1.0);\n{body}}}\n")
}
