//! The cells per step by which a project moves: how they are set, and measured.

use eddy_playback::assertion::{Conditions, Reader, Statements};
use eddy_project::Expression;
use std::sync::Arc;

/// Makes a project move by a given number of cells per step. The speed is the largest value of the project's first check.
#[derive(Clone, Debug)]
pub struct Courant {
    /// The slider that sets it.
    pub slider: String,
    /// The slider's value by `cells` per step, at the speed that results from the project's own forces, and by the
    /// `width` and `height` of the canvas.
    pub(super) value: Expression,
    /// Cells per step by `fastest`, the speed, and the conditions of the case.
    pub(super) cells: Expression,
    /// The reason why it stays below the requested values, if there is one.
    pub limit: Option<Arc<str>>,
}

impl Courant {
    /// Reads `SLIDER = EXPRESSION gives EXPRESSION [because "REASON"]`.
    pub(super) fn read(reader: &mut Reader<'_>, statements: &Statements) -> Result<Courant, String> {
        let slider = reader.name("a slider")?.to_owned();
        reader.want("=", "after the slider")?;
        let value = reader.expression("its value by `cells`")?;
        reader.want("gives", "and the cells per step by `fastest`")?;
        let cells = reader.expression("the cells per step by `fastest`")?;
        let limit = if reader.has("because") { Some(statements.text(reader)?) } else { None };
        Ok(Courant { slider, value, cells, limit })
    }

    /// Returns the slider's value for cells per step, on a canvas of this size.
    pub fn value(&self, cells: f64, size: (u32, u32)) -> f64 {
        let canvas = Conditions { size, ..Conditions::default() };
        self.value.value(&|name| if name == "cells" { cells } else { canvas.value(name) })
    }

    /// Returns the cells per step at a speed.
    pub fn cells(&self, fastest: f64, conditions: &Conditions) -> f64 {
        self.cells.value(&|name| if name == "fastest" { fastest } else { conditions.value(name) })
    }
}
