//! The sums of counters against the walker, which sees each operation.

use super::*;
use crate::{
    ir::{FuncId, Output, Value},
    walk::{EntryInputs, Machine, Observer, View, tests::Bare},
};
use std::collections::HashMap;

/// Counts the values that a pixel computes, and keeps what it outputs.
#[derive(Default)]
struct Seen {
    computed: HashMap<(FuncId, Value), i64>,
    counters: Vec<u32>,
}

impl Observer<f32> for Seen {
    fn value(&mut self, view: &View<'_, '_, f32>, value: Value) {
        *self.computed.entry((view.function_id(), value)).or_default() += 1;
    }

    fn output(&mut self, view: &View<'_, '_, f32>, _: Output, value: Value) {
        self.counters.extend(view.value(value).iter().map(|cell| cell.bits()));
    }
}

fn prepared(code: &str) -> Prepared {
    compile::prepare_counting(&PassSource::image(code), &Link::default(), None).expect("no errors").0
}

/// Compares the sums of each block with the walker at each pixel of 8x4, and returns the table.
fn check(code: &str) -> CountTable {
    let prepared = prepared(code);
    let program = prepared.variant(0..prepared.table.counters);
    ir::verify::verify(&program).unwrap_or_else(|reason| panic!("{reason}\n{}", ir::print::print(&program)));
    for pixel in (0..32).map(|n| (n % 8, n / 8)) {
        let mut seen = Seen::default();
        let world = Bare::default();
        let mut machine = Machine::<f32>::new(&program, &world, EntryInputs::of_pixel(pixel), 1_000_000);
        machine.run(Machine::<f32>::lane_of(pixel), &mut seen).expect("it ends");
        for (function, placed) in prepared.placed.iter().enumerate() {
            for &(value, block) in placed {
                let computed = seen.computed.get(&(FuncId::new(function), value)).copied().unwrap_or(0);
                let counted = prepared.table.blocks[block].runs.of(&seen.counters);
                assert_eq!(counted, computed, "{value:?} of function {function} at {pixel:?} of {code}");
            }
        }
    }
    prepared.table
}

/// Returns the table of `mainImage` with this body.
fn of_body(body: &str) -> CountTable {
    check(&format!("void mainImage(out vec4 o, vec2 p) {{ float s = 0.0; {body} o = vec4(s); }}"))
}

#[test]
fn few_counters_give_all_counts() {
    let cases = [
        ("s = p.x;", 0),
        ("if (p.x > 3.0) s = 1.0;", 1),
        ("if (p.x > 3.0) s = sin(p.y); else s = cos(p.y);", 1),
        ("s = p.x > 3.0 ? sin(p.y) : cos(p.y);", 1),
        // The exit of a loop with one exit follows from the entries.
        ("for (int i = 0; i < int(p.x); i++) s += sin(s);", 1),
        ("for (int i = 0; i < int(p.x); i++) { s += sin(s); if (s > 2.0) break; s += 1.0; }", 3),
        ("for (int i = 0; i < int(p.x); i++) { if (i == 2) continue; s += sin(p.y); }", 2),
        ("for (int i = 0; i < int(p.x); i++) for (int j = 0; j < i; j++) s += sin(p.y);", 2),
        ("int i = 0; do { s += sin(p.y); i++; } while (i < int(p.x));", 1),
        ("if (p.x > 1.0 && sin(p.y) > 0.0 || cos(p.x) > 0.5) s = 1.0;", 3),
        ("switch (int(p.x)) { case 1: s = sin(p.y); break; case 2: case 3: s = cos(p.y); default: s += p.x; }", 5),
        ("for (int i = 0; i < 9; i++) { switch (i) { case 3: continue; case 4: s += sin(p.y); } s += sin(s); }", 4),
    ];
    for (body, counters) in cases {
        let table = of_body(body);
        assert!(table.counters <= counters, "{body}: {} counters", table.counters);
    }
}

#[test]
fn early_exits_and_functions_are_counted() {
    let table = check(
        "float f(float x) {
            if (x > 3.0) return sin(x);
            for (int i = 0; i < 9; i++) { x += cos(x); if (x > 5.0) return x; if (x < 0.5) { x += 1.0; continue; } x -= sin(x); }
            return x;
        }
        void mainImage(out vec4 o, vec2 p) {
            o = vec4(f(p.x), f(p.y), 0, 1);
            for (int i = 0; i < 3; i++) { if (f(p.x + float(i)) > 2.0) return; o.z += sin(p.x); }
            o *= 2.0;
        }",
    );
    assert_eq!(table.loops.len(), 2);
    let lines: Vec<u32> = table.loops.iter().map(|l| table.lines[l.line.unwrap() as usize].number).collect();
    assert_eq!(lines, [8, 3], "callers come first");
}

#[test]
fn discarded_pixels_output_their_counters() {
    let table = check(
        "float f(float x) { if (x > 5.0) discard; return sin(x); }
        float g(float x) { float s = 0.0; for (int i = 0; i < 9; i++) { s += f(x + float(i)); } return s; }
        void mainImage(out vec4 o, vec2 p) {
            o = vec4(f(p.y));
            for (float i = 0.0; i < g(p.x - 7.0); f(i), i++) { if (p.y > 3.0) discard; o += sin(i); }
            if (p.x < 2.0) { o.x += cos(p.y); discard; }
        }",
    );
    assert!(table.blocks.iter().filter(|block| block.discards).count() >= 3);
}

#[test]
fn operations_belong_to_the_lines_where_they_are_written() {
    let code = "#define TWICE(x) \\\n (sin(x) + sin(x * 2.0))\nfloat f(float x) {\n  return sqrt(x);\n}\nvoid mainImage(out vec4 o, vec2 p) {
        o = vec4(TWICE(p.x), f(p.y),
            p.x / p.y, 1.0);\n}";
    let table = check(code);
    let count = |line: u32, class: OpClass| -> u32 {
        let is_there =
            |work: &&Work| work.line.is_some_and(|l| table.lines[l as usize].number == line) && work.class == class;
        table.blocks.iter().flat_map(|block| &block.work).filter(is_there).map(|work| work.count).sum()
    };
    assert_eq!(count(7, OpClass::Sine), 2, "{:?}", table.blocks);
    assert_eq!(count(4, OpClass::SquareRoot), 1);
    assert_eq!(count(8, OpClass::Divide), 1);
    assert_eq!(count(7, OpClass::Divide), 0);
}

#[test]
fn what_repeats_an_operation_is_not_counted() {
    let sines = |body: &str| -> u32 {
        let work = of_body(body).blocks.into_iter().flat_map(|block| block.work);
        work.filter(|work| work.class == OpClass::Sine).map(|work| work.count).sum()
    };
    assert_eq!(sines("s = sin(p.x) * 2.0 + sin(p.x);"), 1);
    assert_eq!(sines("float t = p.x; s = sin(t); t = p.y; s += sin(t);"), 2);
    assert_eq!(sines("float t = p.x; s = sin(t); if (p.y > 2.0) t = p.y; s += sin(t);"), 2);
    assert_eq!(sines("s = sin(p.x); if (p.y > 2.0) s += sin(p.x);"), 1);
    assert_eq!(sines("if (p.y > 2.0) s = sin(p.x); s += sin(p.x);"), 2);
}

#[test]
fn counters_are_output_in_as_many_programs_as_needed() {
    let body: String = (0..9).map(|i| format!("if (p.x > {i}.0) s += sin(p.y + {i}.0);")).collect();
    let code = format!("void mainImage(out vec4 o, vec2 p) {{ float s = 0.0; {body} o = vec4(s); }}");
    let counting = Counting::new(&PassSource::image(&code), &Link::default(), None, 4).expect("no errors");
    assert_eq!((counting.table.counters, counting.variants.len()), (9, 3));
    assert_eq!(counting.counters_of(2), 8..9);
    counting.variants.iter().for_each(|variant| variant.validate().expect("it is valid"));
}

#[test]
fn small_constant_numbers_of_iterations_are_known() {
    let trips = |body: &str| of_body(body).loops[0].trips;
    assert_eq!(trips("for (int i = 0; i < 5; i++) s += sin(p.x + float(i));"), Some(5));
    assert_eq!(trips("for (float i = 1.0; i > 0.0; i -= 0.25) s += sin(p.x + i);"), Some(4));
    assert_eq!(trips("for (int i = 0; i < int(p.x); i++) s += sin(p.y);"), None);
    assert_eq!(trips("for (int i = 0; i < 500; i++) s += sin(p.y);"), None);
    assert_eq!(trips("for (int i = 0; i < 9; i++) { s += sin(p.y); if (p.x > 3.0) i++; }"), None);
}
