//! Reports the window's state to the scripts that drive it.

use super::Shell;
use crate::{
    gui::{cost_map, error_map, halt, panels::Panel, probe, problems, recorder, report::Report, theme},
    project::{Origin, Tab},
    session::{Outcome, Session},
};
use serde_json::{Value, json};
use std::time::Instant;

/// The newest things that are already in the report.
#[derive(Default)]
pub(super) struct Reported {
    /// The newest notice.
    notice: Option<u64>,
    /// The generation of the session's texts.
    generation: Option<u64>,
}

impl Shell {
    /// Reports changes to scripts.
    pub(crate) fn report(
        &mut self,
        session: &Session,
        report: &mut Report,
        window: (u32, u32),
        ctx: &egui::Context,
        now: Instant,
    ) {
        if !report.is_enabled() {
            return;
        }
        let (transport, scale) = (session.transport(), ctx.pixels_per_point());
        let generation = session.text_generation();
        let project = session.project();
        let opened = report.say_if_new("opened", json!({ "name": project.name, "origin": origin(&project.origin) }));
        if self.reported.generation.replace(generation).is_some_and(|g| g != generation) && !opened {
            report.say(json!({ "event": "reloaded", "name": project.name }));
        }
        if opened {
            // Results of the previous project do not apply to this one, even if they read the same.
            report.forget("compiled");
        }
        report.say_if_new("compiled", compiled(session));
        let debounce_ms = session.edit_debounce().as_secs_f64() * 1e3;
        report.say_if_new("drawn", json!({ "programs": session.programs_drawn(), "debounce_ms": debounce_ms }));
        let values: serde_json::Map<String, Value> = session
            .custom_uniforms()
            .iter()
            .map(|k| (k.name.clone(), json!(session.custom_uniform_value(k).components())))
            .collect();
        report.say_if_new("uniforms", json!({ "values": values }));
        report.say_if_new("shown", json!({ "pass": session.shown_pass().title() }));
        for notice in session.notices() {
            if self.reported.notice.is_none_or(|id| notice.id > id) {
                self.reported.notice = Some(notice.id);
                let level = format!("{:?}", notice.level).to_lowercase();
                report.say(json!({ "event": "notice", "level": level, "text": notice.text, "path": notice.path }));
            }
        }
        report.say_if_new(
            "time",
            json!({
                "speed": transport.speed,
                "fixed_rate": transport.fixed_rate,
                "range": session.time_range().map(|range| [range.from, range.to]),
                "keeps_inputs": session.keeps_inputs(),
            }),
        );
        let replay = session.replay();
        report.say_if_new(
            "replay",
            json!({
                "drawn": replay.as_ref().map(|replay| replay.drawn),
                "frames": replay.as_ref().map(|replay| replay.frames),
            }),
        );
        report.say_if_new("film", recorder::report(session));
        report.say_if_new("halt", json!({ "kind": session.halt().map(halt::kind) }));
        let question =
            session.question().map(|q| format!("{q:?}").split([' ', '(']).next().unwrap_or_default().to_lowercase());
        report.say_if_new("question", json!({ "kind": question }));
        let dirty: Vec<String> = session.tabs().iter().filter(|t| session.is_tab_dirty(t)).map(Tab::title).collect();
        report.say_if_new("dirty", json!({ "dirty": session.is_dirty(), "tabs": dirty }));
        for panel in Panel::all().filter(|panel| self.dock.is_open(*panel)) {
            if let Some(members) = panel.row().report {
                report.say_if_new(panel.name(), members(&mut self.project_ui, &self.lab, session));
            }
        }
        let under = session.probe().and(self.viewport.under());
        report.say_if_new("probe", probe::report(session, under));
        report.say_if_new("audit", error_map::report(session));
        report.say_if_new("cost", cost_map::report(session));
        let theme = if ctx.theme() == egui::Theme::Dark { "dark" } else { "light" };
        report.say_if_new("theme", json!({ "shown": theme }));
        // A widget that is not visible yet is scrolled into view in the next frames, and only then has a place to
        // report.
        let place = self.focus.place();
        if place.is_none_or(|[_, seen]| seen.is_positive()) {
            let focused = place.and_then(|[whole, seen]| self.places.named(whole).or_else(|| self.places.named(seen)));
            report.say_if_new("focus", json!({ "widget": focused }));
        }
        report.layout(window, transport.resolution, scale, &self.places.areas(scale));
        if let Some(sound) = session.output_view() {
            let microphone = session.microphone_view();
            let sound = json!({
                "has_sound": sound.has_sound,
                "muted": sound.is_muted,
                "volume": sound.volume,
                "device": format!("{:?}", sound.device),
                "microphone": microphone.is_some_and(|view| view.is_on),
            });
            report.say_if_new("sound", sound);
        }
        let frame = json!({
            "frame": transport.frame,
            "time": transport.time_secs,
            "playing": transport.playing,
            "fps": transport.fps,
            "mouse_has_picture": self.viewport.mouse_is_down(),
            "copied_bytes": session.copied_picture_bytes(),
        });
        report.frame(now, transport.playing, frame);
    }
}

/// Returns the result of the newest finished compile, with every diagnostic.
fn compiled(session: &Session) -> Value {
    let state = session.compile_state();
    let diagnostics: Vec<Value> = session
        .diagnostics()
        .iter()
        .map(|d| {
            let place = d.place.as_ref();
            json!({
                "severity": d.severity.name(),
                "tab": d.tab().map(Tab::title),
                "file": place.filter(|place| place.tab.is_none()).map(|place| &place.text),
                "line": place.map_or(0, |place| place.line),
                "column": place.map_or(0, |place| place.column),
                "message": d.message,
            })
        })
        .collect();
    let ok = state.last.as_ref().map(|l| matches!(l, Outcome::Ok { .. }));
    json!({ "ok": ok, "compiling": state.compiling, "state": problems::state(session, &theme::DARK).0, "diagnostics": diagnostics })
}

fn origin(origin: &Origin) -> Value {
    match origin {
        Origin::Unsaved => json!(null),
        Origin::Preset(name) => json!({ "preset": name }),
        Origin::Folder { path, .. } => json!({ "folder": path }),
        Origin::File(path) => json!({ "file": path }),
        Origin::Json(path) => json!({ "json": path }),
    }
}
