use super::*;
use crate::limits;

fn value(text: &str) -> f64 {
    let of = |name: &str| match name {
        "x" => 3.0,
        "y" => -2.0,
        _ => f64::NAN,
    };
    Expression::parse(text, Syntax::Assertion).unwrap_or_else(|e| panic!("{text}: {e}")).value(&of)
}

#[test]
fn operators_and_functions_bind_as_in_glsl() {
    for (text, expected) in [
        ("1 + 2 * x", 7.0),
        ("(1 + 2) * x", 9.0),
        ("8 - 4 - 2", 2.0),
        ("8 / 4 / 2", 1.0),
        ("-x - -x", 0.0),
        ("+5 + +.5", 5.5),
        ("1 + 1 < x && !(y > 0)", 1.0),
        ("x > 2 ? 10 : 20", 10.0),
        ("x > 4 ? 10 : y < 0 ? 20 : 30", 20.0),
        ("(x > 4 ? 1 : 2) * 3", 6.0),
        ("min(x, y, 7)", -2.0),
        ("max(x, y, 7)", 7.0),
        ("min(0 / 0, 4)", 4.0),
        ("clamp(x, 0, 2) + clamp(y, 0, 2)", 2.0),
        ("clamp(1, 3, 2)", 3.0),
        ("pow(x, 2) + sqrt(16) + abs(y) + floor(2.9)", 17.0),
        ("exp2(x) + log2(8) + log(1)", 11.0),
        ("1e2 + 1.5e-1 + 2.f", 102.15),
        ("0.1 * 3", 0.1 * 3.0),
        ("1e999", f64::INFINITY),
    ] {
        assert_eq!(value(text), expected, "{text}");
    }
    assert!(value("z").is_nan() && value("sqrt(y)").is_nan());
}

#[test]
fn malformed_expressions_are_rejected_with_a_span_and_a_fix() {
    for (text, range, message, hint) in [
        ("1 +", 3..3, "ends where a value must follow", "a number or the name"),
        ("x ? 1", 2..3, "this ? has no :", "A : B"),
        ("foo(1)", 0..3, "no function foo", "abs, floor"),
        ("sqrt(1, 2)", 0..4, "sqrt does not take 2 arguments", "it takes 1"),
        ("min(1)", 0..3, "min does not take 1 arguments", "2 or more"),
        ("clamp(1, 2)", 0..5, "clamp does not take 2 arguments", "it takes 3"),
        ("sqrt()", 5..6, ") is not expected", "remove it"),
        ("sqrt(1", 4..5, "not closed", ")"),
        ("1 % 2", 2..3, "% is not expected", "operators as in GLSL"),
        ("1.2.3", 0..5, "not a number", "0.5"),
    ] {
        let error = Expression::parse(text, Syntax::Assertion).expect_err(text);
        assert_eq!(error.range, range, "{text}: {error}");
        assert!(error.message.contains(message) && error.hint.contains(hint), "{text}: {error}");
    }
}

#[test]
fn an_expression_ends_before_what_is_not_a_part_of_it() {
    for (text, length) in
        [("0..1", 1), ("1.5..2", 3), ("x * 2 unless y", 5), ("1% of x", 1), ("2 \"text\"", 1), ("x)", 1)]
    {
        let (_, end) = Expression::parse_start(text, Syntax::Assertion).unwrap();
        assert_eq!(end, length, "{text}");
    }
}

#[test]
fn syntaxes_differ_in_what_they_compute() {
    for text in ["x + 1", "x * 2", "x ? 1 : 2", "min(x, 1)", "+x"] {
        assert!(Expression::parse(text, Syntax::Condition).is_err(), "{text}");
    }
    let rounded = Expression::parse("0.1", Syntax::Condition).unwrap();
    assert_eq!(rounded.constant(), Some(f64::from(0.1_f32)));
    assert_eq!(Expression::parse("x", Syntax::Assertion).unwrap().constant(), None);
    let of = |text: &str| Expression::parse(text, Syntax::Size).unwrap().constant();
    assert_eq!((of("7 % 4 * 2"), of("ceil(1.2) + round(1.6) + mod(0 - 1, 3)")), (Some(6.0), Some(6.0)));
}

#[test]
fn nesting_is_limited() {
    let most = limits::CONDITION_DEPTH;
    for (open, inner, close) in [("(", "1", ")"), ("-", "1", ""), ("sqrt(", "1", ")"), ("1 ? 1 : ", "1", "")] {
        let nested = |n: usize| format!("{}{inner}{}", open.repeat(n), close.repeat(n));
        assert!(Expression::parse_start(&nested(most - 2), Syntax::Assertion).is_ok(), "{open}");
        let error = Expression::parse_start(&nested(100_000), Syntax::Assertion).unwrap_err();
        assert!(error.message.contains("in one another"), "{open}: {error}");
    }
}
