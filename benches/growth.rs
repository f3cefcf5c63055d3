//! Measures how the time of reading a file grows with its size, at one, two and four times a size:
//! `cargo bench --bench growth`. A ratio near that of the sizes is linear; sixteen times the time for four times the text
//! is quadratic.

use eddy::{
    diag::{SourceMap, render_all},
    glsl::{PassSource, diagnose},
    project::{self, ProjectError, json},
};
use std::{fs, path::Path, time::Instant};

/// The approximate number of bytes in the smallest text of a kind.
const BYTES: usize = 100_000;

type Text = fn(usize) -> String;

/// The reader of a text.
#[derive(Clone, Copy)]
enum Reader {
    /// Read by the front end, with its messages rendered.
    Pass,
    /// Read as a project, in a file of this name, with its messages rendered.
    Project(&'static str),
    /// Read as a project that is exported as JSON.
    Exported(&'static str),
}

fn main() {
    let kinds: [(&str, Reader, Text); 11] = [
        ("unknown functions", Reader::Pass, |n| {
            repeated(n / 100, |i| format!("float name_of_function_{i}(float x) {{ return x; }}\n"))
                + &entry(&repeated(n / 100, |i| format!("color.x = nam_of_functio_{i}x(1.0);\n")))
        }),
        ("unknown members", Reader::Pass, |n| {
            format!("struct S {{ {} }};\n", repeated(n / 80, |i| format!("float member_name_{i};\n")))
                + &entry(&format!("S s; {}", repeated(n / 80, |i| format!("color.x = s.membr_nam_{i};\n"))))
        }),
        ("#if 0", Reader::Pass, |n| repeated(n / 17, |_| "#if 0\nx\n#endif\n".into()) + &entry("")),
        ("#error", Reader::Pass, |n| format!("#error {}\n", "x".repeat(n)) + &entry("")),
        ("macros", Reader::Pass, |n| repeated(n / 20, |i| format!("#define M{i} {i}.0\n")) + &entry("")),
        ("statements", Reader::Pass, |n| entry(&repeated(n / 16, |_| "color.x += 1.0;\n".into()))),
        ("unknown keys", Reader::Project("eddy.toml"), |n| {
            "[passes.image]\n".to_owned() + &repeated(n / 15, |i| format!("key{i} = 1\n"))
        }),
        ("#iUniform", Reader::Project("a.glsl"), |n| {
            repeated(n / 400, |i| format!("#iUniform float name{i} = 1.0 in {{0.0, 2.0}}\n")) + &entry("")
        }),
        ("passes of ISF", Reader::Project("a.fs"), |n| {
            let passes = repeated(n / 500, |i| format!("{{\"TARGET\":\"t{i}\"}},"));
            format!("/*{{\"ISFVSN\":\"2\",\"PASSES\":[{passes}{{}}]}}*/\nvoid main() {{ gl_FragColor = vec4(1.0); }}\n")
        }),
        ("comments, as JSON", Reader::Exported("a.glsl"), |n| repeated(n / 12, |_| "// comment\n".into()) + &entry("")),
        ("draws", Reader::Project("eddy.toml"), |n| {
            let draws =
                repeated(n / 400, |i| format!("[[passes.image.draws]]\nmesh = \"cube\"\ninstances = {}\n", i + 1));
            "[passes.image]\n".to_owned() + &draws
        }),
    ];
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, reader, text) in kinds {
        let times = [1, 2, 4].map(|times| {
            let text = text(times * BYTES);
            let mut all: Vec<f64> = (0..5).map(|_| timed(reader, &text, folder.path())).collect();
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

/// Returns the seconds of reading.
fn timed(reader: Reader, text: &str, folder: &Path) -> f64 {
    let (Reader::Project(name) | Reader::Exported(name)) = reader else {
        let mut sources = SourceMap::default();
        sources.add("a.glsl", text);
        let start = Instant::now();
        std::hint::black_box(render_all(&diagnose(&PassSource::image(text)), &sources));
        return start.elapsed().as_secs_f64();
    };
    let path = folder.join(name);
    fs::write(&path, text).expect("a file can be written");
    fs::write(folder.join("image.glsl"), entry("")).expect("a file can be written");
    let spec = if name == "eddy.toml" { folder } else { &path };
    let start = Instant::now();
    match project::load(spec.to_str().expect("a path in UTF-8")) {
        Ok(loaded) if matches!(reader, Reader::Exported(_)) => {
            drop(std::hint::black_box(json::export(&loaded.project)))
        }
        Err(ProjectError::Invalid { diagnostics, sources, .. }) => {
            drop(std::hint::black_box(render_all(&diagnostics, &sources)));
        }
        loaded => drop(std::hint::black_box(loaded)),
    }
    let time = start.elapsed().as_secs_f64();
    fs::remove_file(path).expect("a file can be removed");
    time
}

fn repeated(count: usize, one: impl Fn(usize) -> String) -> String {
    (0..count).map(one).collect()
}

fn entry(body: &str) -> String {
    format!("void mainImage(out vec4 color, in vec2 at) {{ color = vec4(1.0);\n{body}}}\n")
}
