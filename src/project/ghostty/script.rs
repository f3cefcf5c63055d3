//! The script of the simulated terminal: what is typed, what is printed and where the cursor goes, in a loop.

use std::sync::LazyLock;

/// The period of the loop in seconds.
pub const PERIOD: f64 = 16.0;

/// Text in one row of the terminal.
pub struct Span {
    pub row: u32,
    pub column: u32,
    pub text: &'static str,
    /// The second at which it appears, or at which typing starts.
    pub at: f64,
    /// Seconds between characters; 0 if all appear at once.
    pub step: f64,
    /// Index into the palette.
    pub color: u32,
}

const fn span(row: u32, column: u32, text: &'static str, at: f64, step: f64, color: u32) -> Span {
    Span { row, column, text, at, step, color }
}

const GREEN: u32 = 2;
const YELLOW: u32 = 3;
const BLUE: u32 = 4;
const GRAY: u32 = 8;
const WHITE: u32 = 15;

/// All text. Typed text moves the cursor.
pub const SPANS: &[Span] = &[
    span(0, 0, "~/aurora $", 0.0, 0.0, GREEN),
    span(0, 11, "cargo build", 0.6, 0.09, WHITE),
    span(1, 0, "   compiling aurora v0.3.1", 1.9, 0.0, BLUE),
    span(2, 0, "    finished in 0.84 s", 2.4, 0.0, GREEN),
    span(3, 0, "~/aurora $", 2.5, 0.0, GREEN),
    span(3, 11, "git log", 3.0, 0.08, WHITE),
    span(4, 0, "4f1c2aa", 3.8, 0.0, YELLOW),
    span(4, 8, "shade: softer edges", 3.8, 0.0, WHITE),
    span(5, 0, "9be07d3", 3.8, 0.0, YELLOW),
    span(5, 8, "noise: fewer octaves", 3.8, 0.0, WHITE),
    span(6, 0, "1a55e0c", 3.8, 0.0, YELLOW),
    span(6, 8, "first light", 3.8, 0.0, WHITE),
    span(7, 0, "~/aurora $", 3.9, 0.0, GREEN),
    span(7, 11, "vi notes.txt", 4.6, 0.08, WHITE),
    span(9, 0, " 1", 6.0, 0.0, GRAY),
    span(9, 3, "the cursor is a small light", 6.0, 0.0, WHITE),
    span(10, 0, " 2", 6.0, 0.0, GRAY),
    span(10, 3, "it steps from word to word", 6.0, 0.0, WHITE),
    span(11, 0, " 3", 6.0, 0.0, GRAY),
    span(11, 3, "and jumps across the page", 6.0, 0.0, WHITE),
    span(11, 28, ", as here", 9.3, 0.1, WHITE),
    span(12, 0, "notes.txt", 6.0, 0.0, GRAY),
    span(12, 30, "11:28   70%", 6.0, 0.0, GRAY),
];

/// The shape of the cursor, by the numbers of Ghostty's macros `CURSORSTYLE_..`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Style {
    Block = 0,
    BlockHollow = 1,
    Bar = 2,
    Underline = 3,
}

/// The state of the cursor from a moment on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cursor {
    /// The second.
    pub at: f64,
    pub row: u32,
    pub column: u32,
    pub style: Style,
    pub color: [f32; 3],
    pub is_visible: bool,
}

impl Cursor {
    /// Returns whether Ghostty treats `other` as a changed cursor: its position, colour or shape differs, and with the
    /// shape its size. Hiding it is not a change.
    fn differs(&self, other: &Cursor) -> bool {
        (self.row, self.column, self.style, self.color) != (other.row, other.column, other.style, other.color)
    }
}

const ORANGE: [f32; 3] = [1.0, 0.55, 0.2];
pub(super) const CREAM: [f32; 3] = [0.95, 0.9, 0.75];

/// The seconds at which the window loses and regains the focus.
pub const UNFOCUSED: (f64, f64) = (11.4, 12.4);

/// The jumps and changes that are not typing: the second, the new position, and what else changes.
type Jump = (f64, u32, u32, Style, [f32; 3], bool);

const JUMPS: &[Jump] = &[
    (0.0, 0, 11, Style::Block, CREAM, true),
    (2.5, 3, 11, Style::Block, CREAM, true),
    (3.9, 7, 11, Style::Block, CREAM, true),
    (6.0, 9, 3, Style::Block, CREAM, true),
    (6.5, 9, 7, Style::Block, CREAM, true),
    (6.7, 9, 14, Style::Block, CREAM, true),
    (6.9, 9, 17, Style::Block, CREAM, true),
    (7.3, 10, 17, Style::Block, CREAM, true),
    (7.6, 11, 17, Style::Block, CREAM, true),
    (8.1, 9, 29, Style::Block, CREAM, true),
    (8.6, 11, 27, Style::Block, CREAM, true),
    (9.0, 11, 28, Style::Bar, CREAM, true),
    (10.4, 11, 36, Style::Block, ORANGE, true),
    (10.8, 10, 3, Style::Underline, ORANGE, true),
    (11.4, 10, 3, Style::BlockHollow, ORANGE, true),
    (12.4, 10, 3, Style::Block, CREAM, true),
    (12.8, 10, 3, Style::Block, CREAM, false),
    (13.2, 10, 3, Style::Block, CREAM, true),
    (13.6, 0, 0, Style::Block, CREAM, true),
    (14.2, 12, 40, Style::Block, CREAM, true),
    (15.0, 7, 23, Style::Block, CREAM, true),
];

/// The cursors of one period, in order of time.
static CURSORS: LazyLock<Vec<Cursor>> = LazyLock::new(|| {
    let jump =
        |&(at, row, column, style, color, is_visible): &Jump| Cursor { at, row, column, style, color, is_visible };
    let mut all: Vec<Cursor> = JUMPS.iter().map(jump).collect();
    for span in SPANS.iter().filter(|span| span.step > 0.0) {
        let before = JUMPS.iter().rfind(|jump| jump.0 <= span.at).map(jump);
        let Some(before) = before else { continue };
        let typed = (1..=span.text.len() as u32).map(|n| Cursor {
            at: span.at + span.step * f64::from(n - 1),
            row: span.row,
            column: span.column + n,
            ..before
        });
        all.extend(typed);
    }
    all.sort_by(|a, b| a.at.total_cmp(&b.at));
    all
});

/// The state of the terminal at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    pub cursor: Cursor,
    /// The cursor before the last change; `None` before any change.
    pub previous: Option<Cursor>,
    /// The second of the last change.
    pub changed_at: f64,
    pub is_focused: bool,
    /// The second at which the window last got the focus.
    pub focused_at: f64,
}

/// Returns the state of the terminal `secs` after the start.
pub fn at(secs: f64) -> Moment {
    let secs = secs.max(0.0);
    let round = (secs / PERIOD).floor();
    let (round_start, within) = (round * PERIOD, secs - round * PERIOD);
    let index = CURSORS.partition_point(|cursor| cursor.at <= within).saturating_sub(1);
    let cursor = CURSORS[index];
    // The last change, in this period or at the end of the previous one.
    let change = (1..=index).rev().find(|&i| CURSORS[i].differs(&CURSORS[i - 1]));
    let (previous, changed_at) = match change {
        Some(i) => (Some(CURSORS[i - 1]), round_start + CURSORS[i].at),
        None if round > 0.0 => (CURSORS.last().copied(), round_start),
        None => (None, 0.0),
    };
    let (lost, found) = UNFOCUSED;
    let focused_at = match within >= found {
        true => round_start + found,
        false if round > 0.0 => round_start - PERIOD + found,
        false => 0.0,
    };
    Moment { cursor, previous, changed_at, is_focused: !(lost..found).contains(&within), focused_at }
}

/// The layout of the terminal's cells in a picture of this height, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    /// The size of a dot of the font in pixels.
    pub dot: u32,
}

/// The size of a cell in dots, across and down.
pub const CELL: (u32, u32) = (6, 12);
/// Dots between the edge of the picture and the first cell.
pub const PADDING: u32 = 4;

impl Grid {
    pub fn of(height: u32) -> Grid {
        Grid { dot: ((f64::from(height) / 240.0 + 0.5) as u32).max(1) }
    }

    /// Returns the rectangle of a cursor: its left and its upper edge, y up from the bottom of the picture, then width
    /// and height.
    pub fn rectangle(self, cursor: &Cursor, height: u32) -> [f32; 4] {
        let dots = |n: u32| (n * self.dot) as f32;
        let left = dots(PADDING + cursor.column * CELL.0);
        let top = height as f32 - dots(PADDING + cursor.row * CELL.1);
        match cursor.style {
            Style::Block | Style::BlockHollow => [left, top, dots(CELL.0), dots(CELL.1)],
            Style::Bar => [left, top, dots(1), dots(CELL.1)],
            Style::Underline => [left, top - dots(CELL.1 - 2), dots(CELL.0), dots(1)],
        }
    }
}
