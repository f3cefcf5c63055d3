//! The one grid of the gallery: how many cards fit beside each other, and how wide a row of them is.

/// Between two of a row, and between rows.
pub(super) const GAP: f32 = 16.0;

/// Returns how many cards fit beside each other, and how wide each is.
pub(super) fn columns(room: f32) -> (f32, f32) {
    let columns = ((room + GAP) / (230.0 + GAP)).floor().clamp(1.0, 6.0);
    (columns, ((room - GAP * (columns - 1.0)) / columns).min(360.0).floor())
}

/// Returns the width of a whole row of cards, which everything in the gallery keeps to.
pub(super) fn width(room: f32) -> f32 {
    let (columns, width) = columns(room);
    columns * width + (columns - 1.0) * GAP
}
