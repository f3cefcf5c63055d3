//! The visible part of a picture and its zoom: from all of it down to single texels.

use egui::{Pos2, Rect, Vec2, pos2, vec2};

/// The maximum size of a texel in points: it has room for four numbers of single precision.
pub(super) const OF_TEXELS: f32 = 256.0;
/// The maximum zoom of a graph, which is laid out in points.
pub(super) const OF_GRAPH: f32 = 1.25;

/// The zoom and position of a picture in an area. Texels count from the bottom left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Zoom {
    /// The maximum size of a texel in points.
    most: f32,
    /// The size of a texel in points; `None`: as large as the area allows.
    scale: Option<f32>,
    /// The texel in the middle of the area.
    center: Vec2,
}

/// A picture of a size in texels, placed on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PlacedPicture {
    pub area: Rect,
    pub size: (u32, u32),
    /// The size of a texel in points.
    pub scale: f32,
    center: Vec2,
}

impl Zoom {
    /// Shows the whole picture; a texel has at most this number of points.
    pub(super) fn up_to(most: f32) -> Self {
        Self { most, scale: None, center: Vec2::ZERO }
    }

    /// Returns whether the whole picture is visible.
    pub(super) fn fits(&self) -> bool {
        self.scale.is_none()
    }

    pub(super) fn fit(&mut self) {
        *self = Self::up_to(self.most);
    }

    /// Places a picture of this size in an area.
    pub(super) fn place(&self, area: Rect, size: (u32, u32)) -> PlacedPicture {
        let whole = vec2(size.0 as f32, size.1 as f32);
        let fitting = (area.width() / whole.x).min(area.height() / whole.y).clamp(1e-4, self.most);
        let Some(scale) = self.scale else { return PlacedPicture { area, size, scale: fitting, center: whole / 2.0 } };
        let scale = scale.clamp(fitting.min(1.0), self.most);
        // At least half of the view is covered by the picture.
        PlacedPicture { area, size, scale, center: self.center.clamp(Vec2::ZERO, whole) }
    }

    /// Zooms by a factor; the point of the picture at `at` stays there.
    pub(super) fn about(&mut self, placed: &PlacedPicture, at: Pos2, factor: f32) {
        let (fitting, held) = (Self::up_to(self.most).place(placed.area, placed.size).scale, placed.texel(at));
        let scale = (placed.scale * factor).clamp(fitting.min(1.0), self.most);
        if factor < 1.0 && scale <= fitting {
            return self.fit();
        }
        let offset = at - placed.area.center();
        *self =
            Self { scale: Some(scale), most: self.most, center: held.to_vec2() - vec2(offset.x, -offset.y) / scale };
    }

    /// Moves it by points of the screen.
    pub(super) fn drag(&mut self, placed: &PlacedPicture, by: Vec2) {
        let center = placed.center - vec2(by.x, -by.y) / placed.scale;
        let whole = vec2(placed.size.0 as f32, placed.size.1 as f32);
        *self = Self { scale: Some(placed.scale), most: self.most, center: center.clamp(Vec2::ZERO, whole) };
    }

    /// Centres a texel, magnified so that its numbers are legible.
    pub(super) fn show(&mut self, texel: (u32, u32), scale: f32) {
        *self = Self { scale: Some(scale), most: self.most, center: vec2(texel.0 as f32 + 0.5, texel.1 as f32 + 0.5) };
    }
}

impl PlacedPicture {
    /// Returns the position of a point of the picture on the screen.
    pub(super) fn point(&self, texel: Pos2) -> Pos2 {
        let offset = (texel.to_vec2() - self.center) * self.scale;
        self.area.center() + vec2(offset.x, -offset.y)
    }

    /// Returns the point of the picture at a position on the screen, in texels.
    pub(super) fn texel(&self, at: Pos2) -> Pos2 {
        let offset = (at - self.area.center()) / self.scale;
        (self.center + vec2(offset.x, -offset.y)).to_pos2()
    }

    /// Returns the texel at a position on the screen, if the picture is there.
    pub(super) fn texel_at(&self, at: Pos2) -> Option<(u32, u32)> {
        let place = self.texel(at);
        let is_inside = place.x >= 0.0 && place.y >= 0.0 && self.area.contains(at);
        let texel = (place.x as u32, place.y as u32);
        (is_inside && texel.0 < self.size.0 && texel.1 < self.size.1).then_some(texel)
    }

    /// Returns the texel in the middle.
    pub(super) fn middle(&self) -> (u32, u32) {
        let at = |center: f32, size: u32| (center as u32).min(size.saturating_sub(1));
        (at(self.center.x, self.size.0), at(self.center.y, self.size.1))
    }

    /// Returns the rectangle of a run of texels in a row on the screen, from the first column to before the second.
    pub(super) fn rect(&self, columns: (u32, u32), row: u32) -> Rect {
        let (left, right) = (columns.0 as f32, columns.1 as f32);
        Rect::from_two_pos(self.point(pos2(left, row as f32)), self.point(pos2(right, row as f32 + 1.0)))
    }

    /// Returns the visible texels: the first column and row, and those after the last.
    pub(super) fn seen(&self) -> [(u32, u32); 2] {
        let (a, b) = (self.texel(self.area.left_bottom()), self.texel(self.area.right_top()));
        let side =
            |low: f32, high: f32, size: u32| (low.floor().max(0.0) as u32, (high.ceil().max(0.0) as u32).min(size));
        let ((left, right), (bottom, top)) = (side(a.x, b.x, self.size.0), side(a.y, b.y, self.size.1));
        [(left.min(right), right), (bottom.min(top), top)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area() -> Rect {
        Rect::from_min_size(pos2(100.0, 50.0), vec2(400.0, 300.0))
    }

    #[test]
    fn zooming_keeps_the_texel_under_the_pointer() {
        let (mut zoom, at) = (Zoom::up_to(OF_TEXELS), pos2(137.0, 301.0));
        let first = zoom.place(area(), (640, 360));
        assert_eq!(first.scale, 400.0 / 640.0);
        assert_eq!(first.point(pos2(0.0, 0.0)).x, 100.0);
        let held = first.texel(at);
        for _ in 0..40 {
            let placed = zoom.place(area(), (640, 360));
            zoom.about(&placed, at, 1.2);
        }
        let near = zoom.place(area(), (640, 360));
        assert_eq!(near.scale, OF_TEXELS);
        assert!((near.texel(at) - held).length() < 1e-3, "{:?} {held:?}", near.texel(at));
        assert_eq!(near.texel_at(at), first.texel_at(at));
        assert!(
            near.rect((near.texel_at(at).unwrap().0, near.texel_at(at).unwrap().0 + 1), near.texel_at(at).unwrap().1)
                .contains(at)
        );
        let [(left, right), (bottom, top)] = near.seen();
        assert!(right - left <= 3 && top - bottom <= 3 && right > left && top > bottom);
        for _ in 0..80 {
            let placed = zoom.place(area(), (640, 360));
            zoom.about(&placed, at, 1.0 / 1.2);
        }
        assert!(zoom.fits(), "and back to all of it");
    }

    #[test]
    fn rows_count_from_the_bottom_and_drags_move_the_picture() {
        let mut zoom = Zoom::up_to(OF_TEXELS);
        zoom.show((3, 1), 40.0);
        let placed = zoom.place(area(), (8, 4));
        assert_eq!((placed.middle(), placed.texel_at(area().center())), ((3, 1), Some((3, 1))));
        assert_eq!(placed.texel_at(area().center() - vec2(0.0, 40.0)), Some((3, 2)), "up is up");
        let before = placed.point(pos2(3.0, 1.0));
        zoom.drag(&placed, vec2(7.0, -5.0));
        let after = zoom.place(area(), (8, 4)).point(pos2(3.0, 1.0));
        assert!((after - before - vec2(7.0, -5.0)).length() < 1e-3);
        zoom.drag(&zoom.place(area(), (8, 4)), vec2(9e4, 9e4));
        assert_eq!(zoom.place(area(), (8, 4)).middle(), (0, 3), "it cannot be lost");
    }

    #[test]
    fn a_picture_of_one_texel_can_be_placed() {
        let placed = Zoom::up_to(OF_TEXELS).place(area(), (1, 1));
        assert_eq!((placed.scale, placed.texel_at(area().center())), (OF_TEXELS, Some((0, 0))));
        assert_eq!((placed.texel_at(area().min), placed.seen()), (None, [(0, 1), (0, 1)]));
    }
}
