//! The search for the cheapest setting within a bound, or the most exact one within a budget.
//!
//! Not exhaustive: the effects of single knobs give a model of time and error ([`model`]), the model proposes a
//! combination, which is measured and corrects the model, until no proposal promises more than the best that was
//! measured. Then the steps around the best are halved. Knows nothing of programs and devices.

mod model;
#[cfg(test)]
mod tests;

use model::Model;
use std::collections::HashSet;

/// A measured setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// A value for each knob.
    pub values: Vec<f64>,
    pub millis: f64,
    /// Smaller is better; see [`crate::Metric`].
    pub error: f64,
}

/// The aim of a search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// The cheapest setting whose error is at most this.
    Error(f64),
    /// The setting of the least error that takes at most these milliseconds per frame.
    Budget(f64),
}

impl Goal {
    fn is_met(self, millis: f64, error: f64) -> bool {
        match self {
            Goal::Error(most) => error <= most,
            Goal::Budget(most) => millis <= most,
        }
    }

    /// Returns what is to be small among settings that meet the goal.
    fn objective(self, millis: f64, error: f64) -> f64 {
        match self {
            Goal::Error(_) => millis,
            Goal::Budget(_) => error,
        }
    }

    /// Returns how far a setting is from meeting it.
    fn excess(self, millis: f64, error: f64) -> f64 {
        match self {
            Goal::Error(most) => error / most,
            Goal::Budget(most) => millis / most,
        }
    }

    /// Returns the best of measured settings: the one that meets the goal, or comes closest.
    pub fn best<'p>(self, points: impl Iterator<Item = &'p Point>) -> Option<&'p Point> {
        points.min_by(|a, b| {
            let rank = |p: &Point| match self.is_met(p.millis, p.error) {
                true => (false, self.objective(p.millis, p.error)),
                false => (true, self.excess(p.millis, p.error)),
            };
            let (a, b) = (rank(a), rank(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
    }

    /// Returns whether a measured setting meets it.
    pub fn is_met_by(self, point: &Point) -> bool {
        self.is_met(point.millis, point.error)
    }
}

/// The subject of a search, which measures settings. `None`: the setting cannot be drawn. An error ends the search.
pub trait Measure<E> {
    fn measure(&mut self, values: &[f64]) -> Result<Option<Point>, E>;

    /// Returns whether there is time for another measurement.
    fn has_time(&self) -> bool;

    /// Returns the least part of the base's time that a setting can take, by what is known without measuring it.
    fn least_part(&self, values: &[f64]) -> f64 {
        let _ = values;
        0.0
    }
}

/// The values of a knob that are tried, and the least ratio of two of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Ladder {
    /// In ascending order, at least one.
    pub values: Vec<f64>,
    /// Values between these may be tried.
    pub is_continuous: bool,
    pub is_integer: bool,
}

/// Two values closer than this ratio are not told apart.
const FINEST: f64 = 1.09;
/// A proposal must promise a gain of this factor over the best.
const GAIN: f64 = 0.97;
/// A changed knob has to promise this gain.
const TIDY: f64 = 0.005;
/// The most combinations that the model is asked for at once.
const MOST_COMBINATIONS: usize = 10_000;

/// The state of a search: what was measured, and what could not be drawn.
#[derive(Debug, Default)]
pub struct Search {
    pub points: Vec<Point>,
    /// Settings of smaller pictures, from which times and errors are predicted.
    pub smaller: Vec<Point>,
    refused: HashSet<Vec<u64>>,
}

fn key(values: &[f64]) -> Vec<u64> {
    values.iter().map(|v| v.to_bits()).collect()
}

impl Search {
    /// Returns a search that knows what was measured of smaller pictures.
    pub fn after(smaller: Vec<Point>) -> Self {
        Self { smaller, ..Self::default() }
    }

    /// Adds a setting that was measured before the search.
    pub fn add(&mut self, point: Point) {
        if !self.points.iter().any(|other| other.values == point.values) {
            self.points.push(point);
        }
    }

    fn is_known(&self, values: &[f64]) -> bool {
        self.points.iter().any(|point| point.values == values) || self.refused.contains(&key(values))
    }

    fn try_one<E>(&mut self, subject: &mut dyn Measure<E>, values: &[f64]) -> Result<bool, E> {
        if self.is_known(values) {
            return Ok(false);
        }
        match subject.measure(values)? {
            Some(point) => self.add(point),
            None => {
                self.refused.insert(key(values));
            }
        }
        Ok(true)
    }

    /// Measures the effect of each knob alone, in this order: from `base` down its ladder, while the error stays below
    /// `far`. Values that save nothing are left out.
    pub fn one_at_a_time<E>(
        &mut self,
        subject: &mut dyn Measure<E>,
        base: &[f64],
        ladders: &[Ladder],
        (grows, order): (&[bool], &[usize]),
        far: f64,
    ) -> Result<(), E> {
        for &knob in order {
            let ladder = &ladders[knob];
            let mut cheaper: Vec<f64> = ladder
                .values
                .iter()
                .copied()
                .filter(|v| if grows[knob] { *v < base[knob] } else { *v > base[knob] })
                .collect();
            if grows[knob] {
                cheaper.reverse();
            }
            for value in cheaper {
                if !subject.has_time() {
                    return Ok(());
                }
                let mut values = base.to_vec();
                values[knob] = value;
                if subject.least_part(&values) > GAIN {
                    continue;
                }
                self.try_one(subject, &values)?;
                let is_far = self.points.iter().find(|p| p.values == values).is_none_or(|p| p.error > far);
                if is_far {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Searches for a goal, from what was measured so far. `base` is the setting from which single knobs were changed.
    pub fn run<E>(
        &mut self,
        subject: &mut dyn Measure<E>,
        base: &[f64],
        ladders: &[Ladder],
        goal: Goal,
    ) -> Result<(), E> {
        let mut ladders = ladders.to_vec();
        let mut octaves = 1.0f64;
        while subject.has_time() {
            let Some(model) = Model::new(&self.points, &self.smaller, base) else { return Ok(()) };
            let best = goal.best(self.points.iter()).cloned();
            match self.proposal(subject, &model, &ladders, goal, best.as_ref()) {
                Some(values) => {
                    self.try_one(subject, &values)?;
                }
                None => {
                    let Some(best) = best else { return Ok(()) };
                    octaves /= 2.0;
                    let finer: Vec<Ladder> =
                        ladders.iter().zip(&best.values).map(|(ladder, v)| ladder.refined(*v, octaves)).collect();
                    if finer == ladders {
                        if octaves < FINEST.log2() {
                            return Ok(());
                        }
                        continue;
                    }
                    ladders = finer;
                }
            }
        }
        Ok(())
    }

    /// Measures every combination of the values, the cheapest first.
    pub fn measure_all<E>(&mut self, subject: &mut dyn Measure<E>, ladders: &[Ladder]) -> Result<(), E> {
        let lowest: Vec<f64> = ladders.iter().map(|ladder| ladder.values[0]).collect();
        for values in combinations(ladders, &lowest) {
            if !subject.has_time() {
                break;
            }
            self.try_one(subject, &values)?;
        }
        Ok(())
    }

    /// Returns the setting that is to be measured next; `None` if none promises more than the best.
    fn proposal<E>(
        &self,
        subject: &dyn Measure<E>,
        model: &Model<'_>,
        ladders: &[Ladder],
        goal: Goal,
        best: Option<&Point>,
    ) -> Option<Vec<f64>> {
        let is_met = best.is_some_and(|best| goal.is_met_by(best));
        let least = best.map_or(f64::INFINITY, |best| match is_met {
            true => goal.objective(best.millis, best.error) * GAIN,
            false => goal.excess(best.millis, best.error) * GAIN,
        });
        let around = best.map_or_else(|| model.base().to_vec(), |best| best.values.clone());
        let mut chosen: Option<(f64, Vec<f64>)> = None;
        for values in combinations(ladders, &around) {
            let (millis, error) = model.predict(&values);
            let millis = millis.max(subject.least_part(&values) * model.base_millis());
            let fits = goal.is_met(millis, error);
            let worth = match (is_met, fits) {
                (_, true) if is_met => goal.objective(millis, error),
                // Nothing meets the goal so far: what the model says will, before what comes closer.
                (false, true) => goal.objective(millis, error) * 1e-9,
                (false, false) => goal.excess(millis, error),
                _ => continue,
            };
            // Of settings that promise as much, the one that changes less.
            let changed = values.iter().zip(model.base()).filter(|(value, base)| value != base).count();
            let worth = worth * (1.0 + TIDY * changed as f64);
            let is_better = worth < least && chosen.as_ref().is_none_or(|(other, _)| worth < *other);
            if is_better && !self.is_known(&values) {
                chosen = Some((worth, values));
            }
        }
        chosen.map(|(_, values)| values)
    }

    /// Measures settings that the model holds for the frontier, at errors around the bound.
    pub fn fill_frontier<E>(
        &mut self,
        subject: &mut dyn Measure<E>,
        base: &[f64],
        ladders: &[Ladder],
        levels: &[f64],
    ) -> Result<(), E> {
        for &level in levels {
            if !subject.has_time() {
                return Ok(());
            }
            let Some(model) = Model::new(&self.points, &self.smaller, base) else { return Ok(()) };
            let best = Goal::Error(level).best(self.points.iter()).cloned();
            if let Some(values) = self.proposal(subject, &model, ladders, Goal::Error(level), best.as_ref()) {
                self.try_one(subject, &values)?;
            }
        }
        Ok(())
    }
}

impl Ladder {
    /// Returns the values around one of them, with those that lie `octaves` from it.
    fn refined(&self, around: f64, octaves: f64) -> Ladder {
        if !self.is_continuous || around <= 0.0 {
            return self.clone();
        }
        let (low, high) = (self.values[0], self.values[self.values.len() - 1]);
        let mut values = self.values.clone();
        for sign in [-1.0, 1.0] {
            let value = around * (sign * octaves).exp2();
            let value = if self.is_integer { value.round() } else { rounded(value) };
            let is_new =
                values.iter().all(|v| (v / value).max(value / v) >= if self.is_integer { 1.0001 } else { FINEST });
            if is_new && (low..=high).contains(&value) {
                values.push(value);
            }
        }
        values.sort_by(f64::total_cmp);
        Ladder { values, ..*self }
    }
}

/// Returns a value with three significant digits.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// Returns the combinations of the ladders: all, or where there are too many those near a setting.
fn combinations(ladders: &[Ladder], around: &[f64]) -> Vec<Vec<f64>> {
    let count =
        |sets: &[Vec<f64>]| sets.iter().map(Vec::len).try_fold(1usize, usize::checked_mul).unwrap_or(usize::MAX);
    let mut sets: Vec<Vec<f64>> = ladders.iter().map(|ladder| ladder.values.clone()).collect();
    let mut reach = 4;
    while count(&sets) > MOST_COMBINATIONS && reach > 0 {
        for ((set, ladder), at) in sets.iter_mut().zip(ladders).zip(around) {
            let here = ladder.values.partition_point(|v| v < at);
            let (from, to) = (here.saturating_sub(reach), (here + reach + 1).min(ladder.values.len()));
            *set = ladder.values[from.min(to)..to].to_vec();
        }
        reach -= 1;
    }
    let mut all = vec![Vec::new()];
    for set in sets {
        all = all
            .iter()
            .flat_map(|before: &Vec<f64>| {
                set.iter().map(move |value| before.iter().copied().chain([*value]).collect::<Vec<f64>>())
            })
            .collect();
        if all.len() > MOST_COMBINATIONS {
            all.truncate(MOST_COMBINATIONS);
        }
    }
    all
}

/// Returns the settings that no other beats in both time and error, the cheapest first.
pub fn frontier(points: &[Point]) -> Vec<&Point> {
    let mut sorted: Vec<&Point> = points.iter().filter(|p| p.millis.is_finite() && p.error.is_finite()).collect();
    sorted.sort_by(|a, b| a.millis.total_cmp(&b.millis).then(a.error.total_cmp(&b.error)));
    let mut least = f64::INFINITY;
    sorted.retain(|point| {
        let is_less = point.error < least;
        least = least.min(point.error);
        is_less
    });
    sorted
}
