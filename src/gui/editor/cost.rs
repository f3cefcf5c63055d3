//! These tests print what a frame of the editor costs. The figures are for reading and bound nothing.
//!
//! `cargo test --lib editor::cost -- --ignored --nocapture`

use super::{look::Look, view::CodeEditor};
use egui::{Event, Id, RawInput, Rect, pos2, vec2};
use std::time::Instant;

fn frame(ctx: &egui::Context, editor: &mut CodeEditor, events: Vec<Event>) -> f64 {
    let look = Look { font_size: 13.0, marks: &[], matches: &[], shared: "", help: None };
    let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(700.0, 700.0)));
    let input = RawInput { screen_rect, events, focused: true, ..Default::default() };
    let began = Instant::now();
    let mut output = ctx.run_ui(input, |ui| {
        editor.show(ui, Id::unique("editor"), look);
    });
    let triangles = ctx.tessellate(std::mem::take(&mut output.shapes), output.pixels_per_point);
    let millis = began.elapsed().as_secs_f64() * 1000.0;
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

/// One line of so many bytes.
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
    for (name, text) in texts {
        let ctx = egui::Context::default();
        let began = Instant::now();
        let mut editor = CodeEditor::new(&text);
        let count = editor.buffer.line_count();
        editor.go_to(count / 2, if count < 3 { text.len() / 2 } else { 4 });
        let frames = |editor: &mut CodeEditor, n, events: &[Event]| -> Vec<f64> {
            (0..n).map(|_| frame(&ctx, editor, events.to_vec())).collect()
        };
        frames(&mut editor, 1, &[]);
        let opened = began.elapsed().as_secs_f64() * 1000.0;
        frames(&mut editor, 8, &[]);
        let idle = median(frames(&mut editor, 20, &[]));
        let typing = median(frames(&mut editor, 20, &[Event::Text("x".into())]));
        assert_ne!(editor.buffer.text(), text, "the letters arrived");
        println!("{name:18}: opened in {opened:7.1} ms, idle {idle:6.2} ms, typing {typing:6.2} ms a frame");
    }
}

/// Counted in bytes, so that it is the same on every machine: what a letter costs does not grow with the line or the
/// text.
#[test]
fn a_letter_lays_out_what_is_in_sight_and_looks_at_what_is_around_it() {
    let in_sight = 40 * 2 * 2 * super::pieces::PIECE;
    for (text, column) in [
        (lines(3_000), 4),
        (line(100_000), 50_000),
        (line(1_000_000), 999_999),
        (format!("{}\n", line(20_000)).repeat(50), 9_000),
        ("é".repeat(300_000), 150_000),
        ("/*".repeat(300_000), 150_000),
    ] {
        let ctx = egui::Context::default();
        let mut editor = CodeEditor::new(&text);
        editor.go_to(editor.buffer.line_count() / 2, column);
        for _ in 0..4 {
            frame(&ctx, &mut editor, Vec::new());
        }
        assert_eq!(editor.work.scanned, 0, "nothing has changed");
        let caret = editor.buffer.selection().head;
        frame(&ctx, &mut editor, vec![Event::Text("x".into())]);
        assert_eq!(editor.buffer.text().as_bytes()[caret], b'x');
        let super::view::Work { scanned, laid_out } = editor.work;
        assert!(scanned > 0 && scanned < 8 * super::pieces::PIECE, "{scanned} bytes scanned for a letter");
        assert!(laid_out > 0 && laid_out < in_sight, "{laid_out} bytes laid out");
    }
}
