//! The programs that the open documents belong to.

use super::{
    documents::Documents,
    program::{Program, Root, root_of},
};
use eddy_diag::SourceId;
use eddy_project::is_manifest;
use std::path::Path;

/// Says that a document is closed, or is none of Eddy's.
#[derive(Debug)]
pub(crate) struct Unknown;

#[derive(Default)]
pub(crate) struct Workspace {
    pub documents: Documents,
    pub programs: Vec<Program>,
}

impl Workspace {
    /// A document was opened.
    pub fn opened(&mut self, path: &Path) {
        self.changed(path);
        if !self.programs.iter().any(|program| program.contains(path)) {
            self.begin(root_of(path, self.documents.texts()));
        }
    }

    /// Adds the program of a root, unless it is there.
    pub fn begin(&mut self, root: Root) {
        if !self.programs.iter().any(|program| program.root == root) {
            self.programs.push(Program::new(root));
        }
    }

    /// The text of a document has changed.
    pub fn changed(&mut self, path: &Path) {
        let holds = |program: &Program| {
            program.contains(path)
                || match &program.root {
                    // It may name the file from now on, or for the first time again.
                    Root::Folder(folder) => path.starts_with(folder),
                    Root::File(file) => file == path,
                }
        };
        self.programs.iter_mut().filter(|program| holds(program)).for_each(|program| program.is_stale = true);
    }

    /// Files on disk have changed.
    pub fn changed_on_disk(&mut self) {
        for program in &mut self.programs {
            program.is_stale = true;
            program.forget_media();
        }
    }

    /// Reads every program again that has changed, and lets go of those that no document belongs to.
    pub fn settle(&mut self) {
        loop {
            for program in self.programs.iter_mut().filter(|program| program.is_stale) {
                program.read(&self.documents);
            }
            // A file may have left its project.
            let lost = self.documents.iter().find(|document| self.owner(&document.path).is_none());
            let Some(path) = lost.map(|document| document.path.clone()) else { break };
            let root = match root_of(&path, self.documents.texts()) {
                Root::Folder(folder) if self.programs.iter().any(|p| p.root == Root::Folder(folder.clone())) => {
                    Root::File(path.clone())
                }
                root => root,
            };
            if self.programs.iter().any(|program| program.root == root) {
                // It cannot be read at all; what is wrong is told there.
                break;
            }
            self.begin(root);
        }
    }

    /// Returns the program that a document belongs to: of a text that others include, the one that includes it.
    pub fn owner(&self, path: &Path) -> Option<usize> {
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

    /// Returns the programs that no document belongs to, taken out.
    pub fn take_left(&mut self, keep: impl Fn(&Root) -> bool) -> Vec<Program> {
        let owners: Vec<usize> = self.documents.iter().filter_map(|document| self.owner(&document.path)).collect();
        let mut index = 0;
        let (kept, left): (Vec<Program>, Vec<Program>) =
            std::mem::take(&mut self.programs).into_iter().partition(|p| {
                index += 1;
                owners.contains(&(index - 1)) || keep(&p.root)
            });
        self.programs = kept;
        left
    }

    /// Returns the program of a document, read, and the document's text in it.
    pub fn find(&mut self, path: &Path) -> Result<(&Program, SourceId), Unknown> {
        if self.documents.get(path).is_none() {
            return Err(Unknown);
        }
        self.settle();
        let owner = self.owner(path).ok_or(Unknown)?;
        let program = &self.programs[owner];
        let id = program.id_of(path).ok_or(Unknown)?;
        Ok((program, id))
    }
}
