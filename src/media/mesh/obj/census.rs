//! Counts the contents of a file before memory is allocated.

use super::{
    numbers::whole,
    text::{Statement, statements},
};
use crate::mesh::{
    error::MeshWarning,
    trouble::{Counts, ModelError},
};

/// The sizes of a file, and the first of its oddities.
#[derive(Debug, Default)]
pub(super) struct Census {
    /// The numbers of positions, triangles and parts.
    pub counts: Counts,
    pub uvs: usize,
    pub normals: usize,
    lines: u64,
    points: u64,
    /// The first line with a curve or a surface.
    free_form: Option<usize>,
    /// The first line with a face that uses vertex 0, which OBJ does not have.
    zero: Option<usize>,
    /// The highest vertex number of a face.
    highest: i64,
    /// A face uses relative (negative) numbers.
    is_relative: bool,
    /// The file contains an OBJ keyword.
    is_obj: bool,
}

impl Census {
    pub(super) fn of(text: &[u8]) -> Result<Census, ModelError> {
        let mut census = Census::default();
        for statement in statements(text) {
            if let Some(keyword) = statement.words().next() {
                census.add(keyword, statement)?;
            }
        }
        Ok(census)
    }

    fn add(&mut self, keyword: &[u8], statement: Statement<'_>) -> Result<(), ModelError> {
        match keyword {
            b"v" => self.counts.add(1, 0)?,
            b"vt" => self.uvs += 1,
            b"vn" => self.normals += 1,
            b"l" => self.lines += 1,
            b"p" => self.points += 1,
            b"f" | b"fo" => self.add_face(statement)?,
            b"o" | b"g" => self.counts.add_part()?,
            b"curv" | b"curv2" | b"surf" => drop(self.free_form.get_or_insert(statement.line_of(keyword))),
            b"mtllib" | b"usemtl" | b"s" | b"vp" => {}
            _ => return Ok(()),
        }
        self.is_obj = true;
        Ok(())
    }

    fn add_face(&mut self, statement: Statement<'_>) -> Result<(), ModelError> {
        let mut corners: u64 = 0;
        for corner in statement.words().skip(1) {
            corners += 1;
            let vertex = corner.split(|b| *b == b'/').next().and_then(whole);
            self.highest = self.highest.max(vertex.unwrap_or_default());
            self.is_relative |= vertex.is_some_and(|n| n < 0);
            if vertex == Some(0) {
                self.zero.get_or_insert(statement.line_of(corner));
            }
        }
        self.counts.add(0, corners.saturating_sub(2))
    }

    /// Returns the number of the first element: 1, but 0 if a face uses vertex 0, and counting from 0 leaves all
    /// numbers of faces in range.
    pub(super) fn first(&self) -> i64 {
        let counts_from_zero = self.zero.is_some() && !self.is_relative && self.highest < self.counts.vertices as i64;
        i64::from(!counts_from_zero)
    }

    pub(super) fn warnings(&self) -> Vec<MeshWarning> {
        let zero = self.zero.filter(|_| self.first() == 0).map(|line| MeshWarning {
            message: format!("line {line}: a face uses vertex 0, so all faces are read as counting from 0"),
            hint: "OBJ counts from 1: add 1 to every number of a face".into(),
        });
        let free_form = self.free_form.map(|line| MeshWarning {
            message: format!("line {line}: its curves and surfaces are not drawn"),
            hint: "export them as triangles".into(),
        });
        zero.into_iter().chain(free_form).collect()
    }

    /// Returns the warning for a file without triangles, or an error if it is not an OBJ file at all.
    pub(super) fn no_triangles(&self) -> Result<MeshWarning, ModelError> {
        if !self.is_obj {
            return Err(ModelError::broken("it has no triangles"));
        }
        let (vertices, lines, points) = (self.counts.vertices, self.lines, self.points);
        Ok(MeshWarning {
            message: format!(
                "it has no triangles, so nothing of it is drawn (vertices: {vertices}, lines: {lines}, points: \
                 {points})"
            ),
            hint: "export the model with faces".into(),
        })
    }
}
