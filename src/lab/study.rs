//! The definition of a study: a question, methods that answer it, and a measure of their error.

use super::{LabError, Number, Rig, Setup, metrics::Norms};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The unit of a cost.
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

/// Splits four grids, each twice the previous one: a quick run measures on the first three, a full run on the last
/// three.
pub const fn three_of([a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    [[a, b, c], [b, c, d]]
}

/// The extent of the measurements.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Extent {
    Quick,
    Full,
}

/// A method of computing the answer, with the settings that trade cost for error.
#[derive(Clone, Copy, Debug)]
pub struct Method {
    /// A word without spaces: for CSV, JSON and the command line.
    pub name: &'static str,
    pub title: &'static str,
    /// In the order of the line that joins them.
    pub settings: &'static [f64],
    /// The setting at which the order of convergence is observed. One of `settings`.
    pub usual: f64,
}

/// A method at a setting on a grid: a unit of measurement.
#[derive(Clone, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
pub struct Point {
    pub study: String,
    pub method: String,
    pub setting: f64,
    /// Texels from edge to edge.
    pub grid: u32,
}

impl Point {
    /// Returns whether its method, one of these, is at its usual setting.
    pub fn is_usual(&self, methods: &[Method]) -> bool {
        methods.iter().any(|m| m.name == self.method && m.usual == self.setting)
    }
}

/// A case in which many methods fail.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct HardCase {
    pub name: String,
    pub passed: bool,
    /// The measured value, and the bound.
    pub detail: String,
}

impl HardCase {
    /// Creates a case that passes if `value` is finite and at most `bound`.
    pub fn at_most(name: &str, value: f64, bound: f64) -> HardCase {
        let passed = value <= bound;
        HardCase { name: name.into(), passed, detail: format!("{value:.3e}, at most {bound:.3e}") }
    }
}

/// The results of a point.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    pub norms: Norms,
    /// Further figures by name (`mass_drift`, `nu_eff/nu` …).
    pub values: BTreeMap<String, Number>,
    pub hard: Vec<HardCase>,
    /// The number of frames of the setup in the study's [`Unit`].
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
pub struct SpeedComparison {
    pub method: &'static str,
    pub peers: &'static [&'static str],
    /// A collective name for the peers' points.
    pub peers_are: &'static str,
}

/// A question about numerical methods. One file of `studies/` each.
#[derive(Clone, Copy, Debug)]
pub struct Study {
    /// The name on the command line.
    pub name: &'static str,
    pub title: &'static str,
    /// The scene and its reference, in one or two sentences.
    pub text: &'static str,
    /// The meaning of a method's settings.
    pub parameter: &'static str,
    pub unit: Unit,
    /// The quantity that the error is relative to, for the plot's axis.
    pub error: &'static str,
    /// The error is relative to a norm of the truth, which the plot's axis states.
    pub is_relative: bool,
    pub methods: &'static [Method],
    /// The grids of a quick run and of a full one, from coarse to fine, each twice the previous one.
    pub grids: [[u32; 3]; 2],
    /// The grid of the plot, and of every cost, if it is not the finest.
    pub main_grid: Option<u32>,
    /// A finer grid is a finer answer to the same question, so that an order can be observed.
    pub has_order: bool,
    /// A further figure whose sign indicates the side of the truth on which a method is, where a smaller setting is a
    /// finer answer: if it changes its sign from one setting to the next, two errors cancel in between, and the report
    /// takes as the best error only what finer settings keep.
    pub signed: Option<&'static str>,
    /// The methods do the same thing, so that one of them can be the best. Otherwise no winner, frontier or dominated
    /// method is named.
    pub is_contest: bool,
    /// The report compares these by the time to an error of 1 %.
    pub race: Option<SpeedComparison>,
    /// The project that draws the point, in its state at time 0.
    pub setup: fn(&Point) -> Setup,
    /// Runs the point and compares it with the reference.
    pub measure: fn(&Rig, &Point) -> Result<Measured, LabError>,
}

impl Study {
    /// Returns a study of relative errors with an order, without texts, methods and grids.
    pub const fn of(setup: fn(&Point) -> Setup, measure: fn(&Rig, &Point) -> Result<Measured, LabError>) -> Study {
        Study {
            name: "",
            title: "",
            text: "",
            parameter: "",
            unit: Unit::Frame,
            error: "",
            is_relative: true,
            methods: &[],
            grids: [[0; 3]; 2],
            main_grid: None,
            has_order: true,
            signed: None,
            is_contest: true,
            race: None,
            setup,
            measure,
        }
    }

    /// Returns the label of a plot's y axis.
    pub fn error_label(&self) -> String {
        if self.is_relative { format!("relative L2 error {}", self.error) } else { self.error.into() }
    }

    pub fn grids(&self, extent: Extent) -> [u32; 3] {
        self.grids[usize::from(extent == Extent::Full)]
    }

    /// Returns the grid of the plot, and of every cost.
    pub fn main_grid(&self, extent: Extent) -> u32 {
        self.main_grid.unwrap_or(self.grids(extent)[2])
    }

    /// Returns everything to measure: every setting on the main grid, and, if an order can be observed, the usual one
    /// on the others. A quick run has the usual setting and every second one of the others: the second, the fourth and
    /// so on.
    pub fn points(&self, extent: Extent) -> Vec<Point> {
        let main = self.main_grid(extent);
        let step = if extent == Extent::Quick { 2 } else { 1 };
        let mut points = Vec::new();
        for method in self.methods {
            let point = |setting, grid| Point { study: self.name.into(), method: method.name.into(), setting, grid };
            let settings = method.settings.iter().enumerate();
            let settings = settings.filter(|(n, s)| (n + 1) % step == 0 || **s == method.usual);
            points.extend(settings.map(|(_, &setting)| point(setting, main)));
            let others = self.grids(extent).into_iter().filter(|grid| *grid != main && self.has_order);
            points.extend(others.map(|grid| point(method.usual, grid)));
        }
        points
    }
}
