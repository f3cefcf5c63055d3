//! "Did you mean": the known word that is nearest to one nobody knows.

/// Returns the candidate that `word` is most likely a slip of: few letters changed, added, left out or swapped (the
/// optimal string alignment distance), with case that counts unless nothing else differs. `None` where nothing is near
/// enough to be worth saying. Names of files and settings are measured by `project::nearest`, for which case and `-`,
/// `_` and spaces count for nothing.
pub(super) fn nearest_identifier<'c>(word: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    // One slip in a short word, two in a long one. Two letters may lack a third; any other two are another name.
    let is_pair = word.chars().count() == 2;
    let allowed = match word.chars().count() {
        0..=1 => return None,
        2..=5 => 1,
        6..=10 => 2,
        _ => 3,
    };
    candidates
        .into_iter()
        .filter(|candidate| *candidate != word && candidate.len().abs_diff(word.len()) <= 2 * allowed)
        .filter(|candidate| !is_pair || candidate.len() > word.len() || candidate.eq_ignore_ascii_case(word))
        // Letter case counts for nothing when it is all that differs.
        .map(|candidate| {
            let same = candidate.eq_ignore_ascii_case(word);
            (if same { 0 } else { strsim::osa_distance(word, candidate) }, candidate)
        })
        .filter(|&(distance, _)| distance <= allowed)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::nearest_identifier;

    #[test]
    fn finds_slips_and_leaves_strangers() {
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
}
