//! Colours, sizes and spacing, for a dark and for a light window.

mod palette;

pub(super) use palette::{DARK, LIGHT, Palette};

use palette::{DARK_OVER_PICTURE, LIGHT_OVER_PICTURE};

use egui::{
    CornerRadius, FontFamily, FontId, Margin, Shadow, Stroke, Style, TextStyle, Theme, Ui, Visuals,
    epaint::FontColorTransferFunction, vec2,
};

/// Returns the palette for a `Ui`.
pub(super) fn of(ui: &Ui) -> &'static Palette {
    of_visuals(ui.visuals())
}

/// The same without a `Ui`.
pub(super) fn of_visuals(visuals: &Visuals) -> &'static Palette {
    match (visuals.dark_mode, visuals.panel_fill.is_opaque()) {
        (true, true) => &DARK,
        (true, false) => &DARK_OVER_PICTURE,
        (false, true) => &LIGHT,
        (false, false) => &LIGHT_OVER_PICTURE,
    }
}

/// Switches a `Ui` over a picture to translucent colours.
pub(super) fn put_over_picture(ui: &mut Ui) {
    let palette = if ui.visuals().dark_mode { &DARK_OVER_PICTURE } else { &LIGHT_OVER_PICTURE };
    ui.style_mut().visuals = visuals(palette);
}

/// Applies both themes; [`egui::Options::theme_preference`] chooses between them.
pub(super) fn apply(ctx: &egui::Context) {
    // A system without a preference gets the theme in which pictures look best.
    ctx.options_mut(|options| options.fallback_theme = Theme::Dark);
    for (theme, palette) in [(Theme::Dark, &DARK), (Theme::Light, &LIGHT)] {
        ctx.style_mut_of(theme, |style| set(style, palette));
    }
}

fn set(style: &mut Style, palette: &Palette) {
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
    // Menus open without animation.
    style.animation_time = 0.0;
    style.interaction.selectable_labels = false;
    style.visuals = visuals(palette);
}

fn visuals(p: &Palette) -> Visuals {
    let mut v = if p.is_dark { Visuals::dark() } else { Visuals::light() };
    // Dark text on light looks thinner than it is.
    if !p.is_dark {
        v.text_options.color_transfer_function = FontColorTransferFunction::Gamma(0.6);
    }
    v.panel_fill = p.panel;
    v.window_fill = p.raised;
    v.window_stroke = Stroke::new(1.0, p.line);
    v.window_corner_radius = CornerRadius::same(8);
    v.menu_corner_radius = CornerRadius::same(6);
    v.extreme_bg_color = p.background;
    v.faint_bg_color = p.raised;
    v.code_bg_color = p.background;
    v.hyperlink_color = p.accent;
    v.warn_fg_color = p.warning;
    v.error_fg_color = p.error;
    v.weak_text_color = Some(p.weak);
    v.selection.bg_fill = p.chosen;
    v.selection.stroke = Stroke::new(1.0, p.strong);
    let shade = egui::Color32::from_black_alpha(if p.is_dark { 110 } else { 46 });
    let shadow = Shadow { offset: [0, 6], blur: 20, spread: 0, color: shade };
    v.window_shadow = shadow;
    v.popup_shadow = shadow;
    let radius = CornerRadius::same(5);
    let states = [
        (&mut v.widgets.noninteractive, p.panel, Stroke::new(1.0, p.line), p.text),
        (&mut v.widgets.inactive, p.button, Stroke::NONE, p.text),
        (&mut v.widgets.hovered, p.button_hovered, Stroke::new(1.0, p.button_edge), p.strong),
        (&mut v.widgets.active, p.accent_fill, Stroke::new(1.0, p.accent), p.strong),
        (&mut v.widgets.open, p.button_hovered, Stroke::new(1.0, p.line), p.strong),
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

/// Returns the frame of modal dialogs.
pub(super) fn dialog(style: &Style) -> egui::Frame {
    egui::Frame::popup(style).inner_margin(Margin::same(18)).corner_radius(8)
}
