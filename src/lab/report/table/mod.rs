//! The points of a study with derived results: orders, the frontier, the time to an error.

use crate::{
    Extent, Measured, Method, Number, Point, Results, Study,
    cost::{Cost, Times},
    metrics::{first_reach, order},
};
use std::collections::BTreeSet;

/// The error for which the time is reported.
pub const TARGET: f64 = 0.01;

/// A point of the main grid.
#[derive(Clone, Debug)]
pub struct Row {
    pub method: &'static Method,
    pub point: Point,
    pub measured: Option<Measured>,
    pub trouble: Option<String>,
    pub cost: Option<Cost>,
    /// The milliseconds for the study's unit; an estimate without `cost`.
    pub millis: Option<Times>,
    /// No point that passes its hard cases is both cheaper and more accurate.
    pub is_frontier: bool,
    /// Such a point exists.
    pub is_dominated: bool,
}

impl Row {
    pub fn error(&self) -> Option<f64> {
        self.measured.as_ref().map(|m| m.norms.l2)
    }

    /// Returns the number of passed hard cases, and of all.
    pub fn hard(&self) -> (usize, usize) {
        let all = self.measured.as_ref().map_or(&[][..], |m| &m.hard);
        (all.iter().filter(|h| h.passed).count(), all.len())
    }

    pub fn passes(&self) -> bool {
        let (passed, all) = self.hard();
        passed == all
    }

    /// Returns (milliseconds, error), if both are numbers above 0.
    pub fn place(&self) -> Option<(f64, f64)> {
        let (x, y) = (self.millis?.median, self.error()?);
        (x.is_finite() && y.is_finite() && x > 0.0 && y > 0.0).then_some((x, y))
    }

    pub fn look(&self) -> Look {
        match (self.passes(), self.is_dominated) {
            (false, _) => Look::Hollow,
            (true, true) => Look::Grey,
            (true, false) => Look::Full,
        }
    }

    pub fn value(&self, name: &str) -> Option<f64> {
        self.measured.as_ref()?.values.get(name).map(|Number(x)| *x)
    }
}

/// The fill of a point's marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// No point is cheaper and more accurate.
    Full,
    /// Another point is.
    Grey,
    /// It fails a hard case.
    Hollow,
}

/// The number of colours that methods cycle through, in the report and in the window.
pub const COLOURS: usize = 12;

/// Returns the corners of the nth method's marker around (0, 0), y down; the last is the first. About 8 from the
/// centre.
pub fn sign(n: usize) -> Vec<[f64; 2]> {
    // Methods of the same colour have different markers.
    let sign = (n + n / COLOURS) % 6;
    let (count, turn) = [(16, 0.0), (4, 0.125), (3, -0.25), (4, 0.0), (3, 0.25), (6, 0.0)][sign];
    let radius = [7.5, 9.0, 9.5, 8.5, 9.5, 8.0][sign];
    let corner = |i: i32| {
        let angle = std::f64::consts::TAU * (f64::from(i) / f64::from(count) + turn);
        [radius * angle.cos(), radius * angle.sin()]
    };
    (0..=count).map(corner).collect()
}

/// The results of a method on several grids.
#[derive(Clone, Debug)]
pub struct Convergence {
    pub method: &'static Method,
    /// (grid, error), from coarse to fine.
    pub errors: Vec<(u32, f64)>,
    /// Between the finest two.
    pub order: f64,
}

/// A study's results.
#[derive(Clone, Debug)]
pub struct Table {
    pub study: &'static Study,
    pub grid: u32,
    pub rows: Vec<Row>,
    pub convergence: Vec<Convergence>,
}

/// The way in which a method reaches an error of 1 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// In this number of milliseconds, interpolated between settings that pass their hard cases.
    In(f64),
    /// As `In`, but only with settings that fail a hard case.
    Failing(f64),
    Never,
}

/// The smallest reliable error of a method, of settings that pass their hard cases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Best {
    pub error: f64,
    /// The cheapest setting from which no finer one has a larger error.
    pub setting: f64,
    pub millis: f64,
    /// Two neighbouring settings, the coarser first, between which the figure changes its sign: an error below `error`
    /// there is a coincidence.
    pub turn: Option<[f64; 2]>,
}

impl Table {
    /// Returns `None` if there are no results of the study.
    pub fn new(study: &'static Study, results: &Results) -> Option<Table> {
        Self::with_estimates(study, results, |_| None)
    }

    /// Does the same as [`Table::new`]; `estimate` returns the milliseconds per frame of a point without a measured
    /// cost.
    pub fn with_estimates(
        study: &'static Study,
        results: &Results,
        estimate: impl Fn(&Point) -> Option<f64>,
    ) -> Option<Table> {
        let extent = results.runs.iter().map(|r| r.extent).max_by_key(|e| *e == Extent::Full)?;
        let grid = study.main_grid(extent);
        let points = study.points(extent);
        let mut rows = Vec::new();
        for method in study.methods {
            for point in points.iter().filter(|p| p.method == method.name && p.grid == grid) {
                let Some(record) = results.error(point) else { continue };
                let cost = results.cost(point).copied();
                let measured = record.measured.clone();
                let estimated = || estimate(point).map(|ms| Times { median: ms, min: ms, max: ms });
                let frame = cost.map(|cost| cost.frame).or_else(estimated);
                let millis = frame.zip(measured.as_ref()).map(|(frame, m)| frame.by(m.frames_per_unit));
                rows.push(Row {
                    method,
                    point: point.clone(),
                    measured,
                    trouble: record.trouble.clone(),
                    cost,
                    millis,
                    is_frontier: false,
                    is_dominated: false,
                });
            }
        }
        if rows.is_empty() {
            return None;
        }
        let places: Vec<(usize, (f64, f64), bool)> =
            rows.iter().enumerate().filter_map(|(i, r)| Some((i, r.place()?, r.passes()))).collect();
        for &(i, (x, y), passes) in places.iter().filter(|_| study.is_contest) {
            let beaten = places.iter().any(|&(j, (u, v), ok)| j != i && ok && u <= x && v <= y && (u < x || v < y));
            (rows[i].is_dominated, rows[i].is_frontier) = (beaten, passes && !beaten);
        }
        let convergence = study.methods.iter().filter_map(|method| {
            let mut errors: Vec<(u32, f64)> = points
                .iter()
                .filter(|p| p.method == method.name && p.setting == method.usual && study.has_order)
                .filter_map(|p| Some((p.grid, results.measured(p)?.norms.l2)))
                .collect();
            errors.sort_by_key(|(grid, _)| *grid);
            let &[.., (coarse, a), (fine, b)] = &errors[..] else { return None };
            let order = order(a, b, f64::from(fine) / f64::from(coarse));
            (errors.len() >= 3).then_some(Convergence { method, errors, order })
        });
        Some(Table { study, grid, convergence: convergence.collect(), rows })
    }

    pub fn methods(&self) -> Vec<&'static Method> {
        let mut methods: Vec<&'static Method> = Vec::new();
        for row in &self.rows {
            if !methods.iter().any(|m| m.name == row.method.name) {
                methods.push(row.method);
            }
        }
        methods
    }

    pub fn of(&self, method: &Method) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|r| r.method.name == method.name)
    }

    /// Returns the row at a method's usual setting.
    pub fn usual(&self, method: &Method) -> Option<&Row> {
        self.of(method).find(|r| r.point.setting == method.usual)
    }

    pub fn order(&self, method: &Method) -> Option<f64> {
        self.convergence.iter().find(|c| c.method.name == method.name).map(|c| c.order)
    }

    /// Returns the milliseconds until a method that passes its hard cases has an error of 1 %: between its settings,
    /// interpolated in the logarithms.
    pub fn millis_to_target(&self, method: &Method) -> Option<f64> {
        let places: Vec<(f64, f64)> = self.of(method).filter(|r| r.passes()).filter_map(Row::place).collect();
        first_reach(&places, TARGET)
    }

    /// Does the same as [`Table::millis_to_target`], with the reason if there is no such time.
    pub fn reach(&self, method: &Method) -> Reach {
        match (self.millis_to_target(method), self.millis_of_any(method)) {
            (Some(millis), _) => Reach::In(millis),
            (None, Some(millis)) => Reach::Failing(millis),
            (None, None) => Reach::Never,
        }
    }

    /// Returns the milliseconds to the target, including settings that fail hard cases.
    fn millis_of_any(&self, method: &Method) -> Option<f64> {
        first_reach(&self.of(method).filter_map(Row::place).collect::<Vec<_>>(), TARGET)
    }

    /// Returns a method's best error. In a study with a signed figure ([`Study::signed`]) the smallest error may be at
    /// its change of sign: there an error of time and one of space cancel, and a shorter step, which reduces only the
    /// one, reveals the other. So if the sign changes next to the smallest error and a finer setting has a larger
    /// error, the best one is the largest from that change on.
    pub fn best(&self, method: &Method) -> Option<Best> {
        let mut rows: Vec<(&Row, (f64, f64))> =
            self.of(method).filter(|r| r.passes()).filter_map(|r| Some((r, r.place()?))).collect();
        rows.sort_by(|a, b| b.0.point.setting.total_cmp(&a.0.point.setting));
        let error = |i: usize| rows[i].1.1;
        let least = (0..rows.len()).min_by(|a, b| error(*a).total_cmp(&error(*b)))?;
        let best = |from: usize, error: f64, turn| {
            let (row, (millis, _)) = rows[from];
            Some(Best { error, setting: row.point.setting, millis, turn })
        };
        let sign = |i: usize| self.study.signed.and_then(|name| rows.get(i)?.0.value(name)).map(f64::signum);
        let turns = |i: usize| sign(i).zip(sign(i + 1)).is_some_and(|(a, b)| a != b);
        // The first setting on the finer side of a change of sign next to the smallest error.
        let beyond = [least.checked_sub(1), Some(least)].into_iter().flatten().find(|i| turns(*i)).map(|i| i + 1);
        let Some(beyond) = beyond.filter(|_| (least + 1..rows.len()).any(|i| error(i) > error(least))) else {
            return best(least, error(least), None);
        };
        let kept = (beyond..rows.len()).map(error).fold(0.0, f64::max);
        let from = (0..=beyond).rev().take_while(|i| error(*i) <= kept).last().unwrap_or(beyond);
        best(from, kept, Some([beyond - 1, beyond].map(|i| rows[i].0.point.setting)))
    }

    /// Returns the study's [`SpeedComparison`] as a sentence: `None` if it has none, or if its costs are not known.
    /// Peers need not pass their hard cases: their best counts.
    pub fn verdict(&self) -> Option<String> {
        let race = self.study.race?;
        let methods = self.methods();
        let method = methods.iter().find(|m| m.name == race.method)?;
        let peers = || methods.iter().filter(|m| race.peers.contains(&m.name));
        let places = |m| self.of(m).filter_map(|r: &Row| Some((r, r.place()?)));
        places(*method).next()?;
        let percent = 100.0 * TARGET;
        let Some(own) = self.millis_to_target(method) else {
            return Some(format!("{} does not reach an error of {percent} %.", method.title));
        };
        let head = format!("{} reaches an error of {percent} % in {own:.3} ms", method.title);
        let best = peers().filter_map(|m| Some((m, self.millis_of_any(m)?))).min_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((peer, millis)) = best {
            let times = millis / own;
            return Some(format!(
                "{head}; the best of the {}, {}, takes {millis:.3} ms, {times:.1} times as long.",
                race.peers_are, peer.title
            ));
        }
        let closest = peers().flat_map(|m| places(*m)).min_by(|a, b| a.1.1.total_cmp(&b.1.1));
        let (row, (millis, error)) = closest?;
        Some(format!(
            "{head}; of the {} none reaches it: the closest, {} at {} = {}, still has an error of {:.1} % after \
             {millis:.3} ms, {:.1} times as long.",
            race.peers_are,
            row.method.title,
            self.study.parameter,
            row.point.setting,
            100.0 * error,
            millis / own
        ))
    }

    /// Returns the frontier from cheap to expensive.
    pub fn frontier(&self) -> Vec<(f64, f64)> {
        let mut all: Vec<(f64, f64)> = self.rows.iter().filter(|r| r.is_frontier).filter_map(Row::place).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }

    /// Returns the names of all further figures.
    pub fn values(&self) -> Vec<String> {
        let names = self.rows.iter().filter_map(|r| r.measured.as_ref()).flat_map(|m| m.values.keys().cloned());
        names.collect::<BTreeSet<String>>().into_iter().collect()
    }
}

#[cfg(test)]
mod tests;
