//! `eddy bench`: the cost of a frame, by the clock, by pass on the GPU, and in the engine itself; and the savings from
//! omitting passes that are not read.

use super::{
    args::{BenchArgs, HostProgram},
    command::{CommandError, Run},
    lines,
    machine::{Machine, RunError},
    opening::{Opened, Opening},
    report::{Printer, Report},
    sweep,
};
use crate::{
    engine::{CostClock, PassRole},
    graph::{FramePlan, PassFacts},
    playback::{median, offline::Offline, script::ScriptedInputs},
    project::{PassName, Project},
};
use serde::Serialize;
use std::{collections::HashMap, fmt::Write, io};

/// The number of frames before the measured ones: the driver compiles, buffers fill, clock rates rise.
const WARM_UP: u32 = 10;

/// Medians over the measured frames.
#[derive(Debug, Serialize)]
struct Costs {
    width: u32,
    height: u32,
    device: String,
    /// The engine's own CPU time in microseconds for each pass it draws.
    cpu_us_per_pass: f64,
    /// The slowest frame.
    worst_ms: f64,
    /// The clock of the passes' `ms`: `timestamps` of the GPU, or `waited`: each pass is submitted and waited for
    /// separately.
    clock: &'static str,
    /// In drawing order.
    passes: Vec<PassCost>,
    /// The sum over the passes.
    moved_bytes: u64,
    /// Passes of the project that no requested picture depends on.
    passes_skipped: Vec<String>,
    /// Passes that are not drawn because their conditions are false.
    passes_off: Vec<PassOff>,
    /// The bytes of the targets, and how many more there would be if no pass were omitted.
    target_bytes: u64,
    target_bytes_saved: u64,
    /// Passes that a frame skipped because their inputs had not changed, and the bytes of texels whose writes this
    /// saved; means over the measured frames.
    passes_rested: f64,
    bytes_rested: f64,
}

/// A pass that is not drawn, and its condition.
#[derive(Debug, Serialize)]
struct PassOff {
    pass: String,
    #[serde(skip)]
    title: String,
    when: String,
    /// The number of draws that a frame would execute for it.
    steps: u32,
}

#[derive(Debug, Serialize)]
struct PassCost {
    pass: String,
    #[serde(skip)]
    title: String,
    /// `None` if the device has no timestamps.
    gpu_ms: Option<f64>,
    /// Milliseconds by the project's `clock`.
    ms: Option<f64>,
    /// Texels of its targets.
    width: u32,
    height: u32,
    /// The format of each of its targets, as `eddy.toml` spells them.
    formats: Vec<&'static str>,
    /// The number of draws per frame.
    steps: u32,
    /// The bytes of its textures, including mip levels, the second texture of a pair and the depth buffer.
    held_bytes: u64,
    /// The minimum bytes that a frame moves for it: its texels written, those of each pass it reads read once, at each
    /// step.
    moved_bytes: u64,
}

/// The report of `render`, and the costs.
#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(flatten)]
    costs: Option<&'a Costs>,
}

/// The report of `render`, and the counts of `--lines`.
#[derive(Serialize)]
struct CountsLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(flatten)]
    counted: Option<&'a lines::Counted>,
}

impl Run for BenchArgs {
    const OPENS_DEVICE: bool = true;

    fn hosted(&mut self) -> (Option<HostProgram>, Vec<&mut String>) {
        (self.run.guest, self.project.iter_mut().collect())
    }

    fn run(&mut self) -> Result<u8, CommandError> {
        let inputs = self.inputs()?;
        let sweep = sweep::combinations(&self.sweep)?;
        Ok(run(self, &sweep, &inputs)?)
    }
}

/// Measures every project with every combination of `sweep`.
fn run(args: &BenchArgs, sweep: &[Vec<String>], inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::of(&args.run);
    if args.lines {
        for spec in &args.project {
            let mut report = Report::new(spec);
            let counted = machine
                .attempt(&mut report, |machine, report| lines::measure(machine, report, args, spec, inputs.clone()));
            let words = counted.as_ref().map_or(String::new(), |counted| lines::words(&report, counted));
            printer.print_as(&CountsLine { report: &report, counted: counted.as_ref() }, &report, words.trim_end())?;
        }
        return Ok(printer.exit_code());
    }
    for (spec, swept) in args.project.iter().flat_map(|spec| sweep.iter().map(move |swept| (spec, swept))) {
        let mut report = Report::swept(spec, swept);
        let costs =
            machine.attempt(&mut report, |machine, report| measure(machine, report, args, spec, inputs.clone()));
        let words = costs.as_ref().map_or(String::new(), |c| words(&report, c));
        printer.print_as(&JsonLine { report: &report, costs: costs.as_ref() }, &report, words.trim_end())?;
    }
    Ok(printer.exit_code())
}

fn measure(
    machine: &mut Machine,
    report: &mut Report,
    args: &BenchArgs,
    spec: &str,
    inputs: ScriptedInputs,
) -> Result<Costs, RunError> {
    let Opened { project, mut offline, .. } = Opening::new(spec, &args.run, &inputs).open(machine, report)?;
    // A recording is measured from its first frame on, once for each clock.
    let is_replay = args.run.replay.is_some();
    for _ in 0..if is_replay { WARM_UP.min(args.frames()) } else { WARM_UP } {
        offline.draw()?;
    }
    if is_replay {
        offline.rewind()?;
    }
    let (mut millis, mut cpu) = (Vec::new(), Vec::new());
    let (mut passes_rested, mut bytes_rested) = (0, 0);
    for _ in 0..args.frames() {
        let frame = offline.draw()?;
        passes_rested += frame.stats.passes_cached;
        bytes_rested += frame.stats.bytes_cached;
        cpu.push(frame.cpu_millis * 1000.0 / frame.stats.passes_drawn.max(1) as f64);
        millis.push(frame.millis);
        report.frames += 1;
    }
    // Separately from the others: timestamps cost a little in every frame, and waiting for each pass more.
    let clock = offline.engine()?.cost_clock();
    if is_replay {
        offline.rewind()?;
    }
    let millis_of = pass_times(&mut offline, args.frames())?;
    let engine = offline.engine()?;
    let worst_ms = millis.iter().copied().fold(0.0, f64::max);
    report.frame_ms = median(millis);
    let (width, height) = engine.size();
    let (device, plan) = (engine.gpu().describe(), engine.program().map(|p| p.plan().clone()).unwrap_or_default());
    let drawable = drawable(&project);
    let costs = engine.pass_costs(&project);
    let passes_off = costs.iter().filter(|c| c.role == PassRole::Off).map(|cost| PassOff {
        pass: cost.pass.key().to_owned(),
        title: cost.pass.title(),
        when: cost.when.clone().unwrap_or_default(),
        steps: cost.steps,
    });
    let passes_off = passes_off.collect();
    let passes = costs.into_iter().filter(|c| matches!(c.role, PassRole::Drawn { .. }));
    let passes = passes.map(|cost| {
        let ms = millis_of.get(&cost.pass).copied();
        PassCost {
            pass: cost.pass.key().to_owned(),
            title: cost.pass.title(),
            gpu_ms: ms.filter(|_| clock == CostClock::Timestamps),
            ms,
            width: cost.size.0,
            height: cost.size.1,
            formats: cost.formats.iter().map(|f| f.name()).collect(),
            steps: cost.steps,
            held_bytes: cost.held_bytes,
            moved_bytes: cost.moved_bytes,
        }
    });
    let passes: Vec<PassCost> = passes.collect();
    let everything = FramePlan::new(&drawable, &vec![PassFacts::ANYTHING; drawable.passes.len()], &[], false);
    let target_bytes = plan.target_bytes((width, height));
    Ok(Costs {
        width,
        height,
        device,
        cpu_us_per_pass: median(cpu).unwrap_or_default(),
        worst_ms,
        clock: match clock {
            CostClock::Timestamps => "timestamps",
            CostClock::Waited => "waited",
        },
        moved_bytes: passes.iter().map(|p| p.moved_bytes).sum(),
        passes,
        passes_off,
        passes_skipped: plan.skipped.iter().map(|i| drawable.passes[*i].id.key().to_owned()).collect(),
        target_bytes,
        target_bytes_saved: everything.target_bytes((width, height)).saturating_sub(target_bytes),
        passes_rested: passes_rested as f64 / f64::from(args.frames()),
        bytes_rested: bytes_rested as f64 / f64::from(args.frames()),
    })
}

/// The median time of each pass in the frames in which it was drawn.
pub(super) fn pass_times(offline: &mut Offline, frames: u32) -> Result<HashMap<PassName, f64>, RunError> {
    let mut times: HashMap<PassName, Vec<f64>> = HashMap::new();
    for _ in 0..frames {
        for time in offline.draw_timed()? {
            times.entry(time.pass).or_default().push(time.gpu_millis);
        }
    }
    Ok(times.into_iter().filter_map(|(id, times)| Some((id, median(times)?))).collect())
}

/// The project as the engine plans it: without the passes it does not draw.
fn drawable(project: &Project) -> Project {
    let mut drawable = project.clone();
    drawable.passes.retain(|p| p.id.is_picture());
    drawable
}

fn words(report: &Report, costs: &Costs) -> String {
    let mut out = String::new();
    let mib = |bytes: f64| bytes / f64::from(1 << 20);
    let _ = writeln!(
        out,
        "{}: {:.3} ms per frame (slowest {:.3}), {} frames of {}x{} on {}",
        report.title(),
        report.frame_ms.unwrap_or_default(),
        costs.worst_ms,
        report.frames,
        costs.width,
        costs.height,
        costs.device
    );
    let name = costs.passes.iter().map(|p| p.title.chars().count()).max().unwrap_or_default().max(12);
    for pass in &costs.passes {
        let time = pass.ms.map_or("no time".into(), |ms| format!("{ms:.3} ms"));
        let size = format!("{}x{}", pass.width, pass.height);
        let steps = if pass.steps > 1 { format!(", {} steps", pass.steps) } else { String::new() };
        let _ = writeln!(
            out,
            "  {:name$} {time:>14}  {size:>9} {:8} {:>8.2} MiB memory {:>8.2} MiB traffic{steps}",
            pass.title,
            pass.formats.join(" "),
            mib(pass.held_bytes as f64),
            mib(pass.moved_bytes as f64),
        );
    }
    let sum: f64 = costs.passes.iter().filter_map(|p| p.ms).sum();
    let held: u64 = costs.passes.iter().map(|p| p.held_bytes).sum();
    let _ = writeln!(
        out,
        "  {:name$} {sum:>11.3} ms  {:18} {:>8.2} MiB memory {:>8.2} MiB traffic",
        "all passes",
        "",
        mib(held as f64),
        mib(costs.moved_bytes as f64)
    );
    if costs.clock == "waited" {
        out.push_str("  (this GPU has no timestamps: each pass was submitted and timed separately by wall clock)\n");
    }
    let _ = writeln!(out, "  {:12} {:>11.1} µs per pass and frame", "engine", costs.cpu_us_per_pass);
    let _ = writeln!(out, "  {:12} {:>10.1} MiB", "targets", mib(costs.target_bytes as f64));
    if costs.target_bytes_saved > 0 || !costs.passes_skipped.is_empty() {
        let _ = writeln!(
            out,
            "  {:12} {} of {} passes, {:.1} MiB",
            "skipped",
            costs.passes_skipped.len(),
            costs.passes_skipped.len() + costs.passes.len(),
            mib(costs.target_bytes_saved as f64)
        );
    }
    for off in &costs.passes_off {
        let times = if off.steps > 1 { format!(", {} steps", off.steps) } else { String::new() };
        let _ = writeln!(out, "  {:12} {}{times}: {} is false", "not drawn", off.title, off.when);
    }
    if costs.passes_rested > 0.0 {
        let _ = writeln!(
            out,
            "  {:12} {:.1} passes per frame, as their inputs had not changed: {:.1} MiB not written",
            "unchanged",
            costs.passes_rested,
            mib(costs.bytes_rested)
        );
    }
    out
}
