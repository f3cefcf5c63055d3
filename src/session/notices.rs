//! Notices: what a person is told once, and when it is no news any more.

use super::{
    Session,
    view::{About, Level, Notice},
};
use std::path::PathBuf;

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
        self.notices.push(Notice { id: self.next_notice, level, text, about, path: None, undoes: None, at: self.now });
        self.next_notice += 1;
        self.changed = true;
    }

    /// Says something unless it stands there already.
    pub(super) fn notice_once(&mut self, about: About, level: Level, text: &str) {
        if self.notices.iter().all(|notice| notice.text != text) {
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
        let before = self.notices.len();
        self.notices.retain(|notice| notice.about != about || notice.level == Level::Info);
        self.changed |= self.notices.len() != before;
    }

    /// A program of a text that was edited after them draws: notices about code are of an older text.
    pub(super) fn settled_by_edit(&mut self) {
        if let Some(edited) = self.compile.edited_at() {
            let before = self.notices.len();
            self.notices.retain(|notice| notice.about != About::Code || notice.at > edited);
            self.changed |= self.notices.len() != before;
        }
    }

    /// Another project takes the place of the one that they are of. What the same command has said is of the new one.
    pub(super) fn forget_notices(&mut self) {
        let first = self.command_began;
        self.notices.retain(|notice| notice.about == About::Window || notice.id >= first);
        self.changed = true;
    }
}
