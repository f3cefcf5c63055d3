//! The debugger's report for scripts.

use super::{debugger::Debugger, moment::words};
use crate::{
    debugger::trace::{Printed, Watched},
    session::{Session, Status},
};
use serde_json::{Map, Value, json};

impl Debugger {
    pub(crate) fn report(&mut self, session: &Session) -> Value {
        let breakpoints: Vec<Value> = self
            .breakpoints
            .iter()
            .map(|b| json!({ "tab": b.tab.title(), "line": b.line + 1, "condition": b.condition, "on": b.is_on }))
            .collect();
        let (at, watched, message) = (self.at, self.watches.clone(), self.message);
        let Some(traced) = self.examiner.as_ref().map(|examiner| examiner.traced.clone()) else {
            return json!({ "pixel": null, "trouble": session.trace().trouble, "breakpoints": breakpoints });
        };
        let printed_json = |comment: &Printed| {
            let values: Vec<String> = comment.values.iter().map(|(_, value)| watched_text(value)).collect();
            json!({ "line": comment.line + 1, "expression": comment.expression, "values": values })
        };
        let printed: Vec<Value> = self.printed.iter().flatten().map(printed_json).collect();
        let Some(seen) = self.moment_state() else { return Value::Null };
        let variables: Map<String, Value> =
            seen.variables.iter().map(|v| (v.shown.name.clone(), words(&v.shown.value).into())).collect();
        let changed: Vec<&str> =
            seen.variables.iter().filter(|v| v.is_changed).map(|v| v.shown.name.as_str()).collect();
        let watches: Map<String, Value> =
            watched.into_iter().zip(&seen.watches).map(|(watch, value)| (watch, watched_text(value).into())).collect();
        let mesh = traced.mesh().map(|(fragment, name)| {
            json!({ "draw": fragment.draw, "name": name, "triangle": fragment.triangle, "front": fragment.is_front })
        });
        json!({
            "mesh": mesh,
            "pass": traced.pass.title(),
            "pixel": [traced.pixel.0, traced.pixel.1],
            "frame": traced.frame,
            "moment": at,
            "moments": traced.history.moments.len(),
            "tab": seen.place.as_ref().map(|(tab, _)| tab.title()),
            "line": seen.place.as_ref().map(|(_, line)| line + 1),
            "depth": traced.history.depth(at),
            "said": message,
            "variables": variables,
            "changed": changed,
            "watches": watches,
            "turns": seen.rows.rows.len(),
            "turn": seen.rows.current.map(|turn| turn + 1),
            "printed": printed,
            "breakpoints": breakpoints,
            "value": traced.value,
            "device": traced.device,
            "ulps": traced.ulps(),
            "parted": divergence(session),
        })
    }
}

/// Returns the search for the first difference from the device: its name, its line and the difference there.
fn divergence(session: &Session) -> Value {
    match session.divergence() {
        None => Value::Null,
        Some(Status::UnderWay(())) => json!("under way"),
        Some(Status::Ended(Err(why))) => json!({ "trouble": why }),
        Some(Status::Ended(Ok(found))) => json!({
            "compared": found.compared,
            "name": found.first.as_ref().map(|first| &first.assignment.name),
            "ulps": found.first.as_ref().map(|first| &first.ulps),
        }),
    }
}

fn watched_text(value: &Watched) -> String {
    match value {
        Ok(value) => words(value),
        Err(why) => format!("error: {why}"),
    }
}
