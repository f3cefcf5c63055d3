//! Counts what a pass of a run executes, and measures the same frame.

use crate::offline::{Offline, OfflineError};
use eddy_engine::{
    BuildError, DrawFor, Engine, EngineError, PassTime,
    counts::{CountingProgram, PassCounts, Prices},
};
use eddy_project::{PassName, Project};
use std::time::Instant;

impl Offline {
    /// Compiles the counting variants of a pass of the program that was built of `project`; see [`Engine::counting`].
    pub fn counting(&self, project: &Project, pass: &PassName) -> Result<CountingProgram, BuildError> {
        self.engine()?.counting(project, pass)
    }

    /// Counts what a pass executed in the newest frame; see [`Engine::count`].
    pub fn count(&self, program: &CountingProgram, prices: &Prices) -> Result<PassCounts, EngineError> {
        self.engine()?.count(program, prices, &mut || false)
    }

    /// Draws the next frame several times from the same state. Returns the times of the passes of each, by the device's
    /// timestamps or the clock, as [`Offline::draw_timed`] does. The state afterwards is that of one frame.
    pub fn draw_repeatedly(&mut self, times: u32) -> Result<Vec<Vec<PassTime>>, OfflineError> {
        let inputs = self.next_inputs()?;
        self.within(inputs.frame, move |engine: &mut Engine| {
            let has_stamps = engine.set_timing(true);
            let state = engine.checkpoint()?;
            let mut all = Vec::new();
            for time in 0..times.max(1) {
                if time > 0 {
                    engine.restore(&state);
                }
                if has_stamps {
                    engine.draw_for(&inputs, DrawFor::Frame)?;
                    engine.gpu().wait()?;
                    all.push(engine.pass_times().unwrap_or_default());
                } else {
                    let began = Instant::now();
                    let mut now = || began.elapsed().as_secs_f64() * 1e3;
                    all.push(engine.draw_for(&inputs, DrawFor::Timed(&mut now))?.times);
                }
            }
            engine.set_timing(false);
            Ok(all)
        })
    }
}
