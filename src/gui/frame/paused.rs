//! Paused: no number is shown as if it were of now.

use super::harness::{CTRL_SHIFT, Stage, click, open, press, texts};
use crate::session::Command;
use egui::Key;

fn is_shown(stage: &Stage, part: &str) -> bool {
    texts(stage).iter().any(|text| text.contains(part))
}

#[test]
fn times_of_passes_are_gone_or_said_to_be_old() {
    let Some(mut stage) = open(false) else { return };
    press(&mut stage, CTRL_SHIFT, Key::M);
    stage.state_mut().session.apply(Command::Play);
    stage.run_steps(12);
    assert!(stage.state().shell.place("costs:paused").is_none());
    let has_timestamps = !stage.state().session.pass_times().is_empty();
    let tab = stage.state().shell.place("tab:Image").unwrap().center();
    stage.hover_at(tab);
    stage.run_steps(8);
    assert_eq!(is_shown(&stage, "ms on the GPU"), has_timestamps, "{:?}", texts(&stage));

    stage.state_mut().session.apply(Command::Pause);
    stage.run_steps(8);
    assert!(is_shown(&stage, "image.glsl"), "the tab's tip is open: {:?}", texts(&stage));
    assert!(!is_shown(&stage, "ms on the GPU"), "{:?}", texts(&stage));
    assert!(stage.state().shell.place("costs:paused").is_some() && is_shown(&stage, "from before the pause"));
    press(&mut stage, CTRL_SHIFT, Key::T);
    click(&mut stage, "buffers:page:graph");
    assert!(stage.state().shell.place("buffers:graph:paused").is_some());
    stage.state_mut().session.apply(Command::Play);
    stage.run_steps(3);
    assert!(stage.state().shell.place("buffers:graph:paused").is_none());
    assert!(stage.state().shell.place("costs:paused").is_none() && !is_shown(&stage, "from before the pause"));
}
