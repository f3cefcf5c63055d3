//! Programs damaged in every way: the compiler returns a program or errors for each, quickly and without panicking.
//!
//! The damage is the same in every run. `EDDY_FUZZ_SECONDS` sets how long it runs, and `EDDY_FUZZ_SEED` makes it
//! different.

use crate::support::clock::Clock;
use eddy::{
    diag::{SourceId, SourceMap, render_all},
    glsl::{self, Driver, PassKind, PassSource, services::Analysis},
};
use std::time::{Duration, Instant};

/// Inserted pieces: all kinds of tokens of the language, and some that are not part of it.
const PIECES: &[&str] = &[
    "(",
    ")",
    "{",
    "}",
    "[",
    "]",
    ";",
    ",",
    ".",
    "=",
    "+",
    "-",
    "*",
    "/",
    "%",
    "?",
    ":",
    "<",
    ">",
    "&&",
    "||",
    "^^",
    "!",
    "~",
    "++",
    "--",
    "<<",
    ">>",
    "&",
    "|",
    "^",
    "if(",
    "else ",
    "for(;;)",
    "while(true)",
    "do ",
    "switch(1){",
    "case 1:",
    "default:",
    "return ",
    "break;",
    "continue;",
    "discard;",
    "struct S{",
    "const ",
    "in ",
    "out ",
    "inout ",
    "uniform ",
    "float ",
    "vec3(",
    "mat4(",
    "int ",
    "uint(",
    "bool ",
    "ivec2(",
    "sampler2D ",
    "void ",
    "float[2](",
    "float[](",
    "S(",
    "S[2]",
    "precision highp float;",
    "layout(location=0)",
    "invariant ",
    "1",
    "1.0",
    "0x",
    "1e",
    "3u",
    "08",
    "4294967296",
    "-2147483648",
    "true",
    "x",
    "a",
    "i",
    "A",
    ".xyzw",
    ".length()",
    "[0]",
    "[i]",
    "[-1]",
    "iTime",
    "iChannel0",
    "iCh0.size",
    "gl_FragCoord",
    "mainImage",
    "texture(",
    "mod(",
    "modf(",
    "inverse(",
    "outerProduct(",
    "\n#define A ",
    "\n#define F(x) x x\n",
    "F(",
    "\n#if ",
    "\n#else\n",
    "\n#endif\n",
    "\n#undef A\n",
    "defined(",
    "__LINE__",
    "/*",
    "*/",
    "//",
    "\\\n",
    "\n",
    "\r",
    "\0",
    "\u{e9}",
    "\u{2212}",
    "\u{feff}",
    "\"",
    "'",
    "#",
    "##",
    "@",
];

/// xorshift: the same numbers on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % n.max(1) as u64) as usize
    }
}

fn boundary(text: &str, mut at: usize) -> usize {
    at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

fn slice<'t>(random: &mut Random, text: &'t str, longest: usize) -> &'t str {
    let start = boundary(text, random.below(text.len() + 1));
    let end = boundary(text, start + random.below(longest)).max(start);
    &text[start..end]
}

fn damaged(random: &mut Random, seeds: &[String]) -> String {
    let seed = &seeds[random.below(seeds.len())];
    let mut text = if random.below(4) == 0 { slice(random, seed, seed.len() + 1).to_owned() } else { seed.clone() };
    let max_changes = [1, 1, 1, 2, 6][random.below(5)];
    for _ in 0..=random.below(max_changes) {
        let at = boundary(&text, random.below(text.len() + 1));
        match random.below(12) {
            0 => {
                let end = boundary(&text, at + random.below(20)).max(at);
                text.replace_range(at..end, "");
            }
            1 => {
                let copy = slice(random, &text, 60).to_owned();
                text.insert_str(at, &copy);
            }
            2 => {
                let other = &seeds[random.below(seeds.len())];
                let copy = slice(random, other, 200).to_owned();
                text.insert_str(at, &copy);
            }
            3 => {
                let piece = PIECES[random.below(PIECES.len())];
                let times = if random.below(20) == 0 { 3000 } else { 4 };
                text.insert_str(at, &piece.repeat(1 + random.below(times)));
            }
            4 | 5 => text.insert_str(at, PIECES[random.below(PIECES.len())]),
            // Mild damage, which often leaves a valid program: a statement is removed, an operator or a word is
            // replaced.
            6 | 7 => {
                let end = text[at..].find(';').map_or(at, |i| at + i + 1);
                let start = text[..at].rfind([';', '{', '}']).map_or(at, |i| i + 1);
                text.replace_range(start..end.max(start), "");
            }
            8 => {
                let ops: Vec<usize> = text.match_indices(['+', '-', '*', '/', '<', '>']).map(|m| m.0).collect();
                if let Some(&op) = ops.get(random.below(ops.len())) {
                    text.replace_range(op..op + 1, ["+", "-", "*", "/", "<", ">", "&&", "%"][random.below(8)]);
                }
            }
            _ => {
                let words: Vec<(usize, usize)> = words(&text);
                if words.len() > 1 {
                    let (from, to) = (words[random.below(words.len())], words[random.below(words.len())]);
                    let word = text[from.0..from.1].to_owned();
                    text.replace_range(to.0..to.1, &word);
                }
            }
        }
    }
    text
}

/// Returns the byte ranges of names and numbers.
fn words(text: &str) -> Vec<(usize, usize)> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
    let mut found = Vec::new();
    let mut start = None;
    for (i, c) in text.char_indices().chain([(text.len(), ' ')]) {
        match (is_part(c), start) {
            (true, None) => start = Some(i),
            (false, Some(first)) => {
                found.push((first, i));
                start = None;
            }
            _ => {}
        }
    }
    found
}

/// Returns the passes of the presets, and the programs of the compiler's own tests.
fn seeds() -> Vec<String> {
    let mut seeds = Vec::new();
    for name in eddy::project::presets::names() {
        let project = eddy::project::presets::load(name).unwrap().project;
        seeds.extend(project.passes.iter().map(|p| p.source.compile_text().into_owned()));
    }
    let spec = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/glsl/check/tests/spec");
    for entry in std::fs::read_dir(spec).unwrap() {
        let text = std::fs::read_to_string(entry.unwrap().path()).unwrap();
        // A file contains many programs, each after a line that says whether it is valid.
        for program in text.split("\n//").filter_map(|p| p.trim_start_matches("//").strip_prefix("ok")) {
            let program = program.split_once('\n').map_or("", |(_, rest)| rest);
            let entry = if program.contains("mainImage") {
                ""
            } else {
                "\nvoid mainImage(out vec4 o, in vec2 p) { o = p.xyxy; }\n"
            };
            seeds.push(format!("{program}{entry}"));
        }
    }
    assert!(seeds.len() > 20);
    seeds
}

/// The time limit of a text.
const TIME_LIMIT: Duration = Duration::from_secs(1);

#[test]
fn any_text_is_compiled_or_rejected() {
    let number = |name: &str| std::env::var(name).ok().and_then(|v| v.parse::<u64>().ok());
    let seconds = number("EDDY_FUZZ_SECONDS");
    let mut random = Random(number("EDDY_FUZZ_SEED").unwrap_or(0x9E37_79B9_7F4A_7C15));
    let seeds = seeds();
    let start = Instant::now();
    let (mut cases, mut compiled) = (0, 0);
    while seconds.map_or(cases < 3000, |s| start.elapsed() < Duration::from_secs(s)) {
        let text = damaged(&mut random, &seeds);
        cases += 1;
        let kind =
            [PassKind::Image, PassKind::Buffer, PassKind::Cubemap, PassKind::Sound][random.below(9).saturating_sub(5)];
        let [tables_in_memory, opaque_uniforms, may_discard, nan_angle] = [(); 4].map(|()| random.below(2) == 0);
        let [
            array_loops,
            loop_closing_exits,
            opaque_limits,
            opaque_counters,
            discard_exits,
            small_arrays,
            bounded_loops,
        ] = [(); 7].map(|()| random.below(2) == 0);
        let compile = || {
            let result = glsl::compile(&PassSource {
                kind,
                driver: Driver {
                    tables_in_memory,
                    opaque_uniforms,
                    may_discard,
                    nan_angle,
                    array_loops,
                    loop_closing_exits,
                    opaque_limits,
                    opaque_counters,
                    discard_exits,
                    small_arrays,
                    max_loop_iterations: bounded_loops.then_some(1 << 22),
                    ..Driver::default()
                },
                ..PassSource::image(&text)
            });
            if let Err(errors) = &result {
                assert!(errors.iter().any(|d| d.is_error()), "rejected without an error");
                let bug = errors.iter().find(|d| d.message.contains("bug in Eddy"));
                assert!(bug.is_none(), "{bug:?}");
                let mut sources = SourceMap::default();
                sources.add("image.glsl", text.as_str());
                render_all(errors, &sources);
            }
            result.is_ok()
        };
        // Caches may be cold, and not every system reports a thread's own time: only a text that is slow each time
        // fails.
        let mut shortest = Duration::MAX;
        for _ in 0..5 {
            let start = Clock::now();
            let result = std::panic::catch_unwind(compile);
            let Ok(ok) = result else { panic!("case {cases}, {kind:?}:\n{text}") };
            shortest = shortest.min(start.elapsed());
            if shortest < TIME_LIMIT {
                compiled += u32::from(ok);
                break;
            }
        }
        assert!(shortest < TIME_LIMIT, "case {cases} took {shortest:?}:\n{text}");
    }
    println!("{cases} cases, {compiled} of them compiled");
    assert!(compiled > 0, "no damaged text compiles");
}

/// Makes all the requests that an editor may make about one place of a text.
fn request_all(analysis: &Analysis, text: &str, at: usize) {
    let source = SourceId(0);
    analysis.hover(source, at);
    analysis.near(source, at);
    analysis.definition(source, at);
    for span in analysis.uses(source, at) {
        assert!(text.get(span.range()).is_some_and(|name| !name.is_empty()), "{span:?} is not a name");
    }
    analysis.signature_help(source, at);
    let found = analysis.completions(source, at);
    if let Some(typed) = text.get(found.replace.clone()) {
        found.matching(typed);
    }
}

#[test]
fn editor_requests_work_at_any_place_of_any_text() {
    let number = |name: &str| std::env::var(name).ok().and_then(|v| v.parse::<u64>().ok());
    let seconds = number("EDDY_FUZZ_SECONDS");
    let mut random = Random(number("EDDY_FUZZ_SEED").unwrap_or(0x9E37_79B9_7F4A_7C15));
    let seeds = seeds();
    let start = Instant::now();
    let mut cases = 0;
    while seconds.map_or(cases < 400, |s| start.elapsed() < Duration::from_secs(s)) {
        let text = damaged(&mut random, &seeds);
        cases += 1;
        let places: Vec<usize> = (0..8).map(|_| random.below(text.len() + 2)).collect();
        let result = std::panic::catch_unwind(|| {
            let analysis = Analysis::new(&PassSource::image(&text));
            let mut end = 0;
            for span in analysis.classes(SourceId(0)) {
                assert!(span.range.start >= end && span.range.end <= text.len(), "{span:?}");
                assert!(text.get(span.range.clone()).is_some(), "{span:?} cuts a character");
                end = span.range.end;
            }
            places.iter().for_each(|&at| request_all(&analysis, &text, at));
        });
        assert!(result.is_ok(), "case {cases}, requests at {places:?}:\n{text}");
    }
}

#[test]
fn huge_texts_are_compiled_or_rejected() {
    let diagnose = |text: &str| {
        let start = Clock::now();
        let messages = glsl::diagnose(&PassSource::image(text));
        // Far above the usual time, and far below that of a quadratic algorithm.
        assert!(start.elapsed() < Duration::from_secs(20), "{:?}: {}", start.elapsed(), &text[..40]);
        messages
    };
    let megabyte = |piece: &str| piece.repeat(1_000_000 / piece.len());
    for piece in
        ["(", "{", "[", "a", "a ", "1.0 ", "/*", "//", "\n", "#\n", "#if 1\n", "a;", "a[", "a(", "\"", "\0", "\u{e9} "]
    {
        assert!(!diagnose(&megabyte(piece)).is_empty(), "{piece:?}");
    }
    let functions: String =
        (0..100_000).map(|i| format!("float f{i}(float x) {{ return x * {i}.0 + 1.0; }}\n")).collect();
    let program = functions + "void mainImage(out vec4 o, in vec2 p) { o = vec4(f99999(p.x)); }\n";
    assert_eq!(diagnose(&program), []);
}
