//! Passes that follow edits of the file that they are generated from.

use crate::{EditedTexts, MAX_CHANNELS, Origin, Pass, Project, Source, locate::load_edited};
use std::path::Path;

/// Returns the project that the texts of a project make, if it is generated from a file. Returns `None` for texts from
/// which no project can be generated, as while they are typed.
pub fn regenerated(project: &Project) -> Option<Project> {
    let Origin::File(path) = &project.origin else { return None };
    if !project.dialect.has_main() {
        return None;
    }
    load_edited(path, &texts(project, path)).ok().map(|loaded| loaded.project).filter(|now| now.dialect.has_main())
}

/// Returns the texts of the files of a project that is generated from `path`.
pub(super) fn texts(project: &Project, path: &Path) -> EditedTexts {
    let folder = path.parent().unwrap_or(Path::new(""));
    let place = |source: &Source| source.path.clone().unwrap_or_else(|| folder.join(&source.name));
    let readable = project.includes.iter().filter(|included| included.trouble.is_none());
    readable.map(|included| (place(&included.source), included.source.text.clone())).collect()
}

impl Project {
    /// Takes what has changed between two generated projects. What differs here from `before` was changed by the user,
    /// and stays. Returns whether anything is different.
    pub fn follow_generated(&mut self, before: &Project, now: &Project) -> bool {
        let mut next = self.clone();
        next.dialect = now.dialect;
        let kept = |pass: &Pass| before.pass(&pass.id).is_none() && now.pass(&pass.id).is_none();
        let is_removed = |pass: &Pass| before.pass(&pass.id).is_some() && self.pass(&pass.id).is_none();
        next.passes = self.passes.iter().filter(|pass| kept(pass)).cloned().collect();
        for pass in now.passes.iter().filter(|pass| !is_removed(pass)) {
            next.passes.push(match (before.pass(&pass.id), self.pass(&pass.id)) {
                (Some(before), Some(mine)) => followed(mine, before, pass),
                _ => pass.clone(),
            });
        }
        let text = |project: &Project| project.common.as_ref().map(|common| common.text.clone());
        if text(self) == text(before) {
            next.common.clone_from(&now.common);
        }
        if self.info == before.info {
            next.info.clone_from(&now.info);
        }
        if self.groups == before.groups {
            next.groups.clone_from(&now.groups);
        }
        let same_texts = || self.tab_sources().map(|s| &s.text).eq(next.tab_sources().map(|s| &s.text));
        let is_same = self.dialect == next.dialect
            && self.passes.len() == next.passes.len()
            && self.passes.iter().zip(&next.passes).all(|(a, b)| is_same_pass(a, b))
            && self.info == next.info
            && self.groups == next.groups
            && same_texts();
        if !is_same {
            *self = next;
        }
        !is_same
    }
}

fn is_same_pass(a: &Pass, b: &Pass) -> bool {
    a.id == b.id && a.settings == b.settings && a.body == b.body && a.bindings == b.bindings
}

/// Returns the newly generated pass with the user's changes.
fn followed(mine: &Pass, before: &Pass, now: &Pass) -> Pass {
    let mut pass = now.clone();
    if mine.settings != before.settings {
        pass.settings = mine.settings.clone();
    }
    if mine.body != before.body {
        pass.body = mine.body.clone();
    }
    if mine.source.text != before.source.text {
        pass.source = mine.source.clone();
    }
    let mut keep = |slot: usize, here: Option<usize>, there: Option<usize>| {
        if let (Some(here), Some(there)) = (here, there)
            && mine.bindings.get(here) != before.bindings.get(there)
        {
            pass.bindings.set(slot, mine.bindings.get(here).cloned());
        }
    };
    // A texture is identified by its name, which may have another number now.
    let slot_of =
        |pass: &Pass, name: &str| pass.bindings.names().find(|(_, known)| *known == name).map(|(slot, _)| slot);
    for slot in 0..MAX_CHANNELS {
        match now.bindings.name(slot) {
            Some(name) => keep(slot, slot_of(mine, name), slot_of(before, name)),
            None => keep(slot, Some(slot), Some(slot)),
        }
    }
    pass
}
