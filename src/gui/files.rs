//! File dialogs: the desktop's own where there is one, else a field for the path.
//!
//! The desktop's dialog runs on a thread of its own, so the picture goes on while it is open.

use super::{
    outbox::{Outbox, Pick, Wish},
    theme,
};
use egui::{Id, Key, Modal, TextEdit, Ui};
use std::{
    path::PathBuf,
    sync::{
        Arc,
        mpsc::{Receiver, TryRecvError, channel},
    },
    time::{Duration, Instant},
};

/// A dialog that is gone sooner than this was never seen: no person cancels so fast. It means that the desktop has none
/// (no portal answers), which the dialogs' library does not tell from a cancel.
const UNSEEN: Duration = Duration::from_millis(400);

pub struct Files {
    wake: Arc<dyn Fn() + Send + Sync>,
    asked: Option<Asked>,
    typing: Option<Typing>,
}

/// A dialog of the desktop's that is open.
struct Asked {
    pick: Pick,
    since: Instant,
    answer: Receiver<Option<PathBuf>>,
}

/// Our own field for a path.
struct Typing {
    pick: Pick,
    path: String,
    is_new: bool,
}

/// The outcome of a dialog.
pub enum Picked {
    Path(Pick, PathBuf),
    Cancelled(Pick),
}

impl Files {
    pub fn new(wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        Self { wake, asked: None, typing: None }
    }

    /// Opens a dialog. One at a time: a second is not opened over it.
    pub fn ask(&mut self, pick: Pick, start: Option<PathBuf>) {
        if self.asked.is_some() || self.typing.is_some() {
            return;
        }
        let (sender, answer) = channel();
        let (wake, wanted) = (self.wake.clone(), pick.clone());
        let spawned = std::thread::Builder::new().name("file dialog".into()).spawn(move || {
            // A receiver that is gone no longer wants the answer.
            let _ = sender.send(desktop_dialog(&wanted, start));
            wake();
        });
        match spawned {
            Ok(_) => self.asked = Some(Asked { pick, since: Instant::now(), answer }),
            Err(_) => self.type_path(pick),
        }
    }

    fn type_path(&mut self, pick: Pick) {
        let mut path = std::env::current_dir().map(|d| d.display().to_string()).unwrap_or_default();
        if !path.ends_with(std::path::MAIN_SEPARATOR) {
            path.push(std::path::MAIN_SEPARATOR);
        }
        if let Pick::SaveAs(name) = &pick {
            path.push_str(name);
        }
        self.typing = Some(Typing { pick, path, is_new: true });
    }

    /// Shows what is to be shown; a dialog's end.
    pub fn show(&mut self, ui: &Ui, out: &mut Outbox) -> Option<Picked> {
        if let Some(asked) = &self.asked {
            let answer = match asked.answer.try_recv() {
                Err(TryRecvError::Empty) => return None,
                Err(TryRecvError::Disconnected) => None,
                Ok(path) => path,
            };
            let asked = self.asked.take()?;
            match answer {
                Some(path) => return Some(Picked::Path(asked.pick, path)),
                None if asked.since.elapsed() < UNSEEN => self.type_path(asked.pick),
                None => return Some(Picked::Cancelled(asked.pick)),
            }
        }
        let typing = self.typing.as_mut()?;
        let (mut done, mut cancelled) = (false, false);
        let (title, action) = match &typing.pick {
            Pick::OpenFolder | Pick::OpenFile => ("Open a project", "Open"),
            Pick::SaveAs(_) => ("Save into a folder", "Save"),
            Pick::LabFolder => ("Keep the lab's results in a folder", "Keep"),
            Pick::LabReport => ("Write the lab's report into a folder", "Write"),
            Pick::Picture { .. } => ("A picture for the channel", "Use"),
        };
        let modal = Modal::new(Id::unique("path")).frame(theme::dialog(ui.style())).show(ui.ctx(), |ui| {
            ui.set_width((ui.ctx().content_rect().width() - 80.0).min(460.0));
            ui.heading(title);
            ui.add_space(4.0);
            ui.colored_label(theme::WEAK, help(&typing.pick));
            let field = ui.add(TextEdit::singleline(&mut typing.path).desired_width(f32::INFINITY));
            out.place("field:path", field.rect);
            if std::mem::take(&mut typing.is_new) {
                field.request_focus();
                let end = egui::text::CCursor::new(typing.path.chars().count());
                if let Some(mut state) = TextEdit::load_state(ui.ctx(), field.id) {
                    state.cursor.set_char_range(Some(egui::text::CCursorRange::one(end)));
                    state.store(ui.ctx(), field.id);
                }
            }
            done |= field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            ui.add_space(8.0);
            ui.horizontal(|ui| {
                let ok = ui.add_enabled(!typing.path.trim().is_empty(), egui::Button::new(action));
                done |= out.clicked("button:path-ok", &ok);
                cancelled |= ui.button("Cancel").clicked();
            });
        });
        if done && !typing.path.trim().is_empty() {
            let typing = self.typing.take()?;
            return Some(Picked::Path(typing.pick, expand_home(typing.path.trim())));
        }
        if cancelled || modal.should_close() {
            return self.typing.take().map(|t| Picked::Cancelled(t.pick));
        }
        None
    }

    /// Takes files dropped on the window: the first is opened, or becomes a channel's picture.
    pub fn dropped(ui: &Ui, channel: impl Fn(egui::Pos2) -> Option<usize>, out: &mut Outbox) {
        let (files, at) = ui.input(|i| (i.raw.dropped_files.clone(), i.pointer.latest_pos()));
        let Some(file) = files.first() else { return };
        let path = file.path().to_owned();
        let pick = match at.and_then(channel).filter(|_| is_picture(&path)) {
            Some(channel) => Pick::Picture { channel },
            None if is_picture(&path) => Pick::Picture { channel: 0 },
            None => Pick::OpenFile,
        };
        out.wishes.push(Wish::Picked(pick, path));
    }
}

const PICTURES: [&str; 8] = ["png", "jpg", "jpeg", "webp", "bmp", "tga", "gif", "hdr"];

fn is_picture(path: &std::path::Path) -> bool {
    path.extension().is_some_and(|e| PICTURES.iter().any(|p| e.eq_ignore_ascii_case(p)))
}

fn help(pick: &Pick) -> &'static str {
    match pick {
        Pick::OpenFolder | Pick::OpenFile => {
            "A folder with eddy.toml, a folder of .glsl files, one .glsl file, or a Shadertoy .json"
        }
        Pick::SaveAs(_) => "A folder for the project; it is made if it is not there",
        Pick::LabFolder => "A folder for results.jsonl; a run that was stopped there goes on",
        Pick::LabReport => "An empty or a new folder for tables, plots and index.html",
        Pick::Picture { .. } => "png, jpg, webp, bmp, tga, gif or hdr",
    }
}

fn expand_home(path: &str) -> PathBuf {
    match (path.strip_prefix("~/"), std::env::home_dir()) {
        (Some(rest), Some(home)) => home.join(rest),
        _ => PathBuf::from(path),
    }
}

fn desktop_dialog(pick: &Pick, start: Option<PathBuf>) -> Option<PathBuf> {
    let mut dialog = rfd::FileDialog::new();
    if let Some(start) = start {
        dialog = dialog.set_directory(start);
    }
    match pick {
        Pick::OpenFolder => dialog.set_title("Open a project's folder").pick_folder(),
        Pick::OpenFile => {
            dialog.set_title("Open a shader").add_filter("Shaders", &["glsl", "frag", "json", "toml"]).pick_file()
        }
        Pick::LabFolder => dialog.set_title("Keep the lab's results in a folder").pick_folder(),
        Pick::LabReport => dialog.set_title("Write the lab's report into a folder").pick_folder(),
        Pick::SaveAs(name) => dialog.set_title("Save into a folder").set_file_name(name).save_file(),
        Pick::Picture { .. } => {
            dialog.set_title("A picture for the channel").add_filter("Pictures", &PICTURES).pick_file()
        }
    }
}
