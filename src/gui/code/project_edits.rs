//! Changes of several texts at once: a quick fix, a rename, a replacement in all passes. Undo and redo apply to all of
//! them, as long as none of them was edited since.

use super::CodePanel;
use crate::{
    gui::{
        editor::{Buffer, CodeEditor},
        ui_output::UiOutput,
    },
    project::Tab,
    session::{EditCommand, Session, TabEdit, TabFix},
};
use std::{collections::BTreeMap, ops::Range};

/// The number of edits of several texts that can be undone as one step.
const MAX_JOINED: usize = 200;

impl CodePanel {
    /// Makes all edits of a fix. Fails without changing anything if one of the texts has changed since.
    pub(crate) fn apply_fix(&mut self, fix: &TabFix, out: &mut UiOutput) -> Result<(), &'static str> {
        let mut parts: BTreeMap<Tab, Vec<(Range<usize>, String)>> = BTreeMap::new();
        for TabEdit { tab, range, replaced, text } in &fix.edits {
            let there = self.editors.get(tab).and_then(|editor| editor.buffer().text().get(range.clone()));
            if there != Some(replaced) {
                return Err("The text has changed since: compile it and try again");
            }
            parts.entry(tab.clone()).or_default().push((range.clone(), text.clone()));
        }
        let tabs: Vec<Tab> = parts.keys().cloned().collect();
        for (tab, mut parts) in parts {
            parts.sort_by_key(|(range, _)| (range.start, range.end));
            if let Some(editor) = self.editors.get_mut(&tab) {
                editor.edit(|buffer| buffer.replace_parts(parts));
            }
        }
        self.join_steps(&tabs);
        if let Some(tab) = fix.edits.first().map(|edit| edit.tab.clone()) {
            self.bring(tab);
            self.focus();
        }
        self.report_changed(out);
        Ok(())
    }

    /// Applies the fixes of all problems that have exactly one. Returns their number.
    pub(crate) fn fix_all(&mut self, session: &Session, out: &mut UiOutput) -> Result<usize, &'static str> {
        let mut all: Option<TabFix> = None;
        let mut count = 0;
        for problem in session.diagnostics() {
            let [fix] = problem.fixes.as_slice() else { continue };
            let edits = &mut all.get_or_insert_with(|| TabFix { edits: Vec::new(), ..fix.clone() }).edits;
            let overlaps = |edit: &TabEdit| {
                let is_other = |b: &TabEdit| edit.range.end < b.range.start || b.range.end < edit.range.start;
                edits.iter().any(|other| other.tab == edit.tab && !is_other(other))
            };
            // What two problems would change is left for the next time.
            if !fix.edits.iter().any(overlaps) {
                edits.extend(fix.edits.iter().cloned());
                count += 1;
            }
        }
        if let Some(fix) = all {
            self.apply_fix(&fix, out)?;
        }
        Ok(count)
    }

    /// Makes the newest steps of these texts one step of undo.
    pub(super) fn join_steps(&mut self, tabs: &[Tab]) {
        let step = |tab: &Tab| Some((tab.clone(), self.editors.get(tab)?.buffer().done_step()?));
        let steps: BTreeMap<Tab, u64> = tabs.iter().filter_map(step).collect();
        if steps.len() > 1 {
            self.joined_steps.push(steps);
            // The memory of long sessions is bounded.
            let extra = self.joined_steps.len().saturating_sub(MAX_JOINED);
            self.joined_steps.drain(..extra);
        }
    }

    /// Undoes and redoes in the other texts what was undone and redone in the one in front as a part of one step.
    pub(super) fn follow_undo(&mut self) {
        let Some(editor) = self.editors.get_mut(&self.current) else { return };
        for (step, is_redo) in editor.edit(Buffer::take_reverted) {
            let is_it = |steps: &&BTreeMap<Tab, u64>| steps.get(&self.current) == Some(&step);
            let Some(steps) = self.joined_steps.iter().find(is_it).cloned() else { continue };
            for (tab, step) in steps.iter().filter(|(tab, _)| **tab != self.current) {
                let Some(editor) = self.editors.get_mut(tab) else { continue };
                editor.edit(|buffer| {
                    let next = if is_redo { buffer.undone_step() } else { buffer.done_step() };
                    if next == Some(*step) {
                        if is_redo {
                            buffer.redo()
                        } else {
                            buffer.undo()
                        };
                    }
                    buffer.take_reverted()
                });
            }
        }
    }

    /// Pastes over the selection of the text in front.
    pub(crate) fn paste(&mut self, text: String) {
        if let Some(editor) = self.editors.get_mut(&self.current) {
            editor.paste(text);
        }
    }

    /// Reports the texts that have changed to the session.
    pub(super) fn report_changed(&mut self, out: &mut UiOutput) {
        for (tab, editor) in &mut self.editors {
            if let Some(text) = CodeEditor::take_changed(editor) {
                out.ask(EditCommand::EditText { tab: tab.clone(), text: text.to_owned() });
                self.problem = None;
                // Its places refer to the old text.
                self.uses = None;
            }
        }
    }
}
