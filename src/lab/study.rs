//! Says what a study is: a question, methods that answer it, and a way to say how wrong an answer is.

use super::{LabError, Number, Rig, Setup, metrics::Norms};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

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
pub const fn three_of([a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    [[a, b, c], [b, c, d]]
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

impl Point {
    /// Returns whether its method, one of these, is at its usual setting.
    pub fn is_usual(&self, methods: &[Method]) -> bool {
        methods.iter().any(|m| m.name == self.method && m.usual == self.setting)
    }
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
pub struct SpeedComparison {
    pub method: &'static str,
    pub peers: &'static [&'static str],
    /// Says what the peers' points are called together.
    pub peers_are: &'static str,
}

/// A question about numerical methods. One file of `studies/` each.
#[derive(Clone, Copy, Debug)]
pub struct Study {
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
    /// The error is a part of a norm of the truth, which the plot's axis says.
    pub is_relative: bool,
    pub methods: &'static [Method],
    /// Grids of a quick run and of a full one, from coarse to fine, each twice the one before.
    pub grids: [[u32; 3]; 2],
    /// The grid of the plot, and of every cost, where it is not the finest.
    pub main_grid: Option<u32>,
    /// A finer grid is a finer answer to the same question, so that an order can be observed.
    pub has_order: bool,
    /// Names a further figure whose sign tells on which side of the truth a method is, where a smaller setting is a
    /// finer answer: where it turns from one setting to the next, two errors cancel between them, and the report takes
    /// for the best error what finer settings keep.
    pub signed: Option<&'static str>,
    /// The methods do the same thing, so that one of them can be the best. If not, no winner, frontier or method that
    /// another beats is named.
    pub is_contest: bool,
    /// The report compares these by the time to an error of 1 %.
    pub race: Option<SpeedComparison>,
    /// The project that draws the point, as it is at time 0.
    pub setup: fn(&Point) -> Setup,
    /// Runs the point and compares it with the reference.
    pub measure: fn(&Rig, &Point) -> Result<Measured, LabError>,
}

impl Study {
    /// A study of relative errors with an order, whose words, methods and grids are yet to be given.
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

    /// Returns what a plot's y axis is called.
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

    /// Everything to measure: every setting on the main grid, and, where an order can be observed, the usual one on the
    /// others. A quick run has the usual setting and each second one of the others: the second, the fourth and so on.
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
