//! Texels of a pass that its own program does not draw: its contents before frame 0, and its outermost texels.

use std::{
    ops::Range,
    path::{Path, PathBuf},
    sync::Arc,
};

/// A value that texels are filled with, and its place in `eddy.toml`.
#[derive(Clone, Debug)]
pub struct Fill {
    pub value: FillValue,
    /// `None` if created in code.
    pub written: Option<Written>,
}

/// A value for every texel of a pass.
#[derive(Clone, Debug, PartialEq)]
pub enum FillValue {
    /// A GLSL expression of type `vec4`. It sees Common, Shadertoy's uniforms, and `fragCoord` as in `mainImage`.
    Expression(Arc<str>),
    /// A picture or a `.npy` file, by its name in the project's folder. If its size is the pass's, it is copied texel
    /// for texel, else stretched over the pass with linear filtering.
    File(PathBuf),
    /// The bytes of an `.npy` file that is not on disk yet, and its future name. Exists in memory only: saving writes
    /// the file into the project's folder and replaces this by a [`FillValue::File`], and loading a project never
    /// creates one.
    InMemory { name: PathBuf, npy: Arc<[u8]> },
}

impl FillValue {
    /// The name of the picture; `None` for an expression.
    pub fn path(&self) -> Option<&Path> {
        match self {
            FillValue::Expression(_) => None,
            FillValue::File(path) | FillValue::InMemory { name: path, .. } => Some(path),
        }
    }
}

/// A place in a manifest.
#[derive(Clone, Debug)]
pub struct Written {
    /// The whole text of `eddy.toml`.
    pub manifest: Arc<str>,
    /// The bytes of the value, including its quotes.
    pub range: Range<usize>,
}

/// Fills are equal if their values are, wherever they are written.
impl PartialEq for Fill {
    fn eq(&self, other: &Fill) -> bool {
        self.value == other.value
    }
}

impl Fill {
    pub fn expression(text: impl Into<Arc<str>>) -> Fill {
        Fill { value: FillValue::Expression(text.into()), written: None }
    }

    pub fn file(path: impl Into<PathBuf>) -> Fill {
        Fill { value: FillValue::File(path.into()), written: None }
    }

    /// The text into which its diagnostics point, and the value's range in it: the manifest, if it contains the value
    /// verbatim; else the value alone, at the manifest's line.
    pub(super) fn text(&self) -> (Arc<str>, Range<usize>) {
        let value: Arc<str> = match &self.value {
            FillValue::Expression(text) => text.clone(),
            FillValue::File(path) | FillValue::InMemory { name: path, .. } => path.to_string_lossy().into(),
        };
        Written::located(&value, self.written.as_ref())
    }
}

/// The limit for line breaks before a value. A value with escapes gets a text of its own, with a line break for each
/// line before it in the manifest, and a manifest of a million empty lines may have a thousand such values.
const MOST_LINES: usize = 1 << 16;

impl Written {
    /// Returns the text into which diagnostics about a value point, and the value's range in it.
    pub(super) fn located(value: &Arc<str>, written: Option<&Written>) -> (Arc<str>, Range<usize>) {
        let Some(Written { manifest, range }) = written else { return (value.clone(), 0..value.len()) };
        let written = manifest.get(range.clone()).unwrap_or_default();
        if let Some(at) = written.find(&**value).map(|at| range.start + at) {
            return (manifest.clone(), at..at + value.len());
        }
        // With escapes, the compiled text differs from the written one.
        let before = &manifest[..range.start.min(manifest.len())];
        let lines = before.matches('\n').count().min(MOST_LINES);
        let text = "\n".repeat(lines) + value;
        (text.into(), lines..lines + value.len())
    }
}

/// The outermost texels of a pass, overwritten after each draw.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// The width in texels from each edge, at least 1.
    pub width: u32,
    pub value: Fill,
}

impl Boundary {
    /// The texels of a picture that it covers, as at most four disjoint rectangles (x, y, width, height).
    pub fn rectangles(width: u32, (w, h): (u32, u32)) -> Vec<[u32; 4]> {
        if 2 * u64::from(width) >= u64::from(w.min(h)) {
            return vec![[0, 0, w, h]];
        }
        let inner = h - 2 * width;
        vec![[0, 0, w, width], [0, h - width, w, width], [0, width, width, inner], [w - width, width, width, inner]]
    }
}

/// One of a pass's fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FillKind {
    Initial,
    Boundary,
}

impl FillKind {
    pub const ALL: [FillKind; 2] = [FillKind::Initial, FillKind::Boundary];

    /// Returns the key in `eddy.toml`.
    pub fn key(self) -> &'static str {
        match self {
            FillKind::Initial => "initial",
            FillKind::Boundary => "boundary",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rectangles_cover_each_edge_texel_exactly_once() {
        for (width, size) in
            [(1, (5, 4)), (2, (5, 5)), (2, (4, 9)), (3, (3, 3)), (1, (1, 7)), (1, (3, 3)), (9, (64, 20))]
        {
            let mut hits = vec![0; (size.0 * size.1) as usize];
            for [x, y, w, h] in Boundary::rectangles(width, size) {
                assert!(w > 0 && h > 0, "{width} {size:?}");
                for (x, y) in (y..y + h).flat_map(|y| (x..x + w).map(move |x| (x, y))) {
                    hits[(y * size.0 + x) as usize] += 1;
                }
            }
            for (i, hit) in hits.into_iter().enumerate() {
                let (x, y) = (i as u32 % size.0, i as u32 / size.0);
                let edge = x.min(y).min(size.0 - 1 - x).min(size.1 - 1 - y) < width;
                assert_eq!(hit, i32::from(edge), "{width} {size:?}: {x} {y}");
            }
        }
    }

    #[test]
    fn a_value_with_escapes_keeps_its_line() {
        let manifest: Arc<str> = "a = 1\nb = \"x\\u0041y\"\n".into();
        let written = Some(Written { manifest: manifest.clone(), range: 10..20 });
        let fill = Fill { written: written.clone(), ..Fill::expression("xAy") };
        assert_eq!(fill.text(), ("\nxAy".into(), 1..4));
        let fill = Fill { written, ..Fill::expression("u0041y") };
        assert_eq!(fill.text(), (manifest, 13..19));
    }
}
