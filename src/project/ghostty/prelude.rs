//! The prelude of a custom shader: Ghostty's macros and the palette.

use std::fmt::Write;

pub(super) const BACKGROUND: [f32; 3] = [0.09, 0.1, 0.13];
pub(super) const FOREGROUND: [f32; 3] = [0.85, 0.87, 0.9];

/// The sixteen named colours of the simulated terminal, as 0xRRGGBB.
const NAMED: [u32; 16] = [
    0x17_1a_21, 0xd6_5c_5c, 0x7f_b9_6b, 0xd9_b0_5f, 0x6a_9f_d9, 0xb0_7f_cf, 0x5f_b8_b3, 0xc4_c9_d4, 0x6b_73_82,
    0xf0_7f_7a, 0x9c_d6_86, 0xf2_cd_7e, 0x8c_bb_f0, 0xcb_a0_e6, 0x80_d4_ce, 0xe6_e9_ef,
];

/// Returns a colour of the palette: the sixteen named ones, the cube of 6x6x6 with the levels 0, 95, 135, 175, 215 and
/// 255, and 24 grays from 8 in steps of 10, as in xterm.
pub(super) fn palette(index: u32) -> [u8; 3] {
    let level = |n: u32| if n == 0 { 0 } else { (55 + 40 * n) as u8 };
    match index {
        0..16 => {
            let [_, r, g, b] = NAMED[index as usize].to_be_bytes();
            [r, g, b]
        }
        16..232 => {
            let n = index - 16;
            [level(n / 36), level(n / 6 % 6), level(n % 6)]
        }
        _ => [(8 + 10 * (index.min(255) - 232)) as u8; 3],
    }
}

pub(super) fn text() -> String {
    let mut out = String::from(
        "// Ghostty puts these macros before a custom shader, and the palette, which is a uniform there. Its other\n\
         // uniforms are there without a declaration: iCurrentCursor, iPreviousCursor and so on.\n\
         #define texture2D texture\n\
         #define CURSORSTYLE_BLOCK        0\n\
         #define CURSORSTYLE_BLOCK_HOLLOW 1\n\
         #define CURSORSTYLE_BAR          2\n\
         #define CURSORSTYLE_UNDERLINE    3\n\
         #define CURSORSTYLE_LOCK         4\n\n\
         const vec3 iPalette[256] = vec3[256](\n",
    );
    for index in 0..256 {
        let [r, g, b] = palette(index).map(|level| f32::from(level) / 255.0);
        let end = if index == 255 { "\n);\n" } else { ",\n" };
        // Writing to a String cannot fail.
        let _ = write!(out, "    vec3({r:.4}, {g:.4}, {b:.4}){end}");
    }
    out
}
