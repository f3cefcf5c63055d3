//! `eddy probe`: the value of an expression, drawn instead of the picture.

use super::{
    args::{HostProgram, ProbeArgs},
    command::{CommandError, Run},
    machine::{Machine, RunError, pass_over},
    opening::Opening,
    report::{Printer, Report},
    targets,
    terminal::{one_line, shown_path},
};
use crate::{
    debugger::trace::Number,
    engine::{BuildOptions, Pixels},
    glsl::Probe,
    playback::script::ScriptedInputs,
    project::Project,
};
use serde::Serialize;
use std::{fmt::Write, io, path::PathBuf};

/// The report of `render`, and the value.
#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(flatten)]
    probed: Option<&'a Probed>,
}

#[derive(Serialize)]
struct Probed {
    /// The place as given on the command line.
    at: String,
    visit: u32,
    frame: u32,
    width: u32,
    height: u32,
    /// The number of pixels that evaluated the expression this often.
    visited: usize,
    /// The minimum of each component over these pixels, ignoring NaN.
    min: [Number; 4],
    max: [Number; 4],
    mean: [Number; 4],
    /// The number of components, over these pixels, that are NaN or infinite.
    nonfinite: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    pixel: Option<[u32; 2]>,
    /// The value at the pixel; null if it did not evaluate the expression this often.
    value: Option<[Number; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    written: Option<PathBuf>,
}

impl Run for ProbeArgs {
    const OPENS_DEVICE: bool = true;

    fn hosted(&mut self) -> (Option<HostProgram>, Vec<&mut String>) {
        (self.run.guest, vec![&mut self.project])
    }

    fn run(&mut self) -> Result<u8, CommandError> {
        self.face()?;
        let inputs = self.run.inputs_of(self.frame + 1)?;
        Ok(run(self, &inputs)?)
    }
}

fn run(args: &ProbeArgs, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::of(&args.run);
    let mut report = Report::new(&args.project);
    let probed = machine.attempt(&mut report, |machine, report| probed(machine, report, args, inputs.clone()));
    let words = probed.as_ref().map_or(String::new(), |probed| words(&args.project, probed));
    printer.print_as(&JsonLine { report: &report, probed: probed.as_ref() }, &report, words.trim_end())?;
    Ok(printer.exit_code())
}

fn probed(
    machine: &mut Machine,
    report: &mut Report,
    args: &ProbeArgs,
    inputs: ScriptedInputs,
) -> Result<Probed, RunError> {
    let pass = args.pass();
    if !pass.is_picture() {
        return Err(anyhow::anyhow!("a sound pass has no pixels to probe").into());
    }
    let face = args.face().map_err(anyhow::Error::msg)?;
    let (out, format) = (args.file(), args.format().map_err(anyhow::Error::msg)?);
    // A default file must not overwrite anything.
    if let Some(path) = out.as_ref().filter(|path| args.out.is_none() && path.exists()) {
        let path = path.display();
        return Err(anyhow::anyhow!("{path} already exists: to overwrite it, give it with --out").into());
    }
    let probe = |project: &Project| {
        let (source, at) = args.at.find(project).map_err(anyhow::Error::msg)?;
        Ok(Probe { source, at, visit: args.visit })
    };
    let opening = Opening::new(&args.project, &args.run, &inputs).pass(&pass).probe(&probe);
    let mut offline = opening.open(machine, report)?.offline;
    for _ in 0..args.frame {
        pass_over(&mut offline, &args.run)?;
        report.frames += 1;
    }
    offline.draw()?;
    report.frames += 1;
    let pixels = offline.read(&BuildOptions::probed(), face)?;
    if let Some((x, y)) = args.pixel.filter(|&(x, y)| x >= pixels.width || y >= pixels.height) {
        let (width, height) = (pixels.width, pixels.height);
        return Err(anyhow::anyhow!("pixel {x},{y} is outside the pass, which has {width} x {height} texels").into());
    }
    if let Some(path) = &out {
        targets::write(path, &pixels, format)?;
    }
    Ok(Probed { written: out, ..summary(args, &pixels) })
}

fn summary(args: &ProbeArgs, pixels: &Pixels) -> Probed {
    let is_seen = |texel: &&[f32; 4]| !texel.iter().all(|x| x.is_nan());
    let seen = || pixels.texels.iter().filter(is_seen);
    let component = |fold: fn(f32, f32) -> f32, initial: f32| {
        std::array::from_fn(|i| {
            let numbers = seen().map(|texel| texel[i]).filter(|x| x.is_finite());
            Number::Float(numbers.fold(initial, fold))
        })
    };
    let mean = std::array::from_fn(|i| {
        let numbers = seen().map(|texel| f64::from(texel[i])).filter(|x| x.is_finite());
        let (sum, count) = numbers.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
        Number::Double(sum / count)
    });
    let texel = args.pixel.map(|(x, y)| pixels.texels[(y * pixels.width + x) as usize]);
    Probed {
        at: format!("{}:{}:{}", args.at.tab.title(), args.at.line, args.at.column),
        visit: args.visit,
        frame: args.frame,
        width: pixels.width,
        height: pixels.height,
        visited: seen().count(),
        min: component(f32::min, f32::INFINITY),
        max: component(f32::max, f32::NEG_INFINITY),
        mean,
        nonfinite: seen().flatten().filter(|x| !x.is_finite()).count(),
        pixel: args.pixel.map(|(x, y)| [x, y]),
        value: texel.as_ref().filter(is_seen).map(|texel| texel.map(Number::Float)),
        written: None,
    }
}

fn words(project: &str, probed: &Probed) -> String {
    let list = |values: &[Number; 4]| format!("({})", values.map(|n| n.to_string()).join(", "));
    let Probed { at, frame, width, height, visited, nonfinite, .. } = probed;
    let (project, at) = (one_line(project), one_line(at));
    let mut out = format!("{project}: {at} in frame {frame}: {visited} of {} pixels\n", width * height);
    if *visited > 0 {
        let _ = writeln!(out, "  min   {}", list(&probed.min));
        let _ = writeln!(out, "  max   {}", list(&probed.max));
        let _ = writeln!(out, "  mean  {}", list(&probed.mean));
    }
    if *nonfinite > 0 {
        let _ = writeln!(out, "  {nonfinite} components are not finite");
    }
    if let Some([x, y]) = probed.pixel {
        let value = probed.value.as_ref().map_or("not evaluated".into(), list);
        let _ = writeln!(out, "  at {x},{y}  {value}");
    }
    if let Some(path) = &probed.written {
        let _ = writeln!(out, "  written to {}", shown_path(path));
    }
    out
}
