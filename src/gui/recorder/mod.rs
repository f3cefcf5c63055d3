//! The panel that makes films: the choices, what is wrong with them, two buttons, and how far a film is.
//!
//! The session says what the choices come to ([`FilmForm`]); here they are shown and typed.

mod fields;
mod panel;
mod report;

pub(super) use panel::show;
pub(super) use report::report;

use super::{settings::Change, ui_output::ShellCommand};
use crate::session::FilmForm;

/// The choices while they are typed. They are the person's, and stay when another project is opened.
#[derive(Debug, Default)]
pub(super) struct Recorder {
    form: FilmForm,
    /// As the settings have them.
    kept: Option<FilmForm>,
    /// A file that is there may be replaced: said for the name that is typed.
    replaces: bool,
    /// The encoders of ffmpeg were asked for.
    has_asked: bool,
}

impl Recorder {
    /// Takes the choices of the settings where these are others than before.
    fn follow(&mut self, settings: &FilmForm) {
        if self.kept.as_ref() != Some(settings) {
            let file = std::mem::take(&mut self.form.file);
            self.form = FilmForm { file, ..settings.clone() };
            self.kept = Some(settings.clone());
        }
    }

    /// Returns the change of the settings, where the choices are others and nobody is typing.
    fn change(&mut self, is_typing: bool, has_errors: bool) -> Option<ShellCommand> {
        let now = FilmForm { file: String::new(), ..self.form.clone() };
        if is_typing || has_errors || self.kept.as_ref() == Some(&now) {
            return None;
        }
        self.kept = Some(now.clone());
        Some(ShellCommand::Set(Change::Recorder(now)))
    }

    /// Chooses something else: another name is not one that may be replaced.
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
    fn choices_follow_the_settings_and_are_kept_when_they_are_whole() {
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
