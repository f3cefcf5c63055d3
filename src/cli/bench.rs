//! `eddy bench`: what a frame costs, by the clock, by pass on the device, and in the engine itself; and what leaving out
//! what nobody reads is worth.

use super::{
    args::BenchArgs,
    machine::{Machine, Trouble, median, millis_since, open},
    report::{Printer, Report},
};
use crate::{
    engine::Engine,
    graph::{FramePlan, PassFacts, TargetKind},
    project::{PassId, Project},
    session::script::ScriptedInputs,
};
use serde::Serialize;
use std::{collections::HashMap, fmt::Write, io, time::Instant};

/// Frames before the measured ones: the driver compiles, buffers fill, clocks rise.
const WARM_UP: u32 = 10;

/// Medians over the measured frames.
#[derive(Debug, Serialize)]
struct Costs {
    width: u32,
    height: u32,
    device: String,
    /// Microseconds the engine itself needs on the processor for each pass it draws.
    cpu_us_per_pass: f64,
    /// The slowest frame.
    worst_ms: f64,
    /// In drawing order.
    passes: Vec<PassCost>,
    /// Passes of the project that no wanted picture needs.
    passes_skipped: Vec<String>,
    /// Bytes of the targets, and how many more they were if nothing were left out.
    target_bytes: u64,
    target_bytes_saved: u64,
    /// Passes that a frame left out because nothing they read had changed, and the bytes of texels not written for it; means
    /// over the measured frames.
    passes_rested: f64,
    bytes_rested: f64,
}

#[derive(Debug, Serialize)]
struct PassCost {
    pass: String,
    #[serde(skip)]
    title: String,
    /// `None` where the device has no timestamps.
    gpu_ms: Option<f64>,
}

/// The report of `render`, and the costs.
#[derive(Serialize)]
struct Line<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(flatten)]
    costs: Option<&'a Costs>,
}

pub fn run(args: &BenchArgs, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::default();
    for spec in &args.project {
        let mut report = Report::new(spec);
        let costs =
            machine.attempt(&mut report, |machine, report| measure(machine, report, args, spec, inputs.clone()));
        let words = costs.as_ref().map_or(String::new(), |c| words(&report, c));
        printer.print_as(&Line { report: &report, costs: costs.as_ref() }, &report, words.trim_end())?;
    }
    Ok(printer.exit_code())
}

fn measure(
    machine: &mut Machine,
    report: &mut Report,
    args: &BenchArgs,
    spec: &str,
    mut inputs: ScriptedInputs,
) -> Result<Costs, Trouble> {
    let (project, mut engine) = open(machine, report, spec, &args.run, &PassId::Image)?;
    for _ in 0..WARM_UP {
        engine.draw(&inputs.next_frame())?;
        engine.gpu().wait()?;
    }
    let (mut millis, mut cpu) = (Vec::new(), Vec::new());
    let (mut passes_rested, mut bytes_rested) = (0, 0);
    for _ in 0..args.frames {
        let inputs = inputs.next_frame();
        let began = Instant::now();
        let stats = engine.draw(&inputs)?;
        let drawn = stats.passes_drawn;
        passes_rested += stats.passes_rested;
        bytes_rested += stats.bytes_rested;
        cpu.push(millis_since(began) * 1000.0 / drawn.max(1) as f64);
        engine.gpu().wait()?;
        millis.push(millis_since(began));
        report.frames += 1;
    }
    // Apart from the others: timestamps cost a little in every frame.
    let gpu_millis = pass_times(&mut engine, &mut inputs, args.frames)?;
    let worst_ms = millis.iter().copied().fold(0.0, f64::max);
    report.frame_ms = median(millis);
    let (width, height) = args.run.size;
    let (device, plan) = (engine.gpu().describe(), engine.program().map(|p| p.plan().clone()).unwrap_or_default());
    let drawable = drawable(&project);
    let passes = plan.draws.iter().map(|d| &drawable.passes[d.pass].id);
    let everything = FramePlan::new(&drawable, &vec![PassFacts::ANYTHING; drawable.passes.len()], &[], false);
    let target_bytes = bytes(&plan, width, height);
    Ok(Costs {
        width,
        height,
        device,
        cpu_us_per_pass: median(cpu).unwrap_or_default(),
        worst_ms,
        passes: passes
            .map(|id| PassCost { pass: id.key(), title: id.title(), gpu_ms: gpu_millis.get(id).copied() })
            .collect(),
        passes_skipped: plan.skipped.iter().map(|i| drawable.passes[*i].id.key()).collect(),
        target_bytes,
        target_bytes_saved: bytes(&everything, width, height).saturating_sub(target_bytes),
        passes_rested: passes_rested as f64 / f64::from(args.frames),
        bytes_rested: bytes_rested as f64 / f64::from(args.frames),
    })
}

/// Median time of each pass on the device; empty where it has no timestamps.
fn pass_times(engine: &mut Engine, inputs: &mut ScriptedInputs, frames: u32) -> Result<HashMap<PassId, f64>, Trouble> {
    let mut times: HashMap<PassId, Vec<f64>> = HashMap::new();
    if engine.set_timing(true) {
        for _ in 0..frames {
            engine.draw(&inputs.next_frame())?;
            engine.gpu().wait()?;
            for time in engine.pass_times().unwrap_or_default() {
                times.entry(time.pass).or_default().push(time.gpu_millis);
            }
        }
    }
    Ok(times.into_iter().filter_map(|(id, times)| Some((id, median(times)?))).collect())
}

/// The project as the engine plans it: without the passes it does not draw.
fn drawable(project: &Project) -> Project {
    let mut drawable = project.clone();
    drawable.passes.retain(|p| !matches!(p.id, PassId::Cubemap | PassId::Sound));
    drawable
}

/// What the targets of a plan take on the device.
fn bytes(plan: &FramePlan, width: u32, height: u32) -> u64 {
    let of = |target: &crate::graph::Target| {
        let (mut w, mut h, faces) = match target.kind {
            TargetKind::Canvas => {
                let (w, h) = target.size.of((width, height));
                (w, h, 1)
            }
            TargetKind::Cube => (1024, 1024, 6),
        };
        let level = |w: u32, h: u32| u64::from(w) * u64::from(h) * target.format.bytes();
        let mut sum = level(w, h);
        while target.mips && (w, h) != (1, 1) {
            (w, h) = ((w / 2).max(1), (h / 2).max(1));
            sum += level(w, h);
        }
        sum * faces * if target.doubled { 2 } else { 1 }
    };
    plan.targets.iter().map(of).sum()
}

fn words(report: &Report, costs: &Costs) -> String {
    let mut out = String::new();
    let mib = |bytes: f64| bytes / f64::from(1 << 20);
    let _ = writeln!(
        out,
        "{}: {:.3} ms a frame (slowest {:.3}), {} frames of {}x{} on {}",
        report.project,
        report.frame_ms.unwrap_or_default(),
        costs.worst_ms,
        report.frames,
        costs.width,
        costs.height,
        costs.device
    );
    for pass in &costs.passes {
        let time = pass.gpu_ms.map_or("no timestamps".into(), |ms| format!("{ms:.3} ms"));
        let _ = writeln!(out, "  {:12} {time:>14}", pass.title);
    }
    let _ = writeln!(out, "  {:12} {:>11.1} µs a pass a frame", "engine", costs.cpu_us_per_pass);
    let _ = writeln!(out, "  {:12} {:>10.1} MiB", "targets", mib(costs.target_bytes as f64));
    if costs.target_bytes_saved > 0 || !costs.passes_skipped.is_empty() {
        let _ = writeln!(
            out,
            "  {:12} {} of {} passes, {:.1} MiB",
            "left out",
            costs.passes_skipped.len(),
            costs.passes_skipped.len() + costs.passes.len(),
            mib(costs.target_bytes_saved as f64)
        );
    }
    if costs.passes_rested > 0.0 {
        let _ = writeln!(
            out,
            "  {:12} {:.1} passes a frame, nothing they read having changed: {:.1} MiB not written",
            "at rest",
            costs.passes_rested,
            mib(costs.bytes_rested)
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        graph::Target,
        project::{PassFormat, PassSize},
    };

    #[test]
    fn a_mip_chain_and_a_second_texture_are_counted() {
        let target = |doubled, mips| Target {
            id: PassId::Image,
            index: 0,
            kind: TargetKind::Canvas,
            size: Default::default(),
            format: Default::default(),
            doubled,
            mips,
            undrawn: false,
        };
        let plan = |t| FramePlan { targets: vec![t], ..Default::default() };
        assert_eq!(bytes(&plan(target(false, false)), 4, 2), 8 * 16);
        assert_eq!(bytes(&plan(target(true, false)), 4, 2), 2 * 8 * 16);
        assert_eq!(bytes(&plan(target(true, true)), 4, 2), 2 * (8 + 2 + 1) * 16);
        let half = Target { size: PassSize::Scale(0.5), format: PassFormat::R16f, ..target(false, false) };
        assert_eq!(bytes(&plan(half), 4, 2), 2 * 2);
    }
}
