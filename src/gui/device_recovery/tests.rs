//! Tests of lost devices, panics, and places that cannot be written.

use super::*;
use crate::{
    gpu::testing,
    project::Tab,
    session::{EditCommand, FileCommand},
};
use std::sync::Arc;

const UNSAVED: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); } // not saved";

fn open(gpu: Gpu, folder: &Path) -> Session {
    let project = folder.join("mine");
    std::fs::create_dir(&project).unwrap();
    std::fs::write(project.join("image.glsl"), "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }").unwrap();
    let mut session = Session::new(gpu, Arc::new(|| ())).unwrap();
    session.apply(FileCommand::Open(project.display().to_string()));
    session
}

#[test]
fn repeated_device_loss_saves_unsaved_work() {
    let Some(gpu) = testing::gpu() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut session = open(gpu.clone(), folder.path());
    session.apply(EditCommand::EditText { tab: Tab::image(), text: UNSAVED.into() });
    let (mut losses, start) = (DeviceLosses::default(), Instant::now());
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
    testing::lose(&gpu);
    assert!(matches!(watch(1, &mut session), (Ok(()), 1)));
    assert!(matches!(watch(2, &mut session), (Ok(()), 1)), "the session pauses after it");
    assert!(matches!(watch(12, &mut session), (Ok(()), 1)), "ten seconds later is another accident");
    let warned = |n: &&crate::session::Notice| n.text.contains("Your texts are unchanged");
    assert_eq!(session.notices().iter().filter(warned).count(), 3);
    assert!(matches!(watch(13, &mut session), (Ok(()), 1)));
    let (Err(error), 0) = watch(14, &mut session) else { panic!("a device that is lost each second") };
    let saved = folder.path().join("mine-recovered-0001");
    assert!(matches!(error, GuiError::Lost { .. }) && error.to_string().contains("the graphics device was lost"));
    assert!(error.to_string().ends_with(&format!("Your unsaved work is in {}", saved.display())), "{error}");
    assert_eq!(std::fs::read_to_string(saved.join("image.glsl")).unwrap(), UNSAVED);
}

#[test]
fn failing_to_reopen_a_device_saves_unsaved_work() {
    let Some(gpu) = testing::gpu() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut session = open(gpu.clone(), folder.path());
    session.apply(EditCommand::EditText { tab: Tab::image(), text: UNSAVED.into() });
    testing::lose(&gpu);
    let none = |_: &mut Session| Err(GuiError::Surface("planted".into()));
    let error = DeviceLosses::default().watch(&gpu, &mut session, Instant::now(), none).unwrap_err();
    assert!(error.to_string().contains("Your unsaved work is in"), "{error}");
}

#[test]
fn a_panic_saves_unsaved_work() {
    let Some(gpu) = testing::gpu() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut session = open(gpu, folder.path());
    let (text, tab) = (UNSAVED, Tab::image());
    let ends = |session: &mut Session| {
        catch_panic(
            session,
            |session| -> Result<(), GuiError> {
                session.tick(Instant::now());
                panic!("planted {}", 1)
            },
            |session| session,
        )
    };
    assert_eq!(ends(&mut session).unwrap_err().to_string(), "this is a bug in Eddy: planted 1");
    session.apply(EditCommand::EditText { tab, text: text.into() });
    let error = ends(&mut session).unwrap_err().to_string();
    let saved = folder.path().join("mine-recovered-0001");
    assert_eq!(error, format!("this is a bug in Eddy: planted 1. Your unsaved work is in {}", saved.display()));
    assert_eq!(std::fs::read_to_string(saved.join("image.glsl")).unwrap(), text);
    assert_eq!(catch_panic(&mut session, |_| Ok(3), |session| session).unwrap(), 3);
}

#[test]
fn unsaved_work_goes_to_the_first_writable_place_without_overwriting() {
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
