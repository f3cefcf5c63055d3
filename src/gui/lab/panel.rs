//! The layout of the panel: the row at the top, the plot, the legend.

use super::{header, legend, plot, state::Lab};
use crate::gui::{
    panels::{Content, DefaultPlace, PanelRow},
    theme,
    ui_output::UiOutput,
};
use egui::{Align, Layout, Margin, RichText, Ui, vec2};

pub(crate) const PANEL: PanelRow = PanelRow::new(
    "lab",
    "Lab",
    DefaultPlace::Own,
    Content::Within(Margin { left: 10, right: 8, top: 2, bottom: 6 }, |ui, context| context.lab.show(ui, context.out)),
)
.report(|_, lab, _| lab.report())
.action("Panel: Lab (speed against error)", &["Ctrl+Shift+Y", "Ctrl+Shift+L"], "benchmark study measure");

/// The minimum width of the panel for the legend.
const ROOM_FOR_LEGEND: f32 = 640.0;

impl Lab {
    fn show(&mut self, ui: &mut Ui, out: &mut UiOutput) {
        out.stop("lab", ui);
        ui.spacing_mut().item_spacing = vec2(6.0, 4.0);
        header::show(ui, self, out);
        if let Some((words, is_bad)) = &self.message {
            let color = if *is_bad { theme::of(ui).error } else { theme::of(ui).good };
            ui.add(egui::Label::new(RichText::new(words).size(12.0).color(color)).truncate().selectable(true));
        }
        let Some(shown) = self.shown.take() else { return self.show_about(ui) };
        let has_legend = ui.available_width() > ROOM_FOR_LEGEND;
        let height = ui.available_height();
        let mut clicked = None;
        let mut hovered_method = None;
        ui.horizontal_top(|ui| {
            let width = ui.available_width() - if has_legend { legend::WIDTH + 12.0 } else { 0.0 };
            ui.allocate_ui(vec2(width, height), |ui| {
                let view = plot::View { opened: self.opened.as_ref(), lit: self.hovered_method, extent: self.extent };
                clicked = plot::show(ui, &shown, &view, out);
            });
            if has_legend {
                let layout = Layout::top_down(Align::Min);
                ui.allocate_ui_with_layout(vec2(legend::WIDTH, height), layout, |ui| {
                    hovered_method = legend::show(ui, &shown);
                });
            }
        });
        self.hovered_method = hovered_method;
        if let Some(row) = clicked {
            self.open(shown.table.rows[row].point.clone(), out);
        }
        self.shown = Some(shown);
    }

    /// Shown before there is anything to plot.
    fn show_about(&self, ui: &mut Ui) {
        let study = self.study();
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.add_space(6.0);
            ui.set_max_width(ui.available_width().min(760.0));
            ui.label(RichText::new(study.title).size(17.0).color(theme::of(ui).strong));
            ui.label(study.text);
            ui.add_space(4.0);
            for method in study.methods {
                let settings: Vec<String> = method.settings.iter().map(f64::to_string).collect();
                ui.horizontal_wrapped(|ui| {
                    ui.label(method.title);
                    ui.colored_label(theme::of(ui).weak, format!("{}: {}", study.parameter, settings.join(", ")));
                });
            }
            ui.add_space(4.0);
            let points = study.points(self.extent).len();
            let grids: Vec<String> = study.grids(self.extent).iter().map(u32::to_string).collect();
            let words = match self.run {
                Some(_) => "Measuring the first points…".to_owned(),
                None => format!("Start measures {points} points on grids of {} texels per side.", grids.join(", ")),
            };
            ui.colored_label(theme::of(ui).weak, words);
        });
    }
}
