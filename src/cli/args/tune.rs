//! `eddy tune`.

use super::{run::RunArgs, values::PROJECT};
use crate::{
    playback::frames::FrameList,
    tune::{Bound, Range},
};
use clap::Args;
use std::{path::PathBuf, time::Duration};

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(crate) struct TuneArgs {
    pub project: String,
    /// List the knobs with the reason why each is one, and the numbers that are none; measures nothing
    #[arg(long)]
    pub list: bool,
    /// Try this knob alone; may be repeated [default: the six most promising ones]
    #[arg(long, value_name = "NAME")]
    pub knob: Vec<String>,
    /// Give a knob this value and do not change it; may be repeated
    #[arg(long, value_name = "NAME=VALUE", value_parser = fixed)]
    pub fix: Vec<(String, f64)>,
    /// Try these values of a knob, as in STEPS=16..128 or STEPS=16..128:16 for every 16th; may be repeated
    #[arg(long, value_name = "NAME=LOW..HIGH[:STEP]", value_parser = ranged)]
    pub range: Vec<(String, Range)>,
    /// Largest error: "flip < .02", "ssim > .98", "psnr > 40", "l2 buffer_a < 1e-3", or a claim about a picture, as in
    /// "mean(image.r) within 1% of first", where first is the value of the converged program
    #[arg(long, value_name = "BOUND", default_value = Bound::DEFAULT, value_parser = Bound::parse)]
    pub error: Bound,
    /// Find the most exact setting that takes at most this long per frame, as in 4ms
    #[arg(long, value_name = "MS", value_parser = milliseconds)]
    pub budget: Option<f64>,
    /// Measure errors against the present setting instead of the converged one
    #[arg(long)]
    pub against_present: bool,
    /// Frames to compare, as in 30,120-360x120 [default: a few that are far apart]
    #[arg(long, value_name = "FRAMES", value_parser = FrameList::parse)]
    pub at: Vec<FrameList>,
    /// Time limit of the search in seconds. The best setting that was checked by then is proposed
    #[arg(long, alias = "within", value_name = "SECONDS", default_value = "50", value_parser = super::values::seconds)]
    pub time: Duration,
    /// Measure every combination of the values that --list names, instead of searching; takes as long as --time allows
    #[arg(long)]
    pub all: bool,
    /// Start from the settings of an earlier result, a line of --json; they are measured again, as another device has other
    /// times
    #[arg(long, value_name = "FILE.json")]
    pub from: Option<PathBuf>,
    /// Write every measured setting as comma-separated values
    #[arg(long, value_name = "FILE.csv")]
    pub csv: Option<PathBuf>,
    /// Write a plot of error against time as SVG
    #[arg(long, value_name = "FILE.svg")]
    pub plot: Option<PathBuf>,
    /// Write pictures of the present and the proposed setting beside each other, and the tuned project, into this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write the proposed setting into the project's files; the old files are kept beside them
    #[arg(long)]
    pub apply: bool,
    #[command(flatten)]
    pub run: RunArgs,
    /// Print one JSON object per line instead of tables
    #[arg(long)]
    pub json: bool,
}

fn fixed(text: &str) -> Result<(String, f64), String> {
    let shape = || format!("{text}: write NAME=VALUE, as in AA=2");
    let (name, value) = text.split_once('=').ok_or_else(shape)?;
    Ok((name.trim().to_owned(), value.trim().parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(shape)?))
}

fn ranged(text: &str) -> Result<(String, Range), String> {
    let shape = || format!("{text}: write NAME=LOW..HIGH, as in STEPS=16..128");
    let (name, range) = text.split_once('=').ok_or_else(shape)?;
    Ok((name.trim().to_owned(), Range::parse(range)?))
}

fn milliseconds(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches("ms").trim();
    number
        .parse()
        .ok()
        .filter(|ms: &f64| *ms > 0.0 && ms.is_finite())
        .ok_or_else(|| format!("{text}: write milliseconds, as in 4ms"))
}
