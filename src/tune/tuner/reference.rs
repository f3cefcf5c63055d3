//! The converged setting, and its pictures.

use super::{Reference, SAME, TuneError, Tuner};
use crate::{
    bench::Shots,
    converge::{Convergence, converge, finer},
    search::Point,
};

/// A knob whose converged value changes the present picture by more than this many times the bound, alone or with others,
/// decides what is drawn, not how exactly.
const MEANING: f64 = 4.0;

/// The settings that were drawn for the reference, with their pictures until it is known.
pub(super) type Drawn = Vec<(Vec<f64>, Shots)>;

impl Tuner<'_> {
    /// Finds the converged setting, draws it, and adds what was drawn to the points of the stage.
    pub(super) fn make_reference(&mut self) -> Result<Vec<Convergence>, TuneError> {
        let (at, present) = (self.stage.at.clone(), self.present.clone());
        let Some(shots) = self.draw(&present, (&at, 1), true)? else {
            return Err(match self.refusals.pop() {
                Some((_, why)) => TuneError::Present(why),
                None => TuneError::Slow,
            });
        };
        let mut drawn: Drawn = vec![(present.clone(), shots)];
        let mut states = vec![Convergence::Untried; present.len()];
        let mut moved = vec![0.0; present.len()];
        if !self.request.against_present {
            for knob in self.order() {
                if self.is_tried(knob) {
                    (states[knob], moved[knob]) = self.converge_knob(knob, &at, &mut drawn)?;
                }
            }
        }
        let values = states.iter().zip(&present);
        self.converged = values.map(|(state, value)| state.value().unwrap_or(*value)).collect();
        self.stage.reference = self.reference(&at, &drawn)?;
        loop {
            let change = self.error(&drawn[0].1, &self.stage.reference);
            let raised = (0..present.len()).filter(|k| self.converged[*k] != present[*k]);
            let most = raised.max_by(|a, b| moved[*a].total_cmp(&moved[*b]));
            let Some(most) = most.filter(|_| change > self.request.bound.limit * MEANING) else { break };
            states[most] = Convergence::Diverging { change };
            self.converged[most] = present[most];
            self.stage.reference = self.reference(&at, &drawn)?;
        }
        for (values, shots) in drawn.drain(..) {
            let error = self.error(&shots, &self.stage.reference);
            self.stage.search.add(Point { values, millis: shots.millis, error });
        }
        Ok(states)
    }

    /// Makes a knob more exact alone. Returns its behaviour, and the change of the present picture.
    fn converge_knob(&mut self, knob: usize, at: &[u32], drawn: &mut Drawn) -> Result<(Convergence, f64), TuneError> {
        let one = &self.request.knobs[knob];
        let Some(finest) = one.finest else { return Ok((Convergence::Untried, 0.0)) };
        // No pixel comes near the bound: a larger one changes nothing.
        if one.grows && self.savings[knob].is_some_and(|saving| saving.is_unreached(one.value)) {
            return Ok((Convergence::Reached { value: one.value }, 0.0));
        }
        let values = finer(one.value, finest, one.is_integer());
        let (limit, present) = (self.request.bound.limit, self.present.clone());
        let mut moved = 0.0;
        let state = converge(&values, limit * SAME, |from, to| {
            let with = |value: f64| {
                let mut all = present.clone();
                all[knob] = value;
                all
            };
            let millis = |drawn: &[(Vec<f64>, Shots)], v: f64| {
                drawn.iter().find(|(values, _)| *values == with(v)).map_or(f64::NAN, |(_, shots)| shots.millis)
            };
            // The next step costs at most as much more again.
            let (first, last) = (millis(drawn, present[knob]), millis(drawn, from));
            let next = last * (last / first).max(2.0);
            let draws =
                if self.stage.bench.has_state { f64::from(at.last().copied().unwrap_or(0)) } else { at.len() as f64 };
            let seconds = next * (draws + 4.0) / 1e3;
            let left = self.seconds() * (self.stage.parts.converge - self.part());
            if seconds > left.max(0.0) {
                return Ok::<_, TuneError>(None);
            }
            let Some(shots) = self.draw(&with(to), (at, 1), true)? else { return Ok(None) };
            let change = |other: f64| {
                let before = drawn.iter().find(|(values, _)| *values == with(other));
                before.map(|(_, before)| self.error(&shots, &self.references(before, 1)))
            };
            let (by, all) = (change(from), change(present[knob]));
            moved = all.unwrap_or(moved);
            drawn.push((with(to), shots));
            Ok(by)
        })?;
        let is_other = state.value().is_some_and(|value| value != present[knob]) && moved > limit * MEANING;
        Ok((if is_other { Convergence::Diverging { change: moved } } else { state }, moved))
    }

    /// Draws the converged setting, and returns its pictures. Knobs that cost too much together go back to their present
    /// values, the most expensive ones first.
    fn reference(&mut self, at: &[u32], drawn: &[(Vec<f64>, Shots)]) -> Result<Vec<Reference>, TuneError> {
        let (base, present, seeds) = (drawn[0].1.millis, self.present.clone(), self.seeds);
        let ratio = |knob: usize, value: f64| {
            let alone = drawn.iter().find(|(values, _)| {
                values[knob] == value && (0..present.len()).all(|k| k == knob || values[k] == present[k])
            });
            alone.map_or(1.0, |(_, shots)| shots.millis / base)
        };
        let draws = match self.stage.bench.has_state {
            true => f64::from(at.last().copied().unwrap_or(0)) + 1.0,
            false => at.len() as f64 * f64::from(seeds),
        };
        loop {
            let factor: f64 = self.converged.iter().enumerate().map(|(knob, value)| ratio(knob, *value)).product();
            let seconds = base * factor * draws / 1e3;
            let left = self.seconds() * (self.stage.parts.reference + 0.1 - self.part());
            let raised = (0..present.len()).filter(|k| self.converged[*k] != present[*k]);
            let cost = |k: &usize| ratio(*k, self.converged[*k]);
            if seconds > left
                && let Some(worst) = raised.max_by(|a, b| cost(a).total_cmp(&cost(b)))
            {
                self.converged[worst] = present[worst];
                continue;
            }
            break;
        }
        let known = drawn.iter().find(|(values, _)| *values == self.converged).filter(|_| seeds == 1);
        if let Some((_, shots)) = known {
            return Ok(self.references(shots, 1));
        }
        match self.draw(&self.converged.clone(), (at, seeds), false)? {
            Some(shots) => Ok(self.references(&shots, seeds)),
            None => {
                self.converged.clone_from(&present);
                Ok(self.references(&drawn[0].1, 1))
            }
        }
    }
}
