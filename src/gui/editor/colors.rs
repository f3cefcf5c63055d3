//! The colours of code.

use super::lexer::TokenKind;
use crate::gui::theme::TEXT;
use egui::Color32;

/// Colour of code.
pub(super) fn code_color(kind: TokenKind) -> Color32 {
    match kind {
        TokenKind::Plain => TEXT,
        TokenKind::Keyword => Color32::from_rgb(201, 142, 226),
        TokenKind::Type => Color32::from_rgb(104, 194, 208),
        TokenKind::Builtin => Color32::from_rgb(106, 173, 245),
        TokenKind::Uniform => Color32::from_rgb(240, 152, 118),
        TokenKind::Macro => Color32::from_rgb(226, 196, 120),
        TokenKind::Function => Color32::from_rgb(220, 220, 170),
        TokenKind::Parameter => Color32::from_rgb(233, 186, 158),
        TokenKind::Global => Color32::from_rgb(156, 196, 240),
        TokenKind::Field => Color32::from_rgb(176, 208, 214),
        TokenKind::Inactive => Color32::from_rgb(98, 106, 121),
        TokenKind::Number => Color32::from_rgb(160, 205, 140),
        TokenKind::Comment => Color32::from_rgb(124, 134, 150),
        TokenKind::Directive => Color32::from_rgb(214, 140, 180),
        TokenKind::Operator => Color32::from_rgb(176, 184, 198),
    }
}
