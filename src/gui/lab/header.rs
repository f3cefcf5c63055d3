//! The row over the plot: the study, its progress, and where results are saved.

use super::{
    model,
    state::{Folder, Lab, name_of},
};
use crate::{
    gui::{
        icons::{self, Icon},
        theme,
        ui_output::{Pick, ShellCommand, UiOutput},
    },
    lab::Extent,
};
use egui::{Align, Button, ComboBox, Layout, Popup, ProgressBar, RichText, Ui, vec2};

const HEIGHT: f32 = 28.0;

pub(super) fn show(ui: &mut Ui, lab: &mut Lab, out: &mut UiOutput) {
    ui.allocate_ui_with_layout(vec2(ui.available_width(), HEIGHT), Layout::left_to_right(Align::Center), |ui| {
        study(ui, lab, out);
        extent(ui, lab, out);
        start(ui, lab, out);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            more(ui, lab, out);
            let save = ui.add_enabled(lab.has_results(), Button::new("Save report…"));
            let save = save.on_hover_text("Write tables, plots and an HTML page of all results, like `eddy lab --out`");
            out.on_click("lab:save-report", &save, ShellCommand::Pick(Pick::LabReport));
            progress(ui, lab);
        });
    });
}

fn study(ui: &mut Ui, lab: &mut Lab, out: &mut UiOutput) {
    let mut chosen = lab.study;
    let response = ComboBox::from_id_salt("lab study")
        .width(170.0)
        .height(420.0)
        .selected_text(lab.study().title)
        .show_ui(ui, |ui| {
            for (n, study) in lab.studies.iter().enumerate() {
                let entry = ui.selectable_label(n == lab.study, study.title).on_hover_text(study.text);
                if out.clicked(&format!("lab:study:{}", study.name), &entry) {
                    chosen = n;
                }
            }
        })
        .response
        .on_hover_text(lab.study().text);
    out.place("lab:study", response.rect);
    lab.choose(chosen, lab.extent);
}

fn extent(ui: &mut Ui, lab: &mut Lab, out: &mut UiOutput) {
    ui.spacing_mut().item_spacing.x = 2.0;
    let mut chosen = lab.extent;
    for (extent, name, tip) in [
        (Extent::Quick, "Quick", "Small grids and every second setting: takes seconds"),
        (Extent::Full, "Full", "Full grids and every setting: takes minutes"),
    ] {
        let button = ui.add(Button::new(name).selected(lab.extent == extent)).on_hover_text(tip);
        if out.clicked(&format!("lab:{}", name_of(extent)), &button) {
            chosen = extent;
        }
    }
    lab.choose(lab.study, chosen);
    ui.spacing_mut().item_spacing.x = 6.0;
}

fn start(ui: &mut Ui, lab: &mut Lab, out: &mut UiOutput) {
    if let Some(run) = &lab.run {
        let is_stopping = run.background.is_stopping();
        let button = ui.add_enabled(!is_stopping, Button::new(if is_stopping { "Stopping…" } else { "Stop" }));
        let button = button.on_hover_text("Results are kept; Start resumes the run");
        if out.clicked("lab:stop", &button) {
            run.background.stop();
        }
        return;
    }
    let is_whole = lab.known(lab.extent).is_whole(lab.study(), lab.extent);
    let is_temporary = matches!(lab.folder, Folder::Temporary(_));
    let is_begun = lab.shown.is_some();
    let (label, tip) = match (is_whole, is_begun) {
        (true, _) if is_temporary => ("Run again", "Measure everything again"),
        (true, _) => ("Start", "Everything is measured. To measure again, choose another folder"),
        (false, true) => ("Resume", "Measure the missing points"),
        (false, false) => ("Start", "Measure in the background"),
    };
    let text = RichText::new(label).color(theme::of(ui).strong);
    let button = ui.add_enabled(!is_whole || is_temporary, Button::new(text).fill(theme::of(ui).accent_fill));
    if out.clicked("lab:start", &button.on_hover_text(tip).on_disabled_hover_text(tip)) {
        lab.start();
    }
}

/// Shows the progress in the remaining room.
fn progress(ui: &mut Ui, lab: &Lab) {
    let Some(run) = &lab.run else { return };
    let (part, words) = model::progress_text(&run.progress);
    let is_other = (run.study, run.extent) != (lab.study, lab.extent);
    let words = if is_other { format!("{}: {words}", lab.studies[run.study].title) } else { words };
    let width = ui.available_width() - 8.0;
    if width < 60.0 {
        return;
    }
    let bar = ProgressBar::new(part).desired_width(width).desired_height(18.0).fill(theme::of(ui).accent_fill);
    let text = RichText::new(words.clone()).size(11.5).color(theme::of(ui).strong);
    let tip = "Costs are measured while the window draws, which makes them larger. For publication run `eddy lab` \
               on an idle machine";
    ui.add(bar.text(text).corner_radius(4)).on_hover_text(format!("{words}\n{tip}"));
}

fn more(ui: &mut Ui, lab: &mut Lab, out: &mut UiOutput) {
    let button = icons::button(ui, Icon::More, "More");
    out.place("lab:more", button.rect);
    Popup::menu(&button).show(|ui| {
        let place = match &lab.folder {
            Folder::Temporary(_) => "Results are kept until the window closes".to_owned(),
            Folder::Chosen(path) => format!("Results are kept in {}", path.display()),
        };
        ui.colored_label(theme::of(ui).weak, place);
        let choose = ui.add_enabled(lab.run.is_none(), Button::new("Keep results in a folder…"));
        let choose =
            choose.on_hover_text("A run resumes from the folder's results; `eddy lab merge` joins several folders");
        out.on_menu_click(ui, "lab:choose-folder", &choose, ShellCommand::Pick(Pick::LabFolder));
    });
}
