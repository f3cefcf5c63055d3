//! The line below the editor with the result of the last compile, and the list of problems.

use super::{
    accessible,
    actions::Action,
    editor::EditorAction,
    includes,
    inline_code::{self, Inline},
    theme::{self, Palette},
    ui_output::{ShellCommand, UiOutput},
};
use crate::{
    diag::Severity,
    project::{Tab, TextLocation},
    session::{Outcome, Session, TabDiagnostic, TabFix},
};
use egui::{
    Align2, Color32, FontId, Frame, Galley, Id, Panel, Rect, RichText, ScrollArea, Sense, Stroke, Ui, pos2,
    text::TextWrapping, vec2,
};
use std::sync::Arc;

/// The height of the line with the result of the last compile.
pub(super) const STATE: f32 = 24.0;
const ROW: f32 = 22.0;
/// The space above and below the text of a row that is shown in full.
const PADDING: f32 = 3.0;
/// The left edge of the text of a row.
const TEXT: f32 = 25.0;
/// The width of a quick fix button.
const FIX: f32 = 36.0;
/// The width of the button that applies all fixes.
const FIX_ALL: f32 = 56.0;
/// The indent of a related place below its problem.
const INDENT: f32 = 14.0;
/// The minimum width in which a hint is shown after its problem.
const HINT_ROOM: f32 = 60.0;

/// Shows the state and the list at the bottom of `ui`, which shrinks accordingly. `caret`: the tab in front and its
/// caret's line from 0, whose problem is shown in full. `limit`: the maximum height of the list. Returns the height.
pub(super) fn panel(
    ui: &mut Ui,
    session: &Session,
    caret: Option<(&Tab, usize)>,
    limit: f32,
    out: &mut UiOutput,
) -> f32 {
    let panel = Panel::bottom("problems").frame(Frame::NONE.fill(theme::of(ui).panel));
    let shown = panel.show_separator_line(false).resizable(false);
    shown.show(ui, |ui| show(ui, session, caret, limit, out)).response.rect.height()
}

pub(super) fn has_errors(session: &Session) -> bool {
    counts(session).0 > 0
}

fn show(ui: &mut Ui, session: &Session, caret: Option<(&Tab, usize)>, limit: f32, out: &mut UiOutput) {
    out.stop("problems", ui);
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), STATE), Sense::hover());
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
    let mut end = rect.max;
    let fixable = session.diagnostics().iter().filter(|problem| problem.fixes.len() == 1).count();
    if fixable > 1 {
        let place = Rect::from_min_max(pos2(rect.right() - FIX_ALL - 6.0, rect.top() + 2.0), rect.max - vec2(6.0, 2.0));
        let button = ui.place(place, egui::Button::new(RichText::new("Fix all").size(12.0)).small());
        let tip = format!("Apply the fixes of {fixable} problems");
        out.on_click("problems:fix-all", &button.on_hover_text(tip), Action::FixAll);
        end.x = place.left() - 8.0;
    }
    let room = Rect::from_min_max(pos2(state.right() + 16.0, rect.top()), end);
    includes::show(ui, session, room, out);
    out.place("compile-state", rect);
    let rows: Vec<Row<'_>> = session.diagnostics().iter().enumerate().flat_map(|(i, d)| rows_of(i, d)).collect();
    if rows.is_empty() {
        return;
    }
    let whole = at_caret(session, caret);
    let full =
        whole.and_then(|problem| rows.iter().position(|row| !row.is_label && std::ptr::eq(row.problem, problem)));
    let extra = full.map_or(0.0, |n| (rows[n].full_height(ui) - ROW).max(0.0));
    // A list that fits does not scroll, so its height is known.
    let height = (rows.len() as f32 * ROW + extra).min(limit.max(ROW));
    let area = ScrollArea::vertical().id_salt("problem list").max_height(height).min_scrolled_height(height);
    area.auto_shrink([false, true]).show_viewport(ui, |ui, seen| {
        let origin = ui.max_rect().min;
        let width = ui.available_width();
        ui.set_height(rows.len() as f32 * ROW + extra);
        for (n, row) in rows.iter().enumerate() {
            let is_below = full.is_some_and(|full| n > full);
            let top = n as f32 * ROW + if is_below { extra } else { 0.0 };
            let height = if full == Some(n) { ROW + extra } else { ROW };
            if top < seen.max.y && top + height > seen.min.y {
                let place = Rect::from_min_size(pos2(origin.x, origin.y + top), vec2(width, height));
                row.show(ui, place, full == Some(n), out);
            }
        }
        // The caret was moved to a problem whose row is out of sight.
        let id = Id::unique("problem at caret");
        let before = ui.data(|d| d.get_temp::<Option<usize>>(id)).flatten();
        ui.data_mut(|d| d.insert_temp(id, full));
        if let Some(n) = full
            && before != full
        {
            let top = origin.y + n as f32 * ROW;
            ui.scroll_to_rect(Rect::from_min_size(pos2(origin.x, top), vec2(width, ROW + extra)), None);
        }
    });
    ui.add_space(4.0);
}

/// Returns the most severe problem in the caret's line.
fn at_caret<'a>(session: &'a Session, caret: Option<(&Tab, usize)>) -> Option<&'a TabDiagnostic> {
    let (tab, line) = caret?;
    let is_here = |p: &TextLocation| p.tab.as_ref() == Some(tab) && p.line == line + 1;
    let here = session.diagnostics().iter().filter(|d| d.place.as_ref().is_some_and(is_here));
    here.max_by_key(|d| d.severity)
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

    /// Lays out its texts in a row of this width. In full: the whole message, with all hints below.
    fn layout(&self, ui: &Ui, width: f32, is_full: bool) -> RowLayout {
        let palette = theme::of(ui);
        let painter = ui.painter();
        let mut x = if self.is_label { TEXT + INDENT } else { TEXT };
        let place = self.place.map(|place| {
            let at = format!("{} {}:{}", place.title(), place.line, place.column);
            painter.layout_no_wrap(at, FontId::proportional(12.0), palette.weak)
        });
        x += place.as_ref().map_or(0.0, |place| place.size().x + 10.0);
        let end = width - if self.fix().is_some() { FIX + 6.0 } else { 0.0 };
        let room = end - x - 8.0;
        let color = if self.is_label { palette.weak } else { palette.text };
        let text = |text: &str, size: f32, color: Color32, room: f32| {
            let inline = Inline { size, color, palette };
            let mut job = inline.line(text, room);
            if is_full {
                job.wrap = TextWrapping::wrap_at_width(room);
            }
            painter.layout_job(job)
        };
        let message = text(self.message, 12.5, color, room.max(20.0));
        let hints = self.problem.hints.iter().filter(|_| !self.is_label);
        let hints: Vec<_> = match is_full {
            true => hints.map(|hint| text(hint, 12.0, palette.weak, room.max(20.0))).collect(),
            // A few truncated letters are useless; the tooltip has the full text.
            false => {
                let room = room - message.size().x - 12.0;
                hints.take(1).filter(|_| room > HINT_ROOM).map(|hint| text(hint, 12.0, palette.weak, room)).collect()
            }
        };
        RowLayout { x, place, message, hints }
    }

    /// Returns its height when it is shown in full.
    fn full_height(&self, ui: &Ui) -> f32 {
        let RowLayout { message, hints, .. } = self.layout(ui, ui.available_width(), true);
        let line = ROW - 2.0 * PADDING;
        message.size().y.max(line) + hints.iter().map(|hint| hint.size().y).sum::<f32>() + 2.0 * PADDING
    }

    fn fix(&self) -> Option<&TabFix> {
        self.problem.fixes.first().filter(|_| !self.is_label)
    }

    fn show(&self, ui: &mut Ui, rect: Rect, is_full: bool, out: &mut UiOutput) {
        let response = ui.allocate_rect(rect, Sense::click());
        accessible::name(&response, egui::Role::Button, self.name_of());
        let palette = theme::of(ui);
        if response.hovered() || is_full {
            let fill = if response.hovered() { palette.raised } else { palette.background };
            ui.painter().rect_filled(rect, 0.0, fill);
        }
        let color = palette.of_severity(self.problem.severity);
        let weak = palette.weak;
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let middle = rect.top() + ROW / 2.0;
        if !self.is_label {
            painter.circle_filled(pos2(rect.left() + 13.0, middle), 3.0, color);
        }
        let RowLayout { x, place, message, hints } = self.layout(ui, rect.width(), is_full);
        if let Some(place) = place {
            let at = pos2(rect.left() + x - 10.0 - place.size().x, middle - place.size().y / 2.0);
            painter.galley(at, place, weak);
        }
        let left = rect.left() + x;
        let line = message.rows.first().map_or(0.0, |row| row.height());
        let mut at = pos2(left, middle - line / 2.0);
        let size = message.size();
        painter.galley(at, message, weak);
        if !is_full {
            at.x += size.x + 12.0;
        }
        at.y += if is_full { size.y } else { 0.0 };
        for hint in hints {
            let height = hint.size().y;
            painter.galley(at, hint, weak);
            at.y += height;
        }
        if let Some(fix) = self.fix() {
            let place = Rect::from_min_size(pos2(rect.right() - FIX - 6.0, rect.top() + 2.0), vec2(FIX, ROW - 4.0));
            let name = format!("{}:fix", self.name);
            let button = ui.place(place, egui::Button::new(RichText::new("Fix").size(12.0)).small());
            let tip = out.keys.tip(&fix.title, Action::Code(EditorAction::QuickFix));
            out.on_click(&name, &button.on_hover_text(tip), ShellCommand::Fix(fix.clone()));
        }
        if is_full {
            out.place("problem-at-caret", rect);
        }
        if out.clicked(&self.name, &response)
            && let Some(command) = self.place.and_then(command_for)
        {
            out.shell_commands.push(command);
        }
        let response = response.on_hover_cursor(egui::CursorIcon::PointingHand);
        if !is_full {
            response.on_hover_ui(|ui| {
                inline_code::label(ui, color, &self.problem.message);
                for hint in &self.problem.hints {
                    inline_code::label(ui, theme::of(ui).text, hint);
                }
            });
        }
    }
}

/// The texts of a row, and their places.
struct RowLayout {
    /// The left edge of the message, from that of the row.
    x: f32,
    place: Option<Arc<Galley>>,
    message: Arc<Galley>,
    hints: Vec<Arc<Galley>>,
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
