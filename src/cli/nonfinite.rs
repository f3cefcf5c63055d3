//! The first texel of a project that is NaN or infinite: its pass, its frame, and the operation that produced it.

use super::{
    args::TraceArgs,
    machine::{Machine, RunError},
    opening::{Opened, Opening},
    report::Report,
    source_excerpt::SourceExcerpt,
    terminal::one_line,
};
use crate::{
    debugger::{
        nonfinite::{self, NonfiniteTexels},
        trace::TraceError,
    },
    playback::{offline::Offline, script::ScriptedInputs},
    project::{PassName, Project},
};
use serde::Serialize;
use std::fmt::Write;

/// The first such texel.
#[derive(Debug, Serialize)]
pub(super) struct FirstNonfinite {
    pass: String,
    frame: u32,
    texel: [u32; 2],
    /// The value as stored; values that JSON cannot represent are strings.
    value: [crate::lab::Number; 4],
    /// The number of such texels of the pass in that frame.
    texels: usize,
    /// The operation; none if only the storage of the pass or a texel that it reads can have produced it.
    #[serde(rename = "born", skip_serializing_if = "Option::is_none")]
    origin: Option<NonfiniteOrigin>,
}

#[derive(Debug, Serialize)]
struct NonfiniteOrigin {
    message: &'static str,
    #[serde(flatten)]
    written: SourceExcerpt,
    numbers: String,
}

/// Searches the frames up to and including `args.frame`. `None` if every texel is finite.
pub(super) fn first(
    machine: &mut Machine,
    report: &mut Report,
    args: &TraceArgs,
    spec: &str,
    inputs: &ScriptedInputs,
) -> Result<Option<FirstNonfinite>, RunError> {
    let (project, mut offline) = start(machine, report, args, spec, inputs)?;
    let passes = nonfinite::drawn_passes(&project);
    let mut found = None;
    while report.frames <= args.frame && found.is_none() {
        let frame = report.frames;
        offline.draw()?;
        report.frames += 1;
        for pass in &passes {
            // Passes that no picture depends on are not drawn, and have no texels.
            let Ok(pixels) = offline.read(pass, 0) else { continue };
            if let Some(bad) = NonfiniteTexels::find(&pixels, nonfinite::stored_components(&project, pass)) {
                found = Some((pass.clone(), frame, bad.first, bad.count, pixels));
                break;
            }
        }
    }
    let Some((pass, frame, texel, texels, pixels)) = found else { return Ok(None) };
    let value = pixels.texels[(texel.1 * pixels.width + texel.0) as usize];
    let origin = origin(machine, args, spec, inputs, (&pass, frame, texel))?;
    Ok(Some(FirstNonfinite {
        pass: pass.key().to_owned(),
        frame,
        texel: [texel.0, texel.1],
        value: value.map(|x| crate::lab::Number(x.into())),
        texels,
        origin,
    }))
}

fn start(
    machine: &mut Machine,
    report: &mut Report,
    args: &TraceArgs,
    spec: &str,
    inputs: &ScriptedInputs,
) -> Result<(Project, Offline), RunError> {
    let opening = Opening::new(spec, &args.run, inputs).with_passes(&nonfinite::drawn_passes);
    let Opened { project, offline, .. } = opening.open(machine, report)?;
    Ok((project, offline))
}

/// Redraws everything up to that frame and walks the pass for that texel.
fn origin(
    machine: &mut Machine,
    args: &TraceArgs,
    spec: &str,
    inputs: &ScriptedInputs,
    (pass, frame, texel): (&PassName, u32, (u32, u32)),
) -> Result<Option<NonfiniteOrigin>, RunError> {
    let (project, mut offline) = start(machine, &mut Report::new(spec), args, spec, inputs)?;
    for _ in 0..frame {
        offline.draw()?;
    }
    let read = offline.draw_inspected(pass)?;
    let origin = match nonfinite::find_origin(&project, pass, &read, texel, args.max_statements) {
        Err(TraceError::Diagnostics(found)) => return Err(RunError::Diagnostics(found, project.sources())),
        other => other.map_err(anyhow::Error::from)?,
    };
    Ok(origin.map(|finding| NonfiniteOrigin {
        message: finding.kind.message(),
        written: SourceExcerpt::at(&project, finding.span),
        numbers: finding.numbers.clone(),
    }))
}

pub(super) fn words(spec: &str, frames: u32, first: Option<&FirstNonfinite>) -> String {
    let spec = one_line(spec);
    let Some(FirstNonfinite { pass, frame, texel: [x, y], texels, origin, .. }) = first else {
        return format!("{spec}: all texels of all passes are finite in {frames} frames");
    };
    let mut out = format!(
        "{spec}: the first NaN or infinity is in {pass}, frame {frame}, texel {x},{y} ({texels} in that frame)\n"
    );
    let place = origin.as_ref().and_then(|origin| Some((origin, origin.written.place()?)));
    let _ = match place {
        Some((NonfiniteOrigin { message, written, numbers }, place)) => {
            writeln!(out, "  {place}: {message}\n      {}    of {numbers}", written.text)
        }
        None => {
            writeln!(
                out,
                "  no operation produces it: it is too large for the pass's format, or was read from a texture"
            )
        }
    };
    out
}
