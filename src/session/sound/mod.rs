//! Renders the sound pass of the open project into a track while the picture runs.
//!
//! Owns the newest track, the thread that renders it, and the reason why that has ended, if it has. The thread has a
//! device of its own and pauses between bands, so that no frame waits for a block; a slow sound pass, or one that loses
//! its device, never affects the picture. A track does not change after it is made: a different sound is another track,
//! with a higher revision.

mod maker;
mod save;

use super::{
    Session, SessionOptions,
    drawing::Open,
    films::FilmSoundPass,
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_audio::Track;
use eddy_background::{Background, Wake};
use eddy_engine::BLOCK_SECS;
use eddy_gpu::Rasteriser;
use eddy_media::{MediaKey, MediaSet};
use eddy_playback::date;
use eddy_project::{Bindings, CustomUniformValues, Project};
use std::{
    sync::{
        Arc, Mutex, MutexGuard,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

/// A step of the thread (a compile, or some rows of a block) that takes longer is abandoned with its device.
const STEP_LIMIT: Duration = Duration::from_secs(20);

/// The resulting sound of a compile of the newest text.
pub(super) enum CompiledSound {
    /// There is no sound pass.
    Nothing,
    /// The sound pass has errors: the existing track stays.
    Broken,
    /// It compiles; with the pictures that it may read.
    Sound(Box<MediaSet>),
}

/// A sound to be rendered.
struct Order {
    number: u64,
    project: Project,
    media: MediaSet,
    /// `iDate` of all blocks.
    date: [f32; 4],
    /// Counts the times that a project was opened.
    opened: u64,
}

/// All properties of the project that the samples depend on.
#[derive(PartialEq)]
struct Source {
    opened: u64,
    /// The texts of the pass, of Common, and of all included files.
    texts: Vec<Arc<str>>,
    bindings: Bindings,
    /// The addresses of their texels, which [`SoundPass::kept`] keeps alive.
    texels: Vec<Option<usize>>,
    values: CustomUniformValues,
}

impl Source {
    fn of(project: &Project, media: &MediaSet, opened: u64) -> Option<Self> {
        let sound = project.sound()?;
        let others = project.common.iter().chain(project.includes.iter().map(|included| &included.source));
        let texels = sound.bindings.channels().map(|channel| {
            let key = MediaKey::of_channel(channel)?;
            media.get(&key).map(|texels| Arc::as_ptr(texels) as usize)
        });
        let texels = texels.collect();
        Some(Self {
            opened,
            texts: [&sound.source].into_iter().chain(others).map(|source| source.text.clone()).collect(),
            bindings: sound.bindings.clone(),
            texels,
            values: project.custom_uniform_values.clone(),
        })
    }

    /// Returns whether both differ at most in the values of uniforms.
    fn is_same_code(&self, other: &Source) -> bool {
        let all =
            |source: &Source| (source.opened, source.texts.clone(), source.bindings.clone(), source.texels.clone());
        all(self) == all(other)
    }
}

/// The state that the thread and the session share.
#[derive(Default)]
pub(super) struct Shared(Mutex<SoundState>);

#[derive(Clone, Default)]
struct SoundState {
    /// The number of the order whose track this is, or will be; 0: silence.
    order: u64,
    revision: u64,
    track: Option<Arc<Track>>,
    /// The time at which the thread started its current step.
    since: Option<Instant>,
    /// The block that is playing.
    heard: usize,
}

/// Marks the thread as busy while it lives.
struct BusyGuard<'s>(&'s Shared);

impl Drop for BusyGuard<'_> {
    fn drop(&mut self) {
        self.0.now().since = None;
    }
}

impl Shared {
    fn now(&self) -> MutexGuard<'_, SoundState> {
        self.0.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    fn start_step(&self) -> BusyGuard<'_> {
        self.goes_on();
        BusyGuard(self)
    }

    fn goes_on(&self) {
        self.now().since = Some(Instant::now());
    }

    fn track(&self) -> Option<Arc<Track>> {
        self.now().track.clone()
    }

    /// Starts another track, unless there is a newer order.
    fn set_track(&self, order: u64, track: Arc<Track>) {
        let mut now = self.now();
        if now.order == order {
            now.revision += 1;
            now.track = Some(track);
        }
    }

    /// Drops the track: nothing is to be played.
    fn silence(&self) {
        let mut now = self.now();
        now.order = 0;
        if now.track.take().is_some() {
            now.revision += 1;
        }
    }

    /// Returns the block to render next: the one playing, then those that follow it, then the earlier ones.
    fn next_block(&self, track: &Track) -> Option<usize> {
        let heard = self.now().heard;
        (heard..track.blocks()).find(|block| !track.has_block(*block)).or_else(|| track.first_missing())
    }

    /// Returns whether a block plays soon.
    fn is_urgent(&self, block: usize) -> bool {
        let heard = self.now().heard;
        (heard..=heard + 1).contains(&block)
    }
}

/// The sound of the open project.
pub(super) struct SoundPass {
    /// `None` until there is a sound pass, and after one was abandoned.
    thread: Option<Background<Order, (), ()>>,
    open: Open,
    rasteriser: Rasteriser,
    wake: Wake,
    /// Counts the orders: a compile that a newer one has overtaken is cancelled.
    orders: Arc<AtomicU64>,
    shared: Arc<Shared>,
    /// The sound of the last or the pending order.
    source: Option<Source>,
    /// The order's project and pictures, and its `iDate`.
    kept: Option<(Project, MediaSet, [f32; 4])>,
    /// Counts the orders that differ in more than the values of uniforms.
    codes: u64,
    pending: Option<Order>,
    trouble: Option<String>,
    /// The revision and number of blocks that were last reported to the front end.
    seen: (u64, usize),
    /// The revision of the player's track.
    played: Option<u64>,
    /// A thread was abandoned and may still be running.
    has_lost: bool,
}

/// The sound pass as front ends show it.
#[derive(Clone)]
pub struct SoundView {
    /// Grows with each new track.
    pub revision: u64,
    /// `None` before it compiles.
    pub track: Option<Arc<Track>>,
    /// Blocks of the track are being rendered.
    pub is_making: bool,
    /// The reason why rendering has stopped.
    pub trouble: Option<String>,
}

impl SoundPass {
    pub(crate) fn new(open: Open, rasteriser: Rasteriser, wake: Wake) -> Self {
        Self {
            thread: None,
            open,
            rasteriser,
            wake,
            orders: Arc::default(),
            shared: Arc::default(),
            source: None,
            kept: None,
            codes: 0,
            pending: None,
            trouble: None,
            seen: (0, 0),
            played: None,
            has_lost: false,
        }
    }

    /// Changes how devices are opened, and renders the sound again.
    pub(crate) fn change_device(&mut self, open: Open) {
        self.open = open;
        self.separate();
        if let Some((project, media, _)) = self.kept.take() {
            let opened = self.source.take().map_or(0, |source| source.opened);
            self.order(project, media, opened);
        }
    }

    /// Stops everything: there is no sound pass.
    pub(crate) fn silence(&mut self) {
        if let Some(thread) = &mut self.thread {
            thread.cancel();
        }
        (self.source, self.kept, self.pending, self.trouble) = (None, None, None, None);
        self.shared.silence();
    }

    /// Detaches the thread, and keeps its track. It may still be running, and shares nothing with the next one.
    fn separate(&mut self) {
        if let Some(mut thread) = self.thread.take() {
            self.has_lost |= !thread.end(Duration::ZERO);
        }
        let now = SoundState { since: None, ..self.shared.now().clone() };
        self.shared = Arc::new(Shared(Mutex::new(now)));
    }

    /// Orders another sound if its inputs have changed.
    fn order(&mut self, project: Project, media: MediaSet, opened: u64) {
        let source = Source::of(&project, &media, opened);
        if source == self.source {
            return;
        }
        let date = date::i_date(date::now());
        let number = self.orders.fetch_add(1, Ordering::Relaxed) + 1;
        self.shared.now().order = number;
        self.pending = Some(Order { number, project: project.clone(), media: media.clone(), date, opened });
        let is_same_code = match (&self.source, &source) {
            (Some(before), Some(source)) => before.is_same_code(source),
            _ => false,
        };
        self.codes += u64::from(!is_same_code);
        (self.source, self.kept, self.trouble) = (source, Some((project, media, date)), None);
    }

    /// Renders the sound again with other values of the author's own uniforms.
    fn set_values(&mut self, values: CustomUniformValues) {
        let Some((project, media, _)) = &self.kept else { return };
        let project = Project { custom_uniform_values: values, ..project.clone() };
        let (media, opened) = (media.clone(), self.source.as_ref().map_or(0, |source| source.opened));
        self.order(project, media, opened);
    }

    /// Submits the pending order to the thread.
    fn start(&mut self, options: &SessionOptions) -> std::io::Result<()> {
        let Some(order) = self.pending.take() else { return Ok(()) };
        let thread = match &mut self.thread {
            Some(thread) => thread,
            None => {
                let trials = options.trials.as_ref();
                let trial = trials.map(|trials| trials.trial(options.media_dir.clone(), self.orders.clone()));
                let work = maker::work(self.open.clone(), self.rasteriser, trial, self.shared.clone());
                self.thread.insert(Background::new("sound", "the sound pass", self.wake.clone(), work)?)
            }
        };
        thread.start(order);
        Ok(())
    }

    /// Takes the thread's results. Returns, once, why it has ended, unless it is finished.
    fn poll(&mut self, now: Instant, heard_secs: f64) -> Option<String> {
        self.shared.now().heard = (heard_secs.max(0.0) / BLOCK_SECS) as usize;
        if self.deadline().is_some_and(|deadline| deadline <= now) {
            self.separate();
            let limit = STEP_LIMIT.as_secs();
            self.trouble = Some(format!("the GPU did not finish a part of it within {limit} s"));
            return self.trouble.clone();
        }
        let ended = self.thread.as_mut().and_then(Background::take)?;
        self.trouble = ended.err();
        self.trouble.clone()
    }

    /// Returns when the step in progress times out.
    fn deadline(&self) -> Option<Instant> {
        self.shared.now().since.map(|since| since + STEP_LIMIT)
    }

    /// Returns whether something visible has changed since the last call.
    fn take_changed(&mut self) -> bool {
        let now = self.shared.now().clone();
        let seen = (now.revision, now.track.map_or(0, |track| track.made()));
        std::mem::replace(&mut self.seen, seen) != seen
    }

    /// Returns the number of the newest order; 0: silence.
    pub(crate) fn number(&self) -> u64 {
        self.shared.now().order
    }

    /// Returns the sound pass that is playing, for a film.
    pub(crate) fn heard(&self) -> Option<FilmSoundPass> {
        let (project, media, date) = self.kept.as_ref()?;
        Some(FilmSoundPass { code: self.codes, project: project.clone(), media: media.clone(), date: *date })
    }

    fn is_making(&self) -> bool {
        self.pending.is_some() || self.thread.as_ref().is_some_and(Background::is_busy)
    }

    /// Ends the thread. Returns whether one is hung.
    pub(crate) fn end(&mut self, patience: Duration) -> bool {
        if let Some(mut thread) = self.thread.take() {
            self.has_lost |= !thread.end(patience);
        }
        self.has_lost
    }
}

impl Session {
    /// Submits pending orders, and takes results. Nothing of a held project reaches a device.
    pub(super) fn tick_sound(&mut self) {
        if let Some(values) = self.open.uniforms.for_sound.take() {
            self.services.sound_pass.set_values(values);
        }
        if !self.open.halt.is_held()
            && let Err(error) = self.services.sound_pass.start(&self.open.host.options)
        {
            self.services.sound_pass.trouble = Some(format!("cannot start a thread: {error}"));
        }
        let time = self.open.playback.clock.time_secs();
        if let Some(why) = self.services.sound_pass.poll(self.open.host.now, time) {
            let text = format!("No more of the sound pass is made: {why}. Edit the pass to try again");
            self.open.notice_about(About::Code, Level::Warning, text);
            self.open.host.changed = true;
        }
        self.open.host.changed |= self.services.sound_pass.take_changed();
        let track = self.services.sound_pass.sound_track();
        let revision = track.as_ref().map(|(revision, _)| *revision);
        if std::mem::replace(&mut self.services.sound_pass.played, revision) != revision {
            self.services.audio.play_track(track);
        }
    }
}

impl SoundPass {
    /// Returns the track of the sound pass and its revision, which grows with each new track; `None` if there is no
    /// sound pass that compiles. Blocks of the track may still be missing.
    pub(crate) fn sound_track(&self) -> Option<(u64, Arc<Track>)> {
        let now = self.shared.now();
        now.track.clone().map(|track| (now.revision, track))
    }

    /// Returns the state of the sound pass; `None` if the project has none.
    pub(crate) fn sound(&self, open: &OpenProject) -> Option<SoundView> {
        open.project().sound()?;
        let (revision, track) = match self.sound_track() {
            Some((revision, track)) => (revision, Some(track)),
            None => (0, None),
        };
        Some(SoundView { revision, track, is_making: self.is_making(), trouble: self.trouble.clone() })
    }

    /// Handles the result of compiling the newest text.
    pub(super) fn follow_sound(&mut self, open: &mut OpenProject, project: &Project, heard: CompiledSound) {
        match heard {
            CompiledSound::Nothing => self.silence(),
            CompiledSound::Broken => {}
            CompiledSound::Sound(media) => {
                let mut project = project.clone();
                // They may have been set while it was being compiled.
                project.custom_uniform_values.clone_from(&open.documents.current().custom_uniform_values);
                self.order(project, *media, open.disk.opened());
            }
        }
    }

    /// Returns when the step of the sound in progress times out.
    pub(super) fn sound_deadline(&self) -> Option<Instant> {
        self.deadline()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_background::Control;
    use eddy_project::Origin;
    use std::sync::mpsc::channel;

    #[test]
    fn hung_step_is_abandoned_and_finished_blocks_stay() {
        let open: Open = Arc::new(|| panic!("no device is asked for"));
        let mut sounding = SoundPass::new(open, Rasteriser::GPU, Arc::new(|| ()));
        let (go_on, waits) = channel::<()>();
        let (started, has_started) = channel();
        let shared = sounding.shared.clone();
        let work = move |order: Order, _: &Control<()>| {
            let _at_work = shared.start_step();
            shared.set_track(order.number, Arc::new(Track::new(4, 4)));
            started.send(()).unwrap();
            waits.recv().map_err(|error| error.to_string())
        };
        let mut thread = Background::new("sound", "the sound pass", sounding.wake.clone(), work).unwrap();
        let project = Project::new("p", Vec::new(), Origin::Unsaved);
        sounding.shared.now().order = 1;
        thread.start(Order { number: 1, project, media: MediaSet::new(), date: [0.0; 4], opened: 1 });
        sounding.thread = Some(thread);
        has_started.recv().unwrap();
        let now = Instant::now();
        assert_eq!(sounding.poll(now, 0.0), None);
        assert!(sounding.deadline().is_some_and(|at| at > now) && sounding.is_making());
        let why = sounding.poll(now + STEP_LIMIT, 0.0).expect("a reason");
        assert!(why.contains("20 s"), "{why}");
        assert!(sounding.thread.is_none() && sounding.deadline().is_none() && sounding.has_lost);
        assert!(sounding.shared.track().is_some());
        assert_eq!(sounding.poll(now + 2 * STEP_LIMIT, 0.0), None, "it is said once");
        go_on.send(()).unwrap();
    }

    #[test]
    fn playing_block_is_rendered_first() {
        let (shared, track) = (Shared::default(), Track::new(5, 1));
        shared.now().heard = 3;
        let mut order = Vec::new();
        while let Some(block) = shared.next_block(&track) {
            order.push(block);
            track.write(block, vec![[0; 2]]);
        }
        assert_eq!(order, [3, 4, 0, 1, 2]);
        assert_eq!([2, 3, 4, 5].map(|block| shared.is_urgent(block)), [false, true, true, false]);
        shared.now().heard = 99;
        assert_eq!(shared.next_block(&Track::new(2, 1)), Some(0), "after the end there is time for all");
    }
}
