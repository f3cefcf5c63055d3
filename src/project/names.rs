//! Suggestions for mistyped names.

/// The known name closest to `name`, unless all are too different. Letter case and the difference between `-`, `_` and
/// a space are ignored.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let fold = |s: &str| s.to_lowercase().replace(['-', ' '], "_");
    let name = fold(name);
    let allowed = (name.chars().count() / 3).max(1);
    known
        .into_iter()
        .map(|k| {
            let folded = fold(k);
            let distance = strsim::osa_distance(&name, &folded);
            // The start of a longer name ("noise" for "noise-rgba-256") is a plausible guess too, but a worse one.
            let is_start = name.chars().count() >= 3 && folded.starts_with(&name);
            (if is_start { distance.min(allowed) } else { distance }, k)
        })
        .filter(|(distance, _)| *distance <= allowed)
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, k)| k)
}

/// Joins names for a message: "a, b and c".
pub fn listed<S: AsRef<str>>(names: &[S]) -> String {
    match names {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [start @ .., last] => {
            let start: Vec<&str> = start.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", start.join(", "), last.as_ref())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_finds_a_typo_but_no_distant_name() {
        let known = ["filter", "wrap", "vflip"];
        assert_eq!(nearest("fliter", known), Some("filter"));
        assert_eq!(nearest("Wrap", known), Some("wrap"));
        assert_eq!(nearest("colour", known), None);
        assert_eq!(nearest("", known), None);
        assert_eq!(nearest("brick_braker", ["fluid", "brick-breaker"]), Some("brick-breaker"));
        assert_eq!(nearest("brick", ["fluid", "brick-breaker"]), Some("brick-breaker"));
    }

    #[test]
    fn a_list_reads_like_a_sentence() {
        assert_eq!(listed(&["a", "b", "c"]), "a, b and c");
        assert_eq!(listed(&["a"]), "a");
        assert_eq!(listed::<&str>(&[]), "");
    }
}
