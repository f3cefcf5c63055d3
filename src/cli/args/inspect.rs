//! Commands that inspect a project.

use super::{
    run::RunArgs,
    values::{PROJECT, Picture, face, face_of, picture, picture_format, pixel, png_file, values_file},
};
use crate::{
    cli::text_place::TextPlace,
    debugger::{divergence::MAX_PROBES, trace::STEPS},
    playback::capture::Format,
    project::{self, PassName, Tab},
};
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(crate) struct ProbeArgs {
    pub project: String,
    /// Position of the expression: tab, line and column, as in image:12:9 or common:3:14. Picks the innermost
    /// expression there; at a declaration, the initial value of the variable
    #[arg(value_name = "TAB:LINE:COLUMN", value_parser = TextPlace::parse)]
    pub at: TextPlace,
    /// The pass to draw [default: the pass of the tab; for Common: image]
    #[arg(long, value_name = "NAME", value_parser = picture)]
    pub pass: Option<Picture>,
    /// The face of a cubemap to draw, with --pass cube_a: +x, -x, +y, -y, +z or -z [default: +x]
    #[arg(long, value_name = "FACE", value_parser = face, allow_hyphen_values = true)]
    pub face: Option<usize>,
    /// Which evaluation in a pixel to read: 0 is the first
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..1 << 31))]
    pub visit: u32,
    /// Print the value at this pixel, counted from the bottom left
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pub pixel: Option<(u32, u32)>,
    /// The frame to draw, counted from 0; all frames before it are drawn first
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..1 << 30))]
    pub frame: u32,
    /// Write the values of all pixels to this .npy or .png file; with --format alone, to STEM_TAB_LINE_COLUMN.npy in
    /// the current folder, unless it exists. Scalars have three equal components, and the fourth is 1 where the value
    /// has fewer; a pixel in which the expression is not evaluated has NaN
    #[arg(long, value_name = "PATH", value_parser = values_file)]
    pub out: Option<PathBuf>,
    /// png: 8 bits, as shown on a screen. npy: float32, height x width x 4, row 0 at the bottom
    /// [default: what --out ends in, else npy]
    #[arg(long, value_name = "png|npy", value_parser = picture_format)]
    pub format: Option<Format>,
    #[command(flatten)]
    pub run: RunArgs,
    /// Print one JSON object per line instead of text
    #[arg(long)]
    pub json: bool,
}

impl ProbeArgs {
    /// Returns the pass that is drawn.
    pub(crate) fn pass(&self) -> PassName {
        match (&self.pass, &self.at.tab) {
            (Some(pass), _) => pass.pass.clone(),
            (None, Tab::Pass(pass)) => pass.clone(),
            (None, _) => PassName::image(),
        }
    }

    /// Returns the face of a cubemap that is drawn; 0 for any other pass.
    pub(crate) fn face(&self) -> Result<usize, String> {
        face_of(&self.pass(), self.face)
    }

    /// The file of the values, if one is requested.
    pub(crate) fn file(&self) -> Option<PathBuf> {
        let TextPlace { tab, line, column } = &self.at;
        let tab = tab.pass().map_or("common", PassName::key);
        let named = |format: Format| {
            let stem = project::stem(&self.project);
            PathBuf::from(format!("{stem}_{tab}_{line}_{column}.{}", format.extension()))
        };
        self.out.clone().or_else(|| self.format.map(named))
    }

    /// Returns the format of the file: the requested one, or that of its extension.
    pub(crate) fn format(&self) -> Result<Format, String> {
        let ending = self.out.as_ref().and_then(|path| path.extension());
        let named = ending.map(|e| if e.eq_ignore_ascii_case("png") { Format::Png } else { Format::Npy });
        match (named, self.format) {
            (Some(named), Some(asked)) if named != asked => Err(format!(
                "--out {} and --format {} do not agree",
                self.out.as_deref().unwrap_or(Path::new("")).display(),
                asked.extension()
            )),
            (named, asked) => Ok(named.or(asked).unwrap_or(Format::Npy)),
        }
    }
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(crate) struct TraceArgs {
    #[arg(required = true)]
    pub project: Vec<String>,
    /// The pixel to trace, counted from the bottom left
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    #[arg(required_unless_present = "nonfinite")]
    pub pixel: Option<(u32, u32)>,
    /// Find the first texel of any pass that is NaN or infinite, in the frames up to --frame, and print the operation
    /// that produced it
    #[arg(long, conflicts_with_all = ["pixel", "pass"])]
    pub nonfinite: bool,
    /// The frame to draw, counted from 0; all frames before it are drawn first
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..1 << 30))]
    pub frame: u32,
    /// The pass to trace: image, buffer_a, a further buffer's name …
    #[arg(long, value_name = "NAME", default_value = "image", value_parser = picture)]
    pub pass: Picture,
    /// The face of a cubemap to trace, with --pass cube_a: +x, -x, +y, -y, +z or -z [default: +x]
    #[arg(long, value_name = "FACE", value_parser = face, allow_hyphen_values = true)]
    pub face: Option<usize>,
    #[command(flatten)]
    pub run: RunArgs,
    /// Stop after this number of statements
    #[arg(long, value_name = "N", default_value_t = STEPS)]
    pub max_statements: u64,
    /// If the CPU and GPU values differ, search for the first assignment that differs, with at most this number of
    /// probes, each of which compiles a program; 0 disables the search
    #[arg(long, value_name = "N", default_value_t = MAX_PROBES)]
    pub probes: usize,
    /// Print at most this number of steps [default: as many as 256 MiB hold]
    #[arg(long, value_name = "N")]
    pub max_steps: Option<usize>,
    /// Print one JSON object per line instead of text
    #[arg(long)]
    pub json: bool,
}

impl TraceArgs {
    /// Returns the face of a cubemap that is traced; 0 for any other pass.
    pub(crate) fn face(&self) -> Result<usize, String> {
        face_of(&self.pass.pass, self.face)
    }
}

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(crate) struct CompareArgs {
    /// The project to compare
    pub project: String,
    /// The reference project
    #[arg(required_unless_present = "revision")]
    pub reference: Option<String>,
    /// Compare with the same project at this revision of its git repository
    #[arg(long, value_name = "REVISION", conflicts_with = "reference")]
    pub revision: Option<String>,
    /// The frame to draw, counted from 0; all frames before it are drawn first
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u32).range(..1 << 30))]
    pub frame: u32,
    /// The pass to compare: image, buffer_a, a further buffer's name …; scene:1 is target 1 of a pass that has several
    #[arg(long, value_name = "NAME", default_value = "image", value_parser = picture)]
    pub pass: Picture,
    /// Write both pictures to this .png file
    #[arg(long, value_name = "PATH", value_parser = png_file)]
    pub out: Option<PathBuf>,
    /// side: side by side. wipe: left half of one, right half of the other. difference: absolute difference per
    /// component. flip: the FLIP metric, from black to white
    #[arg(long, value_name = "VIEW", default_value = "side")]
    pub view: CompareView,
    /// Number of timed runs of both projects; 0 disables timing
    #[arg(long, value_name = "N", default_value_t = 9, value_parser = clap::value_parser!(u32).range(..=1 << 20))]
    pub repeats: u32,
    #[command(flatten)]
    pub run: RunArgs,
    /// Print one JSON object per line instead of text
    #[arg(long)]
    pub json: bool,
}

/// The ways to show two pictures in one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum CompareView {
    Side,
    Wipe,
    Difference,
    Flip,
}
