//! The positions, texture coordinates, normals and colours of a file.

use super::{
    census::Census,
    numbers::numbers,
    text::{Statement, quoted, statements},
};
use crate::mesh::{error::MeshWarning, model::Vertex, trouble::ModelError};

/// The elements that the faces of a file refer to by number.
pub(super) struct Elements {
    pub positions: Vec<[f32; 3]>,
    /// White for vertices without a colour; empty if no vertex has one.
    colors: Vec<[f32; 3]>,
    pub uvs: Vec<[f32; 2]>,
    pub normals: Vec<[f32; 3]>,
    /// The first element of each kind that is not finite: its line and the word.
    broken: [Option<(usize, String)>; 4],
}

/// The kinds of elements, as an error counts them.
#[derive(Clone, Copy)]
enum Kind {
    Position,
    Uv,
    Normal,
    Color,
}

impl Elements {
    pub(super) fn of(text: &[u8], census: &Census) -> Result<Elements, ModelError> {
        let mut elements = Elements {
            positions: Vec::with_capacity(census.counts.vertices as usize),
            colors: Vec::new(),
            uvs: Vec::with_capacity(census.uvs),
            normals: Vec::with_capacity(census.normals),
            broken: Default::default(),
        };
        for statement in statements(text) {
            match statement.words().next() {
                Some(b"v") => elements.add_position(statement)?,
                Some(b"vt") => elements.add_uv(statement)?,
                Some(b"vn") => elements.add_normal(statement)?,
                _ => {}
            }
        }
        Ok(elements)
    }

    /// Adds a position, which may be followed by a colour, or by a weight that only curves use.
    fn add_position(&mut self, statement: Statement<'_>) -> Result<(), ModelError> {
        let mut read = [0.0; 6];
        let count = numbers(statement, &mut read)?;
        if count < 3 || count == 5 {
            let reason = format!("a vertex has 3 numbers, 4 with a weight or 6 with a colour, but this has {count}");
            return Err(statement.whole_error(reason, "re-export the model"));
        }
        let [x, y, z, r, g, b] = read;
        self.note(Kind::Position, &[x, y, z], statement);
        self.positions.push([x, y, z]);
        if count >= 6 {
            self.colors.resize(self.positions.len() - 1, WHITE);
            self.note(Kind::Color, &[r, g, b], statement);
            self.colors.push(if is_finite(&[r, g, b]) { [r, g, b] } else { WHITE });
        }
        Ok(())
    }

    /// Adds texture coordinates of one, two or three dimensions, of which the first two are used.
    fn add_uv(&mut self, statement: Statement<'_>) -> Result<(), ModelError> {
        let mut uv = [0.0; 2];
        if numbers(statement, &mut uv)? == 0 {
            let reason = "a texture coordinate has 1 to 3 numbers, but this has none";
            return Err(statement.whole_error(reason, "re-export the model"));
        }
        self.note(Kind::Uv, &uv, statement);
        self.uvs.push(if is_finite(&uv) { uv } else { [0.0; 2] });
        Ok(())
    }

    fn add_normal(&mut self, statement: Statement<'_>) -> Result<(), ModelError> {
        let mut normal = [0.0; 3];
        let count = numbers(statement, &mut normal)?;
        if count < 3 {
            let reason = format!("a normal has 3 numbers, but this has {count}");
            return Err(statement.whole_error(reason, "re-export the model"));
        }
        self.note(Kind::Normal, &normal, statement);
        self.normals.push(normal);
        Ok(())
    }

    fn note(&mut self, kind: Kind, numbers: &[f32], statement: Statement<'_>) {
        let broken = &mut self.broken[kind as usize];
        if !is_finite(numbers) && broken.is_none() {
            let at = numbers.iter().position(|x| !x.is_finite()).unwrap_or_default();
            let skipped = if let Kind::Color = kind { 4 } else { 1 };
            let word = statement.words().nth(at + skipped).unwrap_or_default();
            *broken = Some((statement.line_of(word), quoted(word)));
        }
    }

    pub(super) fn has_place(&self, position: u32) -> bool {
        is_finite(&self.positions[position as usize])
    }

    pub(super) fn has_direction(&self, normal: u32) -> bool {
        is_finite(&self.normals[normal as usize])
    }

    pub(super) fn vertex(&self, position: u32, uv: Option<u32>, normal: Option<u32>) -> Vertex {
        let [r, g, b] = self.colors.get(position as usize).copied().unwrap_or(WHITE);
        let direction = |normal: u32| glam::Vec3::from(self.normals[normal as usize]).normalize_or(glam::Vec3::Y);
        Vertex {
            position: self.positions[position as usize],
            normal: normal.map_or(Vertex::PLAIN.normal, |n| direction(n).to_array()),
            uv: uv.map_or(Vertex::PLAIN.uv, |uv| self.uvs[uv as usize]),
            color: [r, g, b, 1.0],
            ..Vertex::PLAIN
        }
    }

    /// Returns a position of the file, if it has one.
    pub(super) fn somewhere(&self) -> [f32; 3] {
        self.positions.iter().copied().find(|place| is_finite(place)).unwrap_or_default()
    }

    pub(super) fn warnings(&self) -> Vec<MeshWarning> {
        let done = [
            "faces with such a position are skipped",
            "such texture coordinates are read as 0",
            "faces with such a normal get a computed one",
            "vertices with such a colour are white",
        ];
        let warning = |(broken, done): (&Option<(usize, String)>, &str)| {
            let (line, word) = broken.as_ref()?;
            let message = format!("line {line}: {word} is not a number; {done}");
            Some(MeshWarning { message, hint: "fix the model and re-export it".into() })
        };
        self.broken.iter().zip(done).filter_map(warning).collect()
    }

    /// Returns the error of a file in which every face has a position that is not a number.
    pub(super) fn no_places(&self) -> ModelError {
        let (line, word) = self.broken[Kind::Position as usize].clone().unwrap_or_default();
        let reason = format!("the position of a vertex is not a number ({word}), and every face has such a vertex");
        ModelError::Line { line, reason, hint: "fix the model and re-export it".into() }
    }
}

const WHITE: [f32; 3] = [1.0; 3];

fn is_finite(numbers: &[f32]) -> bool {
    numbers.iter().all(|x| x.is_finite())
}
