//! The points of a study with what follows from all of them together: orders, the frontier, the time to an error.

use crate::lab::{
    About, Extent, Measured, Method, Number, Point, Results, Study,
    cost::{Cost, Times},
    metrics::{first_reach, order},
};
use std::collections::BTreeSet;

/// The error whose time is told.
pub const TARGET: f64 = 0.01;

/// A point of the main grid.
#[derive(Clone, Debug)]
pub struct Row {
    pub method: &'static Method,
    pub point: Point,
    pub measured: Option<Measured>,
    pub trouble: Option<String>,
    pub cost: Option<Cost>,
    /// Milliseconds for the study's unit.
    pub millis: Option<Times>,
    /// Nothing that passes its hard cases is both cheaper and closer.
    pub is_frontier: bool,
    /// Something is.
    pub is_dominated: bool,
}

impl Row {
    pub fn error(&self) -> Option<f64> {
        self.measured.as_ref().map(|m| m.norms.l2)
    }

    /// Passed hard cases, and how many there are.
    pub fn hard(&self) -> (usize, usize) {
        let all = self.measured.as_ref().map_or(&[][..], |m| &m.hard);
        (all.iter().filter(|h| h.passed).count(), all.len())
    }

    pub fn passes(&self) -> bool {
        let (passed, all) = self.hard();
        passed == all
    }

    /// (milliseconds, error), if both are numbers above 0.
    pub fn place(&self) -> Option<(f64, f64)> {
        let (x, y) = (self.millis?.median, self.error()?);
        (x.is_finite() && y.is_finite() && x > 0.0 && y > 0.0).then_some((x, y))
    }

    pub fn value(&self, name: &str) -> Option<f64> {
        self.measured.as_ref()?.values.get(name).map(|Number(x)| *x)
    }
}

/// What a method comes to on several grids.
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
    pub about: About,
    pub grid: u32,
    pub rows: Vec<Row>,
    pub convergence: Vec<Convergence>,
}

impl Table {
    /// `None` where nothing of the study is known.
    pub fn new(study: &dyn Study, results: &Results) -> Option<Table> {
        let extent = results.runs.iter().map(|r| r.extent).max_by_key(|e| *e == Extent::Full)?;
        let (about, grid) = (study.about(), study.main_grid(extent));
        let points = study.points(extent);
        let mut rows = Vec::new();
        for method in study.methods() {
            for point in points.iter().filter(|p| p.method == method.name && p.grid == grid) {
                let Some(record) = results.error(point) else { continue };
                let cost = results.cost(point).copied();
                let measured = record.measured.clone();
                let millis = cost.zip(measured.as_ref()).map(|(cost, m)| cost.frame.by(m.frames_per_unit));
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
        for &(i, (x, y), passes) in &places {
            let beaten = places.iter().any(|&(j, (u, v), ok)| j != i && ok && u <= x && v <= y && (u < x || v < y));
            (rows[i].is_dominated, rows[i].is_frontier) = (beaten, passes && !beaten);
        }
        let convergence = study.methods().iter().filter_map(|method| {
            let mut errors: Vec<(u32, f64)> = points
                .iter()
                .filter(|p| p.method == method.name && p.setting == method.usual && study.has_order())
                .filter_map(|p| Some((p.grid, results.measured(p)?.norms.l2)))
                .collect();
            errors.sort_by_key(|(grid, _)| *grid);
            let &[.., (coarse, a), (fine, b)] = &errors[..] else { return None };
            let order = order(a, b, f64::from(fine) / f64::from(coarse));
            (errors.len() >= 3).then_some(Convergence { method, errors, order })
        });
        Some(Table { about, grid, convergence: convergence.collect(), rows })
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

    /// The row at a method's usual setting.
    pub fn usual(&self, method: &Method) -> Option<&Row> {
        self.of(method).find(|r| r.point.setting == method.usual)
    }

    pub fn order(&self, method: &Method) -> Option<f64> {
        self.convergence.iter().find(|c| c.method.name == method.name).map(|c| c.order)
    }

    /// Milliseconds until a method that passes its hard cases has an error of 1 %: between its settings, interpolated in the
    /// logarithms.
    pub fn millis_to_target(&self, method: &Method) -> Option<f64> {
        let places: Vec<(f64, f64)> = self.of(method).filter(|r| r.passes()).filter_map(Row::place).collect();
        first_reach(&places, TARGET)
    }

    /// The frontier from cheap to dear.
    pub fn frontier(&self) -> Vec<(f64, f64)> {
        let mut all: Vec<(f64, f64)> = self.rows.iter().filter(|r| r.is_frontier).filter_map(Row::place).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }

    /// The names of every further figure.
    pub fn values(&self) -> Vec<String> {
        let names = self.rows.iter().filter_map(|r| r.measured.as_ref()).flat_map(|m| m.values.keys().cloned());
        names.collect::<BTreeSet<String>>().into_iter().collect()
    }
}
