//! The layout of widgets: they keep their order and grid, and widgets without enough room are still reachable.
//! Measurements of a paused picture are not shown as current.

use super::harness::{CTRL_SHIFT, Stage, choose, click, open, open_with, press, texts, until};
use crate::{
    audio::fake::FakeHost,
    gui::theme::{DARK, LIGHT},
    project::Tab,
    session::{EditCommand, SessionOptions, TransportCommand},
};
use egui::{Key, Modifiers, MouseWheelUnit, TouchPhase, vec2};
use egui_kittest::kittest::NodeT as _;
use std::sync::Arc;

fn place(stage: &Stage, name: &str) -> egui::Rect {
    stage.state().shell.place(name).unwrap_or_else(|| panic!("no {name}"))
}

#[test]
fn selection_and_primary_button_differ_in_colour() {
    let is_blue = |c: egui::Color32| i32::from(c.b()) - i32::from(c.r()) > 40;
    for p in [DARK, LIGHT] {
        assert!(is_blue(p.accent_fill) && is_blue(p.accent) && !is_blue(p.chosen), "{:?}", p.chosen);
        let differs = |a: egui::Color32, b: egui::Color32| u16::from(a.g().abs_diff(b.g())) >= 12;
        assert!(differs(p.chosen, p.button) && differs(p.chosen, p.button_hovered));
    }
}

#[test]
fn the_gallery_keeps_to_one_grid() {
    for width in [700.0, 1100.0, 1366.0, 1900.0] {
        let Some(mut stage) = open(true) else { return };
        stage.set_size(vec2(width, 720.0));
        stage.run_steps(4);
        let right = |name: &str| place(&stage, name).right();
        let cards = stage.state().shell.places().filter(|(name, _)| name.starts_with("preset:"));
        let edge = cards.map(|(_, rect)| rect.right()).fold(0.0, f32::max);
        let tiles = ["gallery:new", "gallery:paste", "gallery:open-file", "gallery:open"].map(right);
        let last = tiles.into_iter().fold(0.0, f32::max);
        assert!((last - edge).abs() < 1.5, "{width}: {last} and {edge}");
    }
}

#[test]
fn resolution_is_reachable_in_a_small_window() {
    let Some(mut stage) = open(false) else { return };
    for (width, height) in [(1366.0, 800.0), (800.0, 500.0)] {
        stage.set_size(vec2(width, height));
        stage.run_steps(4);
        assert!(place(&stage, "combo:size").width() > 60.0, "{width}");
    }
    // Its list is in sight as a whole.
    click(&mut stage, "combo:size");
    stage.run_steps(4);
    let last = place(&stage, "size:1024x1024");
    assert!(last.top() > 0.0 && last.bottom() < 500.0, "{last}");
}

#[test]
fn device_lights_adapt_to_the_width_of_the_bar() {
    let options = SessionOptions { audio: Some(Arc::new(FakeHost::default())), ..SessionOptions::default() };
    let Some(mut stage) = open_with(false, options) else { return };
    let text = "#iChannel0 \"webcam\"\n#iChannel1 \"microphone\"\n\
                void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, p) + texture(iChannel1, p); }";
    stage.state_mut().session.apply(EditCommand::EditText { tab: Tab::image(), text: text.into() });
    until(&mut stage, "a camera that is asked for", |stage| stage.state().shell.place("button:camera").is_some());
    let names = |names: &[&str]| {
        let buttons = names.iter().map(|name| format!("button:{name}"));
        buttons.chain(["button:options".into(), "combo:pass".into()]).collect::<Vec<_>>()
    };
    let are_apart = |stage: &Stage, names: &[String]| {
        let places: Vec<_> = names.iter().map(|name| (name, place(stage, name))).collect();
        for (n, (name, rect)) in places.iter().enumerate() {
            for (other, beside) in &places[n + 1..] {
                assert!(!rect.shrink(0.5).intersects(*beside), "{name} {rect} and {other} {beside}");
            }
        }
    };
    for width in [1600.0, 1100.0, 900.0, 800.0, 760.0] {
        stage.set_size(vec2(width, 600.0));
        stage.run_steps(4);
        let mut shown = vec!["play", "reset", "camera", "microphone"];
        if stage.state().shell.place("button:step").is_some() {
            shown.extend(["step-back", "step", "screenshot"]);
        }
        let mut all = names(&shown);
        if width >= 900.0 {
            all.push("combo:size".into());
        }
        are_apart(&stage, &all);
        assert!(shown.len() == 7 || width < 1200.0, "{width}");
        let camera = place(&stage, "button:camera");
        assert!(camera.width() >= 112.0 || width < 1200.0, "{width}: {camera}");
    }
    // With one more button, those that also have keys are hidden.
    stage.state_mut().session.apply(TransportCommand::Record);
    stage.run_steps(4);
    are_apart(&stage, &names(&["play", "reset", "recording", "camera", "microphone"]));
    assert!(stage.state().shell.place("button:step").is_none());
    // So is the resolution, which is then in the menu.
    assert!(stage.state().shell.place("combo:size").is_none(), "there is room for it: take a smaller window");
    click(&mut stage, "button:options");
    assert!(place(&stage, "options:resolution").width() > 60.0);
}

#[test]
fn leave_button_of_code_over_picture_appears_on_pointer_motion() {
    let Some(mut stage) = open(false) else { return };
    press(&mut stage, Modifiers::NONE, Key::F9);
    stage.run_steps(2);
    assert!(
        stage.state().shell.place("button:view").is_none()
            && stage.state().shell.place("button:leave-present").is_none()
    );
    stage.hover_at(egui::pos2(1060.0, 20.0));
    stage.run_steps(2);
    click(&mut stage, "button:leave-present");
    assert!(stage.state().shell.place("button:view").is_some());
}

#[test]
fn number_fields_fit_their_text() {
    let Some(mut stage) = open(false) else { return };
    for name in ["uniform:value:red", "uniform:value:wide.x"] {
        click(&mut stage, name);
        let cell = place(&stage, name);
        let focused = stage.ctx.memory(|m| m.focused()).and_then(|id| stage.ctx.read_response(id));
        let field = focused.unwrap_or_else(|| panic!("nothing is edited at {name}")).rect;
        assert!(field.width() > 0.8 * cell.width() - 4.0, "{name}: {field:?} of {cell:?}");
        press(&mut stage, Modifiers::NONE, Key::Escape);
    }
}

#[test]
fn tabs_follow_the_drawing_order_and_scroll() {
    let Some(mut stage) = open(false) else { return };
    for _ in 0..14 {
        choose(&mut stage, "add buffer");
    }
    let order: Vec<String> = stage.state().session.project().passes.iter().map(|pass| pass.id.title()).collect();
    let tabs: Vec<String> = stage.state().session.tabs().iter().map(|tab| tab.title()).collect();
    assert_eq!(tabs, order);
    stage.run_steps(4);
    let left = place(&stage, "viewport").right() - 4.0;
    let is_seen = |stage: &Stage, name: &str| {
        let tab = place(stage, name);
        tab.left() >= left && tab.right() < place(stage, "button:add-tab").left() + 1.0
    };
    let (front, _) = stage.state().shell.caret();
    assert!(is_seen(&stage, &format!("tab:{}", front.title())), "{front:?} is in sight");
    assert!(!is_seen(&stage, "tab:Buffer A"));
    let over = place(&stage, "button:add-tab").center() - vec2(80.0, 0.0);
    for _ in 0..30 {
        stage.hover_at(over);
        stage.event(egui::Event::MouseWheel {
            unit: MouseWheelUnit::Line,
            delta: vec2(0.0, 4.0),
            phase: TouchPhase::Move,
            modifiers: Modifiers::NONE,
            source: egui::MouseWheelSource::Wheel,
        });
        stage.run_steps(2);
    }
    let (first, add) = (place(&stage, "tab:Buffer A"), place(&stage, "button:add-tab"));
    assert!(is_seen(&stage, "tab:Buffer A"), "{first:?} before {add:?}, behind {left}");
}

#[test]
fn adding_a_pass_does_not_cover_the_picture() {
    let Some(mut stage) = open(false) else { return };
    stage.state_mut().session.apply(TransportCommand::Pause);
    click(&mut stage, "button:add-tab");
    assert!(["add:Cube A", "add:Sound"].iter().all(|name| stage.state().shell.place(name).is_some()));
    click(&mut stage, "add:Buffer B");
    stage.run_steps(3);
    assert_eq!(stage.state().shell.caret().0.title(), "Buffer B");
    assert!(stage.state().shell.place("passes").is_none());
}

fn is_shown(stage: &Stage, part: &str) -> bool {
    texts(stage).iter().any(|text| text.contains(part))
}

#[test]
fn stale_pass_times_are_hidden_or_marked() {
    let Some(mut stage) = open(false) else { return };
    press(&mut stage, CTRL_SHIFT, Key::M);
    stage.state_mut().session.apply(TransportCommand::Play);
    stage.run_steps(12);
    assert!(stage.state().shell.place("costs:paused").is_none());
    let has_timestamps = !stage.state().session.pass_times().is_empty();
    let tab = stage.state().shell.place("tab:Image").unwrap().center();
    stage.hover_at(tab);
    stage.run_steps(8);
    assert_eq!(is_shown(&stage, "ms on the GPU"), has_timestamps, "{:?}", texts(&stage));

    stage.state_mut().session.apply(TransportCommand::Pause);
    stage.run_steps(8);
    assert!(is_shown(&stage, "image.glsl"), "the tab's tip is open: {:?}", texts(&stage));
    assert!(!is_shown(&stage, "ms on the GPU"), "{:?}", texts(&stage));
    assert!(stage.state().shell.place("costs:paused").is_some() && is_shown(&stage, "from before the pause"));
    press(&mut stage, CTRL_SHIFT, Key::T);
    click(&mut stage, "buffers:page:graph");
    assert!(stage.state().shell.place("buffers:graph:paused").is_some());
    stage.state_mut().session.apply(TransportCommand::Play);
    stage.run_steps(3);
    assert!(stage.state().shell.place("buffers:graph:paused").is_none());
    assert!(stage.state().shell.place("costs:paused").is_none() && !is_shown(&stage, "from before the pause"));
}

#[test]
fn lab_texts_stay_within_the_window() {
    let Some(mut stage) = open(false) else { return };
    press(&mut stage, CTRL_SHIFT, Key::Y);
    for width in [620.0, 900.0, 1100.0, 1280.0, 1920.0] {
        stage.set_size(vec2(width, 800.0));
        stage.run_steps(3);
        let nodes = stage.root().children_recursive();
        let texts = nodes.map(|node| node.accesskit_node()).filter_map(|node| {
            let text = node.value().or_else(|| node.label())?;
            text.starts_with("A Gaussian of standard deviation").then(|| node.raw_bounds())
        });
        let rights: Vec<f64> = texts.flatten().map(|bounds| bounds.x1).collect();
        assert!(!rights.is_empty(), "{width} wide: the study is not told of");
        let right = rights.into_iter().fold(0.0, f64::max);
        assert!(right <= f64::from(width), "{width} wide: the text ends at {right}");
    }
}
