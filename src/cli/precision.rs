//! `eddy lab precision PROJECT`: the loss of a project if its passes are stored in 16-bit floats, and the difference of
//! its picture from double precision.

use super::{
    args::PrecisionArgs,
    audit::{self, Audited},
    machine::{Machine, RunError},
    report::{Printer, Report},
    terminal::one_line,
};
use crate::{
    engine::Engine,
    lab::{
        Rig,
        precision::{self, Comparison, PrecisionError},
    },
    media,
    playback::{offline, script::ScriptedInputs},
    project,
};
use serde::Serialize;
use std::{fmt::Write, io};

#[derive(Debug, Serialize)]
struct Compared {
    width: u32,
    height: u32,
    device: String,
    /// True if the device truncates 16-bit stores instead of rounding.
    cuts_off: bool,
    #[serde(flatten)]
    comparison: Comparison,
}

/// The report of `render`, and the comparison.
#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(flatten)]
    compared: Option<&'a Compared>,
    /// Comparison with double precision.
    #[serde(skip_serializing_if = "Option::is_none")]
    double: Option<&'a Audited>,
}

pub(super) fn run(args: &PrecisionArgs, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::of(&args.run);
    for spec in &args.project {
        let mut report = Report::new(spec);
        let compared = machine
            .attempt(&mut report, |machine, report| compare(machine, report, args, spec, inputs.clone()))
            .flatten();
        let is_well = report.errors() == 0;
        let double = is_well
            .then(|| {
                machine.attempt(&mut report, |machine, report| audit::run(machine, report, args, spec, inputs.clone()))
            })
            .flatten();
        let mut words = compared.as_ref().map_or(String::new(), |compared| words(spec, compared));
        if let Some(double) = &double {
            words.push_str(&if words.is_empty() { format!("{}\n", one_line(spec)) } else { String::new() });
            words.push_str(&audit::words(double));
        }
        let line = JsonLine { report: &report, compared: compared.as_ref(), double: double.as_ref() };
        printer.print_as(&line, &report, words.trim_end())?;
    }
    Ok(printer.exit_code())
}

fn compare(
    machine: &mut Machine,
    report: &mut Report,
    args: &PrecisionArgs,
    spec: &str,
    mut inputs: ScriptedInputs,
) -> Result<Option<Compared>, RunError> {
    let loaded = project::load(spec)?;
    let mut project = loaded.project;
    report.diagnose(&loaded.warnings, &loaded.sources, Some(&project));
    for assignment in &args.run.set {
        project.set_custom_uniform(assignment).map_err(|why| anyhow::anyhow!("--set {why}"))?;
    }
    let (media, mut missing) = media::gather(&project, args.run.media.as_deref());
    missing.extend(media::unrecorded(&project));
    report.diagnose(&missing, &loaded.sources, Some(&project));
    let gpu = machine.gpu()?;
    let (width, height) = args.run.canvas();
    let next = |engines: &mut [Engine; 2]| {
        if let Some(change) = inputs.next_change() {
            engines.iter_mut().try_for_each(|engine| offline::change(engine, &change))?;
        }
        Ok(inputs.next_frame())
    };
    let comparison = match precision::halved_by(&gpu, &project, &media, (width, height), args.frames(), next) {
        Ok(comparison) => comparison,
        Err(PrecisionError::Build(error)) => return Err(error.into()),
        Err(PrecisionError::Engine(error)) => return Err(error.into()),
        // Nothing is stored that could be stored in fewer bits.
        Err(PrecisionError::NoFloats) => return Ok(None),
    };
    report.frames = args.frames();
    let cuts_off = precision::cuts_off(&Rig::new(gpu.clone())).map_err(anyhow::Error::from)?;
    Ok(Some(Compared { width, height, device: gpu.describe(), cuts_off, comparison }))
}

fn words(spec: &str, compared: &Compared) -> String {
    let Compared { width, height, device, cuts_off, comparison } = compared;
    let spec = one_line(spec);
    let mut out =
        format!("{spec}: 16-bit floats against 32, {width}x{height}, {} frames, {device}\n", comparison.frames);
    out.push_str(if *cuts_off {
        "This device truncates 16-bit stores; one that rounds to nearest, as GPUs do, has half the error, in both \
         directions.\n"
    } else {
        "This device rounds 16-bit stores to nearest.\n"
    });
    let _ = writeln!(
        out,
        "{:<20} {:<18} {:>6} {:>10} {:>10} {:>10} {:>11}",
        "pass", "formats", "frame", "L1", "L2", "Linf", "mass drift"
    );
    let mut rows: Vec<_> = comparison.rows.iter().collect();
    rows.sort_by(|a, b| a.pass.cmp(&b.pass).then(a.frame.cmp(&b.frame)));
    for row in rows {
        let formats = if row.formats[0] == row.formats[1] { row.formats[0].into() } else { row.formats.join(", ") };
        let n = row.norms;
        let _ = writeln!(
            out,
            "{:<20} {formats:<18} {:>6} {:>10.2e} {:>10.2e} {:>10.2e} {:>11.2e}",
            row.pass, row.frame, n.l1, n.l2, n.linf, row.mass_drift
        );
    }
    let _ = match comparison.first_visible {
        Some(frame) => writeln!(
            out,
            "The picture differs by more than 1/255 from frame {frame} on; at most by {:.3}.",
            comparison.largest
        ),
        None => writeln!(out, "The picture differs by at most {:.5}, which is less than 1/255.", comparison.largest),
    };
    out
}
