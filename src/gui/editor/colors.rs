//! The colours of code.

use crate::glsl::services::Class;
use crate::gui::theme::Palette;
use egui::Color32;

/// Returns the colour of a class of code, for the background of a theme.
pub(super) fn code_color(kind: Class, palette: &Palette) -> Color32 {
    let [dark, light] = match kind {
        Class::Local | Class::Unknown => return palette.text,
        Class::Comment if palette.is_over_picture() => return palette.weak,
        Class::Keyword => [(201, 142, 226), (136, 38, 170)],
        Class::Type => [(104, 194, 208), (0, 108, 124)],
        Class::Builtin => [(106, 173, 245), (18, 88, 190)],
        Class::Uniform => [(240, 152, 118), (168, 66, 12)],
        Class::Macro => [(226, 196, 120), (128, 86, 0)],
        Class::Function => [(220, 220, 170), (98, 88, 10)],
        Class::Parameter => [(233, 186, 158), (140, 74, 36)],
        Class::Global => [(156, 196, 240), (30, 84, 150)],
        Class::Field => [(176, 208, 214), (38, 94, 106)],
        Class::Inactive => [(98, 106, 121), (148, 154, 166)],
        Class::Number => [(160, 205, 140), (36, 112, 30)],
        Class::Comment => [(124, 134, 150), (104, 114, 126)],
        Class::Preprocessor => [(214, 140, 180), (158, 36, 100)],
        Class::Operator => [(176, 184, 198), (78, 86, 100)],
    };
    let (r, g, b) = if palette.is_dark { dark } else { light };
    Color32::from_rgb(r, g, b)
}
