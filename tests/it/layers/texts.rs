//! The texts that users read: those of the window, the output and help of the command line, and diagnostics.
//!
//! `scripts/list-texts FILE` writes them all into one file, for reviewing the wording.

use super::{source_texts, sources_of_eddy};
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use std::path::PathBuf;

/// A text and its line.
#[derive(Debug, PartialEq, Eq)]
struct Text {
    line: usize,
    text: String,
}

/// Macros whose texts only programmers see.
const UNSEEN: &[&str] = &[
    "assert",
    "assert_eq",
    "assert_ne",
    "debug",
    "debug_assert",
    "debug_assert_eq",
    "debug_assert_ne",
    "env",
    "include_bytes",
    "include_dir",
    "include_str",
    "matches",
    "panic",
    "todo",
    "trace",
    "unimplemented",
    "unreachable",
    "wgsl",
];

/// Methods that take a name for debugging, or the reason why an error is impossible.
const UNSEEN_METHODS: &[&str] = &["expect", "expect_err", "id_salt", "make_persistent_id"];

/// Places whose texts are for contributors: internal errors, and tests.
const UNREAD: &[&str] = &["glsl/emit/", "glsl/ir/", "glsl/opt/", "gui/editor/cost.rs", "gui/frame/", "lab/reference/"];

/// Returns the texts of a file; `has_help` says that its doc comments are the command line's help.
fn texts_of(stream: TokenStream, has_help: bool) -> Vec<Text> {
    let mut found = Vec::new();
    read(stream, has_help, &mut found);
    found
}

fn read(stream: TokenStream, has_help: bool, found: &mut Vec<Text>) {
    let trees: Vec<TokenTree> = stream.into_iter().collect();
    let word = |n: usize| match trees.get(n) {
        Some(TokenTree::Ident(word)) => word.to_string(),
        _ => String::new(),
    };
    let is_sign = |n: usize, sign: char| matches!(trees.get(n), Some(TokenTree::Punct(p)) if p.as_char() == sign);
    // The line after that of the last doc comment: a comment on it continues the same paragraph.
    let mut next_line = 0;
    let mut n = 0;
    while n < trees.len() {
        match &trees[n] {
            TokenTree::Punct(sign) if sign.as_char() == '#' => {
                let inner = usize::from(is_sign(n + 1, '!'));
                let Some(TokenTree::Group(group)) = trees.get(n + 1 + inner) else {
                    n += 1;
                    continue;
                };
                n += 2 + inner;
                if is_for_tests(group) {
                    // Skip the item's body, or the semicolon after its name.
                    while n < trees.len() && !is_sign(n, ';') && !is_braced(&trees[n]) {
                        n += 1;
                    }
                    n += 1;
                    continue;
                }
                let line = group.span_open().start().line;
                if has_help
                    && inner == 0
                    && !is_of_code(&trees[n..])
                    && let Some(doc) = doc_of(group)
                {
                    match found.last_mut().filter(|_| next_line == line && !doc.is_empty()) {
                        Some(last) => last.text = format!("{} {doc}", last.text),
                        None => found.push(Text { line, text: doc }),
                    }
                    next_line = line + 1;
                } else if attribute(group).is_some_and(|name| ["error", "arg", "command"].contains(&name.as_str())) {
                    read(group.stream(), has_help, found);
                }
                continue;
            }
            TokenTree::Ident(name) => {
                let name = name.to_string();
                let is_macro = is_sign(n + 1, '!') && matches!(trees.get(n + 2), Some(TokenTree::Group(_)));
                if is_macro && UNSEEN.contains(&name.as_str()) {
                    n += 3;
                    continue;
                }
                if n > 0 && is_sign(n - 1, '.') && UNSEEN_METHODS.contains(&name.as_str()) {
                    n += 2;
                    continue;
                }
            }
            TokenTree::Group(group) => read(group.stream(), has_help, found),
            TokenTree::Literal(literal) => {
                // An attribute-like `label: Some("...")` names an object of the device.
                let is_label = n > 1 && is_sign(n - 1, ':') && word(n - 2) == "label";
                if !is_label && let Ok(text) = syn::parse_str::<syn::LitStr>(&literal.to_string()) {
                    found.push(Text { line: literal.span().start().line, text: text.value() });
                }
            }
            TokenTree::Punct(_) => {}
        }
        n += 1;
    }
}

fn is_braced(tree: &TokenTree) -> bool {
    matches!(tree, TokenTree::Group(group) if group.delimiter() == Delimiter::Brace)
}

/// Returns whether attributes belong to a function or a constant, whose documentation is not help for the command
/// line.
fn is_of_code(rest: &[TokenTree]) -> bool {
    let first = rest.iter().find_map(|tree| match tree {
        TokenTree::Ident(word) if word != "pub" => Some(word.to_string()),
        _ => None,
    });
    first.is_some_and(|word| ["fn", "const", "impl", "mod", "type", "use"].contains(&word.as_str()))
}

fn attribute(group: &Group) -> Option<String> {
    match group.stream().into_iter().next() {
        Some(TokenTree::Ident(name)) => Some(name.to_string()),
        _ => None,
    }
}

fn is_for_tests(group: &Group) -> bool {
    group.stream().to_string().replace(' ', "") == "cfg(test)"
}

/// Returns the text of a doc comment, which the parser reads as an attribute.
fn doc_of(group: &Group) -> Option<String> {
    let mut trees = group.stream().into_iter();
    let (Some(TokenTree::Ident(name)), _, Some(TokenTree::Literal(text))) = (trees.next(), trees.next(), trees.next())
    else {
        return None;
    };
    (name == "doc").then(|| syn::parse_str::<syn::LitStr>(&text.to_string()).ok())?.map(|t| t.value().trim().to_owned())
}

/// Returns whether a text may be prose: names of keys and files are single words of small letters and signs.
fn is_words(text: &str) -> bool {
    let mut letters = text.chars().filter(|c| c.is_alphabetic());
    let is_long = letters.by_ref().take(3).count() == 3;
    let is_capital = text.starts_with(|c: char| c.is_uppercase()) && !text.contains('_');
    is_long && (text.trim().contains(' ') || is_capital)
}

/// Returns all texts that users may read, by file; paths are relative to `src/`.
fn all_texts() -> Vec<(String, Vec<Text>)> {
    let files = source_texts(&sources_of_eddy());
    let read = files.into_iter().filter(|(path, _)| {
        let is_test = path.contains("/tests/") || path.ends_with("tests.rs");
        !is_test && !UNREAD.iter().any(|folder| path.starts_with(folder))
    });
    let mut all: Vec<_> = read
        .map(|(path, text)| {
            let stream: TokenStream = text.parse().unwrap_or_else(|error| panic!("src/{path}: {error}"));
            let mut texts = texts_of(stream, path.starts_with("cli/args/"));
            texts.retain(|text| is_words(&text.text));
            (path, texts)
        })
        .collect();
    all.sort_by(|a, b| a.0.cmp(&b.0));
    all
}

/// Phrases to avoid, and what to write instead. They are matched as whole words, in any case.
const PHRASES: &[(&str, &str)] = &[
    ("anew", "again, or restart"),
    ("any more", "no longer, or leave it out"),
    ("as large as", "the size of"),
    ("at first", "default, or initial"),
    ("begin of", "start of"),
    ("behind", "after"),
    ("beside it", "next to it"),
    ("called so", "of this name"),
    ("canvas", "picture, or resolution"),
    ("counts for nothing", "is ignored"),
    ("held against", "compared with"),
    ("is so", "say what"),
    ("known are", "the values are"),
    ("lies in", "is in"),
    ("lies outside", "is outside"),
    ("mend", "fix"),
    ("nobody", "say what is missing"),
    ("or no longer", "Toggle ..."),
    ("so many", "this number of"),
    ("stands", "is, or comes"),
    ("the begin", "the start"),
    ("the file of", "the ... file"),
    ("the most that", "the limit"),
    ("the site", "Shadertoy"),
    ("the walker", "the CPU"),
    ("the way of", "name the thing"),
    ("unasked", "asks before"),
];

/// Returns the words of a text in lower case. A sign between two words is a word, so that no phrase spans it, and so
/// is a placeholder for a formatted value.
fn words(text: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut is_placeholder = false;
    for c in text.chars() {
        is_placeholder = c == '{' || is_placeholder && c != '}';
        if is_placeholder {
            words.push("{}".into());
        } else if c.is_alphanumeric() || c == '\'' || c == '_' {
            let last = words.last_mut().filter(|word| word.chars().all(|c| c.is_alphanumeric() || "'_".contains(c)));
            match last {
                Some(word) => word.extend(c.to_lowercase()),
                None => words.push(c.to_lowercase().collect()),
            }
        } else if c.is_whitespace() {
            words.push(String::new());
        } else {
            words.push(c.to_string());
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Returns the phrases to avoid in a text, with replacements.
fn violations(text: &str) -> Vec<String> {
    let words = words(text);
    let mut found = Vec::new();
    let has =
        |at: usize, phrase: &str| phrase.split(' ').enumerate().all(|(i, w)| words.get(at + i).is_some_and(|x| x == w));
    for at in 0..words.len() {
        for (phrase, instead) in PHRASES.iter().filter(|(phrase, _)| has(at, phrase)) {
            found.push(format!("\"{phrase}\": write {instead}"));
        }
        // "It is no picture" should be "it is not a picture"; "there is no picture" is normal.
        let is_be = ["is", "are", "was", "were"].contains(&words[at].as_str());
        let is_there = at > 0 && words[at - 1] == "there";
        let next_word = words.get(at + 2).map(String::as_str);
        if is_be && !is_there && has(at + 1, "no") && next_word.is_some_and(|w| !["longer", "more"].contains(&w)) {
            found.push(format!("\"{} no {}\": write \"{0} not a\"", words[at], next_word.unwrap_or_default()));
        }
    }
    if let [.., or, not] = &words[..]
        && (or.as_str(), not.as_str()) == ("or", "not")
    {
        found.push("\"or not\" at the end: write Toggle ...".into());
    }
    // "The breakpoint before", "the letter behind": write "the previous breakpoint".
    if let [.., the, _, last] = &words[..]
        && ["the", "a"].contains(&the.as_str())
        && ["before", "after"].contains(&last.as_str())
    {
        found.push(format!("\"the ... {last}\" at the end: write previous or next"));
    }
    found
}

#[test]
fn texts_follow_the_style_rules() {
    let all = all_texts();
    let count: usize = all.iter().map(|(_, texts)| texts.len()).sum();
    assert!(count > 3000, "only {count} texts were read");
    let read = all.iter().filter(|(path, _)| !path.starts_with("lab/"));
    let found: Vec<String> = read
        .flat_map(|(path, texts)| texts.iter().map(move |text| (path, text)))
        .flat_map(|(path, text)| {
            violations(&text.text)
                .into_iter()
                .map(move |what| format!("src/{path}:{}: {what}: {}", text.line, text.text))
        })
        .collect();
    assert!(found.is_empty(), "{} texts; CONTRIBUTING.md says how we write them:\n{}", found.len(), found.join("\n"));
}

#[test]
fn planted_violations_of_style_are_caught() {
    let caught = [
        "Draw it anew",
        "Frames are not drawn unasked",
        "Nothing is called so.",
        "Wrap long lines, or not",
        "Reset on reload, or no longer",
        "nobody sets `x`: it is zero",
        "The file of settings",
        "Panel: the way of a pixel",
        "As large as the view, times",
        "Go to the begin",
        "`a` is no array",
        "these are no numbers",
        "a `;` is missing behind `b`",
        "Back to the breakpoint before",
        "On the site, a buffer",
        "Pixels of the canvas",
    ];
    for text in caught {
        assert_eq!(violations(text).len(), 1, "{text}: {:?}", violations(text));
    }
    for text in [
        "There is no array here",
        "it is no longer drawn",
        "is it? No, not",
        "Toggle word wrap",
        "the line was not reached before",
        "amend, understand, behindhand",
    ] {
        assert_eq!(violations(text), [""; 0], "{text}");
    }
}

#[test]
fn texts_are_read_from_code_help_and_errors_and_not_from_tests() {
    let read = |text: &str, has_help| -> Vec<String> {
        texts_of(text.parse().unwrap(), has_help).into_iter().map(|text| text.text).collect()
    };
    assert_eq!(read("fn f() { g(\"A b\", format!(\"c {x} d\")) }", false), ["A b", "c {x} d"]);
    assert_eq!(read("#[error(\"no {0}\")] struct E;", false), ["no {0}"]);
    assert_eq!(read("#[cfg(test)] mod tests { fn f() { g(\"A\") } } const B: &str = \"B\";", false), ["B"]);
    assert_eq!(read("#[cfg(test)]\nmod tests;\nconst B: &str = \"B\";", false), ["B"]);
    assert_eq!(read("fn f() { assert!(a, \"A\"); b.expect(\"B\"); panic!(\"C\"); d(\"D\") }", false), ["D"]);
    let help = "/// One,\n/// two\npub a: u8,\n/// Three\n#[arg(help = \"Four\")]\npub b: u8";
    assert_eq!(read(help, true), ["One, two", "Three", "Four"]);
    assert_eq!(read(help, false), ["Four"]);
    assert_eq!(read("/// One\npub fn f() {}\n/// Two\n#[arg(long)]\npub b: u8", true), ["Two"]);
}

/// `TEXTS=FILE cargo test --test it texts_as_a_list -- --ignored` writes the file; `scripts/list-texts FILE` runs
/// that.
#[test]
#[ignore = "writes a file"]
fn texts_as_a_list() {
    let into = PathBuf::from(std::env::var_os("TEXTS").expect("TEXTS names the file to write"));
    let mut list = String::new();
    for (path, texts) in all_texts() {
        if !texts.is_empty() {
            list += &format!("\n== {path}\n");
        }
        for text in texts {
            list += &format!("{}: {}\n", text.line, text.text.replace('\n', "\\n"));
        }
    }
    std::fs::write(&into, list).unwrap();
}
