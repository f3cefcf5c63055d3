//! `eddy bench --lines`: what the pixels of each pass execute, line by line, and its part of the time.

use super::{
    args::BenchArgs,
    machine::{Machine, RunError},
    opening::{Opened, Opening},
    report::Report,
    terminal::one_line,
};
use crate::{
    engine::{
        BuildError, EngineError, PassTime,
        counts::{LineCounts, LoopCounts, PassCounts},
    },
    glsl::count::Line,
    playback::{median, prices, script::ScriptedInputs},
    project::{PassName, Project},
};
use serde::Serialize;
use std::{collections::BTreeMap, fmt::Write};

/// The default of `--top`: the lines of the table.
const TOP: usize = 20;

/// The default of `--frames`: how often the frame is timed.
const TIMES: u32 = 15;

/// The counts of a project.
#[derive(Debug, Serialize)]
pub(super) struct Counted {
    width: u32,
    height: u32,
    device: String,
    frame: u32,
    passes: Vec<PassReport>,
}

#[derive(Debug, Serialize)]
struct PassReport {
    pass: String,
    #[serde(skip)]
    title: String,
    /// The median time of the pass in this frame; null if the device gave none.
    ms: Option<f64>,
    /// The reason why the pass could not be counted.
    #[serde(skip_serializing_if = "Option::is_none")]
    uncounted: Option<String>,
    #[serde(flatten)]
    counts: Option<Counts>,
}

#[derive(Debug, Serialize)]
struct Counts {
    width: u32,
    height: u32,
    pixels: u64,
    steps: u32,
    /// The time that the counts and the device's prices predict.
    predicted_ms: f64,
    /// Texture reads per pixel.
    texture_reads: f64,
    discarded: u64,
    /// Largest cost over mean cost of a pixel in tiles of 8 by 4.
    divergence: f64,
    costliest: Option<Costliest>,
    lines: Vec<LineReport>,
    loops: Vec<LoopReport>,
    /// Lines that no pixel reached.
    unreached: Vec<Place>,
}

/// The pixel with the largest cost.
#[derive(Debug, Serialize)]
struct Costliest {
    pixel: [u32; 2],
    face: u32,
    /// Its cost over the mean of all pixels.
    times_mean: f64,
}

#[derive(Clone, Debug, Serialize)]
struct Place {
    source: String,
    line: u32,
    text: String,
}

#[derive(Debug, Serialize)]
struct LineReport {
    #[serde(flatten)]
    place: Place,
    /// Its part of the time of the pass, from 0 to 1.
    share: f64,
    /// The number of times that a pixel runs it, in the mean.
    runs: f64,
    /// Texture reads per pixel.
    texture_reads: f64,
    /// Operations per pixel by class.
    operations: BTreeMap<&'static str, f64>,
}

#[derive(Debug, Serialize)]
struct LoopReport {
    #[serde(flatten)]
    place: Place,
    depth: u32,
    /// The number of times that a pixel reaches it, in the mean.
    entries: f64,
    /// Iterations each time it is reached.
    mean: f64,
    max: f64,
}

/// Counts and measures a frame of a project.
pub(super) fn measure(
    machine: &mut Machine,
    report: &mut Report,
    args: &BenchArgs,
    spec: &str,
    inputs: ScriptedInputs,
) -> Result<Counted, RunError> {
    let mut opening = Opening::new(spec, &args.run, &inputs);
    if let Some(picture) = &args.pass {
        opening = opening.pass(&picture.pass);
    }
    let Opened { project, mut offline, .. } = opening.open(machine, report)?;
    let frame = args.at.unwrap_or(0);
    for _ in 0..frame {
        offline.advance()?;
    }
    let times = offline.draw_repeatedly(args.frames.unwrap_or(TIMES))?;
    report.frames = frame + 1;
    let engine = offline.engine()?;
    let (size, device) = (engine.size(), engine.gpu().describe());
    let drawn: Vec<PassName> = engine.pass_costs(&project).into_iter().map(|cost| cost.pass).collect();
    let is_wanted = |pass: &&PassName| args.pass.as_ref().is_none_or(|picture| picture.pass == **pass);
    let cache_dir = dirs::cache_dir().map(|dir| dir.join("eddy"));
    let prices = prices::of_device(engine.gpu(), cache_dir.as_deref())?;
    let mut passes = Vec::new();
    for pass in drawn.iter().filter(is_wanted) {
        let of_pass = |frame: &Vec<PassTime>| Some(frame.iter().find(|time| time.pass == *pass)?.gpu_millis);
        let ms = median(times.iter().filter_map(of_pass).collect());
        let counted = offline.counting(&project, pass);
        let counted = counted.and_then(|program| Ok(offline.count(&program, &prices)?));
        let (uncounted, counts) = match counted {
            Ok(counts) => (None, Some(Counts::new(&project, &counts, args))),
            Err(BuildError::Engine(
                why @ (EngineError::Uncounted { .. } | EngineError::Off { .. } | EngineError::Overwritten { .. }),
            )) => (Some(why.to_string()), None),
            Err(error) => return Err(error.into()),
        };
        passes.push(PassReport { pass: pass.key().to_owned(), title: pass.title(), ms, uncounted, counts });
    }
    Ok(Counted { width: size.0, height: size.1, device, frame, passes })
}

impl Counts {
    fn new(project: &Project, counts: &PassCounts, args: &BenchArgs) -> Self {
        let sources = project.sources();
        let place = |line: Line| {
            let source = sources.get(line.source);
            let text = source.and_then(|source| source.text.lines().nth(line.number as usize - 1));
            Place {
                source: source.map(|source| source.name.clone()).unwrap_or_default(),
                line: line.number,
                text: text.unwrap_or_default().trim().to_owned(),
            }
        };
        let pixels = counts.pixels.max(1) as f64;
        let mut lines = counts.lines();
        let unreached = lines.iter().filter(|line| line.runs == 0).map(|line| place(line.line)).collect();
        lines.sort_by(|a, b| b.share.total_cmp(&a.share));
        let most = args.top.or((!args.json).then_some(TOP));
        lines.truncate(most.unwrap_or(usize::MAX));
        let line = |counted: &LineCounts| LineReport {
            place: place(counted.line),
            share: counted.share,
            runs: counted.runs as f64 / pixels,
            texture_reads: counted.texture_reads() as f64 / pixels,
            operations: counted
                .operations
                .iter()
                .map(|(class, count)| (class.name(), *count as f64 / pixels))
                .collect(),
        };
        let repeated = |counted: LoopCounts| LoopReport {
            place: place(counted.line),
            depth: counted.depth,
            entries: counted.runs.entries as f64 / pixels,
            mean: counted.runs.mean(),
            max: counted.runs.most,
        };
        let costliest = counts.costliest().map(|(x, y, face)| {
            let mean = counts.costs.iter().map(|cost| f64::from(*cost)).sum::<f64>() / pixels;
            let cost = f64::from(counts.cost_at((x, y), face).unwrap_or_default());
            Costliest { pixel: [x, y], face, times_mean: if mean > 0.0 { cost / mean } else { 1.0 } }
        });
        Self {
            width: counts.size.0,
            height: counts.size.1,
            pixels: counts.pixels,
            steps: counts.steps,
            predicted_ms: counts.predicted_millis(),
            texture_reads: counts.texture_reads(),
            discarded: counts.discarded,
            divergence: counts.mean_divergence(),
            costliest,
            lines: lines.iter().map(line).collect(),
            loops: counts.loops().into_iter().map(repeated).collect(),
            unreached,
        }
    }
}

/// Returns the table of a project.
pub(super) fn words(report: &Report, counted: &Counted) -> String {
    let mut out = String::new();
    let Counted { width, height, device, frame, passes } = counted;
    let _ = writeln!(out, "{}: frame {frame} at {width}x{height} on {device}", report.title());
    for pass in passes {
        let ms = |ms: Option<f64>| ms.map_or_else(|| "no time".into(), |ms| format!("{ms:.3} ms"));
        let _ = write!(out, "{}: {}", pass.title, ms(pass.ms));
        match (&pass.counts, &pass.uncounted) {
            (Some(counts), _) => words_of_pass(&mut out, counts),
            (None, why) => {
                let _ = writeln!(out, "; {}", why.as_deref().unwrap_or_default());
            }
        }
    }
    out
}

fn words_of_pass(out: &mut String, counts: &Counts) {
    let _ = write!(out, " measured, {:.3} ms predicted from its counts", counts.predicted_ms);
    if counts.steps > 1 {
        let _ = write!(out, " of the last of {} steps", counts.steps);
    }
    let _ = write!(out, "; {:.1} texture reads per pixel", counts.texture_reads);
    let _ = writeln!(out, "; divergence {:.2}", counts.divergence);
    if let Some(Costliest { pixel: [x, y], face, times_mean }) = counts.costliest {
        let face = if face > 0 { format!(" of face {face}") } else { String::new() };
        let _ = writeln!(out, "  costliest pixel: {x},{y}{face}, {times_mean:.1} times the mean");
    }
    if counts.discarded > 0 {
        let _ = writeln!(out, "  discarded: {} of {} pixels", counts.discarded, counts.pixels);
    }
    let at = |place: &Place| format!("{}:{}", one_line(&place.source), place.line);
    let wide = counts.lines.iter().map(|line| at(&line.place).chars().count()).max().unwrap_or(0);
    for line in &counts.lines {
        let (at, text) = (at(&line.place), one_line(&line.place.text).into_owned());
        let _ = writeln!(out, "  {:>5.1} %  {:>9.2} per pixel  {at:wide$}  {text}", 100.0 * line.share, line.runs);
    }
    for repeated in &counts.loops {
        let indent = "  ".repeat(repeated.depth as usize);
        let _ = writeln!(
            out,
            "  loop {}{indent}  {:.2} iterations in the mean, {:.0} at most, {:.2} times per pixel",
            at(&repeated.place),
            repeated.mean,
            repeated.max,
            repeated.entries
        );
    }
    for place in &counts.unreached {
        let _ = writeln!(out, "  no pixel reaches {}  {}", at(place), one_line(&place.text));
    }
}
