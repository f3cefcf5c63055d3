//! The panel: buttons, the position, what is shown there, and at its foot how far the CPU differs from the device.

use super::{
    buttons,
    debugger::Debugger,
    divergence,
    moment::words,
    parts,
    rows::{self, RowAction},
};
use crate::{
    debugger::trace::{MomentKind, Traced},
    gui::{
        accessible,
        actions::{Action, TraceAction},
        icons::{self, Icon},
        panels::{Content, DefaultPlace, MARGIN, PanelRow},
        theme,
        ui_output::{ShellCommand, UiOutput},
    },
    session::{Command, Session, ToolCommand},
};
use egui::{Label, RichText, ScrollArea, TextEdit, Ui, vec2};

pub(crate) const PANEL: PanelRow = PanelRow::new(
    "trace",
    "Trace",
    DefaultPlace::BelowCode,
    Content::Within(MARGIN, |ui, context| show(&mut context.project_ui.debugger, ui, context.session, context.out)),
)
.report(|state, _, session| state.debugger.report(session))
.action("Panel: Trace (debugger)", &["Ctrl+Shift+D"], "debug step inspect");

/// The maximum number of values listed for a comment.
const MAX_VALUES: usize = 200;
/// The minimum width for two columns.
const WIDE: f32 = 560.0;
/// The minimum height of what is above the foot.
const MIN_CONTENT_HEIGHT: f32 = 110.0;

fn show(debugger: &mut Debugger, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    out.stop("trace", ui);
    ui.spacing_mut().item_spacing = vec2(6.0, 3.0);
    ui.horizontal_wrapped(|ui| {
        buttons::show(ui, debugger.is_on(), out);
        ui.add_space(6.0);
        let tip = out.keys.tip("Click a pixel in the picture to trace it", Action::TracePixel);
        parts::button(ui, "trace:pick", ("Pick pixel", &tip), Action::TracePixel, out);
        if debugger.is_on() {
            parts::button(ui, "trace:end-trace", ("End", "Stop tracing"), Command::Tool(ToolCommand::Trace(None)), out);
        }
        let view = session.trace();
        if view.is_under_way {
            ui.spinner();
        } else if let Some(trouble) = view.trouble {
            ui.colored_label(theme::of(ui).error, trouble);
        }
    });
    let Some(traced) = debugger.examiner.as_ref().map(|examiner| examiner.traced.clone()) else {
        let how = out.keys.hint(Action::TracePixel);
        let text = format!(
            "Ctrl+Shift+click a pixel of the picture, or press {how} and click it, to step through its code line by \
             line, forwards and backwards."
        );
        ui.add(Label::new(RichText::new(text).color(theme::of(ui).weak)).wrap());
        breakpoints(debugger, ui, out);
        return;
    };
    position(debugger, &traced, ui, out);
    // The foot stays visible if there is room for it and for what is above; otherwise it scrolls.
    let room = ui.available_height() - divergence::height(ui);
    let has_foot = room >= MIN_CONTENT_HEIGHT;
    let height = if has_foot { room } else { ui.available_height() };
    ScrollArea::vertical().id_salt("trace").max_height(height).auto_shrink(false).show(ui, |ui| {
        // Rows of text are packed tightly.
        ui.spacing_mut().interact_size.y = 19.0;
        if ui.available_width() > WIDE {
            ui.columns(2, |columns| {
                watches(debugger, &mut columns[0], out);
                breakpoints(debugger, &mut columns[0], out);
                variables(debugger, &mut columns[0], out);
                iterations(debugger, &mut columns[1], out);
                printed(debugger, &mut columns[1], out);
            });
        } else {
            watches(debugger, ui, out);
            breakpoints(debugger, ui, out);
            variables(debugger, ui, out);
            iterations(debugger, ui, out);
            printed(debugger, ui, out);
        }
        if !has_foot {
            divergence::show(&traced, session, ui, out);
        }
    });
    if has_foot {
        divergence::show(&traced, session, ui, out);
    }
}

/// Shows the pixel, the line, and the position in the trace.
fn position(debugger: &mut Debugger, traced: &Traced, ui: &mut Ui, out: &mut UiOutput) {
    let (at, message) = (debugger.at, debugger.message);
    let p = theme::of(ui);
    let (x, y) = traced.pixel;
    let count = traced.history.moments.len();
    let mut go_to = None;
    ui.horizontal_wrapped(|ui| {
        let mut words = format!("{} at {x},{y} in frame {}", traced.pass.title(), traced.frame);
        if let Some(moment) = traced.history.moments.get(at) {
            words += &match moment.kind {
                MomentKind::Iteration(turn) => format!(" · iteration {turn}"),
                MomentKind::Return => " · returns".to_owned(),
                _ => String::new(),
            };
        }
        let label = ui.label(RichText::new(words).color(p.text));
        out.place("trace:where", label.rect);
        ui.colored_label(p.weak, format!("step {} of {count}", at + 1));
        if let Some((fragment, name)) = traced.mesh() {
            let side = if fragment.is_front { "front" } else { "back" };
            let words = format!("draw {}, {name}: triangle {}, {side} side", fragment.draw, fragment.triangle);
            let label = ui.colored_label(p.weak, words);
            out.place("trace:mesh", label.rect);
        }
        if let Some(message) = message {
            ui.colored_label(p.warning, message);
        }
        if traced.is_endless || traced.history.is_cut {
            ui.colored_label(p.warning, "too long: only the first steps were kept");
        }
        let stack = debugger.moment_state().map(|seen| seen.stack.clone()).unwrap_or_default();
        for (index, (name, moment)) in stack.iter().enumerate() {
            let response = ui.selectable_label(index == 0, format!("{name}()")).on_hover_text("Go to the call");
            if out.clicked(&format!("trace:call:{index}"), &response) && index > 0 {
                go_to = Some(*moment);
            }
        }
    });
    if let Some(moment) = go_to {
        debugger.go_to(moment);
    }
}

fn watches(debugger: &mut Debugger, ui: &mut Ui, out: &mut UiOutput) {
    parts::title(ui, "Watches");
    let mut removed = None;
    let mut is_edited = false;
    let seen: Vec<_> = debugger.moment_state().map(|seen| seen.watches.clone()).unwrap_or_default();
    for (index, watch) in debugger.watches.iter_mut().enumerate() {
        ui.horizontal(|ui| {
            let close = icons::flat(ui, Icon::Close, "Remove watch");
            if out.clicked(&format!("trace:watch:{index}:remove"), &close) {
                removed = Some(index);
            }
            let field = TextEdit::singleline(watch).id_salt(("watch", index)).font(egui::TextStyle::Monospace);
            let field = ui.add(field.desired_width(110.0));
            out.place(format!("trace:watch:{index}"), field.rect);
            is_edited |= field.changed();
            match seen.get(index) {
                Some(Ok(value)) => {
                    parts::swatch(ui, value);
                    let text = RichText::new(words(value)).monospace().color(theme::of(ui).text);
                    ui.add(Label::new(text).truncate()).on_hover_text(&value.type_text);
                }
                Some(Err(why)) => {
                    let text = RichText::new(why).color(theme::of(ui).error);
                    ui.add(Label::new(text).truncate()).on_hover_text(why);
                }
                None => {}
            }
        });
    }
    if let Some(index) = removed {
        debugger.watches.remove(index);
    }
    let field = TextEdit::singleline(&mut debugger.new_watch)
        .id_salt("new watch")
        .font(egui::TextStyle::Monospace)
        .hint_text("Add expression")
        .desired_width(190.0);
    let field = ui.add(field);
    out.place("trace:watch:new", field.rect);
    if field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter)) && !debugger.new_watch.trim().is_empty() {
        debugger.watches.push(std::mem::take(&mut debugger.new_watch).trim().to_owned());
        is_edited = true;
        field.request_focus();
    }
    if is_edited {
        debugger.forget();
    }
}

fn variables(debugger: &mut Debugger, ui: &mut Ui, out: &mut UiOutput) {
    let Some(seen) = debugger.moment_state() else { return };
    if let Some(result) = &seen.result {
        parts::title(ui, "Return value");
        parts::value(ui, "return", result, false);
    }
    parts::title(ui, "Variables");
    for variable in &seen.variables {
        let rect = parts::value(ui, &variable.shown.name, &variable.shown.value, variable.is_changed);
        out.place(format!("trace:variable:{}", variable.shown.name), rect);
    }
}

fn iterations(debugger: &mut Debugger, ui: &mut Ui, out: &mut UiOutput) {
    let plotted = debugger.plotted.clone();
    let Some(seen) = debugger.moment_state().filter(|seen| !seen.rows.rows.is_empty()) else { return };
    match rows::show(ui, &seen.rows, plotted.as_deref(), out) {
        Some(RowAction::GoTo(at)) => debugger.go_to(at),
        Some(RowAction::Plot(name)) => debugger.plotted = Some(name),
        None => {}
    }
}

fn printed(debugger: &mut Debugger, ui: &mut Ui, out: &mut UiOutput) {
    let Some(examiner) = &mut debugger.examiner else { return };
    let printed = debugger.printed.get_or_insert_with(|| examiner.printed());
    if printed.is_empty() {
        return;
    }
    parts::title(ui, "//@print output");
    let mut go_to = None;
    for comment in printed.iter() {
        let count = comment.values.len();
        let times = if comment.is_cut { format!("more than {count}") } else { count.to_string() };
        let head = format!("{}:{} {} · {times} times", comment.tab.title(), comment.line + 1, comment.expression);
        let list = egui::CollapsingHeader::new(RichText::new(head).monospace().size(12.0))
            .id_salt((comment.line, &comment.expression))
            .default_open(count <= 8);
        let shown = list.show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            for (at, value) in comment.values.iter().take(MAX_VALUES) {
                let (text, color) = match value {
                    Ok(value) => (words(value), theme::of(ui).text),
                    Err(why) => (why.clone(), theme::of(ui).error),
                };
                let is_here = *at == debugger.at;
                let label = ui.selectable_label(is_here, RichText::new(text).monospace().size(12.0).color(color));
                if label.on_hover_text("Go to this step").clicked() {
                    go_to = Some(*at);
                }
            }
        });
        out.place(format!("trace:print:{}", comment.line + 1), shown.header_response.rect);
    }
    if let Some(at) = go_to {
        debugger.go_to(at);
    }
}

fn breakpoints(debugger: &mut Debugger, ui: &mut Ui, out: &mut UiOutput) {
    parts::title(ui, "Breakpoints");
    if debugger.breakpoints.is_empty() {
        let key = out.keys.hint(Action::Trace(TraceAction::Breakpoint));
        ui.colored_label(theme::of(ui).weak, format!("Click next to a line number, or press {key} on the line."));
        return;
    }
    let wrong = debugger.moment_state().map(|seen| seen.conditions.clone()).unwrap_or_default();
    let (mut removed, mut is_edited) = (None, false);
    for (index, breakpoint) in debugger.breakpoints.iter_mut().enumerate() {
        ui.horizontal(|ui| {
            let close = icons::flat(ui, Icon::Close, "Remove breakpoint");
            if out.clicked(&format!("trace:breakpoint:{index}:remove"), &close) {
                removed = Some(index);
            }
            let name = format!("{} line {}", breakpoint.tab.title(), breakpoint.line + 1);
            let switch = ui.checkbox(&mut breakpoint.is_on, "").on_hover_text("Enable or disable");
            accessible::choice(
                &switch,
                egui::Role::CheckBox,
                breakpoint.is_on,
                format!("Breakpoint at {name} enabled"),
            );
            is_edited |= switch.changed();
            let link = ui.link(name);
            out.on_click(
                &format!("trace:breakpoint:{index}"),
                &link,
                ShellCommand::GoTo(breakpoint.tab.clone(), Some((breakpoint.line, 0))),
            );
            let field = TextEdit::singleline(&mut breakpoint.condition)
                .id_salt(("condition", index))
                .font(egui::TextStyle::Monospace)
                .hint_text("Condition (optional)")
                .desired_width(150.0);
            let field = ui.add(field);
            out.place(format!("trace:breakpoint:{index}:condition"), field.rect);
            is_edited |= field.changed();
            if let Some(why) = wrong.get(index).and_then(Option::as_ref) {
                let text = RichText::new(why).color(theme::of(ui).error);
                ui.add(Label::new(text).truncate()).on_hover_text(why);
            }
        });
    }
    if let Some(index) = removed {
        debugger.breakpoints.remove(index);
    }
    if is_edited || removed.is_some() {
        debugger.forget();
    }
}
