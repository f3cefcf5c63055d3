//! Random edits with several carets, compared with a plain text and a list of positions.

use super::{
    action::EditorAction as Action,
    buffer::Buffer,
    input,
    motion::{Motion, Vertical},
    selection::{Carets, Selection},
};
use std::ops::Range;

struct Random(u32);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as usize % count
    }

    fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    fn carets(&mut self, buffer: &Buffer) -> Carets {
        let end = buffer.text().len() + 1;
        let selection = |random: &mut Self| {
            let anchor = random.below(end);
            let far = random.of(&[0, 0, 1, 3, 20]);
            let head = if random.below(2) == 0 { anchor + far } else { anchor.saturating_sub(far) };
            Selection::new(buffer.snap(anchor), buffer.snap(head))
        };
        let count = 1 + self.below(4);
        let list: Vec<_> = (0..count).map(|_| selection(self)).collect();
        let main = self.below(count);
        Carets::new(list, main)
    }
}

const TEXTS: [&str; 3] = [
    "void mainImage(out vec4 o, in vec2 p)\n{\n    vec2 uv = p / iResolution.xy;\n\n    // é ü\n    o = vec4(uv, 0.0, 1.0);\n}\n",
    "a\r\n\tb {\r\n}\r\n\r\nlast",
    "",
];

fn check(buffer: &Buffer, what: &str) {
    let text = buffer.text();
    let starts: Vec<usize> = (0..buffer.line_count()).map(|l| buffer.line_range(l).start).collect();
    let wanted: Vec<usize> = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
    assert_eq!(starts, wanted, "{what}: lines of {text:?}");
    let mut end: Option<Range<usize>> = None;
    for s in buffer.carets().list() {
        let range = s.range();
        assert!(range.end <= text.len(), "{what}: {s:?} in {text:?}");
        assert!([s.anchor, s.head].iter().all(|at| buffer.snap(*at) == *at), "{what}: {s:?} is between letters");
        if let Some(before) = &end {
            let is_apart = range.start > before.end || (range.start == before.end && !range.is_empty());
            assert!(is_apart, "{what}: {:?}", buffer.carets());
        }
        end = Some(range);
    }
}

/// Every action that changes a text.
const ACTIONS: [Action; 22] = [
    Action::NewLine,
    Action::Indent,
    Action::Unindent,
    Action::ToggleComment,
    Action::MoveLines(Vertical::Up),
    Action::MoveLines(Vertical::Down),
    Action::CopyLines(Vertical::Up),
    Action::CopyLines(Vertical::Down),
    Action::DeleteLines,
    Action::Delete(Motion::Left),
    Action::Delete(Motion::Right),
    Action::Delete(Motion::WordLeft),
    Action::Delete(Motion::WordRight),
    Action::AddNext,
    Action::AddAll,
    Action::AddCaret(Vertical::Up),
    Action::AddCaret(Vertical::Down),
    Action::OneCaret,
    Action::Go(Motion::Lines(1)),
    Action::Select(Motion::Lines(-1)),
    Action::Select(Motion::WordRight),
    Action::Go(Motion::Home),
];

#[test]
fn random_edits_undo_and_redo_with_their_carets() {
    for (seed, text) in (0..60).flat_map(|seed| TEXTS.map(|text| (seed, text))) {
        let mut random = Random(seed);
        let mut buffer = Buffer::new(text);
        for _ in 0..60 {
            if random.below(3) > 0 {
                let carets = random.carets(&buffer);
                buffer.set_carets(carets);
            }
            // Text typed after this is a new step of undo.
            buffer.set_carets(buffer.carets().clone());
            let before = (buffer.text().to_owned(), buffer.carets().clone());
            let what = match random.below(4) {
                0 => {
                    let letter = random.of(&["x", "(", ")", "{", "}", " ", "é", "*", "/"]);
                    buffer.type_closing(letter, &|_, _| false);
                    format!("typed {letter}")
                }
                1 => {
                    let pasted = random.of(&["a\nb", "one", "x\r\ny\r\n", "\n"]);
                    buffer.paste(pasted);
                    format!("pasted {pasted:?}")
                }
                _ => {
                    let action = random.of(&ACTIONS);
                    input::act(&mut buffer, action);
                    format!("{action:?}")
                }
            };
            let what = format!("{what} in {before:?}, seed {seed}");
            check(&buffer, &what);
            let after = (buffer.text().to_owned(), buffer.carets().clone());
            if before.0 != after.0 {
                let mut back = buffer.clone();
                assert!(back.undo(), "{what}");
                assert_eq!((back.text(), back.carets()), (before.0.as_str(), &before.1), "undo of {what}");
                check(&back, &what);
                assert!(back.redo(), "{what}");
                assert_eq!((back.text(), back.carets()), (after.0.as_str(), &after.1), "redo of {what}");
            }
        }
        let last = buffer.text().to_owned();
        while buffer.undo() {
            check(&buffer, "undo");
        }
        assert_eq!(buffer.text(), text);
        while buffer.redo() {}
        assert_eq!(buffer.text(), last);
    }
}

/// Returns the text after an edit at every caret, computed naively from the last caret on.
fn by_hand(buffer: &Buffer, with: &str, part: impl Fn(&str, Selection) -> Range<usize>) -> String {
    let mut text = buffer.text().to_owned();
    let mut end = text.len();
    for s in buffer.carets().list().iter().rev() {
        let range = part(buffer.text(), *s);
        text.replace_range(range.start..range.end.min(end).max(range.start), with);
        end = range.start;
    }
    text
}

#[test]
fn edits_at_many_carets_match_a_naive_model() {
    for seed in 0..400 {
        let mut random = Random(seed);
        let mut buffer = Buffer::new(TEXTS[0]);
        for _ in 0..12 {
            let carets = random.carets(&buffer);
            buffer.set_carets(carets);
            let with = random.of(&["", "x", "two words", "é"]);
            let wanted = by_hand(&buffer, with, |_, s| s.range());
            let count = buffer.carets().list().len();
            buffer.insert(with);
            assert_eq!(buffer.text(), wanted, "seed {seed}");
            assert!(buffer.carets().list().len() <= count);
            // Each caret is after the text that was typed at it.
            assert!(buffer.carets().list().iter().all(|s| s.is_empty() && buffer.text()[..s.head].ends_with(with)));

            let carets = random.carets(&buffer);
            buffer.set_carets(carets.map(|s| Selection::caret(s.head)));
            let after =
                |text: &str, s: Selection| s.head..s.head + text[s.head..].chars().next().map_or(0, char::len_utf8);
            let wanted = by_hand(&buffer, "", after);
            buffer.delete(Motion::Right);
            assert_eq!(buffer.text(), wanted, "seed {seed}");
        }
    }
}

/// Moves lines from `first` to `last` past a neighbour, copies or deletes them, computed on a list of lines.
fn lines_by_hand(text: &str, lines: Range<usize>, action: Action) -> String {
    let mut list: Vec<&str> = text.split('\n').collect();
    match action {
        Action::MoveLines(Vertical::Up) if lines.start > 0 => list[lines.start - 1..lines.end].rotate_left(1),
        Action::MoveLines(Vertical::Down) if lines.end < list.len() => list[lines.start..=lines.end].rotate_right(1),
        Action::CopyLines(_) => {
            let copy = list[lines.clone()].to_vec();
            list.splice(lines.end..lines.end, copy);
        }
        Action::DeleteLines => drop(list.drain(lines)),
        _ => {}
    }
    list.join("\n")
}

#[test]
fn line_edits_match_a_list_of_lines() {
    for seed in 0..400 {
        let mut random = Random(seed);
        let mut buffer = Buffer::new(TEXTS[0]);
        for _ in 0..12 {
            let main = random.carets(&buffer).main();
            buffer.select(main.anchor, main.head);
            let lines = buffer.blocks()[0].clone();
            let action = random.of(&[
                Action::MoveLines(Vertical::Up),
                Action::MoveLines(Vertical::Down),
                Action::CopyLines(Vertical::Up),
                Action::CopyLines(Vertical::Down),
                Action::DeleteLines,
            ]);
            let wanted = lines_by_hand(buffer.text(), lines, action);
            input::act(&mut buffer, action);
            assert_eq!(buffer.text(), wanted, "{action:?}, seed {seed}");
        }
    }
}
