//! `eddy trace`: the execution of a pass for one pixel, step by step, and the difference of its value from the GPU's.

use super::{
    args::{HostProgram, TraceArgs},
    command::{CommandError, Run},
    divergence::{self, DivergenceReport},
    machine::{Machine, RunError, pass_over},
    nonfinite::{self, FirstNonfinite},
    opening::{Opened, Opening},
    printed::{self, Printed},
    report::{Printer, Report},
    source_excerpt::SourceExcerpt,
    terminal::one_line,
};
use crate::{
    debugger::trace::{self, Event, Extent, Number, Origin, Trace, TraceError, ulps},
    diag::{SourceMap, Span},
    engine::{self, PassInputs},
    playback::script::ScriptedInputs,
    project::{FillKind, PassName, Project, TexelFormat},
    texture::Face,
};
use serde::Serialize;
use std::{fmt::Write, io};

/// The report of `render`, and the trace.
#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(flatten)]
    trace: Option<&'a Traced>,
}

/// The report, and the first value that is not finite; null if all are.
#[derive(Serialize)]
struct NonfiniteReport<'a> {
    #[serde(flatten)]
    report: &'a Report,
    nonfinite: Option<FirstNonfinite>,
}

#[derive(Serialize)]
struct Traced {
    pass: String,
    /// The face of a cubemap pass.
    #[serde(skip_serializing_if = "Option::is_none")]
    face: Option<&'static str>,
    pixel: [u32; 2],
    frame: u32,
    /// For a pass that draws meshes, the triangle whose fragment the texel contains.
    #[serde(skip_serializing_if = "Option::is_none")]
    mesh: Option<MeshReport>,
    /// True if no triangle of a pass that draws meshes covers the pixel.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    clear: bool,
    /// The texel is outside this region of the pass (x, y, width and height): nothing is drawn there.
    #[serde(skip_serializing_if = "Option::is_none")]
    outside: Option<[u32; 4]>,
    /// The expression of the texel's contents before frame 0, which it then keeps, unless they are zeros.
    #[serde(skip_serializing_if = "Option::is_none")]
    initial: Option<SourceExcerpt>,
    /// The texel is in the boundary of the pass, which this expression writes.
    #[serde(skip_serializing_if = "Option::is_none")]
    boundary: Option<SourceExcerpt>,
    /// The walker's value; null if the pass draws nothing.
    value: Option<[Number; 4]>,
    /// The value in double precision along the same path.
    double: Option<[Number; 4]>,
    /// The texel that the GPU drew, as stored.
    device: [Number; 4],
    /// The storage format.
    format: &'static str,
    /// The distances between the two in ulps of single precision, for the stored components; null if these have fewer
    /// bits.
    ulps: Option<Vec<u32>>,
    /// The first difference between the GPU and the walker, if their values differ.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[serde(rename = "parted")]
    divergence: Option<DivergenceReport>,
    statements: u64,
    left_out: u64,
    steps: Vec<PlacedStep>,
    /// The values that `//@print` comments request.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    printed: Vec<Printed>,
}

/// A triangle of a mesh. The draws of the pass and the triangles of the mesh are counted from 0.
#[derive(Serialize)]
struct MeshReport {
    draw: usize,
    name: String,
    triangle: usize,
    /// True if its front is visible.
    front: bool,
}

/// A step with its location spelled out.
#[derive(Serialize)]
struct PlacedStep {
    kind: &'static str,
    depth: u32,
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    turn: Option<u64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    value: Vec<Number>,
}

impl Run for TraceArgs {
    const OPENS_DEVICE: bool = true;

    fn hosted(&mut self) -> (Option<HostProgram>, Vec<&mut String>) {
        (self.run.guest, self.project.iter_mut().collect())
    }

    fn run(&mut self) -> Result<u8, CommandError> {
        self.face()?;
        let inputs = self.run.inputs_of(self.frame + 1)?;
        Ok(run(self, &inputs)?)
    }
}

fn run(args: &TraceArgs, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::of(&args.run);
    for spec in &args.project {
        let mut report = Report::new(spec);
        if args.nonfinite {
            let first =
                machine.attempt(&mut report, |machine, report| nonfinite::first(machine, report, args, spec, inputs));
            let words = first.as_ref().map(|first| nonfinite::words(spec, report.frames, first.as_ref()));
            let line = NonfiniteReport { report: &report, nonfinite: first.flatten() };
            printer.print_as(&line, &report, words.unwrap_or_default().trim_end())?;
            continue;
        }
        let traced =
            machine.attempt(&mut report, |machine, report| traced(machine, report, args, spec, inputs.clone()));
        let words = traced.as_ref().map_or(String::new(), |traced| words(spec, traced));
        printer.print_as(&JsonLine { report: &report, trace: traced.as_ref() }, &report, words.trim_end())?;
    }
    Ok(printer.exit_code())
}

fn traced(
    machine: &mut Machine,
    report: &mut Report,
    args: &TraceArgs,
    spec: &str,
    inputs: ScriptedInputs,
) -> Result<Traced, RunError> {
    let pass = &args.pass.pass;
    let opening = Opening::new(spec, &args.run, &inputs).pass(pass);
    let Opened { project, mut offline, .. } = opening.open(machine, report)?;
    for _ in 0..args.frame {
        pass_over(&mut offline, &args.run)?;
    }
    let before = (args.probes > 0).then(|| Ok::<_, RunError>(offline.engine()?.snapshot()?)).transpose()?;
    let face = args.face().map_err(anyhow::Error::msg)?;
    let read = PassInputs { face: face as u32, ..offline.draw_inspected(pass)? };
    report.frames = args.frame + 1;
    let device = offline.read(pass, face)?;
    let index = project.passes.iter().position(|p| p.id == *pass).unwrap_or_default();
    let texts = engine::Sources::new(&project);
    let extent = Extent { statements: args.max_statements, steps: args.max_steps.unwrap_or(usize::MAX) };
    let pixel = args.pixel.unwrap_or_default();
    let trace = match trace::trace(&texts, index, &read, pixel, extent) {
        Err(TraceError::Diagnostics(found)) => return Err(RunError::Diagnostics(found, project.sources())),
        other => other.map_err(anyhow::Error::from)?,
    };
    let (x, y) = pixel;
    let texel = device.texels[(y * device.width + x) as usize];
    let printed = printed::printed(&project, pass, args.frame, (&read, &device), pixel).map_err(anyhow::Error::from)?;
    let divergence = match before.filter(|_| parts(&project, args, texel, &trace)) {
        Some(before) => {
            Some(divergence::find(args, &project, (offline.into_engine()?, before), (index, &read), inputs)?)
        }
        None => None,
    };
    Ok(Traced { divergence, ..placed(&project, args, texel, trace, printed) })
}

/// The format of a pass's first target.
fn format_of(project: &Project, pass: &PassName) -> TexelFormat {
    project.pass(pass).and_then(|pass| pass.formats().first().copied()).unwrap_or_default()
}

/// Returns whether the walker's value differs from the texel that the GPU has stored, bit for bit.
fn parts(project: &Project, args: &TraceArgs, device: [f32; 4], trace: &Trace) -> bool {
    let format = format_of(project, &args.pass.pass);
    let is_apart = |value: [f32; 4]| (0..format.components()).any(|i| ulps(value[i], device[i]) > 0);
    format.is_32_bit() && trace.origin == Origin::Screen && trace.value.is_some_and(is_apart)
}

fn placed(project: &Project, args: &TraceArgs, device: [f32; 4], trace: Trace, printed: Vec<Printed>) -> Traced {
    let sources = project.sources();
    let format = format_of(project, &args.pass.pass);
    let apart = |value: [f32; 4]| (0..format.components()).map(|i| ulps(value[i], device[i])).collect();
    let floats = |values: [f32; 4]| values.map(Number::Float);
    let steps = trace.steps.into_iter().map(|step| {
        let (source, line, column) = place(&sources, step.span);
        let mut placed =
            PlacedStep { kind: "", depth: step.depth, source, line, column, name: None, turn: None, value: Vec::new() };
        match step.event {
            Event::Enter(name) => (placed.kind, placed.name) = ("enter", Some(name)),
            Event::Leave => placed.kind = "leave",
            Event::Iteration(turn) => (placed.kind, placed.turn) = ("turn", Some(turn)),
            Event::Set { name, value } => (placed.kind, placed.name, placed.value) = ("set", Some(name), value),
        }
        placed
    });
    let draws = project.pass(&args.pass.pass).map_or(&[][..], |pass| pass.body.draws());
    let mesh = match trace.origin {
        Origin::Mesh(fragment) => draws.get(fragment.draw).map(|draw| MeshReport {
            draw: fragment.draw,
            name: draw.mesh.name(),
            triangle: fragment.triangle,
            front: fragment.is_front,
        }),
        _ => None,
    };
    let fill = |kind: FillKind| {
        let index = project.passes.iter().position(|pass| pass.id == args.pass.pass)?;
        Some(SourceExcerpt::at(project, Some(project.fill_span(index, kind)?)))
    };
    let outside = match trace.origin {
        Origin::Outside(region) => Some([region.x, region.y, region.width, region.height]),
        _ => None,
    };
    Traced {
        mesh,
        outside,
        initial: outside.and_then(|_| fill(FillKind::Initial)),
        boundary: (trace.origin == Origin::Boundary).then(|| fill(FillKind::Boundary)).flatten(),
        clear: trace.origin == Origin::Clear,
        pass: args.pass.pass.key().to_owned(),
        face: (args.pass.pass.has_faces()).then(|| Face::ALL[args.face.unwrap_or_default()].name()),
        pixel: args.pixel.map_or([0, 0], |(x, y)| [x, y]),
        frame: args.frame,
        value: trace.value.map(floats),
        double: trace.double.map(|values| values.map(Number::Double)),
        device: floats(device),
        format: format.name(),
        ulps: trace.value.filter(|_| format.is_32_bit()).map(apart),
        divergence: None,
        statements: trace.statements,
        left_out: trace.left_out,
        steps: steps.collect(),
        printed,
    }
}

fn place(sources: &SourceMap, span: Option<Span>) -> (Option<String>, Option<usize>, Option<usize>) {
    let at = span.and_then(|span| sources.line_column(span));
    let name = span.and_then(|span| sources.get(span.source)).map(|source| source.name.clone());
    (name, at.map(|at| at.line), at.map(|at| at.column))
}

fn words(spec: &str, traced: &Traced) -> String {
    let mut out = String::new();
    let list = |values: &[Number]| values.iter().map(Number::to_string).collect::<Vec<_>>().join(", ");
    let vector = |values: &[Number]| if values.len() == 1 { list(values) } else { format!("({})", list(values)) };
    for step in &traced.steps {
        let at = match (&step.source, step.line) {
            (Some(source), Some(line)) => format!("{}:{line}", one_line(source)),
            _ => String::new(),
        };
        let what = match (step.kind, &step.name, step.turn) {
            ("enter", Some(name), _) => format!("{name}()"),
            ("set", Some(name), _) => format!("{name} = {}", vector(&step.value)),
            (_, _, Some(turn)) => format!("iteration {turn}"),
            _ => continue,
        };
        let _ = writeln!(out, "{at:<24} {:indent$}{what}", "", indent = 2 * step.depth as usize);
    }
    if traced.left_out > 0 {
        let _ = writeln!(out, "... and {} more steps", traced.left_out);
    }
    out.push_str(&printed::words(&traced.printed));
    let Traced { pass, pixel: [x, y], frame, statements, .. } = traced;
    let face = traced.face.map_or_else(String::new, |face| format!(" {face}"));
    let _ = writeln!(out, "{}: {pass}{face} at {x},{y} in frame {frame}, {statements} statements", one_line(spec));
    if let Some(MeshReport { draw, name, triangle, front }) = &traced.mesh {
        let side = if *front { "front" } else { "back" };
        let _ = writeln!(out, "  draw {draw}, {}: triangle {triangle}, {side} side", one_line(name));
    }
    if traced.clear {
        out.push_str("  no triangle is drawn here: the texel keeps the zeros from the start of the pass\n");
    }
    if let Some([x, y, width, height]) = traced.outside {
        let held = match traced.initial.as_ref().and_then(|initial| Some((initial.place()?, &initial.text))) {
            Some((place, text)) => format!("its initial state from {place}, {text}"),
            None => "its initial zeros".to_owned(),
        };
        let _ = writeln!(
            out,
            "  outside the region of the pass, {width} x {height} texels from {x},{y}: the texel is not drawn and \
             keeps {held}"
        );
    }
    if let Some(boundary) = &traced.boundary {
        let place = boundary.place().unwrap_or_default();
        let _ = writeln!(out, "  in the boundary of the pass: {place} overwrites the texel: {}", boundary.text);
    }
    let device = format!("{}, stored as {}", vector(&traced.device), traced.format);
    let (Some(value), Some(double)) = (&traced.value, &traced.double) else {
        let is_unwalked = traced.boundary.is_some();
        let walker = if is_unwalked { "cannot be traced" } else { "draws nothing" };
        let _ = writeln!(out, "  CPU     {walker}\n  GPU     {device}");
        return out;
    };
    let _ = writeln!(out, "  CPU     {}\n  GPU     {device}", vector(value));
    if let Some(ulps) = &traced.ulps {
        let ulps: Vec<String> = ulps.iter().map(u32::to_string).collect();
        let _ = writeln!(out, "  apart   ({}) ULPs", ulps.join(", "));
    }
    let _ = writeln!(out, "  double  {}", vector(double));
    if let Some(found) = &traced.divergence {
        out.push_str(&divergence::words(found));
    }
    out
}
