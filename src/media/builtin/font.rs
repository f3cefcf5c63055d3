//! A font as a picture: 16x16 cells of 64 texels, the character of code c in column c mod 16 and row c / 16 from the
//! top.
//!
//! The layout is that of Shadertoy, so that shaders which print find their letters: red is the coverage of a texel by
//! the letter, green and blue are the gradient of the distance to its outline (128 is none), and alpha is that distance
//! in cells, 0.5 on the outline and less inside. The letters are drawn here, as strokes on a grid.

use super::field::byte;
use crate::Texels;
use eddy_texture::TexelFormat;

/// Strokes of the printable ASCII characters, starting with the space. A stroke is a row of points, two digits each: x,
/// 1 to 5, and y, where 2 is the base line, 6 the x-height, 8 the height of a capital and 0 the lowest descender. `~`
/// rounds its corners.
const STROKES: [&str; 95] = [
    "",
    "3834 3232",
    "2826 4846",
    "2228 4248 1656 1454",
    "~574828171625455453422213 3931",
    "1258 ~1727281817 ~4252534342",
    "~5226273847461413224254",
    "3836",
    "~48373342",
    "~28373322",
    "3438 1557 1755",
    "3337 1555",
    "~323120",
    "1555",
    "3232",
    "1258",
    "~284857534222131728 2347",
    "273832 2242",
    "~17284857563412 1252",
    "~17284857564525 ~25455453422213",
    "42481454",
    "581815 ~15455453422213",
    "~574828171322425354452514",
    "185822",
    "~284857564525161728 ~254554534222131425",
    "~132242535748281716254556",
    "3232 3535",
    "3535 ~323120",
    "571553",
    "1656 1454",
    "175513",
    "~17284857563534 3232",
    "~53422213172848575544344644",
    "123852 2444",
    "1218 ~184857564515 ~154554534212",
    "~5748281713224253",
    "1218 ~184857534212",
    "58181252 1545",
    "581812 1545",
    "~5748281713224253 535535",
    "1218 5258 1555",
    "3238 2242 2848",
    "~5853422213",
    "1218 5814 2552",
    "181252",
    "1218355852",
    "12185258",
    "~284857534222131728",
    "1218 ~184857554414",
    "~284857534222131728 3451",
    "1218 ~184857554414 3452",
    "~574828171625455453422213",
    "1858 3832",
    "~181322425358",
    "183258",
    "1822364258",
    "1852 1258",
    "183558 3532",
    "18581252",
    "48383242",
    "1852",
    "28383222",
    "163856",
    "1151",
    "2837",
    "~1526465552 ~542413224253",
    "1812 ~1526465553422213",
    "~5546261513224253",
    "5852 ~5546261513224253",
    "1454 ~545546261513224253",
    "~58483732 2646",
    "~5546261513224253 ~5651402011",
    "1812 ~1526465552",
    "263632 2242 3838",
    "3646 ~46413020 4848",
    "1812 5614 3552",
    "2838 ~38334252",
    "1216 ~15263532 ~35465552",
    "1216 ~1526465552",
    "~264655534222131526",
    "1610 ~1526465553422213",
    "5650 ~5546261513224253",
    "1216 ~14264655",
    "~55462615244453422213",
    "~38334253 1656",
    "5652 ~1613224253",
    "163256",
    "1622354256",
    "1652 1256",
    "1632 5620",
    "16561252",
    "~48383625343242",
    "3931",
    "~28383645343222",
    "~15264455",
];

const CELL: usize = 64;
const SIZE: usize = 16 * CELL;
/// Half the width of a stroke and the length of a grid unit, in texels.
const HALF_WIDTH: f32 = 2.9;
const UNIT: f32 = 6.0;

pub(super) fn atlas() -> Texels {
    let mut bytes = [0, 128, 128, 255].repeat(SIZE * SIZE);
    std::thread::scope(|scope| {
        for (row, band) in bytes.chunks_exact_mut(SIZE * CELL * 4).enumerate() {
            scope.spawn(move || {
                for column in 0..16 {
                    let strokes = (row * 16 + column).checked_sub(32).and_then(|i| STROKES.get(i));
                    if let Some(strokes) = strokes.filter(|s| !s.is_empty()) {
                        draw(&segments(strokes), band, column);
                    }
                }
            });
        }
    });
    Texels::flat(SIZE as u32, SIZE as u32, TexelFormat::Rgba8, bytes)
}

type Point = [f32; 2];

/// Returns the straight segments of a letter, in texels of its cell, y down.
fn segments(strokes: &str) -> Vec<[Point; 2]> {
    let mut found = Vec::new();
    for stroke in strokes.split(' ') {
        let digits: Vec<f32> = stroke.bytes().filter(u8::is_ascii_digit).map(|d| f32::from(d - b'0')).collect();
        let mut points: Vec<Point> =
            digits.chunks_exact(2).map(|p| [32.0 + (p[0] - 3.0) * UNIT, 48.0 - (p[1] - 2.0) * UNIT]).collect();
        // A dot is drawn as a small square, so that it is slightly thicker than a stroke.
        if let [a, b] = points[..]
            && a == b
        {
            points = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
                .map(|(x, y)| [a[0] + x, a[1] - 1.0 + y])
                .to_vec();
        }
        if stroke.starts_with('~') {
            points = rounded(&rounded(&points));
        }
        found.extend(points.windows(2).map(|w| [w[0], w[1]]));
    }
    found
}

/// One round of Chaikin's corner cutting (1974). A closed stroke is rounded at its start too.
fn rounded(points: &[Point]) -> Vec<Point> {
    let between = |a: Point, b: Point, t: f32| [a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t];
    let cut: Vec<Point> =
        points.windows(2).flat_map(|w| [between(w[0], w[1], 0.25), between(w[0], w[1], 0.75)]).collect();
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return cut };
    if first == last {
        let mut cut = cut;
        cut.extend(cut.first().copied());
        return cut;
    }
    // The end points are kept.
    let inner = cut.get(1..cut.len().saturating_sub(1)).unwrap_or_default();
    std::iter::once(first).chain(inner.iter().copied()).chain([last]).collect()
}

fn draw(segments: &[[Point; 2]], band: &mut [u8], column: usize) {
    for y in 0..CELL {
        for x in 0..CELL {
            let at = [x as f32 + 0.5, y as f32 + 0.5];
            let (distance, away) = nearest(segments, at);
            let distance = distance - HALF_WIDTH;
            let texel = &mut band[(y * SIZE + column * CELL + x) * 4..][..4];
            texel.copy_from_slice(&[
                byte(0.5 - distance),
                byte(0.5 + 0.5 * away[0]),
                // v points upwards.
                byte(0.5 - 0.5 * away[1]),
                byte(0.5 + distance / CELL as f32),
            ]);
        }
    }
}

/// Returns the distance to the nearest segment, and the direction away from it.
fn nearest(segments: &[[Point; 2]], at: Point) -> (f32, Point) {
    let mut best = (f32::MAX, [0.0; 2]);
    for [a, b] in segments {
        let (along, to) = ([b[0] - a[0], b[1] - a[1]], [at[0] - a[0], at[1] - a[1]]);
        let length = along[0] * along[0] + along[1] * along[1];
        let t = if length > 0.0 { ((to[0] * along[0] + to[1] * along[1]) / length).clamp(0.0, 1.0) } else { 0.0 };
        let off = [to[0] - along[0] * t, to[1] - along[1] * t];
        let square = off[0] * off[0] + off[1] * off[1];
        if square < best.0 {
            best = (square, off);
        }
    }
    let distance = best.0.sqrt();
    (distance, best.1.map(|c| c / distance.max(1e-3)))
}
