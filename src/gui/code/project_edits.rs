//! Changes of several texts at once: a quick fix, a rename, a replacement in all passes. Each text is reverted by its
//! own undo.

use super::CodePanel;
use crate::{
    gui::{editor::CodeEditor, ui_output::UiOutput},
    project::Tab,
    session::{EditCommand, TabEdit, TabFix},
};
use std::{collections::BTreeMap, ops::Range};

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
        for (tab, mut parts) in parts {
            parts.sort_by_key(|(range, _)| (range.start, range.end));
            if let Some(editor) = self.editors.get_mut(&tab) {
                editor.edit(|buffer| buffer.replace_parts(parts));
            }
        }
        if let Some(tab) = fix.edits.first().map(|edit| edit.tab.clone()) {
            self.bring(tab);
            self.focus();
        }
        self.report_changed(out);
        Ok(())
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
