//! The open project in two versions: as edited, and as on disk.
//!
//! Owns what is unsaved, and the three-way merge of a change on disk: unedited parts follow the disk; a part that was
//! edited and also changed on disk is a conflict for the user to resolve. Reads and writes no file.

use super::{command::DiffLine, structure};
use eddy_project::{Included, Origin, Pass, Project, Source, Tab, name_at};
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
    sync::Arc,
};

/// A project being edited.
#[derive(Clone, Debug)]
pub(super) struct Documents {
    current: Project,
    /// The project on disk as far as is known; for one that is not stored, its initial state.
    saved: Project,
    /// The project as last generated from the texts, if Eddy generates it: what differs from it was changed by the
    /// user. `None` if that is not known.
    generated: Option<Project>,
    /// Tabs whose files are missing on disk: unsaved, whatever their text.
    missing: BTreeSet<Tab>,
    /// The included files as they were when all of them could be read: those of a project that is deleted are not all
    /// deleted at once.
    complete_includes: Vec<Included>,
    revision: u64,
}

/// A part that was edited here and changed on disk.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Conflict {
    pub tab: Tab,
    pub file: PathBuf,
    pub mine: Arc<str>,
    pub disk: Arc<str>,
}

/// The result of merging a change on disk.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Merge {
    /// Tabs that now show the disk's text.
    pub taken: Vec<Tab>,
    /// Passes, channels or names were taken from the disk.
    pub took_structure: bool,
    pub conflicts: Vec<Conflict>,
    /// Passes or channels were changed both here and on disk. None of them were taken from the disk.
    pub structure_conflict: bool,
    /// Tabs whose files are missing; their texts are kept.
    pub gone: Vec<Tab>,
}

impl Merge {
    /// The project must be compiled again.
    pub(crate) fn changes_project(&self) -> bool {
        !self.taken.is_empty() || self.took_structure
    }
}

impl Documents {
    /// A project as it was read or created, with nothing unsaved.
    pub(crate) fn new(project: Project) -> Self {
        let generated = project.dialect.has_main().then(|| project.clone());
        let complete_includes = readable(&project.includes);
        let (saved, missing) = (project.clone(), BTreeSet::new());
        Self { saved, current: project, generated, missing, complete_includes, revision: 0 }
    }

    /// A project with unsaved work, and its version on disk.
    pub(crate) fn restored(mut current: Project, saved: Project) -> Self {
        current.origin = saved.origin.clone();
        let mut saved = saved;
        let edited: Vec<Included> = current.includes.iter().filter(|i| i.is_edited).cloned().collect();
        saved.read_included(edited.iter().map(|i| i.source.name.clone()));
        let is_other = |i: &&Included| !edited.iter().any(|e| e.source.name == i.source.name);
        current.includes = edited.iter().chain(saved.includes.iter().filter(is_other)).cloned().collect();
        for tab in current.tabs() {
            let Some(mine) = current.source_mut(&tab) else { continue };
            mine.path = None;
            if let Some(theirs) = saved.source(&tab) {
                (mine.name, mine.path) = (theirs.name.clone(), theirs.path.clone());
            }
        }
        let (missing, complete_includes) = (BTreeSet::new(), readable(&saved.includes));
        let mut documents = Self { current, saved, generated: None, missing, complete_includes, revision: 0 };
        documents.note_edited();
        documents
    }

    /// Grows with every change, of texts and of what is known of the disk.
    pub(crate) fn revision(&self) -> u64 {
        self.revision
    }

    pub(crate) fn current(&self) -> &Project {
        &self.current
    }

    pub(crate) fn saved(&self) -> &Project {
        &self.saved
    }

    /// For changes of passes, channels and texts alike.
    pub(crate) fn current_mut(&mut self) -> &mut Project {
        self.revision += 1;
        &mut self.current
    }

    /// The project as last generated from the texts.
    pub(crate) fn generated(&self) -> Option<&Project> {
        self.generated.as_ref()
    }

    /// Takes the passes that were generated from the texts, with what the user has changed. Returns whether they differ.
    pub(crate) fn follow_generated(&mut self, now: Project) -> bool {
        let is_other = self.current.follow_generated(self.generated.as_ref().unwrap_or(&now), &now);
        self.generated = Some(now);
        self.revision += u64::from(is_other);
        is_other
    }

    /// Replaces the text of a tab.
    pub(crate) fn set_text(&mut self, tab: &Tab, text: &str) {
        if let Some(source) = self.current_mut().source_mut(tab) {
            source.text = text.into();
        }
        if let Tab::Included(_) = tab {
            self.note_edited();
        }
    }

    /// Takes the included files as they were just read. Texts edited meanwhile are kept. Returns whether an existing
    /// text has changed.
    pub(crate) fn take_includes(&mut self, read: Vec<Included>) -> bool {
        self.revision += 1;
        let is_failed = |i: &Included| read.iter().any(|r| r.source.name == i.source.name && r.trouble.is_some());
        match self.complete_includes.iter().any(is_failed) {
            false => self.complete_includes = readable(&read),
            true => add_missing(&mut self.complete_includes, &readable(&read)),
        }
        let (before, saved) = (std::mem::take(&mut self.current.includes), std::mem::take(&mut self.saved.includes));
        let of = |list: &[Included], name: &str| list.iter().find(|i| i.source.name == name).cloned();
        let mut is_other = false;
        for new in &read {
            let name = &new.source.name;
            // A text that was edited when the read started differs from the disk.
            let base = if new.is_edited { of(&saved, name) } else { Some(new.clone()) };
            let now = match (of(&before, name).filter(|i| i.is_edited), &base) {
                (Some(edited), _) => edited,
                (None, Some(base)) => base.clone(),
                // It was edited when the read started, and has been saved or dropped since.
                (None, None) => continue,
            };
            is_other |= of(&before, name).is_some_and(|before| before.source.text != now.source.text);
            self.current.includes.push(now);
            self.saved.includes.extend(base.map(|base| Included { is_edited: false, ..base }));
        }
        // Edited since, and included by no text that was read.
        for left in before.iter().filter(|i| i.is_edited && of(&read, &i.source.name).is_none()) {
            self.current.includes.insert(0, left.clone());
            self.saved.includes.extend(of(&saved, &left.source.name));
        }
        is_other
    }

    /// Puts back the texts of included files that can no longer be read, because the project was deleted. Returns whether
    /// there were any.
    pub(crate) fn restore_includes(&mut self) -> bool {
        let (lost, before) = (self.complete_includes.clone(), readable(&self.current.includes).len());
        for includes in [&mut self.current.includes, &mut self.saved.includes] {
            let has_lost = |name: &str| lost.iter().any(|i| i.source.name == name);
            includes.retain(|i| i.trouble.is_none() || !has_lost(&i.source.name));
            add_missing(includes, &lost);
        }
        self.revision += 1;
        readable(&self.current.includes).len() != before
    }

    /// Records which included files are edited.
    fn note_edited(&mut self) {
        let edited: BTreeSet<String> = self
            .current
            .includes
            .iter()
            .filter(|i| i.trouble.is_none() && self.is_tab_dirty(&Tab::Included(i.source.name.clone())))
            .map(|i| i.source.name.clone())
            .collect();
        for included in &mut self.current.includes {
            included.is_edited = edited.contains(&included.source.name);
        }
    }

    /// Sets the project as it is on disk now. Returns whether it differs from the edited one, as for an ISF file whose
    /// header was edited: its inputs are the project's uniforms and channels.
    #[must_use]
    pub(crate) fn set_saved(&mut self, project: Project) -> bool {
        let is_as_here =
            structure::is_same(&self.current, &project) && structure::has_same_texts(&self.current, &project);
        *self = Self { revision: self.revision + 1, ..Self::new(project) };
        !is_as_here
    }

    /// Returns the project on disk with the edited texts, if there are any and each belongs to a file of it: this can
    /// be written if the rest cannot.
    pub(crate) fn edited_texts(&self) -> Option<Project> {
        let tabs = self.dirty_tabs();
        let mut project = self.saved.clone();
        for tab in &tabs {
            let source = project.source_mut(tab).filter(|source| source.path.is_some())?;
            source.text = self.current.source(tab)?.text.clone();
        }
        for included in &mut project.includes {
            included.is_edited = tabs.contains(&Tab::Included(included.source.name.clone()));
        }
        (!tabs.is_empty()).then_some(project)
    }

    pub(crate) fn is_tab_dirty(&self, tab: &Tab) -> bool {
        match self.current.source(tab) {
            None => false,
            Some(now) => self.missing.contains(tab) || self.saved_source(tab).is_none_or(|s| s.text != now.text),
        }
    }

    /// Returns whether passes, channels or names differ from those on disk.
    pub(crate) fn is_structure_dirty(&self) -> bool {
        !structure::is_same(&self.current, &self.saved)
    }

    /// Returns the differences from the disk, in words: tabs, then passes, channels and uniforms.
    pub(crate) fn unsaved_parts(&self) -> Vec<String> {
        let tabs = self.dirty_tabs().into_iter().map(|tab| tab.title());
        tabs.chain(structure::differences(&self.current, &self.saved)).collect()
    }

    /// Returns whether the tab's file is known to be missing on disk.
    pub(crate) fn is_missing(&self, tab: &Tab) -> bool {
        self.missing.contains(tab)
    }

    /// Sets the tabs whose files are missing. Returns those that were not known to be.
    pub(crate) fn set_missing(&mut self, missing: BTreeSet<Tab>) -> Vec<Tab> {
        self.revision += u64::from(missing != self.missing);
        let new = missing.difference(&self.missing).cloned().collect();
        self.missing = missing;
        new
    }

    pub(crate) fn dirty_tabs(&self) -> Vec<Tab> {
        self.current.tabs().into_iter().filter(|t| self.is_tab_dirty(t)).collect()
    }

    pub(crate) fn is_dirty(&self) -> bool {
        self.is_structure_dirty()
            || !structure::has_same_texts(&self.current, &self.saved)
            || self.current.includes.iter().any(|i| i.is_edited)
            || self.missing.iter().any(|tab| self.current.source(tab).is_some())
    }

    /// The project's file or folder was renamed to `new`: its texts are in files there, and a name that came from the
    /// old one follows.
    pub(crate) fn follow_move(&mut self, new: &Path) {
        self.revision += 1;
        let generated = self.generated.iter_mut();
        for project in [&mut self.current, &mut self.saved].into_iter().chain(generated) {
            let (Origin::Folder { path: old, .. } | Origin::File(old) | Origin::Json(old)) = &mut project.origin else {
                continue;
            };
            let old = std::mem::replace(old, new.to_owned());
            if project.name == name_at(&old) {
                project.name = name_at(new);
            }
            for tab in project.tabs() {
                let Some(source) = project.source_mut(&tab) else { continue };
                let Some(path) = &mut source.path else { continue };
                if *path == old {
                    *path = new.to_owned();
                    source.name = new.file_name().unwrap_or_default().to_string_lossy().into_owned();
                } else if let Ok(below) = path.strip_prefix(&old) {
                    *path = new.join(below);
                }
            }
        }
    }

    /// Merges the project on disk. Unedited parts are replaced; the rest is returned as conflicts, and its edited text
    /// is kept.
    pub(crate) fn merge(&mut self, mut disk: Project) -> Merge {
        self.revision += 1;
        let mut merge = Merge::default();
        // Also read the files that only a text here includes.
        disk.read_included(self.current.includes.iter().map(|i| i.source.name.clone()));
        self.keep_gone(&mut disk, &mut merge);
        if !structure::is_same(&disk, &self.saved) {
            if !self.is_structure_dirty() {
                self.take_structure(&disk);
                self.generated = disk.dialect.has_main().then(|| disk.clone());
                merge.took_structure = true;
            } else if !structure::is_same(&disk, &self.current) {
                merge.structure_conflict = true;
            }
        }
        for tab in disk.tabs() {
            let here = self.tab_of_file(&disk, &tab);
            let (Some(theirs), Some(mine)) = (disk.source(&tab), self.current.source_mut(&here)) else { continue };
            let base = self.saved.source(&tab);
            let changed_on_disk = base.is_none_or(|s| s.text != theirs.text);
            if !changed_on_disk || mine.text == theirs.text {
                continue;
            }
            if base.is_some_and(|s| s.text == mine.text) {
                mine.text = theirs.text.clone();
                merge.taken.push(here);
            } else {
                let beside = disk.origin.base_dir().unwrap_or(Path::new(""));
                let file = theirs.path.clone().unwrap_or_else(|| beside.join(&theirs.name));
                merge.conflicts.push(Conflict { tab: here, file, mine: mine.text.clone(), disk: theirs.text.clone() });
            }
        }
        // Files may have other names now, and an `eddy.toml` may be new.
        self.current.origin = disk.origin.clone();
        for tab in disk.tabs() {
            if let (Some(theirs), Some(mine)) = (disk.source(&tab), self.current.source_mut(&tab)) {
                (mine.name, mine.path) = (theirs.name.clone(), theirs.path.clone());
            }
        }
        self.saved = disk;
        self.note_edited();
        merge
    }

    /// Takes the structure from the disk after all. Edited texts stay.
    pub(crate) fn take_structure_of_saved(&mut self) {
        self.revision += 1;
        let saved = self.saved.clone();
        self.take_structure(&saved);
        self.generated = saved.dialect.has_main().then_some(saved);
    }

    /// Takes the tab's text from the disk.
    pub(crate) fn take_text_of_saved(&mut self, tab: &Tab) {
        self.revision += 1;
        let text = self.saved_source(tab).map(|saved| saved.text.clone());
        if let (Some(text), Some(mine)) = (text, self.current.source_mut(tab)) {
            mine.text = text;
        }
        self.note_edited();
    }

    /// Returns a tab's text on disk, even if its pass has another name there.
    fn saved_source(&self, tab: &Tab) -> Option<&Source> {
        let path = self.current.source(tab).and_then(|mine| mine.path.as_ref());
        let of_file = || self.saved.tab_sources().find(|s| path.is_some() && s.path.as_ref() == path);
        self.saved.source(tab).or_else(of_file)
    }

    /// Returns the tab here that corresponds to `tab` on disk: a pass that was renamed here is identified by its file.
    fn tab_of_file(&self, disk: &Project, tab: &Tab) -> Tab {
        let path = disk.source(tab).and_then(|theirs| theirs.path.as_ref());
        let is_renamed = self.current.source(tab).is_none() && path.is_some();
        let of_file = |t: &Tab| self.current.source(t).is_some_and(|mine| mine.path.as_ref() == path);
        let found = if is_renamed { self.current.tabs().into_iter().find(of_file) } else { None };
        found.unwrap_or_else(|| tab.clone())
    }

    /// Adds tabs that are no longer on disk to `disk`, unless `eddy.toml` was rewritten without them and nothing in
    /// them is unsaved.
    fn keep_gone(&mut self, disk: &mut Project, merge: &mut Merge) {
        let is_listed = matches!(disk.origin, Origin::Folder { has_manifest: true, .. });
        for tab in self.saved.tabs() {
            // A file that is no longer included is not missing.
            let is_left = matches!(tab, Tab::Included(_)) && !self.is_tab_dirty(&tab);
            if is_left || disk.source(&tab).is_some() {
                self.missing.remove(&tab);
            } else if self.current.source(&tab).is_some() && (!is_listed || self.is_tab_dirty(&tab)) {
                reinsert(disk, &self.saved, &tab);
                if self.missing.insert(tab.clone()) {
                    merge.gone.push(tab);
                }
            }
        }
        // Without `eddy.toml` the channels are inferred from the existing files: a missing file would remove the
        // channels that read it.
        if !is_listed && !self.missing.is_empty() {
            for pass in &mut disk.passes {
                if let Some(saved) = self.saved.pass(&pass.id) {
                    pass.bindings = saved.bindings.clone();
                }
            }
        }
    }

    /// Takes the passes and channels of `disk`, with the edited text of each tab that differs from what was saved.
    fn take_structure(&mut self, disk: &Project) {
        let mut next = disk.clone();
        for tab in disk.tabs() {
            if let (Some(mine), Some(slot)) = (self.current.source(&tab), next.source_mut(&tab)) {
                slot.text = mine.text.clone();
            }
        }
        // The text of a pass that was added here and is not on disk exists nowhere else.
        for tab in self.current.tabs() {
            if next.source(&tab).is_none() && self.is_tab_dirty(&tab) {
                reinsert(&mut next, &self.current, &tab);
            }
        }
        // Which files are included is determined again.
        next.includes = std::mem::take(&mut self.current.includes);
        self.current = next;
    }
}

/// Returns the included files that could be read.
fn readable(includes: &[Included]) -> Vec<Included> {
    includes.iter().filter(|i| i.trouble.is_none()).cloned().collect()
}

/// Adds the files of `from` whose names `to` does not have.
fn add_missing(to: &mut Vec<Included>, from: &[Included]) {
    for included in from {
        if !to.iter().any(|i| i.source.name == included.source.name) {
            to.push(included.clone());
        }
    }
}

/// Copies a tab of `from` into `to`, at its place in the drawing order.
fn reinsert(to: &mut Project, from: &Project, tab: &Tab) {
    match tab {
        Tab::Common => to.common = from.common.clone(),
        Tab::Included(file) => {
            to.includes.retain(|i| i.source.name != *file);
            let there = from.includes.iter().find(|i| i.source.name == *file);
            to.includes.splice(0..0, there.cloned());
        }
        // With the draws that name it, or nothing would use it.
        Tab::Stage(id, _) => {
            if let (Some(from), Some(to)) = (from.pass(id), to.pass_mut(id)) {
                (to.settings, to.body) = (from.settings.clone(), from.body.clone());
            }
        }
        Tab::Pass(id) => {
            if let Some(pass) = from.pass(id) {
                insert_pass(to, pass.clone());
            }
        }
    }
}

/// Inserts a pass according to the order of tabs. Existing passes keep their order, which the author may have chosen.
pub(super) fn insert_pass(project: &mut Project, pass: Pass) {
    let is_before = |other: &Pass| other.id.tab_order(&pass.id).is_lt();
    let mut at = project.passes.iter().rposition(is_before).map_or(0, |i| i + 1);
    // Not within a group, whose passes are drawn one after the other.
    let group_of = |p: Option<&Pass>| project.groups.iter().position(|g| p.is_some_and(|p| g.passes.contains(&p.id)));
    while at > 0 && group_of(project.passes.get(at)).is_some_and(|g| group_of(project.passes.get(at - 1)) == Some(g)) {
        at += 1;
    }
    project.passes.insert(at, pass);
}

/// Returns the lines of both texts as a diff from `disk` to `mine`.
pub(super) fn diff(disk: &str, mine: &str) -> Vec<DiffLine> {
    similar::TextDiff::from_lines(disk, mine)
        .iter_all_changes()
        .map(|change| {
            let line = change.value().trim_end_matches(['\n', '\r']).to_owned();
            match change.tag() {
                similar::ChangeTag::Equal => DiffLine::Both(line),
                similar::ChangeTag::Delete => DiffLine::Disk(line),
                similar::ChangeTag::Insert => DiffLine::Mine(line),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests;
