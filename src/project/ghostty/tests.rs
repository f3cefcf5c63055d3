use super::{
    UNIFORMS, font, prelude,
    script::{self, Grid, SPANS, Style},
    values,
};
use crate::{Dialect, Input, Origin, Overwrite, Pass, PassName, Project, ProjectError, Source, load, manifest, save};
use std::fs;

#[test]
fn the_font_has_every_character_of_the_script() {
    for character in SPANS.iter().flat_map(|span| span.text.chars()).filter(|c| *c != ' ') {
        assert_ne!(font::index(character), 0, "{character:?}");
    }
    assert_eq!(font::packed(&[0x10, 0, 0, 1, 0x1f, 0, 2]), [0x10 << 15 | 1, 0x1f << 10 | 2]);
}

#[test]
fn the_palette_is_that_of_xterm_beyond_the_sixteen_names() {
    assert_eq!(prelude::palette(16), [0, 0, 0]);
    assert_eq!(prelude::palette(21), [0, 0, 255]);
    assert_eq!(prelude::palette(110), [135, 175, 215]);
    assert_eq!((prelude::palette(232), prelude::palette(255)), ([8; 3], [238; 3]));
}

#[test]
fn the_cursor_follows_typing_and_remembers_its_previous_state() {
    let start = script::at(0.0);
    assert_eq!((start.previous, start.changed_at), (None, 0.0));
    // At this time three characters of "cargo build" are typed.
    let typed = script::at(0.6 + 2.5 * 0.09);
    assert_eq!((typed.cursor.row, typed.cursor.column), (0, 14));
    assert_eq!(typed.previous.map(|cursor| cursor.column), Some(13));
    assert!((typed.changed_at - 0.78).abs() < 1e-9);
    let bar = script::at(9.1);
    assert_eq!((bar.cursor.style, bar.previous.map(|cursor| cursor.style)), (Style::Bar, Some(Style::Block)));
    // Hiding it is not a change.
    let (hidden, shown) = (script::at(12.9), script::at(13.3));
    assert!(!hidden.cursor.is_visible && shown.cursor.is_visible);
    assert_eq!((hidden.changed_at, shown.changed_at), (12.4, 12.4));
    let again = script::at(script::PERIOD + 0.1);
    assert_eq!(
        (again.cursor.row, again.previous.map(|cursor| cursor.row), again.changed_at),
        (0, Some(7), script::PERIOD)
    );
}

#[test]
fn the_focus_is_lost_and_regained() {
    assert!(script::at(11.0).is_focused && !script::at(11.5).is_focused);
    assert_eq!(script::at(11.0).focused_at, 0.0);
    assert_eq!(script::at(12.5).focused_at, 12.4);
    assert_eq!(script::at(script::PERIOD + 1.0).focused_at, 12.4);
}

#[test]
fn cursor_positions_are_the_left_and_upper_edge() {
    let cursor = script::at(0.0).cursor;
    assert_eq!(Grid::of(360).dot, 2);
    assert_eq!(Grid::of(360).rectangle(&cursor, 360), [140.0, 352.0, 12.0, 24.0]);
    let at = |name: &str, secs| values(secs, 360)[UNIFORMS.iter().position(|row| row.name == name).unwrap()];
    assert_eq!(at("iCurrentCursor", 0.0), [140.0, 352.0, 12.0, 24.0]);
    assert_eq!(at("iCurrentCursorStyle", 10.9)[0], 3.0);
    // An underline is one dot high, at the bottom of its cell.
    assert_eq!(at("iCurrentCursor", 10.9), [44.0, 360.0 - 8.0 - 240.0 - 20.0, 12.0, 2.0]);
}

fn project(text: &str) -> Project {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("glow.glsl");
    fs::write(&file, text).unwrap();
    load(&format!("ghostty:{}", file.display())).unwrap().project
}

#[test]
fn a_file_becomes_image_with_the_terminal_in_its_channel() {
    // `#iChannel` lines have no effect in Ghostty.
    let project = project("#iChannel0 \"keyboard\"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(0.0); }\n");
    assert_eq!(project.dialect, Dialect::Ghostty);
    assert!(matches!(&project.origin, Origin::File(path) if path.ends_with("glow.glsl")));
    let image = project.image().unwrap();
    assert_eq!(image.bindings.get(0).map(|c| &c.input), Some(&Input::buffer("terminal")));
    assert_eq!(image.bindings.channels().count(), 1);
    assert!(!project.has_channels_in_texts());
}

#[test]
fn eddy_toml_stores_the_dialect() {
    let text = manifest::write(&project("void mainImage(out vec4 c, in vec2 p) {}"), None, "glow", false);
    assert!(text.contains("dialect = \"ghostty\""), "{text}");
}

/// Changes that a Ghostty file cannot store are rejected, as they would be lost; a folder stores everything.
#[test]
fn a_file_is_saved_only_if_nothing_is_lost() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("glow.glsl");
    let text = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.0); }\n";
    fs::write(&file, text).unwrap();
    let project = load(&format!("ghostty:{}", file.display())).unwrap().project;
    let edited = text.replace("0.0", "1.0");
    type Change<'a> = &'a dyn Fn(&mut Project);
    let change = |change: Change<'_>| {
        let mut changed = project.clone();
        changed.image_mut().unwrap().source.text = edited.clone().into();
        change(&mut changed);
        changed
    };
    let added = |project: &mut Project| {
        let source = Source { name: "b".into(), path: None, text: "// mine".into() };
        project.passes.insert(1, Pass::new(PassName::buffer("B"), source));
    };
    let refused: [(&str, Change<'_>); 7] = [
        ("other passes", &added),
        ("Common", &|project| project.common.as_mut().unwrap().text = "// mine".into()),
        ("Common", &|project| project.common = None),
        ("terminal", &|project| project.passes[0].source.text = "// mine".into()),
        ("channels", &|project| {
            let bindings = &mut project.image_mut().unwrap().bindings;
            bindings.set(1, bindings.get(0).cloned());
        }),
        ("sliders", &|project| {
            project.custom_uniform_values.insert("x".into(), crate::CustomUniformValue::Float(0.5));
        }),
        ("description", &|project| project.info.author = "me".into()),
    ];
    for (word, edit) in refused {
        match save(&change(edit), &file, Overwrite::Refuse) {
            Err(ProjectError::CannotHold { what, .. }) => assert!(what.contains(word), "{word}: {what}"),
            other => panic!("{word}: {other:?}"),
        }
        assert_eq!(fs::read_to_string(&file).unwrap(), text, "{word}");
    }
    let folder = dir.path().join("folder");
    save(&change(&added), &folder, Overwrite::Refuse).unwrap();
    let again = load(folder.to_str().unwrap()).unwrap().project;
    assert_eq!((again.dialect, again.passes.len()), (Dialect::Ghostty, 3));
    let saved = save(&change(&|_| ()), &file, Overwrite::Refuse).unwrap();
    assert_eq!((fs::read_to_string(&file).unwrap(), saved.dialect), (edited, Dialect::Ghostty));
}
