//! Questions of the session, which stand in front of everything until they are answered.

use super::{outbox::Outbox, theme};
use crate::{
    project::Tab,
    session::{Answer, Command, DiffLine, Question, Session, Then},
};
use egui::{Color32, FontId, Frame, Id, Modal, Rect, RichText, ScrollArea, Sense, Ui, pos2, vec2};
use std::path::{Path, PathBuf};

/// Shows the first question there is.
pub fn show(ui: &Ui, session: &Session, out: &mut Outbox) {
    let Some(question) = session.question() else { return };
    let window = ui.ctx().content_rect();
    let wide = matches!(question, Question::Conflict { .. });
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
            Question::RemoveTab(tab) => {
                ui.heading(format!("Remove {}?", tab.title()));
                ui.label("Its text goes with it. Nothing is deleted on disk before the project is saved.");
                answers(ui, &[("Remove", Answer::Remove), ("Cancel", Answer::Cancel)], out);
            }
        }
    });
}

/// A row of buttons, the last one the safe way out. Its key is Escape.
fn answers(ui: &mut Ui, list: &[(&str, Answer)], out: &mut Outbox) {
    ui.add_space(12.0);
    ui.horizontal_wrapped(|ui| {
        for (i, (label, answer)) in list.iter().enumerate() {
            let text = RichText::new(*label);
            let button = if i == 0 {
                egui::Button::new(text.color(theme::STRONG)).fill(theme::ACCENT_FILL)
            } else {
                egui::Button::new(text)
            };
            let response = ui.add(button.min_size(vec2(84.0, 28.0)));
            if out.clicked(&format!("answer:{}", name_of(answer)), &response) {
                out.ask(Command::Answer(answer.clone()));
            }
        }
    });
    let cancels = list.last().is_some_and(|(_, a)| *a == Answer::Cancel);
    if cancels && ui.input(|i| i.key_pressed(egui::Key::Escape)) {
        out.ask(Command::Answer(Answer::Cancel));
    }
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
        Answer::Remove => "remove",
    }
}

fn unsaved(ui: &mut Ui, session: &Session, then: &Then, tabs: &[Tab], out: &mut Outbox) {
    ui.heading(format!("Save the changes to {}?", session.project().name));
    let what = match then {
        Then::Open(_) | Then::OpenProject { .. } => "when another project is opened",
        Then::New => "when a new shader is begun",
        Then::Close => "when the window closes",
    };
    let list: Vec<String> = tabs.iter().map(Tab::title).collect();
    let list = if list.is_empty() { "channels or passes".into() } else { list.join(", ") };
    ui.label(format!("Not saved yet: {list}. The changes are lost {what}, unless you save them."));
    let answers_ = [("Save", Answer::Save), ("Discard", Answer::Discard), ("Cancel", Answer::Cancel)];
    answers(ui, &answers_, out);
}

fn overwrite(ui: &mut Ui, folder: &Path, files: &[PathBuf], out: &mut Outbox) {
    ui.heading("Replace files?");
    ui.label(format!("{} holds a project already. These files would be replaced:", folder.display()));
    ScrollArea::vertical().max_height(160.0).show(ui, |ui| {
        for file in files {
            ui.monospace(file.strip_prefix(folder).unwrap_or(file).display().to_string());
        }
    });
    answers(ui, &[("Replace", Answer::Overwrite), ("Cancel", Answer::Cancel)], out);
}

fn conflict(ui: &mut Ui, tab: Option<&Tab>, file: &Path, diff: &[DiffLine], room: f32, out: &mut Outbox) {
    let name = tab.map_or_else(|| "The project's settings".into(), Tab::title);
    ui.heading(format!("{name} changed on disk too"));
    ui.label(
        "Another program wrote the file while there are unsaved edits here. Whichever you take, the other text \
    is kept in a file beside it.",
    );
    ui.colored_label(theme::WEAK, file.display().to_string());
    ui.add_space(8.0);
    let half = (ui.available_width() - 8.0) / 2.0;
    ui.horizontal(|ui| {
        for (text, tint) in [("Here, unsaved", theme::GOOD), ("On disk", theme::WARNING)] {
            let layout = egui::Layout::left_to_right(egui::Align::Center);
            ui.allocate_ui_with_layout(vec2(half, 18.0), layout, |ui| {
                ui.set_width(half);
                ui.colored_label(tint, text);
            });
        }
    });
    Frame::NONE.fill(theme::BACKGROUND).corner_radius(4.0).show(ui, |ui| side_by_side(ui, &pair(diff), room));
    answers(ui, &[("Keep mine", Answer::KeepMine), ("Take the one on disk", Answer::TakeDisk)], out);
}

/// A row of two texts side by side: mine, and the disk's. Where one has no line, the other stands alone.
type Row<'a> = (Option<&'a str>, Option<&'a str>);

/// Pairs the lines of a diff: a run of lines only here lies beside the run only on disk that it replaces.
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

/// Both texts, scrolled together, from the first difference on.
fn side_by_side(ui: &mut Ui, rows: &[(Row<'_>, bool)], room: f32) {
    const ROW: f32 = 17.0;
    let first = rows.iter().position(|(_, differs)| *differs).unwrap_or(0).saturating_sub(3);
    let id = ui.scope_id().with("diff");
    let mut area = ScrollArea::vertical().id_salt(id).max_height(room).auto_shrink([false, true]);
    if ui.ctx().data_mut(|d| !std::mem::replace(d.get_temp_mut_or_default::<bool>(id), true)) {
        area = area.vertical_scroll_offset(first as f32 * ROW);
    }
    ui.spacing_mut().item_spacing.y = 0.0;
    area.show_rows(ui, ROW, rows.len(), |ui, range| {
        for ((here, disk), differs) in &rows[range] {
            let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::hover());
            let (left, right) = rect.split_left_right_at_fraction(0.5);
            for (side, text, tint) in [(left, here, theme::GOOD), (right, disk, theme::WARNING)] {
                half_row(ui, side.shrink2(vec2(2.0, 0.0)), *text, differs.then_some(tint));
            }
        }
    });
}

fn half_row(ui: &Ui, rect: Rect, text: Option<&str>, tint: Option<Color32>) {
    if let Some(tint) = tint.filter(|_| text.is_some()) {
        ui.painter().rect_filled(rect, 0.0, tint.gamma_multiply(0.16));
    }
    if let Some(text) = text {
        let color = tint.unwrap_or(theme::WEAK);
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let at = pos2(rect.left() + 6.0, rect.center().y);
        painter.text(at, egui::Align2::LEFT_CENTER, text, FontId::monospace(11.5), color);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaced_lines_lie_beside_each_other() {
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
