//! No input may panic, hang or overflow the stack: long and deep programs, and valid ones with pieces removed.

use super::checked;
use crate::{ChannelKind, PassKind};
use std::fmt::Write;

const CHANNELS: [ChannelKind; 4] = [ChannelKind::Sampler2D; 4];

fn image(code: &str) -> (bool, String) {
    let (_, failed, messages) = checked(PassKind::Image, CHANNELS, None, code);
    (failed, messages)
}

#[test]
fn long_programs_do_not_overflow_the_stack() {
    let mut chain = String::from("void mainImage(out vec4 c, in vec2 f) { float x = f.x; c = vec4(x");
    for i in 0..20_000 {
        let _ = write!(chain, " + x * {i}.0");
    }
    chain.push_str("); }");
    let (failed, messages) = image(&chain);
    assert!(!failed, "{messages}");
    let mut calls = String::from("float f0(float x) { return x; }\n");
    for i in 1..20_000 {
        let _ = writeln!(calls, "float f{i}(float x) {{ return f{}(x); }}", i - 1);
    }
    calls.push_str("void mainImage(out vec4 c, in vec2 f) { c = vec4(f19999(f.x)); }");
    let (failed, messages) = image(&calls);
    assert!(!failed, "{messages}");
    let mut structs = String::from("struct S0 { float x[1000]; };\n");
    for i in 1..3_000 {
        let _ = writeln!(structs, "struct S{i} {{ S{} a[1000]; }};", i - 1);
    }
    let (failed, messages) = image(&structs);
    assert!(failed && messages.contains("16 MiB") && messages.contains("nested"));
}

/// Pseudo-random numbers with a fixed seed.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end.max(1)
    }
}

#[test]
fn damaged_programs_do_not_panic() {
    let texts = [4, 5, 6, 7, 8].map(|i| {
        std::fs::read_to_string(format!("{}/check/tests/spec/section_{i}.glsl", env!("CARGO_MANIFEST_DIR"))).unwrap()
    });
    let cases: Vec<&str> = texts
        .iter()
        .flat_map(|text| text.split("\n//"))
        .filter_map(|case| case.split_once('\n'))
        .map(|(_, code)| code)
        .collect();
    let rounds = std::env::var("EDDY_TORN_ROUNDS").ok().and_then(|n| n.parse().ok()).unwrap_or(2_000);
    let mut random = Random(7);
    for _ in 0..rounds {
        // Splits two programs into words, some of which are removed, repeated or swapped.
        let mut words: Vec<&str> = Vec::new();
        for _ in 0..2 {
            let case = cases[random.below(cases.len())];
            words.extend(case.split_inclusive([' ', '(', ')', ';', '{', '}', '.', ',', '[', ']']));
        }
        for _ in 0..1 + random.below(5) {
            let (a, b) = (random.below(words.len()), random.below(words.len()));
            match random.below(4) {
                0 => drop(words.remove(a)),
                1 => words.insert(a, words[b]),
                2 => words.swap(a, b),
                _ => words[a] = words[b],
            }
        }
        image(&words.concat());
    }
}
