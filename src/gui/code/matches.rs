//! The matches of a query in all texts of the project.

use crate::{gui::editor::Query, project::Tab};
use std::ops::Range;

/// The matches of a query in all texts.
#[derive(Default)]
pub(super) struct Everywhere {
    /// The query, and the texts' revisions, that they are of.
    pub of: Option<(Query, Vec<(Tab, u64)>)>,
    pub places: Vec<(Tab, Range<usize>)>,
    /// They are listed below the code.
    pub is_listed: bool,
}

impl Everywhere {
    pub fn count(&self) -> usize {
        self.places.len()
    }
}
