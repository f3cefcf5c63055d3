//! The window's contents under egui_kittest: frames without a window, checked through the accessibility tree.

use crate::{
    gpu::testing,
    gui::{shell::Shell, theme},
    session::{FileCommand, Session, SessionOptions, TransportCommand},
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
pub(super) struct Contents {
    pub shell: Shell,
    pub session: Session,
    renderer: Renderer,
    pub folder: tempfile::TempDir,
}

pub(super) type Stage = Harness<'static, Contents>;

/// Uniforms of every type, a warning and a second pass.
const IMAGE: &str = "#iUniform float red = 0.5 in { 0.0, 1.0 }\n#iUniform int count = 3 in { 1, 9 }\n\
    #iUniform bool on\n#iUniform vec2 at\n#iUniform vec4 wide in { 0.0, 1.0 }\n\
    #iUniform color3 tint = color3(1.0, 0.5, 0.0)\n\
    void mainImage(out vec4 o, in vec2 p) {\n\
    //@probe mean(image.r)\n\
    float unused; o = vec4(red * at.x * wide.x, tint.g, on ? 1.0 : 0.0, count); }";

/// Returns `None` after printing the reason if there is no device.
pub(super) fn open(gallery: bool) -> Option<Stage> {
    open_with(gallery, SessionOptions::default())
}

/// The same as [`open`] with session options, for instance a folder for unsaved work.
pub(super) fn open_with(gallery: bool, options: SessionOptions) -> Option<Stage> {
    let gpu = testing::gpu()?;
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("image.glsl"), IMAGE).unwrap();
    std::fs::write(folder.path().join("buffer_a.glsl"), "void mainImage(out vec4 o, in vec2 p) { o = vec4(1); }")
        .unwrap();
    let mut session = Session::with_options(gpu.clone(), Arc::new(|| ()), options).unwrap();
    session.apply(TransportCommand::Pause);
    if !gallery {
        session.apply(FileCommand::Open(folder.path().display().to_string()));
        session.apply(TransportCommand::Pause);
    }
    let renderer = Renderer::new(&gpu.device, wgpu::TextureFormat::Rgba8Unorm, Default::default());
    let mut shell = Shell::new(gpu, Arc::new(|| ()), gallery);
    shell.type_paths();
    let contents = Contents { shell, session, renderer, folder };
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

pub(super) fn press(stage: &mut Stage, modifiers: Modifiers, key: Key) {
    stage.key_press_modifiers(modifiers, key);
    stage.run_steps(3);
}

pub(super) fn click(stage: &mut Stage, widget: &str) {
    let at = stage.state().shell.place(widget).unwrap_or_else(|| panic!("no {widget}")).center();
    stage.hover_at(at);
    stage.drag_at(at);
    stage.drop_at(at);
    stage.run_steps(3);
}

/// Returns the names of all widgets that can be focused or clicked.
pub(super) fn named(stage: &Stage, state: &str) -> Vec<String> {
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
        // Selectable text is its own name.
        let own = [node.label(), node.value(), data.placeholder().map(str::to_owned)];
        let name = own.into_iter().flatten().find(|name| !name.trim().is_empty()).unwrap_or_default();
        assert!(!name.trim().is_empty(), "{state}: {:?} at {:?} has no name", node.role(), node.raw_bounds());
        names.push(name);
    }
    assert!(!names.is_empty(), "{state}: nothing is there");
    names
}

pub(super) const CTRL: Modifiers = Modifiers { ctrl: true, command: true, ..Modifiers::NONE };
pub(super) const CTRL_SHIFT: Modifiers = Modifiers { shift: true, ..CTRL };

/// Runs frames until a condition is true.
pub(super) fn until(stage: &mut Stage, what: &str, is_so: impl Fn(&Stage) -> bool) {
    let end = Instant::now() + Duration::from_secs(60);
    while !is_so(stage) {
        stage.step();
        assert!(Instant::now() < end, "never {what}: {:?}", stage.state().session.diagnostics());
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// Returns all visible texts.
pub(super) fn texts(stage: &Stage) -> Vec<String> {
    let nodes = stage.root().children_recursive();
    let texts = nodes.map(|node| node.accesskit_node()).flat_map(|node| [node.label(), node.value()]);
    texts.flatten().collect()
}

/// Picks what the palette finds for some letters.
pub(super) fn choose(stage: &mut Stage, letters: &str) {
    press(stage, CTRL_SHIFT, Key::P);
    stage.event(egui::Event::Text(letters.to_owned()));
    stage.run_steps(2);
    press(stage, Modifiers::NONE, Key::Enter);
}

/// Asserts that all these names exist.
pub(super) fn has(names: &[String], wanted: &[&str]) {
    for name in wanted {
        assert!(names.iter().any(|n| n.trim_end() == *name), "no {name:?} among {names:?}");
    }
}
