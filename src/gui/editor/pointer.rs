//! The pointer over the text: placing carets, selecting by letters, words and lines, pasting.

use super::{
    lines::Lines,
    look::Help,
    selection::{Carets, Selection},
    view::CodeEditor,
};
use egui::Ui;
use std::ops::Range;

impl CodeEditor {
    pub(super) fn pointer(&mut self, ui: &Ui, response: &egui::Response, lines: &Lines<'_>, help: Option<Help<'_>>) {
        let Some(pointer) = response.interact_pointer_pos().or_else(|| response.hover_pos()) else { return };
        let (pressed, modifiers) = ui.input(|i| (i.pointer.primary_pressed(), i.modifiers));
        let at = lines.position_at(&self.buffer, pointer);
        // A press and its release can both arrive between two frames: then there is only the click.
        let clicked_between = response.clicked() && pressed;
        if (pressed && response.is_pointer_button_down_on()) || clicked_between {
            response.request_focus();
            self.moved_at = ui.input(|i| i.time);
            self.assist.close_all();
            if modifiers.command && !modifiers.shift {
                self.drag = None;
                self.buffer.select(at, at);
                self.assist.go_to_definition();
                ui.ctx().request_repaint();
                return;
            }
            // Alt adds a caret, as in VS Code.
            let others = if modifiers.alt { self.buffer.carets().list().to_vec() } else { Vec::new() };
            let from = if modifiers.shift { self.buffer.selection().anchor } else { at };
            self.drag = Some(Drag { from: from..from, granularity: Granularity::Letter, others });
            self.drag_to(at);
        }
        // A context menu is about the selection, or about the place that was clicked.
        if response.secondary_clicked() && !self.buffer.carets().list().iter().any(|s| s.range().contains(&at)) {
            self.assist.close_all();
            self.buffer.select(at, at);
            response.request_focus();
        }
        let grown = if response.triple_clicked() {
            Some(Granularity::Line)
        } else if response.double_clicked() {
            Some(Granularity::Word)
        } else {
            None
        };
        if let Some(granularity) = grown {
            let others = self.drag.take().map(|d| d.others).unwrap_or_default();
            self.drag = Some(Drag { from: self.unit_range(at, granularity), granularity, others });
            self.drag_to(at);
        } else if response.dragged_by(egui::PointerButton::Primary) && response.drag_delta() != egui::Vec2::ZERO {
            self.drag_to(at);
            self.moved_at = ui.input(|i| i.time);
            self.follow_caret = !ui.clip_rect().contains(pointer);
        }
        if modifiers.command
            && response.hovered()
            && (self.buffer.names_file(at) || help.is_some_and(|h| h.analysis.definition(h.source, at).is_some()))
        {
            ui.ctx().set_cursor_icon(egui::CursorIcon::PointingHand);
        }
        let pasted = ui.input(|i| {
            i.events.iter().find_map(|e| match e {
                egui::Event::MiddleClickPaste { pos, text } if response.rect.contains(*pos) => {
                    Some((*pos, text.clone()))
                }
                _ => None,
            })
        });
        if let Some((pos, text)) = pasted.filter(|_| response.hovered()) {
            let at = lines.position_at(&self.buffer, pos);
            self.buffer.select(at, at);
            // The text must not change while lines are shown.
            self.pasted = Some(text);
            response.request_focus();
            ui.ctx().request_repaint();
        }
    }

    /// Selects from the start of the drag to a place.
    fn drag_to(&mut self, at: usize) {
        let Some(Drag { from, granularity, others }) = &self.drag else { return };
        let to = self.unit_range(at, *granularity);
        let selection = match to.start < from.start {
            true => Selection::new(from.end, to.start),
            false => Selection::new(from.start, to.end),
        };
        let list: Vec<Selection> = others.iter().copied().chain([selection]).collect();
        let main = list.len() - 1;
        self.buffer.set_carets(Carets::new(list, main));
    }

    fn unit_range(&self, at: usize, granularity: Granularity) -> Range<usize> {
        match granularity {
            Granularity::Letter => at..at,
            Granularity::Word => self.buffer.word_at(at),
            Granularity::Line => self.buffer.whole_line(at),
        }
    }
}

/// A selection being dragged with the pointer.
#[derive(Clone, Debug)]
pub(super) struct Drag {
    /// The range where the drag started; whole words or lines at a time.
    pub from: Range<usize>,
    pub granularity: Granularity,
    /// Other selections, which are kept.
    pub others: Vec<Selection>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Granularity {
    Letter,
    Word,
    Line,
}
