//! The text of the compiler's intermediate representation, for readable snapshots.

use eddy::glsl::{self, Driver, Link, PassSource};
use std::{collections::HashMap, fmt::Write};

/// Returns the program of an Image pass after the last pass of the optimiser.
pub(crate) fn optimised(code: &str, driver: Driver) -> String {
    let source = PassSource { driver, ..PassSource::image(code) };
    let text =
        glsl::dump_ir(&source, &Link::default(), None, None).unwrap_or_else(|errors| panic!("{code}: {errors:?}"));
    let [program] = final_programs(&text)[..] else { panic!("an Image pass is one program") };
    program.trim_end().to_owned()
}

/// Returns the programs after the last pass, one for each stage in the text of `dump_ir`.
pub(crate) fn final_programs(dump: &str) -> Vec<&str> {
    let sections: Vec<&str> = dump.split("; after ").skip(1).collect();
    let is_last = |next: Option<&&str>| next.is_none_or(|next| next.starts_with("lower\n"));
    let last = sections.iter().enumerate().filter(|&(n, _)| is_last(sections.get(n + 1)));
    last.map(|(_, section)| section.split_once('\n').expect("a name and a program").1).collect()
}

/// Returns the lines of a program that declare functions, variables and globals.
pub(crate) fn declarations(program: &str) -> String {
    let declares = |line: &&str| {
        let name = line.trim_start();
        let is_variable = name.starts_with(['$', '@']) && name.split_once(": ").is_some_and(|(n, _)| !n.contains(' '));
        is_variable || line.starts_with("fn ") || line.starts_with("entry ")
    };
    program.lines().filter(declares).map(|line| line.trim_end_matches(" {").to_owned() + "\n").collect()
}

/// Returns the indices that a program reads and writes elements at, each with all that it is computed from:
/// `load $0[(subtract (load $1), 1)]`.
pub(crate) fn indices(program: &str) -> String {
    let mut expressions = HashMap::new();
    let mut out = String::new();
    for line in program.lines().map(str::trim_start) {
        if line.starts_with("fn ") || line.starts_with("entry ") {
            expressions.clear();
        }
        let Some((name, text)) = line.split_once(" = ").filter(|(name, _)| name.starts_with('%')) else {
            if let Some((place, _)) = line.split_once(" <- ").filter(|(place, _)| place.contains("[%")) {
                let _ = writeln!(out, "    {} <- ..", expanded(place, &expressions));
            }
            continue;
        };
        let text = expanded(text, &expressions);
        if line.contains("[%") {
            let _ = writeln!(out, "    {text}");
        }
        let name = name.split(':').next().expect("a name");
        expressions.insert(name.to_owned(), text);
    }
    out
}

/// Returns the text of an operation with its operands replaced by the operations that computed them. A nested operation
/// has parentheses.
fn expanded(text: &str, expressions: &HashMap<String, String>) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('%') {
        let end = rest[at + 1..].find(|c: char| !c.is_ascii_digit()).map_or(rest.len(), |n| at + 1 + n);
        out.push_str(&rest[..at]);
        match expressions.get(&rest[at..end]) {
            Some(text) if text.contains(' ') => {
                let _ = write!(out, "({text})");
            }
            Some(text) => out.push_str(text),
            None => out.push_str(&rest[at..end]),
        }
        rest = &rest[end..];
    }
    out + rest
}

/// Returns the text of several programs, each after its title. A function, or all globals of a program, with the same
/// text as an earlier one is a line that names the place of that one.
///
/// The text after a function's number is compared. Calls and globals are identified by number, so functions with the
/// same text may do different things.
pub(crate) fn without_repeats(programs: &[(String, String)]) -> String {
    let mut seen: HashMap<&str, String> = HashMap::new();
    let mut out = String::new();
    for (title, program) in programs {
        let _ = writeln!(out, "=== {title}");
        for part in parts(program) {
            let part = part.trim_end();
            // The name ends at the first parenthesis; globals have none.
            let (name, text) = match part.starts_with("fn ") || part.starts_with("entry ") {
                true => part.split_at(part.find('(').expect("a function's parameters")),
                false => ("globals", part),
            };
            match seen.get(text) {
                Some(place) => {
                    let _ = writeln!(out, "{name}: as {place}\n");
                }
                None => {
                    let _ = writeln!(out, "{part}\n");
                    seen.insert(text, format!("{name} of {title}"));
                }
            }
        }
    }
    out
}

/// Splits a program into its globals, if it has any, and its functions.
fn parts(program: &str) -> impl Iterator<Item = &str> {
    let declares = |line: &str| line.starts_with("fn ") || line.starts_with("entry ");
    let lines = program.split_inclusive('\n').scan(0, |at, line| {
        *at += line.len();
        Some((*at - line.len(), line))
    });
    let mut starts: Vec<usize> = lines.filter(|(_, line)| declares(line)).map(|(at, _)| at).collect();
    starts.insert(0, 0);
    starts.push(program.len());
    let spans: Vec<&str> = starts.windows(2).map(|ends| &program[ends[0]..ends[1]]).collect();
    spans.into_iter().filter(|part| !part.trim().is_empty())
}
