//! Quantities of passes that `eddy render` measures, and the assertions that are checked against them.

use super::report::{Report, Status};
use crate::{
    debugger::trace::Number,
    diag::Diagnostic,
    engine::{EngineError, Pixels},
    playback::{
        offline::Offline,
        reduction::{self, Assertion, Quantity},
    },
    project::{PassName, Project},
};
use serde::Serialize;
use std::collections::HashMap;

/// A measured value of a frame.
#[derive(Debug, Serialize)]
pub(super) struct Measured {
    pub quantity: String,
    pub frame: u32,
    pub value: Number,
}

/// The quantities that are measured while a project is drawn.
pub(super) struct Measures<'a> {
    assertions: &'a [Assertion],
    quantities: Vec<Quantity>,
    /// The number of components that the target of each quantity stores.
    stored: Vec<usize>,
    /// The value of each assertion's quantity in the first frame.
    first: Vec<f64>,
    pub taken: Vec<Measured>,
}

impl Measures<'_> {
    pub(super) fn is_empty(&self) -> bool {
        self.quantities.is_empty() && self.assertions.is_empty()
    }
}

/// Returns the quantities that `//@probe` comments of a project request, and errors for those that cannot be measured.
pub(super) fn declared(project: &Project) -> (Vec<Quantity>, Vec<Diagnostic>) {
    let (mut quantities, mut diagnostics) = (Vec::new(), Vec::new());
    for comment in reduction::declared(project) {
        match comment.quantity {
            Ok(quantity) => quantities.push(quantity),
            Err(unmeasured) => diagnostics.push(unmeasured.diagnostic(comment.span)),
        }
    }
    (quantities, diagnostics)
}

impl<'a> Measures<'a> {
    pub(super) fn new(project: &Project, quantities: Vec<Quantity>, assertions: &'a [Assertion]) -> Self {
        let stored = quantities.iter().map(|quantity| components(project, quantity)).collect();
        Self { assertions, quantities, stored, first: Vec::new(), taken: Vec::new() }
    }

    /// Measures the frame that was drawn last. Failed assertions are added to the report.
    pub(super) fn take(
        &mut self,
        project: &Project,
        offline: &mut Offline,
        frame: u32,
        report: &mut Report,
    ) -> Result<(), EngineError> {
        let mut read: HashMap<(PassName, usize), Pixels> = HashMap::new();
        let mut value = |quantity: &Quantity, stored: usize| -> Result<f64, EngineError> {
            let key = (quantity.pass.clone(), quantity.target);
            let pixels = match read.get(&key) {
                Some(pixels) => pixels,
                None => {
                    let pixels = offline.read(&quantity.pass, quantity.target)?;
                    read.entry(key).or_insert(pixels)
                }
            };
            Ok(quantity.of(pixels, stored))
        };
        for (quantity, &stored) in self.quantities.iter().zip(&self.stored) {
            let value = value(quantity, stored)?;
            self.taken.push(Measured { quantity: quantity.to_string(), frame, value: Number::Double(value) });
        }
        let is_first = self.first.is_empty();
        for (i, assertion) in self.assertions.iter().enumerate() {
            let value = value(&assertion.quantity, components(project, &assertion.quantity))?;
            if is_first {
                self.first.push(value);
            }
            if let Err(failure) = assertion.check(frame, value, self.first[i]) {
                report.fail(Status::Diagnostics, failure);
            }
        }
        Ok(())
    }
}

fn components(project: &Project, quantity: &Quantity) -> usize {
    reduction::stored(project, &quantity.pass, quantity.target)
}
