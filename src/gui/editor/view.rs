//! The editor widget: scrolling, pointer, focus, input methods.

use super::{
    accessible,
    action::EditorAction,
    assist::{Assist, EditorRequest},
    brackets,
    buffer::Buffer,
    gutter::{Clicked, Gutter},
    highlight::Highlight,
    input, line_cost,
    lines::{Lines, MARGIN},
    look::{Help, Look},
    paint::{self, Painted},
    pointer::Drag,
    rows::Rows,
    ruler,
    semantic::Semantic,
};
use crate::gui::theme;
use egui::{
    Event, EventFilter, FontId, Id, Rect, Response, ScrollArea, Sense, Ui, emath::GuiRounding as _, pos2, vec2,
};
use std::ops::Range;

/// Returns the action of the code that a key triggers.
pub(super) type Keys<'a> = &'a dyn Fn(&Event) -> Option<EditorAction>;

/// The results of a frame.
#[derive(Clone, Debug)]
pub(crate) struct EditorOutput {
    /// The area of the text without the gutter.
    pub text_rect: Rect,
    /// The part of it that takes the keyboard focus.
    pub focus_rect: Rect,
    /// Visible lines with a mark, counted from 0, and their places.
    pub marked: Vec<(usize, Rect)>,
    /// Requests that concern other texts.
    pub requests: Vec<EditorRequest>,
    /// Open popups and tooltips, and their places.
    pub placed: Vec<(String, Rect)>,
    /// The line, from 0, whose number was clicked.
    pub clicked_line: Option<usize>,
    /// The byte under the pointer while Ctrl and Alt are held.
    pub pointed: Option<usize>,
    /// The widget that takes the keyboard focus.
    pub response: Option<Response>,
    pub caret: Rect,
}

/// A text being edited, with all state that outlives a frame.
#[derive(Debug)]
pub(crate) struct CodeEditor {
    pub(super) buffer: Buffer,
    pub(super) highlight: Highlight,
    pub(super) assist: Assist,
    /// The text that an input method is composing.
    preedit: String,
    pub(super) follow_caret: bool,
    take_focus: bool,
    /// The time at which the caret last moved, in seconds; its blinking restarts there.
    pub(super) moved_at: f64,
    pub(super) drag: Option<Drag>,
    pub(super) page: usize,
    pub(super) rows: Rows,
    /// The revision of the text to which `rows` belongs.
    rows_of: Option<u64>,
    /// The brackets at the caret, with the revision and the caret for which they were found.
    brackets: Option<[usize; 2]>,
    brackets_of: Option<(u64, usize)>,
    /// Text to paste in the next frame.
    pub(super) pasted: Option<String>,
    /// Text for the clipboard.
    copied: Option<String>,
    /// The revision of the text that was last returned by `take_changed`.
    reported_revision: u64,
    pub(super) work: Work,
    /// The height of the text in the previous frame, and whether the caret was visible.
    sight: (f32, bool),
    /// A line, from 0, to scroll into view.
    sought_line: Option<usize>,
}

/// The bytes that the newest frame processed: bytes and not time, so that a test can bound them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Work {
    /// Bytes scanned to update lines, pieces and comments.
    pub scanned: usize,
    /// Bytes laid out for painting.
    pub laid_out: usize,
}

impl CodeEditor {
    pub(crate) fn new(text: &str) -> Self {
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
            rows: Rows::default(),
            rows_of: None,
            brackets: None,
            brackets_of: None,
            pasted: None,
            copied: None,
            reported_revision: 0,
            work: Work::default(),
            sight: (0.0, false),
            sought_line: None,
        }
    }

    pub(crate) fn buffer(&self) -> &Buffer {
        &self.buffer
    }

    /// Changes the text or its selections.
    pub(crate) fn edit<R>(&mut self, change: impl FnOnce(&mut Buffer) -> R) -> R {
        change(&mut self.buffer)
    }

    /// Takes over a text that was changed outside the editor.
    pub(crate) fn take_text(&mut self, text: &str) {
        self.buffer.set_text(text);
        self.reported_revision = self.buffer.revision();
    }

    /// Returns the text if it has changed since the last call.
    pub(crate) fn take_changed(&mut self) -> Option<&str> {
        let revision = self.buffer.revision();
        (std::mem::replace(&mut self.reported_revision, revision) != revision).then(|| self.buffer.text())
    }

    /// Applies an action of a key or the palette.
    pub(crate) fn act(&mut self, action: EditorAction) {
        match action {
            EditorAction::Propose => self.assist.propose(),
            EditorAction::Signature => self.assist.show_signature(),
            EditorAction::Definition => self.assist.go_to_definition(),
            EditorAction::Uses => self.assist.list_uses(),
            EditorAction::QuickFix => self.assist.requests.push(EditorRequest::Fix(self.buffer.selection().head)),
            EditorAction::Rename => self.assist.requests.push(EditorRequest::Rename(self.buffer.selection().head)),
            EditorAction::Paste => self.assist.requests.push(EditorRequest::Paste),
            EditorAction::Copy => self.copied = Some(self.buffer.copied_text()),
            EditorAction::Cut => {
                self.copied = Some(self.buffer.copied_text());
                self.buffer.cut();
                self.follow_caret = true;
            }
            EditorAction::OtherBracket => {
                let caret = self.buffer.selection().head;
                if let Some([open, close]) = brackets::pair_at(&self.highlight, &self.buffer, caret) {
                    let to = if caret == close { open } else { close };
                    self.buffer.select(to, to);
                }
                self.follow_caret = true;
            }
            action => self.follow_caret |= self.act_on_rows(action) || input::act(&mut self.buffer, action),
        }
    }

    /// Pastes in the next frame.
    pub(crate) fn paste(&mut self, text: String) {
        self.pasted = Some(text);
    }

    /// Scrolls the caret into view in the next frame.
    pub(crate) fn reveal(&mut self) {
        self.follow_caret = true;
    }

    /// Scrolls a line, from 0, into view in the next frame without moving the caret.
    pub(crate) fn reveal_line(&mut self, line: usize) {
        self.sought_line = Some(line);
    }

    /// Takes the keyboard focus in the next frame.
    pub(crate) fn focus(&mut self) {
        self.take_focus = true;
    }

    /// Puts the caret at a line and column, both from 0.
    pub(crate) fn go_to(&mut self, line: usize, column: usize) {
        let at = self.buffer.position(line, column);
        self.buffer.select(at, at);
        self.reveal();
        self.focus();
    }

    /// Selects bytes of the text, scrolls them into view and takes the keyboard focus.
    pub(crate) fn show_range(&mut self, range: Range<usize>) {
        self.buffer.select(range.start, range.end);
        self.assist.close_all();
        self.reveal();
        self.focus();
    }

    /// Fills the available space. `id` is the widget's own, the same in every frame.
    pub(crate) fn show(&mut self, ui: &mut Ui, id: Id, look: Look<'_>, keys: Keys<'_>) -> EditorOutput {
        let font = FontId::monospace(look.font_size);
        let (row_height, glyph) = ui.fonts_mut(|f| (f.row_height(&font), f.glyph_width(&font, '0')));
        let row_height = (row_height * 1.12).round_to_pixels(ui.pixels_per_point());
        let has_focus = ui.memory(|m| m.has_focus(id));
        self.work.scanned = 0;
        self.assist.take_chosen(&mut self.buffer);
        if let Some(text) = self.pasted.take() {
            self.buffer.paste(&text);
        }
        if let Some(text) = self.copied.take().filter(|text| !text.is_empty()) {
            ui.ctx().copy_text(text);
        }
        if has_focus {
            self.take_keys(ui, id, &look, keys);
        } else {
            self.assist.close_all();
        }
        let help = self.fresh(look.help);
        self.assist.update(&self.buffer, help);
        self.sync(ui, &look);
        self.reveal_carets();

        let whole = ui.available_rect_before_wrap();
        let digits = self.buffer.line_count().to_string().len().max(3);
        let gutter = (digits as f32 * glyph + line_cost::beside(look.costs)).round();
        let text_rect = Rect::from_min_max(pos2((whole.left() + gutter).min(whole.right()), whole.top()), whole.max);
        // A bar that opens below the text must not cover the caret's line.
        let (height, was_seen) = self.sight;
        self.follow_caret |= was_seen && text_rect.height() < height;
        self.page = ((text_rect.height() / row_height) as usize).saturating_sub(2).max(1);
        ui.painter().rect_filled(whole, 0.0, theme::of(ui).background);

        let mut text_ui = ui.new_child(egui::UiBuilder::new().max_rect(text_rect).id_salt(id));
        text_ui.spacing_mut().scroll.fade.strength = 0.0;
        text_ui.set_clip_rect(text_rect.intersect(ui.clip_rect()));
        // Leave room for the scroll bar in addition to the margins.
        let wrap = look.wraps.then(|| ((text_rect.width() - 2.0 * MARGIN - 16.0) / glyph).max(8.0));
        if self.highlight.set_wrap(&self.buffer, wrap) {
            self.rows.update(&self.buffer, &self.highlight, None);
        }
        let columns = if wrap.is_some() { 0.0 } else { self.highlight.columns() + 4.0 };
        let row_count = self.rows.len(&self.buffer);
        let size = vec2(columns * glyph + 12.0, row_count as f32 * row_height);
        let (mut painted, mut pointed, mut widget) = (None, None, None);
        // Taken out, because the lines shown borrow it while the editor is changed.
        let index = std::mem::take(&mut self.highlight);
        let folding = std::mem::take(&mut self.rows);
        let scrolled = ScrollArea::both().id_salt(id).auto_shrink(false).content_margin(0).show_viewport(
            &mut text_ui,
            |ui, viewport| {
                // Half a page of blank space lets the last line scroll to the middle.
                let below = (viewport.height() * 0.5).max(0.0);
                let size = vec2(size.x.max(viewport.width()), (size.y + below).max(viewport.height()));
                let origin = ui.max_rect().min;
                let rect = Rect::from_min_size(origin, size);
                ui.allocate_rect(rect, Sense::hover());
                let shown = viewport.translate(origin.to_vec2());
                let response = ui.interact(shown, id, Sense::click_and_drag());
                let first = (viewport.top() / row_height).max(0.0) as usize;
                let last = ((viewport.bottom() / row_height).ceil() as usize).min(row_count);
                let mut lines = Lines {
                    index: &index,
                    folding: &folding,
                    origin,
                    row_height,
                    glyph,
                    font: font.clone(),
                    palette: theme::of(ui),
                    first,
                    rows: Vec::new(),
                };
                let semantic = look.help.map(|help| Semantic::new(help, self.buffer.text()));
                let range = first..last.max(first);
                lines.lay_out(ui, &self.buffer, semantic.as_ref(), &self.preedit, range, shown);
                self.work.laid_out = lines.rows.iter().flat_map(|r| &r.runs).map(|r| r.galley.text().len()).sum();
                accessible::tell(ui, &response, &lines, &self.buffer, look.name);
                self.pointer(ui, &response, &lines, help);
                let is_asked = ui.input(|i| i.modifiers.command && i.modifiers.alt);
                let pointer = response.hover_pos().filter(|_| is_asked);
                pointed = pointer.map(|at| lines.position_at(&self.buffer, at));
                self.find_brackets(&index);
                if std::mem::take(&mut self.take_focus) {
                    response.request_focus();
                }
                // The pointer may have moved the caret; paint it where it is now.
                let caret_shown = has_focus && self.caret_is_lit(ui);
                let uses = if has_focus { self.assist.uses() } else { &[] };
                let brackets = if has_focus { self.brackets } else { None };
                let caret = paint::Caret { has_focus, is_lit: caret_shown, uses, brackets };
                let mut p = paint::text(ui, &lines, &self.buffer, &look, caret, shown);
                self.assist.show(ui, &lines, &self.buffer, shown);
                let hangs = self.assist.show_hover(ui, &lines, &self.buffer, help, shown);
                if hangs || self.assist.is_open() {
                    // Both would be placed at the same line.
                    p.popup = None;
                }
                if std::mem::take(&mut self.follow_caret) {
                    let caret = lines.caret_rect(&self.buffer);
                    ui.scroll_to_rect_animation(
                        caret.expand2(vec2(glyph * 2.0, row_height)),
                        None,
                        egui::style::ScrollAnimation::none(),
                    );
                    // Lines just scrolled into view are laid out in the next frame.
                    ui.ctx().request_repaint();
                }
                if let Some(line) = self.sought_line.take() {
                    let row = folding.of_line(line.min(self.buffer.line_count().saturating_sub(1)));
                    let place = Rect::from_min_size(pos2(shown.left(), lines.top(row)), vec2(1.0, row_height));
                    // Include some of the surrounding text.
                    let around = place.expand2(vec2(0.0, 3.0 * row_height));
                    if !shown.y_range().contains(place.top()) || !shown.y_range().contains(place.bottom()) {
                        ui.scroll_to_rect_animation(around, None, egui::style::ScrollAnimation::none());
                        ui.ctx().request_repaint();
                    }
                }
                if has_focus {
                    self.update_input_method(ui, id, text_rect, p.caret);
                }
                let response = match ui.input(|i| i.modifiers.command) {
                    true => response,
                    false => response.on_hover_cursor(egui::CursorIcon::Text),
                };
                painted = Some(p);
                widget = Some(response);
            },
        );
        self.highlight = index;
        self.rows = folding;
        let painted: Painted = painted.unwrap_or_default();
        let is_seen = painted.caret.is_positive() && text_rect.y_range().contains(painted.caret.center().y);
        self.sight = (text_rect.height(), is_seen);
        let rect = Rect::from_min_max(whole.min, pos2(text_rect.left(), whole.bottom()));
        let top = text_rect.top() - scrolled.state.clamped_offset().y;
        let gutter = Gutter { rect, top, row_height, index: &self.highlight, rows: &self.rows };
        let gutter_clicked = gutter.show(ui, id, &self.buffer, &look);
        if let Some(Clicked::Fold(line)) = gutter_clicked {
            self.toggle_fold(line);
            ui.ctx().request_repaint();
        }
        let clicked_line = gutter_clicked.and_then(|clicked| match clicked {
            Clicked::Line(line) => Some(line),
            Clicked::Fold(_) => None,
        });
        ruler::show(ui, text_rect, &self.buffer, &self.rows, &look, has_focus);
        if let Some(popup) = painted.popup {
            paint::popup(ui, text_rect, &popup);
        }
        let is_over_picture = theme::of(ui).background == egui::Color32::TRANSPARENT;
        if has_focus && !is_over_picture {
            let ring = whole.shrink(0.75);
            ui.painter().rect_stroke(ring, 0.0, theme::of(ui).focus(), egui::StrokeKind::Middle);
        }
        ui.allocate_rect(whole, Sense::hover());
        EditorOutput {
            text_rect,
            focus_rect: painted.whole,
            marked: painted.marked,
            requests: std::mem::take(&mut self.assist.requests),
            placed: std::mem::take(&mut self.assist.placed),
            clicked_line,
            pointed,
            caret: painted.caret,
            response: widget,
        }
    }

    /// Returns the help if it is of the current text.
    fn fresh<'a>(&self, help: Option<Help<'a>>) -> Option<Help<'a>> {
        help.filter(|help| help.text == self.buffer.text())
    }

    fn take_keys(&mut self, ui: &Ui, id: Id, look: &Look<'_>, keys: Keys<'_>) {
        let filter = EventFilter { tab: true, horizontal_arrows: true, vertical_arrows: true, escape: true };
        ui.memory_mut(|m| m.set_focus_lock_filter(id, filter));
        let events = ui.input(|i| i.filtered_events(&filter));
        let moved_at = ui.input(|i| i.time);
        for event in &events {
            let before = self.buffer.revision();
            if self.assist.take(event, &mut self.buffer) {
                self.follow_caret |= self.buffer.revision() != before;
                continue;
            }
            if let Some(action) = keys(event) {
                // Comments and brackets must be looked up in the current text.
                self.sync(ui, look);
                self.act(action);
                if action.is_help() {
                    continue;
                }
            } else {
                if matches!(event, Event::Text(_)) {
                    self.sync(ui, look);
                }
                let Self { buffer, preedit, highlight, .. } = self;
                let handled = input::handle(buffer, preedit, event, &|b, at| highlight.is_comment(b, at));
                if let Some(text) = handled.copied.filter(|t| !t.is_empty()) {
                    ui.ctx().copy_text(text);
                }
                self.follow_caret |= handled.follow_caret;
            }
            self.assist.after(event, &self.buffer);
            if self.follow_caret {
                self.moved_at = moved_at;
            }
        }
    }

    /// Updates the index of the text.
    fn sync(&mut self, ui: &Ui, look: &Look<'_>) {
        let font = FontId::monospace(look.font_size);
        let Self { buffer, highlight, .. } = self;
        let revision = buffer.revision();
        self.work.scanned += ui.fonts_mut(|f| {
            let glyph = f.glyph_width(&font, '0');
            highlight.update(buffer, look.shared, &mut |c: char| f.glyph_width(&font, c) / glyph)
        });
        if self.rows_of != Some(revision) {
            self.rows_of = Some(revision);
            let replaced = self.highlight.take_replaced();
            self.rows.update(&self.buffer, &self.highlight, replaced);
        }
    }

    /// Finds the brackets at the caret if it or the text has changed.
    fn find_brackets(&mut self, index: &Highlight) {
        let now = (self.buffer.revision(), self.buffer.selection().head);
        if self.brackets_of != Some(now) {
            self.brackets_of = Some(now);
            let is_caret = self.buffer.selection().is_empty();
            self.brackets = is_caret.then(|| brackets::pair_at(index, &self.buffer, now.1)).flatten();
        }
    }

    /// Returns whether the caret is lit. It blinks for a while after the last move and then stays lit, so that an idle
    /// window need not be painted.
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

    fn update_input_method(&self, ui: &Ui, id: Id, rect: Rect, caret: Rect) {
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
