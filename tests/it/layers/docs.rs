//! Doc sentences: none is a clause without a subject, such as "Whether it is long."

use super::{source_texts, sources_of_eddy};

/// First words of such clauses.
const HEADLESS: &[&str] = &["Whether", "What", "Of", "Where", "Which", "How", "Why", "Who", "When"];

/// The help of the command line is in these files: it says what an option takes.
const HELP: &str = "cli/args/";

/// Returns the places where a paragraph of documentation starts with such a word; `path` is relative to `src/`.
fn headless(path: &str, text: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut is_inside = false;
    for (n, line) in text.lines().enumerate() {
        let line = line.trim_start();
        let doc = ["///", "//!"].iter().find_map(|mark| line.strip_prefix(mark)).filter(|doc| !doc.starts_with('/'));
        let first = doc.and_then(|doc| doc.split_whitespace().next());
        if let Some(word) = first.filter(|_| !is_inside)
            && HEADLESS.contains(&word.trim_end_matches([',', ':']))
        {
            found.push(format!("src/{path}:{}: a doc sentence begins with `{word}`", n + 1));
        }
        is_inside = first.is_some();
    }
    found
}

#[test]
fn doc_sentences_have_a_subject() {
    let texts = source_texts(&sources_of_eddy());
    let documented = texts.iter().filter(|(path, _)| !path.starts_with(HELP));
    let found: Vec<String> = documented.flat_map(|(path, text)| headless(path, text)).collect();
    assert!(found.is_empty(), "{} sentences:\n{}", found.len(), found.join("\n"));
}

#[test]
fn planted_headless_sentences_are_caught() {
    let place = |line| vec![format!("src/glsl/a.rs:{line}: a doc sentence begins with `Whether`")];
    let none = Vec::<String>::new();
    for (text, found) in [
        ("/// Whether it is long.\nfn a() {}", place(1)),
        ("//! A module.\n//!\n//! Whether it is long.", place(3)),
        (
            "mod a {\n    /// Whether: the answer.\n}",
            vec!["src/glsl/a.rs:2: a doc sentence begins with `Whether:`".into()],
        ),
        ("/// Returns this.\n/// Whether it goes on is no matter.", none.clone()),
        ("// Whether a comment does.\n//// Whether a rule does.", none.clone()),
        ("/// Whethers are nouns.", none),
    ] {
        assert_eq!(headless("glsl/a.rs", text), found, "{text}");
    }
}
