//! The sound pass of the open project becomes a track while the picture runs.
//!
//! Owns the newest track, the thread that fills it, and why that may have ended. The thread has a device of its own and
//! makes pauses, so that no frame waits for a block; and a sound pass that is slow or breaks its device never harms the
//! picture. A track is never changed once it is made: what sounds different is another track, with a higher revision.

mod maker;
mod save;

use super::{
    Session, SessionOptions,
    drawing::Open,
    films::FilmSoundPass,
    view::{About, Level},
};
use eddy_audio::Track;
use eddy_background::{Background, Wake};
use eddy_engine::BLOCK_SECS;
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

/// A step of the thread (a compile, or some rows of a block) that takes longer is given up, and its device with it.
const STEP_LIMIT: Duration = Duration::from_secs(20);

/// The sound that a compile of the newest text leads to.
pub(super) enum CompiledSound {
    /// There is no sound pass.
    Nothing,
    /// The sound pass has errors: what was made before stays.
    Broken,
    /// It compiles; with the pictures that it may read.
    Sound(Box<MediaSet>),
}

/// A sound that is to be made.
struct Order {
    number: u64,
    project: Project,
    media: MediaSet,
    /// `iDate` of all blocks.
    date: [f32; 4],
    /// Counts the times that a project was opened.
    opened: u64,
}

/// Everything that the samples depend on, as far as the project tells.
#[derive(PartialEq)]
struct Source {
    opened: u64,
    /// The texts of the pass, of Common, and of all included files.
    texts: Vec<Arc<str>>,
    bindings: Bindings,
    /// The addresses of their texels, which [`Sounding::kept`] keeps where they are.
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

    /// Both differ in the values of uniforms alone.
    fn is_same_code(&self, other: &Source) -> bool {
        let all =
            |source: &Source| (source.opened, source.texts.clone(), source.bindings.clone(), source.texels.clone());
        all(self) == all(other)
    }
}

/// The state that the thread and the session both know.
#[derive(Default)]
pub(super) struct Shared(Mutex<SoundState>);

#[derive(Clone, Default)]
struct SoundState {
    /// The number of the order whose track it is, or shall be; 0: nothing is to be heard.
    order: u64,
    revision: u64,
    track: Option<Arc<Track>>,
    /// Since when the thread is at its step.
    since: Option<Instant>,
    /// The block that is heard.
    heard: usize,
}

/// The thread is at work while this lives.
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

    fn begin(&self) -> BusyGuard<'_> {
        self.goes_on();
        BusyGuard(self)
    }

    fn goes_on(&self) {
        self.now().since = Some(Instant::now());
    }

    fn track(&self) -> Option<Arc<Track>> {
        self.now().track.clone()
    }

    /// Begins with another track, unless a newer order has come.
    fn set_track(&self, order: u64, track: Arc<Track>) {
        let mut now = self.now();
        if now.order == order {
            now.revision += 1;
            now.track = Some(track);
        }
    }

    /// Nothing is to be heard.
    fn silence(&self) {
        let mut now = self.now();
        now.order = 0;
        if now.track.take().is_some() {
            now.revision += 1;
        }
    }

    /// Returns the block to make next: what is heard first, then what follows it, then what was before.
    fn next_block(&self, track: &Track) -> Option<usize> {
        let heard = self.now().heard;
        (heard..track.blocks()).find(|block| !track.has_block(*block)).or_else(|| track.first_missing())
    }

    /// Returns whether a block is heard soon.
    fn is_urgent(&self, block: usize) -> bool {
        let heard = self.now().heard;
        (heard..=heard + 1).contains(&block)
    }
}

/// The sound of the open project.
pub(super) struct Sounding {
    /// `None` until there is a sound pass, and after one was given up.
    thread: Option<Background<Order, (), ()>>,
    open: Open,
    is_cpu: bool,
    wake: Wake,
    /// Counts the orders: a compile that a newer one has overtaken is given up.
    orders: Arc<AtomicU64>,
    shared: Arc<Shared>,
    /// The sound that was ordered last, or is about to be.
    source: Option<Source>,
    /// The project and the pictures that it was ordered with, and its `iDate`.
    kept: Option<(Project, MediaSet, [f32; 4])>,
    /// Counts the orders that differ in more than the values of uniforms.
    codes: u64,
    pending: Option<Order>,
    trouble: Option<String>,
    /// Revision and blocks made, as the front end was told.
    seen: (u64, usize),
    /// Revision of the track that the player has.
    played: Option<u64>,
    /// A thread was given up and may be at work still.
    has_lost: bool,
}

/// The sound pass as front ends show it.
#[derive(Clone)]
pub struct SoundView {
    /// Grows with each other track.
    pub revision: u64,
    /// `None` before it compiles.
    pub track: Option<Arc<Track>>,
    /// Blocks of the track are being made.
    pub is_making: bool,
    /// The reason why no more of it is made.
    pub trouble: Option<String>,
}

impl Sounding {
    pub(crate) fn new(open: Open, is_cpu: bool, wake: Wake) -> Self {
        Self {
            thread: None,
            open,
            is_cpu,
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

    pub(crate) fn begin_next_project(&mut self) {
        self.silence();
    }

    /// Opens devices otherwise from now on, and makes the sound again.
    pub(crate) fn change_device(&mut self, open: Open) {
        self.open = open;
        self.separate();
        if let Some((project, media, _)) = self.kept.take() {
            let opened = self.source.take().map_or(0, |source| source.opened);
            self.order(project, media, opened);
        }
    }

    /// There is no sound pass.
    fn silence(&mut self) {
        if let Some(thread) = &mut self.thread {
            thread.cancel();
        }
        (self.source, self.kept, self.pending, self.trouble) = (None, None, None, None);
        self.shared.silence();
    }

    /// Lets go of the thread, and keeps what it has made. It may be at work still, and shares nothing with the next one.
    fn separate(&mut self) {
        if let Some(mut thread) = self.thread.take() {
            self.has_lost |= !thread.end(Duration::ZERO);
        }
        let now = SoundState { since: None, ..self.shared.now().clone() };
        self.shared = Arc::new(Shared(Mutex::new(now)));
    }

    /// Makes another sound if it depends on something else than before.
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

    /// Hands the thread what waits.
    fn start(&mut self, options: &SessionOptions) -> std::io::Result<()> {
        let Some(order) = self.pending.take() else { return Ok(()) };
        let thread = match &mut self.thread {
            Some(thread) => thread,
            None => {
                let trials = options.trials.as_ref();
                let trial = trials.map(|trials| trials.trial(options.media_dir.clone(), self.orders.clone()));
                let work = maker::work(self.open.clone(), self.is_cpu, trial, self.shared.clone());
                self.thread.insert(Background::new("sound", "the sound pass", self.wake.clone(), work)?)
            }
        };
        thread.start(order);
        Ok(())
    }

    /// Takes what the thread has done. Returns why it has ended, if not because all is made, once.
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

    /// Returns when the step under way has taken too long.
    fn deadline(&self) -> Option<Instant> {
        self.shared.now().since.map(|since| since + STEP_LIMIT)
    }

    /// Returns whether there is something else to see than at the last call.
    fn take_changed(&mut self) -> bool {
        let now = self.shared.now().clone();
        let seen = (now.revision, now.track.map_or(0, |track| track.made()));
        std::mem::replace(&mut self.seen, seen) != seen
    }

    /// Returns the number of the newest order; 0: nothing is heard.
    pub(crate) fn number(&self) -> u64 {
        self.shared.now().order
    }

    /// Returns the sound that is heard, for a film.
    pub(crate) fn heard(&self) -> Option<FilmSoundPass> {
        let (project, media, date) = self.kept.as_ref()?;
        Some(FilmSoundPass { code: self.codes, project: project.clone(), media: media.clone(), date: *date })
    }

    fn is_making(&self) -> bool {
        self.pending.is_some() || self.thread.as_ref().is_some_and(Background::is_busy)
    }

    /// Ends the thread. Returns whether one does not come back.
    pub(crate) fn end(&mut self, patience: Duration) -> bool {
        if let Some(mut thread) = self.thread.take() {
            self.has_lost |= !thread.end(patience);
        }
        self.has_lost
    }
}

impl Session {
    /// Returns the track of the sound pass and its revision, which grows with each other track; `None` while there is no
    /// sound pass that compiles. The track may still be being made.
    pub fn sound_track(&self) -> Option<(u64, Arc<Track>)> {
        let now = self.sounding.shared.now();
        now.track.clone().map(|track| (now.revision, track))
    }

    /// Returns what there is to show of the sound pass; `None` where the project has none.
    pub fn sound(&self) -> Option<SoundView> {
        self.project().sound()?;
        let (revision, track) = match self.sound_track() {
            Some((revision, track)) => (revision, Some(track)),
            None => (0, None),
        };
        Some(SoundView {
            revision,
            track,
            is_making: self.sounding.is_making(),
            trouble: self.sounding.trouble.clone(),
        })
    }

    /// A compile of the newest text has ended.
    pub(super) fn follow_sound(&mut self, project: &Project, heard: CompiledSound) {
        match heard {
            CompiledSound::Nothing => self.sounding.silence(),
            CompiledSound::Broken => {}
            CompiledSound::Sound(media) => {
                let mut project = project.clone();
                // They may have been turned while it was being compiled.
                project.custom_uniform_values.clone_from(&self.documents.current().custom_uniform_values);
                self.sounding.order(project, *media, self.disk.opened());
            }
        }
    }

    /// The author's own uniforms have other values.
    pub(super) fn sound_values_turned(&mut self, values: &CustomUniformValues) {
        let Some((project, media, _)) = &self.sounding.kept else { return };
        let project = Project { custom_uniform_values: values.clone(), ..project.clone() };
        let (media, opened) = (media.clone(), self.sounding.source.as_ref().map_or(0, |source| source.opened));
        self.sounding.order(project, media, opened);
    }

    /// Hands out what is to be made, and takes what was made. Nothing of a project that is held reaches a device.
    pub(super) fn tick_sound(&mut self) {
        if !self.halting.is_held()
            && let Err(error) = self.sounding.start(&self.options)
        {
            self.sounding.trouble = Some(format!("cannot start a thread: {error}"));
        }
        let time = self.playback.clock.time_secs();
        if let Some(why) = self.sounding.poll(self.now, time) {
            let text = format!("No more of the sound pass is made: {why}. Edit the pass to try again");
            self.notice_about(About::Code, Level::Warning, text);
            self.changed = true;
        }
        self.changed |= self.sounding.take_changed();
        let track = self.sound_track();
        let revision = track.as_ref().map(|(revision, _)| *revision);
        if std::mem::replace(&mut self.sounding.played, revision) != revision {
            self.play_track(track);
        }
    }

    /// The next moment in which a step of the sound may have taken too long.
    pub(super) fn sound_deadline(&self) -> Option<Instant> {
        self.sounding.deadline()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_background::Control;
    use eddy_project::Origin;
    use std::sync::mpsc::channel;

    #[test]
    fn a_step_that_does_not_end_is_given_up_and_what_was_made_stays() {
        let open: Open = Arc::new(|| panic!("no device is asked for"));
        let mut sounding = Sounding::new(open, false, Arc::new(|| ()));
        let (go_on, waits) = channel::<()>();
        let (begun, has_begun) = channel();
        let shared = sounding.shared.clone();
        let work = move |order: Order, _: &Control<()>| {
            let _at_work = shared.begin();
            shared.set_track(order.number, Arc::new(Track::new(4, 4)));
            begun.send(()).unwrap();
            waits.recv().map_err(|error| error.to_string())
        };
        let mut thread = Background::new("sound", "the sound pass", sounding.wake.clone(), work).unwrap();
        let project = Project::new("p", Vec::new(), Origin::Unsaved);
        sounding.shared.now().order = 1;
        thread.start(Order { number: 1, project, media: MediaSet::new(), date: [0.0; 4], opened: 1 });
        sounding.thread = Some(thread);
        has_begun.recv().unwrap();
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
    fn what_is_heard_is_made_first_and_then_the_rest() {
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
