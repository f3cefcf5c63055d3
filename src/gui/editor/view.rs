//! The widget: scrolling, pointer, focus, input methods.

use super::{
    assist::{Ask, Assist},
    buffer::Buffer,
    highlight::Highlight,
    input,
    lines::Lines,
    look::{Help, Look},
    paint::{self, Painted},
    semantic::Semantic,
};
use egui::{EventFilter, FontId, Id, Rect, ScrollArea, Sense, Ui, emath::GuiRounding as _, pos2, vec2};
use std::ops::Range;

/// The results of a frame.
#[derive(Clone, Debug)]
pub struct EditorOutput {
    pub changed: bool,
    /// The area of the text without the numbers beside it.
    pub text_rect: Rect,
    /// Lines with a mark that are in sight, counted from 0, and where they are.
    pub marked: Vec<(usize, Rect)>,
    /// The author's requests that concern other texts.
    pub asks: Vec<Ask>,
    /// Popups and tips that are open, and where.
    pub placed: Vec<(String, Rect)>,
}

/// A text being edited, with all that outlives a frame.
#[derive(Debug)]
pub struct CodeEditor {
    pub buffer: Buffer,
    highlight: Highlight,
    assist: Assist,
    /// The text that an input method is composing.
    preedit: String,
    follow_caret: bool,
    take_focus: bool,
    /// When the caret last moved, in seconds: it blinks from there.
    moved_at: f64,
    /// The place where a drag began, whole words or lines at a time.
    drag: Option<(Range<usize>, Granularity)>,
    page: usize,
    pub(super) work: Work,
}

/// The bytes that the newest frame looked at: bytes, not time, so that a test can hold it to a bound.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work {
    /// To keep lines, pieces and comments in step with the text.
    pub scanned: usize,
    /// To be painted.
    pub laid_out: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Granularity {
    Letter,
    Word,
    Line,
}

impl CodeEditor {
    pub fn new(text: &str) -> Self {
        Self {
            buffer: Buffer::new(text),
            highlight: Highlight::default(),
            assist: Assist::default(),
            preedit: String::new(),
            follow_caret: false,
            take_focus: false,
            moved_at: 0.0,
            drag: None,
            page: 20,
            work: Work::default(),
        }
    }

    /// Brings the caret into sight in the next frame.
    pub fn reveal(&mut self) {
        self.follow_caret = true;
    }

    /// Takes the keyboard in the next frame.
    pub fn focus(&mut self) {
        self.take_focus = true;
    }

    /// Puts the caret at a line and column, both from 0.
    pub fn go_to(&mut self, line: usize, column: usize) {
        let at = self.buffer.position(line, column);
        self.buffer.select(at, at);
        self.reveal();
        self.focus();
    }

    /// Selects bytes of the text, in sight and ready to type.
    pub fn show_range(&mut self, range: Range<usize>) {
        self.buffer.select(range.start, range.end);
        self.assist.close_all();
        self.reveal();
        self.focus();
    }

    /// Fills the space there is. `id` is the widget's own, the same in every frame.
    pub fn show(&mut self, ui: &mut Ui, id: Id, look: Look<'_>) -> EditorOutput {
        let revision = self.buffer.revision();
        let font = FontId::monospace(look.font_size);
        let (row_height, glyph) = ui.fonts_mut(|f| (f.row_height(&font), f.glyph_width(&font, '0')));
        let row_height = (row_height * 1.12).round_to_pixels(ui.pixels_per_point());
        let has_focus = ui.memory(|m| m.has_focus(id));
        if has_focus {
            self.take_keys(ui, id);
        } else {
            self.assist.close_all();
        }
        let help = self.fresh(look.help);
        self.assist.update(&self.buffer, help);
        ui.fonts_mut(|f| {
            let mut width = |c: char| f.glyph_width(&font, c) / glyph;
            self.work.scanned = self.highlight.update(&mut self.buffer, look.shared, &mut width);
        });

        let whole = ui.available_rect_before_wrap();
        let digits = self.buffer.line_count().to_string().len().max(3);
        let gutter = (digits as f32 * glyph + 26.0).round();
        let text_rect = Rect::from_min_max(pos2((whole.left() + gutter).min(whole.right()), whole.top()), whole.max);
        self.page = ((text_rect.height() / row_height) as usize).saturating_sub(2).max(1);
        ui.painter().rect_filled(whole, 0.0, super::super::theme::BACKGROUND);

        let mut text_ui = ui.new_child(egui::UiBuilder::new().max_rect(text_rect).id_salt(id));
        text_ui.spacing_mut().scroll.fade.strength = 0.0;
        text_ui.set_clip_rect(text_rect.intersect(ui.clip_rect()));
        let size = vec2((self.highlight.columns() + 4.0) * glyph + 12.0, self.buffer.line_count() as f32 * row_height);
        let mut painted = None;
        // Lines in sight are shown by it while the editor goes on.
        let index = std::mem::take(&mut self.highlight);
        let scrolled = ScrollArea::both().id_salt(id).auto_shrink(false).content_margin(0).show_viewport(
            &mut text_ui,
            |ui, viewport| {
                // Half a page of nothing below lets the last line be read in the middle.
                let below = (viewport.height() * 0.5).max(0.0);
                let size = vec2(size.x.max(viewport.width()), (size.y + below).max(viewport.height()));
                let origin = ui.max_rect().min;
                let rect = Rect::from_min_size(origin, size);
                ui.allocate_rect(rect, Sense::hover());
                let shown = viewport.translate(origin.to_vec2());
                let response = ui.interact(shown, id, Sense::click_and_drag());
                let first = (viewport.top() / row_height).max(0.0) as usize;
                let last = ((viewport.bottom() / row_height).ceil() as usize).min(self.buffer.line_count());
                let mut lines =
                    Lines { index: &index, origin, row_height, glyph, font: font.clone(), first, rows: Vec::new() };
                let semantic = look.help.map(|help| Semantic::new(help, self.buffer.text()));
                let range = first..last.max(first);
                lines.lay_out(ui, &self.buffer, semantic.as_ref(), &self.preedit, range, shown);
                self.work.laid_out = lines.rows.iter().flat_map(|r| &r.runs).map(|r| r.galley.text().len()).sum();
                self.pointer(ui, &response, &lines, help);
                if std::mem::take(&mut self.take_focus) {
                    response.request_focus();
                }
                // The pointer may have moved the caret; what is painted must be where it is now.
                let caret_shown = has_focus && self.caret_is_lit(ui);
                let uses = if has_focus { self.assist.uses() } else { &[] };
                let caret = paint::Caret { has_focus, is_lit: caret_shown, uses };
                let mut p = paint::text(ui, &lines, &self.buffer, &look, caret, shown);
                self.assist.show(ui, &lines, &mut self.buffer, shown);
                let hangs = self.assist.show_hover(ui, &lines, &self.buffer, help, shown);
                if hangs || self.assist.is_open() {
                    // Both would hang from the same line.
                    p.popup = None;
                }
                if std::mem::take(&mut self.follow_caret) {
                    let caret = lines.caret_rect(&self.buffer);
                    ui.scroll_to_rect_animation(
                        caret.expand2(vec2(glyph * 2.0, row_height)),
                        None,
                        egui::style::ScrollAnimation::none(),
                    );
                    // Lines just scrolled to are laid out in the next frame.
                    ui.ctx().request_repaint();
                }
                if has_focus {
                    self.tell_input_method(ui, id, text_rect, p.caret);
                }
                if !ui.input(|i| i.modifiers.command) {
                    response.on_hover_cursor(egui::CursorIcon::Text);
                }
                painted = Some(p);
            },
        );
        self.highlight = index;
        let painted: Painted = painted.unwrap_or_default();
        let gutter_rect = Rect::from_min_max(whole.min, pos2(text_rect.left(), whole.bottom()));
        let top = text_rect.top() - scrolled.state.clamped_offset().y;
        paint::gutter(ui, gutter_rect, top, row_height, &self.buffer, &look);
        if let Some(popup) = painted.popup {
            paint::popup(ui, text_rect, &popup);
        }
        if has_focus {
            let ring = whole.shrink(0.75);
            ui.painter().rect_stroke(ring, 0.0, super::super::theme::FOCUS, egui::StrokeKind::Middle);
        }
        ui.allocate_rect(whole, Sense::hover());
        EditorOutput {
            changed: self.buffer.revision() != revision,
            text_rect,
            marked: painted.marked,
            asks: std::mem::take(&mut self.assist.asks),
            placed: std::mem::take(&mut self.assist.placed),
        }
    }

    /// Help that is of the text as it is.
    fn fresh<'a>(&self, help: Option<Help<'a>>) -> Option<Help<'a>> {
        help.filter(|help| help.text == self.buffer.text())
    }

    fn take_keys(&mut self, ui: &mut Ui, id: Id) {
        let filter = EventFilter { tab: true, horizontal_arrows: true, vertical_arrows: true, escape: true };
        ui.memory_mut(|m| m.set_focus_lock_filter(id, filter));
        let events = ui.input(|i| i.filtered_events(&filter));
        for event in &events {
            let before = self.buffer.revision();
            if self.assist.take(event, &mut self.buffer) {
                self.follow_caret |= self.buffer.revision() != before;
                continue;
            }
            let handled = input::handle(&mut self.buffer, &mut self.preedit, self.page, std::slice::from_ref(event));
            self.assist.after(event, &self.buffer);
            if let Some(text) = handled.copied.filter(|t| !t.is_empty()) {
                ui.ctx().copy_text(text);
            }
            if handled.follow_caret {
                self.follow_caret = true;
                self.moved_at = ui.input(|i| i.time);
            }
        }
    }

    fn pointer(&mut self, ui: &Ui, response: &egui::Response, lines: &Lines<'_>, help: Option<Help<'_>>) {
        let Some(pointer) = response.interact_pointer_pos().or_else(|| response.hover_pos()) else { return };
        let (pressed, shift, command) =
            ui.input(|i| (i.pointer.primary_pressed(), i.modifiers.shift, i.modifiers.command));
        let at = lines.position_at(&self.buffer, pointer);
        // A press and its release can come between two frames: then there is only the click.
        let clicked_between = response.clicked() && ui.input(|i| i.pointer.primary_pressed());
        if (pressed && response.is_pointer_button_down_on()) || clicked_between {
            response.request_focus();
            self.moved_at = ui.input(|i| i.time);
            self.assist.close_all();
            if command && !shift {
                self.drag = None;
                self.buffer.select(at, at);
                self.assist.go_to_definition();
                ui.ctx().request_repaint();
                return;
            }
            if shift {
                self.buffer.select(self.buffer.selection().anchor, at);
                self.drag = Some((self.buffer.selection().anchor..self.buffer.selection().anchor, Granularity::Letter));
            } else {
                self.buffer.select(at, at);
                self.drag = Some((at..at, Granularity::Letter));
            }
        }
        let grown = if response.triple_clicked() {
            Some(Granularity::Line)
        } else if response.double_clicked() {
            Some(Granularity::Word)
        } else {
            None
        };
        if let Some(granularity) = grown {
            let range = self.grain(at, granularity);
            self.buffer.select(range.start, range.end);
            self.drag = Some((range, granularity));
        } else if response.dragged_by(egui::PointerButton::Primary)
            && response.drag_delta() != egui::Vec2::ZERO
            && let Some((from, granularity)) = self.drag.clone()
        {
            let to = self.grain(at, granularity);
            if to.start < from.start {
                self.buffer.select(from.end, to.start);
            } else {
                self.buffer.select(from.start, to.end);
            }
            self.moved_at = ui.input(|i| i.time);
            self.follow_caret = !ui.clip_rect().contains(pointer);
        }
        if command && response.hovered() && help.is_some_and(|h| h.analysis.definition(h.source, at).is_some()) {
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
            self.buffer.paste(&text);
            response.request_focus();
        }
    }

    fn grain(&self, at: usize, granularity: Granularity) -> Range<usize> {
        match granularity {
            Granularity::Letter => at..at,
            Granularity::Word => self.buffer.word_at(at),
            Granularity::Line => {
                let line = self.buffer.line_of(at);
                let start = self.buffer.line_range(line).start;
                let last = line + 1 >= self.buffer.line_count();
                start..if last { self.buffer.text().len() } else { self.buffer.line_range(line + 1).start }
            }
        }
    }

    /// Blinks for a while after the last move and then stays, so that a still window need not be painted.
    fn caret_is_lit(&self, ui: &Ui) -> bool {
        const HALF: f64 = 0.53;
        const UNTIL: f64 = 10.0;
        if !ui.input(|i| i.focused) {
            return false;
        }
        let since = ui.input(|i| i.time) - self.moved_at;
        if !(0.0..UNTIL).contains(&since) {
            return true;
        }
        let phase = since / HALF;
        ui.ctx().request_repaint_after_secs((HALF * (1.0 - phase.fract())) as f32);
        (phase as u64).is_multiple_of(2)
    }

    fn tell_input_method(&self, ui: &Ui, id: Id, rect: Rect, caret: Rect) {
        if ui.memory(|m| m.owns_ime_events(id)) {
            ui.ctx().output_mut(|o| {
                o.mutable_text_under_cursor = true;
                o.ime = Some(egui::output::IMEOutput {
                    purpose: egui::IMEPurpose::Normal,
                    rect,
                    cursor_rect: caret,
                    should_interrupt_composition: false,
                });
            });
        }
    }
}
