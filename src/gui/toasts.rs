//! Notices of the session. They are shown below the code, or below the gallery, where they cover nothing. If neither
//! is visible, as in full screen, they are over the picture and let the mouse through.

use super::{
    actions::Action,
    icons::{self, Icon},
    inline_code::Inline,
    theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::session::{About, EditCommand, Level, Notice, NoticeCommand, Session};
use egui::{
    Align, Align2, Area, Color32, Context, FontId, Frame, Id, Label, Layout, Margin, Order, Panel, Rect, ScrollArea,
    Sense, Stroke, TextFormat, Ui, pos2, text::LayoutJob, vec2,
};
use std::time::{Duration, Instant};

/// The time that a notice of success is shown; a problem stays until it is closed.
const STAYS: Duration = Duration::from_secs(8);
/// The maximum number of notices shown, newest first, so that they leave room for the code.
const SHOWN: usize = 4;
/// The name of their area.
const PLACE: &str = "notices";

/// Notices with equal texts, shown as one.
struct Group<'a> {
    newest: &'a Notice,
    /// The ids of all of them, oldest first.
    ids: Vec<u64>,
}

/// Returns the notices, newest first, with equal texts merged.
fn groups(notices: &[Notice]) -> Vec<Group<'_>> {
    let mut groups: Vec<Group<'_>> = Vec::new();
    for notice in notices.iter().rev() {
        let is_same = |one: &&mut Group<'_>| {
            let newest = one.newest;
            (newest.level, &newest.text, &newest.path) == (notice.level, &notice.text, &notice.path)
        };
        match groups.iter_mut().find(is_same) {
            Some(one) => one.ids.insert(0, notice.id),
            None => groups.push(Group { newest: notice, ids: vec![notice.id] }),
        }
    }
    groups
}

impl Group<'_> {
    fn text(&self) -> String {
        match self.ids.len() {
            1 => self.newest.text.clone(),
            n => format!("{} (×{n})", self.newest.text),
        }
    }

    fn dismiss(&self, out: &mut UiOutput) {
        self.ids.iter().for_each(|id| out.ask(NoticeCommand::DismissNotice(*id)));
    }
}

/// Closes notices whose time is over. A repeated one lasts as long as the newest of its kind.
pub(super) fn expire(ctx: &Context, session: &Session, now: Instant, out: &mut UiOutput) {
    for group in groups(session.notices()).iter().filter(|group| group.newest.level == Level::Info) {
        let age = now.saturating_duration_since(group.newest.at);
        if age >= STAYS {
            group.dismiss(out);
        } else {
            ctx.request_repaint_after(STAYS - age);
        }
    }
}

/// Shows the notices at the bottom of `ui`, which shrinks accordingly: the newest on top, and the oldest below, where
/// one scrolls to them. `limit`: their maximum height; one line is always shown.
pub(super) fn panel(ui: &mut Ui, session: &Session, limit: f32, out: &mut UiOutput) {
    let groups = groups(session.notices());
    if groups.is_empty() {
        return;
    }
    let frame = Frame::NONE.fill(theme::of(ui).raised);
    // Uses the height of the contents in the last frame: a scroll area does not report the height that it would like.
    let id = Id::unique("height of notices");
    let (count, height) = ui.data(|d| d.get_temp::<(usize, f32)>(id)).unwrap_or_default();
    let more = groups.len().min(SHOWN) as f32 - count.min(SHOWN) as f32;
    let height = (height + more * ROW).max(ROW);
    let panel = Panel::bottom(PLACE).frame(frame).show_separator_line(false).resizable(false);
    let shown = panel.exact_size(height.min(limit.max(ROW))).show(ui, |ui| {
        out.stop(PLACE, ui);
        ui.painter().hline(ui.max_rect().x_range(), ui.max_rect().top() + 0.5, Stroke::new(1.0, theme::of(ui).line));
        ui.spacing_mut().item_spacing.y = 0.0;
        let area = ScrollArea::vertical().id_salt(PLACE).min_scrolled_height(0.0).auto_shrink([false, true]);
        let shown = area.show(ui, |ui| {
            groups.iter().take(SHOWN).for_each(|group| row(ui, session, group, out));
            let older = groups.get(SHOWN..).unwrap_or_default();
            if !older.is_empty() {
                ui.horizontal(|ui| {
                    ui.add_space(10.0);
                    let close = ui.small_button(format!("Close {} older", older.len()));
                    if out.clicked("notices:close-older", &close) {
                        older.iter().for_each(|group| group.dismiss(out));
                    }
                });
            }
        });
        ui.data_mut(|d| d.insert_temp(id, (groups.len(), shown.content_size.y)));
        if (shown.content_size.y - height).abs() > 0.5 {
            ui.ctx().request_repaint();
        }
    });
    out.place(PLACE, shown.response.rect);
}

/// Shows the newest over everything else if nothing has called [`panel`]. Notices of success disappear after a while,
/// and here those of problems too: they are still there when the code is shown.
pub(super) fn over(ui: &Ui, session: &Session, now: Instant, out: &mut UiOutput) {
    let is_fresh = |n: &&Notice| now.saturating_duration_since(n.at) < STAYS;
    let groups = groups(session.notices());
    let Some(group) = groups.first().filter(|group| is_fresh(&group.newest)) else { return };
    let notice = group.newest;
    if out.places.contains_key(PLACE) {
        return;
    }
    ui.ctx().request_repaint_after(STAYS.saturating_sub(now.saturating_duration_since(notice.at)));
    let width = (ui.ctx().content_rect().width() - 40.0).min(560.0);
    let area = Area::new(Id::unique(PLACE)).anchor(Align2::CENTER_BOTTOM, vec2(0.0, -24.0)).interactable(false);
    out.show_area(PLACE, area.order(Order::Foreground), ui, |ui, _| {
        let frame =
            Frame::popup(ui.style()).fill(theme::of(ui).raised.gamma_multiply(0.92)).inner_margin(Margin::same(10));
        frame.stroke(Stroke::new(1.0, color(ui, notice.level))).show(ui, |ui| {
            ui.set_max_width(width);
            ui.add(Label::new(laid_out(ui, &group.text(), 13.0)).wrap());
        });
    });
}

/// Returns whether a line belongs to the excerpt that shows an error's place in a text (`diag::render`), where columns
/// must align.
fn is_excerpt(line: &str) -> bool {
    let line = line.trim_start();
    let behind_number = line.trim_start_matches(|c: char| c.is_ascii_digit()).trim_start();
    line.starts_with("--> ") || behind_number.starts_with('|') || line.starts_with("= help: ")
}

/// Lays out a text with excerpts in the font of code, so that carets are below what they point at.
fn laid_out(ui: &Ui, text: &str, size: f32) -> LayoutJob {
    let color = ui.visuals().text_color();
    let mut job = LayoutJob::default();
    let inline = Inline { size, color, palette: theme::of(ui) };
    for line in text.split_inclusive('\n') {
        match is_excerpt(line) {
            true => job.append(line, 0.0, TextFormat::simple(FontId::monospace(size - 1.0), color)),
            false => inline.append(&mut job, line),
        }
    }
    job
}

fn color(ui: &Ui, level: Level) -> Color32 {
    match level {
        Level::Info => theme::of(ui).good,
        Level::Warning => theme::of(ui).warning,
        Level::Error => theme::of(ui).error,
    }
}

/// The margins of a row's text: the mark at the left, and the space above and below.
const MARK: f32 = 25.0;
const PADDING: f32 = 4.0;
/// The height of a row's buttons, and of a row with one line.
const BUTTON: f32 = 20.0;
pub(super) const ROW: f32 = BUTTON + 2.0 * PADDING;

/// Shows a notice, as high as its text and its buttons need.
fn row(ui: &mut Ui, session: &Session, group: &Group<'_>, out: &mut UiOutput) {
    let notice = group.newest;
    let newest = session.pass_undo().map(|step| step.serial);
    let undoes = notice.undoes.is_some() && notice.undoes == newest;
    let frame =
        Frame::NONE.inner_margin(Margin { left: MARK as i8, right: 6, top: PADDING as i8, bottom: PADDING as i8 });
    let shown = frame.show(ui, |ui| {
        let spacing = ui.spacing_mut();
        (spacing.item_spacing, spacing.interact_size.y) = (vec2(6.0, 0.0), BUTTON);
        spacing.button_padding.y = 1.0;
        ui.with_layout(Layout::right_to_left(Align::TOP), |ui| {
            let close = icons::flat(ui, Icon::Close, "Close this notice");
            if out.clicked(&format!("toast:{}:close", notice.id), &close.on_hover_text("Close")) {
                group.dismiss(out);
            }
            if undoes {
                let undo = ui.button("Undo");
                if out.clicked(&format!("toast:{}:undo", notice.id), &undo) {
                    out.ask(EditCommand::UndoPassEdit);
                    group.dismiss(out);
                }
            }
            if notice.about == About::Gone {
                let save = ui.button("Save as…");
                out.on_click(&format!("toast:{}:save-as", notice.id), &save, Action::SaveAs);
            }
            if let Some(path) = &notice.path {
                let show = ui.button("Show in folder").on_hover_text(path.display().to_string());
                let request = ShellCommand::ShowInFolder(path.clone());
                out.on_click(&format!("toast:{}:show", notice.id), &show, request);
                let copy = ui.button("Copy path").on_hover_text(path.display().to_string());
                if out.clicked(&format!("toast:{}:copy", notice.id), &copy) {
                    ui.ctx().copy_text(path.display().to_string());
                }
            }
            ui.with_layout(Layout::top_down(Align::LEFT), |ui| {
                ui.add_space(2.0);
                ui.add(Label::new(laid_out(ui, &group.text(), 12.5)).wrap().selectable(true));
            });
        });
    });
    let rect: Rect = shown.response.rect;
    let mark = pos2(rect.left() + 13.0, rect.top() + PADDING + BUTTON / 2.0);
    ui.painter().circle_filled(mark, 4.0, color(ui, notice.level));
    ui.interact(rect, Id::unique(("notice", notice.id)), Sense::hover());
    out.place(format!("toast:{}", notice.id), rect);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn notice(id: u64, text: &str, level: Level) -> Notice {
        Notice { id, level, text: text.into(), path: None, undoes: None, at: Instant::now(), about: Default::default() }
    }

    #[test]
    fn excerpts_align_columns() {
        let text = "not saved:\nerror: [passes.image] has no key nonsense\n  --> eddy.toml:10:1\n   |\n10 | nonsense = 3\n   \
                    | ^^^^^^^^\n   = help: the keys are file and size\n\n3 files, a | b";
        let excerpt: Vec<_> = text.lines().map(is_excerpt).collect();
        assert_eq!(excerpt, [false, false, true, true, true, true, true, false, false]);
    }

    #[test]
    fn the_newest_is_first_and_repeated_ones_are_merged() {
        let all = [
            notice(1, "a", Level::Error),
            notice(2, "b", Level::Info),
            notice(3, "a", Level::Error),
            notice(4, "a", Level::Info),
            notice(5, "c", Level::Info),
        ];
        let groups = groups(&all);
        let formatted: Vec<_> = groups.iter().map(|one| (one.text(), one.ids.clone())).collect();
        let wanted: [(&str, &[u64]); 4] = [("c", &[5]), ("a", &[4]), ("a (×2)", &[1, 3]), ("b", &[2])];
        assert_eq!(formatted, wanted.map(|(text, ids)| (text.to_owned(), ids.to_vec())));
        let mut out = UiOutput::default();
        groups[2].dismiss(&mut out);
        assert_eq!(out.commands.len(), 2, "closing one closes all that say the same");
    }
}
