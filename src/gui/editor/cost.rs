//! What a frame of the editor costs: figures to read, not a bound to keep.
//!
//! `cargo test --lib editor::cost -- --ignored --nocapture`

use super::view::{CodeEditor, Look};
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

#[test]
#[ignore = "prints times; they mean something on a quiet machine only"]
fn a_frame_idle_and_typing() {
    for lines in [142, 2_000, 17_000] {
        let text: String = (0..lines)
            .map(|i| format!("    vec3 c{i} = mix(iResolution, vec3(0.{i}), sin(iTime)); // {i}\n"))
            .collect();
        let ctx = egui::Context::default();
        let mut editor = CodeEditor::new(&text);
        editor.go_to(lines / 2, 4);
        for _ in 0..8 {
            frame(&ctx, &mut editor, Vec::new());
        }
        let idle = median((0..40).map(|_| frame(&ctx, &mut editor, Vec::new())).collect());
        let typing = median((0..40).map(|_| frame(&ctx, &mut editor, vec![Event::Text("x".into())])).collect());
        assert_ne!(editor.buffer.text(), text, "the letters arrived");
        println!("{lines:6} lines: idle {idle:.2} ms, typing {typing:.2} ms a frame");
    }
}
