//! The bars over the code: find, rename, and go to line.

use super::{CodePanel, find_bar::FindBarAction, places, rename_bar::Renamed};
use crate::{
    gui::{
        accessible,
        ui_output::{ShellCommand, UiOutput},
    },
    session::Session,
};
use egui::{Key, TextEdit, Ui};

impl CodePanel {
    pub(super) fn find_bar(&mut self, ui: &mut Ui, out: &mut UiOutput) {
        let Some(editor) = self.editors.get(&self.current) else { return };
        let asked = self.find.show(ui, &self.current, editor, self.everywhere.count(), out);
        // During typing, Escape first reduces several carets to one.
        let is_for_code = self.has_keys(ui.ctx()) && self.buffer().is_some_and(|b| b.carets().list().len() > 1);
        match asked {
            FindBarAction::Step(forward) => self.find_next(forward),
            FindBarAction::Replace => {
                if let Some(editor) = self.editors.get_mut(&self.current) {
                    self.find.replace_one(&self.current, editor);
                }
                self.report_changed(out);
                self.find_next(true);
            }
            FindBarAction::ReplaceAll => self.replace_all(out),
            FindBarAction::Nothing | FindBarAction::Close => {}
        }
        if asked == FindBarAction::Close || (ui.input(|i| i.key_pressed(Key::Escape)) && !is_for_code) {
            self.find.close();
            self.focus();
        }
    }

    pub(super) fn rename_bar(&mut self, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
        let Some(bar) = &mut self.rename else { return };
        match bar.show(ui, session, out) {
            Renamed::Nothing => return,
            Renamed::Closed => self.focus(),
            Renamed::To(fix) => out.shell_commands.push(ShellCommand::Fix(fix)),
        }
        self.rename = None;
    }

    pub(super) fn go_to_bar(&mut self, ui: &mut Ui, out: &mut UiOutput) {
        let take_focus = std::mem::take(&mut self.bar_takes_focus);
        let Some(text) = &mut self.go_to_line else { return };
        let mut done = false;
        ui.horizontal(|ui| {
            ui.label("Line");
            let field = ui.add(TextEdit::singleline(text).hint_text("12 or 12:5").desired_width(90.0));
            accessible::name(&field, egui::Role::TextInput, "Line");
            out.place("field:line", field.rect);
            if take_focus {
                field.request_focus();
            }
            let entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            done = entered || ui.button("Go").clicked();
        });
        let place = places::parse(text);
        let closed = ui.input(|i| i.key_pressed(Key::Escape));
        if done || closed {
            self.go_to_line = None;
            match place.filter(|_| done) {
                Some(place) => self.go_to(self.current.clone(), Some(place)),
                None => self.focus(),
            }
        }
    }
}
