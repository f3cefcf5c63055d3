//! Prints what a frame of the editor costs. The figures are informative; no limit is checked.
//!
//! `cargo test --lib editor::cost -- --ignored --nocapture`

use super::{
    EditorAction, Motion,
    look::{Help, Look, Mark, NO_DEBUG},
    selection::{Carets, Selection},
    view::CodeEditor,
};
use crate::{
    diag::SourceId,
    glsl::{PassKind, PassSource, Text, services::Analysis},
};
use egui::{Event, Id, RawInput, Rect, pos2, vec2};
use std::time::Instant;

fn frame(ctx: &egui::Context, editor: &mut CodeEditor, wraps: bool, events: Vec<Event>) -> f64 {
    frame_with(ctx, editor, (wraps, &[], None), events)
}

/// Draws a frame with messages next to its lines, and with an analysis of the text.
fn frame_with(
    ctx: &egui::Context,
    editor: &mut CodeEditor,
    (wraps, marks, help): (bool, &[Mark], Option<Help<'_>>),
    events: Vec<Event>,
) -> f64 {
    let look = Look {
        name: "Code",
        font_size: 13.0,
        wraps,
        marks,
        matches: &[],
        shared: "",
        help,
        debug: &NO_DEBUG,
        costs: &[],
    };
    let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(700.0, 700.0)));
    let input = RawInput { screen_rect, events, focused: true, ..Default::default() };
    let start = Instant::now();
    let mut output = ctx.run_ui(input, |ui| {
        editor.show(ui, Id::unique("editor"), look, &|_| None);
    });
    let triangles = ctx.tessellate(std::mem::take(&mut output.shapes), output.pixels_per_point);
    let millis = start.elapsed().as_secs_f64() * 1000.0;
    assert!(!triangles.is_empty());
    output.textures_delta.set.clear();
    output.textures_delta.free.clear();
    millis
}

fn median(mut list: Vec<f64>) -> f64 {
    list.sort_by(f64::total_cmp);
    list[list.len() / 2]
}

const CODE: &str = "    vec3 c = mix(iResolution, vec3(0.5), sin(iTime)); // ";

fn lines(count: usize) -> String {
    (0..count).map(|i| format!("{CODE}{i}\n")).collect()
}

/// Returns one line of this number of bytes.
fn line(bytes: usize) -> String {
    CODE.replace("//", "+").trim_start().repeat(bytes / 50 + 1).chars().take(bytes).collect()
}

#[test]
#[ignore = "prints times; they mean something on a quiet machine only"]
fn a_frame_idle_and_typing() {
    let texts = [
        ("142 lines", lines(142)),
        ("17,000 lines", lines(17_000)),
        ("10 MB in lines", lines(170_000)),
        ("a line of 100,000", line(100_000)),
        ("a line of 1 MB", line(1_000_000)),
        ("a line of 10 MB", line(10_000_000)),
    ];
    for (name, text, wraps) in texts.iter().flat_map(|(name, text)| [(name, text, false), (name, text, true)]) {
        let ctx = egui::Context::default();
        let start = Instant::now();
        let mut editor = CodeEditor::new(text);
        let count = editor.buffer.line_count();
        editor.go_to(count / 2, if count < 3 { text.len() / 2 } else { 4 });
        let frames = |editor: &mut CodeEditor, n, events: &[Event]| -> Vec<f64> {
            (0..n).map(|_| frame(&ctx, editor, wraps, events.to_vec())).collect()
        };
        frames(&mut editor, 1, &[]);
        let opened = start.elapsed().as_secs_f64() * 1000.0;
        frames(&mut editor, 8, &[]);
        let idle = median(frames(&mut editor, 20, &[]));
        let typing = median(frames(&mut editor, 20, &[Event::Text("x".into())]));
        assert_ne!(editor.buffer.text(), text, "the letters arrived");
        let name = format!("{name}{}", if wraps { ", wrapped" } else { "" });
        println!("{name:28}: opened in {opened:7.1} ms, idle {idle:6.2} ms, typing {typing:6.2} ms a frame");
    }
}

/// Measures typing as in the window: a shader of 17,000 lines, coloured and explained by its analysis, with messages.
#[test]
#[ignore = "prints times; they mean something on a quiet machine only"]
fn a_frame_typing_in_a_text_that_is_known() {
    let text = format!(
        "void mainImage(out vec4 o, in vec2 p) {{\n{}o = vec4(1.0);\n}}\n",
        lines(17_000).replace(
            "vec3 c = mix(iResolution, vec3(0.5), sin(iTime));",
            "{ vec3 c = mix(iResolution, vec3(0.5), sin(iTime)); }",
        )
    );
    let id = SourceId(0);
    let start = Instant::now();
    let analysis = Analysis::new(&PassSource::new(PassKind::Image, Text { id, text: &text }));
    let analysed = start.elapsed().as_secs_f64() * 1000.0;
    let classes = analysis.classes(id);
    let mark = |line: usize| Mark {
        line,
        range: 0..0,
        severity: crate::diag::Severity::Warning,
        message: "what is wrong in this line, and how to mend it".into(),
        hints: Vec::new(),
        has_fix: false,
    };
    for step in [17_000, 170, 17] {
        let marks: Vec<Mark> = (0..17_000).step_by(step).map(mark).collect();
        let ctx = egui::Context::default();
        let mut editor = CodeEditor::new(&text);
        editor.go_to(8_500, 4);
        let known = |editor: &mut CodeEditor, n: usize, events: &[Event]| -> Vec<f64> {
            let help = || Some(Help { analysis: &analysis, source: id, classes: &classes, text: &text });
            (0..n).map(|_| frame_with(&ctx, editor, (false, &marks, help()), events.to_vec())).collect()
        };
        known(&mut editor, 8, &[]);
        let idle = median(known(&mut editor, 20, &[]));
        let typing = median(known(&mut editor, 20, &[Event::Text("x".into())]));
        assert_ne!(editor.buffer.text(), text, "the letters arrived");
        println!(
            "17,000 lines, analysed in {analysed:.0} ms, {} messages: idle {idle:6.2} ms, typing {typing:6.2} ms a frame",
            marks.len()
        );
    }
}

#[test]
#[ignore = "prints times; they mean something on a quiet machine only"]
fn a_frame_typing_with_folds_and_many_carets() {
    let block = "void f() {\n".to_owned() + &lines(8) + "}\n";
    for carets in [1, 2, 100, 1700] {
        for folds in [false, true] {
            let ctx = egui::Context::default();
            let mut editor = CodeEditor::new(&block.repeat(1_700));
            frame(&ctx, &mut editor, false, Vec::new());
            if folds {
                editor.act(EditorAction::FoldAll);
            }
            let at = |i: usize| Selection::caret(editor.buffer.line_range(i * 17_000 / carets).start);
            let list = (0..carets).map(at).collect();
            editor.buffer.set_carets(Carets::new(list, 0));
            editor.focus();
            editor.act(EditorAction::Go(Motion::Home));
            for _ in 0..4 {
                frame(&ctx, &mut editor, false, Vec::new());
            }
            let typing = (0..20).map(|_| frame(&ctx, &mut editor, false, vec![Event::Text("x".into())])).collect();
            println!("17,000 lines, {carets} carets, folded: {folds}: {:6.2} ms a frame", median(typing));
        }
    }
}

/// Counted in bytes, so that it is the same on every machine: the cost of typing a letter does not grow with the line
/// or the text.
#[test]
fn typing_costs_the_visible_text_and_its_surroundings() {
    let in_sight = 40 * 2 * 2 * super::pieces::PIECE;
    for (text, column) in [
        (lines(3_000), 4),
        (line(100_000), 50_000),
        (line(1_000_000), 999_999),
        (format!("{}\n", line(20_000)).repeat(50), 9_000),
        ("é".repeat(300_000), 150_000),
        ("/*".repeat(300_000), 150_000),
    ] {
        for wraps in [false, true] {
            let ctx = egui::Context::default();
            let mut editor = CodeEditor::new(&text);
            editor.go_to(editor.buffer.line_count() / 2, column);
            for _ in 0..4 {
                frame(&ctx, &mut editor, wraps, Vec::new());
            }
            assert_eq!(editor.work.scanned, 0, "nothing has changed");
            let caret = editor.buffer.selection().head;
            frame(&ctx, &mut editor, wraps, vec![Event::Text("x".into())]);
            assert_eq!(editor.buffer.text().as_bytes()[caret], b'x');
            let super::view::Work { scanned, laid_out } = editor.work;
            assert!(scanned > 0 && scanned < 8 * super::pieces::PIECE, "{scanned} bytes scanned for a letter");
            assert!(laid_out > 0 && laid_out < in_sight, "{laid_out} bytes laid out");
        }
    }
}

/// Typing at many carets costs as much as the length of their lines, not of the text between them.
#[test]
fn typing_at_many_carets_scans_only_their_lines() {
    let ctx = egui::Context::default();
    let mut editor = CodeEditor::new(&lines(17_000));
    frame(&ctx, &mut editor, false, Vec::new());
    let at = |i: usize| Selection::caret(editor.buffer.line_range(i * 170).start);
    let list = (0..100).map(at).collect();
    editor.buffer.set_carets(Carets::new(list, 0));
    editor.focus();
    editor.act(EditorAction::Go(Motion::Home));
    for _ in 0..3 {
        frame(&ctx, &mut editor, false, Vec::new());
    }
    frame(&ctx, &mut editor, false, vec![Event::Text("x".into())]);
    assert_eq!(editor.buffer.text().matches("\n    xvec3").count(), 99);
    assert!((1..100 * 100).contains(&editor.work.scanned), "{} bytes scanned", editor.work.scanned);
}
