//! The keyboard focus: moving it from panel to panel and within one by keys, the frame around the focused widget, and
//! restoring the focus.
//!
//! Owns no widget. A part of the window registers with [`UiOutput::stop`] as a stop of F6, and the widgets in it are
//! found by egui's record of nesting. Two widgets are homes: the picture and the code. They take every key, including
//! Tab, and whichever had the focus last gets it back when nothing else has it.

use super::{
    theme,
    ui_output::{FocusStop, UiOutput},
};
use egui::{
    Context, Event, FocusDirection, Id, Key, LayerId, Modifiers, Order, Popup, Pos2, Rect, Ui, WidgetRect, WidgetRects,
    accesskit,
};
use std::collections::HashMap;

/// A field that lost the keyboard focus to a press.
struct Left {
    field: Id,
    /// The place of the field, and the part of the window that contained it.
    rect: Rect,
    stop: Option<&'static str>,
    /// The position of the press.
    at: Pos2,
}

#[derive(Default)]
pub(super) struct Focus {
    /// The stops of the previous frame, in reading order.
    stops: Vec<FocusStop>,
    /// The widget that had the focus last in each of them.
    visited: HashMap<&'static str, Id>,
    /// The home that had the focus last.
    home: Option<Id>,
    had: Option<Id>,
    /// F6 is passing through, and nothing has been done at its stops: a home that is only passed does not become the
    /// last one.
    walks: bool,
    /// The field that had the focus when the pointer was pressed, and the position: a press takes the focus from it,
    /// even if no other widget takes it.
    pressed_from: Option<Left>,
    /// The same in the next frame: the press may have changed the panel's layout, so that the field has another id.
    settling: Option<Left>,
    /// A popup was open in the previous frame, opened by this widget.
    popup_of: Option<Option<Id>>,
    /// The last press was of a key and not of the mouse: then the focus frame is shown.
    by_key: bool,
    brings_into_sight: Option<Id>,
    /// The place of the focused widget, for scripts.
    place: Option<[Rect; 2]>,
}

impl Focus {
    /// Takes the keys that move the focus within a panel, before any widget sees them.
    pub(super) fn take_keys(&mut self, ui: &Ui) {
        if let Some(id) = self.brings_into_sight.take() {
            scroll_into_view(ui, id);
        }
        let mut pressed = None;
        ui.input(|i| {
            for event in &i.events {
                match event {
                    // Shift+F6 starts with a press of Shift.
                    Event::Key { key, .. } if is_modifier(*key) => {}
                    Event::Key { pressed: true, .. } => (self.by_key, self.walks) = (true, false),
                    Event::PointerButton { pressed: true, pos, .. } => {
                        (self.by_key, self.walks) = (false, false);
                        pressed = Some(*pos);
                    }
                    _ => {}
                }
            }
        });
        let field = ui.memory(|m| m.focused()).filter(|_| ui.ctx().text_edit_focused());
        if let Some(at) = pressed {
            self.pressed_from = field.map(|field| self.leaving(ui, field, at));
        }
        // Escape closes the open popup, and is not passed on to what is below.
        let is_escape = |e: &Event| matches!(e, Event::Key { key: Key::Escape, pressed: true, .. });
        if Popup::is_any_open(ui.ctx()) && ui.input(|i| i.events.iter().any(is_escape)) {
            Popup::close_all(ui.ctx());
            ui.input_mut(|i| i.events.retain(|e| !is_escape(e)));
        }
        let focused = ui.memory(|m| m.focused());
        if self.stops.iter().any(|p| p.home.is_some() && p.home == focused) {
            return;
        }
        let pressed = |m: Modifiers| ui.input(|i| i.events.iter().any(|e| is_tab(e, m)));
        let (forward, back) = (pressed(Modifiers::NONE), pressed(Modifiers::SHIFT));
        if !forward && !back {
            return;
        }
        let widgets = ui.ctx().viewport(|v| v.prev_pass.widgets.clone());
        if let Some(next) = self.within(ui, &widgets, focused, forward) {
            ui.input_mut(|i| i.events.retain(|e| !is_tab(e, Modifiers::NONE) && !is_tab(e, Modifiers::SHIFT)));
            ui.memory_mut(|m| {
                m.move_focus(FocusDirection::None);
                m.request_focus(next);
            });
        }
    }

    /// Moves to the next widget of the popup over the panels, or of the panel that has the focus.
    fn within(&self, ui: &Ui, widgets: &WidgetRects, focused: Option<Id>, forward: bool) -> Option<Id> {
        let popup = open_popup(ui.ctx());
        let list: Vec<Id> = match (popup, focused.and_then(|id| self.stop_of(widgets, id))) {
            (Some(layer), _) => focusable(widgets, layer).map(|w| w.id).collect(),
            (None, Some(stop)) => self.inside(widgets, stop),
            // A dialog: egui cycles within it. Without focus: go to the largest part of the window.
            (None, None) if focused.is_some() || ui.memory(|m| m.top_modal_layer().is_some()) => return None,
            (None, None) => {
                let area = |p: &&FocusStop| p.rect.area();
                let largest = self.stops.iter().max_by(|a, b| area(a).total_cmp(&area(b)))?;
                return self.entry(widgets, largest);
            }
        };
        let at = focused.and_then(|id| list.iter().position(|other| *other == id));
        let count = list.len();
        match (at, forward) {
            (Some(at), true) => list.get((at + 1) % count),
            (Some(at), false) => list.get((at + count - 1) % count),
            (None, true) => list.first(),
            (None, false) => list.last(),
        }
        .copied()
    }

    /// Moves the focus to the next or the previous panel, wrapping round.
    pub(super) fn step(&mut self, ui: &Ui, out: &UiOutput, forward: bool) {
        self.stops = ordered(&out.stops);
        let found = ui.ctx().viewport(|v| {
            let widgets = &v.this_pass.widgets;
            let now = self.had.and_then(|id| self.stop_of(widgets, id));
            let at = now.and_then(|now| self.stops.iter().position(|p| p == now));
            let count = self.stops.len();
            let order = (1..=count).map(|by| match (at, forward) {
                (Some(at), true) => (at + by) % count,
                (Some(at), false) => (at + count - by) % count,
                (None, true) => by - 1,
                (None, false) => count - by,
            });
            order.map(|i| &self.stops[i]).find_map(|stop| self.entry(widgets, stop))
        });
        if let Some(id) = found {
            ui.memory_mut(|m| m.request_focus(id));
            (self.by_key, self.walks) = (true, true);
        }
    }

    /// Returns the widget that gets the focus in a panel: its home, the one that had it there last, or the first that
    /// can take it.
    fn entry(&self, widgets: &WidgetRects, stop: &FocusStop) -> Option<Id> {
        let inside = self.inside(widgets, stop);
        let visited = self.visited.get(stop.name).filter(|id| inside.contains(id));
        stop.home.filter(|id| widgets.contains(*id)).or_else(|| visited.or(inside.first()).copied())
    }

    /// Checks the focus after everything has been shown, and restores it if nothing has it.
    ///
    /// `is_covered`: something modal is in front, or nothing can take the focus.
    pub(super) fn settle(&mut self, ui: &Ui, out: &UiOutput, is_covered: bool) {
        self.stops = ordered(&out.stops);
        let is_popup_open = Popup::is_any_open(ui.ctx());
        self.place = None;
        let had = std::mem::replace(&mut self.had, ui.memory(|m| m.focused()));
        let is_held = ui.input(|i| i.pointer.any_down());
        let left = if is_held { None } else { self.pressed_from.take() };
        let field = left.as_ref().or(self.settling.as_ref()).and_then(|left| self.field_beside(ui, left));
        self.settling = left;
        // The press has removed the field. It keeps the focus to the end of this frame, which is too late to look for
        // its neighbour.
        if let (Some(field), Some(gone)) = (field, self.had.filter(|id| layer_of(ui, *id).is_none()))
            && field != gone
        {
            return self.set_focus(ui, field);
        }
        match (is_popup_open, self.popup_of) {
            (true, None) => self.popup_of = Some(field.or(had)),
            (false, Some(opener)) => {
                self.popup_of = None;
                if let (None, Some(opener)) = (self.had, opener) {
                    self.set_focus(ui, opener);
                }
            }
            _ => {}
        }
        let Some(id) = self.had else {
            let is_of_popup = |id: &Id| !is_popup_open || layer_of(ui, *id) == open_popup(ui.ctx());
            if let Some(field) = field.filter(is_of_popup) {
                return self.set_focus(ui, field);
            }
            let home = self.home.filter(|id| self.stops.iter().any(|p| p.home == Some(*id)));
            let home = home.or_else(|| self.stops.iter().find_map(|p| p.home));
            if let (Some(home), false) = (home, is_covered || is_popup_open || is_held) {
                self.set_focus(ui, home);
            }
            return;
        };
        self.place = ui.ctx().viewport(|v| v.this_pass.widgets.get(id).map(|w| [w.rect, w.interact_rect]));
        if self.stops.iter().any(|p| p.home == Some(id)) {
            if !self.walks {
                self.home = Some(id);
            }
            return;
        }
        let Some(widget) = ui.ctx().viewport(|v| {
            let widgets = &v.this_pass.widgets;
            if let Some(stop) = self.stop_of(widgets, id) {
                self.visited.insert(stop.name, id);
            }
            widgets.get(id).copied()
        }) else {
            return;
        };
        if self.by_key {
            if had != Some(id) && widget.interact_rect != widget.rect {
                self.brings_into_sight = Some(id);
                ui.ctx().request_repaint();
            }
            frame(ui, &widget);
        }
    }

    /// Returns the place of the focused widget: all of it, and the visible part.
    pub(super) fn place(&self) -> Option<[Rect; 2]> {
        self.place
    }

    fn set_focus(&mut self, ui: &Ui, id: Id) {
        if ui.ctx().viewport(|v| v.this_pass.widgets.contains(id)) {
            ui.memory_mut(|m| m.request_focus(id));
            self.had = Some(id);
            ui.ctx().request_repaint();
        }
    }

    fn leaving(&self, ui: &Ui, field: Id, at: Pos2) -> Left {
        ui.ctx().viewport(|v| {
            let widgets = &v.prev_pass.widgets;
            let rect = widgets.get(field).map_or(Rect::NOTHING, |w| w.rect);
            Left { field, rect, stop: self.stop_of(widgets, field).map(|stop| stop.name), at }
        })
    }

    /// Returns the field that lost the focus to a press, if the press was in the same panel or window. If the panel's
    /// layout has changed, returns the field nearest to its old place.
    fn field_beside(&self, ui: &Ui, left: &Left) -> Option<Id> {
        let stop = left.stop.and_then(|name| self.stops.iter().find(|stop| stop.name == name));
        if left.stop.is_some() && stop.is_none_or(|stop| !stop.rect.contains(left.at)) {
            return None;
        }
        if let Some(layer) = layer_of(ui, left.field) {
            return (ui.ctx().layer_id_at(left.at) == Some(layer)).then_some(left.field);
        }
        let inside = ui.ctx().viewport(|v| {
            let widgets = &v.this_pass.widgets;
            let place = |id: Id| Some((id, widgets.get(id)?.rect.center().distance(left.rect.center())));
            self.inside(widgets, stop?).into_iter().map(place).collect::<Option<Vec<_>>>()
        });
        let is_field = |id: Id| egui::text_edit::TextEditState::load(ui.ctx(), id).is_some();
        let nearest = |of: &dyn Fn(Id) -> bool| {
            let all = inside.as_ref()?.iter().filter(|(id, _)| of(*id));
            all.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(id, _)| *id)
        };
        // A number that is not being typed is not a text field yet.
        nearest(&is_field).or_else(|| nearest(&|_| true))
    }

    /// Returns the innermost panel that contains a widget.
    fn stop_of(&self, widgets: &WidgetRects, id: Id) -> Option<&FocusStop> {
        let mut at = widgets.get(id)?;
        loop {
            if let Some(stop) = self.stops.iter().find(|p| p.ui == at.id || p.ui == at.parent_id) {
                return Some(stop);
            }
            at = widgets.get(at.parent_id).filter(|parent| parent.id != at.id)?;
        }
    }

    /// Returns the focusable widgets in a panel, in the order in which they were shown.
    fn inside(&self, widgets: &WidgetRects, stop: &FocusStop) -> Vec<Id> {
        let Some(layer) = widgets.get(stop.ui).map(|w| w.layer_id) else { return Vec::new() };
        let is_inside = |w: &&WidgetRect| self.stop_of(widgets, w.id).is_some_and(|p| p.ui == stop.ui);
        focusable(widgets, layer).filter(is_inside).map(|w| w.id).collect()
    }
}

/// Sorts panels by rows from the top, and each row from the left.
fn ordered(stops: &[FocusStop]) -> Vec<FocusStop> {
    let mut list = stops.to_vec();
    list.sort_by(|a, b| (a.rect.top(), a.rect.left()).partial_cmp(&(b.rect.top(), b.rect.left())).unwrap());
    list
}

/// Scroll bars and the edges of panels are thinner than anything else; they are for the mouse.
const THIN: f32 = 14.0;

fn focusable(widgets: &WidgetRects, layer: LayerId) -> impl Iterator<Item = &WidgetRect> {
    let takes_keys = |w: &&WidgetRect| w.enabled && w.visible && w.sense.is_focusable();
    widgets.get_layer(layer).filter(takes_keys).filter(|w| w.rect.size().min_elem() >= THIN)
}

fn layer_of(ui: &Ui, id: Id) -> Option<LayerId> {
    ui.ctx().viewport(|v| v.this_pass.widgets.get(id).map(|w| w.layer_id))
}

/// Returns the layer of the open menu or list.
fn open_popup(ctx: &Context) -> Option<LayerId> {
    Popup::is_any_open(ctx).then(|| ctx.memory(|m| m.areas().top_layer_id(Order::Foreground))).flatten()
}

fn is_modifier(key: Key) -> bool {
    use Key::{AltLeft, AltRight, ControlLeft, ControlRight, ShiftLeft, ShiftRight, SuperLeft, SuperRight};
    matches!(key, ShiftLeft | ShiftRight | ControlLeft | ControlRight | AltLeft | AltRight | SuperLeft | SuperRight)
}

fn is_tab(event: &Event, with: Modifiers) -> bool {
    matches!(event, Event::Key { key: Key::Tab, pressed: true, modifiers, .. } if modifiers.matches_exact(with))
}

/// Scrolls a widget into view, as a screen reader does.
fn scroll_into_view(ui: &Ui, id: Id) {
    let request = accesskit::ActionRequest {
        action: accesskit::Action::ScrollIntoView,
        target_tree: accesskit::TreeId::ROOT,
        target_node: id.accesskit_id(),
        data: None,
    };
    ui.input_mut(|i| i.events.push(Event::AccessKitActionRequest(request)));
}

/// Draws the focus frame around a widget.
fn frame(ui: &Ui, widget: &WidgetRect) {
    if !widget.interact_rect.is_positive() {
        return;
    }
    let painter = ui.ctx().layer_painter(widget.layer_id).with_clip_rect(widget.interact_rect.expand(3.0));
    painter.rect_stroke(widget.rect.expand(1.0), 5.0, theme::of(ui).focus(), egui::StrokeKind::Outside);
}

#[cfg(test)]
mod tests;
