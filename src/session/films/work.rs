//! The film thread: draws a range of frames, and completes live recordings.

use super::{
    FilmDone, FilmOrder, FilmProgress, FilmStage,
    audio::{FilmSoundPass, HeardSounds},
    target::{Pictures, Target},
};
use eddy_background::Control;
use eddy_engine::{BuildOptions, Pixels, Trial};
use eddy_film::{
    Cancel, Encoding, Fade, FilmSound, FilmTime, Rate, Seam, Shape, ShownPass, Still, Writer, check_tools, has_sound,
    soundtrack,
};
use eddy_gpu::Gpu;
use eddy_media::{self as media, MediaSet};
use eddy_playback::{
    comparing::first_error,
    frames::steps,
    offline::{Offline, OfflineError},
    scene::RunSource,
    script::ScriptedInputs,
};
use eddy_project::{PassName, Project};
use eddy_video::Tools;
use std::{
    path::PathBuf,
    time::{Duration, Instant},
};

/// The minimum interval of progress reports.
const REPORT_EVERY: Duration = Duration::from_millis(100);

pub(super) enum Work {
    Range(Box<RangeJob>),
    Finish(Box<Finish>),
    /// Removes a cancelled recording.
    Discard(Box<Finish>),
}

/// A range of frames of a project as it was when the film was requested.
pub(super) struct RangeJob {
    pub gpu: Gpu,
    pub project: Project,
    pub pass: PassName,
    pub media_dir: Option<PathBuf>,
    pub trial: Option<Trial>,
    /// Pictures embed the project.
    pub with_project: bool,
    pub order: FilmOrder,
    pub target: Target,
    pub cancel: Cancel,
}

/// A recording that has all its frames. Dropping it removes everything: first the writer ends, then its pictures are
/// removed.
pub(super) struct Finish {
    pub writer: Option<Writer>,
    pub pictures: Option<Pictures>,
    pub waiting: Vec<Pixels>,
    /// Frames that the writer has accepted.
    pub pushed: u32,
    pub target: Target,
    pub rate: Rate,
    pub sound: Option<LateSound>,
}

/// The sound of a recording, computed after all frames are drawn.
pub(super) struct LateSound {
    pub gpu: Gpu,
    pub trial: Option<Trial>,
    pub heard: HeardSounds,
}

impl LateSound {
    /// Returns the samples of a film of this many frames; `None` if it is silent.
    fn samples(
        self,
        frames: u32,
        rate: Rate,
        control: &Control<FilmProgress>,
    ) -> Result<Option<Vec<[i16; 2]>>, Stopped> {
        let Self { gpu, trial, heard } = self;
        let open = |pass: &FilmSoundPass| {
            let gpu = gpu.for_background();
            let mut offline = Offline::new(&gpu, (16, 16), ScriptedInputs::new(60.0)).map_err(OfflineError::from)?;
            offline.set_sound_date(pass.date);
            let options = BuildOptions { trial: trial.clone(), ..BuildOptions::sound() };
            offline.build(&pass.project, &pass.media, &options).map_err(|error| Stopped(first_error(&error)))?;
            Ok(offline)
        };
        heard.samples(frames, rate, open, || Ok(control.check()?))
    }
}

/// Returns the thread's function.
pub(super) fn work() -> impl FnMut(Work, &Control<FilmProgress>) -> Result<FilmDone, String> + Send {
    let mut is_background = false;
    move |work, control| match work {
        Work::Range(job) => {
            if !std::mem::replace(&mut is_background, true) {
                job.gpu.rasteriser().lower_background_priority();
            }
            draw(*job, control)
        }
        Work::Finish(finish) => complete(*finish, control),
        Work::Discard(finish) => {
            drop(finish);
            Err("cancelled".into())
        }
    }
}

fn complete(mut finish: Finish, control: &Control<FilmProgress>) -> Result<FilmDone, String> {
    let frames = finish.pushed + finish.waiting.len() as u32;
    control.report(FilmProgress { stage: FilmStage::Completing, done: frames, of: frames, left: None });
    let mut writer = finish.writer.take().ok_or("no frame was drawn while it was recorded")?;
    for (n, pixels) in finish.waiting.drain(..).enumerate() {
        control.check()?;
        let path = finish.target.picture(finish.pushed + n as u32, super::live::LAST);
        if let Some(pictures) = &mut finish.pictures {
            pictures.note(&path);
        }
        writer.push(Some(path), pixels, None).map_err(|error| error.to_string())?;
    }
    let mut note = None;
    if let Some(sound) = finish.sound.take() {
        match sound.samples(frames, finish.rate, control) {
            Ok(Some(samples)) => writer.sound(samples).map_err(|error| error.to_string())?,
            Ok(None) => {}
            Err(Stopped(why)) => {
                control.check()?;
                // The frames cannot be drawn again, so the film is kept without sound.
                note = Some(format!("it has no sound: {why}"));
            }
        }
    }
    writer.finish().map_err(|error| error.to_string())?;
    still_wanted(control, &finish.target)?;
    if let Some(pictures) = finish.pictures.take() {
        pictures.keep();
    }
    let secs = f64::from(frames) / finish.rate.per_second();
    Ok(FilmDone { path: finish.target.path().to_owned(), frames, secs, note })
}

/// Removes a film that was cancelled just as it was completed.
fn still_wanted(control: &Control<FilmProgress>, target: &Target) -> Result<(), String> {
    if control.is_cancelled() {
        target.discard();
    }
    control.check()
}

/// The reason why a range is not drawn, as a sentence.
pub(super) struct Stopped(pub String);

impl From<OfflineError> for Stopped {
    fn from(error: OfflineError) -> Self {
        Stopped(error.to_string())
    }
}

impl From<String> for Stopped {
    fn from(why: String) -> Self {
        Stopped(why)
    }
}

fn draw(job: RangeJob, control: &Control<FilmProgress>) -> Result<FilmDone, String> {
    let pictures = Pictures::new(&job.target);
    let mut drawing = Drawing { job, control, pictures, reported_at: None, began: None };
    let done = drawing.run().map_err(|Stopped(why)| why)?;
    still_wanted(control, &drawing.job.target)?;
    if let Some(pictures) = drawing.pictures {
        pictures.keep();
    }
    Ok(done)
}

/// The state while a range is drawn.
struct Drawing<'a> {
    job: RangeJob,
    control: &'a Control<FilmProgress>,
    pictures: Option<Pictures>,
    reported_at: Option<Instant>,
    /// The time at which the first frame was done, which took longer or shorter than the others.
    began: Option<Instant>,
}

impl Drawing<'_> {
    fn run(&mut self) -> Result<FilmDone, Stopped> {
        let order = self.job.order.clone();
        let frames = order.frames.clone().unwrap_or_default();
        let (Some(&first), Some(&last)) = (frames.first(), frames.last()) else {
            return Err("there is no frame to draw".to_owned().into());
        };
        let count = frames.len() as u32;
        self.control.report(FilmProgress { of: count, ..FilmProgress::default() });
        check_tools(&order.encoding, order.size, &Tools::default()).map_err(|error| error.to_string())?;
        let gpu = self.job.gpu.for_background();
        let (media, _) = media::gather(&self.job.project, self.job.media_dir.as_deref());
        let mut offline = self.open(&gpu, &media, self.job.pass.clone())?;
        let has_state = offline.has_state().map_err(OfflineError::from)?;
        let source = self.source(&offline, has_state)?;
        let shown = ShownPass { pass: self.job.pass.clone(), layer: 0, factor: 1 };
        let mut seam = match order.fade_secs {
            Some(secs) => {
                let fade = self.fade(secs, count)?;
                let open = || self.open(&gpu, &media, self.job.pass.clone());
                Some(Seam::open(fade, &frames, open, || Ok(self.control.check()?))?)
            }
            None => None,
        };
        let mut writer: Option<Writer> = None;
        let draws = if has_state { last + 1 } else { count };
        let (mut drawn, mut done) = (0, 0);
        for step in steps(0..last + 1, &frames, !has_state) {
            self.control.check()?;
            if step.is_skipped {
                offline.skip().map_err(OfflineError::from)?;
                continue;
            }
            drawn += 1;
            if !step.is_wanted {
                offline.advance()?;
            } else {
                offline.draw()?;
                let pixels = shown.read(&mut offline)?;
                let pixels = match &mut seam {
                    Some(seam) => seam.join(pixels, |later| shown.read(later))?,
                    None => pixels,
                };
                let writer = match &mut writer {
                    Some(writer) => writer,
                    None => {
                        let sound = self.sound(&gpu, &media, (first, count))?;
                        writer.insert(self.writer(&offline, &pixels, count, sound.as_deref())?)
                    }
                };
                let path = self.job.target.picture(step.frame, last);
                if let Some(pictures) = &mut self.pictures {
                    pictures.note(&path);
                }
                let scene = source.as_ref().map(|source| source.scene(step.frame));
                writer.push(Some(path), pixels, scene).map_err(|error| error.to_string())?;
                done += 1;
            }
            self.tell(done, count, (drawn, draws));
        }
        self.control.report(FilmProgress { stage: FilmStage::Completing, done, of: count, left: None });
        if let Some(writer) = writer {
            writer.finish().map_err(|error| error.to_string())?;
        }
        let note = seam.and_then(Seam::verdict).map(|(_, what)| what);
        let secs = f64::from(count) / order.rate.per_second();
        Ok(FilmDone { path: self.job.target.path().to_owned(), frames: count, secs, note })
    }

    fn fade(&self, secs: f64, count: u32) -> Result<Fade, String> {
        Fade::new(secs, self.job.project.info.period, self.job.order.rate, count)
    }

    /// Sets up a run of the project that draws a pass.
    fn open(&self, gpu: &Gpu, media: &MediaSet, pass: PassName) -> Result<Offline, Stopped> {
        let RangeJob { project, order, trial, .. } = &self.job;
        let inputs = ScriptedInputs::new(order.fps);
        let mut offline = Offline::new(gpu, order.size, inputs).map_err(OfflineError::from)?;
        let options = BuildOptions { requested: vec![pass], trial: trial.clone(), ..BuildOptions::default() };
        offline.build(project, media, &options).map_err(|error| Stopped(first_error(&error)))?;
        Ok(offline)
    }

    /// Returns what pictures embed, as `eddy render` writes it.
    fn source(&self, offline: &Offline, has_state: bool) -> Result<Option<RunSource>, Stopped> {
        let RangeJob { project, pass, order, with_project, .. } = &self.job;
        let has_place = matches!(order.encoding, Encoding::Still(Still::Png { .. } | Still::Exr));
        if !has_place || !with_project {
            return Ok(None);
        }
        Ok(Some(RunSource {
            project: project.clone(),
            pass: pass.clone(),
            device: offline.engine().map_err(OfflineError::from)?.gpu().describe(),
            has_state,
            size: order.size,
            inputs: ScriptedInputs::new(order.fps),
        }))
    }

    fn sound(&self, gpu: &Gpu, media: &MediaSet, (first, count): (u32, u32)) -> Result<Option<Vec<[i16; 2]>>, Stopped> {
        let RangeJob { project, order, .. } = &self.job;
        let holds_sound = matches!(&order.encoding, Encoding::Film(film) if film.holds_sound());
        if !holds_sound || !order.with_sound || !has_sound(project, media) {
            return Ok(None);
        }
        let fade_secs = match order.fade_secs {
            Some(secs) => self.fade(secs, count)?.secs,
            None => 0.0,
        };
        let time = FilmTime { first, fps: order.fps, count, rate: order.rate, fade_secs };
        let open = || self.open(gpu, media, PassName::sound());
        soundtrack((project, media), &time, open, || Ok(self.control.check()?))
    }

    fn writer(
        &self,
        offline: &Offline,
        pixels: &Pixels,
        count: u32,
        sound: Option<&[[i16; 2]]>,
    ) -> Result<Writer, Stopped> {
        let RangeJob { pass, order, target, cancel, .. } = &self.job;
        let texels = offline.engine().map_err(OfflineError::from)?.format(pass, 0).unwrap_or_default();
        let shape = Shape { width: pixels.width, height: pixels.height, rate: order.rate, frames: Some(count) };
        let sound = sound.map_or(FilmSound::None, FilmSound::Known);
        let started = Writer::start(&order.encoding, shape, texels, sound, target.destination(), cancel);
        started.map_err(|error| Stopped(error.to_string()))
    }

    /// Reports the progress, at intervals.
    fn tell(&mut self, done: u32, of: u32, (drawn, draws): (u32, u32)) {
        let now = Instant::now();
        let since = *self.began.get_or_insert(now);
        if self.reported_at.is_some_and(|reported_at| now.duration_since(reported_at) < REPORT_EVERY) && done != of {
            return;
        }
        self.reported_at = Some(now);
        let left = left(now.duration_since(since), drawn.saturating_sub(1), draws.saturating_sub(drawn));
        self.control.report(FilmProgress { stage: FilmStage::Drawing, done, of, left });
    }
}

/// Returns the estimated time of the remaining frames, from that of the others.
fn left(took: Duration, drawn: u32, to_draw: u32) -> Option<Duration> {
    (drawn > 0).then(|| took.mul_f64(f64::from(to_draw) / f64::from(drawn)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remaining_time_is_estimated_from_drawn_frames() {
        assert_eq!(left(Duration::from_secs(3), 0, 9), None, "one frame tells nothing");
        assert_eq!(left(Duration::from_secs(3), 10, 90), Some(Duration::from_secs(27)));
    }
}
