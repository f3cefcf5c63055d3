//! The text of the compiler's intermediate representation, for snapshots that a person reads.

use eddy::glsl::{self, Driver, Link, PassSource};
use std::{collections::HashMap, fmt::Write};

/// Returns the program of an Image pass after the last pass of the optimiser.
pub fn optimised(code: &str, driver: Driver) -> String {
    let source = PassSource { driver, ..PassSource::image(code) };
    let text =
        glsl::dump_ir(&source, &Link::default(), None, None).unwrap_or_else(|errors| panic!("{code}: {errors:?}"));
    let [program] = final_programs(&text)[..] else { panic!("an Image pass is one program") };
    program.trim_end().to_owned()
}

/// Returns the programs after the last pass, one for each stage that the text of `dump_ir` goes through.
pub fn final_programs(dump: &str) -> Vec<&str> {
    let sections: Vec<&str> = dump.split("; after ").skip(1).collect();
    let is_last = |next: Option<&&str>| next.is_none_or(|next| next.starts_with("lower\n"));
    let last = sections.iter().enumerate().filter(|&(n, _)| is_last(sections.get(n + 1)));
    last.map(|(_, section)| section.split_once('\n').expect("a name and a program").1).collect()
}

/// Returns the lines of a program that declare functions, variables and globals.
pub fn declarations(program: &str) -> String {
    let declares = |line: &&str| {
        let name = line.trim_start();
        let is_variable = name.starts_with(['$', '@']) && name.split_once(": ").is_some_and(|(n, _)| !n.contains(' '));
        is_variable || line.starts_with("fn ") || line.starts_with("entry ")
    };
    program.lines().filter(declares).map(|line| line.trim_end_matches(" {").to_owned() + "\n").collect()
}

/// Returns the indices that a program reads and writes elements at, each with all that it is computed from:
/// `load $0[(subtract (load $1), 1)]`.
pub fn indices(program: &str) -> String {
    let mut made = HashMap::new();
    let mut out = String::new();
    for line in program.lines().map(str::trim_start) {
        if line.starts_with("fn ") || line.starts_with("entry ") {
            made.clear();
        }
        let Some((name, text)) = line.split_once(" = ").filter(|(name, _)| name.starts_with('%')) else {
            if let Some((place, _)) = line.split_once(" <- ").filter(|(place, _)| place.contains("[%")) {
                let _ = writeln!(out, "    {} <- ..", expanded(place, &made));
            }
            continue;
        };
        let text = expanded(text, &made);
        if line.contains("[%") {
            let _ = writeln!(out, "    {text}");
        }
        let name = name.split(':').next().expect("a name");
        made.insert(name.to_owned(), text);
    }
    out
}

/// Returns the text of an operation with the values in it replaced by what made them. An operation within another has
/// parentheses.
fn expanded(text: &str, made: &HashMap<String, String>) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('%') {
        let end = rest[at + 1..].find(|c: char| !c.is_ascii_digit()).map_or(rest.len(), |n| at + 1 + n);
        out.push_str(&rest[..at]);
        match made.get(&rest[at..end]) {
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

/// What a function consists of. Places, constants and parameters are no operations.
#[derive(Default)]
struct Digest {
    name: String,
    /// Of the function's text, so that an operand in another's place shows.
    hash: Fnv,
    operations: u32,
    branches: u32,
    loops: u32,
    loads: u32,
    stores: u32,
    calls: u32,
    texture_reads: u32,
}

/// FNV-1a in 32 bits: the same on each machine.
struct Fnv(u32);

impl Default for Fnv {
    fn default() -> Self {
        Self(0x811c_9dc5)
    }
}

impl Fnv {
    fn line(&mut self, line: &str) {
        for byte in line.bytes().chain([b'\n']) {
            self.0 = (self.0 ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        }
    }
}

/// Returns a line for each function of a program, with counts of what it consists of and a hash of its text. The
/// globals before the first function are a line of their own.
pub fn digest(program: &str) -> String {
    let mut functions: Vec<Digest> = Vec::new();
    for line in program.lines().filter(|line| !line.is_empty()) {
        let declares = line.starts_with("fn ") || line.starts_with("entry ");
        if declares || functions.is_empty() {
            let name = if declares { line.split('(').next().expect("a name") } else { "globals" };
            functions.push(Digest { name: name.to_owned(), ..Digest::default() });
        }
        let function = functions.last_mut().expect("one was added");
        function.hash.line(line);
        if declares || function.name == "globals" {
            continue;
        }
        let statement = line.trim_start();
        let expression = statement.strip_prefix('%').and_then(|text| text.split_once(" = "));
        let word = |text: &str| text.split(' ').next().unwrap_or_default().to_owned();
        match expression {
            Some((_, made)) => {
                function.operations += 1;
                match word(made).as_str() {
                    "load" => function.loads += 1,
                    "call" => function.calls += 1,
                    "sample" | "fetch" => function.texture_reads += 1,
                    _ => {}
                }
            }
            None => match word(statement).as_str() {
                "if" | "switch" => function.branches += 1,
                "loop" => function.loops += 1,
                "call" => function.calls += 1,
                _ if statement.contains(" <- ") => function.stores += 1,
                _ => {}
            },
        }
    }
    let mut out = String::new();
    for f in functions {
        let numbers = [f.operations, f.branches, f.loops, f.loads, f.stores, f.calls, f.texture_reads];
        let columns = numbers.map(|number| format!("{number:>10}")).concat();
        let _ = writeln!(out, "{:<10}{columns}  {:08x}", f.name, f.hash.0);
    }
    out
}

/// The names of [`digest`]'s columns.
pub const DIGEST_HEADER: &str =
    "function  operations  branches     loops     loads    stores     calls  textures      hash";
