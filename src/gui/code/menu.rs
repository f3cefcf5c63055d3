//! The context menu of the code, by a right click or the keys for menus.

use crate::{
    gui::{
        actions::{Action, TraceAction},
        editor::EditorAction as Code,
        menus,
        ui_output::UiOutput,
    },
    session::Session,
};
use egui::{Button, Response, Ui};

/// Shows the menu while it is open. `has_selection`: there is something to cut; `has_fix`: a problem at the caret has
/// a fix.
pub(super) fn show(response: &Response, session: &Session, has_fix: bool, out: &mut UiOutput) {
    menus::context(response, |ui| {
        let mut item = |ui: &mut Ui, name: &str, title: &str, action: Action, keys: &str, is_on: bool| {
            let keys = if keys.is_empty() { out.keys.hint(action) } else { keys.to_owned() };
            let button = ui.add_enabled(is_on, Button::new(title).shortcut_text(keys));
            out.on_menu_click(ui, &format!("code-menu:{name}"), &button, action);
        };
        let ctrl = |key: &str| format!("{}{key}", if cfg!(target_os = "macos") { "Cmd+" } else { "Ctrl+" });
        item(ui, "cut", "Cut", Action::Code(Code::Cut), &ctrl("X"), true);
        item(ui, "copy", "Copy", Action::Code(Code::Copy), &ctrl("C"), true);
        item(ui, "paste", "Paste", Action::Code(Code::Paste), &ctrl("V"), true);
        ui.separator();
        item(ui, "definition", "Go to definition", Action::Code(Code::Definition), "", true);
        item(ui, "references", "Find references", Action::Code(Code::Uses), "", true);
        item(ui, "rename", "Rename symbol…", Action::Code(Code::Rename), "", true);
        item(ui, "fix", "Quick fix…", Action::Code(Code::QuickFix), "", has_fix);
        ui.separator();
        let probes = if session.probe().is_some() { "Stop the probe" } else { "Probe this value" };
        item(ui, "probe", probes, Action::Probe, "", true);
        item(ui, "trace", "Trace a pixel…", Action::TracePixel, "", true);
        item(ui, "breakpoint", "Toggle breakpoint", Action::Trace(TraceAction::Breakpoint), "", true);
    });
}
