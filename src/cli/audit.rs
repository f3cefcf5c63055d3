//! The part of `eddy lab precision` that compares a pass with double precision.

use super::{
    args::PrecisionArgs,
    machine::{Machine, RunError, pass_over},
    opening::{Opened, Opening},
    report::Report,
    source_excerpt::SourceExcerpt,
    targets,
    terminal::{one_line, shown_path},
};
use crate::{
    debugger::{
        audit::{self, Audit, AuditedPixel, Finding},
        trace::{TraceError, ulps},
    },
    engine::{Pixels, Sources},
    lab::Number,
    playback::{capture::Format, script::ScriptedInputs},
    project::{Project, TexelFormat},
};
use serde::Serialize;
use std::{fmt::Write, path::PathBuf};

/// The number of listed pixels.
const WORST: usize = 5;
/// The errors that an error map shows as black and as white.
const BLACK: f32 = 1e-8;

#[derive(Debug, Serialize)]
pub(super) struct Audited {
    pass: String,
    frame: u32,
    pixels: usize,
    /// The median over pixels of the largest difference of a component, GPU against double precision.
    median: Number,
    largest: Number,
    /// Pixels that would look different on an 8-bit screen.
    visible: usize,
    worst: Vec<LeastPrecise>,
    /// Comparison with the walker in single precision; null if the pass stores fewer bits than it computes with.
    walker: Option<WalkerComparison>,
    findings: Vec<Found>,
    #[serde(skip_serializing_if = "Option::is_none")]
    written: Option<PathBuf>,
}

/// The GPU against the walker in single precision: the differences are the GPU's own arithmetic.
#[derive(Debug, Serialize)]
struct WalkerComparison {
    /// Pixels with equal bits.
    same: usize,
    /// The median over pixels of the distance in ulps, of the component that differs most.
    median_ulps: u32,
    largest_ulps: u32,
    /// Pixels that differ by more than 1/255, relative to values larger than 1.
    visible: usize,
    /// The pixel with the largest difference, if there is one.
    furthest: Option<LargestDeviation>,
}

#[derive(Debug, Serialize)]
struct LargestDeviation {
    pixel: [u32; 2],
    device: [Number; 4],
    walker: [Number; 4],
}

#[derive(Debug, Serialize)]
struct LeastPrecise {
    pixel: [u32; 2],
    device: [Number; 4],
    double: [Number; 4],
    error: Number,
}

#[derive(Debug, Serialize)]
struct Found {
    kind: &'static str,
    message: &'static str,
    #[serde(flatten)]
    written: SourceExcerpt,
    numbers: String,
    /// True for an operation on constants: it affects every pixel that executes it.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    constant: bool,
    /// The number of the affected pixels, and the one most affected.
    pixels: usize,
    pixel: [u32; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<Number>,
    /// The remaining error if only this operation is exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_left: Option<Number>,
}

pub(super) fn run(
    machine: &mut Machine,
    report: &mut Report,
    args: &PrecisionArgs,
    spec: &str,
    inputs: ScriptedInputs,
) -> Result<Audited, RunError> {
    let wanted = &args.pass;
    let mut quiet = Report::new(spec);
    let opening = Opening::new(spec, &args.run, &inputs).pass(&wanted.pass);
    let Opened { project, mut offline, .. } = opening.open(machine, &mut quiet)?;
    for _ in 1..args.frames() {
        pass_over(&mut offline, &args.run)?;
    }
    let read = offline.draw_inspected(&wanted.pass)?;
    report.frames = args.frames();
    let device = offline.read(&wanted.pass, 0)?;
    let index = project.passes.iter().position(|pass| pass.id == wanted.pass).unwrap_or_default();
    let pixels = audit::grid(args.pixels, &project.passes[index].settings, read.size);
    let sources = Sources::new(&project);
    let audit = match audit::audit(&sources, index, &read, &pixels, args.max_statements) {
        Err(TraceError::Diagnostics(found)) => return Err(RunError::Diagnostics(found, project.sources())),
        other => other.map_err(anyhow::Error::from)?,
    };
    summary(args, &project, (&audit, &pixels), &device)
}

fn summary(
    args: &PrecisionArgs,
    project: &Project,
    (audit, grid): (&Audit, &[(u32, u32)]),
    device: &Pixels,
) -> Result<Audited, RunError> {
    let format = project.pass(&args.pass.pass).map_or_else(TexelFormat::default, |pass| pass.formats()[0]);
    let (stored, is_32_bit) = (format.components(), format.is_32_bit());
    let texel = |(x, y): (u32, u32)| device.texels[(y * device.width + x) as usize];
    let differences = |pixel: &AuditedPixel| pixel.apart(texel(pixel.pixel), stored);
    let error = |pixel: &AuditedPixel| differences(pixel).into_iter().fold(0.0, f64::max);
    let mut order: Vec<(f64, &AuditedPixel)> = audit.pixels.iter().map(|pixel| (error(pixel), pixel)).collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0));
    let worst = order.iter().take(WORST).filter(|(error, _)| *error > 0.0);
    let written = args.map.as_ref().map(|path| {
        let each = |pixel: &(u32, u32)| {
            let audited = audit.pixels.iter().find(|audited| audited.pixel == *pixel);
            audited.map_or([0.0; 4], |audited| differences(audited).map(|x| x as f32))
        };
        let (width, height) = args.pixels;
        let mut texels: Vec<_> = grid.iter().map(each).collect();
        texels.resize((width * height) as usize, [0.0; 4]);
        let map = Pixels { width, height, texels };
        match path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
            true => targets::write(path, &shown(&map), Format::Png)?,
            false => targets::write(path, &map, Format::Npy)?,
        }
        anyhow::Ok(path.clone())
    });
    Ok(Audited {
        pass: args.pass.pass.key().to_owned(),
        frame: args.frames() - 1,
        pixels: audit.pixels.len(),
        median: Number(order.get(order.len() / 2).map_or(0.0, |o| o.0)),
        largest: Number(order.first().map_or(0.0, |o| o.0)),
        visible: order.iter().filter(|(error, _)| *error > 1.0 / 255.0).count(),
        worst: worst
            .map(|(error, pixel)| LeastPrecise {
                pixel: [pixel.pixel.0, pixel.pixel.1],
                device: texel(pixel.pixel).map(|x| Number(x.into())),
                double: pixel.double.map(Number),
                error: Number(*error),
            })
            .collect(),
        walker: is_32_bit.then(|| compare_with_walker(audit, texel, stored)),
        findings: audit.findings.iter().map(|finding| found(project, finding)).collect(),
        written: written.transpose()?,
    })
}

fn compare_with_walker(audit: &Audit, texel: impl Fn((u32, u32)) -> [f32; 4], stored: usize) -> WalkerComparison {
    let numbers = |values: [f32; 4]| values.map(|x| Number(x.into()));
    let apart = |audited: &AuditedPixel| {
        let device = texel(audited.pixel);
        (0..stored).map(|i| ulps(audited.single[i], device[i])).max().unwrap_or(0)
    };
    let mut order: Vec<(u32, &AuditedPixel)> = audit.pixels.iter().map(|audited| (apart(audited), audited)).collect();
    order.sort_by_key(|(ulps, _)| *ulps);
    let is_visible = |audited: &AuditedPixel| {
        let walker = AuditedPixel { double: audited.single.map(f64::from), ..audited.clone() };
        let mut apart = walker.apart(texel(audited.pixel), stored).into_iter().zip(walker.double);
        apart.any(|(apart, value)| apart > value.abs().max(1.0) / 255.0)
    };
    WalkerComparison {
        same: order.iter().filter(|(ulps, _)| *ulps == 0).count(),
        median_ulps: order.get(order.len() / 2).map_or(0, |o| o.0),
        largest_ulps: order.last().map_or(0, |o| o.0),
        visible: audit.pixels.iter().filter(|audited| is_visible(audited)).count(),
        furthest: order.last().filter(|(ulps, _)| *ulps > 0).map(|(_, audited)| LargestDeviation {
            pixel: [audited.pixel.0, audited.pixel.1],
            device: numbers(texel(audited.pixel)),
            walker: numbers(audited.single),
        }),
    }
}

/// The logarithms as greys of a screen, without alpha.
fn shown(map: &Pixels) -> Pixels {
    let grey = |x: f32| if x > BLACK { 1.0 - x.log10() / BLACK.log10() } else { 0.0 };
    let texels = map.texels.iter().map(|t| [grey(t[0]), grey(t[1]), grey(t[2]), 1.0]).collect();
    Pixels { texels, ..*map }
}

fn found(project: &Project, finding: &Finding) -> Found {
    Found {
        kind: finding.kind.name(),
        message: finding.kind.message(),
        written: SourceExcerpt::at(project, finding.span),
        numbers: finding.numbers.clone(),
        constant: finding.is_constant(),
        pixels: finding.pixels,
        pixel: [finding.pixel.0, finding.pixel.1],
        error: finding.error.map(|(error, _)| Number(error)),
        error_left: finding.error.map(|(_, left)| Number(left)),
    }
}

pub(super) fn words(audited: &Audited) -> String {
    let Audited { pass, frame, pixels, median, largest, visible, worst, walker, findings, written } = audited;
    let mut out = format!("Single against double precision: {pixels} pixels of {pass} in frame {frame}\n");
    let _ = writeln!(
        out,
        "  error: median {:.1e}, largest {:.1e}; {visible} pixels differ by more than 1/255",
        median.0, largest.0
    );
    let list = |all: &[Number; 4]| all.iter().map(|n| format!("{:.6}", n.0)).collect::<Vec<_>>().join(", ");
    for LeastPrecise { pixel: [x, y], device, double, error } in worst {
        let _ =
            writeln!(out, "  {x},{y}: ({}) is ({}) in double precision: {:.1e}", list(device), list(double), error.0);
    }
    if let Some(WalkerComparison { same, median_ulps, largest_ulps, visible, furthest }) = walker {
        let _ = writeln!(
            out,
            "  against single precision on the CPU: {same} of {pixels} pixels are identical; difference in ULPs: \
             median {median_ulps}, largest {largest_ulps}; {visible} differ by more than 1/255"
        );
        if let Some(LargestDeviation { pixel: [x, y], device, walker }) = furthest {
            let _ = writeln!(out, "  {x},{y}: ({}) is ({}) on the CPU", list(device), list(walker));
        }
    }
    if findings.is_empty() {
        out.push_str("  no undefined behaviour, no NaN, and no operation with large errors\n");
    }
    for found in findings {
        let at = found.written.place().unwrap_or_else(|| "in Eddy's own code".into());
        let _ = writeln!(out, "  {at}: {}", found.message);
        let [x, y] = found.pixel;
        let mut line = format!("      {}", one_line(&found.written.text));
        if !found.numbers.is_empty() {
            let _ = write!(line, "    {}", found.numbers);
        }
        if !found.constant {
            let _ = write!(line, "    in {} of {pixels} pixels, for example {x},{y}", found.pixels);
        }
        if let (Some(error), Some(left)) = (&found.error, &found.error_left) {
            let _ = write!(line, "; the error of {:.1e} would be {:.1e} if this were exact", error.0, left.0);
        }
        let _ = writeln!(out, "{line}");
    }
    if let Some(path) = written {
        let _ = writeln!(out, "  {}", shown_path(path));
    }
    out
}
