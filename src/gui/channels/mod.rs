//! The panel of channels: the input and sampler of each channel of the selected pass.

mod choose;
mod device_rows;
mod live;
mod names;
mod sound;
mod swatch;

pub(super) use live::Live;

use super::{
    panels::{Content, DefaultPlace, PanelContext, PanelRow},
    theme,
};
use crate::{
    engine::pass_kind,
    glsl::PassKind,
    project::{self, Channel, Pass, Project, SLOTS, Tab},
    session::Session,
};
use egui::{
    Align2, Color32, FontId, Margin, Popup, PopupCloseBehavior, Rect, Response, Sense, Stroke, StrokeKind, Ui, pos2,
    vec2,
};
use names::{input_name, sampler_name};
use swatch::Swatches;

pub(super) const PANEL: PanelRow =
    PanelRow::new("channels", "Channels", DefaultPlace::Own, Content::Within(Margin::ZERO, show))
        .open_by_default()
        .heading(|context| title(context.session, context.code.current()))
        .action("Panel: Channels", &[], "inputs textures samplers");

/// The preferred height of the cards, with their margins.
pub(super) const HEIGHT: f32 = 92.0;
/// The maximum height of the cards.
const MAX_HEIGHT: f32 = 128.0;
/// The width of a channel that reads nothing.
const EMPTY_WIDTH: f32 = 46.0;
const GAP: f32 = 6.0;

/// Returns the panel's title, which names the pass.
fn title(session: &Session, tab: &Tab) -> String {
    match pass(session, tab) {
        Some(pass) => format!("Channels of {}", pass.id.title()),
        None => "Channels".to_owned(),
    }
}

fn pass<'s>(session: &'s Session, tab: &Tab) -> Option<&'s Pass> {
    match tab {
        Tab::Pass(id) | Tab::Stage(id, _) => session.project().pass(id),
        // Channels of Image, if an editor starts with one of its included files.
        Tab::Included(_) if *tab == session.project().main_tab() => session.project().image(),
        Tab::Common | Tab::Included(_) => None,
    }
}

fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let PanelContext { session, code, thumbnails, live, out, .. } = context;
    let tab = code.current();
    out.stop("channels", ui);
    let rect = ui.available_rect_before_wrap();
    let mut swatches = Swatches { session, thumbnails, live };
    let Some(pass) = pass(session, tab) else {
        let text = match tab {
            Tab::Included(_) => "An included file has no channels of its own",
            _ => "Common is shared code; channels belong to passes",
        };
        let painter = ui.painter().with_clip_rect(rect);
        let font = FontId::proportional(12.0);
        painter.text(rect.center(), Align2::CENTER_CENTER, text, font, theme::of(ui).weak);
        return;
    };
    let slots = slots(session.project(), pass);
    if slots == 0 {
        let text = "This shader declares no textures. Add a line like this: uniform sampler2D u_tex0;";
        let painter = ui.painter().with_clip_rect(rect);
        painter.text(rect.center(), Align2::CENTER_CENTER, text, FontId::proportional(12.0), theme::of(ui).weak);
        return;
    }
    let inner = rect.shrink2(vec2(8.0, 0.0)).with_max_y(rect.bottom() - 8.0);
    let height = inner.height().clamp(24.0, MAX_HEIGHT);
    let is_read: Vec<bool> = (0..slots).map(|slot| pass.bindings.get(slot).is_some()).collect();
    let widths = widths(inner.width(), &is_read);
    let mut left = inner.left();
    for (index, width) in widths.into_iter().enumerate() {
        let channel = pass.bindings.get(index);
        let card = Rect::from_min_size(pos2(left, inner.top()), vec2(width, height));
        left = card.right() + GAP;
        let response = match channel {
            Some(channel) => show_card(ui, card, (index, pass.bindings.name(index)), channel, &mut swatches),
            None => show_empty(ui, card, index),
        };
        out.place(format!("channel:{index}"), card);
        let width = (rect.width() - 16.0).clamp(260.0, 760.0);
        Popup::from_toggle_button_response(&response)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .width(width)
            .show(|ui| choose::choose(ui, &pass.id, index, channel, &mut swatches, out));
    }
}

/// Returns the number of channels that a pass of a project offers: Shadertoy's, or those that the text declares.
fn slots(project: &Project, pass: &Pass) -> usize {
    let bound = pass.bindings.iter().map(|(slot, _)| slot + 1).max().unwrap_or_default();
    let named = pass.bindings.names().map(|(slot, _)| slot + 1).max().unwrap_or_default();
    let least = if matches!(pass_kind(project, pass), PassKind::Main(_)) { 0 } else { SLOTS };
    bound.max(named).max(least)
}

/// Divides the width: channels with an input share what empty ones leave.
fn widths(width: f32, is_read: &[bool]) -> Vec<f32> {
    let count = is_read.len() as f32;
    let empty = is_read.iter().filter(|read| !**read).count() as f32;
    let room = width - (count - 1.0) * GAP;
    let least = EMPTY_WIDTH.min(room / count);
    let of_read = (room - empty * least) / (count - empty).max(1.0);
    is_read.iter().map(|read| if *read { of_read.clamp(0.0, 260.0) } else { least }).collect()
}

/// Shows the card of an empty channel.
fn show_empty(ui: &Ui, card: Rect, index: usize) -> Response {
    let p = theme::of(ui);
    let response = ui.interact(card, ui.scope_id().with(("channel", index)), Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, format!("iChannel{index}: none")));
    let is_hot = response.hovered() || response.has_focus();
    let (fill, edge, ink) = if is_hot { (p.button, p.accent, p.strong) } else { (p.panel, p.line, p.weak) };
    ui.painter().rect(card, 5.0, fill, Stroke::new(1.0, edge), StrokeKind::Inside);
    let c = card.center() - vec2(0.0, if card.height() > 40.0 { 6.0 } else { 0.0 });
    for arm in [vec2(5.0, 0.0), vec2(0.0, 5.0)] {
        ui.painter().line_segment([c - arm, c + arm], Stroke::new(1.5, ink));
    }
    if card.height() > 40.0 {
        let at = pos2(card.center().x, c.y + 16.0);
        ui.painter().text(at, Align2::CENTER_CENTER, index, FontId::proportional(11.0), p.weak);
    }
    response
        .on_hover_text(format!("iChannel{index} has no input. Click to choose one"))
        .on_hover_cursor(egui::CursorIcon::PointingHand)
}

fn show_card(
    ui: &Ui,
    card: Rect,
    (index, named): (usize, Option<&str>),
    channel: &Channel,
    swatches: &mut Swatches<'_>,
) -> Response {
    let p = theme::of(ui);
    let long = named.map_or_else(|| format!("iChannel{index}"), str::to_owned);
    let short = named.map_or_else(|| index.to_string(), str::to_owned);
    let response = ui.interact(card, ui.scope_id().with(("channel", index)), Sense::click());
    let name = input_name(&channel.input);
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, format!("{long}: {name}")));
    let painter = ui.painter().with_clip_rect(card);
    let is_hot = response.hovered() || response.has_focus();
    painter.rect_filled(card, 5.0, if is_hot { p.button } else { p.raised });
    painter.rect_stroke(card, 5.0, Stroke::new(1.0, if is_hot { p.accent } else { p.line }), StrokeKind::Inside);
    let missing = project::missing_pass(swatches.session.project(), &channel.input);
    // Texts are next to the picture if the card is wide, below it if the card is high.
    let is_upright = card.height() > 76.0 && card.width() < 2.2 * card.height();
    let texts = if is_upright { 36.0 } else { 0.0 };
    let room = vec2(card.width() - 10.0, card.height() - 10.0 - texts);
    let room = if is_upright { room } else { vec2(room.x.min(room.y * 16.0 / 9.0), room.y) };
    let has_picture = room.x > 20.0 && (is_upright || card.width() > room.x + 66.0);
    let mut text = card.shrink2(vec2(8.0, 5.0));
    if has_picture {
        let place = Rect::from_min_size(card.min + vec2(5.0, 5.0), room);
        match missing {
            // Nothing is read, so the place stays empty.
            Some(_) => drop(painter.rect_filled(place, 3.0, p.surround)),
            None => swatches.show(ui, place, &channel.input),
        }
        text = if is_upright { text.with_min_y(place.bottom() + 2.0) } else { text.with_min_x(place.right() + 8.0) };
    }
    let has_room = |line_text: &str, size: f32| {
        let galley = painter.layout_no_wrap(line_text.to_owned(), FontId::proportional(size), p.weak);
        galley.size().x <= card.right() - text.left() - 5.0
    };
    let line = |y: f32, line_text: &str, size: f32, color: Color32| {
        let mut job = egui::text::LayoutJob::simple_singleline(line_text.to_owned(), FontId::proportional(size), color);
        job.wrap = egui::text::TextWrapping::truncate_at_width((card.right() - text.left() - 5.0).max(8.0));
        let galley = painter.layout_job(job);
        painter.galley(pos2(text.left(), y - galley.size().y / 2.0), galley, color);
    };
    let (tint, how) = match missing {
        Some(_) => (p.warning, "no such pass".to_owned()),
        None => (p.text, sampler_name(channel)),
    };
    let of_how = if missing.is_some() { p.warning } else { p.weak };
    if is_upright {
        line(text.top() + 8.0, &format!("{short}  {name}"), 12.5, tint);
        line(text.top() + 24.0, &how, 11.0, of_how);
    } else if card.height() > 52.0 {
        let middle = card.center().y;
        line(middle - 17.0, &long, 11.0, p.weak);
        line(middle, &name, 12.5, tint);
        // Omitted if it would be truncated: the tooltip has it too.
        if missing.is_some() || has_room(&how, 11.0) {
            line(middle + 17.0, &how, 11.0, of_how);
        }
    } else {
        line(card.center().y, &format!("{short}  {name}"), 12.0, tint);
    }
    let more = match missing {
        Some(id) => format!("There is no {}; the channel reads zero", id.title()),
        None => sampler_name(channel),
    };
    response.on_hover_text(format!("{long}: {name}\n{more}")).on_hover_cursor(egui::CursorIcon::PointingHand)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn empty_channels_are_narrow() {
        let sum = |widths: &[f32]| widths.iter().sum::<f32>() + 3.0 * GAP;
        let all = widths(600.0, &[true; 4]);
        assert!((sum(&all) - 600.0).abs() < 0.1 && all[0] == all[3]);
        let one = widths(600.0, &[false, true, false, false]);
        assert_eq!((one[0], one[1]), (EMPTY_WIDTH, 260.0));
        let none = widths(600.0, &[false; 4]);
        assert_eq!(none, [EMPTY_WIDTH; 4]);
        assert!(sum(&widths(120.0, &[true, false, true, false])) <= 120.1);
        let sixteen = widths(600.0, &[true; 16]);
        assert!((sixteen.iter().sum::<f32>() + 15.0 * GAP - 600.0).abs() < 0.1);
    }
}
