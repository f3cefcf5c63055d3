//! This module declares the command line for clap. Scripts rely on it: an option is added here, never changed.

mod inspect;
mod lab;
mod run;
mod values;

pub use inspect::{CompareArgs, CompareView, ProbeArgs, TraceArgs};
pub use lab::{LabArgs, LabCommand, PrecisionArgs, StabilityArgs};
pub use run::RunArgs;
pub use values::{Picture, format_of};

use super::sweep::Sweep;
use crate::{
    glsl::opt::PassSet,
    session::{
        capture::Format,
        reduction::{Assertion, Quantity},
        script::ScriptedInputs,
        trial::COMMAND,
    },
};
use clap::{Args, Parser, Subcommand};
use run::WithoutPass;
use std::{path::PathBuf, time::Duration};
use values::{PROJECT, format, picture, seconds, size};

/// Runs Shadertoy programs unchanged and says how fast and how wrong they are.
#[derive(Debug, Parser)]
#[command(name = "eddy", version, args_conflicts_with_subcommands = true, after_help = PROJECT)]
pub struct Cli {
    #[command(flatten)]
    pub window: Window,
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The window that is wanted where no command is given.
#[derive(Debug, Args)]
pub struct Window {
    /// Opens the window on this project; without one, on the gallery of presets
    pub project: Option<String>,
    /// Size of the window in pixels [default: what suits the screen]
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    pub size: Option<(u32, u32)>,
    /// Set a uniform that an #iUniform line declares, as in viscosity=0.3 or tint=1,0.5,0; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Open the project paused: nothing of it is drawn before you say so
    #[arg(long)]
    pub paused: bool,
    /// A frame that takes longer pauses the picture [default: 2]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub frame_timeout: Option<Duration>,
    /// Processor time that a driver which compiles on the processor may take for a large pass [default: 8]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub compile_timeout: Option<Duration>,
    /// Tell on standard output what happens in the window, one JSON object a line
    #[arg(long)]
    pub json: bool,
    /// Development only: the window's device is lost when FILE appears, which is removed
    #[arg(long, value_name = "FILE", hide = true)]
    pub lose_device: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw frames without a window, at a fixed step: frame i has iTime = i/60
    Render(RenderArgs),
    /// Draw the value of an expression instead of the picture
    Probe(ProbeArgs),
    /// Say what a pass does for one pixel, step by step, and how far its value is from the device's
    Trace(TraceArgs),
    /// Say how far the pictures of two projects, or of two revisions of one, are apart, and how their times compare
    Compare(CompareArgs),
    /// Compile every pass and say what is wrong with it; needs no graphics device
    Check(CheckArgs),
    /// Measure what a frame costs, after a warm-up
    Bench(BenchArgs),
    /// Measure methods against a reference: speed against error, as tables, plots and one HTML page
    Lab(LabArgs),
    /// Print the presets' names, one a line
    List,
    /// Make a project folder of a Shadertoy JSON file
    Import(ImportArgs),
    /// Write a project as a Shadertoy JSON file
    Export(ExportArgs),
    /// Compile the project on standard input by the graphics driver: what Eddy starts itself for, see session/trial.rs
    #[command(hide = true, name = COMMAND)]
    TryCompile,
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct RenderArgs {
    #[arg(required = true)]
    pub project: Vec<String>,
    /// The file to write, .png or .npy, or a folder that gets STEM.png for each project (several --at: STEM_0004.png,
    /// with more digits if the last one needs them). With --json, --probe or --assert it may be left out: every frame
    /// is drawn and nothing written
    #[arg(long, value_name = "PATH", required_unless_present_any = ["json", "probe", "assert"])]
    pub out: Option<PathBuf>,
    /// Frames to draw [default: 1, or as many as --at needs; with --replay all that were recorded]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 30))]
    pub frames: Option<u32>,
    /// The frames to write, counted from 0 [default: the last]
    #[arg(long, value_name = "F[,F...]", value_delimiter = ',')]
    #[arg(value_parser = clap::value_parser!(u32).range(..1 << 30))]
    pub at: Vec<u32>,
    /// The pass to write: image, buffer_a, a further buffer's name …; scene:1 is target 1 of a pass that has several
    #[arg(long, value_name = "NAME", default_value = "image", value_parser = picture)]
    pub pass: Picture,
    /// png: 8 bits, as shown on a screen. npy: float32, height x width x 4, row 0 at the bottom
    /// [default: what --out ends in, else png]
    #[arg(long, value_name = "png|npy", value_parser = format)]
    pub format: Option<Format>,
    #[command(flatten)]
    pub run: RunArgs,
    /// Draw once for each value of a uniform: tint=1,0,0;0,1,0 or viscosity=0..0.01:5, five values of even distance (of
    /// even ratio: 0.001..1:4:log). Pictures are called STEM_viscosity=0.005.png. May be repeated, for every
    /// combination
    #[arg(long, value_name = "NAME=VALUES", value_parser = Sweep::parse)]
    pub sweep: Vec<Sweep>,
    /// Measure a number of a pass in each frame that --at names: sum, min, max, mean, rms or nonfinite of a component
    /// or of all, as in sum(buffer_a.x) or max(image). May be repeated; lines `//@probe sum(buffer_a.x)` in the
    /// project's texts do the same
    #[arg(long, value_name = "QUANTITY", value_parser = Quantity::parse)]
    pub probe: Vec<Quantity>,
    /// Fail where such a number is not as claimed in one of these frames: "sum(buffer_a.x) within 1e-4 of 1",
    /// "mean(buffer_b.y) within 1% of first", "max(image) <= 1", "nonfinite(buffer_a) == 0". May be repeated
    #[arg(long, value_name = "CLAIM", value_parser = Assertion::parse)]
    pub assert: Vec<Assertion>,
    /// One JSON object a line instead of words: project, status, diagnostics, compile_ms, frame_ms, frames
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct CheckArgs {
    #[arg(required = true)]
    pub project: Vec<String>,
    /// One JSON object a line instead of words
    #[arg(long)]
    pub json: bool,
    /// Print the compiler's intermediate representation of each pass, as it is lowered and after each pass of the
    /// optimiser, or before and after that one (docs/compiler.md)
    #[arg(long, value_name = "PASS", num_args = 0..=1, default_missing_value = "", require_equals = true)]
    #[arg(conflicts_with = "json", value_parser = dumped_pass)]
    pub dump_ir: Option<String>,
    #[command(flatten)]
    pub without_pass: WithoutPass,
}

/// The name of a pass, or nothing.
fn dumped_pass(name: &str) -> Result<String, String> {
    if !name.is_empty() {
        PassSet::of(name)?;
    }
    Ok(name.to_owned())
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct BenchArgs {
    #[arg(required = true)]
    pub project: Vec<String>,
    /// Frames to measure, after the warm-up [default: 60; with --replay all that were recorded]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 30))]
    pub frames: Option<u32>,
    #[command(flatten)]
    pub run: RunArgs,
    /// Measure once for each value of a uniform, as `eddy render` draws; may be repeated, for every combination
    #[arg(long, value_name = "NAME=VALUES", value_parser = Sweep::parse)]
    pub sweep: Vec<Sweep>,
    /// One JSON object a line instead of a table
    #[arg(long)]
    pub json: bool,
}

impl BenchArgs {
    pub fn frames(&self) -> u32 {
        self.frames.or(self.run.recorded()).unwrap_or(60)
    }

    /// Returns what the frames are drawn with. Err: what was asked for cannot be meant.
    pub fn inputs(&self) -> Result<ScriptedInputs, String> {
        self.run.inputs_of(self.frames())
    }
}

#[derive(Debug, Args)]
pub struct ImportArgs {
    #[arg(value_name = "FILE.json")]
    pub file: PathBuf,
    /// The project's folder; it is made
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Write over a project that is there already
    #[arg(long)]
    pub force: bool,
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct ExportArgs {
    pub project: String,
    /// The JSON file to write
    #[arg(long, value_name = "FILE.json")]
    pub out: PathBuf,
    /// Write over a file that is there already
    #[arg(long)]
    pub force: bool,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::PassId;
    use clap::CommandFactory;

    fn parse(line: &str) -> Result<Cli, String> {
        Cli::try_parse_from(line.split(' ')).map_err(|e| e.to_string())
    }

    fn render(line: &str) -> RenderArgs {
        match parse(line) {
            Ok(Cli { command: Some(Command::Render(args)), .. }) => args,
            other => panic!("{line}: {other:?}"),
        }
    }

    #[test]
    fn clap_finds_no_fault_with_the_definitions() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_bare_word_is_a_project_and_a_path_may_look_like_a_command() {
        let project = |line| parse(line).unwrap().window.project;
        assert_eq!(project("eddy fluid --size 800x600").as_deref(), Some("fluid"));
        assert_eq!(project("eddy ./render").as_deref(), Some("./render"));
        assert!(parse("eddy").unwrap().command.is_none());
        assert!(parse("eddy fluid render").is_err());
    }

    #[test]
    fn every_option_of_the_contract_is_read() {
        let r = render(
            "eddy render a b --size 320x180 --frames 9 --out o --at 0,4,8 --pass buffer_b --format npy --fps 30 \
             --date 2024-12-31T23:59:00 --media m --no-skip --json --mouse 0:down --keys 0:up --set a=1 --set b=1,2 \
             --frame-timeout 0.5",
        );
        assert_eq!(r.run.frame_timeout, Some(Duration::from_millis(500)));
        assert!(parse("eddy fluid --paused").unwrap().window.paused);
        assert_eq!(r.project, ["a", "b"]);
        assert_eq!((r.run.size, r.frames, r.run.fps), ((320, 180), Some(9), 30.0));
        assert_eq!(
            (r.at.as_slice(), r.pass.pass.key(), r.format),
            (&[0, 4, 8][..], "buffer_b".into(), Some(Format::Npy))
        );
        assert_eq!(r.pass.target, 0);
        assert_eq!(picture("scene:2"), Ok(Picture { pass: PassId::Buffer("scene".into()), target: 2 }));
        assert!(picture("scene:x").is_err());
        assert_eq!(r.run.set, ["a=1", "b=1,2"]);
        assert!(r.json && r.run.no_skip && r.run.date.is_some());
    }

    #[test]
    fn what_cannot_be_meant_is_refused_with_the_mend() {
        for (line, hint) in [
            ("eddy render", "PROJECT"),
            ("eddy render a", "--out"),
            ("eddy render a --out o --size 0x10", "holds no pixel"),
            ("eddy render a --out o --size 10", "640x360"),
            ("eddy render a --out o --size -1x10", "640x360"),
            ("eddy render a --out o --size 99999999999x10", "640x360"),
            ("eddy render a --out o --frames 0", "frames"),
            ("eddy render a --out o --fps 0", "above 0"),
            ("eddy bench a --frame-timeout 0", "above 0"),
            ("eddy a --frame-timeout nan", "above 0"),
            ("eddy render a --out o --fps nan", "above 0"),
            ("eddy render a --out o --format exr", "it writes png and npy"),
            ("eddy render a --out o --format bmp", "png or npy"),
            ("eddy render a --out o --date yesterday", "2024-02-29T13:45:00"),
            ("eddy render a --out o --date 2024-13-31T23:59:00", "2024-02-29T13:45:00"),
            ("eddy render a --out o --at 1,,2", "at"),
            ("eddy bench", "PROJECT"),
            ("eddy lab", "--out"),
            ("eddy lab --out o --repeats 3", "7"),
            ("eddy lab merge --out o", "DIR"),
            ("eddy lab precision fluid --out o", "--out"),
            ("eddy lab precision fluid --frames 0", "frames"),
            ("eddy import a.json", "--out"),
            ("eddy export", "PROJECT"),
        ] {
            let message = parse(line).expect_err(line);
            assert!(message.contains(hint), "{line}\n{message}");
        }
    }
}
