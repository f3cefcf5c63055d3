//! The panel: the bound, the knobs with their effects, the plot, the picture of the tried setting.

use super::{
    plot,
    state::{Speed, report},
};
use crate::{
    gui::{
        accessible,
        lab::axis::short,
        panels::{Content, DefaultPlace, MARGIN, PanelContext, PanelRow},
        theme,
        ui_output::{ShellCommand, UiOutput},
    },
    session::{Command, EditCommand, Session, Status, ToolCommand, TuneOutcome},
    tune::{Convergence, Tuning},
};
use egui::{Label, ProgressBar, RichText, ScrollArea, TextEdit, Ui, vec2};

pub(crate) const PANEL: PanelRow =
    PanelRow::new("speed", "Speed and error", DefaultPlace::BelowCodeLarge, Content::Within(MARGIN, show))
        .report(|state, _, session| report(&state.speed, session))
        .action("Panel: Speed and error (of this project)", &[], "tune faster quality optimise pareto frontier");

/// The width of the knobs beside the plot.
const KNOBS: f32 = 330.0;
/// The height of the picture of the tried setting.
const PICTURE: f32 = 150.0;

fn show(ui: &mut Ui, context: &mut PanelContext<'_>) {
    let PanelContext { session, out, .. } = context;
    let state = &mut context.project_ui.speed;
    out.stop("speed", ui);
    ui.spacing_mut().item_spacing = vec2(5.0, 4.0);
    let outcome = state.update(session);
    ui.horizontal_wrapped(|ui| header(state, ui, session, out));
    if let Some(Status::Ended(Err(why))) = session.tuning() {
        let label = ui.add(Label::new(RichText::new(why).color(theme::of(ui).error)).wrap());
        out.place("speed:trouble", label.rect);
    }
    let Some(outcome) = outcome else {
        if session.tuning().is_none() {
            let about = "Search finds the constants, macros and sliders that bound loops, measures what each does to time and \
                         picture, and looks for the fastest setting within the error.";
            ui.colored_label(theme::of(ui).weak, about);
        }
        return;
    };
    let room = ui.available_rect_before_wrap();
    let is_wide = room.width() > 2.0 * KNOBS;
    let (left, right) =
        if is_wide { room.split_left_right_at_x(room.left() + KNOBS) } else { room.split_top_bottom_at_fraction(0.45) };
    let mut child = ui.new_child(egui::UiBuilder::new().id_salt("knobs").max_rect(left));
    child.set_clip_rect(left.intersect(ui.clip_rect()));
    ScrollArea::vertical().auto_shrink(false).show(&mut child, |ui| {
        result(state, ui, session, &outcome, out);
        knobs(ui, &outcome, out);
    });
    let mut child = ui.new_child(egui::UiBuilder::new().id_salt("plot").max_rect(right.shrink2(vec2(6.0, 0.0))));
    child.set_clip_rect(right.intersect(ui.clip_rect()));
    let tried = state.tried(&outcome).clone();
    if let Some(values) = plot::show(&mut child, &outcome.tuning, &tried, out) {
        state.chosen = Some(values);
    }
    ui.advance_cursor_after_rect(room);
}

/// Shows the bound, and the button that starts or stops a search.
fn header(state: &mut Speed, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    ui.label("Error");
    let hint = "flip < .02, ssim > .98, psnr > 40";
    let field = ui.add(TextEdit::singleline(&mut state.bound).desired_width(140.0).hint_text(hint));
    accessible::name(&field, egui::Role::TextInput, "Largest error");
    out.place("speed:bound", field.rect);
    let options = state.options();
    let field = match &options {
        Err(why) => field.on_hover_text(why),
        Ok(_) => field.on_hover_text(format!("Largest error of the picture: {hint}")),
    };
    let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
    let against = ui.checkbox(&mut state.against_present, "Against present");
    out.place("speed:against", against.rect);
    against.on_hover_text("Measure errors against the picture as it is now, instead of the converged one");
    if let Some(Status::UnderWay(progress)) = session.tuning() {
        out.on_click("speed:stop", &ui.button("Stop"), Command::Tool(ToolCommand::Tune(None)));
        let bar = ui.add(ProgressBar::new(progress.part as f32).desired_width(90.0));
        accessible::name(&bar, egui::Role::ProgressIndicator, "Searching");
        ui.add(Label::new(RichText::new(&progress.doing).color(theme::of(ui).weak)).truncate());
        return;
    }
    let search = ui.add_enabled(options.is_ok(), egui::Button::new("Search"));
    let search = search.on_hover_text("Takes up to a minute. Pause the picture for less noisy times");
    if (out.clicked("speed:search", &search) || is_entered)
        && let Ok(options) = options
    {
        out.commands.push(Command::Tool(ToolCommand::Tune(Some(options))));
    }
    if session.is_tuning_old() {
        ui.colored_label(theme::of(ui).warning, "The project has changed since");
    }
}

/// Shows the tried setting with its picture, and the buttons that compare and apply it.
fn result(state: &mut Speed, ui: &mut Ui, session: &Session, outcome: &TuneOutcome, out: &mut UiOutput) {
    let (tuning, p) = (&outcome.tuning, theme::of(ui));
    let tried = state.tried(outcome).clone();
    let is_present = tried.values == tuning.present.values;
    let shown = if state.is_compared { tuning.present.values.clone() } else { tried.values.clone() };
    if let Some(texture) = state.picture(ui.ctx(), outcome, &shown) {
        let size = texture.size_vec2();
        let scale = (PICTURE / size.y).min(ui.available_width() / size.x);
        let image = ui.add(egui::Image::new((texture.id(), size * scale)));
        out.place("speed:picture", image.rect);
    }
    let faster = tuning.present.millis / tried.millis;
    let words = match is_present {
        true => format!("{} ms per frame, error {}: the present setting", short(tried.millis), short(tried.error)),
        false => format!(
            "{}: {} ms instead of {} ({} times as fast), error {}",
            tuning.named(&tried.values),
            short(tried.millis),
            short(tuning.present.millis),
            short(faster),
            short(tried.error)
        ),
    };
    let label = ui.add(Label::new(RichText::new(words).color(p.strong)).wrap());
    out.place("speed:tried", label.rect);
    if tuning.proposal.is_none() {
        ui.colored_label(p.warning, format!("No measured setting meets {}", tuning.bound));
    }
    ui.horizontal(|ui| {
        let compare = ui.add_enabled(!is_present, egui::Button::new("Hold to compare"));
        let compare = compare.on_hover_text("Shows the picture of the present setting while the button is held");
        out.place("speed:compare", compare.rect);
        state.is_compared = compare.is_pointer_button_down_on();
        let can_apply = !is_present && !session.is_tuning_old();
        let apply = ui.add_enabled(can_apply, egui::Button::new("Apply"));
        let apply = apply.on_hover_text("Changes the texts, as one edit that Undo reverts");
        if out.clicked("speed:apply", &apply) {
            let edit = outcome.edit(&tried.values);
            out.shell_commands.extend(edit.fix.map(ShellCommand::Fix));
            for (name, value) in edit.uniforms {
                out.commands.push(Command::Edit(EditCommand::SetCustomUniform { name, value: Some(value) }));
            }
        }
        if state.chosen.is_some() && tuning.proposal.is_some() {
            let back = ui.button("Proposed").on_hover_text("Shows the proposed setting again");
            if out.clicked("speed:proposed", &back) {
                state.chosen = None;
            }
        }
    });
}

/// Shows a row for each knob, with the effect of each of its values.
fn knobs(ui: &mut Ui, outcome: &TuneOutcome, out: &mut UiOutput) {
    let (tuning, p) = (&outcome.tuning, theme::of(ui));
    for (index, knob) in tuning.knobs.iter().enumerate() {
        ui.add_space(4.0);
        let row = ui.horizontal_wrapped(|ui| {
            ui.colored_label(p.strong, format!("{} = {}", knob.name, knob.shown(knob.value)));
            ui.colored_label(p.weak, format!("{}: {}", knob.place, knob.why));
        });
        out.place(format!("speed:knob:{}", knob.name), row.response.rect);
        if let Some(words) = state_of(tuning, index) {
            ui.colored_label(p.weak, words);
        }
        for effect in tuning.effects[index].iter().filter(|effect| effect.value != knob.value) {
            let percent = (effect.millis / tuning.present.millis - 1.0) * 100.0;
            ui.label(format!("{}: {percent:+.0} % time, error {}", knob.shown(effect.value), short(effect.error)));
        }
        if let Some(rejected) = tuning.rejected.iter().find(|rejected| rejected.name == knob.name) {
            ui.colored_label(p.weak, format!("Not tried: {}", rejected.reason));
        }
    }
    if !outcome.rejected.is_empty() {
        ui.add_space(6.0);
        ui.collapsing("Not tried", |ui| {
            for rejected in &outcome.rejected {
                ui.colored_label(p.weak, format!("{} ({}): {}", rejected.name, rejected.place, rejected.reason));
            }
        });
    }
    ui.add_space(4.0);
    let device = format!("{} settings on {} ({})", tuning.points.len(), tuning.device, tuning.driver);
    ui.colored_label(p.weak, device);
}

fn state_of(tuning: &Tuning, index: usize) -> Option<String> {
    let knob = &tuning.knobs[index];
    match &tuning.convergence[index] {
        Convergence::Reached { value } => Some(format!("Converged at {}", knob.shown(*value))),
        Convergence::Approaching { value, rest } => Some(format!(
            "Compared with {}; the next step changes the picture by about {}",
            knob.shown(*value),
            short(*rest)
        )),
        Convergence::Diverging { .. } => Some("Does not converge: it decides what is drawn".into()),
        Convergence::Untried => None,
    }
}
