//! The text of the compiler's intermediate representation, for snapshots that a person reads.

use eddy::glsl::{self, Driver, Link, PassSource};
use std::fmt::Write;

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

/// What a function consists of. Places, constants and parameters are no operations.
#[derive(Default)]
struct Digest {
    name: String,
    operations: u32,
    branches: u32,
    loops: u32,
    loads: u32,
    stores: u32,
    calls: u32,
    texture_reads: u32,
}

/// Returns a line for each function of a program, with counts of what it consists of.
pub fn digest(program: &str) -> String {
    let mut functions: Vec<Digest> = Vec::new();
    for line in program.lines() {
        if line.starts_with("fn ") || line.starts_with("entry ") {
            let name = line.split('(').next().expect("a name").to_owned();
            functions.push(Digest { name, ..Digest::default() });
            continue;
        }
        let Some(function) = functions.last_mut() else { continue };
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
        let _ = writeln!(out, "{:<10}{columns}", f.name);
    }
    out
}

/// The names of [`digest`]'s columns.
pub const DIGEST_HEADER: &str = "function  operations  branches     loops     loads    stores     calls  textures";
