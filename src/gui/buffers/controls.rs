//! The rows at the top: the page, how values become colours, and the zoom.

use super::{
    numbers::COMPONENTS,
    state::{Buffers, Page},
};
use crate::{
    engine::Paint,
    gui::{accessible, ui_output::UiOutput, value_range},
};
use egui::{DragValue, RichText, Ui};

/// The range of exposure in stops, either way.
const STOPS: f32 = 24.0;
/// The width at which everything fits into one row.
const ONE_ROW: f32 = 900.0;

pub(super) fn show(state: &mut Buffers, ui: &mut Ui, out: &mut UiOutput) {
    let whole = ui.available_width();
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        for (page, name, place) in
            [(Page::Texels, "Texels", "buffers:page:texels"), (Page::Graph, "Render graph", "buffers:page:graph")]
        {
            let response = ui.selectable_label(state.page == page, RichText::new(name).strong());
            if out.clicked(place, &response) {
                state.page = page;
            }
        }
        if state.page == Page::Graph {
            separator(ui);
            let fit =
                ui.selectable_label(state.sheet.fits(), "Fit").on_hover_text("Fit the whole graph; scroll to zoom");
            if out.clicked("buffers:fit-graph", &fit) {
                state.sheet.fit();
            }
            return;
        }
        separator(ui);
        channels(state, ui, out);
        separator(ui);
        let paints = [
            (Paint::Range, "Range", "Black at the start of the range, white at its end"),
            (Paint::Sign, "Signed", "Red above zero, blue below; brighter is farther from zero"),
            (Paint::FalseColour, "False colour", "Blue at the start of the range, through green and yellow to red"),
        ];
        for (paint, name, tip) in paints {
            let response = ui.selectable_label(state.look.paint == paint, name).on_hover_text(tip);
            if out.clicked(&format!("buffers:{}", name.to_lowercase().replace(' ', "-")), &response) {
                state.look.paint = paint;
            }
        }
        // The numbers of a range stay together.
        if whole < ONE_ROW {
            ui.end_row();
        } else {
            separator(ui);
        }
        range(state, ui, out);
        separator(ui);
        exposure(state, ui, out);
        separator(ui);
        size(state, ui, out);
    });
}

fn separator(ui: &mut Ui) {
    ui.add_space(3.0);
    ui.separator();
    ui.add_space(3.0);
}

fn channels(state: &mut Buffers, ui: &mut Ui, out: &mut UiOutput) {
    let components = state.seen.as_ref().map_or(4, |seen| seen.read.components);
    let all = ui.selectable_label(state.look.channel.is_none(), "RGB").on_hover_text("Show all components as a colour");
    if out.clicked("buffers:channel:all", &all) {
        state.look.channel = None;
    }
    for channel in 0..components {
        let name = COMPONENTS[usize::from(channel) & 3];
        let is_on = state.look.channel == Some(channel);
        let response = ui.selectable_label(is_on, name.to_uppercase()).on_hover_text(format!("Show {name} only"));
        if out.clicked(&format!("buffers:channel:{name}"), &response) {
            state.look.channel = (!is_on).then_some(channel);
        }
    }
}

fn range(state: &mut Buffers, ui: &mut Ui, out: &mut UiOutput) {
    let extent = state.seen.as_ref().map_or((0.0, 1.0), |seen| {
        let plain = seen.read.statistics.extremes.iter().take(3).flatten();
        let joined = plain.copied().reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        state.look.channel.map_or(joined.unwrap_or((0.0, 1.0)), |one| seen.read.statistics.extent(Some(one)))
    });
    value_range::show(ui, "buffers", extent, (0.0, 1.0), &mut state.look.range, out);
}

fn exposure(state: &mut Buffers, ui: &mut Ui, out: &mut UiOutput) {
    let field = DragValue::new(&mut state.look.exposure).speed(0.05).range(-STOPS..=STOPS).max_decimals(2);
    let response = ui.add(field.prefix("EV "));
    accessible::name(&response, egui::Role::SpinButton, format!("Exposure: {}", state.look.exposure));
    out.place("buffers:exposure", response.rect);
    response.on_hover_text("Exposure in stops: +1 doubles the brightness");
}

fn size(state: &mut Buffers, ui: &mut Ui, out: &mut UiOutput) {
    let fit = ui.selectable_label(state.zoom.fits(), "Fit").on_hover_text("Fit the whole texture (Home)");
    if out.clicked("buffers:fit", &fit) {
        state.zoom.fit();
    }
}
