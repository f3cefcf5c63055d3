//! Everything is reachable by the palette, and every panel by keys.

use super::harness::{Stage, choose, named, open, press, until};
use crate::{
    gui::panels::Panel,
    project::{PassName, Tab},
    session::{EditCommand, HaltCommand, TransportCommand},
};
use egui::{Event, Key, Modifiers};

/// Fast typing may arrive in a single frame.
#[test]
fn letters_and_enter_in_one_frame_work() {
    let Some(mut stage) = open(false) else { return };
    stage.run_steps(2);
    press(&mut stage, Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    stage.run_steps(2);
    // The harness draws a frame for each event that it gets; these two belong to one frame.
    stage.input_mut().events.push(Event::Text("640".into()));
    stage.key_down(Key::Enter);
    stage.run_steps(2);
    assert_eq!(stage.state().session.transport().fixed_size, Some((640, 360)));
}

#[test]
fn the_palette_reaches_the_picture_the_passes_and_recent_projects() {
    let Some(mut stage) = open(false) else { return };
    let transport = |stage: &Stage| stage.state().session.transport();
    choose(&mut stage, "640");
    assert_eq!(transport(&stage).fixed_size, Some((640, 360)));
    choose(&mut stage, "scale: 1/2");
    assert_eq!((transport(&stage).fixed_size, transport(&stage).scale), (None, 0.5));
    choose(&mut stage, "fill the panel");
    stage.run_steps(3);
    let area = stage.state().shell.place("viewport").unwrap();
    let shape = |stage: &Stage| f64::from(transport(stage).resolution.0) / f64::from(transport(stage).resolution.1);
    assert!((shape(&stage) - f64::from(area.width() / area.height())).abs() < 0.02, "{area:?}");
    choose(&mut stage, "16:9");
    stage.run_steps(3);
    assert!((shape(&stage) - 16.0 / 9.0).abs() < 0.02);
    choose(&mut stage, "show pass: buffer a");
    assert_eq!(*stage.state().session.shown_pass(), PassName::buffer("A"));

    let before = stage.state().session.reset_on_reload();
    choose(&mut stage, "reset when");
    assert_eq!(stage.state().session.reset_on_reload(), !before);
    stage.state_mut().session.apply(EditCommand::AssignCustomUniform("red=0.25".into()));
    let red = |stage: &Stage| {
        let session = &stage.state().session;
        let uniform = session.custom_uniforms().iter().find(|uniform| uniform.name == "red").unwrap();
        session.custom_uniform_value(uniform).components()[0]
    };
    assert_eq!(red(&stage), 0.25);
    choose(&mut stage, "reset all uniforms");
    assert_eq!(red(&stage), 0.5);

    choose(&mut stage, "add common");
    assert!(stage.state().session.tabs().contains(&Tab::Common));
    choose(&mut stage, "add buffer");
    let b = Tab::Pass(PassName::buffer("B"));
    assert!(stage.state().session.tabs().contains(&b));
    stage.run_steps(2);
    assert_eq!(stage.state().shell.caret().0, b, "it is in front");

    stage.state_mut().session.apply(HaltCommand::Hold);
    stage.run_steps(2);
    assert!(stage.state().session.halt().is_some());
    choose(&mut stage, "slow frame: continue");
    assert!(stage.state().session.halt().is_none());
    choose(&mut stage, "open folder");
    until(&mut stage, "the field for a path", |stage| stage.state().shell.place("field:path").is_some());
    press(&mut stage, Modifiers::NONE, Key::Escape);

    // Opens another project, and returns by the palette. The question about unsaved work shows that it was opened.
    let name = stage.state().folder.path().file_name().unwrap().to_str().unwrap().to_owned();
    choose(&mut stage, &format!("open recent {name}"));
    assert!(stage.state().session.question().is_some());
}

const ALL: Modifiers = Modifiers { ctrl: true, command: true, shift: true, alt: true, mac_cmd: false };

#[test]
fn the_focused_panel_is_resized_and_moved_by_keys() {
    let Some(mut stage) = open(false) else { return };
    stage.state_mut().session.apply(TransportCommand::Pause);
    press(&mut stage, Modifiers::NONE, Key::F6);
    let has_code = |stage: &Stage| stage.state().shell.has_keys(&stage.ctx);
    for _ in 0..12 {
        if has_code(&stage) {
            break;
        }
        press(&mut stage, Modifiers::NONE, Key::F6);
    }
    assert!(has_code(&stage), "F6 comes by the code");
    let width = |stage: &Stage| stage.state().shell.place("editor").unwrap().width();
    let before = width(&stage);
    press(&mut stage, ALL, Key::ArrowLeft);
    let narrower = width(&stage);
    assert!((before - narrower - 24.0).abs() < 3.0, "{before} {narrower}");
    press(&mut stage, ALL, Key::ArrowRight);
    assert!((width(&stage) - before).abs() < 3.0);
    choose(&mut stage, "to the left edge");
    stage.run_steps(4);
    let left = stage.state().shell.place("editor").unwrap().left();
    // The harness keeps 8 points clear on each side; three digits of a line number and their margin take 57.
    assert!(left < 8.0 + 57.0 + 3.0, "{left}: no more than the numbers of lines are before it");
    choose(&mut stage, "close panel");
    assert!(!stage.state().shell.dock().is_open(Panel::Code));
}

#[test]
fn tab_menu_opens_by_keys_and_closes_the_code() {
    let Some(mut stage) = open(false) else { return };
    let is_on = |stage: &Stage| {
        let tab = stage.state().shell.place("tab:Image").unwrap();
        let focused = stage.ctx.memory(|m| m.focused()).and_then(|id| stage.ctx.read_response(id));
        focused.is_some_and(|widget| widget.rect == tab)
    };
    // First the part with the tabs, then the tab.
    for key in [Key::F6; 12].into_iter().chain([Key::Tab; 4]) {
        if is_on(&stage) || (key == Key::F6 && on_tabs(&stage)) {
            continue;
        }
        press(&mut stage, Modifiers::NONE, key);
    }
    assert!(is_on(&stage), "the tab has the keyboard");
    press(&mut stage, Modifiers::SHIFT, Key::F10);
    assert!(named(&stage, "the menu of a tab").iter().any(|name| name == "Show this pass"));
    let (menu, tab) = (stage.state().shell.place("tab:close-code"), stage.state().shell.place("tab:Image").unwrap());
    let menu = menu.expect("the menu is open");
    assert!(menu.top() >= tab.bottom() && menu.left() < tab.right() + 40.0, "{menu:?} below {tab:?}");
    super::harness::click(&mut stage, "tab:close-code");
    assert!(!stage.state().shell.dock().is_open(Panel::Code));
}

/// Returns whether a tab has the keyboard focus.
fn on_tabs(stage: &Stage) -> bool {
    let focused = stage.ctx.memory(|m| m.focused()).and_then(|id| stage.ctx.read_response(id));
    let tabs = ["tab:Image", "tab:Buffer A", "button:add-tab"];
    focused.is_some_and(|widget| tabs.iter().any(|tab| stage.state().shell.place(tab) == Some(widget.rect)))
}
