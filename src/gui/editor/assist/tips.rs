//! Tooltips over the code: what the name under the pointer is, and the signature of the call around the caret.

use super::{
    super::{buffer::Buffer, lines::Lines, look::Help},
    draw,
};
use crate::{
    glsl::services::{Hover, SignatureHelp},
    gui::theme,
};
use egui::{Align2, Area, FontId, Frame, Id, Label, Margin, Order, Pos2, Rect, RichText, Ui, pos2};
use std::time::Duration;

/// The time that the pointer must rest before a tooltip opens, in seconds.
const REST: f64 = 0.35;
const WIDTH: f32 = 440.0;

/// The pointer over the text.
#[derive(Debug, Default)]
pub(super) struct Pointer {
    /// The position of the pointer, and the time in seconds since which it has rested there.
    rests: Option<(Pos2, f64)>,
    /// The place on which the pointer rests was already looked up.
    asked: bool,
    open: Option<Hover>,
}

impl Pointer {
    /// Closes the tooltip until the pointer moves again.
    pub(super) fn close(&mut self) {
        self.open = None;
        self.asked = true;
    }

    /// Opens, keeps or closes the tooltip. Returns true if it is below its line.
    pub(super) fn show(
        &mut self,
        ui: &Ui,
        lines: &Lines<'_>,
        buffer: &Buffer,
        help: Option<Help<'_>>,
        shown: Rect,
        placed: &mut Vec<(String, Rect)>,
    ) -> bool {
        let (now, is_down) = ui.input(|i| (i.time, i.pointer.any_down()));
        let at = ui.ctx().pointer_latest_pos().filter(|p| shown.contains(*p) && ui.clip_rect().contains(*p));
        let Some(at) = at.filter(|_| !is_down && !ui.ctx().any_popup_open()) else {
            *self = Self::default();
            return false;
        };
        if self.rests.is_none_or(|(pos, _)| pos.distance(at) > 1.5) {
            self.rests = Some((at, now));
            self.asked = false;
        }
        // An open tooltip stays while the pointer is on its name.
        if let Some(open) = &self.open
            && !name_rect(lines, buffer, open).is_some_and(|r| r.expand(1.0).contains(at))
        {
            self.open = None;
        }
        if self.open.is_none() && !self.asked {
            let rested = now - self.rests.map_or(now, |r| r.1);
            if rested < REST {
                ui.ctx().request_repaint_after(Duration::from_secs_f64(REST - rested));
            } else if let Some(help) = help {
                self.asked = true;
                let place = lines.position_at(buffer, at);
                self.open = help.analysis.hover(help.source, place);
                self.open.take_if(|hover| !name_rect(lines, buffer, hover).is_some_and(|r| r.contains(at)));
            }
        }
        let Some(open) = &self.open else { return false };
        let Some(name) = name_rect(lines, buffer, open) else { return false };
        tip(ui, name, true, "hover", placed, |ui| {
            if !open.signature.is_empty() {
                ui.add(Label::new(draw::code(theme::of(ui), &open.signature, &lines.font, None)).wrap());
            }
            if !open.doc.is_empty() {
                ui.add(Label::new(RichText::new(&open.doc).size(text_size(&lines.font))).wrap());
            }
            ui.add(Label::new(RichText::new(open.kind).size(small_size(&lines.font)).color(theme::of(ui).weak)));
        })
    }
}

/// Returns the rectangle of the name that a tooltip is about.
fn name_rect(lines: &Lines<'_>, buffer: &Buffer, hover: &Hover) -> Option<Rect> {
    let range = hover.span.range();
    if range.end > buffer.text().len() {
        return None;
    }
    let (first, last) = (lines.rect_of(buffer, range.start), lines.rect_of(buffer, range.end));
    (first.top() == last.top()).then(|| first.union(last))
}

/// Shows the signature of the call around the caret; `at` is where its name starts.
pub(super) fn signature(ui: &Ui, help: &SignatureHelp, at: Rect, font: &FontId, placed: &mut Vec<(String, Rect)>) {
    let Some(signature) = help.signatures.get(help.active) else { return };
    tip(ui, at, true, "signature", placed, |ui| {
        let strong = signature.params.get(help.parameter).cloned();
        ui.add(Label::new(draw::code(theme::of(ui), std::slice::from_ref(&signature.label), font, strong)).wrap());
        if !help.doc.is_empty() {
            ui.add(Label::new(RichText::new(&help.doc).size(text_size(font)).color(theme::of(ui).weak)).wrap());
        }
        if help.signatures.len() > 1 {
            let count = format!("overload {} of {}", help.active + 1, help.signatures.len());
            ui.add(Label::new(RichText::new(count).size(small_size(font)).color(theme::of(ui).weak)));
        }
    });
}

fn text_size(font: &FontId) -> f32 {
    (font.size - 0.5).max(9.0)
}

fn small_size(font: &FontId) -> f32 {
    (font.size - 2.0).max(8.0)
}

/// Shows a tooltip above a place of the text, or below it if there is no room above. Returns true if it is below.
fn tip(
    ui: &Ui,
    at: Rect,
    above: bool,
    name: &'static str,
    placed: &mut Vec<(String, Rect)>,
    contents: impl FnOnce(&mut Ui),
) -> bool {
    let window = ui.ctx().content_rect();
    // The height is known from the previous frame; a new tooltip uses a typical one.
    let id = Id::unique(("tip", name));
    let height = ui.ctx().memory(|m| m.area_rect(id)).map_or(90.0, |r| r.height());
    let below = !above || at.top() - window.top() < height + 4.0;
    let (pos, pivot) = if below {
        (pos2(at.left() - 8.0, at.bottom() + 3.0), Align2::LEFT_TOP)
    } else {
        (pos2(at.left() - 8.0, at.top() - 3.0), Align2::LEFT_BOTTOM)
    };
    let area =
        Area::new(id).order(Order::Tooltip).fixed_pos(pos).pivot(pivot).constrain_to(window).interactable(false).show(
            ui.ctx(),
            |ui| {
                Frame::popup(ui.style()).inner_margin(Margin::symmetric(9, 7)).show(ui, |ui| {
                    ui.set_max_width(WIDTH.min(window.width() - 24.0));
                    ui.spacing_mut().item_spacing.y = 4.0;
                    contents(ui);
                });
            },
        );
    placed.push((name.to_owned(), area.response.rect));
    below
}
