//! The programs besides Shadertoy whose shaders Eddy draws unchanged: a table of their properties, the one place that
//! selects a program for a file, and the project of a file with `void main()`.

use super::{Pass, words::names_word};

#[cfg(test)]
mod docs;
mod program;
mod recognise;
mod regenerate;
mod rows;
mod samplers;
mod sliders;
#[cfg(test)]
mod tests;
mod textures;
mod twigl;
mod uniforms;

pub use recognise::ShaderForm;
pub use regenerate::regenerated;
pub use rows::{AlphaRule, DialectRow, EntryPoint};
pub use textures::{HostTexture, SoundTexture};
pub use uniforms::{HostUniform, HostValue, MouseUnit};

use program::alpha;
pub(super) use program::{load, save};
pub(super) use sliders::declared_sliders;

/// The program that the texts of a project are written for. Its properties are in its [`DialectRow`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dialect {
    #[default]
    Shadertoy,
    /// Custom shaders of the terminal Ghostty ([`super::ghostty`]).
    Ghostty,
    /// Interactive Shader Format ([`super::isf`]).
    Isf,
    GlslViewer,
    GlslSandbox,
    Bonzomatic,
    Twigl,
    /// Complete fragment shaders that no other row recognises.
    Plain,
}

impl Dialect {
    pub const ALL: [Dialect; 8] = [
        Dialect::Shadertoy,
        Dialect::Ghostty,
        Dialect::Isf,
        Dialect::GlslViewer,
        Dialect::GlslSandbox,
        Dialect::Bonzomatic,
        Dialect::Twigl,
        Dialect::Plain,
    ];

    /// Returns its row of the table.
    pub fn row(self) -> &'static DialectRow {
        &rows::ROWS[self as usize]
    }

    /// The name in `eddy.toml` and on the command line.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// Returns whether texts are complete fragment shaders with `void main()`, around which Eddy generates the passes of
    /// a project.
    pub fn has_main(self) -> bool {
        self.row().entry == EntryPoint::Main
    }

    /// Returns the treatment of the alpha that a pass of a project outputs.
    pub fn alpha(self, pass: &Pass) -> AlphaRule {
        alpha(self, pass)
    }

    /// Returns the colour with which the targets of a pass are cleared before it is drawn; `None` if they are not.
    pub fn clear_colour(self, pass: &Pass) -> Option<[f32; 4]> {
        if pass.body.is_cleared() {
            return Some([0.0; 4]);
        }
        self.row().clear.filter(|_| !names_word(&pass.source.text, "mainImage"))
    }

    /// Returns the dialect with a name.
    pub fn of(name: &str) -> Option<Dialect> {
        Self::ALL.into_iter().find(|dialect| dialect.name().eq_ignore_ascii_case(name))
    }
}
