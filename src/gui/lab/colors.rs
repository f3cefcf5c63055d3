//! The colours of the plot, on a dark and on a light background.

use crate::{
    gui::theme::{self, Palette},
    lab::report::{COLOURS, Look},
};
use egui::{Color32, Ui};

pub(super) struct Ink {
    pub palette: &'static Palette,
    methods: [(u8, u8, u8); COLOURS],
    grey: (u8, u8, u8),
    frontier: (u8, u8, u8),
    grid: (u8, u8, u8),
}

/// Colours that are distinguishable with colour blindness (Okabe and Ito 2008), lightened, and further ones that
/// differ in brightness, in the order of the report.
const ON_DARK: Ink = Ink {
    palette: &theme::DARK,
    methods: [
        (70, 160, 235),
        (240, 120, 50),
        (30, 190, 140),
        (225, 140, 190),
        (135, 210, 250),
        (240, 180, 50),
        (190, 150, 110),
        (140, 140, 245),
        (230, 85, 115),
        (140, 195, 100),
        (215, 215, 215),
        (180, 145, 235),
    ],
    grey: (84, 90, 102),
    frontier: (128, 106, 44),
    grid: (92, 99, 114),
};

/// Those of the report.
const ON_LIGHT: Ink = Ink {
    palette: &theme::LIGHT,
    methods: [
        (0, 114, 178),
        (213, 94, 0),
        (0, 158, 115),
        (204, 121, 167),
        (86, 180, 233),
        (230, 159, 0),
        (120, 80, 40),
        (70, 70, 160),
        (150, 20, 60),
        (60, 120, 60),
        (40, 40, 40),
        (150, 110, 200),
    ],
    grey: (165, 168, 172),
    frontier: (255, 222, 132),
    grid: (150, 156, 168),
};

fn rgb((r, g, b): (u8, u8, u8)) -> Color32 {
    Color32::from_rgb(r, g, b)
}

impl Ink {
    pub(super) fn of(ui: &Ui) -> &'static Ink {
        if theme::of(ui).is_dark { &ON_DARK } else { &ON_LIGHT }
    }

    /// Returns the colour of the nth method.
    pub(super) fn method(&self, n: usize) -> Color32 {
        rgb(self.methods[n % COLOURS])
    }

    pub(super) fn frontier(&self) -> Color32 {
        rgb(self.frontier)
    }

    pub(super) fn grid(&self) -> Color32 {
        rgb(self.grid)
    }

    /// Returns the fill colour of a sign.
    pub(super) fn fill(&self, look: Look, color: Color32) -> Color32 {
        match look {
            Look::Full => color,
            Look::Grey => rgb(self.grey),
            Look::Hollow => self.palette.background,
        }
    }
}
