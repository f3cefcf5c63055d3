//! The output of `eddy tune`: tables, JSON and the plot.

use super::super::{report::Report, terminal::one_line};
use crate::{
    metrics::Number,
    tune::{Convergence, Effect, Found, Knob, Point, Rejected, Tuning},
};
use serde::Serialize;
use std::{collections::BTreeMap, fmt::Write};

/// The report of `render`, and the result.
#[derive(Serialize)]
pub(super) struct JsonLine<'a> {
    #[serde(flatten)]
    pub report: &'a Report,
    #[serde(flatten)]
    pub result: Option<&'a serde_json::Value>,
}

#[derive(Serialize)]
pub(super) struct JsonKnob {
    pub name: String,
    pub place: String,
    /// Counted from 1, in characters; none for a setting of the project.
    pub column: Option<usize>,
    pub value: f64,
    pub kind: String,
    pub why: String,
    pub values: Vec<f64>,
    pub finest: Option<f64>,
    pub larger_costs_more: bool,
}

#[derive(Serialize)]
pub(super) struct Listed {
    knobs: Vec<JsonKnob>,
    rejected: Vec<Rejected>,
}

#[derive(Serialize)]
struct JsonPoint {
    values: BTreeMap<String, f64>,
    ms: Number,
    error: Number,
}

#[derive(Serialize)]
struct JsonProposal {
    #[serde(flatten)]
    point: JsonPoint,
    checked_error: Number,
    present_ms: f64,
    speed_up: f64,
}

#[derive(Serialize)]
struct JsonConvergence<'a> {
    knob: &'a str,
    /// The part of the time that its loops take.
    share: Option<f64>,
    #[serde(flatten)]
    convergence: &'a Convergence,
}

#[derive(Serialize)]
pub(super) struct JsonResult<'a> {
    device: &'a str,
    driver: &'a str,
    backend: &'a str,
    clock: &'a str,
    width: u32,
    height: u32,
    compared: &'a [u32],
    metric: &'a str,
    bound: &'a str,
    limit: f64,
    /// Width and height of the pictures that the search began with.
    screened: Option<(u32, u32)>,
    budget_ms: Option<f64>,
    noise: f64,
    seeds: u32,
    knobs: Vec<JsonKnob>,
    convergence: Vec<JsonConvergence<'a>>,
    reference: BTreeMap<String, f64>,
    present: JsonPoint,
    proposal: Option<JsonProposal>,
    frontier: Vec<JsonPoint>,
    points: Vec<JsonPoint>,
    rejected: Vec<Rejected>,
    measured: usize,
    seconds: f64,
}

fn named(knobs: &[Knob], values: &[f64]) -> BTreeMap<String, f64> {
    knobs.iter().zip(values).map(|(knob, value)| (knob.name.clone(), *value)).collect()
}

pub(super) fn result<'a>(tuning: &'a Tuning, found: &Found) -> JsonResult<'a> {
    let point = |point: &Point| JsonPoint {
        values: named(&tuning.knobs, &point.values),
        ms: Number(point.millis),
        error: Number(point.error),
    };
    let proposal = tuning.proposal.as_ref().map(|proposal| JsonProposal {
        point: point(&proposal.point),
        checked_error: Number(proposal.checked_error),
        present_ms: proposal.present_millis,
        speed_up: proposal.speed_up(),
    });
    let names = tuning.knobs.iter().zip(&tuning.convergence);
    JsonResult {
        device: &tuning.device,
        driver: &tuning.driver,
        backend: &tuning.backend,
        clock: &tuning.clock,
        width: tuning.size.0,
        height: tuning.size.1,
        compared: &tuning.frames,
        metric: &tuning.metric,
        bound: &tuning.bound,
        limit: tuning.limit,
        screened: tuning.screened,
        budget_ms: tuning.budget,
        noise: tuning.noise,
        seeds: tuning.seeds,
        knobs: tuning.knobs.iter().map(JsonKnob::new).collect(),
        convergence: names
            .zip(&tuning.shares)
            .map(|((knob, convergence), share)| JsonConvergence { knob: &knob.name, share: *share, convergence })
            .collect(),
        reference: named(&tuning.knobs, &tuning.reference),
        present: point(&tuning.present),
        proposal,
        frontier: tuning.frontier().into_iter().map(point).collect(),
        points: tuning.points.iter().map(point).collect(),
        rejected: tuning.rejected.iter().chain(&found.rejected).cloned().collect(),
        measured: tuning.measured,
        seconds: tuning.seconds,
    }
}

pub(super) fn listed(found: &Found) -> Listed {
    let others = found.others.iter().map(|(_, rejected)| rejected.clone());
    Listed {
        knobs: found.knobs.iter().map(JsonKnob::new).collect(),
        rejected: found.rejected.iter().cloned().chain(others).collect(),
    }
}

/// Returns the values of a knob as `8, 16, 32`.
fn values(knob: &Knob) -> String {
    let all: Vec<String> = knob.ladder.values.iter().map(|value| knob.shown(*value)).collect();
    all.join(", ")
}

pub(super) fn list(found: &Found) -> String {
    let mut out = String::new();
    let width = found.knobs.iter().map(|knob| knob.name.chars().count()).max().unwrap_or(0);
    for knob in &found.knobs {
        let name = one_line(&knob.name);
        let _ = writeln!(out, "{name:width$} = {:8} {}: {}", knob.shown(knob.value), knob.place, knob.why);
        let finer = knob.finest.map_or(String::new(), |finest| format!("; converges towards {}", knob.shown(finest)));
        let _ = writeln!(out, "{:width$}   tries {}{finer}", "", values(knob));
    }
    if found.knobs.is_empty() {
        out.push_str("no knobs\n");
    }
    let others: Vec<&Rejected> =
        found.rejected.iter().chain(found.others.iter().map(|(_, rejected)| rejected)).collect();
    if !others.is_empty() {
        out.push_str("not tried:\n");
    }
    for rejected in others {
        let _ = writeln!(out, "  {} ({}): {}", one_line(&rejected.name), rejected.place, rejected.reason);
    }
    out
}

/// Returns the goal as words.
pub(super) fn goal(tuning: &Tuning) -> String {
    tuning.budget.map_or_else(|| tuning.bound.clone(), |budget| format!("{budget} ms per frame"))
}

fn number(value: f64) -> String {
    match value {
        0.0 => "0".into(),
        v if v.abs() < 1e-3 => format!("{v:.1e}"),
        v => format!("{v:.4}"),
    }
}

/// Returns what happens to a knob when it is made more exact.
fn converged(knob: &Knob, convergence: &Convergence) -> Option<String> {
    let name = &knob.name;
    Some(match convergence {
        Convergence::Reached { value } if *value == knob.value => {
            format!("{name} has converged at {}", knob.shown(*value))
        }
        Convergence::Reached { value } => format!("{name} converges at {}", knob.shown(*value)),
        Convergence::Approaching { value, rest } => {
            format!(
                "{name} is compared with {}, where the next step changes the picture by about {}",
                knob.shown(*value),
                number(*rest)
            )
        }
        Convergence::Diverging { change } => format!(
            "{name} does not converge: twice its value changes the picture by {} again, so it decides what is drawn. Its \
             present value is the reference",
            number(*change)
        ),
        Convergence::Untried => return None,
    })
}

pub(super) fn words(project: &str, tuning: &Tuning, found: &Found) -> String {
    let mut out = String::new();
    let (width, height) = tuning.size;
    let frames: Vec<String> = tuning.frames.iter().map(u32::to_string).collect();
    let _ = writeln!(
        out,
        "{}: {} settings measured in {:.0} s, {width}x{height}, frames {}, on {} ({}, {})",
        one_line(project),
        tuning.points.len(),
        tuning.seconds,
        frames.join(", "),
        tuning.device,
        tuning.backend,
        tuning.driver
    );
    if let Some((width, height)) = tuning.screened {
        let _ = writeln!(
            out,
            "frames take long: {width}x{height} was searched first, and the errors of single values are of that size"
        );
    }
    if tuning.seeds > 1 {
        let _ = writeln!(
            out,
            "the picture is noisy ({} between two seeds): the reference is the mean of many seeds, and the error of a setting \
             includes its noise",
            number(tuning.noise)
        );
    }
    out.push_str("\nknobs\n");
    let name = tuning.knobs.iter().map(|knob| knob.name.chars().count()).max().unwrap_or(0);
    for ((knob, effects), state) in tuning.knobs.iter().zip(&tuning.effects).zip(&tuning.convergence) {
        let _ = writeln!(
            out,
            "  {:name$} = {:8} {}: {}",
            one_line(&knob.name),
            knob.shown(knob.value),
            knob.place,
            knob.why
        );
        if let Some(words) = converged(knob, state) {
            let _ = writeln!(out, "  {:name$}   {}", "", one_line(&words));
        }
        for Effect { value, millis, error } in effects.iter().filter(|effect| effect.value != knob.value) {
            let percent = (millis / tuning.present.millis - 1.0) * 100.0;
            let _ = writeln!(
                out,
                "  {:name$}   {:>8} {percent:+6.0} % ms, error {}",
                "",
                knob.shown(*value),
                number(*error)
            );
        }
    }
    for rejected in tuning.rejected.iter().chain(&found.rejected) {
        let _ = writeln!(
            out,
            "  not tried: {} ({}): {}",
            one_line(&rejected.name),
            rejected.place,
            one_line(&rejected.reason)
        );
    }
    let _ = writeln!(out, "\nfrontier ({}; error is {})", tuning.clock, one_line(&tuning.metric));
    let mut rows: Vec<&Point> = tuning.frontier();
    if !rows.iter().any(|point| point.values == tuning.present.values) {
        rows.push(&tuning.present);
    }
    rows.sort_by(|a, b| a.millis.total_cmp(&b.millis));
    for point in rows {
        let is_proposed = tuning.proposal.as_ref().is_some_and(|proposal| proposal.point.values == point.values);
        let mark = match (is_proposed, point.values == tuning.present.values) {
            (true, true) => "present, proposed",
            (true, false) => "proposed",
            (false, true) => "present",
            (false, false) => "",
        };
        let error = number(point.error);
        let _ =
            writeln!(out, "  {:>9.3} ms  {error:>9}  {}  {mark}", point.millis, one_line(&tuning.named(&point.values)));
    }
    out.push('\n');
    match &tuning.proposal {
        None => {
            let _ = writeln!(out, "no measured setting meets {}", one_line(&goal(tuning)));
        }
        Some(proposal) if proposal.point.values == tuning.present.values => {
            let _ = writeln!(out, "the present setting is the best that meets {}", one_line(&goal(tuning)));
        }
        Some(proposal) => {
            let _ = writeln!(
                out,
                "proposed for {}: {}\n  {:.3} ms instead of {:.3} ms ({:.2} times as fast), error at most {} in {} frames",
                one_line(&goal(tuning)),
                one_line(&tuning.named(&proposal.point.values)),
                proposal.point.millis,
                proposal.present_millis,
                proposal.speed_up(),
                number(proposal.checked_error),
                tuning.frames.len() + tuning.held_out
            );
        }
    }
    out
}

/// Returns the plot; `None` if there is nothing to draw.
pub(super) fn plot(tuning: &Tuning) -> anyhow::Result<Option<String>> {
    Ok(super::plotted(tuning).svg()?)
}
