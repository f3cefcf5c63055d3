//! Removes the groups of conditionals that a pass does not compile because of the macro that selects it.

use crate::lines::{HashLine, hash_lines};
use std::{collections::HashSet, ops::Range};

/// A conditional from `#if` to `#endif`.
struct Chain {
    start: usize,
    /// For each group whether it is compiled, if that is known, and its text.
    groups: Vec<(Option<bool>, Range<usize>)>,
}

/// Returns a text without the groups that the macros of other passes select.
pub(super) fn of_pass(text: &str) -> String {
    let lines = hash_lines(text);
    let defined: HashSet<&str> =
        lines.iter().filter_map(|line| first_word(line.body.strip_prefix("define")?)).collect();
    let value = |line: &HashLine<'_>| {
        let (name, is_wanted) = tested(line.body)?;
        is_of_pass(name).then(|| defined.contains(name) == is_wanted)
    };
    let after =
        |line: &HashLine<'_>| text[line.range.end..].find('\n').map_or(text.len(), |at| line.range.end + at + 1);
    let mut open: Vec<Chain> = Vec::new();
    let mut removed: Vec<Range<usize>> = Vec::new();
    for line in &lines {
        let word = first_word(line.body).unwrap_or_default();
        let known = match word {
            "else" => Some(true),
            _ => value(line),
        };
        match word {
            "if" | "ifdef" | "ifndef" => {
                open.push(Chain { start: line.range.start, groups: vec![(known, after(line)..0)] });
            }
            "else" | "elif" => {
                let Some(chain) = open.last_mut() else { continue };
                close(chain, line.range.start);
                chain.groups.push((known, after(line)..0));
            }
            "endif" => {
                let Some(mut chain) = open.pop() else { continue };
                close(&mut chain, line.range.start);
                if chain.groups.iter().any(|(known, _)| known.is_none()) {
                    continue;
                }
                match chain.groups.into_iter().find(|(known, _)| *known == Some(true)) {
                    Some((_, group)) => removed.extend([chain.start..group.start, group.end..after(line)]),
                    None => removed.push(chain.start..after(line)),
                }
            }
            _ => {}
        }
    }
    removed.sort_by_key(|range| range.start);
    let (mut out, mut done) = (String::new(), 0);
    for range in removed {
        if range.start > done {
            out.push_str(&text[done..range.start]);
        }
        done = done.max(range.end);
    }
    out + &text[done..]
}

fn close(chain: &mut Chain, end: usize) {
    if let Some((_, group)) = chain.groups.last_mut() {
        group.end = end;
    }
}

/// Returns whether a macro of glslViewer selects a pass.
fn is_of_pass(name: &str) -> bool {
    let number = name.strip_prefix("DOUBLE_BUFFER_").or_else(|| name.strip_prefix("BUFFER_"));
    name == "POSTPROCESSING" || number.is_some_and(|number| number.bytes().all(|byte| byte.is_ascii_digit()))
}

/// Returns the macro that a line tests, and whether it must be defined; `None` for lines that test more.
fn tested(body: &str) -> Option<(&str, bool)> {
    let body = body.split("//").next()?.split("/*").next()?.trim();
    if let Some(rest) = body.strip_prefix("ifdef") {
        return Some((rest.trim(), true));
    }
    if let Some(rest) = body.strip_prefix("ifndef") {
        return Some((rest.trim(), false));
    }
    let rest = body.strip_prefix("if").or_else(|| body.strip_prefix("elif"))?.trim();
    let (rest, is_wanted) = rest.strip_prefix('!').map_or((rest, true), |rest| (rest.trim(), false));
    let name = rest.strip_prefix("defined")?.trim();
    let name = name.strip_prefix('(').map_or(Some(name), |name| name.strip_suffix(')'))?.trim();
    Some((name, is_wanted))
}

fn first_word(body: &str) -> Option<&str> {
    body.split(|c: char| !super::tokens::is_letter(c)).find(|word| !word.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_of_other_passes_are_removed() {
        let text = "#define BUFFER_0\na\n#if defined(BUFFER_0)\nb\n#ifdef X\nc\n#endif\n#elif defined( BUFFER_1 )\nd\n\
                    #ifndef BUFFER_0\n#endif\n#else\ne\n#endif\n#ifdef POSTPROCESSING // last\nf\n#endif\n\
                    #if defined(BUFFER_1) || defined(X)\ng\n#endif\n#if !defined(BUFFER_2)\nh\n#else\ni\n#endif";
        let expected = "#define BUFFER_0\na\nb\n#ifdef X\nc\n#endif\n\
                        #if defined(BUFFER_1) || defined(X)\ng\n#endif\nh\n";
        assert_eq!(of_pass(text), expected);
    }
}
