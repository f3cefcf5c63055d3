//! Re-evaluates a record after ranges have changed: a record contains the extremes of every quantity, so that a case
//! need not be drawn again for a corrected range.

use super::{Case, CheckedProject, Outcome, StabilityRecord, inputs::MouseGesture, record_name};
use crate::Number;
use eddy_playback::assertion::{Assertion, Conditions, Range, Region};
use std::collections::BTreeMap;

/// Returns the conditions of a case on which bounds depend.
pub(super) fn conditions(subject: &CheckedProject, case: &Case) -> Conditions {
    subject.conditions(&case.values, case.size, case.steps.longest(), case.hand != MouseGesture::Away)
}

/// Returns whether the current ranges result in the recorded outcome for the recorded extremes.
pub(super) fn still_holds(subject: &CheckedProject, case: &Case, record: &StabilityRecord) -> bool {
    let Some(outcome) = &record.outcome else { return true };
    let sizes: Vec<(u32, u32)> = case.resizes.iter().map(|(_, size)| *size).chain([case.size]).collect();
    let usual = conditions(subject, case);
    let mut ranges: BTreeMap<String, Range> = BTreeMap::new();
    for check in subject.checks.iter().filter(|c| can_be_judged(c, case)) {
        for &size in &sizes {
            let own = check.range(&Conditions { size, ..usual.clone() });
            // Several checks with the same name share their extremes.
            let range = ranges.entry(record_name(&check.quantity)).or_insert_with(|| own.clone());
            range.low = range.low.min(own.low);
            range.high = range.high.max(own.high);
            range.excuse = range.excuse.take().or(own.excuse);
        }
    }
    let mut is_left = false;
    for (name, range) in &ranges {
        let Some(extremes) = record.extremes.get(name) else { return false };
        is_left |= leaves(extremes, range);
    }
    is_left == matches!(outcome, Outcome::Left(_))
}

/// While a canvas goes through several sizes, a region may temporarily have no texels; its extremes are then recorded
/// as 0.
fn can_be_judged(check: &Assertion, case: &Case) -> bool {
    case.resizes.is_empty() || check.quantity.region == Region::All
}

fn leaves((low, high): &(Number, Number), range: &Range) -> bool {
    let (low, high) = (low.0, high.0);
    // No texel belonged to it.
    if low == 0.0 && high == 0.0 {
        return false;
    }
    let is_outside = !(low >= range.low && high <= range.high);
    is_outside && !(range.excuses(low) && range.excuses(high))
}
