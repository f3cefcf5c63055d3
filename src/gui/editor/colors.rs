//! The colours of code.

use super::lexer::TokenKind;
use crate::gui::theme::Palette;
use egui::Color32;

/// Returns the colour of a kind of code, on the background of a theme.
pub(super) fn code_color(kind: TokenKind, palette: &Palette) -> Color32 {
    let [dark, light] = match kind {
        TokenKind::Plain => return palette.text,
        TokenKind::Comment if palette.is_over_picture() => return palette.weak,
        TokenKind::Keyword => [(201, 142, 226), (136, 38, 170)],
        TokenKind::Type => [(104, 194, 208), (0, 108, 124)],
        TokenKind::Builtin => [(106, 173, 245), (18, 88, 190)],
        TokenKind::Uniform => [(240, 152, 118), (168, 66, 12)],
        TokenKind::Macro => [(226, 196, 120), (128, 86, 0)],
        TokenKind::Function => [(220, 220, 170), (98, 88, 10)],
        TokenKind::Parameter => [(233, 186, 158), (140, 74, 36)],
        TokenKind::Global => [(156, 196, 240), (30, 84, 150)],
        TokenKind::Field => [(176, 208, 214), (38, 94, 106)],
        TokenKind::Inactive => [(98, 106, 121), (148, 154, 166)],
        TokenKind::Number => [(160, 205, 140), (36, 112, 30)],
        TokenKind::Comment => [(124, 134, 150), (104, 114, 126)],
        TokenKind::Directive => [(214, 140, 180), (158, 36, 100)],
        TokenKind::Operator => [(176, 184, 198), (78, 86, 100)],
    };
    let (r, g, b) = if palette.is_dark { dark } else { light };
    Color32::from_rgb(r, g, b)
}
