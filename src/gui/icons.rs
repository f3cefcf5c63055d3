//! Buttons with custom-painted icons: no font contains them all in one style.

use super::theme;
use egui::{Color32, Pos2, Rect, Response, Sense, Shape, Stroke, StrokeKind, Ui, pos2, vec2};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Icon {
    Reset,
    Play,
    Pause,
    Step,
    StepBack,
    Camera,
    Expand,
    More,
    Previous,
    Next,
    Close,
    /// Code over picture.
    Present,
    Speaker,
    Muted,
}

/// The width of a button, in points.
pub(super) const WIDTH: f32 = 28.0;

/// Shows a button with an icon; `label` is its accessible name.
pub(super) fn button(ui: &mut Ui, icon: Icon, label: &str) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(WIDTH, 24.0), Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, label));
    let visuals = ui.style().interact(&response);
    ui.painter().rect(rect, visuals.corner_radius, visuals.weak_bg_fill, visuals.bg_stroke, StrokeKind::Inside);
    paint(ui, rect, icon, visuals.fg_stroke.color);
    response
}

/// The same for a primary button: larger, and in the accent colour.
pub(super) fn first(ui: &mut Ui, icon: Icon, label: &str) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(40.0, 28.0), Sense::click());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, label));
    let p = theme::of(ui);
    let (fill, ink) = if p.is_dark { (p.accent_fill, p.strong) } else { (p.accent, p.background) };
    let fill = if response.hovered() { fill.gamma_multiply(0.85) } else { fill };
    ui.painter().rect_filled(rect, ui.visuals().widgets.inactive.corner_radius, fill);
    if response.has_focus() {
        ui.painter().rect_stroke(rect.expand(1.5), 6.0, p.focus(), StrokeKind::Inside);
    }
    paint(ui, rect, icon, ink);
    response
}

/// The same without a background, for rows of titles.
pub(super) fn flat(ui: &mut Ui, icon: Icon, label: &str) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(20.0, 20.0), Sense::click());
    flat_sign(ui, rect, response, icon, label)
}

/// The same at a place over another widget.
pub(super) fn flat_at(ui: &Ui, rect: Rect, icon: Icon, label: &str) -> Response {
    let response = ui.interact(rect, ui.scope_id().with(label), Sense::click());
    flat_sign(ui, rect, response, icon, label)
}

fn flat_sign(ui: &Ui, rect: Rect, response: Response, icon: Icon, label: &str) -> Response {
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, label));
    let p = theme::of(ui);
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 4.0, p.button);
    }
    paint(ui, rect, icon, if response.hovered() { p.strong } else { p.weak });
    response
}

fn paint(ui: &Ui, rect: Rect, icon: Icon, color: Color32) {
    let painter = ui.painter();
    let c = rect.center();
    let at = |x: f32, y: f32| pos2(c.x + x, c.y + y);
    let line = Stroke::new(1.5, color);
    let triangle = |points: [Pos2; 3]| painter.add(Shape::convex_polygon(points.to_vec(), color, Stroke::NONE));
    let bar = |x: f32, width: f32| painter.rect_filled(Rect::from_min_max(at(x, -5.0), at(x + width, 5.0)), 0.5, color);
    match icon {
        Icon::Reset => {
            bar(-5.5, 2.0);
            triangle([at(5.0, -5.5), at(5.0, 5.5), at(-3.0, 0.0)]);
        }
        Icon::Play => {
            triangle([at(-4.0, -6.0), at(-4.0, 6.0), at(6.0, 0.0)]);
        }
        Icon::Pause => {
            bar(-4.5, 3.0);
            bar(1.5, 3.0);
        }
        Icon::Step => {
            triangle([at(-5.0, -5.5), at(-5.0, 5.5), at(3.0, 0.0)]);
            bar(3.5, 2.0);
        }
        Icon::StepBack => {
            triangle([at(4.0, -5.5), at(4.0, 5.5), at(-4.5, 0.0)]);
        }
        Icon::Camera => {
            painter.rect_stroke(Rect::from_min_max(at(-7.0, -3.5), at(7.0, 5.5)), 2.0, line, StrokeKind::Middle);
            painter.rect_filled(Rect::from_min_max(at(-2.5, -6.0), at(2.5, -3.5)), 1.0, color);
            painter.circle_stroke(at(0.0, 1.0), 2.5, line);
        }
        Icon::Expand => {
            for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
                let corner = at(6.0 * x, 5.0 * y);
                painter.line(vec![corner - vec2(3.5 * x, 0.0), corner, corner - vec2(0.0, 3.0 * y)], line);
            }
        }
        Icon::More => {
            for x in [-5.0, 0.0, 5.0] {
                painter.circle_filled(at(x, 0.0), 1.5, color);
            }
        }
        Icon::Previous | Icon::Next => {
            let up = if icon == Icon::Previous { 1.0 } else { -1.0 };
            painter.line(vec![at(-4.0, 2.0 * up), at(0.0, -2.5 * up), at(4.0, 2.0 * up)], line);
        }
        Icon::Close => {
            painter.line_segment([at(-3.5, -3.5), at(3.5, 3.5)], line);
            painter.line_segment([at(3.5, -3.5), at(-3.5, 3.5)], line);
        }
        Icon::Speaker | Icon::Muted => {
            painter.rect_filled(Rect::from_min_max(at(-7.0, -2.5), at(-3.5, 2.5)), 0.5, color);
            painter.add(Shape::convex_polygon(
                vec![at(-4.0, -2.5), at(0.0, -6.0), at(0.0, 6.0), at(-4.0, 2.5)],
                color,
                Stroke::NONE,
            ));
            if icon == Icon::Muted {
                painter.line_segment([at(2.5, -3.0), at(7.5, 3.0)], line);
                painter.line_segment([at(2.5, 3.0), at(7.5, -3.0)], line);
            } else {
                painter.line(vec![at(2.5, -3.0), at(4.0, 0.0), at(2.5, 3.0)], line);
                painter.line(vec![at(5.0, -5.0), at(7.5, 0.0), at(5.0, 5.0)], line);
            }
        }
        Icon::Present => {
            painter.rect_stroke(Rect::from_min_max(at(-7.5, -5.5), at(7.5, 5.5)), 1.5, line, StrokeKind::Middle);
            for (y, width) in [(-2.0, 5.0), (1.5, 8.0)] {
                painter.line_segment([at(-4.5, y), at(-4.5 + width, y)], line);
            }
        }
    }
}
