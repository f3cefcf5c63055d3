//! Tests of which keys go to popups, and when popups open.

use super::*;
use crate::{
    diag::SourceId,
    glsl::{PassKind, PassSource, Text, services::Analysis},
    gui::{
        actions::{Action, KeyFocus, Keymap},
        editor::{EditorAction, input},
    },
};
use egui::Modifiers;

const ID: SourceId = SourceId(0);

/// Feeds keys as the editor does, with an analysis after each: `<Enter>` and the like are keys, the rest is typed.
fn type_into(text: &str, input: &str) -> (Assist, String) {
    let mut buffer = Buffer::new(&text.replace('@', ""));
    let at = text.find('@').unwrap();
    buffer.select(at, at);
    let mut assist = Assist::default();
    let mut rest = input;
    while let Some(first) = rest.chars().next() {
        let named = rest.strip_prefix('<').and_then(|r| r.split_once('>'));
        let (event, after) = match named {
            Some((name, after)) => {
                let ctrl = Modifiers { ctrl: true, command: true, ..Modifiers::NONE };
                let (key, modifiers) = match name {
                    "Ctrl+Space" => (Key::Space, ctrl),
                    name => (Key::from_name(name).unwrap(), Modifiers::NONE),
                };
                (Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers }, after)
            }
            None => (Event::Text(first.to_string()), &rest[first.len_utf8()..]),
        };
        rest = after;
        if !assist.take(&event, &mut buffer) {
            let entry = Keymap::default().pressed(&event, KeyFocus { code: true, ..KeyFocus::default() });
            match entry.map(|e| e.action) {
                Some(Action::Code(EditorAction::Propose)) => assist.propose(),
                Some(Action::Code(EditorAction::Definition)) => assist.go_to_definition(),
                Some(Action::Code(action)) => {
                    input::act(&mut buffer, action);
                    assist.after(&event, &buffer);
                }
                _ => {
                    input::handle(&mut buffer, &mut String::new(), &event, &|_, _| false);
                    assist.after(&event, &buffer);
                }
            }
        }
        let now = buffer.text().to_owned();
        let analysis = Analysis::new(&PassSource::new(PassKind::Image, Text { id: ID, text: &now }));
        assist.update(&buffer, Some(Help { analysis: &analysis, source: ID, classes: &[], text: &now }));
    }
    (assist, buffer.text().to_owned())
}

#[test]
fn popups_take_only_their_keys() {
    for (input, text) in [
        ("nor<Enter>", "x = normalize(); }"),
        ("nor<Tab>", "x = normalize(); }"),
        // The closing parenthesis is typed over, and one that is there is used.
        ("nor<Tab>p) + 1.", "x = normalize(p) + 1.; }"),
        ("(p)<Left><Left><Left>nor<Tab>", "x = normalize(p); }"),
        // A complete word: Enter goes to the text.
        ("normalize<Enter>", "x = normalize\n; }"),
        ("sin<Enter>", "x = sin\n; }"),
        // Picked explicitly, so Enter accepts.
        ("sin<Down><Up><Down><Enter>", "x = sinh(); }"),
        // The item does not start with these letters, so Enter accepts it only if it was picked; Tab always does.
        ("sms<Enter>", "x = sms\n; }"),
        ("sms<Tab>", "x = smoothstep(); }"),
        ("sms<Down><Up><Enter>", "x = smoothstep(); }"),
        // Closed by Escape, and stays closed for this word.
        ("nor<Escape>m<Enter>", "x = norm\n; }"),
        ("nor<Escape> + nor<Tab>", "x = nor + normalize(); }"),
        ("n<Enter>", "x = n\n; }"),
        ("n<Ctrl+Space><Enter>", "x = normalize(); }"),
        ("norx<Backspace><Enter>", "x = nor\n; }"),
        ("p.<Enter>", "x = p.\n; }"),
        ("p.<Tab>", "x = p.x; }"),
        ("p.<Down><Enter>", "x = p.y; }"),
        ("p.xy<Enter>", "x = p.xy\n; }"),
        ("1.5<Enter>", "x = 1.5\n; }"),
        ("nor<Left><Enter>", "x = no\nr; }"),
    ] {
        let (_, found) = type_into("void f(vec2 p) { x = @; }", input);
        let found = found.trim_start_matches("void f(vec2 p) { ").replace("\n    ", "\n").to_owned();
        assert_eq!(found, text, "{input}");
    }
}

#[test]
fn completion_opens_while_a_name_is_typed() {
    for (input, is_open) in [
        ("n", false),
        ("no", true),
        ("no ", false),
        ("qqqq", false),
        ("p.", true),
        ("p.x", true),
        ("12", false),
        ("vec3 no", false),
        ("// no", false),
        ("sin(", false),
        ("<Ctrl+Space>", true),
        ("no<Backspace><Backspace>", false),
    ] {
        let (assist, _) = type_into("void f(vec2 p) { @\n}", input);
        assert_eq!(assist.is_open(), is_open, "{input}");
    }
}

#[test]
fn signature_stays_open_inside_the_call() {
    for (input, parameter) in [
        ("clamp(", Some(0)),
        ("clamp(1.0, ", Some(1)),
        ("clamp(1.0, sin(", Some(0)),
        ("clamp(1.0, sin(2.0), ", Some(2)),
        ("clamp(1.0, 2.0)", None),
        ("clamp(<Escape>1.0", None),
        ("clamp(<Enter>", None),
        ("clam<Tab>", Some(0)),
        ("clam<Tab>1.0, ", Some(1)),
    ] {
        let (assist, _) = type_into("void f(vec2 p) { @\n}", input);
        assert_eq!(assist.signature.map(|s| s.parameter), parameter, "{input}");
    }
}

#[test]
fn requests_are_about_the_name_at_the_caret() {
    let (assist, _) = type_into("float g;\nvoid f() { g@; }", "<F12>");
    assert_eq!(assist.requests, [EditorRequest::GoTo(Span::new(ID, 6..7))]);
    assert_eq!(assist.uses(), [6..7, 20..21]);
    let (assist, _) = type_into("void f() { sin@(1.0); }", "<F12>");
    assert_eq!(assist.requests, []);
}
