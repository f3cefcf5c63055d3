//! The first assignment of a traced pixel for which the GPU and the walker differ.

use super::{args::TraceArgs, machine::RunError, source_excerpt::SourceExcerpt};
use crate::{
    debugger::{
        divergence::{self, MAX_STEPS, Probes, assignments},
        trace::{self, Extent, Number, TraceError},
    },
    engine::{BuildOptions, Engine, PassInputs, Snapshot, Sources},
    media,
    playback::script::ScriptedInputs,
    project::Project,
};
use serde::Serialize;
use std::fmt::Write;

/// The result of a search.
#[derive(Debug, Serialize)]
pub(super) struct DivergenceReport {
    /// The number of compared assignments, and of all assignments of the pixel.
    compared: usize,
    assignments: usize,
    /// Null if all compared assignments are equal.
    first: Option<First>,
}

/// The first divergent assignment.
#[derive(Debug, Serialize)]
struct First {
    #[serde(flatten)]
    written: SourceExcerpt,
    name: String,
    /// The number of earlier evaluations of the expression.
    visit: u32,
    walker: Vec<Number>,
    /// Null if the GPU does not evaluate it this often.
    device: Option<Vec<Number>>,
    /// The distances between the two in ulps of single precision.
    ulps: Vec<u32>,
}

/// Searches the frame after those that are drawn: `before` is the contents of the engine's targets then.
pub(super) fn find(
    args: &TraceArgs,
    project: &Project,
    (engine, before): (Engine, Snapshot),
    (index, read): (usize, &PassInputs),
    mut inputs: ScriptedInputs,
) -> Result<DivergenceReport, RunError> {
    let (mut media, _) = media::gather(project, args.run.media.as_deref());
    media.set_camera_picture(engine.camera_picture());
    let pass = args.pass.pass.clone();
    let (skip, without) = (!args.run.no_skip, args.run.without_pass.set());
    let options = BuildOptions {
        requested: vec![pass.clone()],
        skip,
        disabled_optimisations: without,
        ..BuildOptions::default()
    };
    let mut values = project.custom_uniform_values.clone();
    let mut next = || {
        if let Some(of_frame) = inputs.next_change().and_then(|change| change.values) {
            values = of_frame;
        }
        inputs.next_frame()
    };
    for _ in 0..args.frame {
        next();
    }
    let frame = (next(), values);
    let pixel = args.pixel.unwrap_or_default();
    let sources = Sources::new(project);
    let extent = Extent { statements: args.max_statements, steps: MAX_STEPS };
    let trace = match trace::trace(&sources, index, read, pixel, extent) {
        Err(TraceError::Diagnostics(found)) => return Err(RunError::Diagnostics(found, project.sources())),
        other => other.map_err(anyhow::Error::from)?,
    };
    let mut probes = Probes::new((engine, before), (project, &media), options, pass, frame);
    let assignments = assignments(&sources, index, &trace);
    let found = divergence::search(assignments, args.probes, |assignment| probes.value(assignment, pixel));
    let found = found.map_err(anyhow::Error::from)?;
    let first = found.first.map(|first| First {
        written: SourceExcerpt::at(project, Some(first.assignment.span)),
        name: first.assignment.name,
        visit: first.assignment.probe.visit,
        walker: first.assignment.walker,
        device: first.device.map(|device| device.into_iter().map(Number::Float).collect()),
        ulps: first.ulps,
    });
    Ok(DivergenceReport { compared: found.compared, assignments: found.of, first })
}

pub(super) fn words(report: &DivergenceReport) -> String {
    let DivergenceReport { compared, assignments, first } = report;
    let of = format!("{compared} of {assignments} assignments compared");
    let Some(First { written, name, visit, walker, device, ulps }) = first else {
        return format!("  differs nowhere: {of}\n");
    };
    let list = |values: &[Number]| match values {
        [one] => one.to_string(),
        values => format!("({})", values.iter().map(Number::to_string).collect::<Vec<_>>().join(", ")),
    };
    let mut out = String::new();
    let place = written.place().unwrap_or_default();
    let _ = writeln!(out, "  differs first at {place}: {}    {of}", written.text);
    let again = if *visit > 0 { format!(", at evaluation {visit} (counted from 0)") } else { String::new() };
    let _ = match device {
        Some(device) => {
            let ulps: Vec<String> = ulps.iter().map(u32::to_string).collect();
            let ulps = ulps.join(", ");
            writeln!(
                out,
                "          {name} is {} on the CPU and {} on the GPU, {ulps} ULPs apart{again}",
                list(walker),
                list(device)
            )
        }
        None => {
            writeln!(out, "          {name} is {} on the CPU; the GPU does not reach this line{again}", list(walker))
        }
    };
    out
}
