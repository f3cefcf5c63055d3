//! The engine's side of drawing: executes one job after the other.

use super::{
    gate::Gate,
    history::History,
    job::{DrawnFrame, Job, JobResult, PendingChanges, TileLimit},
};
use eddy_engine::{CostClock, DrawFor, Engine, EngineError, FrameInputs, PassTime, Program};
use eddy_gpu::Gpu;
use std::time::{Duration, Instant};

/// A tile's time is significant if it is at least this fraction of a frame's limit; shorter times are lost in the noise
/// of other work.
const SIGNIFICANT: u32 = 20;
/// The approximate duration of a band of a frame: input waits no longer than this for the previous frame.
const BAND: Duration = Duration::from_millis(12);
/// Frames are drawn again for this long before the picture is shown and another request is handled.
const SEEK_SLICE: Duration = Duration::from_millis(150);

pub(crate) struct Renderer {
    engine: Engine,
    /// The display's picture is copied off the device.
    delivers_pictures: bool,
    history: History,
    /// `iFrame` and `iTime` of the targets' contents.
    shown: Option<(i32, f64)>,
    /// The duration of the newest frame that was drawn whole.
    whole_took: Duration,
    /// The newest frame was abandoned part way.
    is_abandoned: bool,
}

impl Renderer {
    /// `delivers_pictures`: deliver each new picture of the display with the answers.
    pub(crate) fn new(gpu: Gpu, (width, height): (u32, u32), delivers_pictures: bool) -> Result<Self, EngineError> {
        let mut engine = Engine::new(gpu, width, height)?;
        engine.set_timing(true);
        let history = History::default();
        Ok(Self { engine, delivers_pictures, history, shown: None, whole_took: Duration::ZERO, is_abandoned: false })
    }

    pub(crate) fn engine(&self) -> &Engine {
        &self.engine
    }

    pub(crate) fn engine_mut(&mut self) -> &mut Engine {
        &mut self.engine
    }

    pub(crate) fn history(&self) -> &History {
        &self.history
    }

    /// Returns `iFrame` and `iTime` of the targets' contents; `None` before the first frame.
    pub(crate) fn shown(&self) -> Option<(i32, f64)> {
        self.shown
    }

    pub(crate) fn work(&mut self, job: Job) -> JobResult {
        let Job { changes, frame, travel, stays, again, tasks, costs_of, tile_limit, gate } = job;
        let mut done = JobResult::default();
        // A new program draws its own frame.
        if changes.program.is_none() || !tasks.is_empty() {
            done.is_display_new |= self.finish();
        }
        let first_inputs = frame.clone().unwrap_or_else(|| FrameInputs::at_fixed_step(0, 60.0));
        let canvas = self.engine.size();
        if stays && changes.touches_targets(canvas) {
            self.rewind(changes.size.is_some());
        }
        self.change(changes, canvas, tile_limit, &first_inputs, &mut done);
        // Before a new frame, the shown one is drawn with the values that were set meanwhile.
        if stays && frame.is_some() && done.custom_uniforms_changed {
            self.rewind(false);
        }
        if again {
            self.redraw(costs_of.is_some(), &mut done);
        }
        if let Some(goal) = travel {
            let travelled = self.history.travel(&mut self.engine, goal, SEEK_SLICE);
            done.is_display_new |= travelled.as_ref().is_some_and(|t| t.as_ref().is_ok_and(|t| t.is_display_new));
            if let Some(Ok(travelled)) = &travelled {
                self.shown = Some((travelled.inputs.frame, travelled.inputs.time_secs));
            }
            done.travelled = Some(travelled);
        }
        if let Some(inputs) = frame {
            let size = self.engine.size();
            self.shown = Some((inputs.frame, inputs.time_secs));
            let is_ready = self.history.before_frame(&mut self.engine);
            done.is_display_new |= self.engine.size() != size;
            let drawn = is_ready.and_then(|()| self.draw(&inputs, costs_of.is_some(), gate.as_ref()));
            match &drawn {
                Ok(drawn) => self.history.frame_drawn(inputs, self.engine.size(), drawn.took),
                Err(_) => self.history.restart(false),
            }
            done.frame = Some(drawn);
        }
        done.is_late = self.engine.is_late();
        done.reach = self.history.reach();
        let has_drawn = done.frame.is_some() || done.travelled.is_some();
        // The canvas after a resize or a change of program has no valid picture until the next frame.
        let is_other = matches!(done.resized, Some((_, Ok(())))) || matches!(done.program, Some(Ok(())));
        let is_between = !has_drawn && is_other && done.restarted.is_none() && self.engine.program().is_some();
        let is_whole = !self.is_abandoned;
        if self.delivers_pictures && (done.is_display_new || has_drawn) && is_whole && !is_between {
            done.picture = Some(self.engine.picture());
        }
        done.outputs = tasks.run(self);
        done.costs = costs_of.map(|project| self.engine.pass_costs(&project));
        done.clock = Some(self.engine.cost_clock());
        done
    }

    /// Restores the contents of the targets before the shown frame, if they are kept.
    fn rewind(&mut self, is_size_coming: bool) {
        // A lost device is reported by the next request to it.
        if let Err(e) = self.history.rewind(&mut self.engine, is_size_coming) {
            log::error!("cannot draw a frame again: {e}");
        }
    }

    /// Draws the shown frame again.
    fn redraw(&mut self, is_watched: bool, done: &mut JobResult) {
        let size = self.engine.size();
        let drawn = match self.history.prepare_redraw(&mut self.engine) {
            Ok(Some(inputs)) => {
                self.shown = Some((inputs.frame, inputs.time_secs));
                self.draw(&inputs, is_watched, None)
            }
            Ok(None) => {
                done.cannot_redraw = true;
                return;
            }
            Err(error) => Err(error),
        };
        done.is_display_new |= self.engine.size() != size;
        match &drawn {
            Ok(drawn) => self.history.frame_redrawn(drawn.took),
            Err(_) => self.history.restart(false),
        }
        done.frame = Some(drawn);
    }

    /// `canvas`: the size of the picture so far.
    fn change(
        &mut self,
        changes: PendingChanges,
        canvas: (u32, u32),
        tile_limit: Option<TileLimit>,
        inputs: &FrameInputs,
        done: &mut JobResult,
    ) {
        let PendingChanges { restart, size, program, custom_uniforms, shown, look, reset, run, costs: _ } = changes;
        if restart {
            let made = Renderer::new(self.engine.gpu().clone(), self.engine.size(), self.delivers_pictures);
            done.restarted = Some(made.map(|renderer| *self = renderer));
            done.is_display_new = true;
        }
        if let Some(size) = size {
            self.resize(size, canvas, done);
        }
        if let Some(coming) = program {
            let tried = match tile_limit {
                Some(limit) => self.try_tiles(coming.program, limit, inputs, done),
                None => Ok(coming.program),
            };
            if done.forecast.is_some() {
                // The new program is not drawn for now: finish the frame, so that a whole picture is shown until then.
                self.finish();
            }
            done.program = Some(tried.and_then(|program| self.engine.set_program(program)));
            self.is_abandoned &= !matches!(done.program, Some(Ok(())));
            self.history.change_program();
            done.is_display_new = true;
        }
        if let Some(values) = custom_uniforms {
            done.custom_uniforms_changed = self.engine.set_custom_uniforms(&values);
            self.history.set_values(&values);
        }
        if let Some(pass) = shown {
            self.engine.show(pass);
            done.is_display_new = true;
        }
        if let Some(look) = look {
            self.engine.show_values(look);
            done.is_display_new = true;
        }
        if reset {
            self.engine.reset();
            self.history.restart(true);
            self.shown = None;
        }
        if let Some(frames) = run {
            self.history.load_run(frames);
        }
    }

    /// `canvas`: the size of the picture so far.
    fn resize(&mut self, (width, height): (u32, u32), canvas: (u32, u32), done: &mut JobResult) {
        if self.history.resize_before_frame((width, height)) {
            done.resized = Some(((width, height), Ok(())));
            return;
        }
        if (width, height) == canvas {
            return;
        }
        let resized = self.engine.resize(width, height);
        if resized.is_err() && self.engine.size() != canvas {
            // It has been rewound on another canvas.
            let _ = self.engine.resize(canvas.0, canvas.1);
        }
        done.resized = Some(((width, height), resized));
        self.history.resize();
        self.shown = None;
        done.is_display_new = true;
    }

    /// Draws a new program on a canvas of a few pixels, then on larger ones until the time is significant, and returns
    /// the estimated time of a whole frame if that is too long.
    fn try_tiles(
        &mut self,
        mut program: Program,
        limit: TileLimit,
        inputs: &FrameInputs,
        done: &mut JobResult,
    ) -> Result<Program, EngineError> {
        let canvas = self.engine.size();
        let significant = limit.frame / SIGNIFICANT;
        for tile in tiles(canvas) {
            let mut took = Duration::MAX;
            // The first run includes the driver's compilation, or is an outlier.
            for _ in 0..2 {
                let began = Instant::now();
                program = self.engine.try_out(program, tile, inputs)?;
                took = took.min(began.elapsed());
                if took < significant {
                    break;
                }
            }
            if took >= significant {
                let whole = took.mul_f64(self.engine.gpu().rasteriser().frame_per_tile(tile, canvas));
                done.forecast = (whole > limit.frame).then_some(whole);
                break;
            }
        }
        Ok(program)
    }

    /// Draws the rest of an abandoned frame. Returns whether there was any.
    fn finish(&mut self) -> bool {
        if !std::mem::take(&mut self.is_abandoned) {
            return false;
        }
        // A lost device is reported by the next request to it.
        self.engine
            .resume(&mut || Some(u32::MAX))
            .inspect_err(|e| log::error!("a frame could not be finished: {e}"))
            .unwrap_or(false)
    }

    /// Draws a frame. On a device without timestamps each pass is waited for while the costs are watched.
    fn draw(&mut self, inputs: &FrameInputs, is_watched: bool, gate: Option<&Gate>) -> Result<DrawnFrame, EngineError> {
        let began = Instant::now();
        let micros = || began.elapsed().as_secs_f64() * 1e6;
        let (cpu_micros, times): (f64, Option<Vec<PassTime>>);
        let rows = self.engine.gpu().rasteriser().band_rows(self.engine.size().1, self.whole_took, BAND);
        if let (Some(gate), Some(rows), false) = (gate, rows, is_watched) {
            let mut waited = Duration::ZERO;
            let mut next_rows = || {
                let asked = Instant::now();
                let goes_on = gate.pass();
                waited += asked.elapsed();
                goes_on.then_some(rows)
            };
            let is_whole = self.engine.draw_for(inputs, DrawFor::Bands(&mut next_rows))?.is_whole;
            self.is_abandoned = !is_whole;
            let took = began.elapsed().saturating_sub(waited);
            if is_whole {
                self.whole_took = took;
            }
            return Ok(DrawnFrame { cpu_micros: took.as_secs_f64() * 1e6, times: None, took });
        }
        if is_watched && self.engine.cost_clock() == CostClock::Waited {
            let waited = self.engine.draw_for(inputs, DrawFor::Timed(&mut || micros() / 1e3))?.times;
            (cpu_micros, times) = (micros(), Some(waited));
        } else {
            self.engine.draw(inputs)?;
            cpu_micros = micros();
            if self.delivers_pictures {
                self.engine.gpu().wait()?;
            }
            times = self.engine.pass_times();
        }
        (self.whole_took, self.is_abandoned) = (began.elapsed(), false);
        Ok(DrawnFrame { cpu_micros, times, took: self.whole_took })
    }
}

/// Returns the canvases that a new program is tried on, smallest first. A side is a power of two if that of the whole
/// canvas is: drivers compile again for the other kind.
fn tiles(canvas: (u32, u32)) -> impl Iterator<Item = (u32, u32)> {
    let side = |n: u32, other: u32| if n.is_power_of_two() { 16 } else { other };
    let first = (side(canvas.0, 24), side(canvas.1, 12));
    let sizes = (0..).map(move |n| (first.0 << (2 * n), first.1 << (2 * n)));
    sizes.take_while(move |tile| 2 * tile.0 <= canvas.0 && 2 * tile.1 <= canvas.1).take(6)
}

#[cfg(test)]
mod tests;
