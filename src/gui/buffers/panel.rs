//! The panel: its pages, and the parts of each.

use super::{canvas, controls, figures, graph, list, report::report, search, state::Page};
use crate::{
    gui::{
        panels::{Content, DefaultPlace, MARGIN, PanelContext, PanelRow},
        theme,
    },
    session::buffers::reason,
};
use egui::{Align2, FontId, Rect, Ui, UiBuilder, pos2, vec2};

pub(crate) const PANEL: PanelRow =
    PanelRow::new("buffers", "Buffers", DefaultPlace::BelowCodeLarge, Content::Within(MARGIN, show))
        .report(|state, _, session| report(&state.buffers, session))
        .action("Panel: Buffers (texels and render graph)", &["Ctrl+Shift+T"], "textures graph inspect nan");

fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let PanelContext { live, under_picture, session, out, .. } = context;
    let state = &mut context.project_ui.buffers;
    out.stop("buffers", ui);
    state.start_frame();
    ui.spacing_mut().item_spacing = vec2(5.0, 4.0);
    let target = state.target(session.project());
    if let Some(target) = &target {
        state.update(ui.ctx(), session, target);
    }
    controls::show(state, ui, out);
    search::show(state, ui, session, out);
    if state.page == Page::Graph {
        state.wants_costs = true;
        graph::show(state, ui, session, out);
        return;
    }
    let Some(target) = target else {
        ui.colored_label(theme::of(ui).weak, "This project has no pass that draws.");
        return;
    };
    let room = ui.available_rect_before_wrap();
    // In a low panel the texels have priority over the statistics in the foot.
    let foot = if room.height() > 190.0 { figures::HEIGHT } else { 0.0 };
    let beside = (room.width() * 0.32).clamp(150.0, 212.0).min(room.width() * 0.5);
    let (upper, lower) = room.split_top_bottom_at_y(room.bottom() - foot);
    let (left, right) = upper.split_left_right_at_x(upper.left() + beside);
    let canvas = right.with_min_x(right.left() + 6.0);
    let canvas = if foot > 0.0 { canvas.with_max_y(canvas.bottom() - 4.0) } else { canvas };
    canvas::show(state, ui, session, (canvas, *under_picture), out);
    if state.seen.is_none() {
        state.wants_costs = true;
        let costs = session.pass_costs();
        let all: Vec<_> = costs.passes.into_iter().map(|pass| pass.cost).collect();
        let why = reason(&target.0, &all).unwrap_or_else(|| "Reading…".to_owned());
        note(ui, canvas, &format!("{} {why}", target.0.title()));
    }
    within(ui, left, "list", |ui| list::show(state, ui, session, live, out));
    if foot > 0.0 {
        within(ui, lower, "figures", |ui| figures::show(state, ui, out));
    }
    ui.advance_cursor_after_rect(room);
}

fn within(ui: &mut Ui, rect: Rect, name: &str, show: impl FnOnce(&mut Ui)) {
    let mut child = ui.new_child(UiBuilder::new().id_salt(name).max_rect(rect));
    child.set_clip_rect(rect.intersect(ui.clip_rect()));
    show(&mut child);
}

/// Shows words in the middle of a place.
fn note(ui: &Ui, place: Rect, words: &str) {
    let p = theme::of(ui);
    let galley = ui.painter().layout(words.to_owned(), FontId::proportional(12.5), p.weak, place.width() - 24.0);
    let at = Align2::CENTER_CENTER.align_size_within_rect(galley.size(), place);
    ui.painter().with_clip_rect(place).galley(pos2(at.left(), at.top()), galley, p.weak);
}
