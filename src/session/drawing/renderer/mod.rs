//! The engine's side of drawing: executes one job after the other.

use super::{
    changes::{Change, PendingChanges},
    gate::Gate,
    history::History,
    job::{Draw, DrawnFrame, Event, Job, JobResult, TileLimit},
};
use crate::playback::SeekTarget;
use eddy_engine::{CostClock, DrawFor, Engine, EngineError, FrameInputs, PassTime, Picture, Program};
use eddy_gpu::{Gpu, GpuError};
use std::{
    sync::{Arc, atomic::AtomicBool},
    time::{Duration, Instant},
};

/// A tile's time is significant if it is at least this fraction of a frame's limit; shorter times are lost in the noise
/// of other work.
const SIGNIFICANT: u32 = 20;
/// The approximate duration of a band of a frame: input waits no longer than this for the previous frame.
const BAND: Duration = Duration::from_millis(12);
/// Frames are drawn again for this long before the picture is shown and another request is handled.
const SEEK_SLICE: Duration = Duration::from_millis(150);

/// The way in which the session gets the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Delivery {
    /// The session owns the engine, and reads its display.
    Inline,
    /// As the engine's texture: the window is painted on the same device.
    Texture,
    /// As bytes, which are copied to the window's device.
    Bytes,
}

/// A picture that the engine delivers, with its first row at the top.
pub(crate) enum ShownPicture {
    /// The engine draws the next ones into the same texture, until its size changes.
    Texture {
        view: wgpu::TextureView,
        size: (u32, u32),
    },
    Bytes(Picture),
}

pub(crate) struct Renderer {
    engine: Engine,
    delivery: Delivery,
    /// Ends a frame on a device that is shared with the window.
    stop: Arc<AtomicBool>,
    history: History,
    /// `iFrame` and `iTime` of the targets' contents.
    shown: Option<(i32, f64)>,
    /// The duration of the newest frame that was drawn whole.
    whole_took: Duration,
    /// The newest frame was abandoned part way.
    is_abandoned: bool,
}

impl Renderer {
    pub(crate) fn new(
        gpu: Gpu,
        (width, height): (u32, u32),
        delivery: Delivery,
        stop: Arc<AtomicBool>,
    ) -> Result<Self, EngineError> {
        let mut engine = Engine::new(gpu, width, height)?;
        engine.set_timing(true);
        engine.stop_by(stop.clone());
        let (history, whole_took) = (History::default(), Duration::ZERO);
        Ok(Self { engine, delivery, stop, history, shown: None, whole_took, is_abandoned: false })
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
        let Job { changes, draw, stays, tasks, costs_of, tile_limit, gate } = job;
        let mut done = JobResult::default();
        // A new program draws its own frame.
        if changes.program().is_none() || !tasks.is_empty() {
            done.is_display_new |= self.finish();
        }
        let (canvas, restarts) = (self.engine.size(), changes.has(&Change::Restart));
        if stays && changes.touches_targets(canvas) {
            self.rewind(changes.size().is_some());
        }
        let first_inputs = match &draw {
            Draw::Next(inputs) => inputs.clone(),
            _ => FrameInputs::at_fixed_step(0, 60.0),
        };
        let has_new_values = self.change(changes, canvas, tile_limit, &first_inputs, &mut done);
        let is_resized = done.events.iter().any(|event| matches!(event, Event::Resized(_, Ok(()))));
        let is_other = is_resized || done.events.iter().any(|event| matches!(event, Event::ProgramSet(Ok(_))));
        let (is_seek, is_watched) = (matches!(draw, Draw::Seek(_)), costs_of.is_some());
        let drawn = match draw {
            Draw::Nothing => None,
            Draw::Next(inputs) => {
                // Before a new frame, the shown one is drawn with the values that were set meanwhile.
                if stays && has_new_values {
                    self.rewind(false);
                }
                Some(self.draw_next(inputs, is_watched, gate.as_ref(), &mut done))
            }
            Draw::Again => self.redraw(is_watched, &mut done),
            Draw::Seek(goal) => {
                self.travel(goal, &mut done);
                None
            }
        };
        let has_frame = drawn.is_some() || done.has_frame();
        if !has_frame && (is_resized || has_new_values) {
            done.events.push(Event::Outdated);
        } else if has_frame && self.engine.is_late() {
            done.events.push(Event::Late);
        }
        // The canvas after a resize or a change of program has no valid picture until the next frame.
        let has_drawn = drawn.is_some() || is_seek;
        let is_between = !has_drawn && is_other && !restarts && self.engine.program().is_some();
        let is_due = done.is_display_new || has_drawn;
        let picture = self.picture(is_due && !self.is_abandoned && !is_between);
        match drawn.transpose().and_then(|frame| Ok((frame, picture.transpose()?))) {
            Ok((frame, picture)) => {
                done.events.extend(picture.map(Event::Picture));
                done.events.extend(frame.map(Event::Drawn));
            }
            Err(error) => done.events.push(Event::Failed(error)),
        }
        done.outputs = tasks.run(self);
        done.events.push(Event::Reach(self.history.reach()));
        done.events.extend(costs_of.map(|project| Event::Costs(self.engine.pass_costs(&project))));
        done.events.push(Event::Clock(self.engine.cost_clock()));
        done
    }

    /// Returns the picture for the session, if it is due.
    fn picture(&mut self, is_due: bool) -> Option<Result<ShownPicture, EngineError>> {
        match self.delivery {
            Delivery::Bytes if is_due => Some(self.engine.picture().map(ShownPicture::Bytes)),
            Delivery::Texture if is_due => {
                let (view, size) = (self.engine.display().clone(), self.engine.display_size());
                Some(Ok(ShownPicture::Texture { view, size }))
            }
            _ => None,
        }
    }

    /// Restores the contents of the targets before the shown frame, if they are kept.
    fn rewind(&mut self, is_size_coming: bool) {
        // A lost device is reported by the next request to it.
        if let Err(e) = self.history.rewind(&mut self.engine, is_size_coming) {
            log::error!("cannot draw a frame again: {e}");
        }
    }

    fn draw_next(
        &mut self,
        inputs: FrameInputs,
        is_watched: bool,
        gate: Option<&Gate>,
        done: &mut JobResult,
    ) -> Result<DrawnFrame, EngineError> {
        let size = self.engine.size();
        self.shown = Some((inputs.frame, inputs.time_secs));
        let is_ready = self.history.before_frame(&mut self.engine);
        done.is_display_new |= self.engine.size() != size;
        let drawn = is_ready.and_then(|()| self.draw(&inputs, is_watched, gate));
        match &drawn {
            Ok(drawn) => self.history.frame_drawn(inputs, self.engine.size(), drawn.took),
            // Another device draws the same frames again.
            Err(EngineError::Gpu(GpuError::Lost(_))) => {}
            Err(_) => self.history.restart(false),
        }
        drawn
    }

    /// Draws the shown frame again, if its inputs are kept.
    fn redraw(&mut self, is_watched: bool, done: &mut JobResult) -> Option<Result<DrawnFrame, EngineError>> {
        let size = self.engine.size();
        let drawn = match self.history.prepare_redraw(&mut self.engine) {
            Ok(Some(inputs)) => {
                self.shown = Some((inputs.frame, inputs.time_secs));
                self.draw(&inputs, is_watched, None)
            }
            Ok(None) => {
                done.events.push(Event::CannotRedraw);
                return None;
            }
            Err(error) => Err(error),
        };
        done.is_display_new |= self.engine.size() != size;
        match &drawn {
            Ok(drawn) => self.history.frame_redrawn(drawn.took),
            // Another device draws the same frames again.
            Err(EngineError::Gpu(GpuError::Lost(_))) => {}
            Err(_) => self.history.restart(false),
        }
        Some(drawn)
    }

    /// Shows another frame of the run.
    fn travel(&mut self, goal: SeekTarget, done: &mut JobResult) {
        let travelled = self.history.travel(&mut self.engine, goal, SEEK_SLICE);
        if let Some(Ok(travelled)) = &travelled {
            done.is_display_new |= travelled.is_display_new;
            self.shown = Some((travelled.inputs.frame, travelled.inputs.time_secs));
        }
        done.events.push(Event::Travelled(travelled));
    }

    /// Applies changes. `canvas`: the size of the picture so far. Returns whether the author's own uniforms have new
    /// values.
    fn change(
        &mut self,
        changes: PendingChanges,
        canvas: (u32, u32),
        tile_limit: Option<TileLimit>,
        inputs: &FrameInputs,
        done: &mut JobResult,
    ) -> bool {
        let mut has_new_values = false;
        for change in changes.0 {
            done.is_display_new |=
                matches!(change, Change::Restart | Change::Program(_) | Change::Show(_) | Change::Look(_));
            match change {
                Change::Restart => {
                    let (gpu, stop) = (self.engine.gpu().clone(), self.stop.clone());
                    match Renderer::new(gpu, self.engine.size(), self.delivery, stop) {
                        Ok(renderer) => *self = renderer,
                        Err(error) => done.events.push(Event::Failed(error)),
                    }
                }
                Change::Resize(size) => self.resize(size, canvas, done),
                Change::Program(coming) => {
                    let tried = match tile_limit {
                        Some(limit) => self.try_tiles(coming.program, limit, inputs),
                        None => Ok((coming.program, None)),
                    };
                    if matches!(tried, Ok((_, Some(_)))) {
                        // It is not drawn for now: finish the frame, so that a whole picture is shown until then.
                        self.finish();
                    }
                    let set = tried.and_then(|(program, forecast)| self.engine.set_program(program).map(|()| forecast));
                    self.is_abandoned &= set.is_err();
                    done.events.push(Event::ProgramSet(set));
                    self.history.change_program();
                }
                Change::CustomUniforms(values) => {
                    has_new_values = self.engine.set_custom_uniforms(&values);
                    self.history.set_values(&values);
                }
                Change::Show(pass) => self.engine.show(pass),
                Change::Look(look) => self.engine.show_values(look),
                Change::Reset => {
                    self.engine.reset();
                    self.history.restart(true);
                    self.shown = None;
                }
                Change::Run(frames) => self.history.load_run(frames),
                // Read after the frame.
                Change::Costs => {}
            }
        }
        has_new_values
    }

    /// `canvas`: the size of the picture so far.
    fn resize(&mut self, (width, height): (u32, u32), canvas: (u32, u32), done: &mut JobResult) {
        if self.history.resize_before_frame((width, height)) {
            done.events.push(Event::Resized((width, height), Ok(())));
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
        done.events.push(Event::Resized((width, height), resized));
        self.history.resize();
        self.shown = None;
        done.is_display_new = true;
    }

    /// Draws a new program on a canvas of a few pixels, then on larger ones until the time is significant. Returns it
    /// with the estimated time of a whole frame if that is too long.
    fn try_tiles(
        &mut self,
        mut program: Program,
        limit: TileLimit,
        inputs: &FrameInputs,
    ) -> Result<(Program, Option<Duration>), EngineError> {
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
                return Ok((program, (whole > limit.frame).then_some(whole)));
            }
        }
        Ok((program, None))
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
            if self.delivery != Delivery::Inline {
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
