//! The data of the lab's panel, independent of widgets: the results so far as points in the plane of cost and error.

use crate::lab::{
    ErrorRecord, Extent, Method, Point, Results, Study,
    background_run::{Event, Progress},
    report::{Look, Row, Table},
};
use egui::Pos2;

/// Results of one extent, which are not mixed with those of the other.
#[derive(Default)]
pub(super) struct ExtentResults {
    pub results: Results,
    /// Points whose cost is only estimated, in milliseconds per frame.
    pub estimates: Vec<(Point, f64)>,
    /// No results have arrived since the last report was written.
    pub is_saved: bool,
}

/// A point in the plane.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Dot {
    /// log10 of milliseconds and of the error.
    pub at: [f64; 2],
    /// The index in [`PlotData::table`].
    pub row: usize,
    /// The index in [`PlotData::methods`].
    pub method: usize,
    pub look: Look,
    /// The cost is from a single turn, so it may still change.
    pub is_estimate: bool,
}

/// A study's results, ready to be drawn.
pub(super) struct PlotData {
    pub table: Table,
    pub methods: Vec<&'static Method>,
    pub dots: Vec<Dot>,
    /// The frontier as a staircase, in log10.
    pub frontier: Vec<[f64; 2]>,
    /// (left, right), (bottom, top): whole decades, in log10.
    pub bounds: Option<[(f64, f64); 2]>,
}

impl ExtentResults {
    /// Applies an event of a run; returns whether there is something new to draw.
    pub(super) fn take(&mut self, event: &Event) -> bool {
        match event {
            Event::Resumed(results) => {
                // A folder that another run has written contains more than this window has seen.
                self.results = results.clone();
                self.estimates.retain(|(point, _)| self.results.error(point).is_some());
            }
            Event::Measured(record) => self.measured(record),
            Event::Estimate { point, millis } => {
                self.estimates.retain(|(p, _)| p != point);
                self.estimates.push((point.clone(), *millis));
            }
            Event::Costed(record) => {
                self.estimates.retain(|(p, _)| *p != record.point);
                self.results.add(crate::lab::Record::Cost(record.clone()));
            }
            Event::Progress(_) | Event::Ended(_) => return false,
        }
        self.is_saved = false;
        true
    }

    fn measured(&mut self, record: &ErrorRecord) {
        self.results.add(crate::lab::Record::Error(record.clone()));
    }

    /// Returns whether every point of a study has its error, and those on its main grid their costs.
    pub(super) fn is_whole(&self, study: &Study, extent: Extent) -> bool {
        let main = study.main_grid(extent);
        study.points(extent).iter().all(|point| {
            self.results
                .error(point)
                .is_some_and(|e| e.trouble.is_some() || point.grid != main || self.results.cost(point).is_some())
        })
    }

    /// Returns `None` if there are no results of the study.
    pub(super) fn shown(&self, study: &'static Study) -> Option<PlotData> {
        let estimate = |point: &Point| self.estimates.iter().find(|(p, _)| p == point).map(|(_, millis)| *millis);
        Some(PlotData::new(Table::with_estimates(study, &self.results, estimate)?))
    }
}

impl PlotData {
    fn new(table: Table) -> PlotData {
        let methods = table.methods();
        let dot = |(row, r): (usize, &Row)| {
            let (x, y) = r.place()?;
            Some(Dot {
                at: [x.log10(), y.log10()],
                row,
                method: methods.iter().position(|m| m.name == r.method.name)?,
                look: r.look(),
                is_estimate: r.cost.is_none(),
            })
        };
        let dots: Vec<Dot> = table.rows.iter().enumerate().filter_map(dot).collect();
        let frontier: Vec<[f64; 2]> = table.frontier().iter().map(|(x, y)| [x.log10(), y.log10()]).collect();
        let mut stairs = Vec::new();
        for pair in frontier.windows(2) {
            stairs.extend([pair[0], [pair[1][0], pair[0][1]], pair[1]]);
        }
        let around = |axis: usize| {
            let (a, b) = crate::lab::report::decades(dots.iter().map(|d| 10f64.powf(d.at[axis])))?;
            Some((a.log10(), b.log10()))
        };
        let bounds = around(0).zip(around(1)).map(|(x, y)| [x, y]);
        PlotData { methods, frontier: stairs, bounds, dots, table }
    }

    pub(super) fn row(&self, dot: &Dot) -> &Row {
        &self.table.rows[dot.row]
    }

    /// Returns the line of a method along its settings.
    pub(super) fn line(&self, method: usize) -> Vec<[f64; 2]> {
        self.dots.iter().filter(|d| d.method == method).map(|d| d.at).collect()
    }

    /// Iterates over measured rows of a method without a place in the plane: they diverged, failed, or wait for a
    /// cost.
    pub(super) fn without_place(&self, method: &Method) -> impl Iterator<Item = &Row> {
        self.table.of(method).filter(|r| r.place().is_none())
    }
}

/// Returns the place nearest to the pointer within a radius; of two that are equally near the later, which is drawn on
/// top.
pub(super) fn nearest(places: impl IntoIterator<Item = Pos2>, pointer: Pos2, radius: f32) -> Option<usize> {
    let far = places.into_iter().enumerate().map(|(n, place)| (n, place.distance(pointer)));
    let near = far.filter(|(_, distance)| *distance <= radius);
    near.reduce(|best, next| if next.1 <= best.1 { next } else { best }).map(|(n, _)| n)
}

/// Returns the progress of a run, from 0 to 1 and in words.
pub(super) fn progress_text(progress: &Progress) -> (f32, String) {
    match progress {
        Progress::Begins => (0.0, "opening a device".into()),
        Progress::Error { point, done, all } => {
            let part = *done as f32 / (*all).max(1) as f32;
            let words = format!("{} of {all}: {} at {} on {}", done + 1, point.method, point.setting, point.grid);
            // The last part is for the costs.
            (0.8 * part, words)
        }
        Progress::Cost { points } => (0.8, format!("costs of {points} points")),
        Progress::Turn { done, all } => {
            let part = *done as f32 / (*all).max(1) as f32;
            (0.8 + 0.2 * part, format!("costs, run {} of {all}", done + 1))
        }
    }
}

#[cfg(test)]
mod tests;
