//! Measures the front end: `cargo bench --bench front_end`.
//!
//! Measures every pass of the presets, or of the projects named in the file that `EDDY_CORPUS` points to (one per line,
//! as on the command line: folders, Shadertoy JSON files). Single-threaded, with the best of a few runs per pass, so
//! that other load on the machine has little effect.

use eddy::{
    diag::SourceId,
    engine::{channel_kinds, pass_kind},
    glsl::{self, PassSource, Text, services::Analysis},
    project::{self, Project},
};
use std::time::{Duration, Instant};

const RUNS: usize = 3;

/// The times of one pass.
struct Row {
    name: String,
    lines: usize,
    /// Preprocessing, parsing and checking: an editor waits for this.
    check: Duration,
    /// The same with everything that an editor needs: repeated after each keystroke.
    analyse: Duration,
    /// Completion in the last line of code, where most names are in scope, and every colour.
    ask: Duration,
    /// All stages up to the validated module; `None` if the pass has errors.
    compile: Option<Duration>,
}

fn main() {
    let specs: Vec<String> = match std::env::var("EDDY_CORPUS") {
        Ok(list) => std::fs::read_to_string(&list).expect("the list can be read").lines().map(str::to_owned).collect(),
        Err(_) => project::presets::names().iter().map(|n| (*n).to_owned()).collect(),
    };
    let mut rows = vec![measure_long()];
    let mut unread = 0;
    for spec in &specs {
        match project::load(spec) {
            Ok(loaded) => (0..loaded.project.passes.len()).for_each(|i| rows.push(measure(spec, &loaded.project, i))),
            Err(error) => {
                unread += 1;
                eprintln!("{spec}: {error}");
            }
        }
    }
    let long = &rows[0];
    println!(
        "{} ({} lines): parse and check {:?}, analysed {:?}, colours and a completion {:?}",
        long.name, long.lines, long.check, long.analyse, long.ask
    );
    println!("{} projects ({unread} unreadable), {} passes", specs.len(), rows.len() - 1);
    rows.remove(0);
    say("parse and check", &rows.iter().map(|r| (r.check, r)).collect::<Vec<_>>());
    say("analysed for an editor", &rows.iter().map(|r| (r.analyse, r)).collect::<Vec<_>>());
    say("colours and a completion", &rows.iter().map(|r| (r.ask, r)).collect::<Vec<_>>());
    say("to a validated module", &rows.iter().filter_map(|r| Some((r.compile?, r))).collect::<Vec<_>>());
}

fn say(what: &str, times: &[(Duration, &Row)]) {
    let mut sorted: Vec<Duration> = times.iter().map(|t| t.0).collect();
    sorted.sort();
    let (Some(median), Some(worst)) = (sorted.get(sorted.len() / 2), times.iter().max_by_key(|t| t.0)) else { return };
    let mean = sorted.iter().sum::<Duration>() / sorted.len() as u32;
    let millis = |d: Duration| d.as_secs_f64() * 1e3;
    println!(
        "{what}: mean {:.3} ms, median {:.3} ms, worst {:.2} ms ({}, {} lines)",
        millis(mean),
        millis(*median),
        millis(worst.0),
        worst.1.name,
        worst.1.lines
    );
}

/// Measures a shader of two thousand lines: an editor must keep up with it.
fn measure_long() -> Row {
    let function = |i: usize| {
        let callee = i.saturating_sub(1);
        format!(
            "// Distance to part {i}.\nfloat part{i}(vec3 p, float r) {{\n    \
             vec3 q = abs(p - vec3({i}.0, 0.5, sin(iTime))) - r;\n    \
             float d = length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);\n    \
             for (int i = 0; i < 3; i++) {{\n        \
             d = min(d, dot(q.xy, q.yz) * float(i));\n    }}\n    return {}d;\n}}\n\n",
            if i == 0 { String::new() } else { format!("part{callee}(q, r) + ") }
        )
    };
    let mut text: String = (0..200).map(function).collect();
    text.push_str("void mainImage(out vec4 o, in vec2 p) {\n    o = vec4(part199(vec3(p, 1.0), 0.5));\n}\n");
    let mut project = project::presets::load(project::presets::names()[0]).expect("a preset").project;
    let index = project.passes.iter().position(|p| p.id.is_image()).expect("an Image");
    project.common = None;
    project.passes[index].source.text = text.into();
    measure("two thousand lines", &project, index)
}

fn measure(spec: &str, project: &Project, index: usize) -> Row {
    let pass = &project.passes[index];
    let common = project.common.as_ref().map(|c| c.compile_text());
    let code = pass.source.compile_text();
    let source = PassSource {
        common: common.as_deref().map(|text| Text { id: SourceId(0), text }),
        channels: channel_kinds(pass),
        ..PassSource::new(pass_kind(project, pass), Text { id: SourceId(1), text: &code })
    };
    let analysis = Analysis::new(&source);
    let last_line = code.trim_end().trim_end_matches('}').len();
    let ask = || {
        std::hint::black_box(analysis.classes(SourceId(1)));
        Some(analysis.completions(SourceId(1), last_line).matching("si"))
    };
    Row {
        name: format!("{spec} {}", pass.id.title()),
        lines: source.common.iter().chain([&source.code]).map(|t| t.text.lines().count()).sum(),
        check: best(|| Some(glsl::diagnose(&source))).unwrap_or_default(),
        analyse: best(|| Some(Analysis::new(&source))).unwrap_or_default(),
        ask: best(ask).unwrap_or_default(),
        compile: best(|| glsl::compile(&source).ok()),
    }
}

/// Returns the shortest of a few runs; `None` if one returned nothing.
fn best<T>(mut run: impl FnMut() -> Option<T>) -> Option<Duration> {
    (0..RUNS)
        .map(|_| {
            let begin = Instant::now();
            let result = std::hint::black_box(run());
            let time = begin.elapsed();
            result.map(|_| time)
        })
        .collect::<Option<Vec<_>>>()?
        .into_iter()
        .min()
}
