//! How long the front end takes: `cargo bench --bench front_end`.
//!
//! Measures every pass of the presets, or of the projects named in the file that `EDDY_CORPUS` points to (one a line, as on
//! the command line: folders, Shadertoy JSON files). One thread, each pass the best of a few runs, so that what else the
//! machine does counts little.

use eddy::{
    diag::SourceId,
    glsl::{self, ChannelKind, PassKind, PassSource, Text},
    project::{self, Input, PassId, Project},
};
use std::time::{Duration, Instant};

const RUNS: usize = 3;

/// One pass's times.
struct Row {
    name: String,
    lines: usize,
    /// Preprocessing, parsing and checking: what an editor waits for.
    check: Duration,
    /// All of it, to the validated module; `None` where the pass has errors.
    compile: Option<Duration>,
}

fn main() {
    let specs: Vec<String> = match std::env::var("EDDY_CORPUS") {
        Ok(list) => std::fs::read_to_string(&list).expect("the list can be read").lines().map(str::to_owned).collect(),
        Err(_) => project::presets::names().iter().map(|n| (*n).to_owned()).collect(),
    };
    let mut rows = Vec::new();
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
    println!("{} projects ({unread} unreadable), {} passes", specs.len(), rows.len());
    say("parse and check", &rows.iter().map(|r| (r.check, r)).collect::<Vec<_>>());
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

fn measure(spec: &str, project: &Project, index: usize) -> Row {
    let pass = &project.passes[index];
    let common = project.common.as_ref().map(|c| c.compile_text());
    let code = pass.source.compile_text();
    let source = PassSource {
        kind: match pass.id {
            PassId::Image => PassKind::Image,
            PassId::Buffer(_) => PassKind::Buffer,
            PassId::Cubemap => PassKind::Cubemap,
            PassId::Sound => PassKind::Sound,
        },
        common: common.as_deref().map(|text| Text { id: SourceId(0), text }),
        code: Text { id: SourceId(1), text: &code },
        channels: std::array::from_fn(|i| match pass.channels[i].as_ref().map(|c| &c.input) {
            Some(Input::Cubemap(_) | Input::CubemapPass) => ChannelKind::SamplerCube,
            Some(Input::Volume(_)) => ChannelKind::Sampler3D,
            _ => ChannelKind::Sampler2D,
        }),
        bilinear_by_hand: [false; 4],
        tables_in_memory: false,
    };
    Row {
        name: format!("{spec} {}", pass.id.title()),
        lines: source.common.iter().chain([&source.code]).map(|t| t.text.lines().count()).sum(),
        check: best(|| Some(glsl::diagnose(&source))).unwrap_or_default(),
        compile: best(|| glsl::compile(&source).ok()),
    }
}

/// The shortest of a few runs; `None` if one gave nothing.
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
