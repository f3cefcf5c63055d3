//! `eddy compare`: the differences between the pictures of two projects, and between their times.
//!
//! Both get the same inputs and draw the same frames. Their times are measured alternately, so that a busy machine
//! affects both equally, and as with `--no-skip`, so that a static picture costs as much as a changing one.

use super::{
    args::{CompareArgs, CompareView, HostProgram, RunArgs},
    command::{CommandError, Run},
    machine::{Machine, RunError},
    opening::Opening,
    report::{Printer, Report},
    targets,
    terminal::{one_line, shown_path},
};
use crate::{
    debugger::trace::Number,
    diag::{Diagnostic, SourceMap},
    engine::Pixels,
    metrics::difference::{self, PictureDifference, Times},
    playback::{
        capture::Format,
        offline::Offline,
        revision::{self, Checkout},
        script::ScriptedInputs,
    },
};
use anyhow::anyhow;
use serde::Serialize;
use std::{fmt::Write, io, path::PathBuf};

/// The frames that a project draws per turn.
const TURN: u32 = 4;

/// The report of `render`, and the comparison.
#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    reference: &'a str,
    #[serde(flatten)]
    compared: Option<&'a Compared>,
}

#[derive(Debug, Serialize)]
struct Compared {
    frame: u32,
    pass: String,
    width: u32,
    height: u32,
    /// Texels that differ in any bit.
    texels_apart: usize,
    /// The largest difference of a component.
    largest: Number,
    /// The root mean square of the components' differences; 1 is the range of a screen.
    rmse: Number,
    /// The peak signal-to-noise ratio of the components as shown on a screen, in dB.
    psnr: Number,
    /// The structural similarity of luma; null for pictures of less than 11 pixels a side.
    ssim: Option<f64>,
    /// The mean of the FLIP map.
    flip: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    time: Option<Time>,
    #[serde(skip_serializing_if = "Option::is_none")]
    written: Option<PathBuf>,
}

/// Milliseconds per frame, and the ratio of the project's to the reference's.
#[derive(Debug, Serialize)]
struct Time {
    project_ms: f64,
    reference_ms: f64,
    /// The median over the turns, and the quartiles.
    ratio: f64,
    ratio_low: f64,
    ratio_high: f64,
    repeats: u32,
}

impl Run for CompareArgs {
    const OPENS_DEVICE: bool = true;

    fn hosted(&mut self) -> (Option<HostProgram>, Vec<&mut String>) {
        (self.run.guest, vec![&mut self.project])
    }

    fn run(&mut self) -> Result<u8, CommandError> {
        let inputs = self.run.inputs_of(self.frame + 1)?;
        Ok(run(self, &inputs)?)
    }
}

fn run(args: &CompareArgs, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::of(&args.run);
    let mut report = Report::new(&args.project);
    let reference = match (&args.reference, &args.revision) {
        (Some(reference), _) => reference.clone(),
        (None, revision) => format!("{} at {}", args.project, revision.as_deref().unwrap_or("HEAD")),
    };
    let compared = machine.attempt(&mut report, |machine, report| compare(machine, report, args, inputs));
    let words = compared.as_ref().map_or(String::new(), |compared| words(&args.project, &reference, compared));
    let line = JsonLine { report: &report, reference: &reference, compared: compared.as_ref() };
    printer.print_as(&line, &report, words.trim_end())?;
    Ok(printer.exit_code())
}

fn compare(
    machine: &mut Machine,
    report: &mut Report,
    args: &CompareArgs,
    inputs: &ScriptedInputs,
) -> Result<Compared, RunError> {
    let copy = args.revision.as_ref().map(|revision| revision::at(&args.project, revision));
    let copy = copy.transpose().map_err(anyhow::Error::from)?;
    for note in copy.iter().flat_map(Checkout::notes) {
        report.diagnose(&[Diagnostic::warning(None, note)], &SourceMap::default(), None);
    }
    let reference = match (&copy, &args.reference) {
        (Some(copy), _) => copy.project.to_string_lossy().into_owned(),
        (None, reference) => reference.clone().unwrap_or_default(),
    };
    let pass = &args.pass;
    // Timed frames are drawn even if nothing changes; the pictures stay the same.
    let drawn = RunArgs { no_skip: args.run.no_skip || args.repeats > 0, ..args.run.clone() };
    let opening = |spec| Opening::new(spec, &drawn, inputs).pass(&pass.pass);
    let mut ours = opening(&args.project).open(machine, report)?.offline;
    let compile_ms = report.compile_ms;
    let mut theirs = opening(&reference).open(machine, report)?.offline;
    report.compile_ms = compile_ms;
    for _ in 0..=args.frame {
        ours.draw()?;
        theirs.draw()?;
        report.frames += 1;
    }
    let (a, b) = (ours.read(&pass.pass, pass.target)?, theirs.read(&pass.pass, pass.target)?);
    let Some(apart) = PictureDifference::new(&a, &b) else {
        let size = |p: &Pixels| format!("{} x {}", p.width, p.height);
        return Err(anyhow!("cannot compare pictures of different sizes: {} and {}", size(&a), size(&b)).into());
    };
    let mut compared = Compared::new(args, &a, &apart);
    if let Some(path) = &args.out {
        targets::write(path, &shown(args.view, &a, &b, &apart), Format::Png)?;
        compared.written = Some(path.clone());
    }
    if args.repeats > 0 {
        let time = times(&mut ours, &mut theirs, args.repeats)?;
        report.frame_ms = Some(time.project_ms);
        compared.time = Some(time);
    }
    Ok(compared)
}

impl Compared {
    fn new(args: &CompareArgs, shown: &Pixels, apart: &PictureDifference) -> Self {
        Self {
            frame: args.frame,
            pass: args.pass.pass.key().to_owned(),
            width: shown.width,
            height: shown.height,
            texels_apart: apart.texels_apart,
            largest: Number::Double(apart.largest),
            rmse: Number::Double(apart.rmse),
            psnr: Number::Double(apart.psnr),
            ssim: apart.ssim,
            flip: apart.mean_flip(),
            time: None,
            written: None,
        }
    }
}

/// Combines both pictures in one.
fn shown(view: CompareView, a: &Pixels, b: &Pixels, apart: &PictureDifference) -> Pixels {
    let (width, height) = (a.width as usize, a.height as usize);
    let rows =
        |pixels: &Pixels| -> Vec<Vec<[f32; 4]>> { pixels.texels.chunks_exact(width).map(<[_]>::to_vec).collect() };
    let texels = match view {
        CompareView::Side => rows(a).into_iter().zip(rows(b)).flat_map(|(a, b)| [a, b].concat()).collect(),
        CompareView::Wipe => {
            let halves = |(a, b): (Vec<[f32; 4]>, Vec<[f32; 4]>)| [&a[..width / 2], &b[width / 2..]].concat();
            rows(a).into_iter().zip(rows(b)).flat_map(halves).collect()
        }
        CompareView::Difference => return difference::difference(a, b, 1.0),
        CompareView::Flip => {
            // The rows of a screen go from the top down.
            let grey = |&x: &f64| [x as f32, x as f32, x as f32, 1.0];
            apart.flip.chunks_exact(width).rev().flat_map(|row| row.iter().map(grey)).collect::<Vec<_>>()
        }
    };
    let width = if view == CompareView::Side { 2 * width } else { width };
    Pixels { width: width as u32, height: height as u32, texels }
}

fn times(ours: &mut Offline, theirs: &mut Offline, repeats: u32) -> Result<Time, RunError> {
    let turn = |offline: &mut Offline| -> Result<f64, RunError> {
        let mut millis = Vec::new();
        for _ in 0..TURN {
            // Not beyond the end of a recording.
            offline.rewind_at_end()?;
            millis.push(offline.draw()?.millis);
        }
        Ok(millis.iter().sum::<f64>() / f64::from(TURN))
    };
    // Drivers compile when a pipeline is first used.
    turn(ours)?;
    turn(theirs)?;
    let mut turns = Vec::new();
    for repeat in 0..repeats {
        // Each goes first equally often.
        let first = if repeat % 2 == 0 { Some(turn(ours)?) } else { None };
        let reference = turn(theirs)?;
        turns.push((first.map_or_else(|| turn(ours), Ok)?, reference));
    }
    let times = Times::new(&turns).ok_or_else(|| anyhow!("no runs were timed"))?;
    Ok(Time {
        project_ms: times.ours,
        reference_ms: times.theirs,
        ratio: times.ratio,
        ratio_low: times.ratio_low,
        ratio_high: times.ratio_high,
        repeats,
    })
}

fn words(project: &str, reference: &str, compared: &Compared) -> String {
    let Compared { frame, pass, width, height, texels_apart, largest, rmse, psnr, ssim, flip, time, written } =
        compared;
    let short = |number: &Number, digits: usize| match number {
        Number::Double(x) => format!("{x:.digits$}"),
        other => other.to_string(),
    };
    let (project, reference) = (one_line(project), one_line(reference));
    let mut out = format!("{project} against {reference}: {pass} in frame {frame}, {width}x{height}\n");
    if *texels_apart == 0 {
        out.push_str("  identical in every bit\n");
    } else {
        let ssim = ssim.map_or("none, as the picture is too small".into(), |ssim| format!("{ssim:.5}"));
        let _ = writeln!(out, "  {texels_apart} of {} texels differ, by at most {}", width * height, short(largest, 6));
        let (rmse, psnr) = (short(rmse, 6), short(psnr, 2));
        let _ = writeln!(out, "  RMSE {rmse}, PSNR {psnr} dB, SSIM {ssim}, FLIP {flip:.5}");
    }
    if let Some(time) = time {
        let _ = writeln!(
            out,
            "  {:.3} ms per frame against {:.3}: ratio {:.3} (quartiles {:.3} to {:.3}, {} runs)",
            time.project_ms, time.reference_ms, time.ratio, time.ratio_low, time.ratio_high, time.repeats
        );
    }
    if let Some(path) = written {
        let _ = writeln!(out, "  {}", shown_path(path));
    }
    out
}
