//! Says what a study is: a question, methods that answer it, and a way to say how wrong an answer is.

use super::{LabError, Number, Rig, Setup, metrics::Norms};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Holds what a study is about, in words for its report.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// As the command line spells it.
    pub name: &'static str,
    pub title: &'static str,
    /// The scene and its reference, one or two sentences.
    pub text: &'static str,
    /// Says what a method's settings are.
    pub parameter: &'static str,
    pub unit: Unit,
    /// Says what the error is relative to, for the plot's axis.
    pub error: &'static str,
}

/// Says what a cost is divided by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// The simulated time of the study's scene, from start to end.
    Scene,
    /// One frame of a filter.
    Frame,
    /// One problem solved.
    Solve,
}

impl Unit {
    pub fn label(self) -> &'static str {
        match self {
            Unit::Scene => "ms for the simulated time of the scene",
            Unit::Frame => "ms per frame",
            Unit::Solve => "ms per solve",
        }
    }
}

/// Four grids, each twice the one before: a quick run measures on the first three, a full run on the last three.
pub fn three_of(extent: Extent, grids: &'static [u32; 4]) -> &'static [u32] {
    match extent {
        Extent::Quick => &grids[..3],
        Extent::Full => &grids[1..],
    }
}

/// Says how much to measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Extent {
    Quick,
    Full,
}

/// One way to compute the answer, with the settings that trade cost for error.
#[derive(Clone, Copy, Debug)]
pub struct Method {
    /// A word without spaces: in CSV, JSON and on the command line.
    pub name: &'static str,
    pub title: &'static str,
    /// In the order of the line that joins them.
    pub settings: &'static [f64],
    /// The setting at which the order of convergence is observed. One of `settings`.
    pub usual: f64,
}

/// A method at a setting on a grid: what is measured at once.
#[derive(Clone, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
pub struct Point {
    pub study: String,
    pub method: String,
    pub setting: f64,
    /// Texels from edge to edge.
    pub grid: u32,
}

/// A case in which many a method fails.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HardCase {
    pub name: String,
    pub passed: bool,
    /// Says what was measured, and the bound.
    pub detail: String,
}

impl HardCase {
    /// Passes if `value` is finite and at most `bound`.
    pub fn at_most(name: &str, value: f64, bound: f64) -> HardCase {
        let passed = value <= bound;
        HardCase { name: name.into(), passed, detail: format!("{value:.3e}, at most {bound:.3e}") }
    }
}

/// Holds what a point came to.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    pub norms: Norms,
    /// Further figures by name (`mass_drift`, `nu_eff/nu` …).
    pub values: BTreeMap<String, Number>,
    pub hard: Vec<HardCase>,
    /// Frames of the setup that make the study's [`Unit`].
    pub frames_per_unit: f64,
}

impl Measured {
    #[must_use]
    pub fn value(mut self, name: &str, value: f64) -> Self {
        self.values.insert(name.into(), Number(value));
        self
    }

    #[must_use]
    pub fn hard(mut self, case: HardCase) -> Self {
        self.hard.push(case);
        self
    }
}

/// A comparison that the report makes in a sentence: how much sooner a method reaches an error of 1 % than the best of
/// others.
#[derive(Clone, Copy, Debug)]
pub struct Race {
    pub method: &'static str,
    pub peers: &'static [&'static str],
    /// Says what the peers' points are called together.
    pub peers_are: &'static str,
}

/// A question about numerical methods. One file of `studies/` each.
pub trait Study: Sync {
    fn about(&self) -> About;

    /// Returns what a plot's y axis is called.
    fn error_label(&self) -> String {
        format!("relative L2 error {}", self.about().error)
    }

    fn methods(&self) -> &'static [Method];

    /// Grids from coarse to fine, at least three, each twice the one before. The plot shows [`Study::main_grid`].
    fn grids(&self, extent: Extent) -> &'static [u32];

    /// The grid of the plot, and of every cost.
    fn main_grid(&self, extent: Extent) -> u32 {
        let grids = self.grids(extent);
        grids[grids.len() - 1]
    }

    /// The project that draws the point, as it is at time 0.
    fn setup(&self, point: &Point) -> Setup;

    /// Runs the point and compares it with the reference.
    fn measure(&self, rig: &Rig, point: &Point) -> Result<Measured, LabError>;

    /// A finer grid is a finer answer to the same question, so that an order can be observed.
    fn has_order(&self) -> bool {
        true
    }

    /// Names a further figure whose sign tells on which side of the truth a method is, where a smaller setting is a
    /// finer answer: where it turns from one setting to the next, two errors cancel between them, and the report takes
    /// for the best error what finer settings keep.
    fn signed(&self) -> Option<&'static str> {
        None
    }

    /// Returns what the report compares by the time to an error of 1 %.
    fn race(&self) -> Option<Race> {
        None
    }

    /// Everything to measure: every setting on the main grid, and, where an order can be observed, the usual one on the
    /// others. A quick run has the usual setting and each second one of the others: the second, the fourth and so on.
    fn points(&self, extent: Extent) -> Vec<Point> {
        let main = self.main_grid(extent);
        let step = if extent == Extent::Quick { 2 } else { 1 };
        let mut points = Vec::new();
        for method in self.methods() {
            let point =
                |setting, grid| Point { study: self.about().name.into(), method: method.name.into(), setting, grid };
            let settings = method.settings.iter().enumerate();
            let settings = settings.filter(|(n, s)| (n + 1) % step == 0 || **s == method.usual);
            points.extend(settings.map(|(_, &setting)| point(setting, main)));
            let others = self.grids(extent).iter().filter(|grid| **grid != main && self.has_order());
            points.extend(others.map(|&grid| point(method.usual, grid)));
        }
        points
    }
}
