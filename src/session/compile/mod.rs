//! The way from texts to programs: when a compile is due, what is with the compiler, and what came of the newest text.
//!
//! Owns the thread of the compiler and the list of diagnostics. What it returns says what the session is to do; the texts
//! are the documents', and the program that draws is the drawing's.

mod worker;

pub(super) use worker::{Compiled, Done, Job};

use super::{
    debounce::Debounce,
    drawing::Device,
    options::SessionOptions,
    probe::ProbePlace,
    view::{CompileState, Meanwhile, Outcome, TabDiagnostic},
};
use eddy_background::{Background, Wake};
use eddy_diag::Severity;
use eddy_project::{PassId, Project};
use std::{
    cmp::Reverse,
    io,
    mem::{replace, take},
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

/// A compile of so long goes before frames of the program that it takes the place of: they would take its processors,
/// and nobody sees a pause of so long.
pub(super) const BRIEF: Duration = Duration::from_millis(100);

pub(super) struct CompileControl {
    worker: Background<Job, (), Done>,
    /// Jobs that the worker was given.
    jobs: Arc<AtomicU64>,
    asked: Asked,
    /// Edits are compiled when they are saved.
    on_save: bool,
    /// The longest quiet time after the last edit before a compile.
    longest_quiet: Duration,
    /// Counts the edits after which the texts include other files, and how many of them have been followed by reading.
    include_edits: u64,
    includes_read: u64,
}

/// What is asked of the compiler for the open project, and what came of it.
struct Asked {
    edits: Debounce,
    /// A text was edited since the last tick.
    is_edited: bool,
    edited_at: Option<Instant>,
    /// There are edits that are compiled when they are saved.
    waits_for_save: bool,
    /// Compile in the next tick, whatever the debounce says.
    is_wanted: bool,
    /// See whether a picture or a model has changed on disk, as soon as the worker has time.
    is_look_wanted: bool,
    /// The program under way shall start from zero.
    resets: bool,
    /// The project that is to be compiled instead of the newest text.
    fallback: Option<Project>,
    /// Since when the worker compiles the newest text, if it does.
    newest_since: Option<Instant>,
    state: CompileState,
    diagnostics: Vec<TabDiagnostic>,
    /// The diagnostics of reading the project that no compile says.
    read: Vec<TabDiagnostic>,
}

impl Asked {
    fn new(quiet: Duration) -> Self {
        Self {
            edits: Debounce::new(quiet),
            is_edited: false,
            edited_at: None,
            waits_for_save: false,
            is_wanted: true,
            is_look_wanted: false,
            resets: false,
            fallback: None,
            newest_since: None,
            state: CompileState { compiling: true, ..CompileState::default() },
            diagnostics: Vec::new(),
            read: Vec::new(),
        }
    }
}

/// The documents and the view that a compile is of.
pub(super) struct Source<'s> {
    pub project: &'s Project,
    pub shown: &'s PassId,
    /// Counts the times a project was opened or took a new place.
    pub opened: u64,
    pub probe: Option<(ProbePlace, bool)>,
}

impl CompileControl {
    pub fn new(device: Device, options: &SessionOptions, wake: Wake) -> io::Result<Self> {
        let jobs = Arc::<AtomicU64>::default();
        Ok(Self {
            worker: worker(device, options, jobs.clone(), wake)?,
            jobs,
            asked: Asked::new(options.edit_debounce),
            on_save: false,
            longest_quiet: options.edit_debounce,
            include_edits: 0,
            includes_read: 0,
        })
    }

    pub fn begin_next_project(&mut self) {
        // A compile of the project that goes may end before the new one's begins.
        self.worker.clear();
        self.asked = Asked::new(self.longest_quiet);
        self.includes_read = self.include_edits;
    }

    /// Builds programs on another device. What the old one builds is waited for by nobody: it may wait for its device.
    pub fn change_device(&mut self, device: Device, options: &SessionOptions, wake: Wake) -> io::Result<()> {
        self.asked.newest_since = None;
        let worker = worker(device, options, self.jobs.clone(), wake)?;
        replace(&mut self.worker, worker).leave();
        Ok(())
    }

    /// Lets go of the thread.
    pub fn leave(&mut self) {
        self.worker.leave();
    }

    /// A text was edited.
    pub fn edit(&mut self) {
        if self.on_save {
            self.asked.waits_for_save = true;
        } else {
            self.asked.is_edited = true;
            self.asked.state.compiling = true;
        }
    }

    /// Compiles in the next tick.
    pub fn soon(&mut self) {
        self.asked.fallback = None;
        self.asked.waits_for_save = false;
        self.asked.is_wanted = true;
        self.asked.state.compiling = true;
    }

    pub fn set_on_save(&mut self, on: bool) {
        self.on_save = on;
        if !on {
            self.saved();
        }
    }

    /// Compiles what waited to be saved.
    pub fn saved(&mut self) {
        if self.asked.waits_for_save {
            self.soon();
        }
    }

    pub fn waits_for_save(&self) -> bool {
        self.asked.waits_for_save
    }

    /// Sees whether pictures and models have changed on disk.
    pub fn look(&mut self) {
        self.asked.is_look_wanted = true;
    }

    /// The program of the newest text shall start from zero.
    pub fn reset_when_built(&mut self) {
        self.asked.resets = true;
    }

    pub fn resets_when_built(&self) -> bool {
        self.asked.resets
    }

    pub fn take_reset(&mut self) -> bool {
        take(&mut self.asked.resets)
    }

    /// The texts may include other files than before.
    pub fn includes_changed(&mut self) {
        self.include_edits += 1;
    }

    /// Returns the edit whose included files have not been read.
    pub fn unread_includes(&self) -> Option<u64> {
        (self.includes_read != self.include_edits).then_some(self.include_edits)
    }

    pub fn include_edits(&self) -> u64 {
        self.include_edits
    }

    pub fn includes_are_read(&mut self, edit: u64) {
        self.includes_read = edit;
    }

    /// Compiles another project instead of the newest text, which only another edit, or who asks for it, tries again.
    /// Returns whether there is one.
    pub fn fall_back(&mut self, to: Option<Project>) -> bool {
        (self.asked.is_wanted, self.asked.is_edited) = (false, false);
        self.asked.edits.cancel();
        self.asked.fallback = to;
        self.asked.fallback.is_some()
    }

    /// Hands the worker what is due. Returns whether that is a compile.
    pub fn start(&mut self, now: Instant, source: Source<'_>) -> bool {
        let asked = &mut self.asked;
        if take(&mut asked.is_edited) {
            asked.edits.touch(now);
            asked.edited_at = Some(now);
        }
        let is_due = asked.edits.take_due(now);
        if is_due {
            asked.fallback = None;
        }
        let is_compile = take(&mut asked.is_wanted) || is_due || asked.fallback.is_some();
        // A look must not take the place of a compile under way, and a compile looks too.
        let is_look = asked.is_look_wanted && !self.worker.is_busy();
        if !is_compile && !is_look {
            return false;
        }
        asked.is_look_wanted = false;
        let fallback = asked.fallback.take();
        let is_fallback = fallback.is_some();
        if is_compile {
            asked.edits.cancel();
            asked.newest_since = (!is_fallback).then_some(now);
        }
        self.jobs.fetch_add(1, Ordering::Relaxed);
        let include_edit = self.unread_includes().filter(|_| is_compile && !is_fallback);
        let Source { project, shown, opened, probe } = source;
        let (project, shown) = (fallback.unwrap_or_else(|| project.clone()), shown.clone());
        self.worker.start(Job { is_fallback, project, shown, opened, include_edit, probe, is_look: !is_compile });
        is_compile
    }

    /// Takes what the worker has done; the error is a bug in it.
    pub fn take(&mut self) -> Option<Result<Done, String>> {
        let done = self.worker.take()?;
        if !matches!(done, Ok(Done { compiled: None, .. })) {
            self.asked.newest_since = None;
        }
        Some(done)
    }

    /// Returns whether a compile is due or under way.
    pub fn is_busy(&self) -> bool {
        let is_due = self.asked.is_edited || self.asked.is_wanted || self.asked.edits.is_waiting();
        is_due || self.worker.is_busy()
    }

    /// Returns whether something newer is to be drawn than what the compiler was given before.
    pub fn is_newer_wanted(&self, now: Instant) -> bool {
        let asked = &self.asked;
        asked.is_wanted
            || asked.newest_since.is_some()
            || asked.fallback.is_some()
            || asked.edits.deadline().is_some_and(|at| at <= now)
    }

    /// Returns until when frames wait for the compile that is under way: one that takes longer than expected, as of a text
    /// that was pasted, does not hold the picture.
    pub fn holds_frames_until(&self, now: Instant) -> Option<Instant> {
        let until = self.asked.newest_since? + BRIEF;
        (self.quiet() <= BRIEF && now < until).then_some(until)
    }

    /// Returns how long typing has to rest before it is compiled.
    pub fn quiet(&self) -> Duration {
        self.asked.edits.quiet()
    }

    /// Returns when edits are compiled.
    pub fn deadline(&self) -> Option<Instant> {
        self.asked.edits.deadline()
    }

    pub fn edited_at(&self) -> Option<Instant> {
        self.asked.edited_at
    }

    pub fn state(&self) -> &CompileState {
        &self.asked.state
    }

    /// Says whether the picture is of an older text than the newest. Returns whether that is news.
    pub fn set_compiling(&mut self, is_compiling: bool) -> bool {
        replace(&mut self.asked.state.compiling, is_compiling) != is_compiling
    }

    pub fn diagnostics(&self) -> &[TabDiagnostic] {
        &self.asked.diagnostics
    }

    /// Takes what a compile of the newest text has said, and how long it took.
    pub fn diagnose(&mut self, mut diagnostics: Vec<TabDiagnostic>, took: Duration) {
        diagnostics.extend(self.asked.read.iter().cloned());
        diagnostics.sort_by_key(|d| Reverse(d.severity));
        self.asked.diagnostics = diagnostics;
        self.expect(took);
    }

    /// The next compile is expected to take so long.
    pub fn expect(&mut self, took: Duration) {
        self.asked.edits.set_quiet(worker::quiet_after(took, self.longest_quiet));
    }

    /// Takes what reading the project has said, which is listed after the next compile.
    pub fn note_reading(&mut self, diagnostics: Vec<TabDiagnostic>) {
        self.asked.read = diagnostics;
    }

    pub fn add_findings(&mut self, findings: Vec<TabDiagnostic>) {
        self.asked.diagnostics.extend(findings);
    }

    /// Says first, about no text, why there is no program.
    pub fn add_failure(&mut self, why: &str) {
        self.asked.diagnostics.insert(0, TabDiagnostic::nowhere(why));
    }

    pub fn set_failure(&mut self, why: &str) {
        self.asked.diagnostics = vec![TabDiagnostic::nowhere(why)];
    }

    /// The newest text gave a program.
    pub fn succeed(&mut self, millis: f64) {
        let warnings = self.count(Severity::Warning);
        self.asked.state.last = Some(match self.count(Severity::Error) {
            0 => Outcome::Ok { millis, warnings },
            errors => Outcome::Failed { errors, meanwhile: Meanwhile::Newest },
        });
    }

    /// The newest text gave no program, for the reasons that are in the list.
    pub fn fail(&mut self, has_program: bool) {
        let meanwhile = if has_program { Meanwhile::LastGood } else { Meanwhile::Nothing };
        self.asked.state.last = Some(Outcome::Failed { errors: self.count(Severity::Error), meanwhile });
    }

    fn count(&self, severity: Severity) -> usize {
        self.asked.diagnostics.iter().filter(|d| d.severity == severity).count()
    }

    #[cfg(test)]
    pub fn set_newest_since(&mut self, since: Option<Instant>) {
        self.asked.newest_since = since;
    }

    #[cfg(test)]
    pub fn replace_worker(&mut self, worker: Background<Job, (), Done>) -> Background<Job, (), Done> {
        replace(&mut self.worker, worker)
    }
}

fn worker(
    device: Device,
    options: &SessionOptions,
    jobs: Arc<AtomicU64>,
    wake: Wake,
) -> io::Result<Background<Job, (), Done>> {
    Background::new("compile", "the compiler", wake, worker::work(device, options, jobs))
}
