//! Directives and macros: what the specification and the browsers' compiler accept, and what they reject.
#![cfg(test)]

use super::*;
use crate::{
    Include, Text,
    lex::{Kind, words},
    pieces,
};
use eddy_diag::{Diagnostic, SourceId, Span};

/// Returns the tokens as text with single spaces, and the diagnostics' messages.
fn run(text: &str) -> (String, Vec<String>) {
    run_texts(&[text])
}

/// Runs texts whose `#include` lines are not resolved, as for missing files.
fn run_texts(texts: &[&str]) -> (String, Vec<String>) {
    let texts: Vec<_> = texts.iter().enumerate().map(|(i, text)| Text { id: SourceId(i as u16), text }).collect();
    let missing: Vec<Diagnostic> = texts
        .iter()
        .flat_map(|text| text.text.match_indices("#include \"missing").map(move |(at, _)| (text, at)))
        .map(|(text, at)| {
            let line = text.text[at..].lines().next().unwrap();
            Diagnostic::error(Span::new(text.id, at..at + line.len()), format!("{line} is missing"))
        })
        .collect();
    let includes: Vec<_> = missing.iter().map(|said| Include { line: said.span.unwrap(), text: Err(said) }).collect();
    let mut names = words::interner();
    let mut report = Report::default();
    let done = preprocess(
        &pieces::of(&texts, &includes, false),
        (Unit::CommonAlone, Dialect::default(), Cancel::default()),
        Preprocessed::default(),
        &mut names,
        &mut report,
    );
    assert_eq!(done.tokens.len(), done.origins.tokens.len());
    assert_eq!(done.tokens.last().unwrap().kind, Kind::Eof);
    let shown: Vec<String> = done.tokens[..done.tokens.len() - 1]
        .iter()
        .zip(&done.origins.tokens)
        .map(|(token, origin)| match token.kind {
            Kind::Int => (token.value as i32).to_string(),
            Kind::Wrong => "<wrong>".into(),
            _ => texts[usize::from(origin.spelled.source.0)].text[origin.spelled.range()].to_owned(),
        })
        .collect();
    (shown.join(" "), report.diagnostics.iter().map(|d| format!("{}: {}", d.severity.name(), d.message)).collect())
}

/// Checks the tokens of a text that has no diagnostics.
#[track_caller]
fn assert_tokens(text: &str, expected: &str) {
    let (tokens, messages) = run(text);
    assert_eq!(messages, [""; 0], "{text}");
    assert_eq!(tokens, expected, "{text}");
}

/// Checks that there is one error that contains `part`.
#[track_caller]
fn assert_error(text: &str, part: &str) -> String {
    let (tokens, messages) = run(text);
    let text: String = text.chars().take(200).collect();
    assert_eq!(messages.len(), 1, "{text}: {messages:?}");
    assert!(messages[0].starts_with("error") && messages[0].contains(part), "{text}: {messages:?}");
    tokens
}

#[test]
fn backslash_at_the_end_of_the_text_is_ignored() {
    assert_tokens("a\\", "a");
    assert_tokens("a\n\n\\", "a");
    assert_error("a \\ b", "a backslash joins lines");
    assert_error("a\n\\ ", "a backslash joins lines");
}

#[test]
fn pragmas_of_other_tools_are_ignored() {
    assert_tokens("#pragma mark\na", "a");
    let (tokens, messages) = run("#pragma glslify: noise = require('glsl-noise/simplex/2d')\na");
    assert_eq!(tokens, "a");
    assert!(
        messages.len() == 1 && messages[0].starts_with("warning") && messages[0].contains("glslify"),
        "{messages:?}"
    );
    assert_error("#pragma include \"a.glsl\"\na", "`#pragma include`");
}

#[test]
fn object_macros() {
    assert_tokens("#define A 1 + B\n#define B 2\nA;", "1 + 2 ;");
    assert_tokens("#define A\nx A y", "x y");
    assert_tokens("#define A 1\n#undef A\nA", "A");
    assert_tokens("#define A (x)\nA", "( x )");
    assert_tokens("#define float vec4\nfloat", "vec4");
    assert_tokens("A\n#define A 1", "A");
    assert_tokens("# define A 1 // c\n  #  undef A\n#\n# // nothing\nA", "A");
    assert_tokens("/* */ #define X /* a \n b */ 1.\nX", "1.");
}

#[test]
fn function_macros() {
    assert_tokens("#define F(x) (x*x)\nF(a+b)", "( a + b * a + b )");
    assert_tokens("#define F(x, y) y x\nF((1, 2), f(3, 4))", "f ( 3 , 4 ) ( 1 , 2 )");
    assert_tokens("#define F() 1\nF() F( )", "1 1");
    assert_tokens("#define F(x) [x]\nF() F(\n\n1\n)", "[ ] [ 1 ]");
    assert_tokens("#define F(x, y) [x y]\nF(,)", "[ ]");
    // Without parentheses it is an ordinary name.
    assert_tokens("#define F(x) x\nF = F;", "F = F ;");
    assert_tokens("#define F (x)\nF", "( x )");
    assert_tokens("#define F(x) x\nF\n\n(1)", "1");
    // Parameters are also replaced in a nested call.
    assert_tokens("#define G(y) <y>\n#define F(x) G(x) G((x))\nF(1)", "< 1 > < ( 1 ) >");
}

#[test]
fn rescanning() {
    // C's examples about the order of expansion.
    assert_tokens("#define foo foo\nfoo", "foo");
    assert_tokens("#define a b\n#define b a\na b", "a b");
    assert_tokens("#define a b + a\n#define b a * 2\na", "a * 2 + a");
    assert_tokens("#define f(x) x + f(x)\nf(1)", "1 + f ( 1 )");
    assert_tokens("#define f(x) (x)\nf(f(f(1)))", "( ( ( 1 ) ) )");
    assert_tokens("#define f(a) a*g\n#define g(a) f(a)\nf(2)(9)", "2 * 9 * g");
    assert_tokens("#define F(x) x\n#define G F\nG(1)", "1");
    assert_tokens("#define F(x) [x]\n#define G F(\nG 1)", "[ 1 ]");
    assert_tokens("#define F(x) [x]\n#define L (\n#define R )\nF L 1 R", "F ( 1 )");
    // A name that occurred inside its own macro is not expanded when it is passed on either.
    assert_tokens("#define x x y\n#define F(a) a\nF(x)", "x y");
    assert_tokens("#define AA BB\n#define BB AA(1)\n#define AA2(x) x\nAA2(AA)", "AA ( 1 )");
    assert_tokens("#define z z[0]\n#define f(a) f(z * (a))\nf(y)", "f ( z [ 0 ] * ( y ) )");
}

#[test]
fn arguments_are_counted() {
    let tokens = assert_error("#define F(x, y) x\nF(1);", "takes 2 arguments, but 1 is given");
    assert_eq!(tokens, "<wrong> ;");
    assert_error("#define F(x) x\nF(1, 2)", "takes 1 argument, but 2 are given");
    assert_error("#define F() 1\nF(1)", "takes 0 arguments, but 1 is given");
    assert_error("#define F(x) x\nF(1;\n2", "no closing parenthesis");
    assert_error("#define F(x) x\n#define G F(1\nG", "no closing parenthesis");
}

#[test]
fn directives_in_arguments() {
    assert_tokens("#define F(x) x\nF(\n#if 1\n1\n#else\n2\n#endif\n)", "1");
    assert_tokens("#define F(x) x\nF(\n#define B 3\nB)", "3");
    assert_error("#define F(x) x\nF(\n#undef F\n1)", "in the arguments of its own call");
}

#[test]
fn definitions() {
    assert_tokens("#define A 1\n#define A 1\nA", "1");
    assert_tokens("#define A 1 +  2\n#define A   1 + 2 \nA", "1 + 2");
    assert_tokens("#define F(x) x\n#define F(x) x\nF(1)", "1");
    assert_error("#define A 1\n#define A 2", "already defined");
    assert_error("#define A 1+2\n#define A 1 + 2", "already defined");
    assert_error("#define F(x) x\n#define F(y) y", "already defined");
    assert_error("#define F(x) x\n#define F (x) x", "already defined");
    assert_tokens("#define A 1\n#undef A\n#define A 2\nA", "2");
    assert_tokens("#undef A", "");
    assert_tokens("#define HW_PERFORMANCE 1\n#undef HW_PERFORMANCE\n#define HW_PERFORMANCE 0\nHW_PERFORMANCE", "0");
    assert_error("#define HW_PERFORMANCE 0", "already defined");
    for name in ["__LINE__", "__FILE__", "__VERSION__", "GL_ES"] {
        assert_error(&format!("#define {name} 1"), "part of the language");
        assert_error(&format!("#undef {name}"), "part of the language");
    }
    assert_error("#define GL_A 1", "reserved");
    assert_error("#define defined 1", "operator");
    assert_error("#define", "needs the name");
    assert_error("#define 1 2", "cannot be the name");
    assert_error("#undef A B", "unexpected");
    assert_error("#define F(x, x) 1", "repeated");
    assert_error("#define F(...) 1", "variable number");
    assert_error("#define F(x 1", "expected `,` or `)`");
    assert_error("#define F(1) 1", "name of a parameter");
    assert_error("#define F(", "name of a parameter");
    let (tokens, messages) = run("#define A__B 1\nA__B");
    assert_eq!((tokens.as_str(), messages.len()), ("1", 1));
    assert!(messages[0].starts_with("warning"));
    let (tokens, messages) = run("#define F(x,) x\nF(1,)");
    assert!(messages.iter().any(|m| m.starts_with("warning")), "{tokens} {messages:?}");
}

#[test]
fn given_macros() {
    assert_tokens("__VERSION__ GL_ES HW_PERFORMANCE __FILE__ GL_FRAGMENT_PRECISION_HIGH", "300 1 1 0 1");
    // Shadertoy's header comes first: 11 lines before a Common that is compiled by itself.
    assert_tokens("__LINE__\n\n__LINE__ \\\n __LINE__", "12 14 15");
    assert_tokens("#define L __LINE__\n\nL", "14");
    assert_tokens("#line 5\n__LINE__\n#line 5\n__LINE__", "5 5");
    assert_tokens("#line 100\n__LINE__\n__LINE__", "100 101");
    assert_tokens("#line 10 + 5 7\n__LINE__ __FILE__", "15 7");
    assert_error("#line foo", "not defined");
    assert_error("#line 1 2 3", "not expected");
    assert_eq!(run_texts(&["\n__LINE__", "__LINE__\n__LINE__"]).0, "13 14 15", "Common and the pass are one text");
    assert_eq!(run_texts(&["#line 1\n\n", "__LINE__"]).0, "3");
}

#[test]
fn conditionals() {
    assert_tokens("#if 1\na\n#else\nb\n#endif\nc", "a c");
    assert_tokens("#if 0\na\n#elif 1\nb\n#elif 1\nc\n#else\nd\n#endif", "b");
    assert_tokens("#if 0\na\n#elif 0\nb\n#else\nc\n#endif", "c");
    assert_tokens("#ifdef A\na\n#endif\n#ifndef A\nb\n#endif", "b");
    assert_tokens("#define A\n#ifdef A\na\n#endif\n#ifndef A\nb\n#endif", "a");
    assert_tokens("#if 0\n#if 1\na\n#else\nb\n#endif\n#foo \" it's\n#else\nc\n#endif", "c");
    assert_tokens("#if 1\n#if 0\na\n#else\nb\n#endif\n#else\nc\n#endif", "b");
    // Skipped text is not examined.
    assert_tokens("#if 0\n\u{e9} @ 08 #error x\n#error y\n#endif\nz", "z");
    assert_tokens("#if 1\na\n#elif NOBODY\n#endif", "a");
    assert_tokens("#if 0\n/* #endif */ // #endif\n#endif\nz", "z");
    assert_tokens("#if 0\na \\\n#endif\n#endif\nz", "z");
    assert_tokens("#if 0\n/*\n#endif\n*/\n#endif\nz", "z");
    assert_error("#if 1", "has no `#endif`");
    assert_error("#ifdef A", "has no `#endif`");
    assert_error("#endif", "without an `#if`");
    assert_error("#else", "without an `#if`");
    assert_error("#elif 1", "without an `#if`");
    assert_error("#if 1\n#else\n#else\n#endif", "after the `#else`");
    assert_error("#if 0\n#else\n#elif 1\n#endif", "after the `#else`");
    assert_error("#if 1\n#endif x", "unexpected");
    assert_error("#if 1\n#else x\n#endif", "unexpected");
    assert_error("#ifdef A B\n#endif", "unexpected");
    assert_error("#ifdef\n#endif", "needs the name");
    assert_error("#ifdef 1\n#endif", "needs the name");
}

#[test]
fn expressions() {
    for (text, holds) in [
        ("1 + 2 * 3 == 7", true),
        ("(1 + 2) * 3 == 9", true),
        ("7 / 2 == 3 && 7 % 2 == 1", true),
        ("-7 / 2 == -3", true),
        ("1 << 4 == 16", true),
        ("16 >> 2 == 4", true),
        ("1 << 3 + 1 == 16", true),
        ("5 & 3 | 8 ^ 1", true),
        ("1 | 2 ^ 3 & 0", true),
        ("!0 && ~0 == -1", true),
        ("- - 1 == 1", true),
        ("1 < 2 == 1", true),
        ("2 > 1 != 0", true),
        ("1 <= 0", false),
        ("1 >= 2 || 0", false),
        ("0x10 == 16 && 010 == 8 && 3u == 3", true),
        ("defined A", false),
        ("defined(GL_ES) && defined GL_ES", true),
        ("!defined(A)", true),
        ("defined(A) && A > 1", false),
        ("1 || A", true),
        ("0 && 1 / 0", false),
        ("__VERSION__ >= 300", true),
        ("HW_PERFORMANCE == 0", false),
    ] {
        let expected = if holds { "y" } else { "n" };
        assert_tokens(&format!("#if {text}\ny\n#else\nn\n#endif"), expected);
    }
    assert_tokens("#define F(x) (x > 2)\n#if F(3) && !F(2)\ny\n#endif", "y");
    assert_tokens("#define E == 1\n#if 1 E\ny\n#endif", "y");
    for (text, part) in [
        ("", "missing"),
        ("A", "`A` is not defined"),
        ("1 +", "incomplete"),
        ("(1", "not closed"),
        ("1)", "not expected"),
        ("1 2", "not expected"),
        ("1.0", "only integers"),
        ("1 / 0", "zero"),
        ("1 % 0", "zero"),
        ("1 << 32", "shift"),
        ("1 >> -1", "shift"),
        ("1 ? 2 : 3", "not expected"),
        ("1 = 1", "not expected"),
        ("1, 2", "not expected"),
        ("true", "`true`"),
        ("4294967296", "32 bits"),
        ("defined 1", "takes the name"),
        ("defined(GL_ES", "takes the name"),
        ("\"a\"", "strings"),
    ] {
        assert_error(&format!("#if {text}\n#endif"), part);
    }
    assert_error("#define D defined(A)\n#if D\n#endif", "from a macro");
    assert_error("#define F(x) x\n#if F\n#endif", "has no value");
    let nested = |depth| format!("#if {}1{}\ny\n#endif", "(".repeat(depth), ")".repeat(depth));
    assert_tokens(&nested(9_990), "y");
    assert_tokens(&format!("#if {}1\ny\n#endif", "!".repeat(9_990)), "y");
    assert_error(&nested(100_000), "deep");
}

#[test]
fn other_directives() {
    assert_error("#error it is  so\nx", "#error: it is  so");
    assert_tokens("#pragma optimize(off)\n#pragma STDGL foo\nx", "x");
    assert_error("#pragma STDGL invariant(all)", "invariant");
    assert_error("#version 300 es", "#version");
    assert_error("#extension GL_OES_standard_derivatives : enable", "#extension");
    assert_error("#include <a.glsl>", "in double quotes, not in angle brackets");
    assert_error("#include", "has no file name");
    assert_error("#include \"noise.glsl", "closing quote");
    assert_error("#iKeyboard\nx", "no `#iKeyboard`");
    assert_tokens("#StrictCompatibility\nx", "x");
    assert_tokens("#if 0\n#include <a>\n#import \"a\"\n#pragma include \"a\"\n#endif\nx", "x");
    assert_error("#foo", "no directive");
    assert_error("#1", "name of a directive");
    assert_error("a #define B", "`a` comes before `#define`");
    assert_error("a #b", "no meaning here");
}

#[test]
fn a_missing_include_is_an_error_only_where_its_line_is_compiled() {
    const LINE: &str = "#include \"missing.glsl\"";
    for text in [
        "#ifdef NONE\n@\n#endif\nx",
        "#if 0\n@\n#endif\nx",
        "#if 1\nx\n#else\n@\n#endif",
        "#if 1\nx\n#elif 1\n@\n@\n#endif",
        "#if 0\n#if 1\n@\n#else\n@\n#endif\n@\n#endif\nx",
        "#if 1\n#ifndef NONE\n#else\n@\n#endif\n#endif\nx",
        "#define NONE\n#undef NONE\n#ifdef NONE\n@\n#endif\nx",
    ] {
        assert_tokens(&text.replace('@', LINE), "x");
    }
    for text in [
        "@\nx",
        "x\n@",
        "#ifndef NONE\n@\n#endif\nx",
        "#if 0\n#else\n@\n#endif\nx",
        "#if 0\n@\n#elif 1\n@\n#else\n@\n#endif\nx",
        "#define F(a) a\nF(x\n@\n)",
    ] {
        assert_eq!(assert_error(&text.replace('@', LINE), "#include \"missing.glsl\" is missing"), "x", "{text}");
    }
    // A macro of the previous text, such as Common.
    let guarded = format!("#ifdef NOISE\n{LINE}\n#endif\nx");
    assert_eq!(run_texts(&["", &guarded]), ("x".into(), vec![]));
    let (tokens, said) = run_texts(&["#define NOISE\n", &guarded]);
    assert_eq!((tokens.as_str(), said.len()), ("x", 1), "{said:?}");
    // Line numbers continue as if the line were blank.
    assert_eq!(run(&format!("#if 0\n{LINE}\n#endif\n__LINE__")), run("#if 0\n\n#endif\n__LINE__"));
}

#[test]
fn text_that_is_not_glsl_is_rejected() {
    assert_eq!(assert_error("a \u{2212} b", "looks like `-`"), "a \u{2212} b");
    assert_eq!(assert_error("a $ b", "no meaning"), "a b");
    assert_eq!(assert_error("float \u{3b1} = 1.0; \u{3b1};", "does not allow"), "float \u{3b1} = 1.0 ; \u{3b1} ;");
    assert_error("a\u{a0}b", "U+00A0");
    assert_error("a\0b", "NUL");
    assert_error("\"text\"", "strings");
    assert_error("08", "octal");
    assert_error("a /* b", "not closed");
    assert_error("#define A /* b\nA", "not closed");
    // A macro's text only matters where it is used.
    assert_tokens("#define A @ 08 \"x\" a##b #c\nx", "x");
    assert_error("#define A 08\nA A A", "octal");
    let (_, messages) = run("#define C(a, b) a##b\nC(x, y)");
    assert!(messages[0].contains("##"), "{messages:?}");
}

#[test]
fn common_and_code_are_one_text() {
    let (tokens, messages) = run_texts(&["#define A 1\n#ifdef B\nno", "no\n#else\nA\n#endif"]);
    assert_eq!((tokens.as_str(), messages.len()), ("1", 0));
    assert_eq!(run_texts(&["#define F(x) x\nF(", "2)"]).0, "2");
    assert_eq!(run_texts(&["", ""]).0, "");
}

#[test]
fn origins_map_back_to_the_text() {
    let text = "#define IN(x) x * k\n#define OUT IN(a)\nOUT + IN(b);";
    let texts = [Text { id: SourceId(0), text }];
    let (mut names, mut report) = (words::interner(), Report::default());
    let done = preprocess(
        &pieces::of(&texts, &[], false),
        (Unit::CommonAlone, Dialect::default(), Cancel::default()),
        Preprocessed::default(),
        &mut names,
        &mut report,
    );
    let spelled = |i: usize| &text[done.origins.tokens[i].spelled.range()];
    let used = |i: usize| &text[done.origins.token_span(crate::ast::TokenId(i as u32)).range()];
    // a * k + b * k ;
    assert_eq!((spelled(0), used(0)), ("a", "OUT"));
    assert_eq!((spelled(2), used(2)), ("k", "OUT"));
    assert_eq!((spelled(4), used(4)), ("b", "b"), "an argument points at itself");
    assert_eq!((spelled(6), used(6)), ("k", "IN(b)"));
    let inner = done.origins.tokens[2].expansion.unwrap();
    let outer = done.origins[inner].parent.unwrap();
    assert_eq!(names.get(done.origins[done.origins[inner].macro_id].name), "IN");
    assert_eq!(names.get(done.origins[done.origins[outer].macro_id].name), "OUT");
    assert_eq!(done.origins[outer].parent, None);
    let uses: Vec<&str> = done.origins.macro_uses.iter().map(|u| &text[u.0.range()]).collect();
    assert_eq!(uses, ["OUT", "IN", "IN"]);
}

#[test]
fn exponential_expansions_are_stopped() {
    let mut doubling = String::from("#define A0 x x\n");
    for i in 1..64 {
        doubling += &format!("#define A{i} A{} A{}\n", i - 1, i - 1);
    }
    assert_eq!(assert_error(&(doubling + "A63"), "2000000"), "");
    let mut calls = String::from("#define F0(x) x, x\n");
    for i in 1..64 {
        calls += &format!("#define F{i}(x) F{}((x)) F{}((x))\n", i - 1, i - 1);
    }
    assert_error(&(calls + "F63(1)"), "2000000");
    let mut empty = String::from("#define A0\n");
    for i in 1..64 {
        empty += &format!("#define A{i} A{} A{}\n", i - 1, i - 1);
    }
    assert_error(&(empty + "A63"), "2000000");
    let nested = |depth| format!("#define F(x) x\n{}1{}", "F(".repeat(depth), ")".repeat(depth));
    assert_tokens(&nested(1000), "1");
    assert_error(&nested(1100), "1024 levels deep");
    assert_error(&nested(100_000), "2000000");
    // A long chain that does not grow exponentially.
    let mut chain = String::from("#define A0 1\n");
    for i in 1..10_000 {
        chain += &format!("#define A{i} A{}\n", i - 1);
    }
    assert_tokens(&(chain + "A9999"), "1");
}
