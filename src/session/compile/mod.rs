//! From texts to programs: when a compile is due, what is being compiled, and the result of the newest text.
//!
//! Owns the schedule of a project's compiles ([`CompileControl`]) with its list of diagnostics, and the compiler thread
//! ([`Compiler`]), which outlives projects, as it keeps compiled stages and the device. The texts belong to the documents,
//! and the current program to the drawing.

mod worker;

pub(super) use worker::{CompileResult, Compiled, Compiler, Job};

use super::{
    debounce::Debounce,
    probe::ProbePlace,
    view::{CompileState, FallbackPicture, Outcome, TabDiagnostic},
};
use eddy_diag::Severity;
use eddy_project::{PassName, Project};
use eddy_video::Camera;
use std::{
    cmp::Reverse,
    mem::{replace, take},
    time::{Duration, Instant},
};

/// A compile shorter than this takes priority over frames of the program that it replaces: they would compete for the
/// processors, and a pause this short is not visible.
pub(super) const BRIEF: Duration = Duration::from_millis(100);

pub(super) struct CompileControl {
    /// The compiler has a job of this project.
    is_submitted: bool,
    /// The longest debounce time between the last edit and a compile.
    longest_quiet: Duration,
    /// Edits are compiled when they are saved.
    on_save: bool,
    /// Edits wait to be saved.
    pub waits_for_save: bool,
    pub edits: Debounce,
    /// A text was edited since the last tick.
    is_edited: bool,
    pub edited_at: Option<Instant>,
    /// Compile in the next tick, whatever the debounce says.
    is_wanted: bool,
    /// Check whether a picture or a model has changed on disk, as soon as the worker is free.
    pub is_file_check_due: bool,
    /// The program being compiled starts from frame zero.
    pub resets: bool,
    /// The project to compile instead of the newest text.
    fallback: Option<Project>,
    /// The time at which the worker started on the newest text, if it is compiling it.
    newest_since: Option<Instant>,
    /// Counts the edits that changed the `#include` lines, and how many of them have been read.
    pub include_edits: u64,
    pub includes_read: u64,
    pub state: CompileState,
    pub diagnostics: Vec<TabDiagnostic>,
    /// Diagnostics from loading the project that compiles do not repeat.
    pub read: Vec<TabDiagnostic>,
}

/// The documents and the view to compile.
pub(super) struct Source<'s> {
    pub project: &'s Project,
    /// See [`Documents::generated`](super::documents::Documents::generated).
    pub generated: Option<&'s Project>,
    pub shown: &'s PassName,
    /// Counts the times that a project was opened or moved.
    pub opened: u64,
    pub probe: Option<(ProbePlace, bool)>,
    pub camera: Option<Camera>,
}

impl CompileControl {
    pub(crate) fn new(longest_quiet: Duration, on_save: bool) -> Self {
        Self {
            is_submitted: false,
            longest_quiet,
            on_save,
            waits_for_save: false,
            edits: Debounce::new(longest_quiet),
            is_edited: false,
            edited_at: None,
            is_wanted: true,
            is_file_check_due: false,
            resets: false,
            fallback: None,
            newest_since: None,
            include_edits: 0,
            includes_read: 0,
            state: CompileState { compiling: true, ..CompileState::default() },
            diagnostics: Vec::new(),
            read: Vec::new(),
        }
    }

    /// Another compiler takes over: the old one's job has no result.
    pub(crate) fn change_compiler(&mut self) {
        (self.newest_since, self.is_submitted) = (None, false);
    }

    /// Records an edit of a text.
    pub(crate) fn edit(&mut self) {
        if self.on_save {
            self.waits_for_save = true;
        } else {
            self.is_edited = true;
            self.state.compiling = true;
        }
    }

    /// Schedules a compile for the next tick.
    pub(crate) fn soon(&mut self) {
        self.fallback = None;
        self.waits_for_save = false;
        self.is_wanted = true;
        self.state.compiling = true;
    }

    /// Returns whether edits are compiled when they are saved.
    pub(crate) fn is_on_save(&self) -> bool {
        self.on_save
    }

    pub(crate) fn set_on_save(&mut self, on: bool) {
        self.on_save = on;
        if !on {
            self.saved();
        }
    }

    /// Compiles edits that waited to be saved.
    pub(crate) fn saved(&mut self) {
        if self.waits_for_save {
            self.soon();
        }
    }

    /// Returns the edit whose included files have not been read.
    pub(crate) fn unread_includes(&self) -> Option<u64> {
        (self.includes_read != self.include_edits).then_some(self.include_edits)
    }

    /// Compiles another project instead of the newest text, which is tried again only after an edit or on request.
    /// Returns whether there is one.
    pub(crate) fn fall_back(&mut self, to: Option<Project>) -> bool {
        (self.is_wanted, self.is_edited) = (false, false);
        self.edits.cancel();
        self.fallback = to;
        self.fallback.is_some()
    }

    /// Returns the job that is due, which replaces the one that the compiler has.
    pub(crate) fn due_job(&mut self, now: Instant, source: Source<'_>) -> Option<Job> {
        if take(&mut self.is_edited) {
            self.edits.touch(now);
            self.edited_at = Some(now);
        }
        let is_due = self.edits.take_due(now);
        if is_due {
            self.fallback = None;
        }
        let is_compile = take(&mut self.is_wanted) || is_due || self.fallback.is_some();
        // A check must not replace a compile in progress, and a compile checks as well.
        let is_check_only = self.is_file_check_due && !self.is_submitted;
        if !is_compile && !is_check_only {
            return None;
        }
        self.is_file_check_due = false;
        let fallback = self.fallback.take();
        let is_fallback = fallback.is_some();
        if is_compile {
            self.edits.cancel();
            self.newest_since = (!is_fallback).then_some(now);
        }
        self.is_submitted = true;
        let include_edit = self.unread_includes().filter(|_| is_compile && !is_fallback);
        let Source { project, generated, shown, opened, probe, camera } = source;
        let generated = generated.filter(|_| is_compile && !is_fallback).cloned();
        let (project, shown) = (fallback.unwrap_or_else(|| project.clone()), shown.clone());
        let is_check_only = !is_compile;
        Some(Job { is_fallback, project, generated, shown, opened, include_edit, probe, camera, is_check_only })
    }

    /// Records the result of the newest job; `is_check`: it has only checked files.
    pub(crate) fn receive(&mut self, is_check: bool) {
        self.is_submitted = false;
        if !is_check {
            self.newest_since = None;
        }
    }

    /// Returns whether a compile is due or under way.
    pub(crate) fn is_busy(&self) -> bool {
        let is_due = self.is_edited || self.is_wanted || self.edits.is_waiting();
        is_due || self.is_submitted
    }

    /// Returns whether something newer than the last submitted project waits to be compiled.
    pub(crate) fn is_newer_wanted(&self, now: Instant) -> bool {
        self.is_wanted
            || self.newest_since.is_some()
            || self.fallback.is_some()
            || self.edits.deadline().is_some_and(|at| at <= now)
    }

    /// Returns until when frames wait for the compile in progress: one that takes longer than expected, such as of a
    /// pasted text, does not block the picture.
    pub(crate) fn holds_frames_until(&self, now: Instant) -> Option<Instant> {
        let until = self.newest_since? + BRIEF;
        (self.edits.quiet() <= BRIEF && now < until).then_some(until)
    }

    /// Sets whether the picture is older than the newest text. Returns whether that has changed.
    pub(crate) fn set_compiling(&mut self, is_compiling: bool) -> bool {
        replace(&mut self.state.compiling, is_compiling) != is_compiling
    }

    /// Takes the diagnostics of the newest text's compile, and its duration.
    pub(crate) fn diagnose(&mut self, mut diagnostics: Vec<TabDiagnostic>, took: Duration) {
        diagnostics.extend(self.read.iter().cloned());
        diagnostics.sort_by_key(|d| Reverse(d.severity));
        self.diagnostics = diagnostics;
        self.expect(took);
    }

    /// Sets the expected duration of the next compile.
    pub(crate) fn expect(&mut self, took: Duration) {
        self.edits.set_quiet(worker::quiet_after(took, self.longest_quiet));
    }

    /// Adds the reason why there is no program as the first diagnostic, without a place.
    pub(crate) fn add_failure(&mut self, why: &str) {
        self.diagnostics.insert(0, TabDiagnostic::nowhere(why));
    }

    /// The newest text produced a program.
    pub(crate) fn succeed(&mut self, millis: f64) {
        let warnings = self.count(Severity::Warning);
        self.state.last = Some(match self.count(Severity::Error) {
            0 => Outcome::Ok { millis, warnings },
            errors => Outcome::Failed { errors, meanwhile: FallbackPicture::Newest },
        });
    }

    /// The newest text produced no program, for the reasons in the list.
    pub(crate) fn fail(&mut self, has_program: bool) {
        let meanwhile = if has_program { FallbackPicture::LastGood } else { FallbackPicture::Nothing };
        self.state.last = Some(Outcome::Failed { errors: self.count(Severity::Error), meanwhile });
    }

    fn count(&self, severity: Severity) -> usize {
        self.diagnostics.iter().filter(|d| d.severity == severity).count()
    }

    #[cfg(test)]
    pub(crate) fn set_newest_since(&mut self, since: Option<Instant>) {
        self.newest_since = since;
    }
}
