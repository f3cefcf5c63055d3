//! The buttons that step through a trace.

use crate::{
    debugger::trace::travel::{Direction, StepKind},
    gui::{
        actions::{Action, TraceAction},
        theme,
        ui_output::UiOutput,
    },
};
use egui::{Color32, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, pos2, vec2};

const FORWARD: [TraceAction; 5] = [
    TraceAction::Go(StepKind::Into, Direction::Forward),
    TraceAction::Go(StepKind::Over, Direction::Forward),
    TraceAction::Go(StepKind::Out, Direction::Forward),
    TraceAction::Continue(Direction::Forward),
    TraceAction::End(Direction::Forward),
];

const BACK: [TraceAction; 5] = [
    TraceAction::End(Direction::Back),
    TraceAction::Continue(Direction::Back),
    TraceAction::Go(StepKind::Out, Direction::Back),
    TraceAction::Go(StepKind::Over, Direction::Back),
    TraceAction::Go(StepKind::Into, Direction::Back),
];

/// Shows the buttons for going back, then those for going forward.
pub(super) fn show(ui: &mut Ui, is_on: bool, out: &mut UiOutput) {
    ui.spacing_mut().item_spacing.x = 2.0;
    for (index, action) in BACK.into_iter().chain(FORWARD).enumerate() {
        if index == BACK.len() {
            ui.add_space(8.0);
        }
        button(ui, action, is_on, out);
    }
}

fn button(ui: &mut Ui, action: TraceAction, is_on: bool, out: &mut UiOutput) {
    let title = Action::Trace(action).title();
    let response = ui.add_enabled_ui(is_on, |ui| {
        let (rect, response) = ui.allocate_exact_size(vec2(26.0, 22.0), Sense::click());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, is_on, title));
        let visuals = ui.style().interact(&response);
        ui.painter().rect(rect, visuals.corner_radius, visuals.weak_bg_fill, visuals.bg_stroke, StrokeKind::Inside);
        let color = if is_on { visuals.fg_stroke.color } else { theme::of(ui).line };
        paint(ui, rect, action, color);
        response
    });
    let response = response.inner.on_hover_text(out.keys.tip(title, Action::Trace(action)));
    if out.clicked(&format!("trace:{}", name(action)), &response) && is_on {
        out.act(Action::Trace(action));
    }
}

/// Returns the name of a button, for scripts.
fn name(action: TraceAction) -> &'static str {
    match action {
        TraceAction::Go(StepKind::Into, Direction::Forward) => "into",
        TraceAction::Go(StepKind::Over, Direction::Forward) => "over",
        TraceAction::Go(StepKind::Out, Direction::Forward) => "out",
        TraceAction::Go(StepKind::Into, Direction::Back) => "into-back",
        TraceAction::Go(StepKind::Over, Direction::Back) => "over-back",
        TraceAction::Go(StepKind::Out, Direction::Back) => "out-back",
        TraceAction::Continue(Direction::Forward) => "continue",
        TraceAction::Continue(Direction::Back) => "continue-back",
        TraceAction::ToCursor(_) => "to-cursor",
        TraceAction::End(Direction::Forward) => "end",
        TraceAction::End(Direction::Back) => "begin",
        TraceAction::Breakpoint => "breakpoint",
    }
}

fn paint(ui: &Ui, rect: Rect, action: TraceAction, color: Color32) {
    let painter = ui.painter();
    let c = rect.center();
    let (TraceAction::Go(_, way) | TraceAction::Continue(way) | TraceAction::ToCursor(way) | TraceAction::End(way)) =
        action
    else {
        return;
    };
    // To the left is back.
    let side = if way == Direction::Forward { 1.0 } else { -1.0 };
    let at = |x: f32, y: f32| pos2(c.x + side * x, c.y + y);
    let line = Stroke::new(1.5, color);
    let head = |tip: Pos2, by: egui::Vec2| {
        let across = vec2(-by.y, by.x) * 0.8;
        painter.add(Shape::convex_polygon(vec![tip, tip - by + across, tip - by - across], color, Stroke::NONE));
    };
    match action {
        TraceAction::Go(StepKind::Over, _) => {
            let arc: Vec<Pos2> = (0..=12)
                .map(|i| {
                    let angle = std::f32::consts::PI * (1.0 - i as f32 / 12.0);
                    at(7.0 * angle.cos(), 1.0 - 6.0 * angle.sin())
                })
                .collect();
            painter.add(Shape::line(arc, line));
            head(at(7.0, 4.5), vec2(0.0, 4.5));
            painter.circle_filled(at(0.0, 4.0), 2.0, color);
        }
        TraceAction::Go(StepKind::Into, _) => {
            painter.line_segment([at(-5.0, -6.0), at(-5.0, 0.0)], line);
            painter.line_segment([at(-5.0, 0.0), at(2.0, 0.0)], line);
            head(at(5.0, 0.0), vec2(side * 4.5, 0.0));
            painter.circle_filled(at(5.0, 5.0), 2.0, color);
        }
        TraceAction::Go(StepKind::Out, _) => {
            painter.circle_filled(at(-5.0, 5.0), 2.0, color);
            painter.line_segment([at(-5.0, 1.5), at(-5.0, -3.0)], line);
            painter.line_segment([at(-5.0, -3.0), at(2.0, -3.0)], line);
            head(at(5.5, -3.0), vec2(side * 4.5, 0.0));
        }
        TraceAction::Continue(_) => {
            let triangle = vec![at(-5.0, -5.5), at(-5.0, 5.5), at(4.0, 0.0)];
            painter.add(Shape::convex_polygon(triangle, color, Stroke::NONE));
            painter.circle_filled(at(7.0, 0.0), 2.0, color);
        }
        TraceAction::End(_) => {
            let triangle = vec![at(-5.0, -5.0), at(-5.0, 5.0), at(3.0, 0.0)];
            painter.add(Shape::convex_polygon(triangle, color, Stroke::NONE));
            painter.line_segment([at(5.0, -5.0), at(5.0, 5.0)], Stroke::new(2.0, color));
        }
        TraceAction::ToCursor(_) | TraceAction::Breakpoint => {}
    }
}
