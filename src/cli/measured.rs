//! Numbers of passes that `eddy render` measures, and the claims that are held against them.

use super::report::{Report, Status};
use crate::{
    diag::{Diagnostic, Span},
    engine::{EngineError, Pixels},
    project::{PassFormat, PassId, Project, inspect_comments},
    session::{
        offline::Offline,
        reduction::{Assertion, Quantity},
        trace::Number,
    },
};
use serde::Serialize;
use std::collections::HashMap;

/// A number of a frame.
#[derive(Debug, Serialize)]
pub struct Measured {
    pub quantity: String,
    pub frame: u32,
    pub value: Number,
}

/// What is measured of a project while it is drawn.
pub struct Measures<'a> {
    assertions: &'a [Assertion],
    quantities: Vec<Quantity>,
    /// How many components each of them may take.
    stored: Vec<usize>,
    /// What each assertion's quantity was in the first frame.
    first: Vec<f64>,
    pub taken: Vec<Measured>,
}

/// What `//@probe` comments of a project ask for, and what is wrong with those that cannot be measured.
pub fn declared(project: &Project) -> (Vec<Quantity>, Vec<Diagnostic>) {
    let (mut quantities, mut diagnostics) = (Vec::new(), Vec::new());
    for (id, source) in project.texts().iter() {
        for comment in inspect_comments(&source.text).into_iter().filter(|comment| comment.kind == "probe") {
            let quantity = Quantity::parse(comment.argument).and_then(|quantity| match project.pass(&quantity.pass) {
                Some(_) => Ok(quantity),
                None => Err(format!("there is no pass {}", quantity.pass.key())),
            });
            match quantity {
                Ok(quantity) => quantities.push(quantity),
                Err(why) => {
                    let span = Span::new(id, comment.range);
                    let hint = "the form is //@probe sum(buffer_a.x), with sum, min, max, mean, rms or nonfinite";
                    diagnostics.push(Diagnostic::warning(span, format!("nothing is measured here: {why}")).hint(hint));
                }
            }
        }
    }
    (quantities, diagnostics)
}

impl<'a> Measures<'a> {
    pub fn new(project: &Project, quantities: Vec<Quantity>, assertions: &'a [Assertion]) -> Self {
        let stored = quantities.iter().map(|quantity| components(project, &quantity.pass)).collect();
        Self { assertions, quantities, stored, first: Vec::new(), taken: Vec::new() }
    }

    /// Measures the frame that was drawn last. A claim that does not hold goes into the report.
    pub fn take(
        &mut self,
        project: &Project,
        offline: &mut Offline,
        frame: u32,
        report: &mut Report,
    ) -> Result<(), EngineError> {
        let mut read: HashMap<(PassId, usize), Pixels> = HashMap::new();
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
            let value = value(&assertion.quantity, components(project, &assertion.quantity.pass))?;
            if is_first {
                self.first.push(value);
            }
            if let Err(failure) = assertion.check(frame, value, self.first[i]) {
                report.fail(Status::Diagnostics, failure);
            }
        }
        Ok(())
    }

    /// A line for each number.
    pub fn words(&self) -> String {
        self.taken.iter().map(|m| format!("\n  {} = {} in frame {}", m.quantity, m.value, m.frame)).collect()
    }
}

fn components(project: &Project, pass: &PassId) -> usize {
    project.pass(pass).map_or_else(PassFormat::default, |pass| pass.settings.format).components()
}
