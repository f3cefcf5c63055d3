//! What is told to screen readers: in each state of the window, everything that the keyboard can be given to has a
//! name.

use super::harness::{CTRL, CTRL_SHIFT, click, named, open, press};
use crate::session::Command;
use egui::{Key, Modifiers};
use std::time::{Duration, Instant};

#[test]
fn everything_that_takes_the_keyboard_has_a_name() {
    let Some(mut stage) = open(false) else { return };
    let has = |names: &[String], wanted: &[&str]| {
        for name in wanted {
            assert!(names.iter().any(|n| n == name), "no {name:?} among {names:?}");
        }
    };
    let names = named(&stage, "the editor");
    has(&names, &["Code of Image", "Picture of Image", "Image", "Buffer A", "Play", "red", "red, number", "wide.w"]);
    has(&names, &["on", "tint, colour", "tint.g", "tint, hex", "iChannel1: none"]);
    for (state, modifiers, key, wanted) in [
        ("finding and replacing", CTRL, Key::H, "Replace with"),
        ("going to a line", CTRL, Key::G, "Line"),
        ("the costs", CTRL_SHIFT, Key::M, "Close Costs"),
        ("the buffers", CTRL_SHIFT, Key::T, "Render graph"),
        ("the measurements", CTRL_SHIFT, Key::J, "Image:8"),
        ("the palette", CTRL_SHIFT, Key::P, "Save"),
        ("the help", Modifiers::NONE, Key::F1, "Close"),
        ("the passes", CTRL_SHIFT, Key::B, "Add"),
        ("the lab", CTRL_SHIFT, Key::Y, "Start"),
        ("the gallery", CTRL_SHIFT, Key::G, "New shader"),
    ] {
        press(&mut stage, modifiers, key);
        has(&named(&stage, state), &[wanted]);
        press(&mut stage, Modifiers::NONE, Key::Escape);
        if matches!(key, Key::M | Key::Y | Key::B | Key::T | Key::J) || (key == Key::G && modifiers == CTRL_SHIFT) {
            press(&mut stage, modifiers, key);
        }
    }
    for widget in
        ["channel:0", "combo:size", "combo:pass", "button:open", "button:options", "button:add-tab", "uniform:tint"]
    {
        click(&mut stage, widget);
        named(&stage, widget);
        press(&mut stage, Modifiers::NONE, Key::Escape);
    }
    press(&mut stage, CTRL_SHIFT, Key::T);
    let names = named(&stage, "texels");
    has(&names, &["Exposure: 0", "False colour", "Fit", "RGB"]);
    assert!(names.iter().any(|n| n.starts_with("Texels of ")), "{names:?}");
    click(&mut stage, "buffers:page:graph");
    stage.run_steps(3);
    let names = named(&stage, "the graph");
    assert!(names.iter().any(|n| n.starts_with("Buffer A, ")), "{names:?}");
    press(&mut stage, CTRL_SHIFT, Key::T);
    let tab = stage.state().session.tabs()[0].clone();
    let place = format!("error: {} line 1: ", tab.title());
    stage.state_mut().session.apply(Command::EditText { tab, text: "no shader".into() });
    stage.run_steps(3);
    for command in [Command::New, Command::Open("feedback".into())] {
        stage.state_mut().session.apply(command);
        stage.run_steps(3);
        assert!(stage.state().session.question().is_some());
        has(&named(&stage, "a question"), &["Cancel"]);
        press(&mut stage, Modifiers::NONE, Key::Escape);
        assert!(stage.state().session.question().is_none(), "Escape is Cancel");
    }
    let end = Instant::now() + Duration::from_secs(60);
    while stage.state().session.diagnostics().iter().all(|d| d.severity != crate::diag::Severity::Error) {
        stage.step();
        assert!(Instant::now() < end);
    }
    stage.run_steps(3);
    let names = named(&stage, "an error");
    assert!(names.iter().any(|n| n.starts_with(&place)), "{names:?}");
}

#[test]
fn the_gallery_has_names() {
    let Some(stage) = open(true) else { return };
    let names = named(&stage, "the gallery");
    assert!(names.iter().any(|n| n == "New shader"), "{names:?}");
}
