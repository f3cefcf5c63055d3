//! Colours, sizes and spacing: dark and calm, so that the picture is what one looks at.

use egui::{Color32, CornerRadius, FontFamily, FontId, Margin, Shadow, Stroke, TextStyle, Theme, Visuals, vec2};

pub const BACKGROUND: Color32 = Color32::from_rgb(24, 26, 31);
pub const PANEL: Color32 = Color32::from_rgb(31, 34, 40);
pub const RAISED: Color32 = Color32::from_rgb(40, 44, 52);
pub const BUTTON: Color32 = Color32::from_rgb(50, 55, 65);
pub const BUTTON_HOVERED: Color32 = Color32::from_rgb(64, 70, 83);
pub const LINE: Color32 = Color32::from_rgb(53, 58, 68);
/// Beside the picture.
pub const SURROUND: Color32 = Color32::from_rgb(15, 16, 19);
pub const TEXT: Color32 = Color32::from_rgb(214, 219, 228);
/// For what need not be read: 5:1 against the panel.
pub const WEAK: Color32 = Color32::from_rgb(146, 154, 169);
pub const STRONG: Color32 = Color32::from_rgb(244, 246, 250);
pub const ACCENT: Color32 = Color32::from_rgb(92, 168, 255);
pub const ACCENT_FILL: Color32 = Color32::from_rgb(36, 82, 138);
pub const ERROR: Color32 = Color32::from_rgb(255, 120, 117);
pub const WARNING: Color32 = Color32::from_rgb(240, 190, 100);
pub const GOOD: Color32 = Color32::from_rgb(126, 201, 140);

/// Width of the frame round what has the keyboard.
pub const FOCUS: Stroke = Stroke { width: 1.5, color: ACCENT };

/// Puts the theme into effect.
pub fn apply(ctx: &egui::Context) {
    ctx.set_theme(Theme::Dark);
    ctx.all_styles_mut(|style| {
        style.text_styles = [
            (TextStyle::Small, FontId::new(11.0, FontFamily::Proportional)),
            (TextStyle::Body, FontId::new(13.5, FontFamily::Proportional)),
            (TextStyle::Button, FontId::new(13.5, FontFamily::Proportional)),
            (TextStyle::Heading, FontId::new(19.0, FontFamily::Proportional)),
            (TextStyle::Monospace, FontId::new(12.5, FontFamily::Monospace)),
        ]
        .into();
        style.spacing.item_spacing = vec2(6.0, 6.0);
        style.spacing.button_padding = vec2(8.0, 4.0);
        style.spacing.interact_size = vec2(28.0, 24.0);
        style.spacing.window_margin = Margin::same(16);
        style.spacing.menu_margin = Margin::same(8);
        style.interaction.tooltip_delay = 0.4;
        style.interaction.selectable_labels = false;
        style.visuals = visuals();
    });
}

fn visuals() -> Visuals {
    let mut v = Visuals::dark();
    v.panel_fill = PANEL;
    v.window_fill = RAISED;
    v.window_stroke = Stroke::new(1.0, LINE);
    v.window_corner_radius = CornerRadius::same(8);
    v.menu_corner_radius = CornerRadius::same(6);
    v.extreme_bg_color = BACKGROUND;
    v.faint_bg_color = RAISED;
    v.code_bg_color = BACKGROUND;
    v.hyperlink_color = ACCENT;
    v.warn_fg_color = WARNING;
    v.error_fg_color = ERROR;
    v.weak_text_color = Some(WEAK);
    v.selection.bg_fill = ACCENT_FILL;
    v.selection.stroke = Stroke::new(1.0, STRONG);
    let shadow = Shadow { offset: [0, 6], blur: 20, spread: 0, color: Color32::from_black_alpha(110) };
    v.window_shadow = shadow;
    v.popup_shadow = shadow;
    let radius = CornerRadius::same(5);
    let states = [
        (&mut v.widgets.noninteractive, PANEL, Stroke::new(1.0, LINE), TEXT),
        (&mut v.widgets.inactive, BUTTON, Stroke::NONE, TEXT),
        (&mut v.widgets.hovered, BUTTON_HOVERED, Stroke::new(1.0, Color32::from_rgb(92, 100, 117)), STRONG),
        (&mut v.widgets.active, ACCENT_FILL, Stroke::new(1.0, ACCENT), STRONG),
        (&mut v.widgets.open, BUTTON_HOVERED, Stroke::new(1.0, LINE), STRONG),
    ];
    for (widget, fill, border, text) in states {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.bg_stroke = border;
        widget.fg_stroke = Stroke::new(1.0, text);
        widget.corner_radius = radius;
        widget.expansion = 0.0;
    }
    v
}

/// The frame of what stands in front of everything.
pub fn dialog(style: &egui::Style) -> egui::Frame {
    egui::Frame::popup(style).inner_margin(Margin::same(18)).corner_radius(8)
}
