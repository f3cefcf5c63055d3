//! Options for programs whose shaders Eddy draws or checks unchanged.

use super::Cli;
use clap::ValueEnum;

/// A program that a file is drawn as a shader of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum HostProgram {
    /// The terminal Ghostty, with a stand-in terminal
    Ghostty,
}

/// A program that takes Shadertoy's GLSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Consumer {
    /// The terminal Ghostty (`custom-shader`)
    Ghostty,
    /// The module xshadertoy of XScreenSaver
    Xscreensaver,
}

impl HostProgram {
    /// Returns the name by which a file is opened as a shader of this program.
    fn spec(self, file: &str) -> String {
        let HostProgram::Ghostty = self;
        if file.starts_with("ghostty:") { file.to_owned() } else { format!("ghostty:{file}") }
    }
}

impl Consumer {
    /// Returns the name by which a file is opened as this program reads it.
    pub(crate) fn spec(self, file: &str) -> String {
        match self {
            Consumer::Ghostty => HostProgram::Ghostty.spec(file),
            Consumer::Xscreensaver => file.to_owned(),
        }
    }
}

impl Cli {
    /// Applies `--as` to every project.
    pub(crate) fn with_guests(mut self) -> Self {
        let (guest, projects) = match &mut self.command {
            None => (self.window.guest, self.window.project.iter_mut().collect()),
            Some(command) => command.hosted(),
        };
        if let Some(guest) = guest {
            projects.into_iter().for_each(|project| *project = guest.spec(project));
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::{args::LabCommand, command::Command};
    use clap::Parser;

    fn parse(line: &str) -> Cli {
        Cli::try_parse_from(line.split(' ')).expect(line).with_guests()
    }

    #[test]
    fn file_names_get_the_prefix_of_their_program() {
        assert_eq!(parse("eddy --as ghostty glow.glsl").window.project.as_deref(), Some("ghostty:glow.glsl"));
        let Some(Command::Render(args)) = parse("eddy render --as ghostty a.glsl b.glsl --out o").command else {
            panic!()
        };
        assert_eq!(args.project, ["ghostty:a.glsl", "ghostty:b.glsl"]);
        let Some(Command::Bench(args)) = parse("eddy bench a.glsl").command else { panic!() };
        assert_eq!(args.project, ["a.glsl"]);
        let Some(Command::Lab(args)) = parse("eddy lab precision --as ghostty a.glsl").command else { panic!() };
        let Some(LabCommand::Precision(args)) = args.command else { panic!() };
        assert_eq!(args.project, ["ghostty:a.glsl"]);
        assert!(Cli::try_parse_from(["eddy", "--as", "kitty", "a.glsl"]).is_err());
    }
}
