//! `eddy render`: frames of many projects, drawn one after the other on one device and written as pictures.

use super::{
    args::RenderArgs,
    machine::{Machine, Trouble, median, open_measured},
    measured::{self, Measured, Measures},
    report::{Printer, Report},
    targets::Targets,
};
use crate::{playback::script::ScriptedInputs, project::Project};
use serde::Serialize;
use std::{io, path::PathBuf};

/// The report, and what was measured.
#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(skip_serializing_if = "<[Measured]>::is_empty")]
    measured: &'a [Measured],
}

pub fn run(args: &RenderArgs, targets: &Targets, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::default();
    let runs = args.project.iter().enumerate();
    for ((index, spec), swept) in runs.flat_map(|run| targets.sweep.iter().map(move |swept| (run, swept))) {
        let mut report = Report::swept(spec, swept);
        let drawn = machine.attempt(&mut report, |machine, report| draw(machine, report, args, targets, inputs, index));
        let (words, measured) = drawn.map_or((String::new(), Vec::new()), |(written, measures)| {
            let millis = report.frame_ms.unwrap_or_default();
            let paths: Vec<String> = written.iter().map(|p| p.display().to_string()).collect();
            let frames = if report.frames == 1 { "1 frame".into() } else { format!("{} frames", report.frames) };
            let words = format!("{}: {frames}, {millis:.2} ms each: {}", report.title(), paths.join(" "));
            (words.trim_end_matches([':', ' ']).to_owned() + &measures.words(), measures.taken)
        });
        printer.print_as(&JsonLine { report: &report, measured: &measured }, &report, &words)?;
    }
    Ok(printer.exit_code())
}

/// Draws one project. Gives the files it wrote and the numbers it measured.
fn draw<'a>(
    machine: &mut Machine,
    report: &mut Report,
    args: &'a RenderArgs,
    targets: &Targets,
    inputs: &ScriptedInputs,
    index: usize,
) -> Result<(Vec<PathBuf>, Measures<'a>), Trouble> {
    let wanted = &args.pass;
    let beside = |project: &Project| {
        let (declared, _) = measured::declared(project);
        let asserted = args.assert.iter().map(|assertion| &assertion.quantity);
        args.probe.iter().chain(asserted).chain(&declared).map(|quantity| quantity.pass.clone()).collect()
    };
    let spec = &args.project[index];
    let (project, mut offline) =
        open_measured(machine, report, spec, &args.run, (&wanted.pass, &beside), inputs.clone())?;
    let (declared, unread) = measured::declared(&project);
    report.diagnose(&unread, &project.sources(), Some(&project));
    let mut measures = Measures::new(&project, args.probe.iter().cloned().chain(declared).collect(), &args.assert);
    let (mut millis, mut written) = (Vec::new(), Vec::new());
    for frame in 0..targets.frames {
        millis.push(offline.draw()?.millis);
        report.frames += 1;
        if targets.at.binary_search(&frame).is_err() {
            continue;
        }
        measures.take(&project, &mut offline, frame, report)?;
        if let Some(path) = targets.path(index, &report.sweep, frame) {
            targets.write(&path, &offline.read(&wanted.pass, args.face.unwrap_or(wanted.target))?)?;
            written.push(path);
        }
    }
    // The first frame is not like the others: drivers compile for the machine when a pipeline is first used.
    if millis.len() > 1 {
        millis.remove(0);
    }
    report.frame_ms = median(millis);
    Ok((written, measures))
}
