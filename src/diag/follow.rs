//! A position in a text after the text was edited.

/// Returns the position in `new` of byte `at` of `old`: text before the first difference stays in place, text after the
/// last one moves with it, and a position in between is moved to the edit's end at most. `None` if the text was deleted
/// without a replacement.
pub fn follow(old: &str, new: &str, at: usize) -> Option<usize> {
    let prefix = old.bytes().zip(new.bytes()).take_while(|(a, b)| a == b).count();
    let max = old.len().min(new.len()) - prefix;
    let suffix = old.bytes().rev().zip(new.bytes().rev()).take(max).take_while(|(a, b)| a == b).count();
    let mut found = if at <= prefix {
        at
    } else if at >= old.len() - suffix {
        at + new.len() - old.len()
    } else if new.len() - suffix <= prefix {
        return None;
    } else {
        at.min(new.len() - suffix)
    };
    while !new.is_char_boundary(found) {
        found -= 1;
    }
    Some(found)
}

/// As [`follow`], for a line, both counted from 0: it follows its first non-blank character.
pub fn follow_line(old: &str, new: &str, line: usize) -> Option<usize> {
    let breaks = old.match_indices('\n').map(|(at, _)| at + 1);
    let start = [0].into_iter().chain(breaks).nth(line)?;
    let text = old[start..].split('\n').next().unwrap_or_default();
    let found = follow(old, new, start + text.len() - text.trim_start().len())?;
    Some(new[..found].matches('\n').count())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn position_moves_with_the_text_after_an_edit() {
        assert_eq!(follow("abc def", "abc  def", 5), Some(6));
        assert_eq!(follow("abc def", "abc def, g", 5), Some(5));
        assert_eq!(follow("abc def ghi", "abc X ghi", 8), Some(6));
        assert_eq!(follow("abc def ghi", "abc X ghi", 6), Some(5), "another is there");
        assert_eq!(follow("abc def ghi", "abc ghi", 6), None, "what it was in is gone");
        assert_eq!(follow("aa", "a", 2), Some(1));
        assert_eq!(follow("xé", "xö", 2), Some(1), "never within a letter");
        assert_eq!(follow("", "abc", 0), Some(0));
    }

    #[test]
    fn line_moves_with_its_text_and_is_deleted_with_it() {
        let old = "one\n  two\nthree\n";
        assert_eq!(follow_line(old, "zero\none\n  two\nthree\n", 1), Some(2));
        assert_eq!(follow_line(old, "one\n  two, too\nthree\n", 1), Some(1));
        assert_eq!(follow_line(old, "one\n  two\nthree\nfour", 1), Some(1));
        assert_eq!(follow_line(old, "two\nthree\n", 2), Some(1));
        assert_eq!(follow_line(old, "one\n\nthree\n", 1), None);
        assert_eq!(follow_line(old, old, 9), None);
    }
}
