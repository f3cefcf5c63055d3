//! Says what can be wrong with a model, and how much of one is loaded.

use super::model::Vertex;
use crate::project::{confine::FileError, limits};

/// An error of a model before the model's name is added.
#[derive(Debug)]
pub(super) enum Trouble {
    Broken(String),
    /// An error in a line of a text, counted from 1, and how to mend it.
    Line {
        line: usize,
        reason: String,
        mend: String,
    },
    TooLarge(String),
    /// An error of a file that the model names.
    Named(FileError),
}

impl Trouble {
    /// Cut short where a parser quotes a whole file.
    pub fn broken(reason: impl std::fmt::Display) -> Trouble {
        const LONGEST: usize = 400;
        let reason = reason.to_string();
        Trouble::Broken(match reason.char_indices().nth(LONGEST) {
            Some((end, _)) => format!("{}…", &reason[..end]),
            None => reason,
        })
    }
}

/// The sizes of a model, counted before any of it is made.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counts {
    pub vertices: u64,
    pub triangles: u64,
    pub parts: u64,
}

impl Counts {
    pub fn add(&mut self, vertices: u64, triangles: u64) -> Result<(), Trouble> {
        self.vertices = self.vertices.saturating_add(vertices);
        self.triangles = self.triangles.saturating_add(triangles);
        at_most(self.vertices, limits::MODEL_VERTICES, "vertices")?;
        at_most(self.triangles, limits::MODEL_TRIANGLES, "triangles")
    }

    pub fn add_part(&mut self) -> Result<(), Trouble> {
        self.parts += 1;
        at_most(self.parts, limits::MODEL_PARTS, "parts")
    }

    /// Returns whether there is room for them.
    pub fn fit(&self, room: u64) -> Result<(), Trouble> {
        if self.vertices * size_of::<Vertex>() as u64 + self.triangles * 12 <= room {
            return Ok(());
        }
        let all = limits::in_bytes(limits::MEDIA_BYTES);
        Err(Trouble::TooLarge(format!("with it the pictures and models of the project take more than {all}")))
    }
}

pub(super) fn at_most(count: u64, limit: u64, what: &str) -> Result<(), Trouble> {
    if count <= limit {
        return Ok(());
    }
    Err(Trouble::TooLarge(format!("it has more than {limit} {what}, which are the most that Eddy loads of a model")))
}
