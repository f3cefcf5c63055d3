//! Compares a project in 16 bits with itself in 32: the loss when every float format has half its width.

use super::{
    LabError, Rig, Setup,
    metrics::Norms,
    setup::{PROBE, Storage, halve},
};
use eddy_engine::{BuildError, BuildOptions, Engine, EngineError, FrameInputs, Pixels, Program};
use eddy_gpu::Gpu;
use eddy_media::MediaSet;
use eddy_project::{PassName, Project, TexelFormat};
use serde::Serialize;

/// The smallest difference that a screen of 8 bits shows.
pub const VISIBLE: f64 = 1.0 / 255.0;

/// A pass in a frame.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The name for `--pass`.
    pub pass: String,
    /// The formats of the target in each run.
    pub formats: [&'static str; 2],
    /// Counted from 0.
    pub frame: u32,
    /// The norms of all components, relative to the 32-bit run.
    pub norms: Norms,
    /// The sum of all components minus that of the 32-bit run, relative to the sum of the absolute values there.
    pub mass_drift: f64,
}

/// A comparison of both runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// The number of frames drawn.
    #[serde(skip)]
    pub frames: u32,
    /// For each pass, the frames that were requested.
    pub rows: Vec<Row>,
    /// The first frame in which a colour of the picture, from 0 to 1, differs by more than [`VISIBLE`].
    pub first_visible: Option<u32>,
    /// The largest such difference of any frame.
    pub largest: f64,
}

impl Comparison {
    /// Returns the last row of the picture, or of a pass.
    pub fn last(&self, pass: &str) -> Option<&Row> {
        self.rows.iter().rfind(|row| row.pass == pass)
    }

    /// Returns the largest L2 and the mass drift of the largest absolute value among the buffers in the last frame.
    pub fn worst(&self) -> (f64, f64) {
        let last = self.rows.iter().filter(|r| r.frame + 1 == self.frames && r.formats[0] != r.formats[1]);
        last.fold((0.0, 0.0), |(l2, drift): (f64, f64), row| {
            (l2.max(row.norms.l2), if row.mass_drift.abs() > drift.abs() { row.mass_drift } else { drift })
        })
    }
}

/// The reason why a project could not be compared.
#[derive(Debug, thiserror::Error)]
pub enum PrecisionError {
    /// An error that the author or the machine causes.
    #[error("{0}")]
    Build(BuildError),
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error("no buffer of the project has a 32-bit float format: there is nothing to store in 16 bits")]
    NoFloats,
}

/// Returns the frames in which passes are compared: 0, 1, 3, 7 … and the last.
pub fn moments(frames: u32) -> Vec<u32> {
    let mut at: Vec<u32> = (0..31).map(|n| (1u32 << n) - 1).take_while(|f| *f + 1 < frames).collect();
    at.push(frames.saturating_sub(1));
    at
}

/// Draws `frames` frames of a project with its formats and with `other`'s, which has the same passes; passes are
/// compared in the frames `at`, the picture in all frames.
pub fn compare(
    gpu: &Gpu,
    [project, other]: [&Project; 2],
    media: &MediaSet,
    size: (u32, u32),
    (frames, at): (u32, &[u32]),
    mut inputs: impl FnMut() -> FrameInputs,
) -> Result<Comparison, PrecisionError> {
    compare_run(gpu, [project, other], media, size, (frames, at), |_| Ok(inputs()))
}

/// Does the same as [`compare`], where `inputs` may change the engines before each frame.
fn compare_run(
    gpu: &Gpu,
    [project, other]: [&Project; 2],
    media: &MediaSet,
    size: (u32, u32),
    (frames, at): (u32, &[u32]),
    mut inputs: impl FnMut(&mut [Engine; 2]) -> Result<FrameInputs, EngineError>,
) -> Result<Comparison, PrecisionError> {
    let mut engines = [open(gpu, project, media, size)?, open(gpu, other, media, size)?];
    let mut result = Comparison { frames, rows: Vec::new(), first_visible: None, largest: 0.0 };
    for frame in 0..frames {
        let inputs = inputs(&mut engines)?;
        for engine in &mut engines {
            engine.draw(&inputs)?;
        }
        let [a, b] = both(&mut engines, &PassName::image())?;
        let off = largest(&a, &b);
        result.largest = result.largest.max(off);
        if off > VISIBLE && result.first_visible.is_none() {
            result.first_visible = Some(frame);
        }
        if !at.contains(&frame) {
            continue;
        }
        for (pass, other) in project.passes.iter().zip(&other.passes) {
            // An unreachable pass is not drawn.
            let Ok([a, b]) = both(&mut engines, &pass.id) else { continue };
            let formats = [pass, other].map(|p| p.formats()[0].name());
            let (reference, values) = (values(&a), values(&b));
            let sum = |v: &[f64]| v.iter().sum::<f64>();
            let size = reference.iter().map(|x| x.abs()).sum::<f64>();
            let mass_drift = if size > 0.0 { (sum(&values) - sum(&reference)) / size } else { 0.0 };
            let norms = Norms::of(&values, &reference);
            result.rows.push(Row { pass: pass.id.key().to_owned(), formats, frame, norms, mass_drift });
        }
    }
    Ok(result)
}

/// Does the same as [`compare`], with 16 bits instead of 32.
pub fn halved(
    gpu: &Gpu,
    project: &Project,
    media: &MediaSet,
    size: (u32, u32),
    frames: u32,
    mut inputs: impl FnMut() -> FrameInputs,
) -> Result<Comparison, PrecisionError> {
    halved_by(gpu, project, media, size, frames, |_| Ok(inputs()))
}

/// Does the same as [`halved`], where `inputs` may change the engines before each frame, as a recording does.
pub fn halved_by(
    gpu: &Gpu,
    project: &Project,
    media: &MediaSet,
    size: (u32, u32),
    frames: u32,
    inputs: impl FnMut(&mut [Engine; 2]) -> Result<FrameInputs, EngineError>,
) -> Result<Comparison, PrecisionError> {
    let mut half = project.clone();
    halve(&mut half);
    if half.passes.iter().zip(&project.passes).all(|(a, b)| a.formats() == b.formats()) {
        // A compile error is reported first.
        open(gpu, project, media, size)?;
        return Err(PrecisionError::NoFloats);
    }
    compare_run(gpu, [project, &half], media, size, (frames, &moments(frames)), inputs)
}

/// Returns whether the device truncates values when storing 16 bits, instead of rounding to the nearest.
pub fn cuts_off(rig: &Rig) -> Result<bool, LabError> {
    let probe =
        Setup::new("floor", (1, 1)).wants(&["empty"]).steps("empty", 1).storage(Storage::Half).built(|project| {
            if let Some(pass) = project.pass_mut(&PassName::buffer("empty")) {
                pass.source.text = PROBE.into();
                pass.settings.format = TexelFormat::R32f;
            }
        });
    // Three quarters of the last bit above 1.
    Ok(rig.after(&probe, 1, "empty")?.component(0)[0] == 1.0)
}

fn open(gpu: &Gpu, project: &Project, media: &MediaSet, size: (u32, u32)) -> Result<Engine, PrecisionError> {
    let mut engine = Engine::new(gpu.clone(), size.0, size.1)?;
    let options = BuildOptions { requested: vec![PassName::image()], skip: true, ..BuildOptions::default() };
    let built = Program::build(gpu, project, media, &options).map_err(PrecisionError::Build)?;
    engine.set_program(built.program)?;
    Ok(engine)
}

fn both(engines: &mut [Engine; 2], pass: &PassName) -> Result<[Pixels; 2], EngineError> {
    let [a, b] = engines;
    Ok([a.read(pass)?, b.read(pass)?])
}

fn values(pixels: &Pixels) -> Vec<f64> {
    pixels.texels.iter().flatten().map(|v| f64::from(*v)).collect()
}

/// Returns the largest difference of two pictures' colours as displayed.
fn largest(a: &Pixels, b: &Pixels) -> f64 {
    let shown = |v: f32| if v.is_nan() { 0.0 } else { f64::from(v.clamp(0.0, 1.0)) };
    let of = |(a, b): (&[f32; 4], &[f32; 4])| (0..3).map(|i| (shown(a[i]) - shown(b[i])).abs()).fold(0.0, f64::max);
    a.texels.iter().zip(&b.texels).map(of).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(value: f32) -> Pixels {
        Pixels { width: 2, height: 1, texels: vec![[0.5; 4], [0.5, value, 0.5, 0.0]] }
    }

    #[test]
    fn only_displayed_differences_count() {
        assert_eq!(largest(&pixels(0.25), &pixels(0.25)), 0.0);
        assert!((largest(&pixels(0.25), &pixels(0.35)) - 0.1).abs() < 1e-6);
        assert_eq!(largest(&pixels(1.5), &pixels(2.0)), 0.0);
        assert_eq!(largest(&pixels(1.0), &pixels(f32::NAN)), 1.0);
    }

    #[test]
    fn moments_double_up_to_the_last_frame() {
        assert_eq!(moments(1), [0]);
        assert_eq!(moments(10), [0, 1, 3, 7, 9]);
        assert_eq!(moments(8), [0, 1, 3, 7]);
    }
}
