//! This module declares the command line for clap. Scripts rely on it: an option is added here, never changed.

use super::{sweep::Sweep, text_place::TextPlace};
use crate::{
    glsl::opt::PassSet,
    lab::stability::BoundArgument,
    project::PassId,
    session::{
        capture::Format,
        date,
        script::{ScriptedInputs, parse_keys, parse_mouse},
        trace::STEPS,
    },
};
use clap::{Args, Parser, Subcommand};
use jiff::civil::DateTime;
use std::{path::PathBuf, time::Duration};

const PROJECT: &str = "A PROJECT is a folder with eddy.toml, a folder of common.glsl, buffer_a.glsl … image.glsl, one \
    .glsl file, a preset's name (see `eddy list`) or a Shadertoy API .json. One that is called like a command: \
    `eddy ./render`.";

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
    /// Tell on standard output what happens in the window, one JSON object a line
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Draw frames without a window, at a fixed step: frame i has iTime = i/60
    Render(RenderArgs),
    /// Draw the value of an expression instead of the picture
    Probe(ProbeArgs),
    /// Say what a pass does for one pixel, step by step, and how far its value is from the device's
    Trace(TraceArgs),
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
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct RenderArgs {
    #[arg(required = true)]
    pub project: Vec<String>,
    /// Where to: a .png or .npy file, or a folder that gets STEM.png for each project (several --at: STEM_0004.png,
    /// with more digits if the last one needs them). With --json it may be left out: every frame is drawn and nothing
    /// written
    #[arg(long, value_name = "PATH", required_unless_present = "json")]
    pub out: Option<PathBuf>,
    /// Frames to draw [default: 1, or as many as --at needs]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 30))]
    pub frames: Option<u32>,
    /// Which frames to write, counted from 0 [default: the last]
    #[arg(long, value_name = "F[,F...]", value_delimiter = ',')]
    #[arg(value_parser = clap::value_parser!(u32).range(..1 << 30))]
    pub at: Vec<u32>,
    /// Which pass to write: image, buffer_a, a further buffer's name …; scene:1 is target 1 of a pass that has several
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
    /// One JSON object a line instead of words: project, status, diagnostics, compile_ms, frame_ms, frames
    #[arg(long)]
    pub json: bool,
}

/// How frames are drawn, wherever frames are drawn.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = size, allow_hyphen_values = true)]
    pub size: (u32, u32),
    /// Frames in a second of iTime
    #[arg(long, value_name = "N", default_value = "60", value_parser = fps, allow_hyphen_values = true)]
    pub fps: f64,
    /// Mouse events by frame, in canvas pixels from the bottom left: "0:down 40,40; 4:move 80,45; 10:up"
    #[arg(long, value_name = "SCRIPT", default_value = "")]
    pub mouse: String,
    /// Key events by frame, with the site's key codes: "0:down 32; 3:up 32"
    #[arg(long, value_name = "SCRIPT", default_value = "")]
    pub keys: String,
    /// Date and time of frame 0, from which iDate runs on with iTime [default: iDate is (0, 0, 0, iTime)]
    #[arg(long, value_name = "YYYY-MM-DDTHH:MM:SS", value_parser = date::parse)]
    pub date: Option<DateTime>,
    /// A folder with the site's pictures, used instead of Eddy's own where a file has the right name
    #[arg(long, value_name = "DIR")]
    pub media: Option<PathBuf>,
    /// Set a uniform that an #iUniform line declares, as in viscosity=0.3 or tint=1,0.5,0; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Draw every pass in every frame, needed or not; the pictures stay the same
    #[arg(long)]
    pub no_skip: bool,
    /// Give a project up when a frame of it takes longer [default: wait]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub frame_timeout: Option<Duration>,
    #[command(flatten)]
    pub without_pass: WithoutPass,
}

/// Passes of the shader compiler's optimiser that are left out: for who works on it.
#[derive(Debug, Default, Args)]
pub struct WithoutPass {
    /// Leave out a pass of the optimiser; may be repeated
    #[arg(long = "without-pass", value_name = "NAME", value_parser = PassSet::of, hide = true)]
    passes: Vec<PassSet>,
}

impl WithoutPass {
    pub fn set(&self) -> PassSet {
        self.passes.iter().fold(PassSet::default(), |all, &set| all.with(set))
    }
}

impl RunArgs {
    /// Returns what the scripts, the date and the rate make of frame 0, 1, 2 … Err: a script that cannot be read.
    pub fn inputs(&self) -> Result<ScriptedInputs, String> {
        let mouse = parse_mouse(&self.mouse).map_err(|e| format!("--mouse: {e}"))?;
        let keys = parse_keys(&self.keys).map_err(|e| format!("--keys: {e}"))?;
        Ok(ScriptedInputs::new(self.fps).with_mouse(mouse).with_keys(keys).with_date(self.date))
    }
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct ProbeArgs {
    pub project: String,
    /// Where the expression stands: a tab, a line and a column, as in image:12:9 or common:3:14. The innermost
    /// expression there is meant, and at a variable that is declared its first value
    #[arg(value_name = "TAB:LINE:COLUMN", value_parser = TextPlace::parse)]
    pub at: TextPlace,
    /// Which pass is drawn [default: that of the tab; of Common: image]
    #[arg(long, value_name = "NAME", value_parser = picture)]
    pub pass: Option<Picture>,
    /// The value when the expression is evaluated for the time after so many in a pixel
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..1 << 31))]
    pub visit: u32,
    /// A pixel whose value is wanted, counted from the bottom left
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub pixel: Option<(u32, u32)>,
    /// The frame, counted from 0; those before it are drawn first
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..1 << 30))]
    pub frame: u32,
    /// Where the values of all pixels go: a .npy or .png file. Scalars have three equal components, and the fourth is 1
    /// where the value has fewer; a pixel in which the expression is not evaluated has NaN
    #[arg(long, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// png: 8 bits, as shown on a screen. npy: float32, height x width x 4, row 0 at the bottom
    /// [default: what --out ends in, else npy]
    #[arg(long, value_name = "png|npy", value_parser = format)]
    pub format: Option<Format>,
    #[command(flatten)]
    pub run: RunArgs,
    /// One JSON object a line instead of words
    #[arg(long)]
    pub json: bool,
}

impl ProbeArgs {
    /// The format of the file.
    pub fn format(&self) -> Format {
        let is_png = self.out.as_ref().and_then(|p| p.extension()).is_some_and(|e| e.eq_ignore_ascii_case("png"));
        self.format.unwrap_or(if is_png { Format::Png } else { Format::Npy })
    }
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct TraceArgs {
    #[arg(required = true)]
    pub project: Vec<String>,
    /// The pixel, counted from the bottom left
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub pixel: (u32, u32),
    /// The frame, counted from 0; those before it are drawn first
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..1 << 30))]
    pub frame: u32,
    /// Which pass to trace: image, buffer_a, a further buffer's name …
    #[arg(long, value_name = "NAME", default_value = "image", value_parser = picture)]
    pub pass: Picture,
    #[command(flatten)]
    pub run: RunArgs,
    /// Give the pixel up after so many statements
    #[arg(long, value_name = "N", default_value_t = STEPS)]
    pub max_statements: u64,
    /// Print the first so many steps [default: all]
    #[arg(long, value_name = "N")]
    pub max_steps: Option<usize>,
    /// One JSON object a line instead of words
    #[arg(long)]
    pub json: bool,
}

/// A pixel, as in 80,45.
fn pixel(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once(',').and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)));
    parts.ok_or_else(|| format!("{text} is no pixel: write its column and its row, as in 80,45"))
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
    #[arg(long, value_name = "PASS", num_args = 0..=1, default_missing_value = "", require_equals = true, conflicts_with = "json", value_parser = dumped_pass)]
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
    /// Frames to measure, after the warm-up
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u32).range(1..=1 << 30))]
    pub frames: u32,
    #[command(flatten)]
    pub run: RunArgs,
    /// Measure once for each value of a uniform, as `eddy render` draws; may be repeated, for every combination
    #[arg(long, value_name = "NAME=VALUES", value_parser = Sweep::parse)]
    pub sweep: Vec<Sweep>,
    /// One JSON object a line instead of a table
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct LabArgs {
    #[command(subcommand)]
    pub command: Option<LabCommand>,
    /// Which studies to run [default: all]
    pub study: Vec<String>,
    /// The folder of the results and the report; a run that was stopped goes on there
    #[arg(long, value_name = "DIR", required_unless_present = "list")]
    pub out: Option<PathBuf>,
    /// Print the studies and their methods, and measure nothing
    #[arg(long)]
    pub list: bool,
    /// Small grids, each method's usual setting and every second other one: a minute and a half on two cores
    #[arg(long)]
    pub quick: bool,
    /// Turns that methods take while costs are measured, at least 7
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(7..=1 << 20))]
    pub repeats: u32,
    /// Part i of n of the work, from 0/n; auto: what Slurm, AWS Batch or Kubernetes says of the array's task
    #[arg(long, value_name = "I/N|auto", default_value = "0/1")]
    pub shard: String,
}

#[derive(Debug, Subcommand)]
pub enum LabCommand {
    /// Draw simulations under hard conditions and say which leave their bounds
    Stability(StabilityArgs),
    /// Make one report of the results of several folders
    Merge {
        #[arg(required = true, value_name = "DIR")]
        from: Vec<PathBuf>,
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
    },
    /// Compare projects in 16-bit floats with themselves in 32; without one, run the study of that name
    Precision(PrecisionArgs),
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct PrecisionArgs {
    /// What to compare [default: the study's presets, which need --out]
    pub project: Vec<String>,
    /// Frames to draw
    #[arg(long, value_name = "N", default_value_t = 300, value_parser = clap::value_parser!(u32).range(1..=1 << 30))]
    pub frames: u32,
    #[command(flatten)]
    pub run: RunArgs,
    /// One JSON object a line instead of a table
    #[arg(long)]
    pub json: bool,
    /// Without a PROJECT: the folder of the results and the report
    #[arg(long, value_name = "DIR", conflicts_with = "project")]
    pub out: Option<PathBuf>,
    /// Without a PROJECT: a small canvas and few frames
    #[arg(long, conflicts_with = "project")]
    pub quick: bool,
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct StabilityArgs {
    /// [default: every preset that has a state]
    pub project: Vec<String>,
    /// The folder of the results, a CSV and a page; a run that was stopped goes on there
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Small canvases and few frames: a minute on two cores
    #[arg(long)]
    pub quick: bool,
    /// The canvas of all cases but those of odd sizes [default: 640x360, quick 160x90]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// The range of all components of a pass, in place of what is declared or of -1e4..1e4
    #[arg(long, value_name = "PASS=LOW..HIGH", value_parser = BoundArgument::parse, allow_hyphen_values = true)]
    pub bound: Vec<BoundArgument>,
    /// Only cases that have this text in their name or kind, as in drag, strength=50 or odd sizes
    #[arg(long, value_name = "TEXT")]
    pub only: Option<String>,
    /// Part i of n of the cases, from 0/n; auto: what Slurm, AWS Batch or Kubernetes says of the array's task
    #[arg(long, value_name = "I/N|auto", default_value = "0/1")]
    pub shard: String,
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

/// The form a file's extension asks for; `None` for an extension that is no picture's. Err: why it is not written.
pub fn format_of(extension: &str) -> Option<Result<Format, String>> {
    let extension = extension.to_ascii_lowercase();
    Some(match extension.as_str() {
        "png" => Ok(Format::Png),
        "npy" => Ok(Format::Npy),
        "exr" | "gif" | "apng" | "mp4" => {
            Err(format!("this version of Eddy does not write {extension}; it writes png and npy"))
        }
        _ => return None,
    })
}

fn format(text: &str) -> Result<Format, String> {
    format_of(text).unwrap_or_else(|| Err("a picture is written as png or npy".into()))
}

/// A pass, and which of its targets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    pub pass: PassId,
    pub target: usize,
}

fn picture(text: &str) -> Result<Picture, String> {
    let (name, target) = match text.rsplit_once(':') {
        Some((name, number)) => {
            (name, number.parse().map_err(|_| format!("a target is a number from 0, not \"{number}\""))?)
        }
        None => (text, 0),
    };
    Ok(Picture { pass: pass(name)?, target })
}

fn pass(text: &str) -> Result<PassId, String> {
    PassId::parse(text)
        .ok_or_else(|| "a pass is called image, buffer_a, buffer_b … or by a further buffer's name".into())
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let shape = || "a size is written WxH, as in 640x360".to_owned();
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(shape)?;
    let number = |s: &str| s.parse::<u32>().map_err(|_| shape());
    match (number(width)?, number(height)?) {
        (0, _) | (_, 0) => Err("a size of 0 holds no pixel".into()),
        size => Ok(size),
    }
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|secs: &f64| *secs > 0.0);
    let duration = seconds.and_then(|secs| Duration::try_from_secs_f64(secs).ok());
    duration.ok_or_else(|| "seconds are a number above 0, as in 2.5".into())
}

fn fps(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(fps) if fps.is_finite() && fps > 0.0 => Ok(fps),
        _ => Err("frames a second are a number above 0".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
