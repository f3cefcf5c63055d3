//! Shorthands for [`presets`], and measures of pictures, for the tests of filters.

use crate::support::{buffer, presets};
use eddy::{
    engine::{Engine, FrameInputs, Pixels},
    gpu::Gpu,
    project::{PassName, Project},
};

pub(crate) use presets::{all_finite, preset_with as preset};

/// Replaces a buffer's text by one that a test knows completely.
pub(crate) fn replace(project: &mut Project, name: &str, text: &str) {
    project.pass_mut(&buffer(name)).unwrap().source.text = text.into();
}

/// Replaces `old` by `new` in Common, which must contain it.
pub(crate) fn patch_common(project: &mut Project, old: &str, new: &str) {
    let common = project.common.as_mut().unwrap();
    assert!(common.text.contains(old), "Common no longer contains `{old}`");
    common.text = common.text.replace(old, new).into();
}

/// Returns an engine in which every pass can be read.
pub(crate) fn whole(gpu: &Gpu, project: &Project, size: (u32, u32)) -> Engine {
    presets::whole(gpu, project, true, size)
}

/// Returns the input of frame `frame`, with the mouse held at `at`, or never pressed.
pub(crate) fn at_frame(frame: i32, at: Option<[f32; 2]>) -> FrameInputs {
    presets::held(frame, at.map(|[x, y]| ([x.max(1.0), y], [x, y])))
}

pub(crate) fn draw(engine: &mut Engine, frames: std::ops::Range<i32>) {
    presets::draw(engine, frames, presets::untouched);
}

/// Returns an engine with all buffers of a project, after these frames.
pub(crate) fn drawn(gpu: &Gpu, project: &Project, size: (u32, u32), frames: std::ops::Range<i32>) -> Engine {
    let mut engine = whole(gpu, project, size);
    draw(&mut engine, frames);
    engine
}

pub(crate) fn read(engine: &mut Engine, name: &str) -> Pixels {
    engine.read(&buffer(name)).unwrap()
}

pub(crate) fn picture(engine: &mut Engine) -> Pixels {
    engine.read_image().unwrap()
}

/// Returns the peak signal-to-noise ratio of the colours in dB, where 1 is the peak.
pub(crate) fn psnr(a: &[[f32; 4]], b: &[[f32; 4]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let square = |(a, b): (&[f32; 4], &[f32; 4])| (0..3).map(|i| f64::from(a[i] - b[i]).powi(2)).sum::<f64>();
    let mean = a.iter().zip(b).map(square).sum::<f64>() / (3 * a.len()) as f64;
    -10.0 * mean.log10()
}

/// Returns the mean of several pictures.
pub(crate) fn mean(pictures: &[Pixels]) -> Vec<[f32; 4]> {
    let mut sum = vec![[0.0f64; 4]; pictures[0].texels.len()];
    for texels in pictures.iter().map(|p| &p.texels) {
        for (sum, texel) in sum.iter_mut().zip(texels) {
            (0..4).for_each(|i| sum[i] += f64::from(texel[i]));
        }
    }
    sum.iter().map(|t| t.map(|v| (v / pictures.len() as f64) as f32)).collect()
}
