//! The report for scripts.

use super::state::Measurements;
use crate::{debugger::trace::Number, session::Session};
use serde_json::{Value, json};

pub(super) fn report(state: &Measurements, session: &Session) -> Value {
    let cards = session.measures().iter().map(|measure| {
        let (record, trouble) = (&measure.record, session.unmeasured(measure));
        let newest = record.newest();
        json!({
            "text": measure.text,
            "tab": measure.place.title(),
            "line": measure.place.line,
            "frame": newest.map(|newest| newest.frame),
            "value": newest.map(|newest| Number::Double(newest.value)),
            "samples": record.samples().count(),
            "nonfinite": record.samples().filter(|sample| !sample.value.is_finite()).count(),
            "range": record.extremes().map(|(low, high)| [low, high]),
            "first": record.samples().next().map(|first| first.frame),
            "why": trouble.as_ref().map(|trouble| &trouble.why),
            "mend": trouble.as_ref().map(|trouble| &trouble.hint),
        })
    });
    json!({ "axis": state.axis.name(), "frames": session.measured_frames(), "cards": cards.collect::<Vec<_>>() })
}
