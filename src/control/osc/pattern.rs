//! Address patterns of OSC 1.0 ("OSC Message Dispatching and Pattern Matching").
//!
//! A pattern is matched part by part between slashes, so `*` does not match a slash. In a part, `?` is any character,
//! `*` any number of characters, `[a-cx]` one of a list or a range, `[!a]` any other character, and `{one,two}` one of
//! several texts. The time is proportional to the product of both lengths for any pattern.

use crate::ControlEvent;
use eddy_project::{ControlAddress, limits};
use std::collections::{HashMap, HashSet};

/// A well-formed address pattern.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pattern {
    parts: Vec<Vec<Token>>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Token {
    Byte(u8),
    Any,
    AnySequence,
    /// One of the ranges, or none of them.
    Set {
        ranges: Vec<(u8, u8)>,
        is_negated: bool,
    },
    OneOf(Vec<Vec<u8>>),
}

/// Returns whether an address contains a character that makes it a pattern.
pub fn is_pattern(address: &str) -> bool {
    address.contains(['*', '?', '[', ']', '{', '}'])
}

/// An OSC address that moves something, with the number of its arguments that do.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Listener {
    /// The address, which starts with a slash and is not a pattern.
    pub path: String,
    /// Arguments from the first one on; later ones move nothing.
    pub arguments: usize,
}

/// Returns the events with each pattern replaced by the addresses that it matches among all listeners. A pattern itself
/// is not the address of a control. At most [`limits::OSC_PATTERNS`] different patterns are expanded, and at most
/// [`limits::OSC_STEPS`] steps are spent on matching; later ones are dropped.
///
/// For each argument of an address only the newest event from patterns is kept, so that their number never exceeds the
/// number of arguments in `listeners`, whatever is sent.
pub fn dispatched(events: Vec<ControlEvent>, listeners: impl FnOnce() -> Vec<Listener>) -> Vec<ControlEvent> {
    let pattern_of = |event: &ControlEvent| match &event.source {
        ControlAddress::Osc { path, argument } if is_pattern(path) => Some((path.clone(), *argument)),
        _ => None,
    };
    if !events.iter().any(|event| pattern_of(event).is_some()) {
        return events;
    }
    let listeners = listeners();
    let mut steps = limits::OSC_STEPS;
    let mut known: HashMap<String, Vec<u32>> = HashMap::new();
    for (text, _) in events.iter().filter_map(pattern_of) {
        if known.len() == limits::OSC_PATTERNS || known.contains_key(&text) {
            continue;
        }
        let pattern = Pattern::parse(&text);
        let matches = |(_, listener): &(u32, &Listener)| {
            pattern.as_ref().is_some_and(|it| it.matches_within(&listener.path, &mut steps) == Some(true))
        };
        let matched = (0..).zip(&listeners).filter(matches).map(|(n, _)| n).collect();
        known.insert(text, matched);
    }
    let mut seen = HashSet::new();
    let mut newest_first = Vec::new();
    for event in events.into_iter().rev() {
        let Some((text, argument)) = pattern_of(&event) else {
            newest_first.push(event);
            continue;
        };
        for &n in known.get(&text).into_iter().flatten().rev() {
            let listener = &listeners[n as usize];
            if argument < listener.arguments && seen.insert((n, argument)) {
                let source = ControlAddress::Osc { path: listener.path.clone(), argument };
                newest_first.push(ControlEvent { source, value: event.value });
            }
        }
    }
    newest_first.reverse();
    newest_first
}

impl Pattern {
    /// Parses a pattern. `None` if it is not a pattern, or if a bracket or a brace is not closed.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let is_allowed = |byte: u8| byte.is_ascii_graphic() && byte != b'#';
        if text.len() > limits::OSC_PATH || !text.bytes().all(is_allowed) {
            return None;
        }
        let parts = text.strip_prefix('/')?.split('/').map(|part| tokens(part.as_bytes()));
        Some(Self { parts: parts.collect::<Option<_>>()? })
    }

    #[cfg(test)]
    pub(super) fn matches(&self, address: &str) -> bool {
        self.matches_within(address, &mut u64::MAX.clone()) == Some(true)
    }

    /// Compares an address with the pattern, and subtracts the cost from `steps`. `None` if there are not enough steps.
    fn matches_within(&self, address: &str, steps: &mut u64) -> Option<bool> {
        let Some(rest) = address.strip_prefix('/') else { return Some(false) };
        let mut parts = rest.split('/');
        for tokens in &self.parts {
            let Some(part) = parts.next() else { return Some(false) };
            *steps = steps.checked_sub((tokens.len() as u64 + 1) * (part.len() as u64 + 1))?;
            if !part_matches(tokens, part.as_bytes()) {
                return Some(false);
            }
        }
        Some(parts.next().is_none())
    }
}

/// Parses a part between two slashes.
fn tokens(mut rest: &[u8]) -> Option<Vec<Token>> {
    let mut tokens = Vec::new();
    while let Some((first, tail)) = rest.split_first() {
        rest = tail;
        tokens.push(match first {
            b'?' => Token::Any,
            b'*' => Token::AnySequence,
            b'[' => {
                let (list, tail) = until(rest, b']')?;
                rest = tail;
                set(list)
            }
            b'{' => {
                let (list, tail) = until(rest, b'}')?;
                rest = tail;
                Token::OneOf(list.split(|byte| *byte == b',').map(<[u8]>::to_vec).collect())
            }
            b']' | b'}' | b',' => return None,
            byte => Token::Byte(*byte),
        });
    }
    Some(tokens)
}

/// Splits a text at a closing character.
fn until(text: &[u8], end: u8) -> Option<(&[u8], &[u8])> {
    let at = text.iter().position(|byte| *byte == end)?;
    let list = &text[..at];
    // Brackets and braces do not contain each other.
    (!list.iter().any(|byte| b"[]{}".contains(byte))).then(|| (list, &text[at + 1..]))
}

/// Parses the contents of brackets. A minus sign at an end and a `!` that is not the first character are literal.
fn set(list: &[u8]) -> Token {
    let (is_negated, mut list) = match list.strip_prefix(b"!") {
        Some(rest) => (true, rest),
        None => (false, list),
    };
    let mut ranges = Vec::new();
    loop {
        list = match list {
            [] => return Token::Set { ranges, is_negated },
            [from, b'-', to, rest @ ..] => {
                ranges.push((*from.min(to), *from.max(to)));
                rest
            }
            [one, rest @ ..] => {
                ranges.push((*one, *one));
                rest
            }
        };
    }
}

/// Matches all alternatives at once: `reached[n]` is set if the tokens so far can match the first `n` bytes.
fn part_matches(tokens: &[Token], part: &[u8]) -> bool {
    let mut reached = vec![false; part.len() + 1];
    reached[0] = true;
    for token in tokens {
        let mut next = vec![false; part.len() + 1];
        for from in (0..=part.len()).filter(|from| reached[*from]) {
            match token {
                Token::AnySequence => {
                    next[from..].fill(true);
                    break;
                }
                Token::OneOf(texts) => {
                    for text in texts.iter().filter(|text| part[from..].starts_with(text)) {
                        next[from + text.len()] = true;
                    }
                }
                one => {
                    if part.get(from).is_some_and(|byte| is_one(one, *byte)) {
                        next[from + 1] = true;
                    }
                }
            }
        }
        reached = next;
    }
    reached[part.len()]
}

fn is_one(token: &Token, byte: u8) -> bool {
    match token {
        Token::Byte(known) => *known == byte,
        Token::Set { ranges, is_negated } => {
            ranges.iter().any(|(from, to)| (*from..=*to).contains(&byte)) != *is_negated
        }
        Token::Any => true,
        Token::AnySequence | Token::OneOf(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rules of the specification, each with addresses that match and addresses that do not.
    #[test]
    fn patterns_match_by_the_rules_of_osc_1_0() {
        let table: [(&str, &[&str], &[&str]); 20] = [
            ("/a/b", &["/a/b"], &["/a", "/a/b/c", "/a/c", "/A/b", "a/b", ""]),
            ("/?", &["/a", "/1"], &["/ab", "/", "/a/b"]),
            ("/*", &["/a", "/abc", "/"], &["/a/b"]),
            ("/a*c", &["/ac", "/abc", "/abcbc"], &["/ab", "/a/c"]),
            ("/*/x", &["/a/x", "/abc/x"], &["/x", "/a/b/x", "/a/y"]),
            ("/*a*", &["/a", "/bab", "/aa"], &["/b"]),
            ("/[abc]", &["/a", "/c"], &["/d", "/ab", "/"]),
            ("/[a-c]", &["/a", "/b", "/c"], &["/d", "/-"]),
            ("/fader[1-46]", &["/fader1", "/fader4", "/fader6"], &["/fader5", "/fader"]),
            ("/[!a-c]", &["/d", "/-"], &["/a", "/b", "/", "/dd"]),
            // "!" and "-" have no special meaning elsewhere.
            ("/[a!]", &["/a", "/!"], &["/b"]),
            ("/[a-]", &["/a", "/-"], &["/b"]),
            ("/a!-", &["/a!-"], &["/a"]),
            ("/{foo,bar}", &["/foo", "/bar"], &["/foobar", "/foo,bar", "/"]),
            ("/{a,ab}c", &["/ac", "/abc"], &["/c", "/aabc"]),
            ("/{,x}y", &["/y", "/xy"], &["/x"]),
            ("/{pan,gain}/[0-9]?", &["/pan/1a", "/gain/00"], &["/pan/1", "/tone/10"]),
            ("/eddy/*", &["/eddy/speed"], &["/eddy/center/x", "/eddy"]),
            ("/eddy/center/[xy]", &["/eddy/center/x"], &["/eddy/center/z", "/eddy/center"]),
            ("/[]a", &[], &["/a", "/ba"]),
        ];
        for (pattern, wanted, others) in table {
            let read = Pattern::parse(pattern).unwrap_or_else(|| panic!("{pattern}"));
            for address in wanted {
                assert!(read.matches(address), "{pattern} does not match {address}");
            }
            for address in others {
                assert!(!read.matches(address), "{pattern} matches {address}");
            }
        }
        for bad in ["", "a", "/[a", "/a]", "/{a", "/a}", "/[a/b]", "/{a/b}", "/{[a]}", "/a b", "/ä", "/a#", "/a,b"] {
            assert_eq!(Pattern::parse(bad), None, "{bad}");
        }
        assert!(is_pattern("/a*") && is_pattern("/{a}") && !is_pattern("/a/b-c!"));
    }

    #[test]
    fn a_pattern_is_replaced_by_the_addresses_that_it_matches() {
        let event = |path: &str, argument, value| ControlEvent {
            source: ControlAddress::Osc { path: path.into(), argument },
            value,
        };
        let known = || ["/1/a", "/1/b", "/2/a"].map(|path| Listener { path: path.into(), arguments: 64 }).to_vec();
        let sent = vec![event("/9", 0, 0.1), event("/1/*", 1, 0.2), event("/x*", 0, 0.3), event("/[12]/a", 0, 0.4)];
        let wanted = [
            event("/9", 0, 0.1),
            event("/1/a", 1, 0.2),
            event("/1/b", 1, 0.2),
            event("/1/a", 0, 0.4),
            event("/2/a", 0, 0.4),
        ];
        assert_eq!(dispatched(sent, known), wanted);
        let plain = vec![event("/1/a", 0, 1.0)];
        assert_eq!(dispatched(plain.clone(), || unreachable!("there is no pattern")), plain);
    }

    /// 32 patterns, 4,096 events and 20,000 addresses: neither the events nor the steps are their product.
    #[test]
    fn pattern_events_are_limited_by_the_listeners() {
        let event =
            |path: String, argument, value| ControlEvent { source: ControlAddress::Osc { path, argument }, value };
        let known = || ["/1/a", "/1/b"].map(|path| Listener { path: path.into(), arguments: 2 }).to_vec();
        // Beyond the limit of different patterns only the first ones are expanded; arguments that move nothing are not.
        let number = |n: usize| event(format!("/1/{{a,{n}}}"), n % 3, n as f64);
        let many: Vec<ControlEvent> = (0..limits::OSC_PATTERNS + 5).map(number).collect();
        let values: Vec<f64> = dispatched(many, known).iter().map(|event| event.value).collect();
        assert_eq!(values, [30.0, 31.0]);
        let listener = |n: usize| Listener { path: format!("/eddy/{n}_{}", "x".repeat(200)), arguments: 4 };
        let listeners: Vec<Listener> = (0..20_000).map(listener).collect();
        let burst: Vec<ControlEvent> =
            (0..limits::CONTROL_EVENTS).map(|n| event("/eddy/*".into(), n % 60, n as f64)).collect();
        assert_eq!(dispatched(burst, || listeners.clone()).len(), 4 * 20_000);
        let long = Pattern::parse(&format!("/eddy/{}", "*x".repeat(120))).unwrap();
        let mut steps = limits::OSC_STEPS;
        let compared = listeners.iter().take_while(|it| long.matches_within(&it.path, &mut steps).is_some()).count();
        assert!((500..5_000).contains(&compared), "{compared}");
    }

    /// These take exponential time if alternatives are tried one after the other.
    #[test]
    fn matching_takes_no_exponential_time() {
        let pattern = Pattern::parse(&format!("/{}b", "*a".repeat(120))).unwrap();
        let address = format!("/{}", "a".repeat(250));
        let started = std::time::Instant::now();
        assert!(!pattern.matches(&address));
        let lists = Pattern::parse(&format!("/{}", "{a,aa}".repeat(40))).unwrap();
        assert!(lists.matches(&address[..61]) && !lists.matches(&address[..100]));
        assert!(started.elapsed() < std::time::Duration::from_secs(5));
    }
}
