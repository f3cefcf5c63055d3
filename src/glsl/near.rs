//! "Did you mean": the known identifier that is nearest to an unknown one.

/// The number of characters and distance cells that one compile may process to find nearest names, for all its unknown
/// names together: some tens of milliseconds. Names after that are reported without a suggestion.
pub(super) const BUDGET: u64 = 8_000_000;

/// The work that is left for suggestions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Budget {
    left: u64,
}

impl Default for Budget {
    fn default() -> Self {
        Self { left: BUDGET }
    }
}

impl Budget {
    /// Takes work from the budget. Returns false if less than that is left; the budget is then empty.
    fn take(&mut self, work: usize) -> bool {
        let left = self.left.checked_sub(work as u64);
        self.left = left.unwrap_or(0);
        left.is_some()
    }

    /// Returns the amount of work used.
    #[cfg(test)]
    pub(crate) fn used(&self) -> u64 {
        BUDGET - self.left
    }
}

/// Returns the candidate that `word` is most likely a misspelling of: few characters changed, added, left out or
/// swapped (the optimal string alignment distance). Case counts, unless nothing else differs. `None` if no candidate is
/// near enough to suggest. For names of files and settings see `project::nearest`, which ignores case, `-`, `_` and
/// spaces.
pub(super) fn nearest_identifier<'c>(word: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    nearest_within(&mut Budget::default(), word, candidates)
}

/// As [`nearest_identifier`], with the rest of a budget. Candidates after its end are ignored.
pub(super) fn nearest_within<'c>(
    budget: &mut Budget,
    word: &str,
    candidates: impl IntoIterator<Item = &'c str>,
) -> Option<&'c str> {
    // One error is allowed in a short word, two in a long one. A word of two characters may lack a third; any other two
    // are a different name.
    let letters: Vec<char> = word.chars().collect();
    let is_pair = letters.len() == 2;
    let allowed = match letters.len() {
        0..=1 => return None,
        2..=5 => 1,
        6..=10 => 2,
        _ => 3,
    };
    let mask = letter_mask(word);
    let mut other: Vec<char> = Vec::new();
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        if !budget.take(1) {
            break;
        }
        // Characters take up to four bytes in UTF-8; `distance` counts characters, and this only bounds their number.
        if candidate.len() > 4 * (letters.len() + allowed) || 4 * candidate.len() + 4 * allowed < letters.len() {
            continue;
        }
        if is_pair && candidate.len() <= word.len() && !candidate.eq_ignore_ascii_case(word) {
            continue;
        }
        if !budget.take(candidate.len()) {
            break;
        }
        if candidate == word {
            continue;
        }
        // Case is ignored if nothing else differs.
        let found = if candidate.eq_ignore_ascii_case(word) {
            Some(0)
        } else if (letter_mask(candidate) ^ mask).count_ones() as usize > 2 * allowed {
            // An edit removes at most one kind of character and adds at most one.
            None
        } else {
            other.clear();
            other.extend(candidate.chars());
            if !budget.take(letters.len() * (2 * allowed + 1)) {
                break;
            }
            distance(&letters, &other, allowed)
        };
        if let Some(found) = found
            && best.is_none_or(|(best, _)| found < best)
        {
            best = Some((found, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Returns the set of characters in a word as a bit mask.
fn letter_mask(word: &str) -> u64 {
    word.bytes().fold(0, |mask, byte| if byte.is_ascii() { mask | 1 << (byte & 63) } else { mask })
}

/// Returns the optimal string alignment distance (Boytsov 2011, "Indexing methods for approximate dictionary
/// searching", section 2.1) of two words, or `None` where it is larger than `most`. Only the cells within `most` of the
/// diagonal are computed, as Ukkonen (1985, "Algorithms for approximate string matching") does.
fn distance(a: &[char], b: &[char], max: usize) -> Option<usize> {
    /// Cells of a row: `most` is at most 3.
    const BAND: usize = 7;
    debug_assert!(2 * max < BAND);
    if a.len().abs_diff(b.len()) > max {
        return None;
    }
    let far = max + 1;
    // Cell `k` of row `i` is the distance between the first `i` characters of `a` and the first `i + k - most` of `b`.
    let (mut before, mut last, mut row) = ([far; BAND], [far; BAND], [far; BAND]);
    for i in 0..=a.len() {
        for k in 0..=2 * max {
            row[k] = far;
            let Some(j) = (i + k).checked_sub(max).filter(|j| *j <= b.len()) else { continue };
            if i == 0 || j == 0 {
                row[k] = (i + j).min(far);
                continue;
            }
            // In the previous row the same position in `b` is one cell to the right.
            let above = if k < 2 * max { last[k + 1] } else { far };
            let left = if k > 0 { row[k - 1] } else { far };
            let mut cell = (last[k] + usize::from(a[i - 1] != b[j - 1])).min(above + 1).min(left + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                cell = cell.min(before[k] + 1);
            }
            row[k] = cell.min(far);
        }
        if row[..=2 * max].iter().all(|cell| *cell == far) {
            return None;
        }
        (before, last) = (last, row);
    }
    Some(last[max + b.len() - a.len()]).filter(|distance| *distance <= max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_likely_misspellings_are_suggested() {
        let words = ["normalize", "smoothstep", "mix", "return"];
        assert_eq!(nearest_identifier("normalise", words), Some("normalize"));
        assert_eq!(nearest_identifier("smoothStep", words), Some("smoothstep"));
        assert_eq!(nearest_identifier("retrun", words), Some("return"));
        assert_eq!(nearest_identifier("mxi", words), Some("mix"));
        assert_eq!(nearest_identifier("banana", words), None);
        assert_eq!(nearest_identifier("x", words), None);
        assert_eq!(nearest_identifier("mx", words), Some("mix"));
        assert_eq!(nearest_identifier("uV", ["uw", "vu", "uv"]), Some("uv"));
        assert_eq!(nearest_identifier("ua", ["uw", "au", "uv"]), None);
    }

    #[test]
    fn bounded_distance_equals_the_full_distance() {
        let mut state = 1u32;
        let mut random = |below: u32| {
            state = state.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (state >> 16) % below
        };
        for _ in 0..20_000 {
            let mut word = || -> String {
                let length = random(9);
                (0..length).map(|_| ['a', 'b', 'c', 'é'][random(4) as usize]).collect()
            };
            let (a, b) = (word(), word());
            let full = strsim::osa_distance(&a, &b);
            let chars = |word: &str| word.chars().collect::<Vec<_>>();
            for max in 1..=3 {
                assert_eq!(distance(&chars(&a), &chars(&b), max), (full <= max).then_some(full), "{a} {b} {max}");
            }
        }
    }

    #[test]
    fn work_never_exceeds_the_budget() {
        let names: Vec<String> = (0..5_000).map(|i| format!("a_name_of_a_function_{i}")).collect();
        let mut budget = Budget::default();
        assert_eq!(
            nearest_within(&mut budget, "a_name_of_a_funktion_17", names.iter().map(String::as_str)),
            Some("a_name_of_a_function_17")
        );
        let once = budget.used();
        assert!(once < BUDGET / 4, "one name takes {once}");
        for _ in 0..1_000 {
            nearest_within(&mut budget, "a_name_of_a_funktion_17", names.iter().map(String::as_str));
        }
        assert_eq!(budget.used(), BUDGET);
        let long = "x".repeat(1 << 20);
        assert_eq!(nearest_within(&mut budget, &long, [long.as_str()]), None, "nothing is left");
    }
}
