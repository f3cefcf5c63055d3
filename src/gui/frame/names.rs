//! What is told to screen readers: in each state of the window, everything that the keyboard can be given to has a
//! name.

use crate::{
    gui::{shell::Shell, theme},
    session::{Command, Session, SessionOptions, testing},
};
use egui::{
    Key, Modifiers,
    accesskit::{self, Action},
    vec2,
};
use egui_kittest::{Harness, kittest::NodeT as _};
use egui_wgpu::Renderer;
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

/// The window's contents without a window.
struct Contents {
    shell: Shell,
    session: Session,
    renderer: Renderer,
    _folder: tempfile::TempDir,
}

type Stage = Harness<'static, Contents>;

/// Uniforms of every type, a warning and a second pass.
const IMAGE: &str = "#iUniform float red = 0.5 in { 0.0, 1.0 }\n#iUniform int count = 3 in { 1, 9 }\n\
    #iUniform bool on\n#iUniform vec2 at\n#iUniform vec4 wide in { 0.0, 1.0 }\n\
    #iUniform color3 tint = color3(1.0, 0.5, 0.0)\n\
    void mainImage(out vec4 o, in vec2 p) {\n\
    //@probe mean(image.r)\n\
    float unused; o = vec4(red * at.x * wide.x, tint.g, on ? 1.0 : 0.0, count); }";

/// `None` where there is no device, after saying so.
fn open(gallery: bool) -> Option<Stage> {
    let gpu = testing::gpu()?;
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("image.glsl"), IMAGE).unwrap();
    std::fs::write(folder.path().join("buffer_a.glsl"), "void mainImage(out vec4 o, in vec2 p) { o = vec4(1); }")
        .unwrap();
    let mut session = Session::with_options(gpu.clone(), Arc::new(|| ()), SessionOptions::default()).unwrap();
    session.apply(Command::Pause);
    if !gallery {
        session.apply(Command::Open(folder.path().display().to_string()));
        session.apply(Command::Pause);
    }
    let renderer = Renderer::new(&gpu.device, wgpu::TextureFormat::Rgba8Unorm, Default::default());
    let shell = Shell::new(gpu, Arc::new(|| ()), gallery);
    let contents = Contents { shell, session, renderer, _folder: folder };
    let show = |ui: &mut egui::Ui, contents: &mut Contents| {
        let Contents { shell, session, renderer, .. } = contents;
        shell.prepare(session, renderer);
        let commands = shell.show(ui, session);
        commands.into_iter().for_each(|command| session.apply(command));
        session.tick(Instant::now());
        session.gpu().wait().unwrap();
    };
    let mut stage = Harness::builder()
        .with_size(vec2(1100.0, 720.0))
        .with_context_setup(theme::apply)
        .build_ui_state(show, contents);
    let end = Instant::now() + Duration::from_secs(60);
    while stage.state().session.compile_state().last.is_none() || stage.state().session.compile_state().compiling {
        stage.step();
        assert!(Instant::now() < end, "never compiled: {:?}", stage.state().session.diagnostics());
        std::thread::sleep(Duration::from_millis(2));
    }
    stage.run_steps(3);
    Some(stage)
}

fn press(stage: &mut Stage, modifiers: Modifiers, key: Key) {
    stage.key_press_modifiers(modifiers, key);
    stage.run_steps(3);
}

fn click(stage: &mut Stage, widget: &str) {
    let at = stage.state().shell.place(widget).unwrap_or_else(|| panic!("no {widget}")).center();
    stage.hover_at(at);
    stage.drag_at(at);
    stage.drop_at(at);
    stage.run_steps(3);
}

/// Everything that can have the keyboard or be clicked, by its name.
fn named(stage: &Stage, state: &str) -> Vec<String> {
    let unnamed = stage.unnamed_widgets();
    assert!(unnamed.is_empty(), "{state}: without a name:\n{}", unnamed.join("\n"));
    let mut names = Vec::new();
    for node in stage.root().children_recursive() {
        let node = node.accesskit_node();
        let data = node.data();
        let is_bar = data.role() == accesskit::Role::ScrollBar;
        if is_bar || data.is_hidden() || !(data.supports_action(Action::Focus) || data.supports_action(Action::Click)) {
            continue;
        }
        // A text that can be selected is its own name.
        let own = [node.label(), node.value(), data.placeholder().map(str::to_owned)];
        let name = own.into_iter().flatten().find(|name| !name.trim().is_empty()).unwrap_or_default();
        assert!(!name.trim().is_empty(), "{state}: {:?} at {:?} has no name", node.role(), node.raw_bounds());
        names.push(name);
    }
    assert!(!names.is_empty(), "{state}: nothing is there");
    names
}

const CTRL: Modifiers = Modifiers { ctrl: true, command: true, ..Modifiers::NONE };
const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..CTRL };

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
        ("the lab", CTRL_SHIFT, Key::L, "Start"),
        ("the gallery", CTRL_SHIFT, Key::G, "New shader"),
    ] {
        press(&mut stage, modifiers, key);
        has(&named(&stage, state), &[wanted]);
        press(&mut stage, Modifiers::NONE, Key::Escape);
        if matches!(key, Key::M | Key::L | Key::B | Key::T | Key::J) || (key == Key::G && modifiers == CTRL_SHIFT) {
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
