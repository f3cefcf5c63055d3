//! Words of a private dialect in names and comments. Their counts may only fall: removing one lowers its number
//! here, and a new one is an error. `docs/` and the texts that users read have their own rules (`texts`, `pages`).

use super::{source_texts, sources_of_eddy};
use proc_macro2::{TokenStream, TokenTree};
use std::{collections::BTreeMap, path::Path};

/// Each word with what a colleague would write instead, and how often it is left.
const WORDS: &[(&str, &str, usize)] = &[
    ("anew", "again, rebuild, restart", 0),
    ("begin", "start", 5),
    ("begun", "started", 4),
    ("behind", "after, in the background", 33),
    ("mend", "fix, hint", 0),
    ("nobody", "no one reads it, unused", 0),
    ("somebody", "a caller, a panel", 0),
    ("stands", "is, appears", 0),
    ("whoever", "the caller", 0),
];

/// Files that name these words: the rules about words.
const RULES: &[&str] = &["it/layers/words.rs", "it/layers/texts.rs"];

/// Returns the words of a name: `BeginFrame`, `begin_frame` and `BEGIN_FRAME` have two.
fn parts(name: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let mut was_lower = false;
    for c in name.chars() {
        if c == '_' || (c.is_uppercase() && was_lower) {
            parts.push(String::new());
        }
        was_lower = c.is_lowercase() || c.is_ascii_digit();
        if c != '_' {
            parts.last_mut().unwrap().extend(c.to_lowercase());
        }
    }
    parts
}

/// Adds the words of all names that a text declares or uses. Texts and doc comments are not names.
fn names(stream: TokenStream, add: &mut impl FnMut(&str)) {
    for tree in stream {
        match tree {
            TokenTree::Ident(name) => parts(&name.to_string()).iter().for_each(|part| add(part)),
            TokenTree::Group(group) => names(group.stream(), add),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

/// Adds the words of the comments that are alone in their line.
fn comments(text: &str, add: &mut impl FnMut(&str)) {
    let lines = text.lines().map(str::trim_start).filter(|line| line.starts_with("//"));
    lines.flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && c != '_')).for_each(|word| {
        // A name in a comment is counted where it is declared.
        if !word.contains('_') {
            add(&word.to_lowercase());
        }
    });
}

fn counts(texts: &[(String, String)]) -> BTreeMap<&'static str, usize> {
    let mut counts: BTreeMap<&'static str, usize> = WORDS.iter().map(|(word, ..)| (*word, 0)).collect();
    for (path, text) in texts.iter().filter(|(path, _)| !RULES.contains(&path.as_str())) {
        let mut add = |word: &str| {
            if let Some((known, ..)) = WORDS.iter().find(|(known, ..)| *known == word) {
                *counts.entry(known).or_default() += 1;
            }
        };
        comments(text, &mut add);
        names(text.parse().unwrap_or_else(|e| panic!("{path}: {e}")), &mut add);
    }
    counts
}

#[test]
fn dialect_words_in_names_and_comments_become_fewer() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let mut texts = source_texts(&sources_of_eddy());
    texts.extend(source_texts(&tests));
    let counts = counts(&texts);
    let mut wrong = Vec::new();
    for (word, instead, most) in WORDS {
        match counts[word] {
            count if count > *most => {
                wrong.push(format!("`{word}` occurs {count} times, {most} allowed: write {instead}"))
            }
            count if count < *most => {
                wrong.push(format!("`{word}` occurs {count} times: lower its number from {most}"))
            }
            _ => {}
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn planted_dialect_words_are_counted_in_names_and_comments() {
    let text =
        "/// Begins, behind the other. begin_frame\nfn begin_frame(MEND: BeginOf) { let x = \"anew\"; } // stands\n";
    let counts = counts(&[("a.rs".into(), text.into())]);
    assert_eq!([counts["begin"], counts["behind"], counts["mend"]], [2, 1, 1]);
    assert_eq!([counts["anew"], counts["stands"]], [0, 0], "texts, and comments after code");
    assert_eq!(parts("begin_frame2"), ["begin", "frame2"]);
    assert_eq!(parts("BeginFrame"), ["begin", "frame"]);
}
