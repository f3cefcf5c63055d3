//! The picture of the simulated terminal, as the GLSL of a buffer.

use super::{
    font::{self, GLYPHS},
    script::{CELL, PADDING, PERIOD, SPANS},
};
use std::fmt::Write;

/// Returns the text of the buffer.
pub(super) fn text() -> String {
    let glyphs: Vec<u32> = GLYPHS.iter().flat_map(|(_, rows)| font::packed(rows)).collect();
    // Four characters per number, the first in the lowest byte.
    let characters: Vec<u8> = SPANS.iter().flat_map(|s| s.text.chars()).map(|c| font::index(c) as u8).collect();
    let words: Vec<u32> =
        characters.chunks(4).map(|four| four.iter().rev().fold(0, |word, byte| word << 8 | u32::from(*byte))).collect();
    let mut out = String::from(
        "// A stand-in for the terminal: what a custom shader finds in iChannel0. The text and the cursor follow a script of\n\
         // Eddy's own, and depend on nothing but iTime and iResolution.\n",
    );
    let list = |values: &[u32]| values.iter().map(|v| format!("{v}u")).collect::<Vec<_>>().join(", ");
    let (mut at, mut starts) = (0, Vec::new());
    for span in SPANS {
        starts.push(at);
        at += span.text.len();
    }
    let places = SPANS
        .iter()
        .zip(&starts)
        .map(|(s, start)| format!("    ivec4({}, {}, {}, {start})", s.row, s.column, s.text.len()));
    let times = SPANS.iter().map(|s| format!("    vec3({:?}, {:?}, {:?})", s.at, s.step, f64::from(s.color)));
    // Writing to a String cannot fail.
    let _ = write!(
        out,
        "const uint GLYPHS[{}] = uint[](\n    {}\n);\n\
         const uint CHARACTERS[{}] = uint[](\n    {}\n);\n\
         // Row, column, length, first character.\n\
         const ivec4 PLACES[{count}] = ivec4[](\n{}\n);\n\
         // The second at which it appears, seconds from one character to the next, colour.\n\
         const vec3 TIMES[{count}] = vec3[](\n{}\n);\n\
         const float PERIOD = {PERIOD:?};\n\
         const ivec2 CELL = ivec2({}, {});\n\
         const int PADDING = {PADDING};\n",
        glyphs.len(),
        list(&glyphs),
        words.len(),
        list(&words),
        places.collect::<Vec<_>>().join(",\n"),
        times.collect::<Vec<_>>().join(",\n"),
        CELL.0,
        CELL.1,
        count = SPANS.len(),
    );
    out.push_str(BODY);
    out
}

const BODY: &str = "
// Whether a dot of a glyph is set; from the top left.
bool isSet(uint glyph, ivec2 dot) {
    if (any(lessThan(dot, ivec2(0))) || dot.x > 4 || dot.y > 6) return false;
    int row = dot.y < 4 ? 3 - dot.y : 6 - dot.y;
    return ((GLYPHS[2u * glyph + (dot.y < 4 ? 0u : 1u)] >> uint(5 * row + 4 - dot.x)) & 1u) == 1u;
}

void mainImage(out vec4 color, in vec2 at) {
    float time = mod(iTime, PERIOD);
    int scale = max(1, int(iResolution.y / 240.0 + 0.5));
    ivec2 dot = ivec2(floor(vec2(at.x, iResolution.y - at.y) / float(scale))) - PADDING;
    ivec2 cell = ivec2(floor(vec2(dot) / vec2(CELL)));
    ivec2 inside = dot - cell * CELL - ivec2(0, 2);
    vec3 ink = iBackgroundColor;
    bool isInk = false;
    for (int i = 0; i < PLACES.length(); i++) {
        ivec4 place = PLACES[i];
        int n = cell.y == place.x ? cell.x - place.y : -1;
        if (n < 0 || n >= place.z || time < TIMES[i].x + TIMES[i].y * float(n)) continue;
        int character = place.w + n;
        uint glyph = (CHARACTERS[character / 4] >> uint(8 * (character % 4))) & 255u;
        if (isSet(glyph, inside)) {
            isInk = true;
            ink = iPalette[int(TIMES[i].z)];
        }
    }
    vec2 corner = vec2(iCurrentCursor.x, iCurrentCursor.y - iCurrentCursor.w);
    vec2 away = min(at - corner, corner + iCurrentCursor.zw - at);
    if (iCursorVisible == 1 && min(away.x, away.y) > 0.0) {
        bool isHollow = iCurrentCursorStyle == CURSORSTYLE_BLOCK_HOLLOW;
        if (!isHollow) ink = isInk ? iCursorText : iCurrentCursorColor.rgb;
        if (isHollow && min(away.x, away.y) < float(scale)) ink = iCurrentCursorColor.rgb;
    }
    color = vec4(ink, 1.0);
}
";
