//! The CPU's value of the pixel and the device's; if they differ, the first assignment in which the device differs.

use super::parts;
use crate::{
    debugger::{
        divergence::DivergenceFound,
        trace::{Number, Traced},
    },
    gui::{
        theme,
        ui_output::{ShellCommand, UiOutput},
    },
    session::{Command, Session, Status, ToolCommand},
};
use egui::{Id, Label, RichText, Ui};

/// The margin below, because the panel may end at the window's edge.
const MARGIN: f32 = 6.0;

fn height_id() -> Id {
    Id::unique("height of the foot of a trace")
}

/// Returns the height of the panel's foot in the last frame: values wrap depending on the panel's width and their
/// digits.
pub(super) fn height(ui: &Ui) -> f32 {
    ui.data(|d| d.get_temp(height_id())).unwrap_or(40.0)
}

/// Shows both values, their difference, and the result of a search for the first difference.
pub(super) fn show(traced: &Traced, session: &Session, ui: &mut Ui, out: &mut UiOutput) {
    let before = height(ui);
    let shown = ui.vertical(|ui| {
        foot(traced, session, ui, out);
        ui.add_space(MARGIN);
    });
    let now = shown.response.rect.height() + ui.spacing().item_spacing.y;
    if (now - before).abs() > 0.5 {
        ui.data_mut(|d| d.insert_temp(height_id(), now));
        ui.ctx().request_repaint();
    }
}

fn foot(traced: &Traced, session: &Session, ui: &mut Ui, out: &mut UiOutput) {
    let p = theme::of(ui);
    let ulps = traced.ulps();
    let is_apart = ulps.iter().flatten().any(|ulps| *ulps > 0);
    let divergence = session.divergence();
    let first = ui.horizontal_wrapped(|ui| {
        ui.colored_label(p.weak, "CPU");
        let value = traced.value.map_or("draws nothing".into(), |value| list(&value));
        ui.label(RichText::new(value).monospace().size(11.5).color(p.text));
        ui.colored_label(p.weak, "GPU");
        let device = format!("{} as {}", list(&traced.device), traced.format.name());
        ui.label(RichText::new(device).monospace().size(11.5).color(p.text));
        if let Some(ulps) = &ulps {
            let words: Vec<String> = ulps.iter().map(u32::to_string).collect();
            let color = if is_apart { p.warning } else { p.good };
            let label = ui.colored_label(color, format!("{} ULPs apart", words.join(", ")));
            label.on_hover_text("ULPs: the number of single-precision values between the two");
        }
        let is_searching = matches!(divergence, Some(Status::UnderWay(())));
        if is_searching {
            ui.spinner();
        } else if is_apart && traced.mesh().is_none() {
            let tip = "Compare each assignment on the CPU and the GPU until one differs";
            parts::button(
                ui,
                "trace:part",
                ("Find first difference", tip),
                Command::Tool(ToolCommand::FindDivergence),
                out,
            );
        }
    });
    out.place("trace:values", first.response.rect);
    match divergence {
        Some(Status::Ended(Ok(result))) => found(traced, result, ui, out),
        Some(Status::Ended(Err(why))) => drop(ui.colored_label(p.error, why)),
        Some(Status::UnderWay(())) => {
            ui.colored_label(p.weak, "comparing assignments…");
        }
        None => {}
    }
}

fn found(traced: &Traced, result: &DivergenceFound, ui: &mut Ui, out: &mut UiOutput) {
    let p = theme::of(ui);
    let of = format!("{} of {} assignments compared", result.compared, result.of);
    let Some(first) = &result.first else {
        let label = ui.colored_label(p.text, format!("No assignment differs: {of}"));
        out.place("trace:parted", label.rect);
        return;
    };
    let place = traced.place(first.assignment.span);
    let walker: Vec<String> = first.assignment.walker.iter().map(Number::to_string).collect();
    let device = match &first.device {
        Some(device) => format!("{} on the GPU", list(device)),
        None => "not reached on the GPU".to_owned(),
    };
    let ulps: Vec<String> = first.ulps.iter().map(u32::to_string).collect();
    let apart = if ulps.is_empty() { String::new() } else { format!(", {} ULPs apart", ulps.join(", ")) };
    let words = format!("{}{apart}: {} on the CPU, {device}", first.assignment.name, walker.join(", "));
    ui.horizontal(|ui| {
        ui.colored_label(p.weak, "First difference at");
        if let Some((tab, line, range)) = place {
            let text = traced.text(&tab).get(range).and_then(|text| text.lines().next()).unwrap_or_default();
            let link = ui.link(RichText::new(format!("{}:{} {text}", tab.title(), line + 1)).monospace().size(11.5));
            out.on_click("trace:parted", &link.on_hover_text(of), ShellCommand::GoTo(tab, Some((line, 0))));
        }
    });
    let text = RichText::new(&words).monospace().size(11.5).color(p.text);
    ui.add(Label::new(text).truncate()).on_hover_text(words);
}

fn list(values: &[f32]) -> String {
    match values {
        [one] => Number::Float(*one).to_string(),
        values => format!("({})", values.iter().map(|x| Number::Float(*x).to_string()).collect::<Vec<_>>().join(", ")),
    }
}
