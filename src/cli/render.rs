//! `eddy render`: frames of many projects, drawn one after the other on one device and written as pictures.

use super::{
    args::RenderArgs,
    machine::{Machine, Trouble, median, open},
    report::{Printer, Report},
    targets::{self, Targets},
};
use crate::session::script::ScriptedInputs;
use std::{io, path::PathBuf};

pub fn run(args: &RenderArgs, targets: &Targets, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::default();
    let runs = args.project.iter().enumerate();
    for ((index, spec), swept) in runs.flat_map(|run| targets.sweep.iter().map(move |swept| (run, swept))) {
        let mut report = Report::swept(spec, swept);
        let written =
            machine.attempt(&mut report, |machine, report| draw(machine, report, args, targets, inputs, index));
        let words = written.map_or(String::new(), |written| {
            let millis = report.frame_ms.unwrap_or_default();
            let paths: Vec<String> = written.iter().map(|p| p.display().to_string()).collect();
            let frames = if report.frames == 1 { "1 frame".into() } else { format!("{} frames", report.frames) };
            format!("{}: {frames}, {millis:.2} ms each: {}", report.title(), paths.join(" "))
        });
        printer.print(&report, &words)?;
    }
    Ok(printer.exit_code())
}

/// Draws one project and gives the files it wrote.
fn draw(
    machine: &mut Machine,
    report: &mut Report,
    args: &RenderArgs,
    targets: &Targets,
    inputs: &ScriptedInputs,
    index: usize,
) -> Result<Vec<PathBuf>, Trouble> {
    let wanted = &args.pass;
    let (_, mut offline) = open(machine, report, &args.project[index], &args.run, &wanted.pass, inputs.clone())?;
    let (mut millis, mut written) = (Vec::new(), Vec::new());
    for frame in 0..targets.frames {
        millis.push(offline.draw()?.millis);
        report.frames += 1;
        if targets.at.binary_search(&frame).is_ok()
            && let Some(path) = targets.path(index, &report.sweep, frame)
        {
            targets::write(&path, &offline.read(&wanted.pass, wanted.target)?, targets.format)?;
            written.push(path);
        }
    }
    // The first frame is not like the others: drivers compile for the machine when a pipeline is first used.
    if millis.len() > 1 {
        millis.remove(0);
    }
    report.frame_ms = median(millis);
    Ok(written)
}
