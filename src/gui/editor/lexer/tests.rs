use super::*;

fn kinds(line: &str, state: LexState) -> Vec<(&str, TokenKind)> {
    let mut at = 0;
    let tokens = lex(line, 0..line.len(), state, &|name| name == "PI");
    let list = tokens
        .into_iter()
        .map(|t| {
            at += t.len;
            (&line[at - t.len..at], t.kind)
        })
        .collect();
    assert_eq!(at, line.len(), "tokens cover the line");
    list
}

fn kind_of(line: &str, what: &str) -> TokenKind {
    kinds(line, LexState::default())
        .into_iter()
        .find(|(t, _)| *t == what)
        .unwrap_or_else(|| panic!("{what} in {line}"))
        .1
}

#[test]
fn words_have_their_kinds() {
    let line = "  const vec3 c = mix(iResolution, vec3(PI, .5e-3, 0x1Fu), shade(uv)); // 1.0";
    for (what, kind) in [
        ("const", TokenKind::Keyword),
        ("vec3", TokenKind::Type),
        ("mix", TokenKind::Builtin),
        ("iResolution", TokenKind::Uniform),
        ("PI", TokenKind::Macro),
        (".5e-3", TokenKind::Number),
        ("0x1Fu", TokenKind::Number),
        ("shade", TokenKind::Function),
        ("// 1.0", TokenKind::Comment),
    ] {
        assert_eq!(kind_of(line, what), kind, "{what}");
    }
    assert_eq!(kind_of("a-1", "1"), TokenKind::Number);
    assert_eq!(kind_of("x.y", "y"), TokenKind::Plain);
    assert_eq!(kind_of("# define  FOO(x) (x*2.)", "FOO"), TokenKind::Macro);
    assert_eq!(kind_of("#ifdef WILD", "#ifdef"), TokenKind::Directive);
}

/// The state at every byte, and the one the next line begins in.
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
        ("float a; /* one", Inside::BlockComment, false),
        ("still */ float b; // two \\", Inside::LineComment, false),
        ("comment goes on", Inside::Indent, false),
        ("float c; /* x */ /* y", Inside::BlockComment, false),
        ("*/ d // /*", Inside::Indent, false),
        ("e / f", Inside::Indent, false),
        ("#define A \\", Inside::Indent, true),
        ("  b /* c", Inside::BlockComment, true),
        ("*/ \\", Inside::Indent, true),
        ("g", Inside::Indent, false),
        ("ünïcode /*ä*/ ö", Inside::Indent, false),
        ("/*/", Inside::BlockComment, false),
        ("*/ # h \\", Inside::Indent, false),
        ("// *\\", Inside::LineComment, false),
        ("/* in a line comment", Inside::Indent, false),
    ];
    let mut state = LexState::default();
    for (line, inside, in_directive) in lines {
        let (states, next) = states(line, state);
        let mut at = 0;
        for (text, kind) in kinds(line, state) {
            for (_, s) in states.iter().filter(|(i, _)| (at + 2..at + text.len()).contains(i)) {
                let is_comment = matches!(s.inside, Inside::LineComment | Inside::BlockComment);
                assert_eq!(is_comment, kind == TokenKind::Comment, "{text:?} in {line:?}");
            }
            at += text.len();
        }
        state = next;
        assert_eq!(state, LexState { inside, in_directive }, "after {line:?}");
    }
}

#[test]
fn a_part_of_a_line_is_lexed_as_in_the_whole() {
    let line = "  a /* b c */ shade   (1.5e-3) #x // d e";
    let (states, _) = states(line, LexState::default());
    let whole = lex(line, 0..line.len(), LexState::default(), &|_| false);
    for (at, state) in states.into_iter().filter(|(at, _)| *at == 0 || line.as_bytes()[at - 1] == b' ') {
        let mut parts = lex(line, 0..at, LexState::default(), &|_| false);
        for token in lex(line, at..line.len(), state, &|_| false) {
            match parts.last_mut() {
                Some(last) if last.kind == token.kind => last.len += token.len,
                _ => parts.push(token),
            }
        }
        assert_eq!(parts, whole, "cut at {at}");
    }
}

#[test]
fn macro_names_are_found() {
    assert_eq!(defined_name("  #  define   R  iResolution"), Some("R"));
    assert_eq!(defined_name("#define F(x) x"), Some("F"));
    assert_eq!(defined_name("#definex F"), None);
    assert_eq!(defined_name("#undef F"), None);
}
