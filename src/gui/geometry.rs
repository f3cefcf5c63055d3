//! The place of the picture in the viewport, and the pixel of it that a pointer is over. All is in physical pixels.

/// An area of the window: left, top, width, height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub x: f32,
    pub y: f32,
    pub width: f32,
    pub height: f32,
}

/// A canvas shown inside an area without changing its shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Letterbox {
    /// The area that the picture covers; it starts on a whole pixel.
    pub picture: Area,
    pub canvas: (u32, u32),
    /// Window pixels to canvas pixels.
    pub zoom: f32,
}

impl Letterbox {
    /// The largest picture that fits: pixel for pixel where the canvas has just the area's size, a whole multiple where
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

    /// Returns whether texels should be shown as they are. Between two whole zooms some would be wider than others, so
    /// those blend.
    pub(super) fn shows_whole_texels(&self) -> bool {
        self.zoom >= 1.0 && (self.zoom - self.zoom.round()).abs() < 1e-3
    }

    /// Canvas pixels from the bottom left, not rounded; may lie outside while a drag does.
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

/// The shape of a picture that follows the view.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Shape {
    /// 16:9, which pictures on the site are composed for.
    #[default]
    Site,
    /// The view's own.
    Fill,
}

impl Shape {
    /// The largest size of this shape in whole pixels.
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
    fn a_canvas_of_the_areas_size_is_shown_pixel_for_pixel() {
        let l = Letterbox::new(AREA, (640, 360));
        assert_eq!((l.picture, l.zoom), (AREA, 1.0));
        assert!(l.shows_whole_texels());
        // The site: x = floor(px), y = floor(height - py).
        assert_eq!(l.canvas_from_window(10.0, 20.0), (0.0, 360.0));
        assert_eq!(l.canvas_from_window(50.0, 379.0), (40.0, 1.0));
    }

    #[test]
    fn bars_lie_where_the_shapes_differ() {
        let l = Letterbox::new(AREA, (100, 100));
        assert_eq!(l.zoom, 3.6);
        assert_eq!(l.picture, Area { x: 150.0, y: 20.0, width: 360.0, height: 360.0 });
        assert!(!l.shows_whole_texels() && !l.contains(149.0, 30.0) && l.contains(150.0, 20.0));
        let (x, y) = l.canvas_from_window(330.0, 200.0);
        assert!((x - 50.0).abs() < 1e-4 && (y - 50.0).abs() < 1e-4);
    }

    #[test]
    fn a_whole_zoom_is_taken_when_it_is_near() {
        let l = Letterbox::new(AREA, (315, 175));
        assert_eq!(l.zoom, 2.0);
        assert_eq!((l.picture.x, l.picture.y), (15.0, 25.0));
        assert!(l.shows_whole_texels());
    }

    #[test]
    fn an_area_or_canvas_of_nothing_is_no_trouble() {
        let none = Area { width: 0.0, height: 0.0, ..AREA };
        assert_eq!(Letterbox::new(none, (640, 360)).canvas_from_window(5.0, 5.0), (0.0, 0.0));
        assert!(Letterbox::new(AREA, (0, 0)).zoom.is_finite());
    }

    #[test]
    fn the_sites_shape_fits_whatever_there_is() {
        assert_eq!(Shape::Site.within(640, 999), (640, 360));
        assert_eq!(Shape::Site.within(9999, 360), (640, 360));
        assert_eq!(Shape::Site.within(634, 680), (634, 357));
        assert_eq!(Shape::Site.within(1, 1), (1, 1));
        assert_eq!(Shape::Fill.within(634, 680), (634, 680));
    }
}
