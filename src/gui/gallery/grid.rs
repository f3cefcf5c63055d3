//! The gallery's grid: the number of cards in a row, and their width.

/// The gap between cards of a row, and between rows.
pub(super) const GAP: f32 = 16.0;

/// Returns the number of cards in a row, and the width of each.
pub(super) fn columns(room: f32) -> (f32, f32) {
    let columns = ((room + GAP) / (230.0 + GAP)).floor().clamp(1.0, 6.0);
    (columns, ((room - GAP * (columns - 1.0)) / columns).min(360.0).floor())
}

/// Returns the width of a whole row of cards, with which everything in the gallery is aligned.
pub(super) fn width(room: f32) -> f32 {
    let (columns, width) = columns(room);
    columns * width + (columns - 1.0) * GAP
}
