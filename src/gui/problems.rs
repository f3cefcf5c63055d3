//! The line below the editor with the result of the last compile, and the list of problems.

use super::{
    accessible,
    actions::Action,
    editor::EditorAction,
    includes,
    theme::{self, Palette},
    ui_output::{ShellCommand, UiOutput},
};
use crate::{
    diag::Severity,
    project::{Tab, TextLocation},
    session::{Outcome, Session, TabDiagnostic},
};
use egui::{Align2, Color32, FontId, Frame, Label, Margin, Rect, RichText, ScrollArea, Sense, Stroke, Ui, pos2, vec2};

const ROW: f32 = 22.0;
/// The width of a quick fix button.
const FIX: f32 = 36.0;
/// The indent of a related place below its problem.
const INDENT: f32 = 14.0;
/// The minimum width in which a hint is shown after its problem.
const HINT_ROOM: f32 = 60.0;

/// `caret`: the tab in front and its caret's line from 0, whose problem is shown in full. `limit`: the maximum height
/// of the list.
pub(super) fn show(ui: &mut Ui, session: &Session, caret: Option<(&Tab, usize)>, limit: f32, out: &mut UiOutput) {
    out.stop("problems", ui);
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 24.0), Sense::hover());
    ui.painter().hline(rect.x_range(), rect.top() + 0.5, Stroke::new(1.0, theme::of(ui).line));
    let (text, color) = state(session, theme::of(ui));
    let dot = pos2(rect.left() + 13.0, rect.center().y);
    ui.painter().circle_filled(dot, 4.0, color);
    let painter = ui.painter().with_clip_rect(rect);
    let state = painter.text(
        pos2(rect.left() + 25.0, rect.center().y),
        Align2::LEFT_CENTER,
        text,
        FontId::proportional(12.0),
        theme::of(ui).text,
    );
    includes::show(ui, session, Rect::from_min_max(pos2(state.right() + 16.0, rect.top()), rect.max), out);
    out.place("compile-state", rect);
    whole(ui, session, caret, out);
    let rows: Vec<Row<'_>> = session.diagnostics().iter().enumerate().flat_map(|(i, d)| rows_of(i, d)).collect();
    if rows.is_empty() {
        return;
    }
    ScrollArea::vertical().id_salt("problem list").max_height(limit).auto_shrink([false, true]).show_rows(
        ui,
        ROW,
        rows.len(),
        |ui, seen| {
            ui.spacing_mut().item_spacing.y = 0.0;
            rows[seen].iter().for_each(|row| row.show(ui, out));
        },
    );
    ui.add_space(4.0);
}

/// Shows the whole message of the problem in the caret's line: next to the code and in the list it may be truncated.
fn whole(ui: &mut Ui, session: &Session, caret: Option<(&Tab, usize)>, out: &mut UiOutput) {
    let Some((tab, line)) = caret else { return };
    let is_here = |p: &TextLocation| p.tab.as_ref() == Some(tab) && p.line == line + 1;
    let here = session.diagnostics().iter().filter(|d| d.place.as_ref().is_some_and(is_here));
    let Some(problem) = here.max_by_key(|d| d.severity) else { return };
    let frame =
        Frame::NONE.fill(theme::of(ui).background).inner_margin(Margin { left: 25, right: 8, top: 4, bottom: 5 });
    let shown = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 2.0;
        let text = |text: &str| RichText::new(text).size(12.5);
        ui.add(
            Label::new(text(&problem.message).color(theme::of(ui).of_severity(problem.severity)))
                .wrap()
                .selectable(true),
        );
        for hint in &problem.hints {
            ui.add(Label::new(text(hint).color(theme::of(ui).weak)).wrap());
        }
        ui.horizontal_wrapped(|ui| {
            for (n, fix) in problem.fixes.iter().enumerate() {
                let tip = out.keys.tip("Fix it", Action::Code(EditorAction::QuickFix));
                let button = ui.small_button(&fix.title).on_hover_text(tip);
                out.on_click(&format!("problem-at-caret:fix:{n}"), &button, ShellCommand::Fix(fix.clone()));
            }
        });
    });
    out.place("problem-at-caret", shown.response.rect);
}

/// Returns the result of the newest compile in words, and their colour.
pub(super) fn state(session: &Session, palette: &Palette) -> (String, Color32) {
    let state = session.compile_state();
    if state.compiling {
        return ("Compiling…".into(), palette.accent);
    }
    if session.waits_for_save() {
        return ("Edited: save to compile".into(), palette.weak);
    }
    let some = |n: usize, noun: &str| format!("{n} {noun}{}", if n == 1 { "" } else { "s" });
    let (errors, warnings) = counts(session);
    match &state.last {
        None => ("Not compiled yet".into(), palette.weak),
        Some(Outcome::Ok { millis, .. }) if warnings == 0 => (format!("Compiled in {millis:.0} ms"), palette.good),
        Some(Outcome::Ok { millis, .. }) => {
            (format!("Compiled in {millis:.0} ms, {}", some(warnings, "warning")), palette.warning)
        }
        Some(Outcome::Failed { .. }) if warnings > 0 => {
            (format!("{}, {}", some(errors, "error"), some(warnings, "warning")), palette.error)
        }
        Some(Outcome::Failed { .. }) => (some(errors, "error"), palette.error),
    }
}

/// A row of the list: a problem, or a related place below it.
struct Row<'a> {
    name: String,
    problem: &'a TabDiagnostic,
    place: Option<&'a TextLocation>,
    message: &'a str,
    is_label: bool,
}

fn rows_of(index: usize, problem: &TabDiagnostic) -> impl Iterator<Item = Row<'_>> {
    let place = problem.place.as_ref();
    let own = Row { name: format!("problem:{index}"), problem, place, message: &problem.message, is_label: false };
    let labels = problem.labels.iter().enumerate().map(move |(n, label)| {
        let place = Some(&label.place);
        Row { name: format!("problem:{index}:{n}"), problem, place, message: &label.message, is_label: true }
    });
    std::iter::once(own).chain(labels)
}

impl Row<'_> {
    /// Returns its accessible name.
    fn name_of(&self) -> String {
        let place = self.place.map(|p| format!("{} line {}: ", p.title(), p.line)).unwrap_or_default();
        let kind = if self.is_label { "see also" } else { self.problem.severity.name() };
        format!("{kind}: {place}{}", self.message)
    }

    fn show(&self, ui: &mut Ui, out: &mut UiOutput) {
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
        accessible::name(&response, egui::Role::Button, self.name_of());
        if response.hovered() {
            ui.painter().rect_filled(rect, 0.0, theme::of(ui).raised);
        }
        let color = theme::of(ui).of_severity(self.problem.severity);
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let mut x = rect.left() + 25.0;
        if self.is_label {
            x += INDENT;
        } else {
            painter.circle_filled(pos2(rect.left() + 13.0, rect.center().y), 3.0, color);
        }
        if let Some(place) = self.place {
            let at = format!("{} {}:{}", place.title(), place.line, place.column);
            let font = FontId::proportional(12.0);
            let end = painter.text(pos2(x, rect.center().y), Align2::LEFT_CENTER, at, font, theme::of(ui).weak);
            x = end.right() + 10.0;
        }
        let fix = self.problem.fixes.first().filter(|_| !self.is_label);
        let mut text_end = rect.right();
        if let Some(fix) = fix {
            let place = Rect::from_min_size(pos2(rect.right() - FIX - 6.0, rect.top() + 2.0), vec2(FIX, ROW - 4.0));
            text_end = place.left();
            let name = format!("{}:fix", self.name);
            let button = ui.place(place, egui::Button::new(RichText::new("Fix").size(12.0)).small());
            out.on_click(&name, &button.on_hover_text(&fix.title), ShellCommand::Fix(fix.clone()));
        }
        let color_of_text = if self.is_label { theme::of(ui).weak } else { theme::of(ui).text };
        let text = self.message.replace('\n', " ");
        let mut job = egui::text::LayoutJob::simple_singleline(text, FontId::proportional(12.5), color_of_text);
        job.wrap = egui::text::TextWrapping::truncate_at_width((text_end - x - 8.0).max(20.0));
        let galley = painter.layout_job(job);
        let text_rect = Rect::from_min_size(pos2(x, rect.center().y - galley.size().y / 2.0), galley.size());
        painter.galley(text_rect.min, galley, color_of_text);
        if let Some(hint) = self.problem.hints.first().filter(|_| !self.is_label) {
            let mut job = egui::text::LayoutJob::simple_singleline(
                hint.replace('\n', " "),
                FontId::proportional(12.0),
                theme::of(ui).weak,
            );
            let room = text_end - text_rect.right() - 20.0;
            job.wrap = egui::text::TextWrapping::truncate_at_width(room.max(0.0));
            let galley = painter.layout_job(job);
            // A few truncated letters are useless; the tooltip has the full text.
            if room > HINT_ROOM {
                let at = pos2(text_rect.right() + 12.0, rect.center().y - galley.size().y / 2.0);
                painter.galley(at, galley, theme::of(ui).weak);
            }
        }
        if out.clicked(&self.name, &response)
            && let Some(command) = self.place.and_then(command_for)
        {
            out.shell_commands.push(command);
        }
        response.on_hover_cursor(egui::CursorIcon::PointingHand).on_hover_ui(|ui| {
            ui.colored_label(color, &self.problem.message);
            for hint in &self.problem.hints {
                ui.label(hint);
            }
        });
    }
}

/// Returns the command that goes to a place; `None` if it is not in any tab.
fn command_for(place: &TextLocation) -> Option<ShellCommand> {
    Some(ShellCommand::GoTo(place.tab.clone()?, Some((place.line - 1, place.column - 1))))
}

/// Returns the numbers of errors and of warnings.
fn counts(session: &Session) -> (usize, usize) {
    let count = |s: Severity| session.diagnostics().iter().filter(|d| d.severity == s).count();
    (count(Severity::Error), count(Severity::Warning))
}
