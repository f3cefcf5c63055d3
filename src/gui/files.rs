//! File dialogs: the desktop's own if it has one, else a field for the path.
//!
//! The desktop's dialog runs on a separate thread, so that the picture continues while it is open; that thread reports
//! the dialog's result.

use super::{
    accessible,
    dialogs::{self, Dialog, Kind, Outcome},
    theme,
    ui_output::{Pick, UiOutput},
};
use crate::{
    background::{Background, Control},
    project::{RECORDING, SOUNDS, expand_home},
};
use egui::{Align, Align2, Area, Button, Frame, Id, Key, Layout, Modal, Order, RichText, TextEdit, Ui, Vec2, vec2};
use std::{
    path::{MAIN_SEPARATOR, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

/// The time that a dialog may take to appear before typing the path is offered.
const PORTAL_TIMEOUT: Duration = Duration::from_secs(1);
/// The minimum size of a dialog's buttons.
const BUTTON: Vec2 = vec2(84.0, 28.0);

pub(super) struct Files {
    wake: Arc<dyn Fn() + Send + Sync>,
    /// Shows a dialog of the desktop and waits for its result.
    desktop: fn(&Dialog) -> Outcome,
    asked: Option<OpenDialog>,
    typing: Option<PathField>,
    /// The widget that gets the keyboard focus in the next frame: in its last frame a modal still takes the focus from
    /// everything below it.
    gets_keyboard: Option<Id>,
}

/// An open dialog of the desktop.
struct OpenDialog {
    pick: Pick,
    start: Option<PathBuf>,
    since: Instant,
    answer: Background<(), (), Outcome>,
}

/// Eddy's own field for a path.
struct PathField {
    pick: Pick,
    path: String,
    is_new: bool,
    /// The widget that had the keyboard focus before, and gets it back.
    before: Option<Id>,
}

/// The result of a dialog.
#[derive(Debug, PartialEq)]
pub(super) enum Picked {
    Path(Pick, PathBuf),
    Cancelled(Pick),
}

impl Files {
    pub(super) fn new(wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        Self { wake, desktop: dialogs::show, asked: None, typing: None, gets_keyboard: None }
    }

    /// Without the desktop's dialogs, which do not exist in tests.
    #[cfg(test)]
    pub(super) fn without_desktop(wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        Self { desktop: |_| Outcome::Unavailable, ..Self::new(wake) }
    }

    /// Opens a dialog. While one is open, another is not opened.
    pub(super) fn ask(&mut self, pick: Pick, start: Option<PathBuf>) {
        if self.asked.is_some() || self.typing.is_some() {
            return;
        }
        let show = self.desktop;
        let dialog = dialog(&pick, start.clone());
        let show = move |_: &Control<()>| Ok(show(&dialog));
        match Background::once("file dialog", "the file dialog", self.wake.clone(), show) {
            Ok(answer) => {
                self.asked = Some(OpenDialog { pick, start, since: Instant::now(), answer: answer.detached() });
            }
            Err(_) => self.type_path(pick, start),
        }
    }

    /// Returns whether a path is being typed.
    pub(super) fn is_asking(&self) -> bool {
        self.typing.is_some() || self.gets_keyboard.is_some()
    }

    fn type_path(&mut self, pick: Pick, start: Option<PathBuf>) {
        let mut path = start.or_else(|| std::env::current_dir().ok()).unwrap_or_default().display().to_string();
        if !path.ends_with(MAIN_SEPARATOR) {
            path.push(MAIN_SEPARATOR);
        }
        if let Pick::SaveAs(name) | Pick::Json(name) | Pick::Page(name) = &pick {
            path.push_str(name);
        }
        self.typing = Some(PathField { pick, path, is_new: true, before: None });
    }

    /// Shows the open dialog, and returns its result once it ends.
    pub(super) fn show(&mut self, ui: &Ui, out: &mut UiOutput) -> Option<Picked> {
        if let Some(id) = self.gets_keyboard.take() {
            ui.memory_mut(|m| m.request_focus(id));
        }
        if let Some(mut asked) = self.asked.take() {
            match asked.answer.take() {
                None if asked.wants_to_type(ui, out) => self.type_path(asked.pick, asked.start),
                None => {
                    self.asked = Some(asked);
                    return None;
                }
                Some(Ok(Outcome::Path(path))) => return Some(Picked::Path(asked.pick, path)),
                Some(Ok(Outcome::Cancelled)) => return Some(Picked::Cancelled(asked.pick)),
                Some(Ok(Outcome::Unavailable) | Err(_)) => self.type_path(asked.pick, asked.start),
            }
        }
        self.path_field(ui, out)
    }

    fn path_field(&mut self, ui: &Ui, out: &mut UiOutput) -> Option<Picked> {
        let typing = self.typing.as_mut()?;
        let (mut done, mut cancelled) = (false, false);
        let (title, action) = match &typing.pick {
            Pick::OpenFolder | Pick::OpenFile => ("Open project", "Open"),
            Pick::SaveAs(_) => ("Save to folder", "Save"),
            Pick::Recording => ("Play recording", "Play"),
            Pick::Json(_) => ("Export to Shadertoy JSON", "Export"),
            Pick::Page(_) => ("Export to HTML page", "Export"),
            Pick::LabFolder => ("Keep lab results in folder", "Keep"),
            Pick::LabReport => ("Write lab report to folder", "Write"),
            Pick::Reference => ("Compare with project", "Compare"),
            Pick::CodeFont => ("Font file for code", "Use"),
            Pick::LibraryFolder => ("Folder of shader libraries", "Use"),
            Pick::Picture { .. } => ("Image or video file for the channel", "Use"),
            Pick::Sound { .. } => ("Music for the channel", "Use"),
        };
        // A modal takes the keyboard focus from everything below it.
        if typing.is_new {
            typing.before = ui.memory(|m| m.focused());
        }
        let modal = Modal::new(Id::unique("path")).frame(theme::dialog(ui.style())).show(ui.ctx(), |ui| {
            ui.set_width((ui.ctx().content_rect().width() - 80.0).min(460.0));
            ui.heading(title);
            ui.add_space(4.0);
            ui.colored_label(theme::of(ui).weak, help(&typing.pick));
            let field = ui.add(TextEdit::singleline(&mut typing.path).desired_width(f32::INFINITY));
            accessible::name(&field, egui::Role::TextInput, "Path");
            out.place("field:path", field.rect);
            if std::mem::take(&mut typing.is_new) {
                field.request_focus();
                let end = egui::text::CCursor::new(typing.path.chars().count());
                // The file name, after the folder, is selected because it is what one usually replaces.
                let start = typing.path.rfind(MAIN_SEPARATOR).map_or(0, |at| typing.path[..=at].chars().count());
                if let Some(mut state) = TextEdit::load_state(ui.ctx(), field.id) {
                    let range = egui::text::CCursorRange::two(egui::text::CCursor::new(start), end);
                    state.cursor.set_char_range(Some(range));
                    state.store(ui.ctx(), field.id);
                }
            }
            done |= field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            ui.add_space(8.0);
            let row = vec2(ui.available_width(), BUTTON.y);
            ui.allocate_ui_with_layout(row, Layout::right_to_left(Align::Center), |ui| {
                // The accent colour marks the button that Enter presses, as in every dialog.
                let p = theme::of(ui);
                let ok = Button::new(RichText::new(action).color(p.strong)).fill(p.accent_fill).min_size(BUTTON);
                let ok = ui.add_enabled(!typing.path.trim().is_empty(), ok);
                done |= out.clicked("button:path-ok", &ok);
                let cancel = ui.add(Button::new("Cancel").min_size(BUTTON));
                cancelled |= out.clicked("button:path-cancel", &cancel);
            });
        });
        let is_done = done && !typing.path.trim().is_empty();
        let is_cancelled = cancelled || modal.should_close();
        if let Some(before) = typing.before.filter(|_| is_done || is_cancelled) {
            self.gets_keyboard = Some(before);
            ui.ctx().request_repaint();
        }
        if is_done {
            let typing = self.typing.take()?;
            return Some(Picked::Path(typing.pick, expand_home(typing.path.trim())));
        }
        if is_cancelled {
            return self.typing.take().map(|t| Picked::Cancelled(t.pick));
        }
        None
    }
}

impl OpenDialog {
    /// Offers to type the path while a dialog of the desktop is open, in case it is hidden or hangs.
    fn wants_to_type(&self, ui: &Ui, out: &mut UiOutput) -> bool {
        if let Some(wait) = PORTAL_TIMEOUT.checked_sub(self.since.elapsed()) {
            ui.ctx().request_repaint_after(wait);
            return false;
        }
        let area = Area::new(Id::unique("file dialog")).order(Order::Foreground);
        let area = area.anchor(Align2::CENTER_BOTTOM, vec2(0.0, -52.0));
        out.show_area("file dialog", area, ui, |ui, out| {
            Frame::popup(ui.style())
                .fill(theme::of(ui).raised)
                .show(ui, |ui| {
                    ui.horizontal(|ui| {
                        ui.label("Waiting for the file dialog");
                        out.clicked("button:type-path", &ui.button("Type a path instead"))
                    })
                    .inner
                })
                .inner
        })
    }
}

/// File extensions of images and videos that a channel can show.
const SHOWN: [&str; 20] = [
    "png", "jpg", "jpeg", "webp", "bmp", "tga", "gif", "hdr", "exr", "ktx2", "dds", "mp4", "webm", "mkv", "mov", "m4v",
    "ogv", "avi", "mpg", "mpeg",
];

fn help(pick: &Pick) -> &'static str {
    match pick {
        Pick::OpenFolder | Pick::OpenFile => {
            "A folder with eddy.toml, a folder of .glsl files, a .glsl file, ISF, an image, a video, a model, or a Shadertoy .json"
        }
        Pick::SaveAs(_) => "A folder for the project; it is created if missing",
        Pick::Recording => "A .replay file that Record input has saved",
        Pick::Json(_) => "A .json file; Eddy asks before replacing one",
        Pick::Page(_) => "A .html file; Eddy asks before replacing one",
        Pick::LabFolder => "A folder for results.jsonl; a stopped run resumes there",
        Pick::Reference => {
            "A folder with eddy.toml, a folder of .glsl files, a .glsl file, ISF, an image, a video, a model, or a Shadertoy .json"
        }
        Pick::LabReport => "An empty or new folder for tables, plots and index.html",
        Pick::CodeFont => "A .ttf or .otf file",
        Pick::LibraryFolder => "The folder that contains a library, such as the folder lygia",
        Pick::Picture { .. } => {
            "An image (png, jpg, webp, bmp, tga, gif, hdr, exr, ktx2, dds) or a video (mp4, webm, mkv, mov)"
        }
        Pick::Sound { .. } => "An mp3, ogg, wav, flac, m4a, aac or aiff file",
    }
}

fn dialog(pick: &Pick, start: Option<PathBuf>) -> Dialog {
    let (title, kind) = match pick {
        Pick::OpenFolder => ("Open project folder", Kind::OpenFolder),
        Pick::OpenFile => ("Open shader", Kind::OpenFile("Shaders", &["glsl", "frag", "json", "toml", RECORDING])),
        Pick::Recording => ("Play recording", Kind::OpenFile("Recordings", &[RECORDING])),
        Pick::Json(name) => ("Export to Shadertoy JSON", Kind::Save(name.clone())),
        Pick::Page(name) => ("Export to HTML page", Kind::Save(name.clone())),
        Pick::LabFolder => ("Keep lab results in folder", Kind::OpenFolder),
        Pick::LabReport => ("Write lab report to folder", Kind::OpenFolder),
        Pick::Reference => ("Compare with project folder", Kind::OpenFolder),
        Pick::SaveAs(name) => ("Save to folder", Kind::Save(name.clone())),
        Pick::LibraryFolder => ("Folder of shader libraries", Kind::OpenFolder),
        Pick::CodeFont => ("Font file for code", Kind::OpenFile("Fonts", &["ttf", "otf"])),
        Pick::Picture { .. } => ("Image or video file for the channel", Kind::OpenFile("Images and videos", &SHOWN)),
        Pick::Sound { .. } => ("Music for the channel", Kind::OpenFile("Sound files", &SOUNDS)),
    };
    Dialog { title, kind, start }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicBool, Ordering};

    /// Runs frames until a dialog has ended or the field for the path appears.
    fn end_of(desktop: fn(&Dialog) -> Outcome, between_frames: Duration) -> (Option<Picked>, bool) {
        let woken = Arc::new(AtomicBool::new(false));
        let flag = woken.clone();
        let mut files = Files { desktop, ..Files::new(Arc::new(move || flag.store(true, Ordering::Release))) };
        files.ask(Pick::SaveAs("mine".into()), Some("/begin".into()));
        let ctx = egui::Context::default();
        let give_up = Instant::now() + Duration::from_secs(10);
        loop {
            std::thread::sleep(between_frames);
            let mut out = UiOutput::default();
            let mut picked = None;
            let mut output = ctx.run_ui(egui::RawInput::default(), |ui| picked = files.show(ui, &mut out));
            output.textures_delta.clear();
            if picked.is_some() || files.typing.is_some() {
                while !woken.load(Ordering::Acquire) {
                    assert!(Instant::now() < give_up, "the window sleeps until it is woken");
                    std::thread::yield_now();
                }
                assert!(files.asked.is_none());
                return (picked, files.typing.is_some_and(|t| t.path == "/begin/mine"));
            }
            assert!(Instant::now() < give_up);
        }
    }

    #[test]
    fn every_extension_of_images_and_videos_is_offered() {
        assert!(SHOWN.iter().eq(crate::project::PICTURES.iter().chain(&crate::project::VIDEOS)));
    }

    #[test]
    fn the_path_field_appears_without_a_desktop_dialog() {
        let late = |_: &Dialog| {
            std::thread::sleep(Duration::from_millis(600));
            Outcome::Unavailable
        };
        assert_eq!(end_of(|_| Outcome::Unavailable, Duration::from_millis(600)), (None, true));
        assert_eq!(end_of(late, Duration::from_millis(5)), (None, true));
        assert_eq!(end_of(|_| panic!("planted"), Duration::from_millis(5)), (None, true));
    }

    #[test]
    fn closing_a_dialog_at_once_cancels_it() {
        let pick = || Pick::SaveAs("mine".into());
        assert_eq!(end_of(|_| Outcome::Cancelled, Duration::ZERO), (Some(Picked::Cancelled(pick())), false));
        let path = PathBuf::from("/there");
        let chosen = |_: &Dialog| Outcome::Path("/there".into());
        assert_eq!(end_of(chosen, Duration::ZERO), (Some(Picked::Path(pick(), path)), false));
    }
}
