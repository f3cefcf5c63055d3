//! The lab's commands.

use super::{
    run::RunArgs,
    values::{PROJECT, Picture, picture, size},
};
use crate::{lab::stability::BoundArgument, session::trace::STEPS};
use clap::{Args, Subcommand};
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct LabArgs {
    #[command(subcommand)]
    pub command: Option<LabCommand>,
    /// The studies to run [default: all]
    pub study: Vec<String>,
    /// The folder of the results and the report; a run that was stopped goes on there
    #[arg(long, value_name = "DIR", required_unless_present = "list")]
    pub out: Option<PathBuf>,
    /// Print the studies and their methods, and measure nothing
    #[arg(long)]
    pub list: bool,
    /// Small grids, each method's usual setting and every second other one
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
    /// Make one report of the results of several folders, which must be of one device, driver, version and extent
    Merge {
        #[arg(required = true, value_name = "DIR")]
        from: Vec<PathBuf>,
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
    },
    /// Say how wrong projects are: in 16-bit floats against 32, in single against double precision, and by what GLSL
    /// leaves undefined. Without a project, run the study of that name
    Precision(PrecisionArgs),
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct PrecisionArgs {
    /// The projects to compare [default: the study's presets, which need --out]
    pub project: Vec<String>,
    /// Frames to draw [default: 300; with --replay all that were recorded]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 30))]
    pub frames: Option<u32>,
    /// The pass whose last frame is held against double precision
    #[arg(long, value_name = "NAME", default_value = "image", value_parser = picture)]
    pub pass: Picture,
    /// The number of its pixels, across and up
    #[arg(long, value_name = "CxR", default_value = "32x18", value_parser = size, allow_hyphen_values = true)]
    pub pixels: (u32, u32),
    /// A .npy or .png file for the error of each of these pixels, in each component; a .png shows its logarithm, from
    /// 1e-8 (black) to 1 (white)
    #[arg(long, value_name = "PATH", requires = "project")]
    pub map: Option<PathBuf>,
    /// Give a pixel up after so many statements
    #[arg(long, value_name = "N", default_value_t = STEPS)]
    pub max_statements: u64,
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

impl PrecisionArgs {
    pub fn frames(&self) -> u32 {
        self.frames.or(self.run.recorded()).unwrap_or(300)
    }
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub struct StabilityArgs {
    /// [default: every preset]
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
