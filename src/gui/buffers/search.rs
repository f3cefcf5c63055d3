//! The row of the first NaN: the button that searches for it, the progress, and the result.

use super::state::Buffers;
use crate::{
    debugger::nonfinite::{FirstNonfinite, NonfiniteOperation, NonfiniteTexels, SearchEnd},
    gui::{
        theme,
        ui_output::{ShellCommand, UiOutput},
    },
    session::{Command, Count, Session, Status, ToolCommand},
};
use egui::{Label, RichText, Ui};

pub(super) fn show(state: &mut Buffers, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let bad = state.seen.as_ref().and_then(|seen| seen.read.nonfinite);
    let search = session.search();
    if bad.is_none() && search.is_none() {
        return;
    }
    let p = theme::of(ui);
    ui.horizontal_wrapped(|ui| match search {
        Some(Status::UnderWay(Count { done, of })) => {
            // Before the words, which get wider: a button must not move away from the pointer.
            out.on_click("buffers:stop", &ui.button("Stop"), Command::Tool(ToolCommand::FindNonfinite(false)));
            ui.spinner();
            ui.label(format!("Searching for the first NaN: frame {done} of {of}"));
        }
        None => {
            if let Some(NonfiniteTexels { first: (x, y), count }) = bad {
                let words = match count {
                    1 => format!("Texel {x},{y} is NaN or infinite"),
                    _ => format!("{count} texels are NaN or infinite, the first is {x},{y}"),
                };
                let label = ui.label(RichText::new(words).color(p.error));
                out.place("buffers:nonfinite", label.rect);
                if out.clicked("buffers:show-nonfinite", &ui.button("Show")) {
                    state.reveals = Some((x, y));
                }
            }
            find(ui, "Find first cause", out);
        }
        Some(Status::Ended(end)) => {
            match end {
                Ok(SearchEnd::Found(found)) => first(state, ui, found, out),
                Ok(SearchEnd::Nowhere { first, last }) => {
                    let text = format!("All texels of all passes are finite in frames {first} to {last}.");
                    let label = ui.add(Label::new(RichText::new(text).color(p.good)).wrap());
                    out.place("buffers:found", label.rect);
                }
                Err(why) => {
                    let label = ui.add(Label::new(RichText::new(why).color(p.error)).wrap());
                    out.place("buffers:found", label.rect);
                }
            }
            find(ui, "Search again", out);
            let close = ui.button("Close").on_hover_text("Dismiss");
            out.on_click("buffers:close-search", &close, Command::Tool(ToolCommand::FindNonfinite(false)));
        }
    });
}

fn find(ui: &mut Ui, name: &str, out: &mut UiOutput) {
    let tip = "Replays the kept frames in the background and reports the first NaN: pass, frame, texel and line";
    let response = ui.button(name).on_hover_text(tip);
    out.on_click("buffers:find", &response, Command::Tool(ToolCommand::FindNonfinite(true)));
}

fn first(state: &mut Buffers, ui: &mut Ui, found: &FirstNonfinite, out: &mut UiOutput) {
    let p = theme::of(ui);
    let (pass, (x, y)) = (found.pass.title(), found.texel);
    let head = match found.is_older {
        true => {
            format!("{pass} has it at {x},{y} before the searched frames: step back and search again.")
        }
        false => format!("First NaN: {pass}, frame {}, texel {x},{y} ({} in that frame).", found.frame, found.texels),
    };
    let label = ui.add(Label::new(RichText::new(head).color(p.error)).wrap());
    out.place("buffers:found", label.rect);
    if let Some(NonfiniteOperation { message, place, text, numbers }) = &found.origin {
        let of = if numbers.is_empty() { String::new() } else { format!(" of {numbers}") };
        let words = match place {
            Some(place) => format!("{} line {}: {message}: {text}{of}", place.title(), place.line),
            None => format!("{message}{of}"),
        };
        ui.add(Label::new(RichText::new(words).color(p.text)).wrap());
        if let Some(place) = place
            && let Some(tab) = &place.tab
            && out.clicked("buffers:go-to", &ui.button("Go to line"))
        {
            out.shell_commands.push(ShellCommand::GoTo(tab.clone(), Some((place.line - 1, place.column - 1))));
        }
    } else if !found.is_older {
        let words = "No operation produces it: it is too large for the pass's format, or was read from a texture.";
        ui.add(Label::new(RichText::new(words).color(p.text)).wrap());
    }
    if out.clicked("buffers:show-texel", &ui.button("Show texel")) {
        state.choose((found.pass.clone(), 0));
        state.reveals = Some(found.texel);
    }
}
