//! The check of the best settings on frames that the search has not seen.

use super::{Reference, TuneError, Tuner, worst};
use crate::{Goal, Point, Proposal};
use eddy_engine::Pixels;
use eddy_playback::median;

/// Settings that are checked, and those that are timed beside each other in the end.
const CHECKED: usize = 6;
const TIMED: usize = 2;
/// Turns of the last, interleaved measurement.
const TURNS: u32 = 7;
/// Frames that are drawn at the requested size for each setting, where smaller pictures say which are the worst.
const WORST: usize = 3;
/// An error in frames that are checked may be this part of the bound, as there are more frames.
const KEPT: f64 = 0.98;

/// A setting that takes more than this part of the present time is not proposed where the present one keeps the bound.
const LEAST_GAIN: f64 = 0.97;

/// The part of the turns in which it has to be faster.
const WINS: f64 = 0.7;

/// The frames that are checked, and the reference there.
struct Truth {
    at: Vec<u32>,
    reference: Vec<Reference>,
}

impl Tuner<'_> {
    /// Chooses the best setting that keeps the bound on frames that the search has not seen, and times it beside the
    /// present one. A setting that there was no time to check is not proposed.
    pub(super) fn propose(&mut self) -> Result<Option<Proposal>, TuneError> {
        let (goal, present) = (self.goal(), self.present.clone());
        let limit = self.request.bound.limit;
        let mut candidates: Vec<Point> = self.stage.search.points.clone();
        candidates.retain(|point| goal.is_met_by(point));
        candidates.sort_by(|a, b| match goal {
            Goal::Error(_) => a.millis.total_cmp(&b.millis),
            Goal::Budget(_) => a.error.total_cmp(&b.error),
        });
        let mut scanned: Option<Truth> = None;
        let mut truth = Truth { at: Vec::new(), reference: Vec::new() };
        let mut kept: Vec<(Point, f64)> = Vec::new();
        let (mut strictest, mut checked) = (f64::INFINITY, 0);
        for point in candidates {
            if kept.len() >= TIMED || checked >= CHECKED || !kept.is_empty() && self.part() > 0.9 {
                break;
            }
            // One that is no more exact than one that failed fails, too.
            if point.error > strictest || strictest.is_finite() && point.error == strictest {
                continue;
            }
            checked += 1;
            if self.request.scene.held_out.is_empty() {
                kept.push((point.clone(), point.error));
                continue;
            }
            let Some(frames) = self.worst_frames(&point, &mut scanned)? else { break };
            let fails = |error: f64| matches!(goal, Goal::Error(_)) && (error > limit * KEPT || error.is_nan());
            // The next one is to be as much more exact as this one was off.
            let stricter = |error: f64| point.error * (limit * KEPT / error).min(1.0);
            if fails(frames.predicted) {
                strictest = stricter(frames.predicted);
                continue;
            }
            let Some(error) = self.checked_error(&point.values, &frames.at, &mut truth)? else { break };
            let error = worst(&[error, point.error]);
            if fails(error) { strictest = stricter(error) } else { kept.push((point, error)) }
        }
        if kept.is_empty() {
            return Ok(None);
        }
        self.say("the result beside the present setting")?;
        let settings: Vec<Vec<f64>> =
            [present.clone()].into_iter().chain(kept.iter().map(|(point, _)| point.values.clone())).collect();
        let turns = self.stage.bench.interleaved(&settings, TURNS)?;
        let times: Vec<Option<f64>> = turns.iter().map(|turns| median(turns.clone())).collect();
        let millis = |at: usize| times[at + 1].unwrap_or(kept[at].0.millis);
        let rank = |at: usize| match goal {
            Goal::Error(_) => millis(at),
            Goal::Budget(_) => kept[at].1,
        };
        let best = (0..kept.len()).min_by(|a, b| rank(*a).total_cmp(&rank(*b))).unwrap_or(0);
        let best_millis = millis(best);
        let present_millis = times[0].unwrap_or_else(|| self.stage.bench.present_millis());
        // A change that saves nothing is none.
        let is_faster = best_millis <= LEAST_GAIN * present_millis && wins(&turns[best + 1], &turns[0]) >= WINS;
        if matches!(goal, Goal::Error(_))
            && !is_faster
            && kept[best].0.values != present
            && let Some((point, checked_error)) = self.checked_present(&mut scanned, &mut truth)?
        {
            let point = Point { millis: present_millis, ..point };
            return Ok(Some(Proposal { point, checked_error, present_millis }));
        }
        let (point, checked_error) = kept.swap_remove(best);
        // The present setting beside itself would only show the noise of the measurement.
        if point.values == present {
            let point = Point { millis: present_millis, ..point };
            return Ok(Some(Proposal { point, checked_error, present_millis }));
        }
        Ok(Some(Proposal { point: Point { millis: best_millis, ..point }, checked_error, present_millis }))
    }

    /// Returns the present setting with its error in frames that are checked; `None` if it does not keep the bound.
    fn checked_present(
        &mut self,
        scanned: &mut Option<Truth>,
        truth: &mut Truth,
    ) -> Result<Option<(Point, f64)>, TuneError> {
        let (present, limit) = (self.present.clone(), self.request.bound.limit * KEPT);
        let base = self.stage.search.points.iter().find(|point| point.values == present && point.error <= limit);
        let Some(base) = base.cloned() else { return Ok(None) };
        // It is the reference itself.
        if present == self.converged {
            return Ok(Some((base, 0.0)));
        }
        let Some(frames) = self.worst_frames(&base, scanned)? else { return Ok(None) };
        let Some(error) = self.checked_error(&present, &frames.at, truth)? else { return Ok(None) };
        let error = worst(&[error, base.error]);
        Ok((error <= limit).then_some((base, error)))
    }

    /// Returns the frames that a setting is to be checked on at the requested size. `None` without time.
    fn worst_frames(&mut self, point: &Point, scanned: &mut Option<Truth>) -> Result<Option<Frames>, TuneError> {
        let held_out = self.held_out();
        let Some(small) = self.small.take() else { return Ok(Some(Frames { at: held_out, predicted: 0.0 })) };
        let mut other = small;
        let deadline = self.stage.bench.deadline;
        other.bench.deadline = deadline;
        std::mem::swap(&mut self.stage, &mut other);
        // The frames of the search say what the size makes of the error.
        let searched = other.at.clone();
        // A simulation may differ later than at the frames that it can be drawn to at the requested size.
        let mut all: Vec<u32> = searched.iter().chain(&held_out).chain(&self.request.scene.held_out).copied().collect();
        all.sort_unstable();
        all.dedup();
        let errors = self.scan(&point.values, &all, scanned);
        std::mem::swap(&mut self.stage, &mut other);
        self.small = Some(other);
        let Some(errors) = errors? else { return Ok(None) };
        let there = all.iter().zip(&errors).filter(|(frame, _)| searched.contains(frame)).map(|(_, error)| *error);
        let there = there.fold(0.0, f64::max);
        let ratio = if there > 1e-4 { (point.error / there).min(1.0) } else { 1.0 };
        let mut order: Vec<(f64, u32)> = errors.iter().copied().zip(all.iter().copied()).collect();
        order.retain(|(_, frame)| !searched.contains(frame));
        order.sort_by(|a, b| b.0.total_cmp(&a.0));
        let predicted = order.first().map_or(0.0, |(error, _)| error * ratio / 1.15);
        let seconds = self.request.limit.as_secs_f64() * (0.95 - self.part()).max(0.0);
        let per_frame = self.stage.bench.present_millis() / 1e3;
        let count =
            if self.stage.bench.has_state { WORST } else { WORST.min((seconds / 8.0 / per_frame) as usize).max(1) };
        let last = held_out.last().copied().unwrap_or(u32::MAX);
        order.retain(|(_, frame)| *frame <= last);
        let mut at: Vec<u32> = order.into_iter().take(count).map(|(_, frame)| frame).collect();
        at.sort_unstable();
        Ok(Some(Frames { at, predicted }))
    }

    /// Returns the frames that the search has not seen, as few as the search draws.
    fn held_out(&self) -> Vec<u32> {
        let all = &self.request.scene.held_out;
        let last = |at: &[u32]| f64::from(at.last().copied().unwrap_or(1).max(1));
        let part = (last(&self.stage.at) / last(&self.request.scene.at)).min(1.0);
        if !self.stage.bench.has_state || part >= 1.0 {
            return all.clone();
        }
        let mut fewer: Vec<u32> = all.iter().map(|frame| (f64::from(*frame) * part).round() as u32).collect();
        fewer.dedup();
        fewer.retain(|frame| !self.stage.at.contains(frame));
        fewer
    }

    /// Returns the errors of a setting in frames of the stage's size.
    fn scan(&mut self, values: &[f64], at: &[u32], truth: &mut Option<Truth>) -> Result<Option<Vec<f64>>, TuneError> {
        if truth.is_none() {
            let (converged, seeds) = (self.converged.clone(), self.seeds);
            let Some(shots) = self.draw(&converged, (at, seeds), false)? else { return Ok(None) };
            *truth = Some(Truth { at: at.to_vec(), reference: self.references(&shots, seeds) });
        }
        let Some(shots) = self.draw(values, (at, 1), false)? else { return Ok(None) };
        Ok(truth.as_ref().map(|truth| self.errors(&shots, &truth.reference)))
    }

    /// Returns the worst error of a setting in frames of the requested size. `None` without time.
    fn checked_error(&mut self, values: &[f64], at: &[u32], truth: &mut Truth) -> Result<Option<f64>, TuneError> {
        let missing: Vec<u32> = at.iter().copied().filter(|frame| !truth.at.contains(frame)).collect();
        if !missing.is_empty() {
            let (converged, seeds) = (self.converged.clone(), self.seeds);
            let Some(shots) = self.draw(&converged, (&missing, seeds), false)? else { return Ok(None) };
            truth.at.extend(&missing);
            truth.reference.extend(self.references(&shots, seeds));
        }
        let Some(shots) = self.draw(values, (at, 1), false)? else { return Ok(None) };
        let of_frame = |(at, picture): (&u32, &Pixels)| {
            let known = truth.at.iter().position(|known| known == at);
            known.map_or(f64::NAN, |index| self.frame_error(picture, &truth.reference[index]))
        };
        let errors: Vec<f64> = at.iter().zip(&shots.pictures).map(of_frame).collect();
        Ok(Some(worst(&errors)))
    }
}

/// Returns the part of the turns in which a setting was faster than another; 1 without turns.
fn wins(setting: &[f64], other: &[f64]) -> f64 {
    let turns = setting.len().min(other.len());
    let won = setting.iter().zip(other).filter(|(a, b)| a < b).count();
    if turns == 0 { 1.0 } else { won as f64 / turns as f64 }
}

/// The frames that a setting is checked on.
struct Frames {
    at: Vec<u32>,
    /// The error that smaller pictures predict for the worst.
    predicted: f64,
}
