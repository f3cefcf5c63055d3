//! The table of commands. A row has a command's name, its help and its arguments; the arguments implement [`Run`], in
//! the command's own file.

use super::args::{
    BenchArgs, CheckArgs, CompareArgs, CompletionsArgs, ConvertArgs, DoctorArgs, ExportArgs, HostProgram, ImportArgs,
    LabArgs, ListArgs, LspArgs, ManArgs, ProbeArgs, RenderArgs, TraceArgs, TranslateArgs, TryCompileArgs, TuneArgs,
    UnusedArgs,
};
use crate::playback::trial;
use clap::Subcommand;
use std::io;

/// A command whose arguments have been parsed.
pub(super) trait Run {
    /// True for a command that opens a graphics device.
    const OPENS_DEVICE: bool = false;

    /// Returns the value of `--as`, and the projects that it applies to.
    fn hosted(&mut self) -> (Option<HostProgram>, Vec<&mut String>) {
        (None, Vec::new())
    }

    /// Runs the command and returns the exit code.
    fn run(&mut self) -> Result<u8, CommandError>;
}

/// The reason why a command failed.
#[derive(Debug, thiserror::Error)]
pub(super) enum CommandError {
    /// The arguments contradict each other, or the whole call is impossible.
    #[error("{0}")]
    Refused(String),
    #[error("cannot write to standard output: {0}")]
    Output(#[from] io::Error),
}

impl From<String> for CommandError {
    fn from(why: String) -> Self {
        Self::Refused(why)
    }
}

macro_rules! commands {
    ($($(#[$attribute:meta])* $name:ident($arguments:ty),)*) => {
        #[derive(Debug, Subcommand)]
        pub(crate) enum Command {
            $($(#[$attribute])* $name($arguments),)*
        }

        impl Command {
            /// Returns whether the command opens a graphics device.
            pub(crate) fn opens_device(&self) -> bool {
                match self {
                    $(Self::$name(_) => <$arguments as Run>::OPENS_DEVICE,)*
                }
            }

            /// Returns the value of `--as`, and the projects that it applies to.
            pub(crate) fn hosted(&mut self) -> (Option<HostProgram>, Vec<&mut String>) {
                match self {
                    $(Self::$name(arguments) => arguments.hosted(),)*
                }
            }

            /// Runs the command and returns the exit code.
            pub(crate) fn run(&mut self) -> Result<u8, CommandError> {
                match self {
                    $(Self::$name(arguments) => arguments.run(),)*
                }
            }
        }
    };
}

commands! {
    /// Draw frames without a window, at a fixed step: frame i has iTime = i/60
    Render(RenderArgs),
    /// Draw the value of an expression instead of the picture
    Probe(ProbeArgs),
    /// Trace one pixel of a pass step by step on the CPU, and compare the result with the GPU
    Trace(TraceArgs),
    /// Compare the pictures and times of two projects, or of two revisions of one
    Compare(CompareArgs),
    /// Compile all passes and print errors and warnings; needs no GPU
    Check(CheckArgs),
    /// Measure the time and memory of a frame, after a warm-up
    Bench(BenchArgs),
    /// List the work of a project that nothing depends on, what it costs, and what of it is left out already
    Unused(UnusedArgs),
    /// Find a cheaper setting of the quality constants within a bound of error, or the best within a budget of time
    Tune(TuneArgs),
    /// Measure methods against a reference: speed against error, as tables, plots and an HTML page
    Lab(LabArgs),
    /// List the presets, one per line
    List(ListArgs),
    /// Convert a Shadertoy JSON file to a project folder
    Import(ImportArgs),
    /// Convert a project to a Shadertoy JSON file, to an HTML file that plays it, or to an ISF file
    Export(ExportArgs),
    /// Convert a shader of another program to a project in Shadertoy's form
    Convert(ConvertArgs),
    /// Write the passes of a project in another shading language, with a JSON file of bindings and uniforms
    Translate(TranslateArgs),
    /// Serve an editor over the Language Server Protocol, on standard input and output
    Lsp(LspArgs),
    /// Describe this machine and this build, for a report; sends nothing
    Doctor(DoctorArgs),
    /// Print completions for a shell
    Completions(CompletionsArgs),
    /// Write manual pages
    Man(ManArgs),
    /// Compile the project on standard input with the graphics driver; Eddy runs this itself, see playback/trial.rs
    #[command(hide = true, name = trial::COMMAND)]
    TryCompile(TryCompileArgs),
}

impl Run for LspArgs {
    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(crate::lsp::serve(io::stdin(), io::stdout().lock())?)
    }
}

impl Run for TryCompileArgs {
    const OPENS_DEVICE: bool = true;

    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(u8::from(trial::serve(io::stdin()).is_err()))
    }
}
