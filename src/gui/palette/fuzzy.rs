//! Scores how well a few letters match a title.

/// Costs of a letter of a title: it continues the previous one, starts a word, or is anywhere.
const GOES_ON: u32 = 0;
const WORD_START: u32 = 1;
const ANYWHERE: u32 = 6;

/// Returns a cost, which is smaller for a better match, and the bytes of the matched letters of `title`; `None` if it
/// does not match. Letters are in the title's order, in upper or lower case; typed words may be in any order.
pub(super) fn fit(typed: &str, title: &str) -> Option<(u32, Vec<usize>)> {
    let mut letters = Vec::new();
    let mut cost = 0;
    let mut from = 0;
    for (i, word) in typed.split_whitespace().enumerate() {
        // A match in the typed order is better.
        let (word_cost, found) = match word_fit(word, title, from) {
            Some(fit) => fit,
            None => word_fit(word, title, 0).filter(|_| i > 0).map(|(c, found)| (c + ANYWHERE, found))?,
        };
        from = found.last().map_or(from, |last| last + 1);
        cost += word_cost;
        letters.extend(found);
    }
    // Of equal matches, the shorter title is better.
    let rest = title.chars().count().saturating_sub(letters.len()) as u32;
    Some((cost * 256 + if typed.trim().is_empty() { 0 } else { rest.min(255) }, letters))
}

/// Returns a cost like that of [`fit`] if at least one typed word is a prefix of one of the synonyms, which consist of
/// lower case letters and blanks, and the other typed words match the title; also the bytes of the title's matched
/// letters, and the synonym. A word of fewer than two letters is too short for a synonym.
pub(super) fn fit_with<'a>(typed: &str, title: &str, synonyms: &'a str) -> Option<(u32, Vec<usize>, &'a str)> {
    let typed = typed.to_lowercase();
    let mut rest = Vec::new();
    let (mut cost, mut found) = (0, None);
    for word in typed.split_whitespace() {
        match synonyms.split(' ').find(|synonym| word.len() > 1 && synonym.starts_with(word)) {
            Some(synonym) => {
                // A word of the title itself has priority.
                cost += 1 + WORD_START + u32::from(synonym.len() > word.len());
                found = found.or(Some(synonym));
            }
            None => rest.push(word),
        }
    }
    let found = found?;
    let (of_title, letters) = fit(&rest.join(" "), title)?;
    // Of equal matches, one in a title has priority.
    let length = title.chars().count().min(255) as u32;
    Some((cost * 256 + of_title.max(length), letters, found))
}

/// Returns the cheapest match of a word's letters in a title from a byte on, in order.
fn word_fit(word: &str, title: &str, from: usize) -> Option<(u32, Vec<usize>)> {
    let places: Vec<(usize, char, bool)> = {
        let mut before = ' ';
        let place = |(i, c): (usize, char)| {
            let is_word_start = !before.is_alphanumeric() && c.is_alphanumeric();
            before = c;
            (i, lower(c), is_word_start)
        };
        title.char_indices().map(place).filter(|(i, ..)| *i >= from).collect()
    };
    // For each place: the cheapest match that ends there, and its previous place.
    let mut costs: Vec<Vec<Option<(u32, usize)>>> = Vec::new();
    for (n, letter) in word.chars().map(lower).enumerate() {
        let mut cheapest: Option<(u32, usize)> = None;
        let mut row = Vec::with_capacity(places.len());
        for (p, (_, c, is_word_start)) in places.iter().enumerate() {
            let step = if *is_word_start { WORD_START } else { ANYWHERE };
            let reached = match n.checked_sub(1).map(|before| &costs[before]) {
                None => Some((step, p)),
                Some(before) => {
                    let next = p.checked_sub(1).and_then(|q| before[q].map(|(cost, _)| (cost + GOES_ON, q)));
                    let far = cheapest.map(|(cost, q)| (cost + step, q));
                    if let Some((cost, _)) = p.checked_sub(1).and_then(|q| before[q])
                        && cheapest.is_none_or(|(least, _)| cost < least)
                    {
                        cheapest = Some((cost, p - 1));
                    }
                    [next, far].into_iter().flatten().min_by_key(|(cost, _)| *cost)
                }
            };
            row.push(reached.filter(|_| *c == letter));
        }
        costs.push(row);
    }
    let (mut at, cost) = {
        let ends = costs.last()?.iter().enumerate().filter_map(|(p, cost_and_origin)| Some((p, (*cost_and_origin)?.0)));
        ends.min_by_key(|(_, cost)| *cost)?
    };
    let mut found = Vec::new();
    for row in costs.iter().rev() {
        found.push(places[at].0);
        at = row[at]?.1;
    }
    found.reverse();
    Some((cost, found))
}

fn lower(c: char) -> char {
    c.to_lowercase().next().unwrap_or(c)
}

#[cfg(test)]
mod tests {
    use super::fit;

    #[test]
    fn better_matches_cost_less() {
        let cost = |typed: &str, title: &str| fit(typed, title).unwrap().0;
        assert!(cost("find", "Find") < cost("find", "Find and replace"));
        assert!(cost("far", "Find and replace") < cost("far", "Safe area"), "first letters of words");
        assert!(cost("line", "Delete lines") < cost("line", "Play in here"));
        assert!(cost("go line", "Go to line") < cost("line go", "Go to line"));
        assert_eq!(fit("go line", "Go to line").unwrap().1, [0, 1, 6, 7, 8, 9]);
        assert_eq!(fit("lin", "A long line").unwrap().1, [7, 8, 9], "letters that go on, not the first there are");
        assert_eq!(fit("x", "Go"), None);
        assert_eq!(fit("oog", "Go"), None);
        assert_eq!(fit("", "Go").unwrap(), (0, vec![]));
    }
}
