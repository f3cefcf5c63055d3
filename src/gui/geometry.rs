//! The place of the picture in the viewport, and the pixel of it below the pointer, all in physical pixels.

/// An area of the window: left, top, width, height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub x: f32,
    pub y: f32,
    pub width: f32,
    pub height: f32,
}

/// A canvas that is fitted into an area with its aspect ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Letterbox {
    /// The area that the picture covers; it starts on a whole pixel.
    pub picture: Area,
    pub canvas: (u32, u32),
    /// Window pixels per canvas pixel.
    pub zoom: f32,
}

impl Letterbox {
    /// Returns the largest picture that fits: at 1:1 if the canvas has exactly the area's size, at a whole multiple if
    /// that loses less than a tenth of the size (so that pixels stay square and equal), else as large as the area
    /// allows.
    pub(super) fn new(area: Area, canvas: (u32, u32)) -> Letterbox {
        let (width, height) = (canvas.0.max(1) as f32, canvas.1.max(1) as f32);
        let fit = (area.width / width).min(area.height / height).max(0.0);
        let whole = fit.floor();
        let zoom = if whole >= 1.0 && whole / fit > 0.9 { whole } else { fit };
        let size = (width * zoom, height * zoom);
        let picture = Area {
            x: (area.x + (area.width - size.0) / 2.0).round(),
            y: (area.y + (area.height - size.1) / 2.0).round(),
            width: size.0,
            height: size.1,
        };
        Letterbox { picture, canvas, zoom }
    }

    /// Returns whether texels are shown unfiltered. At a fractional zoom some would be wider than others, so they are
    /// blended.
    pub(super) fn shows_whole_texels(&self) -> bool {
        self.zoom >= 1.0 && (self.zoom - self.zoom.round()).abs() < 1e-3
    }

    /// Converts to canvas pixels from the bottom left, not rounded; the result may be outside during a drag.
    pub(super) fn canvas_from_window(&self, x: f32, y: f32) -> (f32, f32) {
        if self.zoom <= 0.0 {
            return (0.0, 0.0);
        }
        ((x - self.picture.x) / self.zoom, self.canvas.1 as f32 - (y - self.picture.y) / self.zoom)
    }

    pub(super) fn contains(&self, x: f32, y: f32) -> bool {
        let p = self.picture;
        x >= p.x && y >= p.y && x < p.x + p.width && y < p.y + p.height
    }
}

/// The aspect ratio of a picture that follows the view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Shape {
    /// 16:9, for which pictures on Shadertoy are composed.
    #[default]
    Site,
    /// The aspect ratio of the view.
    Fill,
}

impl Shape {
    /// Returns the largest size of this aspect ratio in whole pixels.
    pub(super) fn within(self, width: u32, height: u32) -> (u32, u32) {
        match self {
            Shape::Fill => (width, height),
            Shape::Site => (width.min(height * 16 / 9), height.min((width * 9).div_ceil(16))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: Area = Area { x: 10.0, y: 20.0, width: 640.0, height: 360.0 };

    #[test]
    fn a_canvas_of_equal_size_is_shown_at_1_to_1() {
        let l = Letterbox::new(AREA, (640, 360));
        assert_eq!((l.picture, l.zoom), (AREA, 1.0));
        assert!(l.shows_whole_texels());
        // Shadertoy: x = floor(px), y = floor(height - py).
        assert_eq!(l.canvas_from_window(10.0, 20.0), (0.0, 360.0));
        assert_eq!(l.canvas_from_window(50.0, 379.0), (40.0, 1.0));
    }

    #[test]
    fn letterbox_bars_fill_the_difference_in_aspect_ratio() {
        let l = Letterbox::new(AREA, (100, 100));
        assert_eq!(l.zoom, 3.6);
        assert_eq!(l.picture, Area { x: 150.0, y: 20.0, width: 360.0, height: 360.0 });
        assert!(!l.shows_whole_texels() && !l.contains(149.0, 30.0) && l.contains(150.0, 20.0));
        let (x, y) = l.canvas_from_window(330.0, 200.0);
        assert!((x - 50.0).abs() < 1e-4 && (y - 50.0).abs() < 1e-4);
    }

    #[test]
    fn nearby_whole_zooms_are_preferred() {
        let l = Letterbox::new(AREA, (315, 175));
        assert_eq!(l.zoom, 2.0);
        assert_eq!((l.picture.x, l.picture.y), (15.0, 25.0));
        assert!(l.shows_whole_texels());
    }

    #[test]
    fn empty_areas_and_canvases_do_not_panic() {
        let none = Area { width: 0.0, height: 0.0, ..AREA };
        assert_eq!(Letterbox::new(none, (640, 360)).canvas_from_window(5.0, 5.0), (0.0, 0.0));
        assert!(Letterbox::new(AREA, (0, 0)).zoom.is_finite());
    }

    #[test]
    fn the_16_to_9_shape_fits_any_view() {
        assert_eq!(Shape::Site.within(640, 999), (640, 360));
        assert_eq!(Shape::Site.within(9999, 360), (640, 360));
        assert_eq!(Shape::Site.within(634, 680), (634, 357));
        assert_eq!(Shape::Site.within(1, 1), (1, 1));
        assert_eq!(Shape::Fill.within(634, 680), (634, 680));
    }
}
