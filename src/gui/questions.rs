//! The session's questions, which are modal until they are answered.

use super::{
    theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::{
    project::{Origin, Tab},
    session::{self, Answer, Command, DiffLine, FileCommand, PendingAction, Question, Recovered, Session},
};
use egui::{
    Align, Color32, FontId, Frame, Id, Layout, Modal, Rect, RichText, ScrollArea, Sense, Ui, UiBuilder, pos2, vec2,
};
use std::path::{Path, PathBuf};

/// The height of a button.
const BUTTON: f32 = 28.0;

/// Shows the first pending question.
pub(super) fn show(ui: &Ui, session: &Session, out: &mut UiOutput) {
    let Some(question) = session.question() else { return };
    let window = ui.ctx().content_rect();
    let wide = matches!(question, Question::Conflict { .. } | Question::Recover(_));
    let width = (window.width() - 48.0).min(if wide { 900.0 } else { 440.0 });
    Modal::new(Id::unique("question")).frame(theme::dialog(ui.style())).show(ui.ctx(), |ui| {
        ui.set_width(width);
        match question {
            Question::Unsaved { then, tabs } => unsaved(ui, session, then, tabs, out),
            Question::Conflict { tab, file, diff, .. } => {
                let room = (window.height() - 230.0).max(60.0);
                conflict(ui, tab.as_ref(), file, diff, room, out);
            }
            Question::Overwrite { folder, files } => overwrite(ui, folder, files, out),
            Question::Export { file, exists, lost } => {
                export(ui, file, *exists, lost, (window.height() - 230.0).max(60.0), out);
            }
            Question::Film { is_live } => film(ui, *is_live, out),
            Question::Recover(recovered) => recover(ui, recovered, (window.height() - 260.0).max(60.0), out),
        }
    });
}

/// Shows a row of buttons from the right: the first is highlighted and pressed by Enter, the last is the safe way out and
/// pressed by Escape.
fn answers(ui: &mut Ui, list: &[(&str, Answer)], out: &mut UiOutput) {
    answers_with_default(ui, list, 0, out);
}

/// The same with the highlight and Enter at the button of this index: a destructive one must never be pressed by a key
/// that was meant for something else.
fn answers_with_default(ui: &mut Ui, list: &[(&str, Answer)], default_index: usize, out: &mut UiOutput) {
    let takes_keys = takes_keys(ui);
    ui.add_space(14.0);
    let row = vec2(ui.available_width(), BUTTON);
    ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center).with_main_wrap(true), |ui| {
        for (i, (label, answer)) in list.iter().enumerate() {
            let text = RichText::new(*label);
            let button = if i == default_index {
                egui::Button::new(text.color(theme::of(ui).strong)).fill(theme::of(ui).accent_fill)
            } else {
                egui::Button::new(text)
            };
            let response = ui.add(button.min_size(vec2(84.0, BUTTON)));
            // Enter presses the default button, unless another one has the focus.
            if i == default_index && takes_keys && ui.memory(|m| m.focused().is_none()) {
                response.request_focus();
            }
            // In a sizing pass a dialog is not visible yet.
            if !ui.is_sizing_pass() && out.clicked(&format!("answer:{}", name_of(answer)), &response) {
                out.ask(FileCommand::Answer(answer.clone()));
            }
        }
    });
    let cancels = list.last().is_some_and(|(_, a)| *a == Answer::Cancel);
    if cancels && ui.input(|i| i.key_pressed(egui::Key::Escape)) {
        out.ask(FileCommand::Answer(Answer::Cancel));
    }
}

/// The time that a question is shown before a key answers it, in seconds: keys typed when it appears must not answer
/// it.
const KEY_DELAY_SECS: f64 = 0.7;

fn takes_keys(ui: &Ui) -> bool {
    let id = Id::unique("question since");
    let (now, pass) = (ui.input(|i| i.time), ui.ctx().cumulative_pass_nr());
    let (since, last): (f64, u64) = ui.data(|d| d.get_temp(id)).unwrap_or((now, 0));
    // A question that was not shown in the last few passes is new.
    let since = if pass.saturating_sub(last) > 4 { now } else { since };
    ui.data_mut(|d| d.insert_temp(id, (since, pass)));
    let left = since + KEY_DELAY_SECS - now;
    if left > 0.0 {
        ui.ctx().request_repaint_after_secs(left as f32);
    }
    left <= 0.0
}

fn name_of(answer: &Answer) -> &'static str {
    match answer {
        Answer::Save => "save",
        Answer::Discard => "discard",
        Answer::Cancel => "cancel",
        Answer::KeepMine => "keep-mine",
        Answer::TakeDisk => "take-disk",
        Answer::SaveMineAs(_) => "save-mine-as",
        Answer::Overwrite => "overwrite",
        Answer::Export => "export",
        Answer::Recover => "recover",
        Answer::Finish => "finish",
    }
}

fn unsaved(ui: &mut Ui, session: &Session, then: &PendingAction, tabs: &[Tab], out: &mut UiOutput) {
    ui.heading(format!("Save the changes to {}?", session.project().name));
    let what = match then {
        PendingAction::Open(_) | PendingAction::OpenProject { .. } | PendingAction::OpenPicture(_) => {
            "by opening another project"
        }
        PendingAction::Keep(_) => "by opening the new one",
        PendingAction::New => "by starting a new shader",
        PendingAction::Recover(_) => "by restoring the recovered project",
        PendingAction::Close => "by closing the window",
    };
    let mut list = session.unsaved_parts();
    // The question may have appeared before an edit that has been saved since.
    if list.is_empty() {
        list.extend(tabs.iter().map(Tab::title));
    }
    let list = list.join(", ");
    ui.label(format!("Unsaved: {list}. Unless you save, this is lost {what}."));
    let answers_ = [("Save", Answer::Save), ("Discard", Answer::Discard), ("Cancel", Answer::Cancel)];
    answers(ui, &answers_, out);
}

fn overwrite(ui: &mut Ui, folder: &Path, files: &[PathBuf], out: &mut UiOutput) {
    let count = files.len();
    ui.heading(if count == 1 { "Replace a file?".into() } else { format!("Replace {count} files?") });
    ui.label(format!("{} already holds a project. These files would be replaced:", folder.display()));
    let row = ui.text_style_height(&egui::TextStyle::Monospace) + ui.spacing().item_spacing.y;
    let place = &mut of_height(ui, (row * count as f32).min(160.0));
    ScrollArea::vertical().auto_shrink([false, false]).show(place, |ui| {
        for file in files {
            // A project of one file is saved to that file.
            let name = file.strip_prefix(folder).ok().filter(|name| *name != Path::new(""));
            let name = name.or(file.file_name().map(Path::new)).unwrap_or(file).display().to_string();
            let row = ui.monospace(&name);
            out.place(format!("replaces:{name}"), row.rect);
        }
    });
    ui.label(format!("What is replaced is kept for {} days.", session::KEPT_DAYS));
    answers_with_default(ui, &[("Replace", Answer::Overwrite), ("Cancel", Answer::Cancel)], 1, out);
}

fn export(ui: &mut Ui, file: &Path, exists: bool, lost: &[String], room: f32, out: &mut UiOutput) {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    ui.heading(if exists { format!("Replace {name}?") } else { format!("Export to {name}?") });
    ui.colored_label(theme::of(ui).weak, file.display().to_string());
    if !lost.is_empty() {
        ui.add_space(4.0);
        let is_page = file.extension().is_some_and(|e| !e.eq_ignore_ascii_case("json"));
        ui.label(match is_page {
            true => "The page does not show everything as this window does:",
            false => "Some things will not work on Shadertoy:",
        });
        // The height of the sentences, limited by the available room.
        let width = ui.available_width() - 16.0;
        let font = egui::TextStyle::Body.resolve(ui.style());
        let sentences: Vec<String> = lost.iter().map(|lost| format!("• {lost}")).collect();
        let gap = ui.spacing().item_spacing.y;
        let height =
            |text: &String| ui.painter().layout(text.clone(), font.clone(), theme::of(ui).text, width).size().y + gap;
        let height = sentences.iter().map(height).sum::<f32>().min(room);
        let place = &mut of_height(ui, height);
        ScrollArea::vertical().auto_shrink([false, false]).show(place, |ui| {
            for (n, sentence) in sentences.iter().enumerate() {
                let row = ui.add(egui::Label::new(sentence).wrap());
                out.place(format!("lost:{n}"), row.rect);
            }
        });
    }
    if exists {
        ui.label(format!("The file already exists. The replaced one is kept for {} days.", session::KEPT_DAYS));
        answers_with_default(ui, &[("Replace", Answer::Export), ("Cancel", Answer::Cancel)], 1, out);
    } else {
        answers(ui, &[("Export", Answer::Export), ("Cancel", Answer::Cancel)], out);
    }
}

fn film(ui: &mut Ui, is_live: bool, out: &mut UiOutput) {
    ui.heading("A film is not complete yet");
    ui.label(match is_live {
        true => "You are recording what you do. Stop and save it before the window closes?",
        false => "Frames of a film are still being drawn or encoded. Eddy can close when the file is complete.",
    });
    let finish = if is_live { "Save, then close" } else { "Close when complete" };
    let list = [(finish, Answer::Finish), ("Discard the film", Answer::Discard), ("Cancel", Answer::Cancel)];
    answers(ui, &list, out);
}

fn conflict(ui: &mut Ui, tab: Option<&Tab>, file: &Path, diff: &[DiffLine], room: f32, out: &mut UiOutput) {
    let name = tab.map_or_else(|| "The project's settings".into(), Tab::title);
    ui.heading(format!("{name} also changed on disk"));
    ui.label(
        "Another program changed this file while you have unsaved edits. Either way, the other version is kept in a \
         file next to it.",
    );
    ui.colored_label(theme::of(ui).weak, file.display().to_string());
    ui.add_space(8.0);
    let rows = pair(diff);
    let height = room.min(rows.len() as f32 * ROW);
    both(ui, "Here, unsaved", "On disk", &rows, height);
    answers(ui, &[("Keep mine", Answer::KeepMine), ("Use version on disk", Answer::TakeDisk)], out);
}

fn recover(ui: &mut Ui, recovered: &Recovered, room: f32, out: &mut UiOutput) {
    let Recovered { file, name, origin, written, tabs, is_structure_changed, trouble } = recovered;
    ui.heading(format!("Recover unsaved changes to {name}?"));
    ui.label(format!("Eddy closed before they were saved. Last change: {written}."));
    let (place, there) = match origin {
        Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => {
            (path.display().to_string(), "On disk")
        }
        Origin::Preset(name) => (format!("a copy of the preset {name}"), "The preset"),
        Origin::Unsaved => ("never saved".into(), "A new shader"),
    };
    ui.colored_label(theme::of(ui).weak, place);
    if let Some(why) = trouble {
        ui.colored_label(theme::of(ui).warning, why);
    }
    ui.add_space(8.0);
    // The tab whose difference is shown.
    let id = Id::unique(("recovered tab", file));
    let mut shown = ui.data_mut(|d| *d.get_temp_mut_or_default::<usize>(id)).min(tabs.len().saturating_sub(1));
    if tabs.len() > 1 {
        ui.horizontal_wrapped(|ui| {
            for (i, tab) in tabs.iter().enumerate() {
                let choice = ui.add(egui::Button::new(tab.tab.title()).selected(i == shown));
                if out.clicked(&format!("recovered:{}", tab.tab.title()), &choice) {
                    shown = i;
                }
            }
        });
        ui.data_mut(|d| d.insert_temp(id, shown));
    }
    // The height of the longest one, whichever is shown, so that nothing moves below the pointer.
    let all: Vec<_> = tabs.iter().map(|tab| pair(&tab.diff)).collect();
    let longest = all.iter().map(Vec::len).max().unwrap_or(0);
    if let Some(rows) = all.get(shown) {
        let height = room.min(longest as f32 * ROW);
        ui.push_id((file, shown), |ui| both(ui, "Recovered", there, rows, height));
    }
    if *is_structure_changed {
        ui.label("Passes, channels, sliders or the name were changed too.");
    }
    let list = [("Recover", Answer::Recover), ("Discard", Answer::Discard), ("Ask again later", Answer::Cancel)];
    answers(ui, &list, out);
    if out.commands.contains(&Command::File(FileCommand::Answer(Answer::Recover))) {
        out.shell_commands.push(ShellCommand::ShowRecovered);
    }
}

/// Shows two texts side by side below their titles.
fn both(ui: &mut Ui, left: &str, right: &str, rows: &[(Row<'_>, bool)], height: f32) {
    let half = (ui.available_width() - 8.0) / 2.0;
    ui.horizontal(|ui| {
        for (text, tint) in [(left, theme::of(ui).good), (right, theme::of(ui).warning)] {
            let layout = egui::Layout::left_to_right(egui::Align::Center);
            ui.allocate_ui_with_layout(vec2(half, 18.0), layout, |ui| {
                ui.set_width(half);
                ui.colored_label(tint, text);
            });
        }
    });
    Frame::NONE.fill(theme::of(ui).background).corner_radius(4.0).show(ui, |ui| side_by_side(ui, rows, height));
}

/// The height of a line of the texts.
const ROW: f32 = 17.0;

/// A row of two texts side by side: the editor's and the disk's. A line that only one of them has is shown alone.
type Row<'a> = (Option<&'a str>, Option<&'a str>);

/// Pairs the lines of a diff: a run of lines only in the editor is next to the run only on disk that it replaces.
fn pair(diff: &[DiffLine]) -> Vec<(Row<'_>, bool)> {
    let mut rows = Vec::new();
    let (mut here, mut disk): (Vec<&str>, Vec<&str>) = (Vec::new(), Vec::new());
    for line in diff {
        match line {
            DiffLine::Mine(text) => here.push(text),
            DiffLine::Disk(text) => disk.push(text),
            DiffLine::Both(text) => {
                settle(&mut rows, &mut here, &mut disk);
                rows.push(((Some(text.as_str()), Some(text.as_str())), false));
            }
        }
    }
    settle(&mut rows, &mut here, &mut disk);
    rows
}

fn settle<'a>(rows: &mut Vec<(Row<'a>, bool)>, here: &mut Vec<&'a str>, disk: &mut Vec<&'a str>) {
    for i in 0..here.len().max(disk.len()) {
        rows.push(((here.get(i).copied(), disk.get(i).copied()), true));
    }
    here.clear();
    disk.clear();
}

/// Shows both texts, scrolled together from the first difference, in a place of fixed height.
fn side_by_side(ui: &mut Ui, rows: &[(Row<'_>, bool)], height: f32) {
    let first = rows.iter().position(|(_, differs)| *differs).unwrap_or(0).saturating_sub(3);
    let id = ui.scope_id().with("diff");
    let mut area = ScrollArea::vertical().id_salt(id).max_height(height).auto_shrink([false, false]);
    if ui.ctx().data_mut(|d| !std::mem::replace(d.get_temp_mut_or_default::<bool>(id), true)) {
        area = area.vertical_scroll_offset(first as f32 * ROW);
    }
    let ui = &mut of_height(ui, height);
    ui.spacing_mut().item_spacing.y = 0.0;
    area.show_rows(ui, ROW, rows.len(), |ui, range| {
        for ((here, disk), differs) in &rows[range] {
            let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::hover());
            let (left, right) = rect.split_left_right_at_fraction(0.5);
            for (side, text, tint) in [(left, here, theme::of(ui).good), (right, disk, theme::of(ui).warning)] {
                half_row(ui, side.shrink2(vec2(2.0, 0.0)), *text, differs.then_some(tint));
            }
        }
    });
}

/// Returns a `Ui` of this height regardless of its contents: a scrolling list would take the height that its dialog
/// had in the previous frame, and the dialog would grow from frame to frame.
fn of_height(ui: &mut Ui, height: f32) -> Ui {
    let (place, _) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::hover());
    ui.new_child(UiBuilder::new().max_rect(place))
}

fn half_row(ui: &Ui, rect: Rect, text: Option<&str>, tint: Option<Color32>) {
    if let Some(tint) = tint.filter(|_| text.is_some()) {
        ui.painter().rect_filled(rect, 0.0, tint.gamma_multiply(0.16));
    }
    if let Some(text) = text {
        let color = tint.unwrap_or(theme::of(ui).weak);
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let at = pos2(rect.left() + 6.0, rect.center().y);
        painter.text(at, egui::Align2::LEFT_CENTER, text, FontId::monospace(11.5), color);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaced_lines_are_paired() {
        let diff = [
            DiffLine::Both("a".into()),
            DiffLine::Disk("b".into()),
            DiffLine::Disk("c".into()),
            DiffLine::Mine("B".into()),
            DiffLine::Both("d".into()),
            DiffLine::Mine("e".into()),
        ];
        let rows = pair(&diff);
        assert_eq!(
            rows,
            [
                ((Some("a"), Some("a")), false),
                ((Some("B"), Some("b")), true),
                ((None, Some("c")), true),
                ((Some("d"), Some("d")), false),
                ((Some("e"), None), true),
            ]
        );
    }
}
