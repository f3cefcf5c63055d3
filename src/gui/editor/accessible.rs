//! Exposes the visible text and the caret to assistive technology.

use super::{buffer::Buffer, lines::Lines};
use egui::{
    FontId, Response, Role, Ui, WidgetInfo,
    emath::TSTransform,
    text::{CCursor, LayoutJob},
    text_selection::{CCursorRange, accesskit_text},
};

/// Reports the visible rows and the caret in them to a screen reader. Costs nothing while none is connected.
pub(super) fn tell(ui: &Ui, response: &Response, lines: &Lines<'_>, buffer: &Buffer, name: &str) {
    response.widget_info(|| WidgetInfo::labeled(Role::MultilineTextInput, true, name));
    if !ui.ctx().has_accesskit_node(response.id) {
        return;
    }
    let selection = buffer.selection();
    let mut text = String::new();
    let mut letters = 0;
    // Offsets of the selection's two ends in the visible text, clamped to its ends.
    let (mut anchor, mut head) = (0, 0);
    for row in &lines.rows {
        let Some(bytes) = row.bytes() else { continue };
        let shown = &buffer.text()[bytes.clone()];
        for (end, at) in [(&mut anchor, selection.anchor), (&mut head, selection.head)] {
            if at >= bytes.start {
                *end = letters + buffer.text()[bytes.start..at.min(bytes.end)].chars().count();
            }
        }
        text.push_str(shown);
        text.push('\n');
        letters += shown.chars().count() + 1;
    }
    let font = FontId { size: lines.font.size, ..FontId::monospace(0.0) };
    let galley = ui.painter().layout_job(LayoutJob::simple(text, font, egui::Color32::TRANSPARENT, f32::INFINITY));
    let carets = CCursorRange::two(CCursor::new(anchor), CCursor::new(head));
    let place = TSTransform::from_translation(response.rect.min.to_vec2());
    accesskit_text::update_accesskit_for_text_widget(ui.ctx(), response.id, Some(carets), place, &galley);
}
