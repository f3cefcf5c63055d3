//! The panel of the sound pass: its texts, and seeking by a click in the waveform.

use super::harness::{Stage, click, open, texts, until};
use crate::{gui::panels::Panel, project::Tab, session::EditCommand};

fn says(stage: &Stage, words: &str) -> bool {
    texts(stage).iter().any(|text| text.contains(words))
}

#[test]
fn a_sound_pass_is_added_shown_and_seeked() {
    let Some(mut stage) = open(false) else { return };
    stage.state_mut().shell.set_open(Panel::Sound, true);
    stage.run_steps(3);
    assert!(says(&stage, "no sound pass"));
    click(&mut stage, "sound:add");
    let track = |stage: &Stage| stage.state().session.sound_track().map(|(_, track)| track);
    until(&mut stage, "a track", |stage| track(stage).is_some_and(|track| track.first_missing().is_none()));
    stage.run_steps(3);
    assert!(says(&stage, "180 s at 44100 samples per second"), "{:?}", texts(&stage));
    // A quarter of the width, within a pixel.
    let wave = stage.state().shell.place("sound:wave").expect("a waveform");
    let at = wave.left_center() + egui::vec2(wave.width() / 4.0, 0.0);
    stage.hover_at(at);
    stage.drag_at(at);
    stage.drop_at(at);
    stage.run_steps(3);
    until(&mut stage, "a time", |stage| (stage.state().session.transport().time_secs - 45.0).abs() < 1.0);

    let tab = Tab::sound();
    let text = "vec2 mainSound(float time) { return vec2(0.0); }".into();
    stage.state_mut().session.apply(EditCommand::EditText { tab, text });
    until(&mut stage, "an error", |stage| says(stage, "this is the sound before"));
}
