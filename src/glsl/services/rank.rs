//! Ranks of names by the letters typed so far.

/// Returns how badly a name matches; smaller is better, `None` is no match. Letters must occur in order and the first
/// one must start a word of the name, so that `sms` finds `smoothstep` and `step` does too.
pub(super) fn misfit(typed: &str, name: &str) -> Option<u32> {
    if name.starts_with(typed) {
        return Some(0);
    }
    let same = |a: char, b: char| a.eq_ignore_ascii_case(&b);
    let has_prefix = |name: &str| {
        let mut letters = name.chars();
        typed.chars().all(|t| letters.next().is_some_and(|n| same(t, n)))
    };
    if has_prefix(name) {
        return Some(1);
    }
    let inner = name.char_indices().skip(1).find(|&(i, _)| has_prefix(&name[i..]));
    let first = typed.chars().next()?;
    if let Some((at, _)) = inner {
        return Some(if starts_word(name, at) { 2 } else { 4 });
    }
    // In order, with gaps, starting at the first letter.
    let mut rest = name.chars();
    let starts = rest.next().is_some_and(|n| same(first, n));
    let follows = starts && typed.chars().skip(1).all(|t| rest.any(|n| same(t, n)));
    follows.then_some(3)
}

/// Returns whether a word of a name starts here: a capital after a small letter, or a letter after `_` or a digit.
fn starts_word(name: &str, at: usize) -> bool {
    let before = name[..at].chars().next_back().unwrap_or(' ');
    let here = name[at..].chars().next().unwrap_or(' ');
    before == '_' || before.is_ascii_digit() || (before.is_lowercase() && here.is_uppercase())
}

#[cfg(test)]
mod tests {
    use super::misfit;

    #[test]
    fn better_matches_come_first() {
        let fits: Vec<u32> = [
            ("smooth", "smoothstep"),
            ("Smo", "smoothstep"),
            ("Step", "smoothStep"),
            ("sms", "smoothstep"),
            ("step", "smoothstep"),
        ]
        .iter()
        .map(|(typed, name)| misfit(typed, name).unwrap())
        .collect();
        assert_eq!(fits, [0, 1, 2, 3, 4]);
        for (typed, name) in
            [("sx", "smoothstep"), ("ms", "smoothstepx".trim_end_matches('x')), ("normalizes", "normalize")]
        {
            assert_eq!(misfit(typed, name), None, "{typed} {name}");
        }
        assert_eq!(misfit("", "x"), Some(0));
    }
}
