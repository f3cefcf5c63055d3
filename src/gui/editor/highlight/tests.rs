use super::super::{
    history::Kind,
    selection::{Carets, Selection},
};
use super::*;
use crate::glsl::services::Class;

impl Highlight {
    fn take(&mut self, buffer: &mut Buffer, shared: &str) -> usize {
        self.update(buffer, shared, &mut |_| 1.0)
    }

    fn kind(&self, line: usize, text: &str) -> Class {
        self.tokens(text, 0..text.len(), self.lines[line].state)[0].class
    }
}

#[test]
fn opening_a_comment_recolours_the_lines_below() {
    let mut b = Buffer::new("a\nb\nc\n");
    let mut h = Highlight::default();
    h.take(&mut b, "#define SHARED 1\n");
    assert_eq!(h.kind(2, "c"), Class::Unknown);
    assert_eq!(h.kind(2, "SHARED"), Class::Macro);
    b.replace(0..0, "/*", Kind::Other);
    h.take(&mut b, "");
    assert_eq!(h.kind(2, "c"), Class::Comment);
    b.replace(5..5, "*/\n", Kind::Other);
    h.take(&mut b, "");
    assert_eq!((h.kind(1, "b*/"), h.kind(2, "x")), (Class::Comment, Class::Unknown));
    assert_eq!(h.lines.len(), b.line_count());
    b.replace(0..b.text().len(), "", Kind::Other);
    h.take(&mut b, "");
    assert_eq!((h.lines.len(), h.columns()), (1, 0.0));
}

#[test]
fn index_matches_a_fresh_one_after_random_edits() {
    let mut text = String::new();
    for i in 0..40 {
        text.push_str(&format!("#define M{i} {i}\r\nfloat a{i}; /* {i} */\n{}\n", "g(x) + ".repeat(i * 30)));
    }
    let mut b = Buffer::new(&text);
    let mut h = Highlight::default();
    h.take(&mut b, "");
    let mut seed = 1u32;
    let mut random = |below: usize| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (seed >> 8) as usize % below
    };
    let texts = ["", "x", "\n", "\r\n", "/*", "*/", "//", "\\\n", "#define Q\n", "a\nb\nc\n", "é"];
    for round in 0..400 {
        // Several changes between two updates.
        for _ in 0..1 + round % 3 {
            let start = random(b.text().len() + 1);
            let end = (start + [0, 1, 40, 900][random(4)]).min(b.text().len());
            let (start, end) = (b.snap(start), b.snap(end));
            b.replace(start..end.max(start), texts[random(texts.len())], Kind::Other);
        }
        if round % 3 == 0 {
            // Several carets, whose lines alone are scanned if the number of lines is unchanged.
            h.take(&mut b, "");
            let mut selection = |_| {
                let at = random(b.text().len() + 1);
                Selection::new(at, at + random(2))
            };
            let list = (0..9).map(&mut selection).collect();
            b.set_carets(Carets::new(list, 0));
            b.insert(texts[random(texts.len())]);
        }
        if round % 7 == 0 {
            b.undo();
        }
        h.take(&mut b, "");
        let mut fresh = Highlight::default();
        fresh.take(&mut Buffer::new(b.text()), "");
        assert_eq!(h.lines.len(), fresh.lines.len());
        assert_eq!(h.macros, fresh.macros);
        for (line, (now, fresh)) in h.lines.iter().zip(&fresh.lines).enumerate() {
            assert_eq!((now.state, &now.defines), (fresh.state, &fresh.defines), "line {line} in round {round}");
            assert_eq!(now.cut.end.next_line(b.line(line)), fresh.cut.end.next_line(b.line(line)));
            assert!((now.columns - fresh.columns).abs() < 0.01, "{} and {}", now.columns, fresh.columns);
            assert_eq!(now.cut.pieces.iter().map(|p| p.len).sum::<usize>(), b.line(line).len());
        }
    }
}

#[test]
fn typing_cost_is_independent_of_line_and_text_length() {
    let line = "vec3 c = mix(iResolution, vec3(0.5), sin(iTime)); ";
    for text in [line.repeat(20_000), format!("{line}\n").repeat(20_000)] {
        let mut b = Buffer::new(&text);
        let mut h = Highlight::default();
        assert!(h.take(&mut b, "") >= text.len() - 20_000);
        for at in [0, text.len() / 2, text.len()] {
            let at = b.snap(at);
            b.replace(at..at, "x", Kind::Typing);
            let scanned = h.take(&mut b, "");
            assert!((1..8 * pieces::PIECE).contains(&scanned), "{scanned} bytes for a letter at {at}");
        }
        assert_eq!(h.take(&mut b, ""), 0);
    }
}
