use super::*;

fn kinds(line: &str, state: LexState) -> Vec<(&str, Class)> {
    let mut at = 0;
    let tokens = lex(line, 0..line.len(), state, &|name| name == "PI");
    let list = tokens
        .into_iter()
        .map(|t| {
            at += t.len;
            (&line[at - t.len..at], t.class)
        })
        .collect();
    assert_eq!(at, line.len(), "tokens cover the line");
    list
}

fn kind_of(line: &str, what: &str) -> Class {
    kinds(line, LexState::default())
        .into_iter()
        .find(|(t, _)| *t == what)
        .unwrap_or_else(|| panic!("{what} in {line}"))
        .1
}

#[test]
fn words_are_classified() {
    let line = "  const vec3 c = mix(iResolution, vec3(PI, .5e-3, 0x1Fu), shade(uv)); // 1.0";
    for (what, kind) in [
        ("const", Class::Keyword),
        ("vec3", Class::Type),
        ("mix", Class::Builtin),
        ("iResolution", Class::Uniform),
        ("PI", Class::Macro),
        (".5e-3", Class::Number),
        ("0x1Fu", Class::Number),
        ("shade", Class::Function),
        ("// 1.0", Class::Comment),
    ] {
        assert_eq!(kind_of(line, what), kind, "{what}");
    }
    assert_eq!(kind_of("a-1", "1"), Class::Number);
    assert_eq!(kind_of("x.y", "y"), Class::Unknown);
    assert_eq!(kind_of("# define  FOO(x) (x*2.)", "FOO"), Class::Macro);
    assert_eq!(kind_of("#ifdef WILD", "#ifdef"), Class::Preprocessor);
}

/// Returns the state at every byte, and the one at the start of the next line.
fn states(line: &str, state: LexState) -> (Vec<(usize, LexState)>, LexState) {
    let mut scanner = Scanner::new(line, 0, state);
    let mut states = Vec::new();
    while !scanner.is_at_end() {
        states.push((scanner.at, scanner.state));
        scanner.step();
    }
    (states, scanner.state.next_line(line))
}

#[test]
fn lexer_and_scanner_agree_on_what_is_comment() {
    let lines = [
        ("float a; /* one", LineContext::BlockComment, false),
        ("still */ float b; // two \\", LineContext::LineComment, false),
        ("comment goes on", LineContext::Indent, false),
        ("float c; /* x */ /* y", LineContext::BlockComment, false),
        ("*/ d // /*", LineContext::Indent, false),
        ("e / f", LineContext::Indent, false),
        ("#define A \\", LineContext::Indent, true),
        ("  b /* c", LineContext::BlockComment, true),
        ("*/ \\", LineContext::Indent, true),
        ("g", LineContext::Indent, false),
        ("ünïcode /*ä*/ ö", LineContext::Indent, false),
        ("/*/", LineContext::BlockComment, false),
        ("*/ # h \\", LineContext::Indent, false),
        ("// *\\", LineContext::LineComment, false),
        ("/* in a line comment", LineContext::Indent, false),
    ];
    let mut state = LexState::default();
    for (line, inside, in_directive) in lines {
        let (states, next) = states(line, state);
        let mut at = 0;
        for (text, kind) in kinds(line, state) {
            for (_, s) in states.iter().filter(|(i, _)| (at + 2..at + text.len()).contains(i)) {
                let is_comment = matches!(s.inside, LineContext::LineComment | LineContext::BlockComment);
                assert_eq!(is_comment, kind == Class::Comment, "{text:?} in {line:?}");
            }
            at += text.len();
        }
        state = next;
        assert_eq!(state, LexState { inside, in_directive }, "after {line:?}");
    }
}

#[test]
fn part_of_a_line_is_lexed_as_in_the_whole_line() {
    let line = "  a /* b c */ shade   (1.5e-3) #x // d e";
    let (states, _) = states(line, LexState::default());
    let whole = lex(line, 0..line.len(), LexState::default(), &|_| false);
    for (at, state) in states.into_iter().filter(|(at, _)| *at == 0 || line.as_bytes()[at - 1] == b' ') {
        let mut parts = lex(line, 0..at, LexState::default(), &|_| false);
        for token in lex(line, at..line.len(), state, &|_| false) {
            match parts.last_mut() {
                Some(last) if last.class == token.class => last.len += token.len,
                _ => parts.push(token),
            }
        }
        assert_eq!(parts, whole, "cut at {at}");
    }
}

/// Predefined words are the compiler's: an editor has no list of its own.
#[test]
fn every_word_of_the_language_has_a_class() {
    for word in crate::lex::words::keywords() {
        assert_eq!(kind_of(word, word), Class::Keyword, "{word}");
    }
    for builtin in crate::hir::Builtin::all().filter(|builtin| builtin.since == 0) {
        assert_eq!(kind_of(builtin.name, builtin.name), Class::Builtin, "{}", builtin.name);
    }
    // One of them is a member of a struct.
    for uniform in crate::hir::Uniform::ALL.iter().filter(|u| !u.name().contains('.')) {
        assert_eq!(kind_of(uniform.name(), uniform.name()), Class::Uniform, "{}", uniform.name());
    }
    for word in ["iModel", "iProjection", "iNormalMatrix", "iSampleOffset", "gl_FragDepth", "mainSound"] {
        assert_eq!(kind_of(word, word), Class::Uniform, "{word}");
    }
    assert_eq!(kind_of("mat2x2", "mat2x2"), Class::Type);
    assert_eq!(kind_of("double", "double"), Class::Keyword, "a reserved word is no name");
}

#[test]
fn macro_names_are_found() {
    assert_eq!(defined_name("  #  define   R  iResolution"), Some("R"));
    assert_eq!(defined_name("#define F(x) x"), Some("F"));
    assert_eq!(defined_name("#definex F"), None);
    assert_eq!(defined_name("#undef F"), None);
}
