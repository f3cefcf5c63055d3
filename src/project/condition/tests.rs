use super::*;
use crate::{Origin, Pass, PassName, Source, limits};

fn holds(text: &str) -> bool {
    let value = |name: &str| match name {
        "kind" => Some(3.0),
        "on" => Some(1.0),
        "off" => Some(0.0),
        "rate" => Some(f64::from(0.1_f32)),
        _ => None,
    };
    Condition::parse(text).unwrap_or_else(|e| panic!("{text}: {e}")).holds(&value, (640, 360))
}

#[test]
fn operators_bind_as_in_glsl() {
    for text in [
        "kind == 3",
        "kind==3&&on",
        "!off",
        "!(kind == 2)",
        "off || on",
        "on || off && off",
        "!(off && on || off)",
        "1 < 2 == on",
        "kind >= 3 && kind <= 3 && kind > 2 && kind < 4 && kind != 2.5",
        "-kind < -2",
        "- -kind == 3",
        "rate == 0.1",
        "rate == .1f",
        "kind == 3e0 && kind == 30.e-1",
        "width == 640 && height < 361.0",
        "((((on))))",
        "true && !false",
        "16777217 != 16777216",
    ] {
        assert!(holds(text), "{text}");
    }
    for text in ["kind == 2", "off", "!on", "on && off || off", "width > 640", "nothing", "false", "!!off"] {
        assert!(!holds(text), "{text}");
    }
}

#[test]
fn syntax_errors_have_a_span_and_a_fix() {
    for (text, range, message, hint) in [
        ("", 0..0, "empty", "for example"),
        ("  ", 0..2, "empty", "for example"),
        ("kind = 3", 5..6, "= is not", "=="),
        ("kind & on", 5..6, "& is not", "&&"),
        ("kind and on", 5..8, "and is not", "&&"),
        ("kind or on", 5..7, "or is not", "||"),
        ("kind + 1 > 2", 5..6, "+ is not", "does not compute"),
        ("(kind == 3", 0..1, "not closed", ")"),
        ("kind == 3)", 9..10, ") is not", "("),
        ("kind ==", 7..7, "ends", "after it"),
        ("1 < kind < 3", 9..10, "second <", "&&"),
        ("kind == 3 == on", 10..12, "second ==", "&&"),
        ("kind == 3.1.2", 8..13, "3.1.2 is not a number", "0.5"),
        ("kind == 0x3", 8..11, "0x3 is not a number", "0.5"),
        ("kind == 1e999", 8..13, "not a number", "0.5"),
        ("kind == .", 8..9, "not a number", "0.5"),
        ("kind == é", 8..10, "é is not", "names of uniforms"),
        ("kind # on", 5..6, "# is not", "names of uniforms"),
    ] {
        let error = Condition::parse(text).expect_err(text);
        assert_eq!(error.range, range, "{text}: {error}");
        assert!(error.message.contains(message) && error.hint.contains(hint), "{text}: {error}");
    }
}

#[test]
fn long_or_deeply_nested_conditions_are_rejected() {
    let deep = |n: usize| format!("{}on{}", "(".repeat(n), ")".repeat(n));
    assert!(Condition::parse(&deep(limits::CONDITION_DEPTH - 1)).is_ok());
    assert!(Condition::parse(&deep(limits::CONDITION_DEPTH)).unwrap_err().message.contains("in one another"));
    assert!(Condition::parse(&"!".repeat(900)).unwrap_err().message.contains("in one another"));
    assert!(Condition::parse(&"on && ".repeat(400)).unwrap_err().message.contains("longer"));
    // Many parentheses that are not nested are fine.
    assert!(Condition::parse(&format!("{}on", "(on) && ".repeat(100))).is_ok());
}

#[test]
fn names_are_checked_against_the_uniforms() {
    let source = |text: &str| Source { name: "Image".into(), path: None, text: text.into() };
    let text =
        "#iUniform int diffusion = 1 in { 0, 3 }\n#iUniform vec2 wind = vec2(0.0)\n#iUniform float height = 2.0\n";
    let mut project = Project::new("p", vec![Pass::new(PassName::image(), source(text))], Origin::Unsaved);
    let mut buffer = Pass::new(PassName::buffer("A"), source(""));
    buffer.settings.when = Some(Condition::parse("difusion == 3 && width > 3 && height > 1 && wind < 1").unwrap());
    project.passes.insert(0, buffer);
    let uniforms = project.custom_uniforms();
    let sources = project.sources();
    let said: Vec<_> = project
        .check_conditions(&uniforms)
        .into_iter()
        .map(|d| {
            let span = d.span.unwrap();
            let text = sources.get(span.source).unwrap();
            (text.name.clone(), text.text[span.range()].to_owned(), d.message, d.hints.join("\n"))
        })
        .collect();
    assert_eq!(said.len(), 2, "{said:?}");
    assert_eq!((said[0].0.as_str(), said[0].1.as_str()), ("eddy.toml", "difusion"));
    assert!(said[0].3.contains("did you mean diffusion?"), "{said:?}");
    assert!(said[1].2.contains("vec2") && said[1].3.contains("int"), "{said:?}");
    assert!(project.fill_that_names("diffusion").is_none());
    project.passes[0].settings.when = Some(Condition::parse("diffusion == 3").unwrap());
    assert!(project.check_conditions(&uniforms).is_empty());
    assert_eq!(project.fill_that_names("diffusion").unwrap(), "the condition of Buffer A");
}
