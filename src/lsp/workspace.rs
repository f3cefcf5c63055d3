//! The programs that the open documents belong to.

use super::{
    documents::Documents,
    program::{Program, Root, root_of},
    reading::{Reading, ReadingState},
};
use eddy_diag::SourceId;
use eddy_project::is_manifest;
use std::{mem, path::Path, sync::Arc, time::Duration};

/// The reason why a document cannot be queried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unavailable {
    /// It is closed, or not a file that Eddy handles.
    Unknown,
    /// Its program is still being read.
    Reading,
}

/// The limit for waiting for a program that is being read.
pub(crate) const READ_TIMEOUT: Duration = Duration::from_millis(50);

#[derive(Default)]
pub(crate) struct Workspace {
    pub documents: Documents,
    pub programs: Vec<Program>,
    /// Programs are read on a separate thread, one at a time.
    pub is_threaded: bool,
    reading: Option<Reading>,
    /// A request was refused because its program was being read.
    pub has_refused: bool,
}

impl Workspace {
    /// Called when a document was opened.
    pub(crate) fn opened(&mut self, path: &Path) {
        self.changed(path);
        if !self.programs.iter().any(|program| program.contains(path)) {
            self.start_reading(root_of(path, self.documents.texts()));
        }
    }

    /// Adds the program of a root, unless it exists.
    pub(crate) fn start_reading(&mut self, root: Root) {
        if !self.programs.iter().any(|program| program.root == root) {
            self.programs.push(Program::new(root));
        }
    }

    /// Called when the text of a document has changed.
    pub(crate) fn changed(&mut self, path: &Path) {
        let holds = |program: &Program| {
            program.contains(path)
                || match &program.root {
                    // The project may start to use the file, or use it again.
                    Root::Folder(folder) => path.starts_with(folder),
                    Root::File(file) => file == path,
                }
        };
        // The texts of a program that is being read are known only later.
        let read = self.reading.as_ref().map(|reading| &reading.root);
        let mut is_outdated = false;
        for program in self.programs.iter_mut().filter(|program| holds(program) || Some(&program.root) == read) {
            is_outdated |= Some(&program.root) == read;
            program.is_stale = true;
        }
        if let Some(reading) = self.reading.as_ref().filter(|_| is_outdated) {
            reading.cancel();
        }
    }

    /// Called when files on disk have changed.
    pub(crate) fn changed_on_disk(&mut self) {
        for program in &mut self.programs {
            program.is_stale = true;
            program.forget_media();
        }
        if let Some(reading) = &self.reading {
            reading.cancel();
        }
    }

    /// Returns whether a program is being read.
    pub(crate) fn is_reading(&self) -> bool {
        self.reading.is_some()
    }

    /// Cancels the current reading.
    pub(crate) fn drop_reading(&mut self) {
        if let Some(reading) = self.reading.take() {
            reading.cancel();
        }
    }

    /// As [`Workspace::settle`] if programs are read on this thread. Otherwise reads on the other one, and returns
    /// false if a program takes longer than `patience`.
    pub(crate) fn settle_within(&mut self, patience: Duration) -> bool {
        if !self.is_threaded {
            self.settle();
            return true;
        }
        loop {
            if let Some(reading) = self.reading.take() {
                match reading.wait(patience) {
                    ReadingState::Reading => {
                        self.reading = Some(reading);
                        return false;
                    }
                    ReadingState::Read(read) => self.take_read(*read),
                    ReadingState::Ended { has_failed: true } => {
                        log::error!("{} cannot be read: this is a bug in Eddy", reading.root.path().display());
                    }
                    ReadingState::Ended { has_failed: false } => {}
                }
            }
            if let Some(program) = self.programs.iter_mut().find(|program| program.is_stale) {
                program.is_stale = false;
                match Reading::start(program.take_unread(), self.documents.clone()) {
                    Ok(reading) => self.reading = Some(reading),
                    // If the thread cannot be started, the program is read here.
                    Err(_) => program.read(&self.documents, &Arc::default()),
                }
            } else if !self.add_missing_program() {
                return true;
            }
        }
    }

    fn take_read(&mut self, mut read: Program) {
        let Some(program) = self.programs.iter_mut().find(|program| program.root == read.root) else { return };
        if program.is_stale {
            // A text has changed since.
            program.take_cache_of(read);
            return;
        }
        read.replace(program);
        *program = read;
    }

    /// Reads every changed program again, and drops those without documents.
    fn settle(&mut self) {
        loop {
            for program in self.programs.iter_mut().filter(|program| program.is_stale) {
                program.read(&self.documents, &Arc::default());
            }
            if !self.add_missing_program() {
                break;
            }
        }
    }

    /// Adds a program for a document without one: a file may have left its project. Returns whether there was such a
    /// document.
    fn add_missing_program(&mut self) -> bool {
        let lost = self.documents.iter().find(|document| self.owner(&document.path).is_none());
        let Some(path) = lost.map(|document| document.path.clone()) else { return false };
        let root = match root_of(&path, self.documents.texts()) {
            Root::Folder(folder) if self.programs.iter().any(|p| p.root == Root::Folder(folder.clone())) => {
                Root::File(path.clone())
            }
            root => root,
        };
        if self.programs.iter().any(|program| program.root == root) {
            // It cannot be read at all; its program reports the error.
            return false;
        }
        self.start_reading(root);
        true
    }

    /// Returns the program that a document belongs to: for a text that others include, the one that includes it.
    pub(crate) fn owner(&self, path: &Path) -> Option<usize> {
        if is_manifest(path) {
            let folder = path.parent()?;
            return self.programs.iter().position(|p| matches!(&p.root, Root::Folder(of) if of == folder));
        }
        let is_own = |program: &Program| matches!(&program.root, Root::File(file) if file == path);
        let own = self.programs.iter().position(is_own).filter(|&i| self.programs[i].contains(path));
        if own.is_some_and(|i| self.programs[i].is_whole()) {
            return own;
        }
        self.programs.iter().position(|program| !is_own(program) && program.contains(path)).or(own)
    }

    /// Removes and returns the programs without documents.
    pub(crate) fn take_closed_programs(&mut self, keep: impl Fn(&Root) -> bool) -> Vec<Program> {
        let owners: Vec<usize> = self.documents.iter().filter_map(|document| self.owner(&document.path)).collect();
        let mut index = 0;
        let (kept, left): (Vec<Program>, Vec<Program>) = mem::take(&mut self.programs).into_iter().partition(|p| {
            index += 1;
            owners.contains(&(index - 1)) || keep(&p.root)
        });
        self.programs = kept;
        left
    }

    /// Returns the program of a document, read, and the id of the document's text in it.
    pub(crate) fn find(&mut self, path: &Path) -> Result<(&Program, SourceId), Unavailable> {
        if self.documents.get(path).is_none() {
            return Err(Unavailable::Unknown);
        }
        let read = self.reading.as_ref().map(|reading| &reading.root);
        // Does not wait for the reading of other programs.
        let is_read = |program: &Program| !program.is_stale && Some(&program.root) != read;
        let is_known = self.owner(path).is_some_and(|owner| is_read(&self.programs[owner]));
        if !is_known && !self.settle_within(READ_TIMEOUT) {
            self.has_refused = true;
            return Err(Unavailable::Reading);
        }
        let owner = self.owner(path).ok_or(Unavailable::Unknown)?;
        let program = &self.programs[owner];
        let id = program.id_of(path).ok_or(Unavailable::Unknown)?;
        Ok((program, id))
    }
}
