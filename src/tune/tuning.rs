//! The result of a search.

use crate::{
    converge::Convergence,
    discover::Rejected,
    knob::Knob,
    search::{Point, frontier},
};
use eddy_engine::Picture;
use std::fmt::Write;

/// A value of one knob alone, and what it does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    pub value: f64,
    pub millis: f64,
    pub error: f64,
}

/// The setting that is proposed.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// With the time of the last measurement, interleaved with the present setting.
    pub point: Point,
    /// The worst error of the frames that were compared at the requested size: those of the search, and those of the
    /// others that are worst in small pictures.
    pub checked_error: f64,
    /// The time of the present setting in that measurement.
    pub present_millis: f64,
}

impl Proposal {
    /// Returns how many times as fast it is as the present setting.
    pub fn speed_up(&self) -> f64 {
        self.present_millis / self.point.millis
    }
}

/// The measurements of a project, and the proposed setting.
#[derive(Clone, Debug)]
pub struct Tuning {
    pub device: String,
    pub driver: String,
    pub backend: String,
    /// `timestamps` of the device, or `waited`.
    pub clock: String,
    pub size: (u32, u32),
    /// The size of smaller pictures that the search began with, if any: errors of single values are of these.
    pub screened: Option<(u32, u32)>,
    /// The frames that were compared.
    pub frames: Vec<u32>,
    /// Frames on which the proposal was checked besides, of the requested or a smaller size.
    pub held_out: usize,
    pub metric: String,
    pub bound: String,
    pub limit: f64,
    pub budget: Option<f64>,
    pub knobs: Vec<Knob>,
    /// For each knob the part of the time that its loops take, by what the pixels execute; `None` if that is not known.
    pub shares: Vec<Option<f64>>,
    /// For each knob.
    pub convergence: Vec<Convergence>,
    /// For each knob the values that were measured alone.
    pub effects: Vec<Vec<Effect>>,
    pub tried: Vec<Vec<f64>>,
    /// The values that count as converged.
    pub reference: Vec<f64>,
    /// The difference of two pictures that only a seed tells apart.
    pub noise: f64,
    pub seeds: u32,
    pub present: Point,
    /// Settings with a picture, if these were requested: as displayed, of the middle frame.
    pub pictures: Vec<(Vec<f64>, Picture)>,
    /// All settings that were measured.
    pub points: Vec<Point>,
    /// `None`: no setting meets the goal.
    pub proposal: Option<Proposal>,
    /// Knobs that were given up, with the reasons.
    pub rejected: Vec<Rejected>,
    /// Settings that were drawn.
    pub measured: usize,
    pub compile_seconds: f64,
    pub seconds: f64,
}

impl Tuning {
    /// Returns the settings that no other beats, the cheapest first.
    pub fn frontier(&self) -> Vec<&Point> {
        frontier(&self.points)
    }

    /// Returns a setting as `STEPS=32 AA=1`, with all knobs that any measured setting changes.
    pub fn named(&self, values: &[f64]) -> String {
        let is_moved = |at: &usize| self.points.iter().any(|point| point.values[*at] != self.knobs[*at].value);
        let name = |at: usize| format!("{}={}", self.knobs[at].name, self.knobs[at].shown(values[at]));
        let all: Vec<String> = (0..self.knobs.len()).filter(is_moved).map(name).collect();
        all.join(" ")
    }

    /// Returns every measured setting as a line of comma-separated values, after a line of names.
    pub fn csv(&self) -> String {
        let quoted = |text: &str| match text.contains([',', '"', '\n']) {
            true => format!("\"{}\"", text.replace('"', "\"\"")),
            false => text.to_owned(),
        };
        let mut out = String::new();
        for knob in &self.knobs {
            let _ = write!(out, "{},", quoted(&knob.name));
        }
        let _ = writeln!(out, "ms,error,frontier,present,proposed,metric,device,driver");
        let frontier = self.frontier();
        for point in &self.points {
            for (knob, value) in self.knobs.iter().zip(&point.values) {
                let _ = write!(out, "{},", knob.shown(*value));
            }
            let is_proposed = self.proposal.as_ref().is_some_and(|proposal| proposal.point.values == point.values);
            let _ = writeln!(
                out,
                "{:.6},{:.6},{},{},{},{},{},{}",
                point.millis,
                point.error,
                u8::from(frontier.contains(&point)),
                u8::from(point.values == self.present.values),
                u8::from(is_proposed),
                quoted(&self.metric),
                quoted(&self.device),
                quoted(&self.driver),
            );
        }
        out
    }
}

/// Returns the frames that are compared, and those that check the result, unless the user names some. A program without
/// state is drawn at moments that are far apart; one with state has to draw all frames before.
pub fn default_frames(has_state: bool, recorded: Option<u32>) -> (Vec<u32>, Vec<u32>) {
    match recorded {
        Some(count) => {
            let at = |parts: &[f64]| {
                let mut all: Vec<u32> =
                    parts.iter().map(|part| (part * f64::from(count.saturating_sub(1))) as u32).collect();
                all.dedup();
                all
            };
            (at(&[0.2, 0.45, 0.7, 0.95]), at(&[0.1, 0.35, 0.6, 0.85, 1.0]))
        }
        None if has_state => (vec![8, 24, 60], vec![4, 14, 19, 30, 37, 45, 52, 70, 80, 90, 104, 120]),
        None => (
            vec![20, 190, 430, 880],
            vec![5, 75, 120, 160, 240, 310, 365, 480, 540, 600, 665, 730, 790, 850, 940, 1000, 1080, 1140, 1200],
        ),
    }
}
