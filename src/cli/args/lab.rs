//! The commands of the lab.

use super::{
    run::RunArgs,
    values::{PROJECT, Picture, picture, size, values_file},
};
use crate::{debugger::trace::STEPS, lab::stability::parse_bound, playback::assertion::Assertion};
use clap::{Args, Subcommand};
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct LabArgs {
    #[command(subcommand)]
    pub command: Option<LabCommand>,
    /// The studies to run [default: all]
    pub study: Vec<String>,
    /// Folder for the results and the report; a stopped run resumes there
    #[arg(long, value_name = "DIR", required_unless_present = "list")]
    pub out: Option<PathBuf>,
    /// List the studies and their methods without measuring
    #[arg(long)]
    pub list: bool,
    /// Use small grids, and each method's default setting plus every second of the others
    #[arg(long)]
    pub quick: bool,
    /// Number of timed runs per method, at least 7
    #[arg(long, value_name = "N", default_value_t = 7, value_parser = clap::value_parser!(u32).range(7..=1 << 20))]
    pub repeats: u32,
    /// Run part i of n of the work, counted from 0/n; auto: read it from the environment of Slurm or AWS Batch;
    /// auto/n: of GNU parallel or Kubernetes, which do not say how many tasks there are
    #[arg(long, value_name = "I/N|auto|auto/N", default_value = "0/1")]
    pub shard: String,
}

#[derive(Debug, Subcommand)]
#[expect(clippy::large_enum_variant, reason = "there is one, and it is made once")]
pub(crate) enum LabCommand {
    /// Run simulations under hard conditions and report which leave their bounds
    Stability(StabilityArgs),
    /// Merge the results of several folders into one report; device, driver, version and extent must match
    Merge {
        #[arg(required = true, value_name = "DIR")]
        from: Vec<PathBuf>,
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
    },
    /// Measure the error of projects: 16-bit against 32-bit floats, single against double precision, and undefined
    /// behaviour in GLSL. Without a project, run the study of that name
    Precision(PrecisionArgs),
}

/// The limit of statements for an audited pixel: a tenth of that for a traced pixel, as many pixels are audited.
const AUDIT_STEPS: u64 = STEPS / 10;

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(crate) struct PrecisionArgs {
    /// The projects to check [default: the study's presets, which need --out]
    pub project: Vec<String>,
    /// Number of frames to draw [default: 300; with --replay all recorded frames]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 30))]
    pub frames: Option<u32>,
    /// The pass whose last frame is compared with double precision
    #[arg(long, value_name = "NAME", default_value = "image", value_parser = picture)]
    pub pass: Picture,
    /// Number of sampled pixels, columns x rows
    #[arg(long, value_name = "CxR", default_value = "32x18", value_parser = size, allow_hyphen_values = true)]
    pub pixels: (u32, u32),
    /// Write the error of each sampled pixel, per component, to this .npy or .png file; a .png shows its logarithm,
    /// from 1e-8 (black) to 1 (white)
    #[arg(long, value_name = "PATH", requires = "project", value_parser = values_file)]
    pub map: Option<PathBuf>,
    /// Stop a pixel after this number of statements
    #[arg(long, value_name = "N", default_value_t = AUDIT_STEPS)]
    pub max_statements: u64,
    #[command(flatten)]
    pub run: RunArgs,
    /// Print one JSON object per line instead of a table
    #[arg(long)]
    pub json: bool,
    /// Without a PROJECT: folder for the results and the report
    #[arg(long, value_name = "DIR", conflicts_with = "project")]
    pub out: Option<PathBuf>,
    /// Without a PROJECT: use a small resolution and few frames
    #[arg(long, conflicts_with = "project")]
    pub quick: bool,
}

impl PrecisionArgs {
    pub(crate) fn frames(&self) -> u32 {
        self.frames.or(self.run.recorded()).unwrap_or(300)
    }
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(crate) struct StabilityArgs {
    /// [default: every preset]
    pub project: Vec<String>,
    /// Folder for the results, a CSV and an HTML page; a stopped run resumes there
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Use small resolutions and few frames: takes a minute on two cores
    #[arg(long)]
    pub quick: bool,
    /// Resolution of all cases except the odd sizes [default: 640x360, quick 160x90]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<(u32, u32)>,
    /// Allowed range of all components of a pass, instead of the declared one or -1e4..1e4
    #[arg(long, value_name = "PASS=LOW..HIGH", value_parser = parse_bound, allow_hyphen_values = true)]
    pub bound: Vec<Assertion>,
    /// Run only cases with this text in their name or kind, as in drag, strength=50 or odd sizes
    #[arg(long, value_name = "TEXT")]
    pub only: Option<String>,
    /// Run part i of n of the cases, counted from 0/n; auto: read it from the environment of Slurm or AWS Batch;
    /// auto/n: of GNU parallel or Kubernetes, which do not say how many tasks there are
    #[arg(long, value_name = "I/N|auto|auto/N", default_value = "0/1")]
    pub shard: String,
}
