//! The bar over a picture of an expression's values: the expression, how it is shown, and its numbers.

use super::{
    accessible, histogram,
    icons::{self, Icon},
    theme,
    ui_output::UiOutput,
    value_range,
};
use crate::{
    debugger::trace::Number,
    engine::{Paint, Pixels},
    session::{
        Command, Session, ViewCommand,
        probe::{ProbePlace, ProbeView, ProbedValue, Statistics},
    },
};
use egui::{Area, DragValue, Frame, Id, Margin, Order, Rect, RichText, Role, Ui, vec2};

const NAMES: [&str; 4] = ["x", "y", "z", "w"];

/// Shows the bar at the top of the picture's area. `under`: the point of the picture below the mouse, from 0 to 1.
pub(super) fn show(ui: &Ui, session: &Session, area: Rect, under: Option<[f32; 2]>, out: &mut UiOutput) {
    let Some(view) = session.probe() else { return };
    let card =
        Area::new(Id::unique("probe")).order(Order::Middle).fixed_pos(area.min + vec2(6.0, 6.0)).constrain_to(area);
    out.show_area("probe", card, ui, |ui, out| {
        theme::put_over_picture(ui);
        let frame = Frame::NONE.fill(theme::of(ui).panel).corner_radius(6).inner_margin(Margin::symmetric(8, 5));
        frame.show(ui, |ui| {
            out.stop("probe", ui);
            ui.set_max_width((area.width() - 28.0).max(160.0));
            ui.spacing_mut().item_spacing = vec2(6.0, 4.0);
            bar(ui, &view, under, out);
        });
    });
}

fn bar(ui: &mut Ui, view: &ProbeView<'_>, under: Option<[f32; 2]>, out: &mut UiOutput) {
    let p = theme::of(ui);
    ui.horizontal_wrapped(|ui| {
        match view.value {
            None => drop(ui.colored_label(p.weak, "Compiling the probe…")),
            Some(Err(why)) => drop(ui.colored_label(p.warning, why)),
            Some(Ok(value)) => {
                ui.label(RichText::new(&*value.text).monospace().color(p.strong));
                ui.colored_label(
                    p.weak,
                    format!("{} · {} line {}", value.type_text, view.place.tab.title(), value.line),
                );
                visit(ui, view.place, out);
            }
        }
        let close = icons::flat(ui, Icon::Close, "Close probe").on_hover_text("Show the picture (Escape)");
        out.on_click("probe:close", &close, Command::View(ViewCommand::Probe(None)));
    });
    let Some(Ok(value)) = view.value else { return };
    look(ui, view, value, out);
    let Some(numbers) = view.numbers else { return };
    ui.horizontal(|ui| {
        histogram::show(ui, value.components, &numbers.statistics, "probe:histogram", 34.0, out);
        ui.vertical(|ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            figures(ui, value, &numbers.statistics, out);
            let under = under.and_then(|at| number_at(&numbers.pixels, at, value));
            let text = under.map_or("–".into(), |(pixel, number)| format!("at {},{}: {number}", pixel.0, pixel.1));
            let label = ui.label(RichText::new(text).monospace().color(p.strong));
            out.place("probe:number", label.rect);
        });
    });
}

fn visit(ui: &mut Ui, place: &ProbePlace, out: &mut UiOutput) {
    let mut visit = place.visit;
    let field = DragValue::new(&mut visit).prefix("visit ").range(0..=100_000);
    let response = ui.add(field);
    accessible::name(&response, Role::SpinButton, "Evaluation to show");
    let response = response.on_hover_text("Which evaluation to show: 0 is the first");
    out.place("probe:visit", response.rect);
    if visit != place.visit {
        out.ask(ViewCommand::Probe(Some(ProbePlace { visit, ..place.clone() })));
    }
}

/// Offers the display options: colours, one component or all, and the range.
fn look(ui: &mut Ui, view: &ProbeView<'_>, value: &ProbedValue, out: &mut UiOutput) {
    let mut look = view.look;
    ui.horizontal_wrapped(|ui| {
        let paints = [(Paint::Range, "Range"), (Paint::Sign, "Signed"), (Paint::FalseColour, "False colour")];
        for (paint, name) in paints {
            let response = ui.selectable_label(look.paint == paint, name);
            if out.clicked(&format!("probe:{}", name.to_lowercase().replace(' ', "-")), &response) {
                look.paint = paint;
            }
        }
        if value.components > 1 {
            for channel in 0..value.components {
                let is_on = look.channel == Some(channel);
                let response = ui.selectable_label(is_on, NAMES[usize::from(channel) & 3]);
                if out.clicked(&format!("probe:{}", NAMES[usize::from(channel) & 3]), &response) {
                    look.channel = (!is_on).then_some(channel);
                }
            }
        }
        let extent = view.numbers.map_or((0.0, 1.0), |numbers| numbers.statistics.extent(look.channel));
        value_range::show(ui, "probe", extent, extent, &mut look.range, out);
    });
    if look != view.look {
        out.ask(ViewCommand::LookAtProbe(look));
    }
}

/// Shows the minimum and maximum, and warnings.
fn figures(ui: &mut Ui, value: &ProbedValue, statistics: &Statistics, out: &mut UiOutput) {
    let p = theme::of(ui);
    let words = statistics.extremes.iter().enumerate().filter_map(|(i, extreme)| {
        let (low, high) = (*extreme)?;
        let name = if value.components == 1 { String::new() } else { format!("{} ", NAMES[i]) };
        Some(format!("{name}{} … {}", Number::Float(low), Number::Float(high)))
    });
    let mut text = words.collect::<Vec<_>>().join("   ");
    if statistics.visited < statistics.pixels {
        text += &format!("   {} of {} pixels", statistics.visited, statistics.pixels);
    }
    let label = ui.label(RichText::new(text).monospace().size(11.0).color(p.text));
    out.place("probe:extremes", label.rect);
    if statistics.nonfinite > 0 {
        ui.colored_label(p.error, format!("{} values are NaN or infinite", statistics.nonfinite));
    }
}

/// Returns the texel at a point of the picture, and its numbers.
pub(super) fn number_at(pixels: &Pixels, at: [f32; 2], value: &ProbedValue) -> Option<((u32, u32), String)> {
    let texel = |part: f32, count: u32| ((part * count as f32) as u32).min(count.saturating_sub(1));
    let (x, y) = (texel(at[0], pixels.width), texel(at[1], pixels.height));
    let found = pixels.texels.get((y * pixels.width + x) as usize)?;
    if found.iter().all(|x| x.is_nan()) {
        return Some(((x, y), "not evaluated".into()));
    }
    let number = |x: &f32| match value.is_whole && x.fract() == 0.0 {
        true => format!("{x:.0}"),
        false => Number::Float(*x).to_string(),
    };
    let numbers: Vec<String> = found.iter().take(value.components.into()).map(number).collect();
    Some(((x, y), if numbers.len() == 1 { numbers.concat() } else { format!("({})", numbers.join(", ")) }))
}

/// Returns the report for scripts.
pub(super) fn report(session: &Session, under: Option<[f32; 2]>) -> serde_json::Value {
    let Some(view) = session.probe() else { return serde_json::json!({ "text": null }) };
    let (value, trouble) = match view.value {
        Some(Ok(value)) => (Some(value), None),
        Some(Err(why)) => (None, Some(why)),
        None => (None, None),
    };
    let under = value.zip(view.numbers).zip(under);
    let under = under.and_then(|((value, numbers), at)| number_at(&numbers.pixels, at, value));
    let extremes = view.numbers.map(|numbers| &numbers.statistics.extremes);
    serde_json::json!({
        "text": value.map(|value| &value.text),
        "type": value.map(|value| &value.type_text),
        "line": value.map(|value| value.line),
        "visit": view.place.visit,
        "trouble": trouble,
        "range": extremes.map(|extremes| extremes.map(|extreme| extreme.map(|(low, high)| [low, high]))),
        "pixel": under.as_ref().map(|(pixel, _)| [pixel.0, pixel.1]),
        "number": under.as_ref().map(|(_, number)| number),
    })
}
