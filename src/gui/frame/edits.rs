//! Quick fixes, renaming, finding in all passes, the code's menu, breakpoints and compiling on save, by keys and
//! clicks.

use super::harness::{CTRL, CTRL_SHIFT, Stage, choose, click, has, named, open, press, texts, until};
use crate::{
    gui::panels::Panel,
    project::{CustomUniformValue, FillValue, PassEdit, PassName, Tab},
    session::{Command, EditCommand, FileCommand, TransportCommand},
};
use egui::{Event, Key, Modifiers, PointerButton};

fn buffer() -> Tab {
    Tab::Pass(PassName::buffer("A"))
}

fn text(stage: &Stage, tab: &Tab) -> String {
    stage.state().session.text(tab).to_owned()
}

fn settle(stage: &mut Stage) {
    stage.run_steps(2);
    until(stage, "compiled", |stage| !stage.state().session.compile_state().compiling);
    stage.run_steps(3);
}

/// Types into the code as a user does.
fn write(stage: &mut Stage, new: &str) {
    focus_code(stage);
    press(stage, CTRL, Key::A);
    stage.event(Event::Paste(new.into()));
    stage.run_steps(2);
    stage.state_mut().session.apply(EditCommand::CompileNow);
    settle(stage);
}

fn focus_code(stage: &mut Stage) {
    let at = stage.state().shell.place("code").unwrap().center();
    stage.hover_at(at);
    stage.drag_at(at);
    stage.drop_at(at);
    stage.run_steps(3);
    assert!(stage.state().shell.has_keys(&stage.ctx));
}

fn key(stage: &mut Stage, key: Key) {
    press(stage, Modifiers::NONE, key);
}

fn type_text(stage: &mut Stage, text: &str) {
    stage.event(Event::Text(text.into()));
    stage.run_steps(2);
}

const OLD: &str = "void main() {\n    vec4 a = texture2D(iChannel0, vec2(1));\n    gl_FragColor = a;\n}\n";

#[test]
fn quick_fixes_work_by_keys_and_in_the_list() {
    let Some(mut stage) = open(false) else { return };
    write(&mut stage, OLD);
    assert_eq!(stage.state().session.diagnostics().iter().filter(|d| d.tab() == Some(&Tab::image())).count(), 2);
    // Ctrl+. at the first line, and Enter.
    press(&mut stage, CTRL, Key::Home);
    press(&mut stage, CTRL, Key::Period);
    assert!(stage.state().shell.place("fixes").is_some(), "{:?}", texts(&stage));
    has(&named(&stage, "fixes"), &["Make it `mainImage`"]);
    key(&mut stage, Key::Escape);
    assert!(stage.state().shell.place("fixes").is_none() && text(&stage, &Tab::image()) == OLD);
    press(&mut stage, CTRL, Key::Period);
    key(&mut stage, Key::Enter);
    let fixed = text(&stage, &Tab::image());
    assert!(fixed.starts_with("void mainImage(out vec4 fragColor, in vec2 fragCoord) {\n"), "{fixed}");
    assert!(fixed.contains("    fragColor = a;\n"), "{fixed}");
    // One undo reverts it, and redo applies it again.
    press(&mut stage, CTRL, Key::Z);
    assert_eq!(text(&stage, &Tab::image()), OLD);
    press(&mut stage, CTRL_SHIFT, Key::Z);
    assert_eq!(text(&stage, &Tab::image()), fixed);
    settle(&mut stage);
    // The next one by the button in the list.
    click(&mut stage, "problem:0:fix");
    assert!(text(&stage, &Tab::image()).contains("texture(iChannel0"), "{}", text(&stage, &Tab::image()));
    settle(&mut stage);
    assert!(stage.state().session.diagnostics().iter().all(|d| d.tab() != Some(&Tab::image())));
    // If there is no problem the list says so, and another key goes to the code.
    press(&mut stage, CTRL, Key::Period);
    assert!(texts(&stage).iter().any(|text| text == "No quick fix for this line"));
    key(&mut stage, Key::Escape);
    type_text(&mut stage, "/");
    assert!(stage.state().shell.place("fixes").is_none());
}

#[test]
fn outdated_fixes_change_nothing() {
    let Some(mut stage) = open(false) else { return };
    write(&mut stage, "void mainImage(out vec4 o, in vec2 p) { o = vec4(p.x * 2); }");
    let problem = stage.state().session.diagnostics().iter().find(|d| !d.fixes.is_empty()).cloned().unwrap();
    let other = "void mainImage(out vec4 o, in vec2 p) { /* other */ o = vec4(p.x * 2); }";
    write(&mut stage, other);
    stage.state_mut().shell.ask_fix(problem.fixes[0].clone());
    stage.run_steps(3);
    assert_eq!(text(&stage, &Tab::image()), other);
    assert!(stage.state().session.notices().last().unwrap().text.contains("changed since"));
}

const SHARED: &str = "float glow(float x) {\n    return 0.5 * x;\n}\n";
const USES: &str = "#include \"lib/glow.glsl\"\nvoid mainImage(out vec4 o, in vec2 p) {\n    float glare = 1.0;\n    o = vec4(glow(glare)); // glow\n}\n";

fn with_shared() -> Option<Stage> {
    let mut stage = open(false)?;
    let folder = stage.state().folder.path().to_owned();
    std::fs::create_dir(folder.join("lib")).unwrap();
    std::fs::write(folder.join("lib/glow.glsl"), SHARED).unwrap();
    for tab in ["image.glsl", "buffer_a.glsl"] {
        std::fs::write(folder.join(tab), USES).unwrap();
    }
    stage.state_mut().session.apply(FileCommand::Open(folder.display().to_string()));
    stage.state_mut().session.apply(TransportCommand::Pause);
    until(&mut stage, "compiled", |stage| {
        let state = stage.state().session.compile_state();
        !state.compiling && state.last.is_some() && stage.state().session.tabs().len() == 3
    });
    stage.run_steps(4);
    Some(stage)
}

fn shared() -> Tab {
    Tab::Included("lib/glow.glsl".into())
}

#[test]
fn renaming_covers_all_texts_and_only_the_same_symbol() {
    let Some(mut stage) = with_shared() else { return };
    focus_code(&mut stage);
    // Go to the call by its name.
    press(&mut stage, CTRL, Key::Home);
    (0..3).for_each(|_| key(&mut stage, Key::ArrowDown));
    (0..15).for_each(|_| key(&mut stage, Key::ArrowRight));
    key(&mut stage, Key::F2);
    assert!(stage.state().shell.place("field:rename").is_some(), "{:?}", texts(&stage));
    // A name that is already in use keeps the bar open, with the reason.
    type_text(&mut stage, "glare");
    key(&mut stage, Key::Enter);
    assert!(stage.state().shell.place("rename:wrong").is_some());
    press(&mut stage, CTRL, Key::A);
    type_text(&mut stage, "mix");
    key(&mut stage, Key::Enter);
    assert!(stage.state().shell.place("rename:wrong").is_some());
    assert_eq!(text(&stage, &Tab::image()), USES);
    press(&mut stage, CTRL, Key::A);
    type_text(&mut stage, "shine");
    key(&mut stage, Key::Enter);
    let renamed = USES.replace("glow(", "shine(");
    for tab in [Tab::image(), buffer()] {
        assert_eq!(text(&stage, &tab), renamed, "{tab:?}");
    }
    assert_eq!(text(&stage, &shared()), SHARED.replace("glow", "shine"));
    settle(&mut stage);
    assert!(stage.state().session.diagnostics().is_empty(), "{:?}", stage.state().session.diagnostics());
    // One undo reverts all texts, and one redo renames in all.
    let renamed_tabs = |stage: &Stage| {
        [Tab::image(), buffer(), shared()].iter().filter(|tab| text(stage, tab).contains("shine")).count()
    };
    press(&mut stage, CTRL, Key::Z);
    assert_eq!(renamed_tabs(&stage), 0);
    press(&mut stage, CTRL, Key::Y);
    assert_eq!(renamed_tabs(&stage), 3);
    press(&mut stage, CTRL, Key::Z);
    // Built-in names cannot be renamed.
    write(&mut stage, "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }");
    press(&mut stage, CTRL, Key::Home);
    (0..8).for_each(|_| key(&mut stage, Key::ArrowRight));
    key(&mut stage, Key::F2);
    assert!(stage.state().shell.place("field:rename").is_none());
}

#[test]
fn names_of_included_files_link_to_their_tabs() {
    let Some(mut stage) = with_shared() else { return };
    let folder = stage.state().folder.path().to_owned();
    std::fs::write(folder.join("lib/dim.glsl"), "float dim(float x) { return 0.1 * x; }\n").unwrap();
    write(&mut stage, &format!("#include \"lib/dim.glsl\"\n{USES}"));
    let dim = Tab::Included("lib/dim.glsl".into());
    until(&mut stage, "included", |stage| stage.state().session.tabs().contains(&dim));
    stage.run_steps(3);
    for tab in [shared(), dim] {
        click(&mut stage, &format!("includes:{}", tab.title()));
        assert_eq!(stage.state().shell.caret().0, tab);
        assert!(stage.state().shell.has_keys(&stage.ctx), "one writes on in it");
        click(&mut stage, "tab:Image");
    }
}

const SPEED: &str = "#iUniform float speed = 1.0 in { 0.0, 2.0 } // speed of all\n";
const USES_SPEED: &str = "void mainImage(out vec4 o, in vec2 p) {\n    o = vec4(speed);\n}\n";

/// Returns the value of a uniform's slider by its name; `None`: it has the default.
fn turned(stage: &Stage, name: &str) -> Option<CustomUniformValue> {
    stage.state().session.project().custom_uniform_values.get(name).cloned()
}

#[test]
fn renaming_a_uniform_keeps_its_value() {
    let Some(mut stage) = open(false) else { return };
    let folder = stage.state().folder.path().to_owned();
    std::fs::write(folder.join("common.glsl"), SPEED).unwrap();
    for file in ["image.glsl", "buffer_a.glsl"] {
        std::fs::write(folder.join(file), USES_SPEED).unwrap();
    }
    stage.state_mut().session.apply(FileCommand::Open(folder.display().to_string()));
    stage.state_mut().session.apply(TransportCommand::Pause);
    settle(&mut stage);
    // Edits of the text do not reach `eddy.toml`.
    let fill = |text: &str| {
        let value = FillValue::Expression(format!("vec4({text})").into());
        Command::Edit(EditCommand::EditPasses(PassEdit::Initial(PassName::buffer("A"), Some(value))))
    };
    stage.state_mut().session.apply(fill("0.1 * speed"));
    let why = stage.state().session.rename(&Tab::Common, SPEED.find("speed").unwrap(), "pace").unwrap_err();
    assert_eq!(why, "`speed` is used in the initial state of Buffer A too: write `pace` there first, then rename it");
    stage.state_mut().session.apply(fill("0.1"));
    let value = CustomUniformValue::Float(1.5);
    let turn = Command::Edit(EditCommand::SetCustomUniform { name: "speed".into(), value: Some(value.clone()) });
    stage.state_mut().session.apply(turn);
    focus_code(&mut stage);
    press(&mut stage, CTRL, Key::Home);
    key(&mut stage, Key::ArrowDown);
    (0..14).for_each(|_| key(&mut stage, Key::ArrowRight));
    key(&mut stage, Key::F2);
    type_text(&mut stage, "o");
    key(&mut stage, Key::Enter);
    assert!(stage.state().shell.place("rename:wrong").is_some(), "a local has that name");
    press(&mut stage, CTRL, Key::A);
    type_text(&mut stage, "pace");
    key(&mut stage, Key::Enter);
    assert_eq!(text(&stage, &Tab::Common), SPEED.replacen("speed", "pace", 1));
    for tab in [Tab::image(), buffer()] {
        assert_eq!(text(&stage, &tab), USES_SPEED.replace("speed", "pace"), "{tab:?}");
    }
    assert_eq!((turned(&stage, "speed"), turned(&stage, "pace")), (None, Some(value.clone())));
    // The running program has the old name until the new one is compiled.
    let shown = |stage: &Stage| {
        let session = &stage.state().session;
        let uniform = session.custom_uniforms()[0].clone();
        (uniform.name.clone(), session.custom_uniform_value(&uniform))
    };
    assert_eq!(shown(&stage).1, value);
    settle(&mut stage);
    assert_eq!(shown(&stage), ("pace".to_owned(), value.clone()));
    assert!(stage.state().session.diagnostics().is_empty(), "{:?}", stage.state().session.diagnostics());
    press(&mut stage, CTRL, Key::S);
    until(&mut stage, "saved", |stage| !stage.state().session.is_dirty());
    let manifest = std::fs::read_to_string(folder.join("eddy.toml")).unwrap();
    assert!(manifest.contains("pace = 1.5") && !manifest.contains("speed"), "{manifest}");
    // The value follows the line when the rename is undone, and the passes' undo uses the new name.
    stage.state_mut().session.apply(EditCommand::EditText { tab: Tab::Common, text: SPEED.into() });
    assert_eq!((turned(&stage, "speed"), turned(&stage, "pace")), (Some(value), None));
    stage.state_mut().session.apply(EditCommand::UndoPassEdit);
    assert_eq!((turned(&stage, "speed"), turned(&stage, "pace")), (None, None));
    stage.state_mut().session.apply(EditCommand::RedoPassEdit);
    assert!(turned(&stage, "speed").is_some());
}

#[test]
fn declaring_sliders_is_explained_for_each_dialect() {
    let Some(mut stage) = open(false) else { return };
    let folder = stage.state().folder.path().to_owned();
    let draws = "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }";
    std::fs::write(folder.join("plain.glsl"), draws).unwrap();
    std::fs::write(folder.join("plain.fs"), "/*{ \"ISFVSN\": \"2\" }*/ void main() { gl_FragColor = vec4(1.0); }")
        .unwrap();
    stage.state_mut().shell.set_open(Panel::Uniforms, true);
    let path = |name: &str| folder.join(name).display().to_string();
    for (spec, expected) in [
        (path("plain.glsl"), "#iUniform float speed = 1.0 in { 0.0, 4.0 }"),
        (format!("ghostty:{}", path("plain.glsl")), "Ghostty gives a shader its own uniforms and no others."),
        (path("plain.fs"), "Add a line like this to INPUTS, and save, to get a slider:"),
    ] {
        stage.state_mut().session.apply(FileCommand::Open(spec.clone()));
        settle(&mut stage);
        assert!(texts(&stage).iter().any(|text| text == expected), "{spec}: {:?}", texts(&stage));
        assert_eq!(texts(&stage).iter().any(|text| text.starts_with("#iUniform")), expected.starts_with('#'), "{spec}");
    }
}

#[test]
fn sliders_appear_before_the_first_compile() {
    let Some(mut stage) = open(false) else { return };
    let folder = stage.state().folder.path().join("broken");
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(folder.join("image.glsl"), format!("{SPEED}void mainImage(out vec4 o, in vec2 p) {{ o = ; }}"))
        .unwrap();
    let hint = |stage: &Stage| texts(stage).iter().any(|text| text.starts_with("Add a line like this"));
    stage.state_mut().shell.set_open(Panel::Uniforms, true);
    stage.state_mut().session.apply(FileCommand::Open(folder.display().to_string()));
    stage.step();
    assert!(!hint(&stage));
    assert!(stage.state().shell.place("uniform:speed").is_some(), "{:?}", texts(&stage));
    settle(&mut stage);
    assert!(!stage.state().session.diagnostics().is_empty(), "it has no program");
    assert!(stage.state().shell.place("uniform:speed").is_some());
    write(&mut stage, USES_SPEED);
    assert!(hint(&stage));
    // The same for a uniform that only the newest text declares, and the running program does not.
    write(&mut stage, "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }");
    write(&mut stage, &format!("{SPEED}void mainImage(out vec4 o, in vec2 p) {{ o = ; }}"));
    assert!(stage.state().shell.place("uniform:speed").is_some());
}

#[test]
fn replacing_in_all_passes_is_one_step_of_undo() {
    let Some(mut stage) = with_shared() else { return };
    focus_code(&mut stage);
    press(&mut stage, CTRL_SHIFT, Key::F);
    press(&mut stage, CTRL, Key::H);
    click(&mut stage, "field:find");
    press(&mut stage, CTRL, Key::A);
    type_text(&mut stage, "glow");
    stage.run_steps(2);
    // In the line that includes, the call and the comment of two passes, and in the included file.
    assert!(texts(&stage).iter().any(|text| text == "7"), "{:?}", texts(&stage));
    assert!(texts(&stage).iter().any(|text| text == "7 matches in 3 tabs"));
    // Enter continues in the next text, and the field keeps the keyboard focus.
    let mut seen = std::collections::BTreeSet::new();
    for _ in 0..7 {
        key(&mut stage, Key::Enter);
        seen.insert(stage.state().shell.caret().0.title());
    }
    assert_eq!(seen.len(), 3, "{seen:?}");
    press(&mut stage, CTRL, Key::A);
    type_text(&mut stage, "float");
    click(&mut stage, "field:replace");
    type_text(&mut stage, "highp float");
    click(&mut stage, "find:replace-all");
    for (tab, old) in [(Tab::image(), USES), (buffer(), USES), (shared(), SHARED)] {
        assert_eq!(text(&stage, &tab), old.replace("float", "highp float"), "{tab:?}");
    }
    assert!(stage.state().session.notices().last().unwrap().text.starts_with("Replaced 4 matches in 3 tabs"));
    key(&mut stage, Key::Escape);
    click(&mut stage, "tab:Image");
    press(&mut stage, CTRL, Key::Z);
    for (tab, old) in [(Tab::image(), USES), (buffer(), USES), (shared(), SHARED)] {
        assert_eq!(text(&stage, &tab), old, "{tab:?}");
    }
    // A text that was edited since is not reverted with the others.
    press(&mut stage, CTRL, Key::Y);
    click(&mut stage, "tab:Buffer A");
    focus_code(&mut stage);
    type_text(&mut stage, " ");
    click(&mut stage, "tab:Image");
    press(&mut stage, CTRL, Key::Z);
    assert!(text(&stage, &Tab::image()) == USES && text(&stage, &buffer()).contains("highp float"));
    // Toggling the bar limits it to one text again.
    press(&mut stage, CTRL_SHIFT, Key::F);
    press(&mut stage, CTRL_SHIFT, Key::F);
    type_text(&mut stage, "glow");
    assert!(!texts(&stage).iter().any(|text| text.ends_with("places")));
}

#[test]
fn context_menu_of_the_code_opens_by_mouse_and_keys() {
    let Some(mut stage) = with_shared() else { return };
    focus_code(&mut stage);
    press(&mut stage, CTRL, Key::Home);
    press(&mut stage, Modifiers::SHIFT, Key::F10);
    let wanted = ["Cut", "Copy", "Paste", "Go to definition", "Find references", "Rename symbol…", "Toggle breakpoint"];
    let names = named(&stage, "the code's menu");
    wanted.iter().for_each(|name| assert!(names.iter().any(|n| n.starts_with(name)), "{name}: {names:?}"));
    click(&mut stage, "code-menu:definition");
    stage.run_steps(3);
    assert_eq!(stage.state().shell.caret().0, shared(), "the line that includes it leads there");
    // A right click applies to the place that was clicked.
    click(&mut stage, "tab:Image");
    let at = stage.state().shell.place("code").unwrap().center();
    stage.event(Event::PointerMoved(at));
    for pressed in [true, false] {
        stage.event(Event::PointerButton {
            pos: at,
            button: PointerButton::Secondary,
            pressed,
            modifiers: Modifiers::NONE,
        });
        stage.run_steps(2);
    }
    assert!(stage.state().shell.place("code-menu:rename").is_some());
    key(&mut stage, Key::Escape);
    // Cut deletes the line, and undo restores it.
    focus_code(&mut stage);
    press(&mut stage, CTRL, Key::Home);
    press(&mut stage, Modifiers::SHIFT, Key::F10);
    click(&mut stage, "code-menu:cut");
    stage.run_steps(3);
    assert_eq!(text(&stage, &Tab::image()), USES.split_once('\n').unwrap().1);
    stage.state_mut().shell.focus_code();
    stage.run_steps(2);
    press(&mut stage, CTRL, Key::Z);
    assert_eq!(text(&stage, &Tab::image()), USES);
}

#[test]
fn breakpoints_move_to_a_statement_or_are_refused_with_a_notice() {
    let Some(mut stage) = open(false) else { return };
    write(
        &mut stage,
        "// About.\nvoid mainImage(out vec4 o, in vec2 p) {\n    // More.\n\n    o = vec4(1.0);\n}\n// End.\n",
    );
    stage.state_mut().shell.set_open(Panel::Trace, true);
    stage.run_steps(3);
    focus_code(&mut stage);
    let go = |stage: &mut Stage, line: usize| {
        press(stage, CTRL, Key::Home);
        (0..line).for_each(|_| key(stage, Key::ArrowDown));
        key(stage, Key::F9);
    };
    for line in [0, 2, 3] {
        go(&mut stage, line);
        assert_eq!(stage.state().shell.breakpoints(), [(Tab::image(), 4)], "line {line}");
    }
    go(&mut stage, 4);
    assert_eq!(stage.state().shell.breakpoints(), []);
    go(&mut stage, 6);
    assert_eq!(stage.state().shell.breakpoints(), []);
    assert!(stage.state().session.notices().last().unwrap().text.starts_with("No statement here"));
}

#[test]
fn compile_on_save_delays_edits() {
    let Some(mut stage) = open(false) else { return };
    choose(&mut stage, "toggle compile on save");
    stage.run_steps(2);
    focus_code(&mut stage);
    press(&mut stage, CTRL, Key::A);
    stage.event(Event::Paste("void mainImage(out vec4 o, in vec2 p) { o = none; }".into()));
    stage.run_steps(3);
    let session = &stage.state().session;
    assert!(session.waits_for_save() && !session.compile_state().compiling);
    std::thread::sleep(2 * session.edit_debounce());
    stage.run_steps(5);
    assert!(stage.state().session.diagnostics().iter().all(|d| !d.message.contains("none")));
    assert!(
        texts(&stage).iter().any(|text| text == "Edited: save to compile") || stage.state().session.waits_for_save()
    );
    press(&mut stage, CTRL, Key::S);
    until(&mut stage, "an error", |stage| {
        stage.state().session.diagnostics().iter().any(|d| d.message.contains("none"))
    });
    assert!(!stage.state().session.waits_for_save());
    // When it is switched off, pending edits are compiled at once.
    press(&mut stage, CTRL, Key::A);
    stage.event(Event::Paste("void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }".into()));
    stage.run_steps(3);
    assert!(stage.state().session.waits_for_save());
    choose(&mut stage, "toggle compile on save");
    until(&mut stage, "a good compile", |stage| {
        stage.state().session.diagnostics().is_empty() && !stage.state().session.compile_state().compiling
    });
}
