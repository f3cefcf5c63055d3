//! Notices: what a person is told once, and when it is no news any more.

use super::{
    Session,
    view::{About, Level, Notice},
};
use std::{path::PathBuf, time::Instant};

/// The notices that stand, oldest first.
#[derive(Default)]
pub(super) struct Notices {
    list: Vec<Notice>,
    /// The number of the next one, and of the next one when the command under way began.
    next: u64,
    command_began: u64,
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

    /// A command begins: what is said from now on is said of what it does.
    pub(crate) fn begin_command(&mut self) {
        self.command_began = self.next;
    }

    fn push(&mut self, about: About, level: Level, text: String, at: Instant) {
        self.list.push(Notice { id: self.next, level, text, about, path: None, undoes: None, at });
        self.next += 1;
    }

    /// Keeps some. Returns whether others were there.
    fn retain(&mut self, keep: impl FnMut(&Notice) -> bool) -> bool {
        let before = self.list.len();
        self.list.retain(keep);
        self.list.len() != before
    }
}

impl Session {
    /// Says something of the open project.
    pub(super) fn notice(&mut self, level: Level, text: impl Into<String>) {
        self.notice_about(About::Project, level, text);
    }

    /// Says something that is gone once [`Session::settled`] is told of `about`.
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
        self.notices.push(about, level, text, self.now);
        self.changed = true;
    }

    /// Says something unless it stands there already.
    pub(super) fn notice_once(&mut self, about: About, level: Level, text: &str) {
        if self.notices.list.iter().all(|notice| notice.text != text) {
            self.notice_about(about, level, text);
        }
    }

    /// Says something with a file that can be opened.
    pub(super) fn notice_with_path(&mut self, about: About, level: Level, text: impl Into<String>, path: PathBuf) {
        self.notice_about(about, level, text);
        if let Some(notice) = self.notices.last_mut() {
            notice.path = Some(path);
        }
    }

    /// It is mended, or tried again: what was said of it is no news any more. Good news goes by itself.
    pub(super) fn settled(&mut self, about: About) {
        self.changed |= self.notices.retain(|notice| notice.about != about || notice.level == Level::Info);
    }

    /// A program of a text that was edited after them draws: notices about code are of an older text.
    pub(super) fn settled_by_edit(&mut self) {
        if let Some(edited) = self.compile.edited_at {
            self.changed |= self.notices.retain(|notice| notice.about != About::Code || notice.at > edited);
        }
    }

    /// Another project takes the place of the one that they are of. What the same command has said is of the new one.
    pub(super) fn forget_notices(&mut self) {
        let first = self.notices.command_began;
        self.notices.retain(|notice| notice.about == About::Window || notice.id >= first);
        self.changed = true;
    }
}
