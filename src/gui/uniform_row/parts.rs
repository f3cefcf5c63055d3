//! Shared parts of the rows: rectangles, and names of numbers.

use crate::project::CustomUniformType;
use egui::{Align, Layout, Rect, Ui, UiBuilder, pos2};

/// The height of a row.
pub(crate) const HEIGHT: f32 = 27.0;
const GAP: f32 = 8.0;

/// Returns a `Ui` for a part of the row, with its contents from the left and vertically centred.
pub(super) fn child(ui: &mut Ui, place: Rect) -> Ui {
    let layout = Layout::left_to_right(Align::Center);
    let mut child = ui.new_child(UiBuilder::new().max_rect(place).layout(layout).id_salt(place.left() as i32));
    child.set_clip_rect(ui.clip_rect().intersect(place.expand(4.0)));
    child.spacing_mut().item_spacing.x = 4.0;
    child
}

/// Cuts a width from the right end of a rectangle; returns that part and the rest.
pub(super) fn split_right(place: Rect, width: f32) -> (Rect, Rect) {
    let at = (place.right() - width).max(place.left());
    let rest = Rect::from_min_max(place.min, pos2((at - GAP).max(place.left()), place.bottom()));
    (Rect::from_min_max(pos2(at, place.top()), place.max), rest)
}

/// Returns the names of a value's numbers.
pub(super) fn components(ty: CustomUniformType) -> &'static [&'static str] {
    match ty {
        CustomUniformType::Bool | CustomUniformType::Int | CustomUniformType::Float => &[""],
        CustomUniformType::Vec2 => &["x", "y"],
        CustomUniformType::Vec3 => &["x", "y", "z"],
        CustomUniformType::Vec4 => &["x", "y", "z", "w"],
        CustomUniformType::Color3 => &["r", "g", "b"],
    }
}
