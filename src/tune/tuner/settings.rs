//! The stages of a search: single knobs, combinations, and what is drawn again at the requested size.

use super::{Stage, TuneError, Tuner, VERIFY_PART, WHOLE, thinned};
use crate::{
    Goal, Knob, Point, Rejected,
    bench::{Bench, Refusal},
    converge::{Convergence, finer},
    knob::Kind,
    savings::Saving,
    search::{Ladder, Measure, Search},
};

/// A knob whose loops take less than this part of the time is not tried.
const LEAST_SHARE: f64 = 0.02;
/// Bounds, as multiples of the requested one, whose best settings in smaller pictures are drawn at the requested size.
const BEYOND: [f64; 2] = [2.0, 1.4];

impl Tuner<'_> {
    /// Returns whether the values of a knob are tried.
    pub(super) fn is_tried(&self, knob: usize) -> bool {
        let one = &self.request.knobs[knob];
        !self.rejected.iter().any(|rejected| rejected.name == one.name)
    }

    /// Returns the part of the time that a knob can save at most.
    fn most_saving(&self, knob: usize) -> f64 {
        let one = &self.request.knobs[knob];
        let Some(saving) = &self.savings[knob] else { return if one.kind == Kind::Setting { 0.3 } else { 0.5 } };
        one.ladder.values.iter().map(|value| saving.at_most(one, *value)).fold(0.0, f64::max)
    }

    fn reject(&mut self, knob: usize, reason: String) {
        let Knob { name, place, .. } = self.request.knobs[knob].clone();
        self.rejected.push(Rejected { name, place, reason });
    }

    /// Counts what the present setting executes, and keeps the knobs that can save most.
    fn count(&mut self) -> Result<(), TuneError> {
        self.say("counting what the pixels execute")?;
        self.end_at(0.08);
        let (counts, all) = self.stage.bench.counts(&self.request.prices)?;
        if !counts.is_empty() {
            self.savings = self.request.knobs.iter().map(|knob| counts.saving(knob, all)).collect();
        }
        let mut order = self.order();
        for knob in order.clone() {
            let is_little = |saving: &Saving| saving.share < LEAST_SHARE && self.request.most_knobs.is_some();
            if let Some(saving) = self.savings[knob].filter(is_little) {
                self.reject(knob, format!("its loops take {:.1} % of the time", saving.share * 100.0));
            }
        }
        order.retain(|knob| self.is_tried(*knob));
        let most = self.request.most_knobs.unwrap_or(usize::MAX);
        for knob in order.into_iter().skip(most) {
            self.reject(knob, format!("only {most} knobs are tried at once; choose it with --knob"));
        }
        Ok(())
    }

    /// Returns the knobs, those first that can save most.
    pub(super) fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.present.len()).collect();
        order.sort_by(|a, b| self.most_saving(*b).total_cmp(&self.most_saving(*a)));
        order
    }

    /// Finds the converged setting, and searches at the size of the first stage. Returns what was converged, and the
    /// values that are tried.
    pub(super) fn first_stage(&mut self) -> Result<(Vec<Convergence>, Vec<Ladder>), TuneError> {
        self.count()?;
        self.end_at(self.stage.parts.reference + 0.1);
        let states = self.make_reference()?;
        self.end_at(self.stage.parts.search + 0.05);
        let ladders = self.search()?;
        Ok((states, ladders))
    }

    /// Measures single knobs, then combinations. Returns the values that were tried.
    fn search(&mut self) -> Result<Vec<Ladder>, TuneError> {
        let (request, present) = (self.request, self.present.clone());
        let mut ladders: Vec<Ladder> = Vec::new();
        for (at, (knob, value)) in request.knobs.iter().zip(&self.converged).enumerate() {
            let mut knob = knob.clone();
            if !self.is_tried(at) {
                knob.ladder.values = vec![knob.value];
            }
            // Up to the converged value, by the steps that were drawn.
            for value in finer(knob.value, *value, knob.is_integer()) {
                knob.add_value(value);
            }
            ladders.push(knob.ladder);
        }
        let grows: Vec<bool> = request.knobs.iter().map(|knob| knob.grows).collect();
        let far = request.bound.limit * 5.0;
        let order = self.order();
        let mut search = std::mem::take(&mut self.stage.search);
        if request.is_exhaustive {
            search.measure_all(self, &ladders)?;
            self.stage.search = search;
            return Ok(ladders);
        }
        search.one_at_a_time(self, &present, &ladders, (&grows, &order), far)?;
        for values in &request.earlier {
            if self.has_time() && !search.points.iter().any(|point| point.values == *values) {
                let point = self.measure(values)?;
                point.into_iter().for_each(|point| search.add(point));
            }
        }
        for (knob, ladder) in ladders.iter_mut().enumerate() {
            self.narrow(&search, knob, ladder, far);
        }
        let goal = self.goal();
        search.run(self, &present, &ladders, goal)?;
        let limit = request.bound.limit;
        let levels = [limit * 2.0, limit * 0.5, limit * 4.0, limit * 0.25, limit * 1.4, limit * 0.7];
        search.fill_frontier(self, &present, &ladders, &levels)?;
        self.stage.search = search;
        Ok(ladders)
    }

    /// Gives up a knob that changes nothing, and values beyond one that is far off.
    fn narrow(&mut self, search: &Search, knob: usize, ladder: &mut Ladder, far: f64) {
        let (one, present) = (&self.request.knobs[knob], &self.present);
        let differs_alone = |values: &[f64]| {
            values[knob] != present[knob] && (0..present.len()).all(|k| k == knob || values[k] == present[k])
        };
        let base = search.points.iter().find(|point| point.values == *present).cloned();
        let mut alone = search.points.iter().filter(|point| differs_alone(&point.values)).peekable();
        let reason = match (alone.peek().is_some(), &base) {
            (false, _) => match self.refusals.iter().find(|(values, _)| differs_alone(values)) {
                Some((values, why)) => {
                    let first = why.lines().next().unwrap_or("");
                    Some(format!("with {} the program does not compile: {first}", one.shown(values[knob])))
                }
                None if ladder.values.len() > 1 => Some("there was no time to try it".to_owned()),
                None => None,
            },
            (true, Some(base)) => {
                let has_effect = |point: &Point| (point.millis / base.millis - 1.0).abs() > 0.03;
                let is_idle = !alone.any(has_effect);
                is_idle.then(|| "other values take as long".to_owned())
            }
            (true, None) => None,
        };
        if let Some(reason) = reason {
            ladder.values = vec![self.present[knob]];
            if self.is_tried(knob) {
                self.reject(knob, reason);
            }
            return;
        }
        let furthest = search.points.iter().filter(|point| differs_alone(&point.values) && point.error > far);
        let furthest: Vec<f64> = furthest.map(|point| point.values[knob]).collect();
        let is_near = |v: &f64| {
            furthest
                .iter()
                .all(|far| if one.grows { v > far || *v >= present[knob] } else { v < far || *v <= present[knob] })
        };
        ladder.values.retain(is_near);
    }

    /// Draws the best settings at the requested size, by what is known from smaller pictures.
    pub(super) fn second_stage(&mut self, ladders: &mut [Ladder]) -> Result<(), TuneError> {
        let request = self.request;
        let deadline = self.began + request.limit;
        let bench = Bench::new(self.gpu, (&request.scene, &request.knobs, self.metric), request.scene.size, deadline);
        let points = self.stage.search.points.clone();
        let stage = Stage {
            bench,
            at: self.stage.at.clone(),
            reference: Vec::new(),
            search: Search::after(points),
            cost: 0.0,
            parts: WHOLE,
        };
        let small = std::mem::replace(&mut self.stage, stage);
        let ratio = f64::from(request.scene.size.0) * f64::from(request.scene.size.1)
            / (f64::from(small.bench.size.0) * f64::from(small.bench.size.1));
        let millis = small.bench.present_millis() * ratio;
        // The frames that a setting can be drawn in, with those that show the present error or that of the best most.
        let draws = self.seconds() * VERIFY_PART * 1e3 / millis;
        if request.scene.may_thin {
            self.stage.at = match self.stage.bench.has_state {
                true => thinned(&self.stage.at, true, draws),
                false => {
                    let count = (draws - 1.0).clamp(1.0, self.stage.at.len() as f64);
                    let from = (self.stage.at.len() - count as usize) / 2;
                    self.stage.at[from..from + count as usize].to_vec()
                }
            };
        }
        self.small = Some(small);
        self.end_at(0.9);
        let present = self.present.clone();
        match self.stage.bench.open_present(&present)? {
            Ok(()) => {}
            Err(Refusal::Compile(why)) => return Err(TuneError::Present(why)),
            Err(Refusal::Time) => return Ok(()),
        }
        let at = self.stage.at.clone();
        let Some(shots) = self.draw(&self.converged.clone(), (&at, self.seeds), false)? else { return Ok(()) };
        self.stage.reference = self.references(&shots, self.seeds);
        let Some(base) = self.measure(&present)? else { return Ok(()) };
        let mut search = std::mem::take(&mut self.stage.search);
        search.add(base);
        for point in &search.smaller {
            for (ladder, value) in ladders.iter_mut().zip(&point.values) {
                if !ladder.values.contains(value) {
                    ladder.values.push(*value);
                    ladder.values.sort_by(f64::total_cmp);
                }
            }
        }
        let goal = self.goal();
        // Edges are a smaller part of a larger picture: settings that were beyond the bound in small ones may keep it, and
        // say by how much errors differ.
        if let Goal::Error(limit) = goal {
            for factor in BEYOND {
                let best = Goal::Error(limit * factor).best(search.smaller.iter()).map(|point| point.values.clone());
                let Some(values) = best.filter(|values| !search.points.iter().any(|point| point.values == *values))
                else {
                    continue;
                };
                if self.has_time() {
                    self.measure(&values)?.into_iter().for_each(|point| search.add(point));
                }
            }
        }
        search.run(self, &present, ladders, goal)?;
        self.stage.search = search;
        Ok(())
    }
}
