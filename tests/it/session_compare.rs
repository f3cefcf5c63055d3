//! The open project held against another one in a session: the same inputs, frame for frame.

use crate::support::{self, stage::*};
use eddy::{
    playback::{
        comparing::{Baseline, Comparison},
        trial::TrialSettings,
    },
    project::PassName,
    session::{
        CanvasCommand, CaptureCommand, Command, FileCommand, InputCommand, Session, Status, ToolCommand,
        TransportCommand,
    },
};
use std::{fs, sync::Arc};

/// Sums what it saw of time and of the hand, so that any input that differs shows.
const HISTORY: &str = "void mainImage(out vec4 o, in vec2 p) {
    vec4 before = texelFetch(iChannel0, ivec2(p), 0);
    o = before * 0.5 + vec4(iTime + float(iFrame), p + iMouse.xy, 1.0);
}";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
const MORE: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 0.25; }";
const FILES: [(&str, &str); 2] = [("buffer_a.glsl", HISTORY), ("image.glsl", SHOW)];

fn ended(session: &Session) -> Option<Result<&Arc<Comparison>, &str>> {
    match session.comparison() {
        Some(Status::Ended(end)) => Some(end),
        _ => None,
    }
}

/// Compares, and waits for the end.
fn compare(stage: &mut Stage, against: Baseline) -> Result<Arc<Comparison>, String> {
    stage.session.apply(ToolCommand::Compare(Some(against)));
    assert!(matches!(stage.session.comparison(), Some(Status::UnderWay(_))));
    stage.until("the end of a comparison", |s| ended(s).is_some());
    ended(&stage.session).unwrap().cloned().map_err(str::to_owned)
}

fn bits(texels: &[[f32; 4]]) -> Vec<u32> {
    texels.iter().flatten().map(|x| x.to_bits()).collect()
}

/// A run with a hand on the picture, and canvases of two sizes.
fn run(stage: &mut Stage) {
    for frame in 0..9u16 {
        if frame == 2 {
            stage.session.apply(InputCommand::MouseDown { x: 3.0, y: 2.0 });
        }
        if frame == 4 {
            stage.session.apply(InputCommand::MouseMove { x: 5.0, y: 1.0 });
        }
        if frame == 6 {
            stage.session.apply(CanvasCommand::SetFixedSize(Some((12, 6))));
        }
        stage.act(Command::Transport(TransportCommand::Step));
    }
}

#[test]
fn an_edit_and_its_last_save_draw_the_same_frames_from_the_same_inputs() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &FILES);
    stage.session.apply(TransportCommand::Reset);
    run(&mut stage);
    let same = compare(&mut stage, Baseline::LastSave).unwrap();
    let frame = stage.session.transport().frame;
    assert_eq!((same.frame, same.is_cut, (same.ours.width, same.ours.height)), (frame, false, (12, 6)));
    assert!(same.frames >= 9 && !same.turns.is_empty() && same.turns.iter().all(|(a, b)| *a > 0.0 && *b > 0.0));
    assert_eq!(bits(&same.ours.texels), bits(&same.theirs.texels));
    // What both drew is what the session draws.
    stage.session.apply(CaptureCommand::SaveTexels);
    let written = fs::read(stage.path("project-0001.npy")).unwrap();
    let drawn: Vec<u8> = bits(&same.ours.texels).iter().flat_map(|x| x.to_le_bytes()).collect();
    assert!(written.ends_with(&drawn), "the session's own picture");
    assert!(!stage.session.is_comparison_old());

    // The texts are read again for the file that was written beside them.
    stage.settle();
    stage.edit(MORE);
    stage.until_compiled();
    assert!(stage.session.is_comparison_old());
    let edited = compare(&mut stage, Baseline::LastSave).unwrap();
    // Image's alpha is 1, whatever is written there.
    let more: Vec<[f32; 4]> =
        edited.theirs.texels.iter().map(|t| [t[0] + 0.25, t[1] + 0.25, t[2] + 0.25, t[3]]).collect();
    assert_eq!(bits(&edited.ours.texels), bits(&more));
    assert!(!stage.session.is_comparison_old() && stage.session.is_dirty());

    // Another project has nothing to do with it.
    stage.session.apply(FileCommand::Save);
    stage.session.apply(FileCommand::Open("feedback".into()));
    assert!(stage.session.comparison().is_none());
}

#[test]
fn without_a_state_only_the_newest_frame_is_drawn() {
    let Some(gpu) = support::gpu() else { return };
    let text = "void mainImage(out vec4 o, in vec2 p) { o = vec4(iFrame, iTime, p.x, 1.0); }";
    let mut stage = Stage::open(gpu, &[("image.glsl", text)]);
    (0..20).for_each(|_| {
        stage.act(Command::Transport(TransportCommand::Step));
    });
    let other = stage.dir.path().join("other.glsl");
    fs::write(&other, text.replace("p.x", "p.y")).unwrap();
    let found = compare(&mut stage, Baseline::Project(other.display().to_string())).unwrap();
    assert_eq!((found.frames, found.is_cut, found.pass.clone()), (1, false, PassName::image()));
    let frame = stage.session.transport().frame as f32;
    assert_eq!((found.ours.texels[9][0], found.theirs.texels[9][0]), (frame, frame));
    assert_eq!((found.ours.texels[9][2], found.theirs.texels[9][2]), (1.5, 1.5));
    assert_eq!((found.ours.texels[10][2], found.theirs.texels[10][2]), (2.5, 1.5));
}

#[test]
fn a_revision_is_drawn_as_it_was_and_what_is_not_there_is_said() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.25))]);
    let folder = stage.folder();
    let wrong = compare(&mut stage, Baseline::Revision("HEAD".into())).unwrap_err();
    assert!(wrong.contains("git has no such revision"), "{wrong}");
    support::git::commit_all(&folder);
    stage.edit(&plain(0.5));
    stage.until_compiled();
    stage.session.apply(FileCommand::Save);
    let found = compare(&mut stage, Baseline::Revision("HEAD".into())).unwrap();
    assert_eq!((found.ours.texels[0][0], found.theirs.texels[0][0]), (0.5, 0.25));
    let same = compare(&mut stage, Baseline::LastSave).unwrap();
    assert_eq!((same.ours.texels[0][0], same.theirs.texels[0][0]), (0.5, 0.5));

    let wrong = compare(&mut stage, Baseline::Revision("v9".into())).unwrap_err();
    assert!(wrong.contains("git has no such revision") && wrong.contains("v9"), "{wrong}");
    let wrong = compare(&mut stage, Baseline::Project("nowhere".into())).unwrap_err();
    assert!(wrong.starts_with("cannot open nowhere"), "{wrong}");
    let broken = stage.dir.path().join("broken.glsl");
    fs::write(&broken, "void mainImage(out vec4 o, in vec2 p) {\n    o = vec4(1.0) + lenght(p);\n}\n").unwrap();
    let wrong = compare(&mut stage, Baseline::Project(broken.display().to_string())).unwrap_err();
    assert!(wrong.contains("broken.glsl") && wrong.contains("lenght") && wrong.contains('2'), "{wrong}");
    // One that is stopped leaves what was there before, and the next one begins.
    stage.session.apply(ToolCommand::Compare(Some(Baseline::LastSave)));
    stage.session.apply(ToolCommand::Compare(None));
    stage.for_a_while();
    assert!(ended(&stage.session).is_some_and(|end| end.is_err()));
    assert!(compare(&mut stage, Baseline::LastSave).is_ok());
}

/// The other project may be a stranger's, and one that the driver takes minutes for.
#[cfg(unix)]
#[test]
fn a_large_project_to_compare_with_is_tried_first() {
    use std::os::unix::fs::PermissionsExt;
    let Some(gpu) = support::gpu().filter(|gpu| gpu.compiles_here) else { return };
    let mut stage = Stage::with_options(gpu, |folder| {
        let program = folder.join("child");
        fs::write(&program, "#!/bin/sh\ncat > /dev/null\necho memory\nkill -ABRT $$\n").unwrap();
        fs::set_permissions(&program, fs::Permissions::from_mode(0o700)).unwrap();
        let trials = Some(TrialSettings { program, limit: std::time::Duration::from_secs(60) });
        eddy::session::SessionOptions { trials, ..Default::default() }
    });
    stage.write("image.glsl", plain(0.5));
    let large: String = (0..2000).map(|k| format!("a = a * {k}.5 + sin(a);")).collect();
    let large = format!("void mainImage(out vec4 o, in vec2 p) {{ float a = p.x; {large} o = vec4(a); }}");
    let other = stage.folder().with_file_name("other.glsl");
    fs::write(&other, large).unwrap();
    stage.compile(Command::File(FileCommand::Open(stage.folder().to_str().unwrap().into())));
    stage.until("a frame", |s| s.transport().frame > 0);
    let refused = compare(&mut stage, Baseline::Project(other.to_str().unwrap().into())).unwrap_err();
    assert!(refused.contains("other.glsl: error: the graphics driver cannot compile Image"), "{refused}");
    assert!(refused.contains("of memory"), "{refused}");
}
