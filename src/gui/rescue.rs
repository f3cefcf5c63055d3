//! Saves unsaved work when the window cannot go on.

use super::GuiError;
use crate::{
    gpu::{Gpu, GpuError},
    project::{self, Origin, Overwrite, Project},
    session::{Command, Level, Session},
};
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

/// A device that is lost again so soon after another would be lost for ever.
const AGAIN: Duration = Duration::from_secs(10);

/// The losses of the window's device so far.
#[derive(Default)]
pub struct Losses {
    newest: Option<Instant>,
}

impl Losses {
    /// Looks whether the window's device is still there. In the place of one that is lost comes another, which `renew`
    /// opens; the window ends if that fails or was done just before, after what was not saved has been. What the device
    /// refused is told of, and the window goes on.
    pub fn watch(
        &mut self,
        gpu: &Gpu,
        session: &mut Session,
        now: Instant,
        renew: impl FnOnce(&mut Session) -> Result<(), GuiError>,
    ) -> Result<(), GuiError> {
        let reason = match gpu.take_trouble("the window") {
            Ok(()) => return Ok(()),
            Err(reason @ GpuError::Lost(_)) => reason,
            Err(refused) => {
                session.tell_of(&refused);
                return Ok(());
            }
        };
        let is_again = self.newest.replace(now).is_some_and(|at| now.saturating_duration_since(at) < AGAIN);
        if is_again {
            return Err(GuiError::Lost { reason, rescue: save_unsaved(session) });
        }
        if let Err(e) = renew(session) {
            log::error!("no other device: {e}");
            return Err(GuiError::Lost { reason, rescue: save_unsaved(session) });
        }
        let text = format!("{reason}; the window has another now. Nothing of your texts is lost");
        session.apply(Command::Notify { level: Level::Warning, text, path: None });
        Ok(())
    }
}

/// Does a part of the window's work. A panic in it ends the window with an error that says so, after what was not saved
/// has been: a bug in drawing is no reason to lose a text.
pub fn caught<W, T>(
    window: &mut W,
    work: impl FnOnce(&mut W) -> Result<T, GuiError>,
    session: impl FnOnce(&W) -> &Session,
) -> Result<T, GuiError> {
    let panic = match catch_unwind(AssertUnwindSafe(|| work(window))) {
        Ok(done) => return done,
        Err(panic) => panic,
    };
    let said = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    let reason = said.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no reason given".into());
    // Whatever was left half done may make this stumble too.
    let rescue = catch_unwind(AssertUnwindSafe(|| save_unsaved(session(window))));
    let rescue = rescue.unwrap_or_else(|_| ". Your unsaved work could not be written".into());
    Err(GuiError::Panicked { reason, rescue })
}

/// Writes what is not saved into a new folder, beside the project where that can be written, else at home, else among
/// the temporary files. Returns what to tell the user; nothing if nothing was unsaved.
pub fn save_unsaved(session: &Session) -> String {
    if !session.is_dirty() {
        return String::new();
    }
    let project = session.project();
    match save(project, places(project)) {
        Ok(folder) => {
            session.forget_unsaved();
            format!(". Your unsaved work is in {}", folder.display())
        }
        Err(reason) => format!(". Your unsaved work could not be written anywhere: {reason}"),
    }
}

fn places(project: &Project) -> impl Iterator<Item = PathBuf> {
    let beside = match &project.origin {
        Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => path.parent().map(Path::to_owned),
        Origin::Unsaved | Origin::Preset(_) => None,
    };
    beside.into_iter().chain(std::env::home_dir()).chain([std::env::temp_dir()])
}

fn save(project: &Project, places: impl Iterator<Item = PathBuf>) -> Result<PathBuf, String> {
    let name: String = project.name.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    let mut reason = String::new();
    for place in places {
        let free = (1..).map(|n| place.join(format!("{name}-recovered-{n:04}"))).find(|path| !path.exists());
        let Some(folder) = free else { continue };
        match project::save(project, &folder, Overwrite::Refuse) {
            Ok(_) => return Ok(folder),
            Err(e) => reason = e.to_string(),
        }
        // What a text includes is still where it was read from.
        let alone = Project { includes: Vec::new(), ..project.clone() };
        if !project.includes.is_empty() && project::save(&alone, &folder, Overwrite::Refuse).is_ok() {
            return Ok(folder);
        }
    }
    Err(reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        project::{PassId, Tab},
        session::testing,
    };
    use std::sync::Arc;

    const UNSAVED: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); } // not saved";

    fn open(gpu: Gpu, folder: &Path) -> Session {
        let project = folder.join("mine");
        std::fs::create_dir(&project).unwrap();
        std::fs::write(project.join("image.glsl"), "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }").unwrap();
        let mut session = Session::new(gpu, Arc::new(|| ())).unwrap();
        session.apply(Command::Open(project.display().to_string()));
        session
    }

    #[test]
    fn a_window_whose_device_is_lost_again_and_again_saves_what_was_not() {
        let Some(gpu) = testing::gpu() else { return };
        let folder = tempfile::tempdir().unwrap();
        let mut session = open(gpu.clone(), folder.path());
        session.apply(Command::EditText { tab: Tab::Pass(PassId::Image), text: UNSAVED.into() });
        let (mut losses, start) = (Losses::default(), Instant::now());
        let mut watch = |seconds: u64, session: &mut Session| {
            let mut renewed = 0;
            let now = start + Duration::from_secs(seconds);
            let watched = losses.watch(&gpu, session, now, |_| {
                renewed += 1;
                Ok(())
            });
            (watched, renewed)
        };
        assert!(matches!(watch(0, &mut session), (Ok(()), 0)));
        gpu.lose();
        assert!(matches!(watch(1, &mut session), (Ok(()), 1)));
        assert!(matches!(watch(12, &mut session), (Ok(()), 1)), "eleven seconds later is another accident");
        let warned = |n: &&crate::session::Notice| n.text.contains("Nothing of your texts is lost");
        assert_eq!(session.notices().iter().filter(warned).count(), 2);
        let (Err(error), 0) = watch(13, &mut session) else { panic!("a device that is lost each second") };
        let saved = folder.path().join("mine-recovered-0001");
        assert!(matches!(error, GuiError::Lost { .. }) && error.to_string().contains("the graphics device was lost"));
        assert!(error.to_string().ends_with(&format!("Your unsaved work is in {}", saved.display())), "{error}");
        assert_eq!(std::fs::read_to_string(saved.join("image.glsl")).unwrap(), UNSAVED);
    }

    #[test]
    fn a_window_that_gets_no_other_device_saves_what_was_not() {
        let Some(gpu) = testing::gpu() else { return };
        let folder = tempfile::tempdir().unwrap();
        let mut session = open(gpu.clone(), folder.path());
        session.apply(Command::EditText { tab: Tab::Pass(PassId::Image), text: UNSAVED.into() });
        gpu.lose();
        let none = |_: &mut Session| Err(GuiError::Surface("planted".into()));
        let error = Losses::default().watch(&gpu, &mut session, Instant::now(), none).unwrap_err();
        assert!(error.to_string().contains("Your unsaved work is in"), "{error}");
    }

    #[test]
    fn a_panic_in_the_window_saves_what_was_not() {
        let Some(gpu) = testing::gpu() else { return };
        let folder = tempfile::tempdir().unwrap();
        let mut session = open(gpu, folder.path());
        let (text, tab) = (UNSAVED, Tab::Pass(PassId::Image));
        let ends = |session: &mut Session| {
            caught(
                session,
                |session| -> Result<(), GuiError> {
                    session.tick(Instant::now());
                    panic!("planted {}", 1)
                },
                |session| session,
            )
        };
        assert_eq!(ends(&mut session).unwrap_err().to_string(), "this is a bug in Eddy: planted 1");
        session.apply(Command::EditText { tab, text: text.into() });
        let error = ends(&mut session).unwrap_err().to_string();
        let saved = folder.path().join("mine-recovered-0001");
        assert_eq!(error, format!("this is a bug in Eddy: planted 1. Your unsaved work is in {}", saved.display()));
        assert_eq!(std::fs::read_to_string(saved.join("image.glsl")).unwrap(), text);
        assert_eq!(caught(&mut session, |_| Ok(3), |session| session).unwrap(), 3);
    }

    #[test]
    fn unsaved_work_goes_to_the_first_place_that_takes_it_and_over_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let blocked = folder.path().join("a file");
        std::fs::write(&blocked, "").unwrap();
        let mut project = crate::project::presets::load("feedback").unwrap().project;
        project.name = "My / shader".into();
        let save = || save(&project, [blocked.clone(), folder.path().to_owned()].into_iter()).unwrap();
        let (first, second) = (save(), save());
        assert_ne!(first, second);
        assert_eq!(first, folder.path().join("My---shader-recovered-0001"));
        let back = crate::project::load(first.to_str().unwrap()).unwrap().project;
        assert_eq!(back.passes.len(), project.passes.len());
        assert_eq!(back.passes[0].source.text, project.passes[0].source.text);
    }
}
