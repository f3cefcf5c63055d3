//! The entry of a preset: whether its picture is the expected one, and its times.

use crate::{
    cli::{
        machine::{Machine, RunError, millis_since},
        report::Report,
    },
    engine::{BuildOptions, Engine, FrameInputs},
    lab::preset_pictures::{self, Bounds, Difference, PresetPicture},
    media,
    playback::{median, offline::Offline, trial::TrialSettings},
    project::presets,
};
use serde::Serialize;
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

/// The time after which a frame is abandoned.
const FRAME_LIMIT: Duration = Duration::from_secs(20);

/// The number of frames of a preset that are not measured, the duration of those that are, and their number.
const WARM_UP: u32 = 2;
const MEASURED: Duration = Duration::from_millis(300);
const FRAMES: std::ops::RangeInclusive<u32> = 3..=120;

/// Returns the size in pixels that frames are timed at.
pub(super) fn timed_size(is_software: bool) -> (u32, u32) {
    if is_software { (320, 180) } else { (1920, 1080) }
}

/// The result of comparing a preset's picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Verdict {
    AsExpected,
    Differs,
    /// It could not be drawn.
    #[default]
    Failed,
}

#[derive(Debug, Default, Serialize)]
pub(super) struct PresetEntry {
    pub preset: &'static str,
    pub verdict: Verdict,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
    /// The difference from the reference in steps of 1/255, and its bounds.
    mean_difference: Option<f64>,
    max_difference: Option<u8>,
    mean_bound: f64,
    max_bound: u8,
    /// The number of pixels that are infinite or not a number.
    not_finite: Option<u64>,
    /// Milliseconds of Eddy's compiler and of creating the pipelines.
    compile_ms: Option<f64>,
    /// Milliseconds of the first frame, in which some drivers compile.
    first_frame_ms: Option<f64>,
    #[serde(flatten)]
    times: Option<Times>,
}

/// The times of frames at one size.
#[derive(Debug, Serialize)]
struct Times {
    size: (u32, u32),
    frames: u32,
    /// The median of the milliseconds from the start of a frame until the device has finished it.
    frame_ms: f64,
    /// The median of the sums of the passes' milliseconds by the device's timestamps.
    gpu_ms: Option<f64>,
    /// The bytes that a frame moves at least, by its plan.
    moved_bytes: u64,
    /// The bytes per second relative to those of a copying pass of the same size.
    roofline_share: Option<f64>,
}

impl PresetEntry {
    /// Draws a preset. `copied` is the roofline in bytes per second.
    pub(super) fn measure(
        machine: &mut Machine,
        preset: &'static str,
        size: (u32, u32),
        copied: Option<f64>,
    ) -> PresetEntry {
        let bounds = preset_pictures::bounds(preset);
        let mut entry =
            PresetEntry { preset, mean_bound: bounds.mean, max_bound: bounds.max, ..PresetEntry::default() };
        let mut report = Report::new(preset);
        let done = machine.attempt(&mut report, |machine, _| {
            let (offline, picture) = entry.draw(machine)?;
            entry.compare(&picture, preset_pictures::reference(preset).as_ref(), bounds);
            entry.times = Some(times(offline.into_engine()?, size, copied)?);
            Ok(())
        });
        if done.is_none() {
            entry.verdict = Verdict::Failed;
        }
        entry.error = report.first_error();
        entry
    }

    fn draw(&mut self, machine: &mut Machine) -> Result<(Offline, PresetPicture), RunError> {
        let project = presets::load(self.preset)?.project;
        let (media, _) = media::gather(&project, None);
        let mut offline = Offline::new(&machine.gpu()?, preset_pictures::SIZE, preset_pictures::inputs())?;
        offline.set_frame_limit(Some(FRAME_LIMIT));
        // The driver's own compiler may need a while here: the report says how long.
        let trials = TrialSettings::of_this_program(Some(FRAME_LIMIT * 3));
        let trial = trials.map(|trials| trials.trial(None, Arc::default()));
        offline.build(&project, &media, &BuildOptions { trial, ..BuildOptions::default() })?;
        self.compile_ms = offline.build_millis();
        let began = Instant::now();
        offline.draw()?;
        self.first_frame_ms = Some(millis_since(began));
        offline.rewind()?;
        let picture = preset_pictures::draw(&mut offline)?;
        Ok((offline, picture))
    }

    /// Compares a picture with its reference.
    pub(super) fn compare(&mut self, picture: &PresetPicture, reference: Option<&image::RgbImage>, bounds: Bounds) {
        let difference = reference.and_then(|reference| Difference::of(&picture.means, reference));
        self.mean_difference = difference.map(|difference| difference.mean);
        self.max_difference = difference.map(|difference| difference.max);
        self.not_finite = Some(picture.not_finite);
        let is_within = difference.is_some_and(|difference| difference.is_within(bounds));
        self.verdict = if is_within { Verdict::AsExpected } else { Verdict::Differs };
    }
}

/// Measures frames of a size, from frame 0 on.
fn times(mut engine: Engine, size: (u32, u32), copied: Option<f64>) -> Result<Times, RunError> {
    engine.resize(size.0, size.1)?;
    engine.reset();
    let has_stamps = engine.gpu().rasteriser().has_exact_timestamps() && engine.set_timing(true);
    let (mut frames, mut on_gpu) = (Vec::new(), Vec::new());
    let mut started = Instant::now();
    for frame in 0.. {
        let began = Instant::now();
        engine.draw(&FrameInputs::at_fixed_step(frame as i32, 60.0))?;
        engine.gpu().wait()?;
        if frame < WARM_UP {
            started = Instant::now();
            continue;
        }
        frames.push(millis_since(began));
        if let Some(passes) = has_stamps.then(|| engine.pass_times()).flatten() {
            on_gpu.push(passes.iter().map(|pass| pass.gpu_millis).sum::<f64>());
        }
        let measured = frames.len() as u32;
        if measured >= *FRAMES.end() || measured >= *FRAMES.start() && started.elapsed() >= MEASURED {
            break;
        }
    }
    let moved_bytes = engine.traffic().bytes;
    let count = frames.len() as u32;
    let frame_ms = median(frames).unwrap_or_default();
    let gpu_ms = median(on_gpu);
    let per_second = moved_bytes as f64 / (gpu_ms.unwrap_or(frame_ms).max(1e-6) / 1e3);
    let roofline_share = copied.map(|copied| per_second / copied);
    Ok(Times { size, frames: count, frame_ms, gpu_ms, moved_bytes, roofline_share })
}
