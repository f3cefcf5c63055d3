//! The panel that makes films: the choices, errors in them, two buttons, and the progress of a film.
//!
//! The session evaluates the choices ([`FilmForm`]); they are shown and typed here.

mod fields;
mod panel;
mod report;

pub(super) use panel::PANEL;
pub(super) use report::report;

use super::{settings::Change, ui_output::ShellCommand};
use crate::session::FilmForm;

/// The choices while they are typed. They belong to the user, and are kept when another project is opened.
#[derive(Debug, Default)]
pub(super) struct Recorder {
    form: FilmForm,
    /// The choices in the settings.
    saved: Option<FilmForm>,
    /// The existing file of the typed name may be replaced.
    replaces: bool,
    /// The encoders of ffmpeg were requested.
    has_asked: bool,
}

impl Recorder {
    /// Takes over the choices of the settings if they have changed.
    fn follow(&mut self, settings: &FilmForm) {
        if self.saved.as_ref() != Some(settings) {
            let file = std::mem::take(&mut self.form.file);
            self.form = FilmForm { file, ..settings.clone() };
            self.saved = Some(settings.clone());
        }
    }

    /// Returns the change of the settings, if the choices have changed and nothing is being typed.
    fn change(&mut self, is_typing: bool, has_errors: bool) -> Option<ShellCommand> {
        let now = FilmForm { file: String::new(), ..self.form.clone() };
        if is_typing || has_errors || self.saved.as_ref() == Some(&now) {
            return None;
        }
        self.saved = Some(now.clone());
        Some(ShellCommand::Set(Change::Recorder(now)))
    }

    /// Sets other choices: permission to replace a file does not apply to another name.
    fn set(&mut self, form: FilmForm) {
        if self.form.file != form.file || self.form.format != form.format {
            self.replaces = false;
        }
        self.form = form;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Format;

    #[test]
    fn choices_follow_the_settings_and_are_saved_when_valid() {
        let mut recorder = Recorder::default();
        let settings = FilmForm { fps: "25".into(), ..FilmForm::default() };
        recorder.follow(&settings);
        assert_eq!(recorder.form, settings);
        assert_eq!(recorder.change(false, false), None, "they are the settings'");
        recorder.set(FilmForm { format: Format::Gif, file: "a".into(), ..settings.clone() });
        assert_eq!(recorder.change(true, false), None);
        assert_eq!(recorder.change(false, true), None);
        let wanted = FilmForm { format: Format::Gif, ..settings.clone() };
        assert_eq!(recorder.change(false, false), Some(ShellCommand::Set(Change::Recorder(wanted.clone()))));
        recorder.follow(&wanted);
        assert_eq!(recorder.form.file, "a", "the name is not one of the settings");
        recorder.follow(&settings);
        assert_eq!((recorder.form.format, recorder.form.file.as_str()), (Format::Mp4, "a"), "the file was edited");
        recorder.replaces = true;
        recorder.set(FilmForm { fps: "30".into(), ..recorder.form.clone() });
        assert!(recorder.replaces);
        recorder.set(FilmForm { file: "b".into(), ..recorder.form.clone() });
        assert!(!recorder.replaces, "another file");
    }
}
