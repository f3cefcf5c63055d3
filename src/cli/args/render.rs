//! The options of `eddy render`: the frames to draw, and the files to write.

use super::{
    run::RunArgs,
    values::{
        self, PROJECT, Picture, chroma, codec, face, fade, picture, quality, range, seconds, shard, shutter, tile,
    },
};
use crate::{
    cli::{progress, sweep::Sweep, tiles::Tiles},
    film::{Chroma, Codec, ColorRange, Format, Quality, Style},
    playback::{
        assertion::{Assertion, Quantity},
        frames::{FrameList, Frames},
        script::ScriptedInputs,
        shard::Shard,
    },
};
use clap::Args;
use std::{path::PathBuf, time::Duration};

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(crate) struct RenderArgs {
    #[arg(required = true)]
    pub project: Vec<String>,
    /// File to write, or a folder for STEM.png of each project (with several frames STEM_0004.png, with more digits if
    /// needed); with --pass sound .wav or .flac, or a folder for STEM.wav. A film (.mp4, .gif and others) is one file. -
    /// writes to standard output. Optional with --json, --probe or --assert: frames are then drawn but not written
    #[arg(long, value_name = "PATH", required_unless_present_any = ["json", "probe", "assert", "checkpoint_every", "plan"])]
    pub out: Option<PathBuf>,
    /// Number of frames to draw, of which the last is written, or all of them into a film [default: 1, or as many as --at
    /// needs; with --replay all recorded frames]; or the frames to write: 0-59 (both ends), 0-599:2 (every second), 3,8,20-30
    #[arg(long, value_name = "N|A-B[:S][,...]", value_parser = Frames::parse, allow_hyphen_values = true)]
    pub frames: Option<Frames>,
    /// The frames to write, counted from 0: 7, 0-59, 0-599:2 or 3,8,20-30 [default: the last]
    #[arg(long, value_name = "F|A-B[:S][,...]", value_parser = FrameList::parse, allow_hyphen_values = true)]
    pub at: Vec<FrameList>,
    /// Write part i of n of the frames of all projects, counted from 0/n; auto: read it from the environment of Slurm or AWS
    /// Batch; auto/n: of GNU parallel or Kubernetes, which do not say how many tasks there are
    #[arg(long, value_name = "I/N|auto|auto/N", value_parser = shard)]
    pub shard: Option<Shard>,
    /// Draw pictures of a range or a shard again that are there already; otherwise they are kept
    #[arg(long)]
    pub overwrite: bool,
    /// The pass to write: image, buffer_a, a further buffer's name …; scene:1 is target 1 of a pass that has several.
    /// sound writes the samples of the sound pass
    #[arg(long, value_name = "NAME", default_value = "image", value_parser = picture)]
    pub pass: Picture,
    /// Seconds of sound to write, with --pass sound [default: all 180]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub secs: Option<Duration>,
    /// The face of a cubemap to write, with --pass cube_a: +x, -x, +y, -y, +z or -z [default: +x]
    #[arg(long, value_name = "FACE", value_parser = face, allow_hyphen_values = true)]
    pub face: Option<usize>,
    #[command(flatten)]
    pub style: StyleArgs,
    #[command(flatten)]
    pub run: RunArgs,
    /// Draw each picture N times as wide and high, and write the mean of its blocks of NxN pixels. iResolution is that of the
    /// larger picture
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=8), conflicts_with = "replay")]
    pub supersample: Option<u32>,
    /// Draw the picture in tiles of SIZE pixels along each side, a multiple of 4, one after the other: for drivers that stop
    /// long draws. Pictures of more than 33 megapixels are drawn in tiles anyway [default: 2048, or as memory allows]
    #[arg(long, value_name = "SIZE", value_parser = tile, conflicts_with = "no_skip")]
    pub tile: Option<u32>,
    /// Motion blur: the part of a frame's time for which the shutter is open, above 0 to 1. For projects without a state
    #[arg(long, value_name = "PART", value_parser = shutter, conflicts_with = "replay")]
    pub shutter: Option<f64>,
    /// Number of pictures whose mean a frame is, with --shutter
    #[arg(long, value_name = "N", default_value = "8", requires = "shutter")]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=1024))]
    pub samples: u32,
    /// A film without a seam: its first SECS seconds are faded with those that would follow its end. 0 only says how far the last
    /// frame is from the first
    #[arg(long = "loop", value_name = "SECS", value_parser = fade)]
    #[arg(conflicts_with_all = ["replay", "shard", "shutter"])]
    pub looped: Option<f64>,
    /// Draw once for each value of a uniform: tint=1,0,0;0,1,0 or viscosity=0..0.01:5, which is five evenly spaced
    /// values (logarithmic: 0.001..1:4:log). Files are named STEM_viscosity=0.005.png. May be repeated, for all
    /// combinations
    #[arg(long, value_name = "NAME=VALUES", value_parser = Sweep::parse)]
    pub sweep: Vec<Sweep>,
    /// Measure a pass in each frame of --at: sum, min, max, mean, rms, nonfinite, energy or roughness, as in
    /// sum(buffer_a.x), max(image) or max(length(buffer_a.xy)) from row 1. May be repeated; `//@probe sum(buffer_a.x)`
    /// comments in the project do the same
    #[arg(long, value_name = "QUANTITY", value_parser = Quantity::parse)]
    pub probe: Vec<Quantity>,
    /// Fail if this claim does not hold in one of these frames: "sum(buffer_a.x) within 1e-4 of 1", "mean(buffer_b.y)
    /// within 1% of first", "max(image) <= 1", "buffer_a.rgb in 0..2 * brightness". May be repeated
    #[arg(long, value_name = "CLAIM", value_parser = Assertion::parse)]
    pub assert: Vec<Assertion>,
    /// Save the state of the run every N frames, so that later frames can be drawn without those before. Without --out
    /// nothing else is written, and Image is not drawn
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub checkpoint_every: Option<u32>,
    /// Folder for the checkpoints, named STEM_000100.eddystate [default: that of --out, else the current
    /// one]
    #[arg(long, value_name = "DIR", requires = "checkpoint_every")]
    pub checkpoints: Option<PathBuf>,
    /// Go on from a checkpoint, or from the latest one in a folder that is not after the first frame to write. It must be of
    /// this version of Eddy, this project, resolution, rate and input
    #[arg(long, value_name = "PATH", conflicts_with = "looped")]
    pub resume: Option<PathBuf>,
    /// Write PNG and EXR images without the project and its inputs in them. With them, an image opens as its frame in the window
    #[arg(long)]
    pub no_project: bool,
    /// Draw a few frames, write nothing, and tell which frames depend on which and what the tasks of an array would cost
    #[arg(long)]
    pub plan: bool,
    /// Progress on standard error
    #[arg(long, value_name = "STYLE", default_value = "auto")]
    pub progress: progress::Style,
    /// No progress, and no line that says how long a long call takes
    #[arg(long, conflicts_with = "progress")]
    pub quiet: bool,
    /// Print one JSON object per line instead of text: project, status, diagnostics, compile_ms, frame_ms, frames
    #[arg(long)]
    pub json: bool,
}

/// The form of what is written.
#[derive(Debug, Args)]
pub(crate) struct StyleArgs {
    /// png: as shown on a screen. exr: the floats of the pass. npy: float32, height x width x 4, row 0 at the bottom. gif,
    /// apng, webm, mp4, mov, mkv, y4m: a film. raw: 8-bit RGBA and nothing else [default: what --out ends in, else png, or
    /// y4m to standard output]
    #[arg(long, value_name = "FORMAT", value_parser = values::format)]
    pub format: Option<Format>,
    /// Codec of a film: h264, h265, vp9, av1, prores or ffv1 [default: mp4 h264, webm vp9, mov prores, mkv ffv1]
    #[arg(long, value_name = "CODEC", value_parser = codec)]
    pub codec: Option<Codec>,
    /// Quality of a film: low, medium, high, lossless, or the encoder's own number, of which smaller is better
    /// [default: medium]
    #[arg(long, value_name = "QUALITY", value_parser = quality)]
    pub quality: Option<Quality>,
    /// Range of a film's codes: limited or full [default: limited]
    #[arg(long, value_name = "RANGE", value_parser = range)]
    pub range: Option<ColorRange>,
    /// Resolution of a film's colour: 420 (half), which every player shows, 422 or 444 (full) [default: 420; prores 422]
    #[arg(long, value_name = "CHROMA", value_parser = chroma)]
    pub chroma: Option<Chroma>,
    /// Bits of a component: 8 or 16 for png, apng and raw, 8 or 10 for most films [default: 8; prores 10]
    #[arg(long, value_name = "BITS")]
    pub depth: Option<u32>,
    /// Write a film without the project's sound
    #[arg(long)]
    pub no_audio: bool,
}

impl RenderArgs {
    /// Returns the factor by which the width and height of pictures are enlarged when drawn.
    pub(crate) fn factor(&self) -> u32 {
        self.supersample.unwrap_or(1)
    }

    /// Returns the style of progress output.
    pub(crate) fn progress(&self) -> progress::Style {
        if self.quiet { progress::Style::None } else { self.progress }
    }

    /// Returns the inputs of the frames, or an error for an invalid script.
    pub(crate) fn inputs(&self) -> Result<ScriptedInputs, String> {
        Ok(self.run.inputs()?.with_mouse_scale(self.factor()))
    }

    /// Returns the run with the resolution at which it is drawn, and with tiles if needed.
    pub(crate) fn drawn(&self) -> RunArgs {
        let (width, height) = self.run.size;
        let size = (width.saturating_mul(self.factor()), height.saturating_mul(self.factor()));
        let tiles = match self.tile {
            Some(side) => Tiles::Always(side, self.factor()),
            None => Tiles::Large(self.factor()),
        };
        RunArgs { size, tiles, ..self.run.clone() }
    }
}

impl StyleArgs {
    pub(crate) fn of(&self, format: Format) -> Style {
        let &StyleArgs { codec, quality, range, chroma, depth, .. } = self;
        Style { format, codec, quality, range, chroma, depth }
    }
}
