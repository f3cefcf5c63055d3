//! Temporal anti-aliasing compared with plain supersampling: its resolution of a still picture, the ghosts of a moving
//! thing, and its flicker.

use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::{Norms, mean},
    reference::{
        rays::on_all_cores,
        star::{DISC, SIDE, SLOW, SPEED, Star},
    },
};
use eddy_metrics::{
    flip,
    picture::{Picture, psnr, ssim},
};
use std::sync::LazyLock;

/// The number of frames until the picture is measured: four rounds of the jitter.
const REST: u32 = 64;
/// The frame of the moving scene that is measured.
const NOW: u32 = 40;
/// The frames in a round of the jitter.
const ROUND: u32 = 16;

/// The star at rest, and with the disc in each frame from [`NOW`] on for a round. Every point is compared with these.
static STILL: LazyLock<Picture> = LazyLock::new(|| Star::STILL.picture());
static PASSING: LazyLock<Vec<Picture>> = LazyLock::new(|| passing(SPEED));
static CREEPING: LazyLock<Vec<Picture>> = LazyLock::new(|| passing(SLOW));

fn passing(speed: f64) -> Vec<Picture> {
    let frames: Vec<u32> = (NOW..NOW + ROUND).collect();
    on_all_cores(&frames, |frame| Star { frame: Some(*frame), speed }.picture())
}

/// A smaller part of the disc is not a ghost.
const FAINT: f64 = 0.01;

const METHODS: &[Method] = &[
    Method { name: "taa", title: "preset taa, by gamma", settings: &[0.5, 0.75, 1.0, 1.5, 2.5], usual: 0.75 },
    Method {
        name: "taa-narrow",
        title: "taa, one box everywhere, by gamma",
        settings: &[0.75, 1.0, 1.25, 4.0],
        usual: 0.75,
    },
    Method { name: "taa-linear", title: "taa, history read by a linear filter", settings: &[0.75], usual: 0.75 },
    Method {
        name: "taa-blind",
        title: "taa without motion vectors, by gamma",
        settings: &[0.75, 1.0, 1.25, 4.0],
        usual: 0.75,
    },
    Method { name: "one-sample", title: "taa with blend = 1: one jittered sample", settings: &[1.0], usual: 1.0 },
    Method {
        name: "supersampling",
        title: "so many samples in each frame",
        settings: &[1.0, 2.0, 4.0, 8.0, 16.0],
        usual: 4.0,
    },
];

const SCENE: &str = include_str!("../../../assets/lab/supersampling/scene.glsl");

/// Replaces the preset's own scene. Alpha identifies the object.
const SAMPLED: &str = "
void mainImage(out vec4 sampled, in vec2 fragCoord) {
    vec2 q = fragCoord + jitter(iFrame) - 0.5 * iResolution.xy;
    sampled = scene(q * 192.0 / iResolution.y, float(iFrame));
}
";

/// Returns a method's project with the star in it, at rest or with the disc moving in front of it by this number of
/// pixels per frame.
fn scene(method: &str, setting: f64, side: u32, speed: Option<f64>) -> Setup {
    let size = (side, side);
    let (moving, speed) = (u32::from(speed.is_some()), speed.unwrap_or(SPEED));
    if method == "supersampling" {
        return Setup::new("supersampling", size)
            .define("SAMPLES", setting as u32)
            .define("MOVES", moving)
            .define("DISC_SPEED", speed);
    }
    // In the units of the scene: pixels over the preset's unit, which is .7 of the width here.
    let disc = format!("vec2 cogAt(float t) {{ return vec2(-60.0 + {speed:?} * 60.0 * t, -20.0) / (0.7 * 192.0); }}");
    let setup = Setup::new("taa", size)
        .wants(&["b"])
        .text("a", format!("{SCENE}{SAMPLED}"))
        .define("MOVES", moving)
        .define("DISC_SPEED", speed)
        .edit("common", "vec2 cogAt(float t) { return vec2(-0.48 + 0.10 * sin(0.7 * t), -0.12); }", disc)
        .edit("common", "return p + vec2(0.06 * t, 0.0);", "return p;")
        .edit("common", "return q - vec2(0.06 * t, 0.0);", "return q;");
    match method {
        "taa" => setup.uniform("gamma", setting),
        // No wider than gamma, for any history.
        "taa-narrow" => setup.uniform("gamma", setting).uniform("relaxed", 0.25),
        "taa-linear" => setup.uniform("gamma", setting).flag("catmullRom", false),
        "taa-blind" => setup.uniform("gamma", setting).flag("motionVectors", false),
        _ => setup.uniform("blend", 1.0),
    }
}

fn result(method: &str) -> &'static str {
    if method == "supersampling" { "field" } else { "b" }
}

/// A still picture.
#[derive(Clone, Debug)]
pub struct Still {
    pub picture: Picture,
    /// The root mean square over all pixels of the deviation in time, over a round of the jitter.
    pub flicker: f64,
}

/// Returns the star at rest, after [`REST`] frames and another round.
pub fn rest(rig: &Rig, method: &str, setting: f64) -> Result<Still, LabError> {
    let mut running = rig.open(&scene(method, setting, SIDE as u32, None))?;
    running.frames(REST + 1)?;
    let mut frames = Vec::new();
    for _ in 0..ROUND {
        frames.push(running.read(result(method))?.picture());
        running.frames(1)?;
    }
    let values: Vec<Vec<f64>> = frames.iter().map(Picture::luma).collect();
    let deviation = |i: usize| {
        let all: Vec<f64> = values.iter().map(|v| v[i]).collect();
        let middle = mean(&all);
        mean(&all.iter().map(|v| (v - middle).powi(2)).collect::<Vec<f64>>())
    };
    let variances: Vec<f64> = (0..values[0].len()).map(deviation).collect();
    Ok(Still { picture: frames.swap_remove(0), flicker: mean(&variances).sqrt() })
}

/// The traces of a moving disc.
#[derive(Clone, Debug)]
pub struct Moving {
    /// At frame [`NOW`].
    pub picture: Picture,
    /// The remaining part of its colour in the pixels that it left this number of frames ago (1, 2 …): 1 is all. The
    /// mean over a round of the jitter, which removes most of the noise.
    pub ghost: Vec<f64>,
    /// The mean distance from the truth in the pixels that it left within the last six frames.
    pub beside: f64,
}

impl Moving {
    /// Returns the length of the tail in pixels: up to the first place with less than [`FAINT`] of the disc's colour.
    /// At most the measured length.
    pub fn tail(&self) -> f64 {
        let end = self.ghost.iter().position(|g| g.abs() < FAINT).unwrap_or(self.ghost.len());
        end as f64 * SPEED
    }
}

/// The number of frames after which the end of a tail is no longer searched.
const LONGEST: u32 = 30;

pub fn moving(rig: &Rig, method: &str, setting: f64) -> Result<Moving, LabError> {
    let mut running = rig.open(&scene(method, setting, SIDE as u32, Some(SPEED)))?;
    running.frames(NOW)?;
    let (mut ghost, mut off, mut first) = (vec![(0.0, 0.0); LONGEST as usize], Vec::new(), None);
    for (frame, truth) in (NOW..).zip(PASSING.iter()) {
        running.frames(1)?;
        let picture = running.read(result(method))?.picture();
        for (ago, (sum, all)) in (1..).zip(&mut ghost) {
            for i in Star::vacated(SPEED, frame - ago, frame - ago + 1..=frame) {
                for (c, disc) in DISC.iter().enumerate() {
                    *sum += picture.rgb[i][c] - truth.rgb[i][c];
                    *all += disc - truth.rgb[i][c];
                }
            }
        }
        let near = Star::vacated(SPEED, frame - 6, frame..=frame);
        let distance = |i: usize| (0..3).map(|c| (picture.rgb[i][c] - truth.rgb[i][c]).abs()).sum::<f64>() / 3.0;
        off.extend(near.into_iter().map(distance));
        first.get_or_insert(picture);
    }
    let ghost = ghost.into_iter().map(|(sum, all)| sum / all).collect();
    let picture = first.unwrap_or_else(|| STILL.clone());
    Ok(Moving { picture, ghost, beside: mean(&off) })
}

/// Returns the remaining part of a slow disc's colour in the pixels that its edge left [`SLOW_AGO`] frames ago, as in
/// [`Moving::ghost`].
pub fn slow_ghost(rig: &Rig, method: &str, setting: f64) -> Result<f64, LabError> {
    let mut running = rig.open(&scene(method, setting, SIDE as u32, Some(SLOW)))?;
    running.frames(NOW)?;
    let (mut left, mut all) = (0.0, 0.0);
    for (frame, truth) in (NOW..).zip(CREEPING.iter()) {
        running.frames(1)?;
        let picture = running.read(result(method))?.picture();
        for i in Star::left_ago(SLOW, frame, SLOW_AGO) {
            for (c, disc) in DISC.iter().enumerate() {
                left += picture.rgb[i][c] - truth.rgb[i][c];
                all += disc - truth.rgb[i][c];
            }
        }
    }
    Ok(left / all)
}

/// The number of frames after which a slow edge should have taken its colour along.
const SLOW_AGO: u32 = 4;

pub static STUDY: Study = Study {
    name: "taa",
    title: "Temporal anti-aliasing",
    text: "A Siemens star of 72 rays and a hairline, .36 and .64 bright, 192 x 192, at frame 64, and a light \
           disc that crosses them by 2.37 pixels a frame, at frame 40; the truth is the mean of 8 x 8 samples \
           a pixel in f64. Errors are those of colours as a screen shows them, of the resting picture. Of the \
           moving one the table gives PSNR and FLIP, and how much of the disc's colour is left where it was \
           six frames ago at most, and how many pixels behind it 1 % of it is left. slow_ghost is the part of \
           its colour that is left four frames after its edge, where it moves by .35 pixels a frame. Flicker is \
           the deviation in time over a round of the jitter. Hard cases: 31 dB at rest; no more than .02 \
           flicker; a tail of at most 24 pixels.",
    parameter: "gamma, or samples",
    unit: Unit::Frame,
    error: "of the resting picture",
    methods: METHODS,
    grids: [[48, 96, SIDE as u32]; 2],
    // The truth is that of one canvas.
    has_order: false,
    ..Study::of(|point| scene(&point.method, point.setting, point.grid, Some(SPEED)), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let (still, truth) = (&*STILL, &PASSING[0]);
    let rest = rest(rig, &point.method, point.setting)?;
    let moving = moving(rig, &point.method, point.setting)?;
    let off = psnr(&rest.picture, still);
    let norms = Norms::of(&rest.picture.values(), &still.values());
    Ok(Measured { norms, frames_per_unit: 1.0, ..Measured::default() }
        .value("psnr_db", off)
        .value("ssim", ssim(&rest.picture, still))
        .value("flip", flip::mean(&rest.picture, still))
        .value("flicker", rest.flicker)
        .value("moving_psnr_db", psnr(&moving.picture, truth))
        .value("moving_ssim", ssim(&moving.picture, truth))
        .value("moving_flip", flip::mean(&moving.picture, truth))
        .value("ghost", moving.beside)
        .value("ghost_px", moving.tail())
        .value("slow_ghost", slow_ghost(rig, &point.method, point.setting)?)
        // A root mean square of 10^(-31 / 20).
        .hard(HardCase::at_most("31 dB at rest", 10f64.powf(-off / 20.0), 0.0282))
        .hard(HardCase::at_most("flicker", rest.flicker, 0.02))
        .hard(HardCase::at_most("tail, pixels", moving.tail(), 24.0)))
}
