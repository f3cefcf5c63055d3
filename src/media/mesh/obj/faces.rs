//! Converts the faces of a file to triangles.

use super::{
    census::Census,
    elements::Elements,
    numbers::whole,
    polygon::Cutter,
    text::{Statement, quoted, statements},
};
use crate::mesh::{
    model::Raw,
    trouble::{Counts, ModelError},
};
use rustc_hash::FxHashMap;

/// A corner of a face: a position, a texture coordinate and a normal, as indices into [`Elements`].
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Corner {
    position: u32,
    uv: Option<u32>,
    normal: Option<u32>,
}

/// Converts faces to triangles.
pub(super) struct Faces<'f> {
    elements: &'f Elements,
    /// The number of the first element.
    first: i64,
    room: u64,
    made: Counts,
    /// Positions, texture coordinates and normals before the current statement, from which negative numbers count back.
    passed: [usize; 3],
    /// The current part: faces with and without texture coordinates, with and without normals, as missing attributes
    /// are made for all faces of a kind.
    part: [Kind; 4],
    cutter: Cutter,
    corners: Vec<Corner>,
    places: Vec<[f32; 3]>,
    triangles: Vec<u32>,
}

/// Faces that have the same attributes.
#[derive(Default)]
struct Kind {
    raw: Raw,
    vertices: FxHashMap<Corner, u32>,
}

/// The kinds of elements in the order of a corner's numbers.
const KINDS: [&str; 3] = ["vertex", "texture coordinate", "normal"];

impl<'f> Faces<'f> {
    pub(super) fn new(elements: &'f Elements, census: &Census, room: u64) -> Self {
        Self {
            elements,
            first: census.first(),
            room,
            made: Counts::default(),
            passed: [0; 3],
            part: Default::default(),
            cutter: Cutter::default(),
            corners: Vec::new(),
            places: Vec::new(),
            triangles: Vec::new(),
        }
    }

    /// Passes on the faces of a text, part by part, and returns the number of triangles.
    pub(super) fn hand_over(
        mut self,
        text: &[u8],
        take: &mut dyn FnMut(Raw) -> Result<(), ModelError>,
    ) -> Result<u64, ModelError> {
        for statement in statements(text) {
            match statement.words().next() {
                Some(b"v") => self.passed[0] += 1,
                Some(b"vt") => self.passed[1] += 1,
                Some(b"vn") => self.passed[2] += 1,
                Some(b"f" | b"fo") => self.add(statement)?,
                Some(b"o" | b"g") => self.end_part(take)?,
                _ => {}
            }
        }
        self.end_part(take)?;
        Ok(self.made.triangles)
    }

    fn end_part(&mut self, take: &mut dyn FnMut(Raw) -> Result<(), ModelError>) -> Result<(), ModelError> {
        let kinds = self.part.iter_mut().filter(|kind| !kind.raw.indices.is_empty());
        kinds.map(std::mem::take).try_for_each(|kind| take(kind.raw))
    }

    /// Adds a face. A face of fewer than three corners is a point or a line.
    fn add(&mut self, statement: Statement<'_>) -> Result<(), ModelError> {
        self.corners.clear();
        for word in statement.words().skip(1) {
            let corner = self.corner(statement, word)?;
            self.corners.push(corner);
        }
        let elements = self.elements;
        if self.corners.len() < 3 || !self.corners.iter().all(|corner| elements.has_place(corner.position)) {
            return Ok(());
        }
        let has_uv = self.corners.iter().all(|corner| corner.uv.is_some());
        let has_normals = self.corners.iter().all(|corner| corner.normal.is_some_and(|n| elements.has_direction(n)));
        self.places.clear();
        self.places.extend(self.corners.iter().map(|corner| elements.positions[corner.position as usize]));
        self.cutter.triangles(&self.places, &mut self.triangles)?;
        self.made.add(0, self.triangles.len() as u64 / 3)?;
        let kind = &mut self.part[usize::from(has_uv) + 2 * usize::from(has_normals)];
        (kind.raw.has_uv, kind.raw.has_normals) = (has_uv, has_normals);
        for &corner in &self.triangles {
            let Corner { position, uv, normal } = self.corners[corner as usize];
            let corner = Corner { position, uv: uv.filter(|_| has_uv), normal: normal.filter(|_| has_normals) };
            let next = kind.raw.vertices.len() as u32;
            let index = *kind.vertices.entry(corner).or_insert(next);
            if index == next {
                self.made.vertices += 1;
                self.made.fit(self.room)?;
                kind.raw.vertices.push(elements.vertex(corner.position, corner.uv, corner.normal));
            }
            kind.raw.indices.push(index);
        }
        Ok(())
    }

    /// Parses a corner: `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&self, statement: Statement<'_>, word: &[u8]) -> Result<Corner, ModelError> {
        let mut found = [None; 3];
        for (kind, number) in word.split(|b| *b == b'/').enumerate() {
            if kind > 2 || kind == 0 && number.is_empty() {
                return Err(no_corner(statement, word));
            }
            if !number.is_empty() {
                found[kind] = self.element(statement, (word, number), kind)?;
            }
        }
        let [Some(position), uv, normal] = found else { return Err(no_corner(statement, word)) };
        Ok(Corner { position, uv, normal })
    }

    /// Returns the index of an element of a kind. For a missing texture coordinate or normal some programs write 0, and
    /// others any number in a file that has none at all.
    fn element(
        &self,
        statement: Statement<'_>,
        (word, text): (&[u8], &[u8]),
        kind: usize,
    ) -> Result<Option<u32>, ModelError> {
        let Some(number) = whole(text) else { return Err(no_corner(statement, word)) };
        let all = [self.elements.positions.len(), self.elements.uvs.len(), self.elements.normals.len()][kind];
        if kind > 0 && (all == 0 || number == 0 && self.first == 1) {
            return Ok(None);
        }
        let passed = self.passed[kind];
        let place = if number < 0 { (passed as i64).checked_add(number) } else { number.checked_sub(self.first) };
        if let Some(place) = place.and_then(|place| u32::try_from(place).ok()).filter(|place| (*place as usize) < all) {
            return Ok(Some(place));
        }
        let names = format!("{} uses {} {}", quoted(word), KINDS[kind], quoted(text));
        let (reason, hint) = match number {
            0 => (names, "OBJ counts from 1: add 1 to every number of a face"),
            ..0 => (
                format!("{names}, but only {passed} come before it"),
                "a negative number counts back from the face: re-export the model",
            ),
            _ => (
                format!("{names}, but the file has {all}"),
                "the file may be truncated or merged from several: re-export the model",
            ),
        };
        Err(statement.error(word, reason, hint))
    }
}

fn no_corner(statement: Statement<'_>, word: &[u8]) -> ModelError {
    let reason = format!("{} is not a corner of a face", quoted(word));
    statement.error(word, reason, "write corners as v, v/vt, v//vn or v/vt/vn, all whole numbers: 1/2/3")
}
