//! The colours of the window, dark and light.

use crate::diag::Severity;
use egui::{Color32, Stroke};

/// A set of colours. Text of any of them is readable on the panel, the background and raised surfaces.
#[derive(Clone, Debug)]
pub(crate) struct Palette {
    pub is_dark: bool,
    /// The background of text fields.
    pub background: Color32,
    pub panel: Color32,
    /// Cards, popups, dialogs.
    pub raised: Color32,
    pub button: Color32,
    pub button_hovered: Color32,
    pub button_edge: Color32,
    pub line: Color32,
    /// Around the picture.
    pub surround: Color32,
    pub text: Color32,
    /// For text of low importance.
    pub weak: Color32,
    pub strong: Color32,
    pub accent: Color32,
    /// Fills primary buttons, parts of rails, and pressed widgets.
    pub accent_fill: Color32,
    /// The background of selected text: not blue, which marks primary buttons.
    pub chosen: Color32,
    pub error: Color32,
    pub warning: Color32,
    /// A search match.
    pub found: Color32,
    pub good: Color32,
    /// Colours drawn below code.
    pub code: CodeFills,
}

/// Colours drawn below code.
#[derive(Clone, Debug)]
pub(crate) struct CodeFills {
    pub selection: Color32,
    /// While something else has the keyboard focus.
    pub selection_idle: Color32,
    pub caret_line: Color32,
    pub uses: Color32,
    pub found: Color32,
    pub bracket: Color32,
    /// Line numbers.
    pub numbers: Color32,
    /// Below each row, if nothing else is.
    pub row: Color32,
}

impl Palette {
    /// Returns whether the picture is visible through it.
    pub(crate) fn is_over_picture(&self) -> bool {
        self.background == Color32::TRANSPARENT
    }

    /// Returns the stroke of the focus frame.
    pub(crate) fn focus(&self) -> Stroke {
        Stroke::new(1.5, self.accent)
    }

    pub(crate) fn of_severity(&self, severity: Severity) -> Color32 {
        match severity {
            Severity::Error => self.error,
            Severity::Warning => self.warning,
            Severity::Note => self.accent,
        }
    }
}

const fn rgb(r: u8, g: u8, b: u8) -> Color32 {
    Color32::from_rgb(r, g, b)
}

/// Muted, so that the picture gets the attention.
pub(crate) const DARK: Palette = Palette {
    is_dark: true,
    background: rgb(24, 26, 31),
    panel: rgb(31, 34, 40),
    raised: rgb(40, 44, 52),
    button: rgb(50, 55, 65),
    button_hovered: rgb(64, 70, 83),
    button_edge: rgb(92, 100, 117),
    line: rgb(53, 58, 68),
    surround: rgb(15, 16, 19),
    text: rgb(214, 219, 228),
    weak: rgb(166, 174, 188),
    strong: rgb(244, 246, 250),
    accent: rgb(92, 168, 255),
    accent_fill: rgb(36, 82, 138),
    chosen: rgb(78, 86, 104),
    error: rgb(255, 120, 117),
    warning: rgb(240, 190, 100),
    found: rgb(196, 160, 60),
    good: rgb(126, 201, 140),
    code: CodeFills {
        selection: rgb(44, 84, 136),
        selection_idle: rgb(50, 68, 96),
        caret_line: Color32::from_rgba_premultiplied(8, 8, 8, 8),
        uses: rgb(52, 60, 74),
        found: rgb(74, 63, 28),
        bracket: Color32::from_rgba_premultiplied(14, 14, 14, 14),
        numbers: rgb(134, 142, 157),
        row: Color32::TRANSPARENT,
    },
};

/// Returns a colour with this alpha, from 0 to 255.
const fn part(r: u8, g: u8, b: u8, alpha: u8) -> Color32 {
    const fn of(x: u8, alpha: u8) -> u8 {
        (x as u16 * alpha as u16 / 255) as u8
    }
    Color32::from_rgba_premultiplied(of(r, alpha), of(g, alpha), of(b, alpha), alpha)
}

/// Dark and translucent. Below text it is dense enough for any picture.
pub(super) const DARK_OVER_PICTURE: Palette = Palette {
    background: Color32::TRANSPARENT,
    panel: part(14, 16, 20, 205),
    raised: part(30, 33, 39, 235),
    line: part(120, 128, 144, 90),
    text: rgb(232, 236, 243),
    weak: rgb(186, 193, 206),
    code: CodeFills {
        selection: part(52, 110, 190, 190),
        selection_idle: part(60, 84, 120, 170),
        numbers: rgb(176, 184, 198),
        row: part(10, 12, 15, 200),
        ..DARK.code
    },
    ..DARK
};

pub(crate) const LIGHT: Palette = Palette {
    is_dark: false,
    background: rgb(255, 255, 255),
    panel: rgb(242, 243, 246),
    raised: rgb(252, 252, 254),
    button: rgb(226, 229, 235),
    button_hovered: rgb(213, 218, 227),
    button_edge: rgb(172, 180, 193),
    line: rgb(211, 215, 222),
    surround: rgb(221, 224, 229),
    text: rgb(40, 45, 56),
    weak: rgb(82, 90, 105),
    strong: rgb(14, 17, 23),
    accent: rgb(14, 84, 184),
    accent_fill: rgb(190, 216, 250),
    chosen: rgb(196, 203, 216),
    error: rgb(186, 26, 38),
    warning: rgb(146, 86, 0),
    found: rgb(196, 150, 20),
    good: rgb(26, 118, 56),
    code: CodeFills {
        selection: rgb(173, 205, 247),
        selection_idle: rgb(214, 224, 238),
        caret_line: Color32::from_rgba_premultiplied(0, 0, 0, 9),
        uses: rgb(225, 231, 240),
        found: rgb(255, 228, 150),
        bracket: Color32::from_rgba_premultiplied(0, 0, 0, 16),
        numbers: rgb(100, 108, 122),
        row: Color32::TRANSPARENT,
    },
};

/// The same in light.
pub(super) const LIGHT_OVER_PICTURE: Palette = Palette {
    background: Color32::TRANSPARENT,
    panel: part(246, 247, 250, 226),
    raised: part(252, 252, 254, 240),
    line: part(120, 128, 144, 120),
    text: rgb(24, 28, 36),
    weak: rgb(66, 73, 87),
    code: CodeFills {
        selection: part(150, 192, 248, 220),
        selection_idle: part(200, 214, 234, 200),
        numbers: rgb(92, 100, 114),
        row: part(252, 252, 254, 226),
        ..LIGHT.code
    },
    ..LIGHT
};

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the contrast ratio of WCAG 2.2.
    fn contrast(a: Color32, b: Color32) -> f32 {
        let luminance = |c: Color32| {
            let [r, g, b] = [c.r(), c.g(), c.b()].map(|v| {
                let v = f32::from(v) / 255.0;
                if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
            });
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
        a.max(b) / a.min(b)
    }

    /// Blends a colour over a background.
    fn over(color: Color32, ground: u8) -> Color32 {
        let seen = |c: u8| c + (u16::from(ground) * u16::from(255 - color.a()) / 255) as u8;
        Color32::from_rgb(seen(color.r()), seen(color.g()), seen(color.b()))
    }

    #[test]
    fn code_is_readable_over_the_worst_picture() {
        for (p, picture) in [(DARK_OVER_PICTURE, 255), (LIGHT_OVER_PICTURE, 0)] {
            for ground in [p.code.row, p.panel].map(|color| over(color, picture)) {
                for text in [p.text, p.strong, p.weak] {
                    assert!(contrast(text, ground) >= 4.5, "{text:?} on {ground:?}: {}", contrast(text, ground));
                }
            }
        }
    }

    #[test]
    fn every_text_is_readable_on_every_background() {
        assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 0.01);
        for p in [DARK, LIGHT] {
            for ground in [p.background, p.panel, p.raised] {
                for text in [p.text, p.weak, p.strong, p.accent, p.error, p.warning, p.good] {
                    assert!(contrast(text, ground) >= 4.5, "{text:?} on {ground:?}: {}", contrast(text, ground));
                }
            }
            for ground in
                [p.button, p.button_hovered, p.accent_fill, p.chosen, p.code.selection, p.code.found, p.code.uses]
            {
                assert!(contrast(p.strong, ground) >= 4.5, "{ground:?}: {}", contrast(p.strong, ground));
            }
        }
    }
}
