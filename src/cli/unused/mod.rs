//! `eddy unused`: the work of a project that nothing depends on, what it costs, and whether Eddy leaves it out already.

mod measured;
mod planned;
mod precision;

use super::{
    args::{HostProgram, UnusedArgs},
    bench::pass_times,
    command::{CommandError, Run},
    machine::{Machine, RunError},
    opening::{Opened, Opening},
    report::{Printer, Report},
};
use crate::{
    engine::{CostClock, PassCost, PassRole},
    playback::script::ScriptedInputs,
};
use serde::Serialize;
use std::{collections::HashMap, fmt::Write, io};

/// The unused parts of a project.
#[derive(Debug, Serialize)]
struct Unused {
    width: u32,
    height: u32,
    device: String,
    /// The clock of `ms`: `timestamps` or `waited`, as in `eddy bench`.
    clock: &'static str,
    findings: Vec<Finding>,
}

/// The kind of thing that is unused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    /// A pass that no shown pass reads, or that its condition turns off.
    Pass,
    /// A channel that names a pass, and whose texels no code reads.
    Channel,
    /// Components that no reader uses.
    Components,
    /// Mip levels that no reader can reach.
    Mips,
    /// Texels beyond those that readers fetch.
    Texels,
    /// Frames in which a pass has the texels of the frame before.
    Frames,
    /// Bits of the format without which the picture is the same.
    Precision,
}

/// Something that nothing depends on.
#[derive(Debug, Serialize)]
struct Finding {
    kind: Kind,
    pass: String,
    #[serde(skip)]
    title: String,
    /// Says what is unused, and how to change it.
    message: String,
    /// The milliseconds of a frame that it takes, as far as they are known.
    ms: Option<f64>,
    /// The bytes of textures, or for frames and channels those that a frame moves.
    bytes: u64,
    /// True if Eddy leaves it out.
    skipped: bool,
}

impl Finding {
    fn of(kind: Kind, cost: &PassCost, message: String) -> Finding {
        let (pass, title) = (cost.pass.key().to_owned(), cost.pass.title());
        Finding { kind, pass, title, message, ms: None, bytes: 0, skipped: false }
    }
}

/// The report of `render`, and what is unused.
#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(flatten)]
    unused: Option<&'a Unused>,
}

impl Run for UnusedArgs {
    const OPENS_DEVICE: bool = true;

    fn hosted(&mut self) -> (Option<HostProgram>, Vec<&mut String>) {
        (self.run.guest, self.project.iter_mut().collect())
    }

    fn run(&mut self) -> Result<u8, CommandError> {
        let inputs = self.inputs()?;
        Ok(run(self, &inputs)?)
    }
}

fn run(args: &UnusedArgs, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::of(&args.run);
    for spec in &args.project {
        let mut report = Report::new(spec);
        let unused = machine.attempt(&mut report, |machine, report| find(machine, report, args, spec, inputs));
        let words = unused.as_ref().map_or(String::new(), |unused| words(&report, unused));
        let line = JsonLine { report: &report, unused: unused.as_ref() };
        printer.print_as(&line, &report, words.trim_end())?;
    }
    Ok(printer.exit_code())
}

fn find(
    machine: &mut Machine,
    report: &mut Report,
    args: &UnusedArgs,
    spec: &str,
    inputs: &ScriptedInputs,
) -> Result<Unused, RunError> {
    let Opened { project, mut offline, media } = Opening::new(spec, &args.run, inputs).open(machine, report)?;
    let frames = measured::draw(&mut offline, &project, args.frames())?;
    report.frames = args.frames();
    offline.rewind()?;
    let times = pass_times(&mut offline, args.frames())?;
    let engine = offline.engine()?;
    let (width, height) = engine.size();
    let costs = engine.pass_costs(&project);
    let clock = match engine.cost_clock() {
        CostClock::Timestamps => "timestamps",
        CostClock::Waited => "waited",
    };
    let plan = engine.program().map(|program| program.plan().clone()).unwrap_or_default();
    let device = engine.gpu().describe();
    let gpu = engine.gpu().clone();
    let mut findings = planned::find(&project, &plan, &costs, &times, (width, height));
    findings.extend(measured::find(&frames, &costs, &times));
    if !args.no_precision {
        let pictures = frames.pictures;
        let test = precision::Test { gpu: &gpu, media: &media, size: (width, height), inputs, pictures: &pictures };
        findings.extend(test.find(&project, &costs)?);
    }
    // What costs most, and can be changed, comes first.
    let weight = |finding: &Finding| (finding.skipped, -finding.ms.unwrap_or(0.0), u64::MAX - finding.bytes);
    findings.sort_by(|a, b| weight(a).partial_cmp(&weight(b)).unwrap_or(std::cmp::Ordering::Equal));
    Ok(Unused { width, height, device, clock, findings })
}

/// Returns whether a pass is drawn in some frames.
fn is_drawn(cost: &PassCost) -> bool {
    matches!(cost.role, PassRole::Drawn { .. })
}

/// Returns the milliseconds of a pass in a frame that draws it.
fn millis(times: &HashMap<crate::project::PassName, f64>, cost: &PassCost) -> Option<f64> {
    times.get(&cost.pass).copied().filter(|ms| *ms > 0.0)
}

fn words(report: &Report, unused: &Unused) -> String {
    let mut out = String::new();
    let (frames, width, height) = (report.frames, unused.width, unused.height);
    let _ = writeln!(out, "{}: {frames} frames of {width}x{height} on {}", report.title(), unused.device);
    if unused.findings.is_empty() {
        out.push_str("  nothing is unused\n");
    }
    let name = unused.findings.iter().map(|f| f.title.chars().count()).max().unwrap_or_default();
    for (heading, skipped) in [("unused, but drawn or stored:", false), ("left out by Eddy:", true)] {
        let mut shown = unused.findings.iter().filter(|finding| finding.skipped == skipped).peekable();
        if shown.peek().is_some() {
            let _ = writeln!(out, "  {heading}");
        }
        for finding in shown {
            let time = finding.ms.map_or(String::new(), |ms| format!("{ms:.3} ms"));
            let mib = finding.bytes as f64 / f64::from(1 << 20);
            let Finding { title, message, .. } = finding;
            let _ = writeln!(out, "    {title:name$} {time:>11} {mib:>8.2} MiB  {message}");
        }
    }
    out
}
