//! Notices: messages that are shown once, and when they are dismissed.

use super::{
    open_project::OpenProject,
    view::{About, Level, Notice},
};
use std::{path::PathBuf, time::Instant};

/// The current notices, oldest first.
#[derive(Default)]
pub(super) struct Notices {
    list: Vec<Notice>,
    /// The number of the next one, and of the next one when the current command started.
    next: u64,
    first_of_command: u64,
}

impl Notices {
    pub(crate) fn list(&self) -> &[Notice] {
        &self.list
    }

    pub(crate) fn last_mut(&mut self) -> Option<&mut Notice> {
        self.list.last_mut()
    }

    pub(crate) fn dismiss(&mut self, id: u64) {
        self.list.retain(|notice| notice.id != id);
    }

    /// Marks the start of a command: later notices are about its effects.
    pub(crate) fn start_command(&mut self) {
        self.first_of_command = self.next;
    }

    fn push(&mut self, about: About, level: Level, text: String, at: Instant) {
        self.list.push(Notice { id: self.next, level, text, about, path: None, undoes: None, at });
        self.next += 1;
    }

    /// Keeps some of the notices. Returns whether any were removed.
    fn retain(&mut self, keep: impl FnMut(&Notice) -> bool) -> bool {
        let before = self.list.len();
        self.list.retain(keep);
        self.list.len() != before
    }
}

impl OpenProject {
    /// Shows a notice about the open project.
    pub(super) fn notice(&mut self, level: Level, text: impl Into<String>) {
        self.notice_about(About::Project, level, text);
    }

    /// Shows a notice that is dismissed when [`Session::settled`] is called with its `about`.
    pub(super) fn notice_about(&mut self, about: About, level: Level, text: impl Into<String>) {
        let text = text.into();
        log::log!(
            match level {
                Level::Info => log::Level::Info,
                Level::Warning => log::Level::Warn,
                Level::Error => log::Level::Error,
            },
            "{text}"
        );
        self.host.notices.push(about, level, text, self.host.now);
        self.host.changed = true;
    }

    /// Shows a notice unless it is shown already.
    pub(super) fn notice_once(&mut self, about: About, level: Level, text: &str) {
        if self.host.notices.list.iter().all(|notice| notice.text != text) {
            self.notice_about(about, level, text);
        }
    }

    /// Shows a notice with a file that can be opened.
    pub(super) fn notice_with_path(&mut self, about: About, level: Level, text: impl Into<String>, path: PathBuf) {
        self.notice_about(about, level, text);
        if let Some(notice) = self.host.notices.last_mut() {
            notice.path = Some(path);
        }
    }

    /// The problem was fixed or the operation is retried: dismisses the notices about it. Success notices expire.
    pub(super) fn dismiss_notices(&mut self, about: About) {
        self.host.changed |= self.host.notices.retain(|notice| notice.about != about || notice.level == Level::Info);
    }

    /// A program of a text that was edited after the notices draws: dismisses notices about code, which are about an
    /// older text.
    pub(super) fn dismiss_code_notices(&mut self) {
        if let Some(edited) = self.compile.edited_at {
            self.host.changed |= self.host.notices.retain(|notice| notice.about != About::Code || notice.at > edited);
        }
    }

    /// Another project is opened: dismisses notices of the previous one. Notices of the current command are about the
    /// new one.
    pub(super) fn forget_notices(&mut self) {
        let first = self.host.notices.first_of_command;
        self.host.notices.retain(|notice| notice.about == About::Window || notice.id >= first);
        self.host.changed = true;
    }
}
