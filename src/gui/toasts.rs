//! Notices of the session, over the bottom right corner.

use super::{
    icons::{self, Icon},
    outbox::Outbox,
    theme,
};
use crate::session::{Command, Level, Notice, Session};
use egui::{Align2, Area, Frame, Id, Margin, Order, Stroke, Ui, vec2};
use std::time::{Duration, Instant};

/// How long one stays that is only good news; trouble stays until it is closed.
const STAYS: Duration = Duration::from_secs(8);
/// More than these would cover the window; the newest are shown.
const SHOWN: usize = 4;

pub fn show(ui: &Ui, session: &Session, now: Instant, out: &mut Outbox) {
    let notices = session.notices();
    for notice in notices {
        let age = now.saturating_duration_since(notice.at);
        if notice.level == Level::Info {
            if age >= STAYS {
                out.ask(Command::DismissNotice(notice.id));
            } else {
                ui.ctx().request_repaint_after(STAYS - age);
            }
        }
    }
    if notices.is_empty() {
        return;
    }
    let width = (ui.ctx().content_rect().width() - 40.0).min(420.0);
    Area::new(Id::unique("toasts")).anchor(Align2::RIGHT_BOTTOM, vec2(-12.0, -52.0)).order(Order::Foreground).show(
        ui.ctx(),
        |ui| {
            ui.set_max_width(width);
            let hidden = notices.len().saturating_sub(SHOWN);
            if hidden > 0 && ui.small_button(format!("Close {hidden} older")).clicked() {
                notices[..hidden].iter().for_each(|n| out.ask(Command::DismissNotice(n.id)));
            }
            for notice in &notices[hidden..] {
                toast(ui, notice, width, out);
            }
        },
    );
}

fn toast(ui: &mut Ui, notice: &Notice, width: f32, out: &mut Outbox) {
    let color = match notice.level {
        Level::Info => theme::GOOD,
        Level::Warning => theme::WARNING,
        Level::Error => theme::ERROR,
    };
    let frame =
        Frame::popup(ui.style()).fill(theme::RAISED).inner_margin(Margin { left: 14, right: 6, top: 6, bottom: 6 });
    let shown = frame.stroke(Stroke::new(1.0, theme::LINE)).show(ui, |ui| {
        ui.set_width(width - 24.0);
        ui.horizontal_top(|ui| {
            ui.with_layout(egui::Layout::right_to_left(egui::Align::TOP), |ui| {
                let close = icons::button(ui, Icon::Close, "Close");
                if out.clicked(&format!("toast:{}:close", notice.id), &close) {
                    out.ask(Command::DismissNotice(notice.id));
                }
                if let Some(path) = &notice.path {
                    let copy = ui.small_button("Copy path").on_hover_text(path.display().to_string());
                    if copy.clicked() {
                        ui.ctx().copy_text(path.display().to_string());
                    }
                }
                ui.with_layout(egui::Layout::top_down(egui::Align::LEFT), |ui| {
                    ui.add(egui::Label::new(&notice.text).wrap().selectable(true));
                });
            });
        });
    });
    let rect = shown.response.rect;
    let stripe = egui::Rect::from_min_max(rect.min, egui::pos2(rect.left() + 4.0, rect.bottom()));
    ui.painter().rect_filled(stripe, egui::CornerRadius { nw: 6, sw: 6, ne: 0, se: 0 }, color);
    out.place(format!("toast:{}", notice.id), rect);
}
