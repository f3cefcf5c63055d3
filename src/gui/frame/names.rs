//! Screen reader names: in each state of the window, every widget that can take the keyboard focus has a name.

use super::harness::{CTRL, CTRL_SHIFT, click, has, named, open, open_with, press, until};
use crate::{
    gui::panels::Panel,
    playback::comparing::Baseline,
    session::{
        Command, EditCommand, FileCommand, HaltCommand, Level, NoticeCommand, Question, SessionOptions, Status,
        ToolCommand, ViewCommand, probe::ProbePlace,
    },
};
use egui::{Key, Modifiers};
use std::time::{Duration, Instant};

#[test]
fn every_focusable_widget_has_a_name() {
    let Some(mut stage) = open(false) else { return };
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
    for widget in [
        "channel:0",
        "combo:size",
        "combo:pass",
        "button:open",
        "button:export",
        "button:options",
        "button:add-tab",
        "uniform:tint",
    ] {
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
    stage.state_mut().session.apply(EditCommand::EditText { tab, text: "no shader".into() });
    stage.run_steps(3);
    for command in [Command::File(FileCommand::New), Command::File(FileCommand::Open("feedback".into()))] {
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

/// Shows every panel, with a traced pixel and a finished comparison.
#[test]
fn every_panel_has_names() {
    let Some(mut stage) = open(false) else { return };
    stage.state_mut().shell.set_open(Panel::Trace, true);
    stage.run_steps(2);
    stage.state_mut().session.apply(ToolCommand::Trace(Some([0.5, 0.5])));
    until(&mut stage, "a traced pixel", |stage| stage.state().session.trace().traced.is_some());
    stage.state_mut().session.apply(ToolCommand::Compare(Some(Baseline::LastSave)));
    until(&mut stage, "a comparison", |stage| matches!(stage.state().session.comparison(), Some(Status::Ended(Ok(_)))));
    for panel in Panel::all() {
        stage.state_mut().shell.set_open(panel, true);
        stage.run_steps(4);
        assert!(stage.state().shell.dock().is_seen(panel), "{panel:?}");
        let names = named(&stage, panel.title());
        match panel {
            Panel::Trace => {
                assert!(stage.state().shell.place("trace:where").is_some(), "the pixel's way is shown");
                has(&names, &["Close Trace"]);
            }
            Panel::Compare => {
                assert!(stage.state().shell.place("compare:begin").is_some());
                has(&names, &["Close Compare"]);
            }
            _ => {}
        }
    }
}

#[test]
fn popups_have_names() {
    let Some(mut stage) = open(false) else { return };
    for (widget, wanted) in
        [("button:view", "Reset layout"), ("button:time", "Time to go to"), ("button:options", "Close picture")]
    {
        click(&mut stage, widget);
        has(&named(&stage, widget), &[wanted]);
        press(&mut stage, Modifiers::NONE, Key::Escape);
    }
    stage.state_mut().session.apply(NoticeCommand::Notify {
        level: Level::Warning,
        text: "Something is so.".into(),
        path: Some("/somewhere".into()),
    });
    stage.run_steps(3);
    has(&named(&stage, "a notice"), &["Close this notice", "Copy path"]);
    press(&mut stage, CTRL_SHIFT, Key::S);
    until(&mut stage, "the field for a path", |stage| stage.state().shell.place("field:path").is_some());
    // The first frame of a dialog only measures it; it is neither visible nor in the accessibility tree.
    stage.run_steps(3);
    has(&named(&stage, "a path"), &["Path", "Save", "Cancel"]);
    press(&mut stage, Modifiers::NONE, Key::Escape);
    until(&mut stage, "no field", |stage| stage.state().shell.place("field:path").is_none());

    press(&mut stage, CTRL_SHIFT, Key::B);
    click(&mut stage, "passes:row:Buffer A");
    for (widget, wanted) in [("passes:size", "fixed"), ("passes:format", "rgba32f   four floats, as on Shadertoy")] {
        click(&mut stage, widget);
        has(&named(&stage, widget), &[wanted]);
        press(&mut stage, Modifiers::NONE, Key::Escape);
    }
    click(&mut stage, "passes:region");
    has(&named(&stage, "the window of passes"), &["region width", "steps", "Name"]);
    press(&mut stage, CTRL_SHIFT, Key::B);

    let tab = stage.state().session.tabs().into_iter().find(|tab| tab.title() == "Image").unwrap();
    let at = stage.state().session.text(&tab).find("red * at").unwrap();
    stage.state_mut().session.apply(ViewCommand::Probe(Some(ProbePlace { tab, at, visit: 0 })));
    until(&mut stage, "a probe", |stage| stage.state().shell.place("probe:number").is_some());
    has(&named(&stage, "a probe"), &["Evaluation to show"]);
    stage.state_mut().session.apply(ViewCommand::Probe(None));

    press(&mut stage, Modifiers::NONE, Key::F9);
    has(&named(&stage, "presenting"), &["Code of Image", "Picture of Image"]);
    press(&mut stage, Modifiers::NONE, Key::F9);
    press(&mut stage, CTRL_SHIFT, Key::G);
    stage.run_steps(2);
    let recent = format!("recent:{}", stage.state().session.recent()[0].path.display());
    assert!(stage.state().shell.place(&recent).is_some(), "the gallery has what was open");
    named(&stage, "the gallery with recent projects");
    press(&mut stage, CTRL_SHIFT, Key::G);

    stage.state_mut().session.apply(HaltCommand::Hold);
    stage.run_steps(3);
    has(&named(&stage, "a halt"), &["Play", "Lower resolution"]);
}

#[test]
fn every_question_has_names() {
    let kept = tempfile::tempdir().unwrap();
    let options = || SessionOptions { recovery: Some(kept.path().to_owned()), ..SessionOptions::default() };
    let Some(mut stage) = open_with(false, options()) else { return };
    let folder = stage.state().folder.path().to_owned();
    let other = folder.join("other");
    std::fs::create_dir(&other).unwrap();
    // A file with the same contents would be kept without a question.
    std::fs::write(other.join("image.glsl"), "// of another project\n").unwrap();
    stage.state_mut().session.apply(FileCommand::SaveAs(other));
    until(&mut stage, "a question", |stage| {
        matches!(stage.state().session.question(), Some(Question::Overwrite { .. }))
    });
    stage.run_steps(3);
    has(&named(&stage, "overwriting"), &["Replace", "Cancel"]);
    stage.run_steps(4);
    press(&mut stage, Modifiers::NONE, Key::Escape);
    assert!(stage.state().session.question().is_none());

    let tab = stage.state().session.tabs().into_iter().find(|tab| tab.title() == "Image").unwrap();
    let mine = format!("// mine\n{}", stage.state().session.text(&tab));
    stage.state_mut().session.apply(EditCommand::EditText { tab, text: mine });
    stage.run_steps(3);
    std::fs::write(folder.join("image.glsl"), "// of another program\n").unwrap();
    until(&mut stage, "a conflict", |stage| {
        matches!(stage.state().session.question(), Some(Question::Conflict { .. }))
    });
    stage.run_steps(3);
    assert!(named(&stage, "a conflict").iter().any(|name| name.starts_with("Keep")), "it can be answered");
    stage.run_steps(4);
    click(&mut stage, "answer:keep-mine");
    assert!(stage.state().session.question().is_none());

    let is_kept = |entry: std::fs::DirEntry| entry.path().extension().is_some_and(|e| e == "json");
    until(&mut stage, "unsaved work on disk", |_| std::fs::read_dir(kept.path()).unwrap().flatten().any(is_kept));
    // It ends without being closed.
    drop(stage);
    let Some(mut stage) = open_with(true, options()) else { return };
    until(&mut stage, "what was left behind", |stage| stage.state().session.question().is_some());
    stage.run_steps(3);
    assert!(matches!(stage.state().session.question(), Some(Question::Recover(_))));
    assert!(named(&stage, "unsaved work").iter().any(|name| name.starts_with("Recover")));
}
