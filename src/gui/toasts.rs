//! Notices of the session. They have a place of their own below the code, or below the gallery, which covers nothing.
//! Where there is none, as in full screen, they lie over the picture and let the mouse through.

use super::{
    icons::{self, Icon},
    outbox::Outbox,
    theme,
};
use crate::session::{Command, Level, Notice, Session};
use egui::{
    Align, Align2, Area, Color32, Context, Frame, Id, Label, Layout, Margin, Order, Panel, Rect, RichText, ScrollArea,
    Sense, Stroke, Ui, pos2, vec2,
};
use std::time::{Duration, Instant};

/// Says how long one stays that is only good news; trouble stays until it is closed.
const STAYS: Duration = Duration::from_secs(8);
/// More than these would take the code's room; the newest are shown.
const SHOWN: usize = 4;
/// The name of their place.
const PLACE: &str = "notices";

/// Closes those that have been there long enough.
pub fn expire(ctx: &Context, session: &Session, now: Instant, out: &mut Outbox) {
    for notice in session.notices().iter().filter(|n| n.level == Level::Info) {
        let age = now.saturating_duration_since(notice.at);
        if age >= STAYS {
            out.ask(Command::DismissNotice(notice.id));
        } else {
            ctx.request_repaint_after(STAYS - age);
        }
    }
}

/// Shows them at the bottom of `ui`, which has so much less room.
pub fn panel(ui: &mut Ui, session: &Session, out: &mut Outbox) {
    let notices = session.notices();
    if notices.is_empty() {
        return;
    }
    let most = (ui.available_height() * 0.4).max(40.0);
    let frame = Frame::NONE.fill(theme::of(ui).raised);
    let shown = Panel::bottom(PLACE).frame(frame).show_separator_line(false).resizable(false).show(ui, |ui| {
        out.stop(PLACE, ui);
        ui.painter().hline(ui.max_rect().x_range(), ui.max_rect().top() + 0.5, Stroke::new(1.0, theme::of(ui).line));
        ui.spacing_mut().item_spacing.y = 0.0;
        ScrollArea::vertical().id_salt(PLACE).max_height(most).auto_shrink([false, true]).show(ui, |ui| {
            let hidden = notices.len().saturating_sub(SHOWN);
            if hidden > 0 {
                ui.horizontal(|ui| {
                    ui.add_space(10.0);
                    if out.clicked("notices:close-older", &ui.small_button(format!("Close {hidden} older"))) {
                        notices[..hidden].iter().for_each(|n| out.ask(Command::DismissNotice(n.id)));
                    }
                });
            }
            notices[hidden..].iter().for_each(|notice| row(ui, session, notice, out));
        });
    });
    out.place(PLACE, shown.response.rect);
}

/// Shows the newest over all else where nothing has called [`panel`]. Good news goes by itself, and so does trouble
/// here: it is still there when the code is.
pub fn over(ui: &Ui, session: &Session, now: Instant, out: &mut Outbox) {
    let is_fresh = |n: &&Notice| now.saturating_duration_since(n.at) < STAYS;
    let Some(notice) = session.notices().last().filter(is_fresh) else { return };
    if out.places.contains_key(PLACE) {
        return;
    }
    ui.ctx().request_repaint_after(STAYS.saturating_sub(now.saturating_duration_since(notice.at)));
    let width = (ui.ctx().content_rect().width() - 40.0).min(560.0);
    let area = Area::new(Id::unique(PLACE)).anchor(Align2::CENTER_BOTTOM, vec2(0.0, -24.0)).interactable(false);
    let shown = area.order(Order::Foreground).show(ui.ctx(), |ui| {
        let frame =
            Frame::popup(ui.style()).fill(theme::of(ui).raised.gamma_multiply(0.92)).inner_margin(Margin::same(10));
        frame.stroke(Stroke::new(1.0, color(ui, notice.level))).show(ui, |ui| {
            ui.set_max_width(width);
            ui.add(Label::new(&notice.text).wrap());
        });
    });
    out.place(PLACE, shown.response.rect);
}

fn color(ui: &Ui, level: Level) -> Color32 {
    match level {
        Level::Info => theme::of(ui).good,
        Level::Warning => theme::of(ui).warning,
        Level::Error => theme::of(ui).error,
    }
}

fn row(ui: &mut Ui, session: &Session, notice: &Notice, out: &mut Outbox) {
    let frame = Frame::NONE.inner_margin(Margin { left: 25, right: 6, top: 3, bottom: 3 });
    let shown = frame.show(ui, |ui| {
        ui.spacing_mut().item_spacing = vec2(6.0, 0.0);
        ui.with_layout(Layout::right_to_left(Align::TOP), |ui| {
            let close = icons::button(ui, Icon::Close, "Close this notice");
            if out.clicked(&format!("toast:{}:close", notice.id), &close.on_hover_text("Close")) {
                out.ask(Command::DismissNotice(notice.id));
            }
            let newest = session.pass_undo().map(|step| step.serial);
            if notice.undoes.is_some() && notice.undoes == newest {
                let undo = ui.button("Undo");
                if out.clicked(&format!("toast:{}:undo", notice.id), &undo) {
                    out.ask(Command::UndoPassEdit);
                    out.ask(Command::DismissNotice(notice.id));
                }
            }
            if let Some(path) = &notice.path {
                let copy = ui.button("Copy path").on_hover_text(path.display().to_string());
                if out.clicked(&format!("toast:{}:copy", notice.id), &copy) {
                    ui.ctx().copy_text(path.display().to_string());
                }
            }
            ui.with_layout(Layout::top_down(Align::LEFT), |ui| {
                ui.add_space(4.0);
                ui.add(Label::new(RichText::new(&notice.text).size(12.5)).wrap().selectable(true));
                ui.add_space(2.0);
            });
        });
    });
    let rect: Rect = shown.response.rect;
    ui.painter().circle_filled(pos2(rect.left() + 13.0, rect.top() + 15.0), 4.0, color(ui, notice.level));
    ui.interact(rect, Id::unique(("notice", notice.id)), Sense::hover());
    out.place(format!("toast:{}", notice.id), rect);
}
