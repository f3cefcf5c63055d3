//! Maps places of a text to points of the window and back, in lines of many pieces.

use super::{super::history::Kind, *};
use egui::RawInput;

/// Lays out the first line of a text, scrolled right by this number of points, in a window 600 points wide.
fn with_lines(text: &str, scrolled: f32, check: impl Fn(&Lines<'_>, &Buffer)) {
    let ctx = egui::Context::default();
    let window = Rect::from_min_size(Pos2::ZERO, vec2(600.0, 100.0));
    let input = RawInput { screen_rect: Some(window), ..Default::default() };
    for _ in 0..2 {
        let mut output = ctx.run_ui(input.clone(), |ui| {
            let font = FontId::monospace(13.0);
            let (row_height, glyph) = ui.fonts_mut(|f| (f.row_height(&font), f.glyph_width(&font, '0')));
            let mut buffer = Buffer::new("");
            buffer.replace(0..0, text, Kind::Other);
            let mut index = Highlight::default();
            ui.fonts_mut(|f| index.update(&mut buffer, "", &mut |c| f.glyph_width(&font, c) / glyph));
            let origin = pos2(-scrolled, 0.0);
            let folding = Rows::default();
            let mut lines = Lines {
                index: &index,
                folding: &folding,
                origin,
                row_height,
                glyph,
                font,
                palette: &crate::gui::theme::DARK,
                first: 0,
                rows: Vec::new(),
            };
            lines.lay_out(ui, &buffer, None, "", 0..buffer.line_count().min(5), window);
            check(&lines, &buffer);
        });
        output.textures_delta.clear();
    }
}

#[test]
fn positions_round_trip_through_window_points() {
    let words = "vec3 c = mix(a, \tvec3(0.5), sin(iTime)); é ";
    for text in [words.to_owned(), words.repeat(400), "x".repeat(30_000), "é".repeat(9_000)] {
        for part in [0.0f32, 0.3, 0.9] {
            let scrolled = (text.chars().count() as f32 * 7.0 * part).floor();
            with_lines(&text, scrolled, |lines, buffer| {
                let bytes = lines.rows[0].bytes().unwrap();
                let mut left = f32::NEG_INFINITY;
                for (at, _) in text.char_indices().filter(|(i, _)| bytes.contains(i)) {
                    let rect = lines.rect_of(buffer, at);
                    // Pieces follow each other without a gap, as letters do within one.
                    let step = rect.left() - left;
                    let is_even = left == f32::NEG_INFINITY || (step > 0.5 * lines.glyph && step < 4.6 * lines.glyph);
                    assert!(is_even, "{step} points from the letter before to the one at {at}");
                    left = rect.left();
                    let point = rect.left_center() + vec2(0.3, 0.0);
                    assert_eq!(lines.position_at(buffer, point), at);
                }
            });
        }
    }
}

#[test]
fn text_out_of_view_has_a_position() {
    let text = "vec3 c; ".repeat(5_000);
    with_lines(&text, 150_000.0, |lines, buffer| {
        let row = &lines.rows[0];
        assert!(row.runs.len() <= 2 && row.bytes().unwrap().len() < 5 * pieces::PIECE);
        let end = lines.rect_of(buffer, text.len()).left();
        assert!((end - lines.end(row)).abs() < 1.0);
        assert_eq!(lines.position_at(buffer, pos2(end + 50.0, 3.0)), text.len());
        assert_eq!(lines.position_at(buffer, pos2(lines.rect_of(buffer, 0).left() - 9.0, 3.0)), 0);
        let middle = lines.rect_of(buffer, 20_004).left();
        assert_eq!(lines.position_at(buffer, pos2(middle, 3.0)), 20_004);
    });
}

#[test]
fn a_selection_of_ten_million_letters_is_clipped_to_the_view() {
    let text = "ab ".repeat(3_400_000);
    with_lines(&text, 40_000_000.0, |lines, buffer| {
        let (left, right) = lines.span(buffer, 0, &(0..text.len())).unwrap();
        assert!(left > -20_000.0 && right < 20_600.0 && right - left > 600.0, "{left} to {right}");
        assert_eq!(lines.span(buffer, 0, &(0..10)), None);
        let galleys: Vec<_> = lines.rows[0].runs.iter().map(|r| (r.x, f64::from(r.galley.size().x))).collect();
        for pair in galleys.windows(2) {
            assert!((pair[0].0 + pair[0].1 - pair[1].0).abs() < 0.6, "{pair:?}");
        }
    });
}

#[test]
fn touching_ranges_are_found_by_binary_search() {
    let list = [0..2, 5..6, 8..12, 20..21];
    assert_eq!(touching(&list, &(6..8)), [5..6, 8..12]);
    assert!(touching(&list, &(13..19)).is_empty());
    assert_eq!(touching(&list, &(0..99)), list);
}
