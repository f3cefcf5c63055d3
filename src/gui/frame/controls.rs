//! Controls of devices in the panel of uniforms: learned by a right click, shown in the row, and removed again.

use super::harness::{Stage, open_with, press, texts, until};
use crate::{
    control::{
        fake::FakeMidi,
        midi::{MidiChoice, host::MidiHost},
    },
    gui::panels::Panel,
    project::ControlTarget,
    session::{ControlCommand, SessionOptions},
};
use egui::{Key, Modifiers, PointerButton};
use std::sync::Arc;

fn stage(midi: &FakeMidi) -> Option<Stage> {
    let host: Arc<dyn MidiHost> = Arc::new(midi.clone());
    let options = SessionOptions { midi: Some(host), audio_on_thread: false, ..SessionOptions::default() };
    let mut stage = open_with(false, options)?;
    stage.state_mut().shell.set_open(Panel::Uniforms, true);
    stage.run_steps(3);
    Some(stage)
}

fn right_click(stage: &mut Stage, widget: &str) {
    let pos = stage.state().shell.place(widget).unwrap_or_else(|| panic!("no {widget}")).center();
    stage.hover_at(pos);
    for pressed in [true, false] {
        stage.event(egui::Event::PointerButton {
            pos,
            button: PointerButton::Secondary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        stage.run_steps(2);
    }
    stage.run_steps(2);
}

fn is_there(stage: &Stage, widget: &str) -> bool {
    stage.state().shell.place(widget).is_some()
}

fn value(stage: &Stage, name: &str) -> Vec<f64> {
    let session = &stage.state().session;
    let uniform = session.custom_uniforms().iter().find(|uniform| uniform.name == name).unwrap();
    session.custom_uniform_value(uniform).components()
}

#[test]
fn controls_are_learned_and_removed_by_the_context_menu() {
    let midi = FakeMidi::default();
    midi.plug_in("Knobs");
    let Some(mut stage) = stage(&midi) else { return };
    // While no device is listened to, the menu leads to the settings.
    right_click(&mut stage, "uniform:red");
    super::harness::click(&mut stage, "uniform-menu:learn:red");
    let red = ControlTarget::whole("red");
    assert!(!stage.state().session.is_learning(&red));
    press(&mut stage, Modifiers::NONE, Key::Escape);
    right_click(&mut stage, "uniform:red");
    super::harness::click(&mut stage, "uniform-menu:settings");
    assert!(is_there(&stage, "settings:page"));
    super::harness::click(&mut stage, "button:close-settings");
    stage.state_mut().session.apply(ControlCommand::SetMidi(MidiChoice::All));
    stage.run_steps(3);

    right_click(&mut stage, "uniform:red");
    super::harness::click(&mut stage, "uniform-menu:learn:red");
    assert!(
        stage.state().session.is_learning(&red) && texts(&stage).iter().any(|text| text.contains("Move a control"))
    );
    press(&mut stage, Modifiers::NONE, Key::Escape);
    assert!(!stage.state().session.is_learning(&red), "Escape stops");
    right_click(&mut stage, "uniform:value:red");
    super::harness::click(&mut stage, "uniform-menu:learn:red");
    midi.send("Knobs", &[0xb0, 21, 127]);
    until(&mut stage, "a value", |stage| value(stage, "red") == [1.0]);
    stage.run_steps(3);
    assert!(is_there(&stage, "uniform:control:red") && texts(&stage).iter().any(|text| text == "red, CC 21"));
    midi.send("Knobs", &[0xb0, 21, 0]);
    until(&mut stage, "a value", |stage| value(stage, "red") == [0.0]);

    // A component of a vector, and a switch.
    right_click(&mut stage, "uniform:value:at.y");
    super::harness::click(&mut stage, "uniform-menu:learn:at.y");
    midi.send("Knobs", &[0xe0, 0, 64]);
    until(&mut stage, "a value", |stage| value(stage, "at") == [0.0, 0.5]);
    right_click(&mut stage, "uniform:on");
    super::harness::click(&mut stage, "uniform-menu:learn:on");
    midi.send("Knobs", &[0x90, 60, 99]);
    until(&mut stage, "a value", |stage| value(stage, "on") == [1.0]);

    right_click(&mut stage, "uniform:red");
    assert_eq!(value(&stage, "red"), [0.0], "a right click moves nothing");
    super::harness::click(&mut stage, "uniform-menu:forget:red");
    assert!(!is_there(&stage, "uniform:control:red"));
    midi.send("Knobs", &[0xb0, 21, 64]);
    stage.run_steps(5);
    assert_eq!(value(&stage, "red"), [0.0]);
}
