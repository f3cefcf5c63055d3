//! The programs whose shaders Eddy draws as they are, beside Shadertoy's.

/// The program that the texts of a project are written for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dialect {
    #[default]
    Shadertoy,
    /// Custom shaders of the terminal Ghostty ([`super::ghostty`]).
    Ghostty,
    /// Interactive Shader Format ([`super::isf`]).
    Isf,
}

impl Dialect {
    pub const ALL: [Dialect; 3] = [Dialect::Shadertoy, Dialect::Ghostty, Dialect::Isf];

    /// The name in `eddy.toml` and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Dialect::Shadertoy => "shadertoy",
            Dialect::Ghostty => "ghostty",
            Dialect::Isf => "isf",
        }
    }

    /// Returns the dialect of a name.
    pub fn of(name: &str) -> Option<Dialect> {
        Self::ALL.into_iter().find(|dialect| dialect.name().eq_ignore_ascii_case(name))
    }
}
