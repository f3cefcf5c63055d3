//! Quantities of passes that `eddy render` measures, and the assertions that are checked against them.

use super::report::{Report, Status};
use crate::{
    debugger::trace::Number,
    diag::Diagnostic,
    engine::{EngineError, Pixels},
    playback::{
        assertion::{self, Assertion, Quantity},
        offline::Offline,
    },
    project::{CustomUniforms, PassName, Project},
};
use serde::Serialize;
use std::collections::{HashMap, hash_map::Entry};

/// A measured value of a frame.
#[derive(Debug, Serialize)]
pub(super) struct Measured {
    pub quantity: String,
    pub frame: u32,
    pub value: Number,
}

/// The targets that are read of a frame, each with the number of components that it stores.
type Targets<'q> = HashMap<(&'q PassName, usize), (Pixels, usize)>;

fn target<'q>(read: &'q Targets<'q>, quantity: &'q Quantity) -> Option<&'q (Pixels, usize)> {
    read.get(&(&quantity.pass, quantity.target))
}

/// The quantities that are measured while a project is drawn.
pub(super) struct Measures<'a> {
    assertions: &'a [Assertion],
    quantities: Vec<Quantity>,
    uniforms: CustomUniforms,
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
    for comment in assertion::declared(project) {
        match comment.quantity {
            Ok(quantity) => quantities.push(quantity),
            Err(unmeasured) => diagnostics.push(unmeasured.diagnostic(comment.span)),
        }
    }
    (quantities, diagnostics)
}

impl<'a> Measures<'a> {
    /// Fails for an assertion with names that the project does not have.
    pub(super) fn new(
        project: &Project,
        quantities: Vec<Quantity>,
        assertions: &'a [Assertion],
    ) -> anyhow::Result<Self> {
        let uniforms = project.custom_uniforms();
        for assertion in assertions {
            assertion.check_names(&uniforms).map_err(|why| anyhow::anyhow!("--assert \"{assertion}\": {why}"))?;
        }
        Ok(Self { assertions, quantities, uniforms, first: Vec::new(), taken: Vec::new() })
    }

    /// Measures the frame that was drawn last. Failed assertions are added to the report.
    pub(super) fn take(
        &mut self,
        project: &Project,
        offline: &mut Offline,
        frame: u32,
        report: &mut Report,
    ) -> Result<(), EngineError> {
        let asserted = self.assertions.iter().map(|assertion| &assertion.quantity);
        let mut read = Targets::new();
        for Quantity { pass, target, .. } in self.quantities.iter().chain(asserted) {
            if let Entry::Vacant(entry) = read.entry((pass, *target)) {
                entry.insert((offline.read(pass, *target)?, assertion::stored(project, pass, *target)));
            }
        }
        let value = |quantity: &Quantity| match target(&read, quantity) {
            Some((pixels, stored)) => quantity.of(pixels, *stored),
            None => f64::NAN,
        };
        for quantity in &self.quantities {
            let value = Number::Double(value(quantity));
            self.taken.push(Measured { quantity: quantity.to_string(), frame, value });
        }
        if self.assertions.is_empty() {
            return Ok(());
        }
        if self.first.is_empty() {
            self.first = self.assertions.iter().map(|assertion| value(&assertion.quantity)).collect();
        }
        let conditions = offline.conditions(project, &self.uniforms)?;
        for (assertion, first) in self.assertions.iter().zip(&self.first) {
            let Some((pixels, stored)) = target(&read, &assertion.quantity) else { continue };
            if let Err(failure) = assertion.check(frame, (pixels, *stored), *first, &conditions) {
                report.fail(Status::Diagnostics, failure);
            }
        }
        Ok(())
    }
}
