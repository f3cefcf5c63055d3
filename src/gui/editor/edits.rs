//! Edits are what the editor's keys do to a text: typing, indenting, comments, whole lines.

use super::{buffer::Buffer, history::Kind, motion::Motion, selection::Selection};
use std::ops::Range;

const INDENT: &str = "    ";

impl Buffer {
    /// Types text over the selection.
    pub fn insert(&mut self, text: &str) {
        let kind = if text.chars().count() == 1 { Kind::Typing } else { Kind::Other };
        // A closing brace alone on its line goes back one step.
        if text == "}" && self.selection.is_empty() {
            let line = self.line_range(self.line_of(self.selection.head));
            let before = &self.text()[line.start..self.selection.head];
            if !before.is_empty() && before.trim().is_empty() {
                let kept = before.len() - unit_at_end(before);
                self.replace(line.start + kept..self.selection.head, text, Kind::Other);
                return;
            }
        }
        self.replace(self.selection.range(), text, kind);
    }

    /// Pastes: line ends become the file's own.
    pub fn paste(&mut self, text: &str) {
        let text = text.replace("\r\n", "\n").replace('\r', "\n");
        let text = if self.line_end() == "\n" { text } else { text.replace('\n', "\r\n") };
        self.replace(self.selection.range(), &text, Kind::Other);
    }

    /// Enter: the new line is indented as this one, one step more after an opening brace.
    pub fn new_line(&mut self) {
        let range = self.selection.range();
        let line = self.line_range(self.line_of(range.start));
        let before = &self.text()[line.start..range.start];
        let indent = before[..before.len() - before.trim_start().len()].to_owned();
        let opens = before.trim_end().ends_with(['{', '(']);
        let closes = self.text()[range.end..].starts_with(['}', ')']);
        let end = self.line_end();
        let mut text = format!("{end}{indent}");
        if opens {
            text.push_str(unit_of(&indent));
        }
        let caret = range.start + text.len();
        if opens && closes {
            text.push_str(end);
            text.push_str(&indent);
        }
        self.replace_selecting(range, &text, Selection::caret(caret), Kind::Other);
    }

    /// Backspace and Delete: the selection, or what `motion` passes over.
    pub fn delete(&mut self, motion: Motion) {
        let mut range = self.selection.range();
        if range.is_empty() {
            let to = self.target(motion, range.start);
            range = range.start.min(to)..range.start.max(to);
            // Backspace in the indent takes a step of it.
            let line = self.line_range(self.line_of(range.end));
            let before = &self.text()[line.start..range.end.max(line.start)];
            if motion == Motion::Left && before.len() > 1 && before.bytes().all(|b| b == b' ') {
                range.start = range.end - unit_at_end(before);
            }
        }
        let kind = if self.selection.is_empty() { Kind::Deleting } else { Kind::Other };
        self.replace(range, "", kind);
    }

    /// Tab: indents the lines of a selection, or adds spaces up to the next stop.
    pub fn indent(&mut self) {
        let range = self.selection.range();
        if self.line_of(range.start) == self.line_of(range.end) {
            let (_, column) = self.line_column(range.start);
            let spaces = INDENT.len() - column % INDENT.len();
            self.replace(range, &INDENT[..spaces], Kind::Other);
        } else {
            self.edit_lines(|line| if line.trim().is_empty() { line.to_owned() } else { format!("{INDENT}{line}") });
        }
    }

    /// Shift+Tab: takes one step of indent from every line of the selection.
    pub fn unindent(&mut self) {
        self.edit_lines(|line| {
            let spaces = line.len() - line.trim_start_matches(' ').len();
            let cut = if line.starts_with('\t') { 1 } else { spaces.min(INDENT.len()) };
            line[cut..].to_owned()
        });
    }

    /// Ctrl+/: turns every line of the selection into a comment, or back if all are.
    pub fn toggle_comment(&mut self) {
        let range = self.selected_lines();
        let lines: Vec<&str> = range.clone().map(|l| self.line(l)).filter(|l| !l.trim().is_empty()).collect();
        let all = !lines.is_empty() && lines.iter().all(|l| l.trim_start().starts_with("//"));
        let depth = lines.iter().map(|l| l.len() - l.trim_start().len()).min().unwrap_or(0);
        self.edit_lines(|line| {
            let body = line.trim_start();
            if line.trim().is_empty() {
                line.to_owned()
            } else if all {
                let rest = body[2..].strip_prefix(' ').unwrap_or(&body[2..]);
                format!("{}{rest}", &line[..line.len() - body.len()])
            } else {
                format!("{}// {}", &line[..depth], &line[depth..])
            }
        });
    }

    /// Alt+Shift+Down: a copy of the selected lines below them.
    pub fn duplicate_lines(&mut self) {
        let lines = self.selected_lines();
        let range = self.line_range(lines.start).start..self.line_range(lines.end - 1).end;
        let copy = format!("{}{}", self.line_end(), &self.text()[range.clone()]);
        let by = copy.len();
        let Selection { anchor, head } = self.selection;
        self.replace_selecting(
            range.end..range.end,
            &copy,
            Selection { anchor: anchor + by, head: head + by },
            Kind::Other,
        );
    }

    /// Returns what Ctrl+C takes: the selection, or the caret's whole line.
    pub fn copied_range(&self) -> Range<usize> {
        let range = self.selection.range();
        if !range.is_empty() {
            return range;
        }
        let line = self.line_of(range.start);
        let start = self.line_range(line).start;
        let end = if line + 1 < self.line_count() { self.line_range(line + 1).start } else { self.text().len() };
        start..end
    }

    /// Lines the selection touches; a selection that ends at a line's start does not touch it.
    fn selected_lines(&self) -> Range<usize> {
        let range = self.selection.range();
        let first = self.line_of(range.start);
        let mut last = self.line_of(range.end);
        if last > first && self.line_range(last).start == range.end {
            last -= 1;
        }
        first..last + 1
    }

    /// Changes every selected line as one step, and keeps the ends of the selection at their letters.
    fn edit_lines(&mut self, change: impl Fn(&str) -> String) {
        let lines = self.selected_lines();
        let Selection { anchor, head } = self.selection;
        let ends = [self.line_column(anchor), self.line_column(head)];
        let lengths: Vec<usize> = ends.iter().map(|(line, _)| self.line(*line).chars().count()).collect();
        self.begin_group();
        for line in lines {
            let old = self.line(line).to_owned();
            let new = change(&old);
            if new != old {
                self.replace(self.line_range(line), &new, Kind::Other);
            }
        }
        self.end_group();
        let moved: Vec<usize> = ends
            .iter()
            .zip(lengths)
            .map(|((line, column), was)| {
                let now = self.line(*line).chars().count();
                // Column 0 of a line stays: a selection of whole lines goes on being one.
                let column = if *column == 0 { 0 } else { (column + now).saturating_sub(was) };
                self.position(*line, column)
            })
            .collect();
        self.selection = Selection { anchor: moved[0], head: moved[1] };
    }
}

/// One step of indent in the style of a line's own.
fn unit_of(indent: &str) -> &'static str {
    if indent.starts_with('\t') {
        "\t"
    } else if indent.len() % 4 == 2 {
        "  "
    } else {
        INDENT
    }
}

/// Bytes of the last step of an indent.
fn unit_at_end(indent: &str) -> usize {
    if indent.ends_with('\t') {
        1
    } else {
        let spaces = indent.len() - indent.trim_end_matches(' ').len();
        let over = spaces % INDENT.len();
        if over == 0 { spaces.min(INDENT.len()) } else { over }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(text: &str, anchor: usize, head: usize) -> Buffer {
        let mut b = Buffer::new(text);
        b.select(anchor, head);
        b
    }

    #[test]
    fn enter_keeps_the_indent_and_opens_a_block() {
        let mut b = with("    if (x) {}", 12, 12);
        b.new_line();
        assert_eq!(b.text(), "    if (x) {\n        \n    }");
        assert_eq!(b.line_column(b.selection().head), (1, 8));
        b.insert("}");
        assert_eq!(b.line(1), "    }");
    }

    #[test]
    fn comments_come_and_go_as_one_step() {
        let text = "  a;\n\n    b;\nc;";
        let mut b = with(text, 0, 10);
        b.toggle_comment();
        assert_eq!(b.text(), "  // a;\n\n  //   b;\nc;");
        b.toggle_comment();
        assert_eq!(b.text(), text);
        b.undo();
        b.undo();
        assert_eq!(b.text(), text);
        assert!(!b.undo());
    }

    #[test]
    fn tab_indents_a_selection_and_comes_back() {
        let mut b = with("a\nb\nc", 0, 3);
        b.indent();
        assert_eq!(b.text(), "    a\n    b\nc");
        b.unindent();
        assert_eq!(b.text(), "a\nb\nc");
        let mut b = with("ab", 2, 2);
        b.indent();
        assert_eq!(b.text(), "ab  ");
    }

    #[test]
    fn backspace_takes_a_step_of_the_indent_or_a_letter() {
        let mut b = with("        x", 8, 8);
        b.delete(Motion::Left);
        assert_eq!(b.text(), "    x");
        let mut b = with("a\r\nb", 3, 3);
        b.delete(Motion::Left);
        assert_eq!(b.text(), "ab");
        let mut b = with("one two", 7, 7);
        b.delete(Motion::WordLeft);
        assert_eq!(b.text(), "one ");
        let mut b = with("", 0, 0);
        b.delete(Motion::Left);
        b.delete(Motion::Right);
        assert!(!b.undo(), "nothing happened, so there is nothing to undo");
    }

    #[test]
    fn pasted_lines_take_the_files_ends() {
        let mut b = with("a\r\nb", 4, 4);
        b.paste("x\ny\r\nz");
        assert_eq!(b.text(), "a\r\nbx\r\ny\r\nz");
        assert_eq!(with("a\nb", 0, 0).copied_range(), 0..2);
        let mut b = with("a\nb", 2, 2);
        b.duplicate_lines();
        assert_eq!(b.text(), "a\nb\nb");
        assert_eq!(b.selection().head, 4);
    }
}
