//! `eddy render --plan`: the dependencies between frames, and the cost of the tasks of an array, measured on a few
//! frames.

use super::{
    args::RenderArgs,
    machine::{Machine, RunError, millis_since},
    opening::Opening,
    report::{Printer, Report},
    targets::Targets,
    terminal::one_line,
    tiles,
};
use crate::playback::{median, offline::Offline, script::ScriptedInputs, shard::Shard};
use serde::Serialize;
use std::{io, time::Instant};

/// The number of frames that are drawn to measure one.
const MEASURED: u32 = 8;

/// The cost of a project's frames.
#[derive(Debug, Serialize)]
struct Plan {
    /// The number of written frames, and of tasks that share them.
    writes: usize,
    tasks: u64,
    /// The passes that make frames depend on earlier ones; if empty, every frame can be drawn independently.
    state: Vec<String>,
    /// The milliseconds of a frame without the passes that only its picture needs; equal to `frame_ms` if there are
    /// none.
    #[serde(skip_serializing_if = "Option::is_none")]
    state_ms: Option<f64>,
    /// The bytes of a checkpoint before compression.
    #[serde(skip_serializing_if = "Option::is_none")]
    checkpoint_bytes: Option<u64>,
    /// The maximum number of frames that a task draws: from the start, and from checkpoints at an interval.
    most_frames: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    resumed: Option<Resumed>,
}

#[derive(Debug, Serialize)]
struct Resumed {
    checkpoint_every: u32,
    most_frames: u32,
    /// The frames of the run that writes the checkpoints.
    serial_frames: u32,
}

#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    plan: Option<&'a Plan>,
}

pub(super) fn run(args: &RenderArgs, targets: &Targets, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::of(&args.run);
    for spec in &args.project {
        let swept = targets.sweep.first().cloned().unwrap_or_default();
        let mut report = Report::swept(spec, &swept);
        let plan = machine.attempt(&mut report, |machine, report| plan(machine, report, spec, args, targets, inputs));
        let words = plan.as_ref().map_or(String::new(), |plan| plan.words(&report));
        printer.print_as(&JsonLine { report: &report, plan: plan.as_ref() }, &report, &words)?;
    }
    Ok(printer.exit_code())
}

fn plan(
    machine: &mut Machine,
    report: &mut Report,
    spec: &str,
    args: &RenderArgs,
    targets: &Targets,
    inputs: &ScriptedInputs,
) -> Result<Plan, RunError> {
    let drawn = args.drawn();
    let mut offline = Opening::new(spec, &drawn, inputs).pass(&args.pass.pass).open(machine, report)?.offline;
    let (at, tasks) = (&targets.at, targets.shard.count);
    let blocks: Vec<(u32, u32)> = (0..tasks)
        .map(|index| Shard { index, count: tasks }.part_of(at.len() as u64))
        .filter(|block| block.start < block.end)
        .map(|block| (at[block.start as usize], at[block.end as usize - 1]))
        .collect();
    report.frame_ms = measure(&mut offline, report, |offline| {
        let drawn = offline.draw()?;
        let began = Instant::now();
        tiles::draw_all(offline)?;
        Ok(drawn.millis + millis_since(began))
    })?;
    let largest = at.len().div_ceil(tasks as usize) as u32;
    let mut plan = Plan {
        writes: at.len(),
        tasks,
        state: Vec::new(),
        state_ms: None,
        checkpoint_bytes: None,
        most_frames: largest,
        resumed: None,
    };
    if !offline.has_state()? {
        return Ok(plan);
    }
    plan.state = offline.engine()?.passes_with_state().iter().map(|pass| pass.title()).collect();
    plan.checkpoint_bytes = Some(offline.engine()?.checkpoint_bytes());
    plan.most_frames = at.last().map_or(0, |last| last + 1);
    plan.state_ms = measure(&mut offline, report, |offline| Ok(offline.advance()?.millis))?;
    if tasks > 1 {
        let every = plan.most_frames.div_ceil(tasks as u32).max(1);
        let drawn = |(first, last): &(u32, u32)| last + 1 - first / every * every;
        plan.resumed = Some(Resumed {
            checkpoint_every: every,
            most_frames: blocks.iter().map(drawn).max().unwrap_or_default(),
            // The last checkpoint that a task resumes from.
            serial_frames: blocks.last().map_or(0, |(first, _)| first / every * every),
        });
    }
    Ok(plan)
}

/// Returns the milliseconds of a frame, ignoring the first one.
fn measure(
    offline: &mut Offline,
    report: &mut Report,
    frame: impl Fn(&mut Offline) -> Result<f64, RunError>,
) -> Result<Option<f64>, RunError> {
    let mut millis = Vec::new();
    for _ in 0..=MEASURED {
        offline.rewind_at_end()?;
        millis.push(frame(offline)?);
        report.frames += 1;
    }
    Ok(median(millis.split_off(1)))
}

impl Plan {
    fn words(&self, report: &Report) -> String {
        let frame_ms = report.frame_ms.unwrap_or_default();
        let state_ms = self.state_ms.unwrap_or(frame_ms);
        // A task writes some of its frames; of the others, only what later frames read is drawn.
        let written = self.writes.div_ceil(self.tasks as usize) as u32;
        let each = |frames: u32| {
            let seen = written.min(frames);
            let secs = (f64::from(seen) * frame_ms + f64::from(frames - seen) * state_ms) / 1e3;
            format!("at most {frames} frames each, {}", duration(secs))
        };
        let depends = match self.state.is_empty() {
            true => "each can be drawn by itself".to_owned(),
            false => {
                format!("each depends on those before, through {}", one_line(&crate::project::listed(&self.state)))
            }
        };
        let mut lines = vec![format!("{}: {} frames; {depends}", report.title(), self.writes)];
        lines.push(format!("{frame_ms:.2} ms a frame, the median of {MEASURED}"));
        if let (Some(state_ms), Some(bytes)) = (self.state_ms, self.checkpoint_bytes) {
            let mebibytes = bytes as f64 / f64::from(1 << 20);
            lines.push(format!("{state_ms:.2} ms without the picture; a checkpoint takes at most {mebibytes:.1} MiB"));
        }
        let tasks = if self.tasks == 1 { "1 task".into() } else { format!("{} tasks", self.tasks) };
        lines.push(format!("{tasks}: {}", each(self.most_frames)));
        if let Some(resumed) = &self.resumed {
            lines.push(format!(
                "{tasks} from checkpoints (--checkpoint-every {}): {}, after {} for the checkpoints",
                resumed.checkpoint_every,
                each(resumed.most_frames),
                duration(f64::from(resumed.serial_frames) * state_ms / 1e3)
            ));
        }
        lines.join("\n  ")
    }
}

/// Formats a duration for users.
fn duration(secs: f64) -> String {
    match secs {
        secs if secs < 120.0 => format!("{secs:.1} s"),
        secs if secs < 7200.0 => format!("{:.0} min", secs / 60.0),
        secs => format!("{:.1} h", secs / 3600.0),
    }
}
