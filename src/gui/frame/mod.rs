//! One frame of the window: input, apply, draw, show again.
//!
//! Owns the order of these steps. First the panels take the input, then the session applies their commands, and only
//! then is the picture drawn, so that a shader sees the current mouse position. Knows nothing of windows or surfaces:
//! it returns what is to be painted.

use super::{input_steps, shell::Shell};
use crate::session::{Session, Tick};
use egui::{FullOutput, RawInput};
use egui_wgpu::Renderer;
use std::time::Instant;

/// A frame that is ready to be painted.
pub(super) struct Frame {
    pub output: FullOutput,
    pub tick: Tick,
    /// Panels shown after the picture was drawn have further requests, which the next frame draws.
    pub wants_next: bool,
}

/// Runs the input since the last frame through panels and session, and draws the picture. `renderer` gets the
/// picture's texture.
pub(super) fn run(
    ctx: &egui::Context,
    shell: &mut Shell,
    session: &mut Session,
    renderer: &mut Renderer,
    input: RawInput,
    now: Instant,
) -> Frame {
    let nothing = input_steps::without_events(&input);
    let mut output = FullOutput::default();
    let mut show = |input, session: &mut Session, renderer: &mut Renderer| {
        shell.prepare(session, renderer);
        let mut commands = Vec::new();
        output.append(ctx.run_ui(input, |ui| commands.extend(shell.show(ui, session))));
        let asked = !commands.is_empty();
        commands.into_iter().for_each(|command| session.apply(command));
        asked
    };
    for input in input_steps::split(input) {
        show(input, session, renderer);
    }
    let tick = session.tick(now);
    // The panels were shown before their commands and the tick's changes were applied.
    let wants_next = tick.changed && show(nothing, session, renderer);
    shell.prepare(session, renderer);
    Frame { output, tick, wants_next }
}

#[cfg(test)]
mod contrast;
#[cfg(test)]
mod controls;
#[cfg(test)]
mod edits;
#[cfg(test)]
mod fields;
#[cfg(test)]
mod harness;
#[cfg(test)]
mod looks;
#[cfg(test)]
mod names;
#[cfg(test)]
mod reach;
#[cfg(test)]
mod sound;
#[cfg(test)]
mod tests;
