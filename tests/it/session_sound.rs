//! The sound pass of an open project: a track that is made beside the picture, again only where it sounds different.

use crate::support::{
    self,
    stage::{Stage, image_tab, plain},
};
use eddy::{
    audio::Track,
    project::{CustomUniformValue, PassEdit, Tab},
    session::{CaptureCommand, EditCommand, Outcome, Session, TransportCommand},
};
use std::sync::Arc;

fn constant(value: &str) -> String {
    format!("vec2 mainSound(int samp, float time) {{ return vec2({value}, -0.5); }}\n")
}

/// The first frame of the track, once it is made.
fn first(session: &Session) -> Option<(u64, [i16; 2])> {
    let (revision, track) = session.sound_track()?;
    Some((revision, track.frame(0)?))
}

fn until_left(stage: &mut Stage, left: i16) -> u64 {
    stage.until("a track", |session| first(session).is_some_and(|(_, frame)| frame[0] == left));
    first(&stage.session).unwrap().0
}

fn until_whole(stage: &mut Stage) -> Arc<Track> {
    let is_whole = |session: &Session| session.sound_track().is_some_and(|(_, track)| track.first_missing().is_none());
    stage.until("a whole track", is_whole);
    stage.session.sound_track().unwrap().1
}

fn edit_sound(stage: &mut Stage, text: &str) {
    stage.session.apply(EditCommand::EditText { tab: Tab::sound(), text: text.into() });
}

/// (0.5 + 0.5 v) 65,536 - 32,767.
const QUARTER: i16 = 8_193;
const HALF: i16 = 16_385;

#[test]
fn a_track_is_made_once_and_again_only_where_it_sounds_different() {
    let Some(gpu) = support::gpu() else { return };
    let common = "float level() { return 0.25; }\n";
    let sound = constant("level()");
    let mut stage = Stage::open(gpu, &[("common.glsl", common), ("sound.glsl", &sound), ("image.glsl", &plain(0.2))]);
    assert!(stage.is_ok());
    let revision = until_left(&mut stage, QUARTER);
    let track = until_whole(&mut stage);
    assert_eq!(track.frame(7_937_999), Some([QUARTER, -16_383]), "to the last sample");
    assert_eq!(track.frame(7_938_000), Some([0, 0]));
    assert!(stage.session.sound().is_some_and(|view| view.trouble.is_none()));

    stage.session.apply(CaptureCommand::SaveSound);
    let saved = stage.session.notices().last().expect("a notice").path.clone().expect("a file");
    let file = std::fs::read(&saved).unwrap();
    assert_eq!(file.len(), 44 + 4 * 7_938_000, "{}", saved.display());
    assert_eq!(i16::from_le_bytes([file[44], file[45]]), QUARTER);

    // The picture, a comment, and what of Common the sound does not call leave it alone.
    stage.edit(&plain(0.4));
    stage.until_red(102);
    edit_sound(&mut stage, &format!("// louder?\n{sound}"));
    stage.for_a_while();
    stage
        .session
        .apply(EditCommand::EditText { tab: Tab::Common, text: format!("{common}float other() {{ return 1.0; }}\n") });
    stage.for_a_while();
    let (now, same) = stage.session.sound_track().unwrap();
    assert_eq!(now, revision);
    assert!(Arc::ptr_eq(&same, &track));

    // Common changes it, and so does the pass.
    stage.session.apply(EditCommand::EditText { tab: Tab::Common, text: common.replace("0.25", "0.5") });
    let second = until_left(&mut stage, HALF);
    assert!(second > revision);
    assert_eq!(track.frame(0), Some([QUARTER, -16_383]), "what may be playing does not change");
    edit_sound(&mut stage, &constant("0.25"));
    assert!(until_left(&mut stage, QUARTER) > second);

    // Without the pass there is nothing to hear; another project begins anew.
    stage.session.apply(EditCommand::EditPasses(PassEdit::Remove(Tab::sound())));
    stage.until("silence", |session| session.sound_track().is_none() && session.sound().is_none());
}

#[test]
fn a_slider_makes_another_track_if_the_sound_reads_it() {
    let Some(gpu) = support::gpu() else { return };
    let sound = format!("#iUniform float level = 0.25 in {{0.0, 1.0}}\n{}", constant("level"));
    let show = format!("#iUniform float tint = 0.2 in {{0.0, 1.0}}\n{}", plain(0.2).replace("0.2", "tint"));
    let mut stage = Stage::open(gpu, &[("sound.glsl", &sound), ("image.glsl", &show)]);
    let revision = until_left(&mut stage, QUARTER);
    let turn = |stage: &mut Stage, name: &str| {
        let value = Some(CustomUniformValue::Float(0.5));
        stage.session.apply(EditCommand::SetCustomUniform { name: name.into(), value });
    };
    turn(&mut stage, "tint");
    stage.for_a_while();
    assert_eq!(first(&stage.session).unwrap().0, revision);
    turn(&mut stage, "level");
    assert!(until_left(&mut stage, HALF) > revision);
}

#[test]
fn errors_are_in_the_tab_of_the_pass_and_the_picture_goes_on() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("sound.glsl", &constant("0.25")), ("image.glsl", &plain(0.2))]);
    let revision = until_left(&mut stage, QUARTER);
    edit_sound(&mut stage, "vec2 mainSound(float time) { return vec2(time); }\n");
    stage.until("an error", |session| session.diagnostics().iter().any(|d| d.tab() == Some(&Tab::sound())));
    assert!(matches!(stage.session.compile_state().last, Some(Outcome::Failed { errors: 1, .. })));
    stage.edit(&plain(0.4));
    stage.until_red(102);
    assert_eq!(first(&stage.session).unwrap().0, revision, "the last good sound stays");
    edit_sound(&mut stage, &constant("0.5"));
    until_left(&mut stage, HALF);
    assert!(stage.session.diagnostics().is_empty());
    // An error of the picture does not silence the sound.
    stage.edit("void mainImage(out vec4 o, in vec2 p) { o = nothing; }");
    stage.until("an error", |session| session.diagnostics().iter().any(|d| d.tab() == Some(&image_tab())));
    edit_sound(&mut stage, &constant("0.25"));
    until_left(&mut stage, QUARTER);
}

#[test]
fn a_sound_that_takes_forever_holds_neither_the_picture_nor_the_end() {
    let Some(gpu) = support::gpu() else { return };
    let slow = "vec2 mainSound(int samp, float time) { float a = time; for (int i = 0; i < 100000000; i++) \
                a = fract(sin(a) * 43758.5 + float(i & 1)); return vec2(a); }";
    let mut stage = Stage::open(gpu, &[("sound.glsl", slow), ("image.glsl", &plain(0.2))]);
    stage.until("a track", |session| session.sound_track().is_some());
    let frames = stage.frames();
    stage.session.apply(TransportCommand::Play);
    stage.for_a_while();
    assert!(stage.frames() > frames + 5, "{} frames", stage.frames() - frames);
    assert_eq!(first(&stage.session), None);
    stage.edit(&plain(0.4));
    stage.until_red(102);
    drop(stage);
}
