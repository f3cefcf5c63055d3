//! Tokens, positions and numbers.
#![cfg(test)]

use super::{Kind, Lexer, bad_number, words};
use eddy_diag::SourceId;

/// Returns the kind, the characters in the author's text, and the value of each token.
fn lex(text: &str) -> Vec<(Kind, String, u32)> {
    let mut names = words::interner();
    let mut lexer = Lexer::new(SourceId(0), text);
    let mut tokens = Vec::new();
    loop {
        let token = lexer.next(&mut names);
        if token.kind == Kind::Eof {
            return tokens;
        }
        tokens.push((token.kind, text[token.span.range()].to_owned(), token.value));
    }
}

fn kinds(text: &str) -> Vec<Kind> {
    lex(text).into_iter().map(|t| t.0).collect()
}

fn texts(text: &str) -> Vec<String> {
    lex(text).into_iter().map(|t| t.1).collect()
}

#[test]
fn the_longest_operator_wins() {
    use Kind::*;
    assert_eq!(
        kinds("a+++b<<=c>>d>=e^^f|=g"),
        [
            Ident,
            PlusPlus,
            Plus,
            Ident,
            LessLessEqual,
            Ident,
            GreaterGreater,
            Ident,
            GreaterEqual,
            Ident,
            CaretCaret,
            Ident,
            OrEqual,
            Ident
        ]
    );
    assert_eq!(kinds("a-=-b"), [Ident, MinusEqual, Minus, Ident]);
    assert_eq!(kinds("!=!a&&&b||c"), [BangEqual, Bang, Ident, AndAnd, And, Ident, OrOr, Ident]);
}

#[test]
fn comments_are_white_space() {
    assert_eq!(texts("a/* b // */c// d\ne"), ["a", "c", "e"]);
    assert_eq!(texts("a/**/b"), ["a", "b"]);
    assert_eq!(texts("a // \u{2603} \u{0} \"\nb"), ["a", "b"], "anything may stand in a comment");
    assert_eq!(kinds("a /* b"), [Kind::Ident, Kind::OpenComment]);
    assert_eq!(kinds("/*/"), [Kind::OpenComment]);
}

#[test]
fn all_three_line_ends_are_recognised() {
    for end in ["\n", "\r\n", "\r"] {
        assert_eq!(texts(&format!("a // b{end}c")), ["a", "c"]);
        assert_eq!(texts(&format!("ab\\{end}cd // x \\{end} y{end}e")).last().unwrap(), "e");
    }
}

#[test]
fn joined_lines_keep_original_positions() {
    let text = "fl\\\noat x\\\r\n = 1\\\n.5;\\\n";
    let tokens = lex(text);
    let spelled: Vec<&str> = tokens.iter().map(|t| t.1.as_str()).collect();
    assert_eq!(spelled, ["fl\\\noat", "x", "=", "1\\\n.5", ";"]);
    assert_eq!(words::kind(tokens[0].2), Kind::Type);
    assert_eq!(f32::from_bits(tokens[3].2), 1.5);
    // Only a backslash at the end of its line joins.
    assert_eq!(kinds("a \\ \nb"), [Kind::Ident, Kind::BadChar, Kind::Ident]);
}

#[test]
fn numbers() {
    let int = |text: &str| match lex(text).as_slice() {
        [(Kind::Int, _, value)] => *value as i32,
        other => panic!("{text}: {other:?}"),
    };
    assert_eq!((int("0"), int("017"), int("0x1F"), int("2147483648")), (0, 15, 31, i32::MIN));
    assert_eq!(int("0xFFFFFFFF"), -1);
    assert_eq!(lex("12u"), [(Kind::Uint, "12u".into(), 12)]);
    let float = |text: &str| match lex(text).as_slice() {
        [(Kind::Float, _, value)] => f32::from_bits(*value),
        other => panic!("{text}: {other:?}"),
    };
    for (text, value) in [
        ("1.", 1.0),
        (".5", 0.5),
        ("1.5f", 1.5),
        ("1e3", 1000.0),
        ("1.e-2F", 0.01),
        ("08.5", 8.5),
        ("1E+2", 100.0),
        ("0.1", 0.1),
        ("1e99", f32::INFINITY),
    ] {
        assert_eq!(float(text), value, "{text}");
    }
    assert_eq!(texts("0xE+1"), ["0xE", "+", "1"], "a sign is no part of a hexadecimal number");
    assert_eq!(texts("v.x.y"), ["v", ".", "x", ".", "y"]);
    assert_eq!(texts("a[0].x"), ["a", "[", "0", "]", ".", "x"]);
}

#[test]
fn invalid_numbers_have_a_reason() {
    for (text, expected) in [
        ("1f", "takes no `f`"),
        ("08", "octal"),
        ("0189", "octal"),
        ("4294967296", "32 bits"),
        ("4294967296u", "32 bits"),
        ("0xFFFFFFFFF", "32 bits"),
        ("0x", "hexadecimal"),
        ("0xg", "hexadecimal"),
        ("1e", "digits after"),
        ("1e+", "digits after"),
        ("1.0.x", "not a number"),
        ("1..x", "not a number"),
        ("1.xx", "not a number"),
        ("1.0lf", "not a number"),
        ("3ul", "not a number"),
        ("2pi", "not a number"),
    ] {
        let tokens = lex(text);
        let [(Kind::BadNumber, spelled, value)] = tokens.as_slice() else { panic!("{text}: {tokens:?}") };
        assert_eq!(spelled, text, "the whole is one token");
        let (message, _) = bad_number(*value, spelled);
        assert!(message.contains(expected), "{text}: {message}");
    }
}

#[test]
fn foreign_characters_are_separate_tokens() {
    use Kind::*;
    assert_eq!(kinds("a \u{201c}b\u{201d} c"), [Ident, BadChar, Ident, BadChar, Ident]);
    assert_eq!(kinds("\u{3b1} = \u{e9}t\u{e9}2;"), [BadName, Equal, BadName, Semicolon]);
    assert_eq!(kinds("x\u{2082} a\0b"), [BadName, Ident, BadChar, Ident]);
    assert_eq!(kinds("\"a;b\" c \"d\ne"), [Text, Ident, Text, Ident]);
    assert_eq!(texts("\u{feff}a"), ["a"], "a byte order mark at the start is no character");
}

#[test]
fn words_are_classified() {
    let mut names = words::interner();
    let mut kind = |word: &str| words::kind(names.intern(word).0);
    for word in ["vec3", "mat2x2", "mat4x4", "usampler2DArray", "void"] {
        assert_eq!(kind(word), Kind::Type, "{word}");
    }
    for word in ["sample", "filter", "input", "double", "varying", "isampler2DMS", "using", "attribute"] {
        assert_eq!(kind(word), Kind::Reserved, "{word}");
    }
    // Reserved only in other versions, so plain names here.
    for word in
        ["buffer", "shared", "sampler", "texture2D", "precise", "packed", "dmat2", "samplerCubeArray", "sin", "iTime"]
    {
        assert_eq!(kind(word), Kind::Ident, "{word}");
    }
    assert_eq!(kind("invariant"), Kind::Invariant);
    assert_eq!(kind("false"), Kind::False);
    let symbol = names.intern("mat3x3").0;
    assert_eq!(words::basic_type(symbol).name(), "mat3");
}
