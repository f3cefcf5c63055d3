//! The time of each draw, taken while a frame is drawn piece by piece.

use super::{PassTime, Program};

/// A clock, and what it has said of each draw.
pub(super) struct Watch<'a> {
    /// Gives milliseconds since any moment.
    now: &'a mut dyn FnMut() -> f64,
    /// The time of handing in nothing and waiting for it.
    floor: f64,
    /// The milliseconds of each draw, all steps together.
    millis: Vec<f64>,
}

impl<'a> Watch<'a> {
    pub fn new(now: &'a mut dyn FnMut() -> f64, program: &Program) -> Self {
        Self { now, floor: 0.0, millis: vec![0.0; program.draws.len()] }
    }

    pub fn now(&mut self) -> f64 {
        (self.now)()
    }

    /// Takes the time since `began` for that of handing in nothing.
    pub fn set_floor(&mut self, began: f64) {
        self.floor = self.now() - began;
    }

    /// Adds what a draw took since `began`.
    pub fn add(&mut self, draw: usize, began: f64) {
        let millis = self.now() - began - self.floor;
        if let Some(sum) = self.millis.get_mut(draw) {
            *sum += millis.max(0.0);
        }
    }

    /// Returns the time of each pass.
    pub fn times(&self, program: &Program) -> Vec<PassTime> {
        let times = program.draws.iter().zip(&self.millis);
        times.map(|(draw, &gpu_millis)| PassTime { pass: draw.id.clone(), gpu_millis }).collect()
    }
}
