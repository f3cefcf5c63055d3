//! The panel: the baseline, the view, the pictures, and the figures at its foot.

use super::{
    pictures,
    report::report,
    state::{Choice, Compare, HoveredPixel, View},
};
use crate::{
    gui::{
        accessible,
        panels::{Content, DefaultPlace, MARGIN, PanelContext, PanelRow},
        theme,
        ui_output::{Pick, ShellCommand, UiOutput},
    },
    metrics::difference::{PictureDifference, Times},
    playback::comparing::Comparison,
    session::{Command, Count, Outcome, Session, Status, ToolCommand},
};
use egui::{Label, ProgressBar, RichText, TextEdit, Ui, vec2};

pub(crate) const PANEL: PanelRow =
    PanelRow::new("compare", "Compare", DefaultPlace::BelowCodeLarge, Content::Within(MARGIN, show))
        .report(|state, _, session| report(&state.compare, session))
        .action(
            "Panel: Compare (with the last save, a project or a revision)",
            &["Ctrl+Shift+O"],
            "diff difference git a/b",
        );

/// The height of the figures.
const FOOT: f32 = 62.0;
/// The factors by which a difference can be amplified.
const GAINS: [u32; 4] = [1, 4, 16, 64];

fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let PanelContext { wake, session, out, .. } = context;
    let state = &mut context.project_ui.compare;
    out.stop("compare", ui);
    ui.spacing_mut().item_spacing = vec2(5.0, 4.0);
    state.update(ui.ctx(), session, wake);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        reference(state, ui, out);
        ui.add_space(6.0);
        start_button(state, ui, session, out);
    });
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        views(state, ui, out);
    });
    if let Some(Status::Ended(Err(why))) = session.comparison() {
        let label = ui.add(Label::new(RichText::new(why).color(theme::of(ui).error)).wrap());
        out.place("compare:trouble", label.rect);
    }
    let room = ui.available_rect_before_wrap();
    let foot = if state.seen.is_some() { FOOT } else { 0.0 };
    let (upper, lower) = room.split_top_bottom_at_y((room.bottom() - foot).max(room.top()));
    pictures::show(state, ui, upper, out);
    if state.seen.is_some() {
        let mut child = ui.new_child(egui::UiBuilder::new().id_salt("figures").max_rect(lower));
        child.set_clip_rect(lower.intersect(ui.clip_rect()));
        figures(state, &mut child, session, out);
    }
    ui.advance_cursor_after_rect(room);
}

/// Offers the baselines.
fn reference(state: &mut Compare, ui: &mut Ui, out: &mut UiOutput) {
    ui.label("Against");
    let choices = [
        (Choice::LastSave, "Last save", "compare:last-save", "The project as last saved or opened"),
        (Choice::Project, "Project", "compare:project", "A folder, a file or the name of a preset"),
        (Choice::Revision, "Revision", "compare:revision", "The project at a revision of its git repository"),
    ];
    for (choice, name, place, tip) in choices {
        let response = ui.selectable_label(state.choice == choice, name).on_hover_text(tip);
        if out.clicked(place, &response) {
            state.choice = choice;
        }
    }
    let (text, name, hint, width) = match state.choice {
        Choice::LastSave => return,
        Choice::Project => (&mut state.project, "The other project", "Folder, file or preset", 170.0),
        Choice::Revision => (&mut state.revision, "The revision", "HEAD~1, a branch or a hash", 110.0),
    };
    let field = ui.add(TextEdit::singleline(text).desired_width(width).hint_text(hint));
    accessible::name(&field, egui::Role::TextInput, name);
    out.place("compare:name", field.rect);
    if field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter)) {
        out.commands.extend(state.against().map(|against| Command::Tool(ToolCommand::Compare(Some(against)))));
    }
    if state.choice == Choice::Project {
        let browse = ui.button("Browse…").on_hover_text("Choose the folder of the other project");
        out.on_click("compare:browse", &browse, ShellCommand::Pick(Pick::Reference));
    }
}

/// Shows the button that starts or stops, and the progress.
fn start_button(state: &mut Compare, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    if let Some(Status::UnderWay(Count { done, of })) = session.comparison() {
        out.on_click("compare:stop", &ui.button("Stop"), Command::Tool(ToolCommand::Compare(None)));
        if of > 1 {
            let part = done as f32 / of as f32;
            let bar = ProgressBar::new(part).desired_width(130.0).text(format!("Frame {done} of {of}"));
            let response = ui.add(bar);
            accessible::name(&response, egui::Role::ProgressIndicator, format!("Drawing frame {done} of {of}"));
        } else {
            ui.spinner();
        }
        return;
    }
    let against = state.against();
    let tip = "Replays the frames since the last reset with both projects and the same inputs. Pause the picture \
               for less noisy times";
    let compare = ui.add_enabled(against.is_some(), egui::Button::new("Compare")).on_hover_text(tip);
    let is_asked = out.clicked("compare:begin", &compare);
    let follows =
        ui.checkbox(&mut state.follows, "After each edit").on_hover_text("Compare again whenever new code is drawn");
    out.place("compare:follow", follows.rect);
    if state.is_measuring() {
        ui.spinner();
    }
    let compile = session.compile_state();
    let is_settled = !compile.compiling && matches!(compile.last, Some(Outcome::Ok { .. }));
    let is_due = state.follows && is_settled && session.is_comparison_old();
    if is_asked || is_due {
        out.commands.extend(against.map(|against| Command::Tool(ToolCommand::Compare(Some(against)))));
    }
}

fn views(state: &mut Compare, ui: &mut Ui, out: &mut UiOutput) {
    let views = [
        (View::Side, "Side by side", "compare:side", "This project on the left"),
        (View::Wipe, "Wipe", "compare:wipe", "One over the other: drag the line or use the arrow keys"),
        (View::Difference, "Difference", "compare:difference", "The difference of each component"),
        (View::Flip, "FLIP", "compare:flip", "Visible difference when flipping between the two"),
    ];
    for (view, name, place, tip) in views {
        let response = ui.selectable_label(state.view == view, name).on_hover_text(tip);
        if out.clicked(place, &response) {
            state.view = view;
        }
    }
    if state.view == View::Difference {
        ui.add_space(6.0);
        for gain in GAINS {
            let response = ui.selectable_label(state.gain == gain, format!("× {gain}"));
            let response = response.on_hover_text(format!("Multiply the difference by {gain}"));
            if out.clicked(&format!("compare:gain:{gain}"), &response) {
                state.gain = gain;
            }
        }
    }
}

fn figures(state: &Compare, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let Some(seen) = &state.seen else { return };
    let p = theme::of(ui);
    let comparison = &seen.figures.comparison;
    ui.spacing_mut().item_spacing.y = 1.0;
    ui.add_space(3.0);
    let mut first = location_text(comparison);
    if session.is_comparison_old() && !state.follows {
        first += " · the project has changed since";
    }
    ui.add(Label::new(RichText::new(first).color(p.weak)).truncate());
    let second = match state.under {
        Some(at) => under(&at),
        None => distance(&seen.figures.apart, comparison),
    };
    let label = ui.add(Label::new(RichText::new(second).color(p.text)).truncate());
    out.place("compare:figures", label.rect);
    if let Some(times) = seen.figures.times {
        ui.add(Label::new(RichText::new(speed_text(&times)).color(p.text)).truncate());
    }
}

fn location_text(comparison: &Comparison) -> String {
    let Comparison { pass, frame, ours, against, is_cut, is_camera_still, frames, .. } = comparison;
    let cut = if *is_cut { format!(" · last {frames} frames, from empty buffers") } else { String::new() };
    let camera = if *is_camera_still { " · all frames with the camera's last picture" } else { "" };
    format!(
        "{} in frame {frame}, {}x{}, against {}{cut}{camera}",
        pass.title(),
        ours.width,
        ours.height,
        against.name()
    )
}

pub(super) fn distance(apart: &PictureDifference, comparison: &Comparison) -> String {
    if apart.texels_apart == 0 {
        return "Identical".to_owned();
    }
    let ssim = apart.ssim.map_or("none".to_owned(), |ssim| format!("{ssim:.5}"));
    format!(
        "RMSE {:.6} · PSNR {:.2} dB · SSIM {ssim} · FLIP {:.5} · {} of {} texels differ, by at most {:.4}",
        apart.rmse,
        apart.psnr,
        apart.mean_flip(),
        apart.texels_apart,
        comparison.ours.texels.len(),
        apart.largest
    )
}

pub(super) fn speed_text(times: &Times) -> String {
    let Times { ours, theirs, ratio, ratio_low, ratio_high, turns } = times;
    format!(
        "{ours:.3} ms per frame against {theirs:.3}: ratio {ratio:.3} (quartiles {ratio_low:.3} to {ratio_high:.3}, \
         {turns} runs)"
    )
}

fn under(HoveredPixel { texel: (x, y), ours, theirs }: &HoveredPixel) -> String {
    let words = |texel: &[f32; 4]| texel.map(|x| format!("{x:.4}")).join(" ");
    format!("{x},{y}: {} against {}", words(ours), words(theirs))
}
