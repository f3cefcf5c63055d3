//! The uniforms that Ghostty adds to Shadertoy's, and their values. `iPalette` is not among them: it is a constant
//! array, which the prelude declares.

use super::{
    prelude,
    script::{self, CREAM, Cursor, Grid, Moment},
};
use crate::{CustomUniformType as Type, HostUniform, HostValue};

/// A uniform that the terminal sets.
struct Row {
    name: &'static str,
    ty: Type,
    about: &'static str,
    value: fn(&Moment, u32) -> [f32; 4],
}

const fn row(name: &'static str, ty: Type, about: &'static str, value: fn(&Moment, u32) -> [f32; 4]) -> Row {
    Row { name, ty, about, value }
}

fn one(value: f32) -> [f32; 4] {
    [value, 0.0, 0.0, 0.0]
}

fn rgb([r, g, b]: [f32; 3]) -> [f32; 4] {
    [r, g, b, 0.0]
}

fn rectangle(cursor: &Cursor, height: u32) -> [f32; 4] {
    Grid::of(height).rectangle(cursor, height)
}

/// Ghostty's cursor colours have an alpha.
fn opaque([r, g, b]: [f32; 3]) -> [f32; 4] {
    [r, g, b, 1.0]
}

/// All of them, in the order of Ghostty's prefix.
const ROWS: [Row; 16] = [
    row("iCurrentCursor", Type::Vec4, "the left and the upper edge of the cursor, its width and its height", |m, h| {
        rectangle(&m.cursor, h)
    }),
    row("iPreviousCursor", Type::Vec4, "the same of the cursor before it changed", |m, h| {
        m.previous.map_or([0.0; 4], |cursor| rectangle(&cursor, h))
    }),
    row("iCurrentCursorColor", Type::Vec4, "the colour of the cursor", |m, _| opaque(m.cursor.color)),
    row("iPreviousCursorColor", Type::Vec4, "the colour of the cursor before it changed", |m, _| {
        m.previous.map_or([0.0; 4], |cursor| opaque(cursor.color))
    }),
    row("iCurrentCursorStyle", Type::Int, "the shape of the cursor, one of CURSORSTYLE_..", |m, _| {
        one(f32::from(m.cursor.style as u8))
    }),
    row("iPreviousCursorStyle", Type::Int, "the shape of the cursor before it changed", |m, _| {
        one(m.previous.map_or(0.0, |cursor| f32::from(cursor.style as u8)))
    }),
    row("iCursorVisible", Type::Int, "1 where the cursor is shown, else 0", |m, _| {
        one(f32::from(u8::from(m.cursor.is_visible)))
    }),
    row("iTimeCursorChange", Type::Float, "iTime at which the cursor last changed", |m, _| one(m.changed_at as f32)),
    row("iTimeFocus", Type::Float, "iTime at which the terminal last got the focus", |m, _| one(m.focused_at as f32)),
    row("iFocus", Type::Int, "1 where the terminal has the focus, else 0", |m, _| {
        one(f32::from(u8::from(m.is_focused)))
    }),
    row("iBackgroundColor", Type::Vec3, "the background colour of the terminal", |_, _| rgb(prelude::BACKGROUND)),
    row("iForegroundColor", Type::Vec3, "the colour of text", |_, _| rgb(prelude::FOREGROUND)),
    row("iCursorColor", Type::Vec3, "the colour of the cursor as configured", |_, _| rgb(CREAM)),
    row("iCursorText", Type::Vec3, "the colour of text under the cursor", |_, _| rgb(prelude::BACKGROUND)),
    row("iSelectionForegroundColor", Type::Vec3, "the colour of selected text", |_, _| rgb(prelude::BACKGROUND)),
    row("iSelectionBackgroundColor", Type::Vec3, "the background colour of selected text", |_, _| {
        rgb(prelude::FOREGROUND)
    }),
];

/// The uniforms, in the order of [`values`].
pub(crate) static UNIFORMS: [HostUniform; ROWS.len()] = {
    let mut all = [HostUniform { name: "", ty: Type::Int, value: HostValue::Terminal(0) }; ROWS.len()];
    let mut i = 0;
    while i < ROWS.len() {
        all[i] = HostUniform { name: ROWS[i].name, ty: ROWS[i].ty, value: HostValue::Terminal(i as u8) };
        i += 1;
    }
    all
};

/// Returns the meaning of a uniform.
pub(crate) fn about(row: u8) -> &'static str {
    ROWS[usize::from(row)].about
}

/// Returns the values at `secs` in a picture of this height; unused components are 0, and an `int` is stored as a whole
/// number.
pub fn values(secs: f64, height: u32) -> Vec<[f32; 4]> {
    let moment = script::at(secs);
    ROWS.iter().map(|row| (row.value)(&moment, height)).collect()
}
