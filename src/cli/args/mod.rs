//! The clap declaration of the command line. Scripts rely on it: options are added here, but never changed.

mod elsewhere;
mod inspect;
mod lab;
mod render;
mod run;
mod tools;
mod tune;
mod values;

pub(super) use elsewhere::{Consumer, HostProgram};
pub(super) use inspect::{CompareArgs, CompareView, ProbeArgs, TraceArgs};
pub(super) use lab::{LabArgs, LabCommand, PrecisionArgs, StabilityArgs};
pub(super) use render::RenderArgs;
pub(super) use run::RunArgs;
pub(super) use tools::{CompletionsArgs, DoctorArgs, ListArgs, LspArgs, ManArgs, TranslateArgs, TryCompileArgs};

pub(super) use tune::TuneArgs;

use super::{command::Command, sweep::Sweep};
use crate::{glsl::opt::PassSet, playback::script::ScriptedInputs, video::CameraSource};
use clap::{Args, CommandFactory, Parser, ValueEnum};
use eddy_project::{EditedTexts, project_of};
use run::DisabledPasses;
use std::{net::SocketAddr, path::PathBuf, time::Duration};
pub(super) use values::face_of;
use values::{PROJECT, Picture, folder, osc, picture, seconds, size, webcam};

/// Runs Shadertoy programs unchanged and says how fast and how wrong they are.
#[derive(Debug, Parser)]
#[command(name = "eddy", version, args_conflicts_with_subcommands = true, after_help = PROJECT)]
pub(super) struct Cli {
    #[command(flatten)]
    pub window: Window,
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// The window that is wanted where no command is given.
#[derive(Debug, Args)]
pub struct Window {
    /// Open this project in the window; without it, open the preset gallery
    pub project: Option<String>,
    /// Open the file as a custom shader of this program, with a stand-in for what it draws: ghostty, a terminal
    #[arg(long = "as", value_name = "PROGRAM", requires = "project")]
    pub guest: Option<HostProgram>,
    /// Size of the window in pixels [default: fits the screen]
    #[arg(long, value_name = "WxH", value_parser = size, allow_hyphen_values = true)]
    pub size: Option<(u32, u32)>,
    /// Set a uniform declared by an #iUniform line, as in viscosity=0.3 or tint=1,0.5,0; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Show the picture and the uniforms alone, beside another editor: what it saves is drawn at once. A file that belongs to
    /// a project opens that project
    #[arg(long, requires = "project")]
    pub follow: bool,
    /// Open the project paused, without drawing anything
    #[arg(long)]
    pub paused: bool,
    /// Pause when a frame takes longer than this [default: 2; 1 on a GPU under Windows]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub frame_timeout: Option<Duration>,
    /// CPU time limit for compiling a large pass with a driver that compiles on the CPU [default: 8]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub compile_timeout: Option<Duration>,
    /// Camera that is used when you turn the camera on: /dev/video0, 0 or a name as the system has it, or a test picture by
    /// ffmpeg as in lavfi:testsrc [default: the first camera]
    #[arg(long, value_name = "CAMERA", value_parser = webcam)]
    pub webcam: Option<CameraSource>,
    /// Listen to OSC at this UDP port for this run, at 127.0.0.1 unless an address of this computer is given
    #[arg(long, value_name = "[ADDR:]PORT", value_parser = osc)]
    pub osc: Option<SocketAddr>,
    /// Graphics adapter: a part of its name, high-performance or low-power [default: WGPU_ADAPTER_NAME, or the setting, or
    /// high-performance]
    #[arg(long, value_name = "ADAPTER")]
    pub adapter: Option<String>,
    /// Print events of the window to standard output, one JSON object per line
    #[arg(long)]
    pub json: bool,
}

impl Window {
    /// With `--follow`, an editor passes the file that is open in it: opens the project that contains the file.
    pub fn with_project_of_file(mut self) -> Self {
        let folder_of = |project: &String| {
            let file = std::path::absolute(project).ok().filter(|file| file.is_file())?;
            Some(project_of(&file, &EditedTexts::new())?.to_str()?.to_owned())
        };
        if self.follow
            && let Some(folder) = self.project.as_ref().and_then(folder_of)
        {
            self.project = Some(folder);
        }
        self
    }
}

/// Returns the names of all commands.
pub(super) fn command_names() -> Vec<String> {
    Cli::command().get_subcommands().map(|command| command.get_name().to_owned()).collect()
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(super) struct CheckArgs {
    #[arg(required = true)]
    pub project: Vec<String>,
    /// Say what this program would make of it: ghostty, a terminal whose custom shaders are GLSL files, or xscreensaver
    #[arg(long = "for", value_name = "PROGRAM")]
    pub consumer: Option<Consumer>,
    /// Print one JSON object per line instead of text
    #[arg(long)]
    pub json: bool,
    /// Print the intermediate representation of each pass, after lowering and after each optimisation, or before and
    /// after the named one (docs/compiler.md)
    #[arg(long, value_name = "PASS", num_args = 0..=1, default_missing_value = "", require_equals = true)]
    #[arg(conflicts_with = "json", value_parser = dumped_pass)]
    pub dump_ir: Option<String>,
    #[command(flatten)]
    pub without_pass: DisabledPasses,
}

/// Parses the name of a pass, or nothing.
fn dumped_pass(name: &str) -> Result<String, String> {
    if !name.is_empty() {
        PassSet::of(name)?;
    }
    Ok(name.to_owned())
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(super) struct BenchArgs {
    #[arg(required = true)]
    pub project: Vec<String>,
    /// Number of frames to measure after the warm-up [default: 60; with --replay all recorded frames]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 30))]
    pub frames: Option<u32>,
    #[command(flatten)]
    pub run: RunArgs,
    /// Measure once for each value of a uniform, as in `eddy render --sweep`; may be repeated, for all combinations
    #[arg(long, value_name = "NAME=VALUES", value_parser = Sweep::parse)]
    pub sweep: Vec<Sweep>,
    /// Print one JSON object per line instead of a table
    #[arg(long)]
    pub json: bool,
    /// Count what the pixels of one frame execute, line by line, with each line's part of the time of its pass
    #[arg(long, conflicts_with_all = ["sweep", "replay"])]
    pub lines: bool,
    /// Count only this pass: image, buffer_a, a further buffer's name …
    #[arg(long, value_name = "NAME", requires = "lines", value_parser = picture)]
    pub pass: Option<Picture>,
    /// Count this frame [default: 0]
    #[arg(long, value_name = "FRAME", requires = "lines")]
    pub at: Option<u32>,
    /// Show this number of lines of each pass [default: 20; with --json all]
    #[arg(long, value_name = "N", requires = "lines")]
    pub top: Option<usize>,
}

impl BenchArgs {
    pub(super) fn frames(&self) -> u32 {
        self.frames.or(self.run.recorded()).unwrap_or(60)
    }

    /// Returns the inputs of the frames, or an error message if the options contradict each other.
    pub(super) fn inputs(&self) -> Result<ScriptedInputs, String> {
        self.run.inputs_of(self.frames())
    }
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(super) struct UnusedArgs {
    #[arg(required = true)]
    pub project: Vec<String>,
    /// Number of frames to look at [default: 60; with --replay all recorded frames]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 30))]
    pub frames: Option<u32>,
    #[command(flatten)]
    pub run: RunArgs,
    /// Do not try formats of 16 bits, which draws the frames once more for each pass
    #[arg(long)]
    pub no_precision: bool,
    /// Print one JSON object per line instead of a list
    #[arg(long)]
    pub json: bool,
}

impl UnusedArgs {
    pub(super) fn frames(&self) -> u32 {
        self.frames.or(self.run.recorded()).unwrap_or(60)
    }

    /// Returns the inputs of the frames, or an error message if the options contradict each other.
    pub(super) fn inputs(&self) -> Result<ScriptedInputs, String> {
        self.run.inputs_of(self.frames())
    }
}

#[derive(Debug, Args)]
pub(super) struct ImportArgs {
    #[arg(value_name = "FILE.json")]
    pub file: PathBuf,
    /// Project folder to create
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Overwrite an existing project
    #[arg(long)]
    pub force: bool,
}

#[derive(Debug, Args)]
pub(super) struct ConvertArgs {
    /// Shader of another program, such as glslViewer, GLSL Sandbox, twigl or Bonzomatic, or an ISF file
    #[arg(value_name = "FILE")]
    pub file: String,
    /// Project folder to create
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Overwrite an existing project
    #[arg(long)]
    pub force: bool,
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(super) struct ExportArgs {
    pub project: String,
    /// File to write, which ends in .json, .html or .fs
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Format of the file [default: by its ending]
    #[arg(long, value_name = "FORMAT")]
    pub to: Option<ExportFormat>,
    /// Folder with Shadertoy's textures, music and videos, for html
    #[arg(long, value_name = "DIR", value_parser = folder)]
    pub media: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long)]
    pub force: bool,
}

/// A form that a project is exported in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ExportFormat {
    /// Shadertoy JSON
    Json,
    /// One HTML file that plays the project in a browser by WebGL 2
    Html,
    /// One file of Interactive Shader Format
    Isf,
}

#[cfg(test)]
mod tests {
    use super::{
        values::{Picture, picture},
        *,
    };
    use crate::{
        cli::command::Command,
        film::Format,
        playback::frames::{FrameList, Frames},
        project::PassName,
    };

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
    fn every_option_of_the_contract_is_parsed() {
        let r = render(
            "eddy render a b --size 320x180 --frames 9 --out o --at 0,4,8 --pass buffer_b --format npy --fps 30 \
             --date 2024-12-31T23:59:00 --media src --no-skip --json --mouse 0:down --keys 0:up --set a=1 --set b=1,2 \
             --frame-timeout 0.5",
        );
        assert_eq!(r.run.frame_timeout, Some(Duration::from_millis(500)));
        assert!(parse("eddy fluid --paused").unwrap().window.paused);
        assert_eq!(r.project, ["a", "b"]);
        assert_eq!((r.run.size, r.frames, r.run.fps), ((320, 180), Some(Frames::Count(9)), Some(30.0)));
        assert_eq!((r.pass.pass.key(), r.style.format), ("buffer_b", Some(Format::Npy)));
        assert_eq!(FrameList::joined(&r.at).unwrap().numbers(), [0, 4, 8]);
        assert_eq!(r.pass.target, 0);
        assert_eq!(picture("scene:2"), Ok(Picture { pass: PassName::buffer("scene"), target: 2 }));
        assert!(picture("scene:x").is_err());
        assert_eq!(r.run.set, ["a=1", "b=1,2"]);
        assert!(r.json && r.run.no_skip && r.run.date.is_some());
    }

    #[test]
    fn invalid_options_are_rejected_with_a_fix() {
        for (line, hint) in [
            ("eddy render", "PROJECT"),
            ("eddy render a", "--out"),
            ("eddy render a --out o --size 0x10", "at least 1"),
            ("eddy render a --out o --size 10", "640x360"),
            ("eddy render a --out o --size -1x10", "640x360"),
            ("eddy render a --out o --size 99999999999x10", "640x360"),
            ("eddy render a --out o --frames 0", "frames"),
            ("eddy render a --out o --fps 0", "above 0"),
            ("eddy bench a --frame-timeout 0", "above 0"),
            ("eddy a --frame-timeout nan", "above 0"),
            ("eddy render a --out o --fps nan", "above 0"),
            ("eddy render a --out o --format bmp", "png, exr, npy"),
            ("eddy render a --out o --format wav", "--pass sound"),
            ("eddy render a --out o --codec xvid", "h264, h265"),
            ("eddy render a --out o --quality best", "lossless"),
            ("eddy render a --out o --range tv", "limited or full"),
            ("eddy render a --out o --chroma 411", "420"),
            ("eddy render a --out o --frames 9-2", "write 2-9"),
            ("eddy render a --out o --frames -1", "0-59"),
            ("eddy render a --out o --shard 3/3", "the last is 2"),
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
            ("eddy translate a", "--to"),
            ("eddy translate a --to cg", "wgsl, hlsl, msl, glsl, spirv"),
            ("eddy translate a --to glsl --glsl-version 120", "330, 410, 450, 300es"),
        ] {
            let message = parse(line).expect_err(line);
            assert!(message.contains(hint), "{line}\n{message}");
        }
    }
}
