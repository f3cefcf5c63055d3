//! Finds words in the text of a shader without parsing its language.

use std::collections::HashSet;

/// Returns whether a text contains a word outside comments.
pub fn names_word(text: &str, name: &str) -> bool {
    find_word(text, name).is_some()
}

/// Returns the first offset of a word outside comments.
pub(crate) fn find_word(text: &str, word: &str) -> Option<usize> {
    let is_letter = |byte: Option<&u8>| byte.is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_');
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &text.as_bytes()[at..];
        if rest.starts_with(b"//") {
            at += rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
        } else if rest.starts_with(b"/*") {
            at += rest.windows(2).skip(2).position(|two| two == b"*/").map_or(rest.len(), |end| end + 4);
        } else {
            let is_whole = rest.starts_with(word.as_bytes())
                && !is_letter(at.checked_sub(1).and_then(|i| bytes.get(i)))
                && !is_letter(rest.get(word.len()));
            if is_whole {
                return Some(at);
            }
            at += 1;
        }
    }
    None
}

/// Returns every word of a text outside comments: letters, digits and `_`.
pub(crate) fn all_words(text: &str) -> HashSet<&str> {
    let bytes = text.as_bytes();
    let is_letter = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    let mut found = HashSet::new();
    let mut at = 0;
    while at < bytes.len() {
        let rest = &bytes[at..];
        at += if rest.starts_with(b"//") {
            memchr::memchr(b'\n', rest).unwrap_or(rest.len())
        } else if rest.starts_with(b"/*") {
            memchr::memmem::find(&rest[2..], b"*/").map_or(rest.len(), |end| end + 4)
        } else {
            let length = rest.iter().position(|byte| !is_letter(byte)).unwrap_or(rest.len());
            if length > 0 {
                // Both ends are next to ASCII characters, or are the ends of the text.
                found.extend(text.get(at..at + length));
            }
            length.max(1)
        };
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_words_outside_comments_are_found() {
        for (text, at) in [
            ("main", Some(0)),
            ("void main()", Some(5)),
            ("mainImage domain main_ _main main2", None),
            ("// main\nmain", Some(8)),
            ("/* main */ main", Some(11)),
            ("/*/ main */ main", Some(12)),
            ("/* main", None),
            ("// main", None),
            ("a/main", Some(2)),
        ] {
            assert_eq!(find_word(text, "main"), at, "{text}");
            assert_eq!(all_words(text).contains("main"), at.is_some(), "{text}");
        }
    }
}
