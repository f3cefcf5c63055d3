//! The result of a stability case: a line of the file of results.

use super::Number;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The purpose of a case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Defaults, without interaction.
    #[default]
    Untouched,
    /// A number of cells per step.
    Courant,
    /// A slider at an end, all others at their defaults.
    End,
    /// A slider of few integer values at one between its ends.
    Inner,
    Drag,
    /// Frames that are long, uneven, or take no time.
    Step,
    Resize,
    /// A texel that is not a number.
    Broken,
    /// Canvases of odd and extreme sizes.
    Size,
    /// Several sliders at their ends.
    Pairs,
    /// Larger canvases.
    Large,
    /// Viscosities across their slider on a large canvas, at several speeds.
    Viscosity,
    /// 100,000 frames.
    Long,
}

impl Kind {
    pub fn title(self) -> &'static str {
        match self {
            Kind::Untouched => "left alone",
            Kind::Courant => "cells a step",
            Kind::End => "a slider at an end",
            Kind::Inner => "a whole number between a slider's ends",
            Kind::Drag => "the mouse",
            Kind::Step => "time steps",
            Kind::Resize => "resize",
            Kind::Broken => "a texel that is no number",
            Kind::Size => "odd sizes",
            Kind::Pairs => "pairs of sliders at their ends",
            Kind::Large => "large canvases",
            Kind::Viscosity => "viscosities at 1920x1080",
            Kind::Long => "100,000 frames",
        }
    }
}

/// A value outside of a bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Violation {
    /// The first frame after which a value was outside.
    pub frame: u32,
    pub pass: String,
    pub quantity: String,
    /// The texel that is furthest outside in that frame, from the bottom left; `None` if the quantity belongs to the
    /// whole picture.
    pub texel: Option<(u32, u32)>,
    pub value: Number,
    pub low: Number,
    pub high: Number,
    /// The number of values of that frame that are outside.
    pub count: u64,
}

/// The outcome of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Everything stayed within its bounds.
    Held,
    /// A range was left as theory predicts for this case; all values stayed finite.
    LeftAsExpected(Violation),
    Left(Violation),
}

/// The time after the end of a disturbance until everything was within its bounds and no livelier than without it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Recovery {
    Frames(u32),
    /// It did not recover within the frames that were drawn after the disturbance.
    NotWithin(u32),
}

/// A case of a project.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StabilityRecord {
    pub project: String,
    /// The fingerprint of the project's texts: see `Subject::fingerprint`.
    pub texts: String,
    pub kind: Kind,
    pub case: String,
    pub size: (u32, u32),
    pub frames: u32,
    /// The sliders that are not at their defaults.
    pub settings: String,
    /// The reasons why a bound may be left; empty if none may.
    pub excuses: Vec<String>,
    /// `None` if it could not be drawn.
    pub outcome: Option<Outcome>,
    pub trouble: Option<String>,
    /// The recovery from a temporary disturbance.
    pub recovery: Option<Recovery>,
    /// The minimum and maximum value by quantity.
    pub extremes: BTreeMap<String, (Number, Number)>,
    /// Cells per step, at the largest speed of the run.
    pub courant: Option<Number>,
}

impl StabilityRecord {
    /// Returns whether both are the same case, regardless of texts and settings.
    pub fn is_same_case(&self, other: &StabilityRecord) -> bool {
        (&self.project, &self.case, self.size, self.frames) == (&other.project, &other.case, other.size, other.frames)
    }

    /// Returns whether all required bounds were kept.
    pub fn is_right(&self) -> bool {
        matches!(self.outcome, Some(Outcome::Held | Outcome::LeftAsExpected(_)))
    }

    pub fn offence(&self) -> Option<&Violation> {
        match self.outcome.as_ref()? {
            Outcome::Held => None,
            Outcome::LeftAsExpected(offence) | Outcome::Left(offence) => Some(offence),
        }
    }
}

impl Violation {
    /// Describes where and what was violated, and the allowed range.
    pub fn describe(&self) -> String {
        let place = self.texel.map_or(String::new(), |(x, y)| format!(" texel ({x}, {y})"));
        let others = if self.count > 1 { format!(", {} values outside", self.count) } else { String::new() };
        let number = |n: Number| short(n.0);
        format!(
            "frame {}, {}{place}: {} is {}, not {} to {}{others}",
            self.frame,
            self.pass,
            self.quantity,
            number(self.value),
            number(self.low),
            number(self.high)
        )
    }
}

/// Formats four significant digits.
pub(crate) fn short(x: f64) -> String {
    match x.abs() {
        _ if !x.is_finite() => x.to_string(),
        0.0 => "0".into(),
        size if !(1e-3..1e5).contains(&size) => format!("{x:.2e}"),
        size if size < 10.0 => format!("{x:.4}").trim_end_matches('0').trim_end_matches('.').into(),
        _ => format!("{x:.1}").trim_end_matches('0').trim_end_matches('.').into(),
    }
}
