//! Custom shaders of the terminal Ghostty: Shadertoy's `mainImage`, with the terminal's picture in `iChannel0` and
//! uniforms for its cursor and colours. Source: `src/renderer/shaders/shadertoy_prefix.glsl`,
//! `src/renderer/generic.zig` and the documentation of `custom-shader` in `src/config/Config.zig` of
//! <https://github.com/ghostty-org/ghostty> (August 2026).
//!
//! Owns a simulated terminal, a pure function of time and resolution: what is typed and where the cursor goes
//! ([`script`]), its picture, which a buffer of the project draws in GLSL ([`screen`]), and the values of the uniforms
//! ([`uniforms`]).
//!
//! Positions are in pixels. y points up, as in Ghostty with OpenGL; with Metal, on macOS, it points down there.

mod advice;
mod config;
mod font;
mod prelude;
mod screen;
pub mod script;
mod uniforms;

#[cfg(test)]
mod tests;

pub use advice::advice;
pub(super) use config::load as load_config;
pub use uniforms::values;
pub(crate) use uniforms::{UNIFORMS, about};

use super::{Channel, Dialect, Filter, Input, Pass, PassName, Project, Sampler, Source, TexelFormat, Wrap};

/// The name of the buffer that draws the simulated terminal.
pub const TERMINAL: &str = "terminal";

/// The prefix of a file's name that marks it as a custom shader of Ghostty.
pub(super) const PREFIX: &str = "ghostty:";

/// Turns a project of GLSL files into one of custom shaders: adds the prelude that Ghostty puts before them as Common,
/// and the simulated terminal as the buffer that the first of them reads. Each other one reads the picture of the one
/// before it.
pub(super) fn dress(project: &mut Project) {
    let generated = |name: &str, text: String| Source { name: name.into(), path: None, text: text.into() };
    let mut before = PassName::buffer(TERMINAL);
    let mut terminal = Pass::new(before.clone(), generated("terminal", screen::text()));
    terminal.settings.format = TexelFormat::Rgba8;
    project.passes.retain(|pass| pass.id != before);
    for pass in &mut project.passes {
        let sampler = Sampler { filter: Filter::Linear, wrap: Wrap::Clamp, vflip: true };
        pass.bindings = [Some(Channel { input: Input::pass(before), sampler })].into();
        before = pass.id.clone();
        if !pass.id.is_image() {
            pass.settings.format = TexelFormat::Rgba8;
        }
    }
    project.passes.insert(0, terminal);
    project.common = Some(generated("Ghostty", prelude::text()));
    project.dialect = Dialect::Ghostty;
}
