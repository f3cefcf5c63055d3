//! The state of the engine for the open project, as its last result reported it.

use super::{Change, Event, PendingChanges, ProgramOrigin};
use crate::playback::Reach;
use eddy_engine::{CostClock, PassCost};
use eddy_gpu::Gpu;
use eddy_project::{CustomUniform, PassName, Project};
use std::mem::take;

pub(crate) struct EngineStatus {
    size: (u32, u32),
    program: Option<ProgramOrigin>,
    costs: Vec<PassCost>,
    clock: CostClock,
    reach: Reach,
    /// The job that the engine has.
    submitted: Submitted,
}

/// The part of a job that changes the status.
#[derive(Default)]
struct Submitted {
    size: Option<(u32, u32)>,
    program: Option<ProgramOrigin>,
}

impl EngineStatus {
    /// The status of an engine on `gpu` without a program.
    pub(crate) fn new(gpu: &Gpu, size: (u32, u32)) -> Self {
        let clock = if gpu.has_timestamps { CostClock::Timestamps } else { CostClock::Waited };
        Self::with_clock(size, clock)
    }

    /// The status for another project, of which nothing is drawn yet. The picture keeps its size until then.
    pub(crate) fn successor(&self) -> Self {
        Self::with_clock(self.size, self.clock)
    }

    fn with_clock(size: (u32, u32), clock: CostClock) -> Self {
        Self { size, program: None, costs: Vec::new(), clock, reach: Reach::default(), submitted: Submitted::default() }
    }

    /// The canvas size of the newest picture.
    pub(crate) fn size(&self) -> (u32, u32) {
        self.size
    }

    /// The canvas size of the engine after the job in flight.
    pub(crate) fn coming_size(&self) -> (u32, u32) {
        self.submitted.size.unwrap_or(self.size)
    }

    /// Returns whether the engine has a program.
    pub(crate) fn has_program(&self) -> bool {
        self.program.is_some()
    }

    /// Returns whether the job in flight sets a program.
    pub(crate) fn is_program_coming(&self) -> bool {
        self.submitted.program.is_some()
    }

    /// The project of the program that draws.
    pub(crate) fn project(&self) -> Option<&Project> {
        self.program.as_ref().map(|program| &program.project)
    }

    /// Returns whether the current program is of the newest text that compiled, not a fallback.
    pub(crate) fn is_newest_program(&self) -> bool {
        self.new_program_millis().is_some()
    }

    /// Milliseconds of its compile, if the current program is of the newest text.
    pub(crate) fn new_program_millis(&self) -> Option<f64> {
        self.program.as_ref().and_then(|program| program.millis)
    }

    /// The author's own uniforms, as the current program declares them.
    pub(crate) fn custom_uniforms(&self) -> &[CustomUniform] {
        self.program.as_ref().map_or(&[], |program| &program.custom_uniforms)
    }

    /// Returns whether the program draws a pass.
    pub(crate) fn draws(&self, pass: &PassName) -> bool {
        self.program.as_ref().is_some_and(|program| program.drawn.contains(pass))
    }

    /// The passes' costs when they were last requested.
    pub(crate) fn costs(&self) -> &[PassCost] {
        &self.costs
    }

    pub(crate) fn clock(&self) -> CostClock {
        self.clock
    }

    /// The range of frames for seeking.
    pub(crate) fn reach(&self) -> Reach {
        self.reach
    }

    /// Drops the current program. The picture stays until there is another.
    pub(crate) fn drop_program(&mut self) {
        (self.program, self.submitted.program) = (None, None);
    }

    /// Records the changes of a job that is about to be submitted. The engine gets the program, and its origin stays here.
    pub(crate) fn submit(&mut self, changes: &mut PendingChanges) {
        self.submitted = Submitted { size: changes.size(), ..Submitted::default() };
        for change in &mut changes.0 {
            if let Change::Program(coming) = change {
                self.submitted.program = coming.origin.take();
            }
        }
    }

    /// Records the events of that job. Of one for the previous project only the size of the picture counts.
    pub(crate) fn finish(&mut self, events: &mut [Event], is_of_project: bool) {
        let Submitted { mut program, .. } = take(&mut self.submitted);
        self.reach = Reach::default();
        for event in events {
            match event {
                Event::Resized(size, Ok(())) => self.size = *size,
                _ if !is_of_project => {}
                Event::ProgramSet(Ok(_)) => self.program = program.take(),
                Event::Reach(reach) => self.reach = *reach,
                Event::Clock(clock) => self.clock = *clock,
                Event::Costs(costs) => self.costs = take(costs),
                _ => {}
            }
        }
    }
}
