//! Films: live recordings of what the window draws, and ranges of frames that are drawn exactly.
//!
//! Owns the form of the choices ([`form`]), the live recording ([`live`]) with its sound ([`heard`]), the thread that
//! draws a range and completes files ([`work`]), and the files' places ([`target`]). One film is made at a time.

mod audio;
mod form;
mod live;
mod order;
mod target;
mod words;
mod work;

pub(super) use audio::FilmSoundPass;
pub use form::{CheckedForm, FilmFacts, FilmField, FilmForm, FilmPreset};
pub use order::{FilmDone, FilmOrder, FilmPlace, FilmProgress, FilmStage, FilmView, LiveView};

use super::{
    Session,
    canvas::CanvasSize,
    command::{PendingAction, Question},
    drawing::Tasks,
    open_project::OpenProject,
    view::{About, Level},
};
use audio::FilmAudio;
use eddy_background::{Background, Status, Wake};
use eddy_film::{Cancel, FilmError};
use eddy_gpu::Gpu;
use eddy_playback::capture;
use eddy_video::Tools;
use live::Live;
use std::{
    sync::Arc,
    time::{Duration, Instant},
};
use target::Target;
use work::{Finish, LateSound, RangeJob, Work};

/// The film in progress, and the newest finished one.
pub(super) struct Films {
    live: Option<Live>,
    work: Background<Work, FilmProgress, FilmDone>,
    /// Kills the encoder of the work.
    cancel: Cancel,
    /// Queries the encoders of ffmpeg.
    tools: Background<(), (), Vec<String>>,
    encoders: Option<Result<Vec<String>, String>>,
    ended: Option<Ended>,
    /// The window closes when the film is complete.
    closes: bool,
}

enum Ended {
    Done(FilmDone),
    Failed(String),
    Cancelled,
}

impl Films {
    pub(crate) fn new(wake: &Wake) -> std::io::Result<Self> {
        let look = |(), _: &_| Tools::default().encoders().map_err(|error| FilmError::from(error).to_string());
        Ok(Self {
            live: None,
            work: Background::new("film", "the film", wake.clone(), work::work())?,
            cancel: Cancel::default(),
            tools: Background::new("encoders", "the look for encoders", wake.clone(), look)?,
            encoders: None,
            ended: None,
            closes: false,
        })
    }

    /// Returns whether a film is not complete yet.
    pub(crate) fn is_busy(&self) -> bool {
        self.live.is_some() || self.work.is_under_way()
    }

    pub(crate) fn is_live(&self) -> bool {
        self.live.is_some()
    }

    /// Returns whether the next frame of the running picture may be drawn.
    pub(crate) fn may_draw(&self, now: Instant) -> bool {
        self.live.as_ref().is_none_or(|live| live.may_draw(now))
    }

    /// Returns whether no frame waits for the encoder.
    pub(crate) fn has_room(&self) -> bool {
        self.live.as_ref().is_none_or(Live::has_room)
    }

    /// Returns when the next frame is due; `None`: as soon as it can be drawn.
    pub(crate) fn due(&self) -> Option<Instant> {
        self.live.as_ref()?.pace.due()
    }

    /// Returns when to poll again.
    pub(crate) fn deadline(&self, now: Instant) -> Option<Instant> {
        self.live.as_ref()?.deadline(now)
    }

    /// Sets whether the next frame advances time, by playing or by a step.
    pub(crate) fn note_frame(&mut self, is_new: bool, now: Instant) {
        if let Some(live) = &mut self.live {
            live.note(is_new, now);
        }
    }

    /// Cancels everything, and waits for the end, up to `patience`. Returns whether the thread does not end.
    pub(crate) fn end(&mut self, patience: Duration) -> bool {
        self.cancel.cancel();
        self.live = None;
        self.tools.leave();
        !self.work.end(patience)
    }
}

impl Films {
    /// Returns whether the window closes when the film is complete.
    pub(crate) fn closes(&self) -> bool {
        self.closes
    }

    /// Returns the facts that a film's form is validated against. `gpu`: the window's device.
    pub(crate) fn facts(&self, open: &OpenProject, gpu: &Gpu) -> FilmFacts {
        let project = open.project();
        FilmFacts {
            shown: open.engine.size(),
            most_side: gpu.device.limits().max_texture_dimension_2d,
            folder: capture::folder_for(project, &open.host.options.pictures),
            period: project.info.period,
            encoders: self.encoders.clone(),
        }
    }

    /// Returns whether the encoders of ffmpeg are being queried.
    pub(crate) fn looks_for_encoders(&self) -> bool {
        self.tools.is_busy()
    }
}

impl Session {
    /// Returns the film in progress, or the newest finished one; `None` if there was none.
    pub fn film(&self) -> Option<FilmView<'_>> {
        let films = &self.services.films;
        if let Some(live) = &films.live {
            let frames = live.frames();
            return Some(FilmView::Live(LiveView {
                frames,
                secs: f64::from(frames) / live.order.rate.per_second(),
                speed: live.pace.speed(),
                waits: !live.has_room(),
                is_paused: !self.open.playback.is_running(),
            }));
        }
        if let Some(Status::UnderWay(progress)) = films.work.status() {
            return Some(FilmView::UnderWay(progress));
        }
        Some(match films.ended.as_ref()? {
            Ended::Done(done) => FilmView::Done(done),
            Ended::Failed(why) => FilmView::Failed(why),
            Ended::Cancelled => FilmView::Cancelled,
        })
    }

    pub(super) fn find_encoders(&mut self) {
        if !self.services.films.tools.is_busy() {
            self.services.films.tools.start(());
        }
    }

    /// Starts a film.
    pub(super) fn start_film(&mut self, order: FilmOrder) {
        self.open.dismiss_notices(About::Film);
        if self.services.films.is_busy() {
            return self.open.notice_about(
                About::Film,
                Level::Warning,
                "a film is being made: stop or cancel it first",
            );
        }
        match self.open.film_target(&order) {
            Err(why) => self.open.notice_about(About::Film, Level::Error, why),
            Ok(target) if order.frames.is_some() => self.draw_range(order, target),
            Ok(target) => self.record_film(order, target),
        }
    }

    /// Draws a range of the project as it is now, in the background.
    fn draw_range(&mut self, order: FilmOrder, target: Target) {
        if self.open.halt.is_held() {
            let text = "nothing of this project is drawn before you play it: play it, then render it";
            return self.open.notice_about(About::Film, Level::Warning, text);
        }
        let gpu = match self.services.drawing.device().wait() {
            Ok(gpu) => gpu,
            Err(error) => return self.open.notice_about(About::Film, Level::Error, error.to_string()),
        };
        self.open.settle_includes();
        let media_dir = self.open.host.options.media_dir.clone();
        self.services.films.cancel = Cancel::default();
        self.services.films.ended = None;
        self.services.films.work.start(Work::Range(Box::new(RangeJob {
            gpu,
            project: self.open.documents.current().clone(),
            pass: self.open.picture.shown.clone(),
            trial: self.open.host.options.trials.as_ref().map(|trials| trials.trial(media_dir.clone(), Arc::default())),
            media_dir,
            with_project: self.services.captures.with_project,
            order,
            target,
            cancel: self.services.films.cancel.clone(),
        })));
    }

    /// Starts recording what is drawn, at the film's size and rate.
    fn record_film(&mut self, order: FilmOrder, target: Target) {
        self.open.end_replay("a film is recorded");
        let before = (self.open.canvas.requested, self.open.playback.clock.fixed_rate());
        if order.size != self.open.engine.size() || self.open.canvas.requested.fixed.is_none() {
            self.open.request_size(CanvasSize { fixed: Some(order.size), ..self.open.canvas.requested });
        }
        self.open.playback.clock.set_fixed_rate(Some(order.fps));
        self.services.films.ended = None;
        self.services.films.live = Some(Live::new(order, target, before));
        self.open.play();
    }

    /// Ends a recording, and completes its film.
    pub(super) fn stop_film(&mut self) {
        let Some(mut live) = self.end_live() else { return };
        if live.frames() == 0 {
            self.services.films.ended = Some(Ended::Failed("no frame was drawn while it was recorded".into()));
            return;
        }
        self.services.films.cancel = live.cancel.clone();
        let sound = self.late_sound(&mut live);
        self.services.films.work.start(Work::Finish(Box::new(Finish { sound, ..live.finish() })));
    }

    /// Returns the data from which the sound of a recording is computed; `None` if it is silent, or there is no device.
    fn late_sound(&self, live: &mut Live) -> Option<LateSound> {
        let heard = live.heard.take()?;
        let gpu = self.services.drawing.device().wait().ok()?;
        let trials = self.open.host.options.trials.as_ref();
        let trial = trials.map(|trials| trials.trial(self.open.host.options.media_dir.clone(), Arc::default()));
        Some(LateSound { gpu, trial, heard })
    }

    /// Records the sound of a frame with this time.
    pub(super) fn note_heard(&mut self, secs: f64) {
        let Some(heard) = self.services.films.live.as_mut().and_then(|live| live.heard.as_mut()) else { return };
        let (music, number) = (self.services.audio.music(), self.services.sound_pass.number());
        heard.note(secs, (number, music), || FilmAudio::new(music, self.services.sound_pass.heard()));
    }

    /// Ends the recording, and restores the picture's size and rate.
    fn end_live(&mut self) -> Option<Live> {
        let live = self.services.films.live.take()?;
        let (size, rate) = live.before;
        // The user may have chosen others meanwhile.
        if self.open.canvas.requested.fixed == Some(live.order.size) {
            self.open.request_size(size);
        }
        if self.open.playback.clock.fixed_rate() == Some(live.order.fps) {
            self.open.playback.clock.set_fixed_rate(rate);
        }
        self.open.host.changed = true;
        Some(live)
    }

    /// Cancels the film in progress, and removes its files.
    pub(super) fn cancel_film(&mut self) {
        self.services.films.closes = false;
        if !self.services.films.is_busy() {
            return;
        }
        self.services.films.cancel.cancel();
        self.services.films.work.cancel();
        if let Some(live) = self.end_live() {
            live.cancel.cancel();
            self.services.films.work.start(Work::Discard(Box::new(live.finish())));
            self.services.films.work.cancel();
        }
        self.services.films.ended = Some(Ended::Cancelled);
    }

    /// Ends a recording that gets no further frames. The frames so far are completed to a film.
    pub(super) fn cut_film(&mut self, why: &str) {
        if self.services.films.is_live() {
            self.open.notice_about(About::Film, Level::Warning, format!("the film ends here: {why}"));
            self.stop_film();
        }
    }

    /// The drawing device is lost, and a frame in flight with it.
    pub(super) fn film_lost_device(&mut self) {
        if self.services.films.live.as_mut().is_some_and(Live::lose_frame) {
            self.cut_film("the GPU did not give back a frame");
        }
    }

    /// Adds the read-back of a frame of the film.
    pub(super) fn request_film_frame(&mut self, tasks: &mut Tasks) {
        let pass = self.open.pictured();
        if let Some(live) = &mut self.services.films.live {
            live.request(pass, tasks);
        }
    }

    /// Passes frames that were read to the encoder.
    pub(super) fn feed_film(&mut self) {
        let is_running = self.open.playback.is_running();
        let Some(live) = &mut self.services.films.live else { return };
        if !is_running {
            live.pace.wait_idle();
        }
        let before = live.frames();
        let fed = live.feed();
        self.open.host.changed |= self.services.films.live.as_ref().is_some_and(|live| live.frames() != before);
        if let Err(why) = fed {
            match self.services.films.live.as_ref().map_or(0, Live::frames) {
                0 => {
                    self.cancel_film();
                    self.film_failed(why);
                }
                _ => self.cut_film(&why),
            }
        }
    }

    fn film_failed(&mut self, why: String) {
        self.open.notice_about(About::Film, Level::Error, format!("Film not saved: {why}"));
        self.services.films.ended = Some(Ended::Failed(why));
    }

    /// Takes results of the threads.
    pub(super) fn tick_film(&mut self) {
        self.feed_film();
        if let Some(found) = self.services.films.tools.take() {
            self.services.films.encoders = Some(found);
            self.open.host.changed = true;
        }
        self.open.host.changed |= self.services.films.work.poll();
        let Some(result) = self.services.films.work.take() else { return };
        self.open.host.changed = true;
        let closes = std::mem::take(&mut self.services.films.closes);
        match result {
            Ok(done) => {
                let frames = if done.frames == 1 { "1 frame".to_owned() } else { format!("{} frames", done.frames) };
                let text = format!("saved {}: {frames}, {:.2} s", done.path.display(), done.secs);
                self.open.notice_with_path(About::Film, Level::Info, text, done.path.clone());
                self.services.films.ended = Some(Ended::Done(done));
                if closes {
                    self.ask_to_save_then(PendingAction::Close);
                }
            }
            Err(why) => self.film_failed(why),
        }
    }

    /// Asks what to do with an incomplete film. Returns whether there is one.
    pub(super) fn asks_about_film(&mut self) -> bool {
        let is_busy = self.services.films.is_busy();
        if is_busy {
            self.open.ask(Question::Film { is_live: self.services.films.is_live() });
        }
        is_busy
    }

    /// Closes the window when the film is complete.
    pub(super) fn close_after_film(&mut self) {
        self.stop_film();
        if self.services.films.is_busy() {
            self.services.films.closes = true;
        } else {
            self.ask_to_save_then(PendingAction::Close);
        }
    }
}
impl OpenProject {
    fn film_target(&self, order: &FilmOrder) -> Result<Target, String> {
        let project = self.project();
        let stem = capture::stem_for(project, &self.picture.shown);
        match &order.place {
            FilmPlace::Numbered => {
                Target::numbered(&capture::folder_for(project, &self.host.options.pictures), &stem, order.format)
            }
            FilmPlace::Named { path, replaces } => Ok(Target::named(path.clone(), &stem, order.format, *replaces)),
        }
    }
}
