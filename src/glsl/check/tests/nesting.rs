//! Expressions may nest as deep as in browsers, and deeper ones are rejected with an error.

use super::checked;
use crate::{ChannelKind, PassKind};

fn image(body: &str) -> (bool, String) {
    let code = format!("float g(float x) {{ return x; }}\nvoid mainImage(out vec4 o, in vec2 p) {{ {body} }}");
    let (_, failed, messages) = checked(PassKind::Image, [ChannelKind::Sampler2D; 4], None, &code);
    (failed, messages)
}

/// Returns a value in `depth` pairs of brackets.
fn within(open: &str, value: &str, close: &str, depth: usize) -> String {
    format!("o = vec4({}{value}{});", open.repeat(depth), close.repeat(depth))
}

#[test]
fn parentheses_and_constants_nest_up_to_the_parser_limit() {
    for (open, value, close) in [
        ("(", "p.x", ")"),
        ("- ", "1.0", ""),
        ("abs(", "1.0", ")"),
        ("float(", "1.0", ")"),
        ("(0.0 + ", "1.0", ")"),
        ("(true ? ", "1.0", " : 0.0)"),
    ] {
        let (failed, messages) = image(&within(open, value, close, 4_000));
        assert!(!failed, "{open}: {messages}");
    }
}

#[test]
fn too_deep_expressions_are_reported_once() {
    for (open, close) in
        [("- ", ""), ("g(", ")"), ("(p.y + ", ")"), ("(p.x > 0.0 ? ", " : 0.0)"), ("float(", ")"), ("sin(", ")")]
    {
        // ANGLE rejects 256 levels.
        let (failed, messages) = image(&within(open, "p.x", close, 255));
        assert!(!failed, "{open}: {messages}");
        for depth in [400, 9_000, 100_000] {
            let (failed, messages) = image(&within(open, "p.x", close, depth));
            assert!(failed && messages.contains("deep"), "{open} {depth}: {messages}");
            assert_eq!(messages.matches("error: ").count(), 1, "{open} {depth}: {messages}");
        }
    }
    let (failed, messages) = image(&format!("{} o = vec4(1.0); {}", "{".repeat(255), "}".repeat(255)));
    assert!(!failed, "{messages}");
}
