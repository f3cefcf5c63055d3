//! A frame: the loop that executes the operations of a [`Schedule`](eddy_graph::Schedule).

use super::{
    EngineError, FrameInputs, FrameStats, PassInputs, PassTime, Program,
    display::Display,
    host,
    inspect::Capture,
    resting,
    running::Running,
    shared::Shared,
    sound,
    uniforms::{self, UniformReads},
};
use eddy_gpu::Gpu;
use eddy_graph::{Dependencies, FrameOp, FrameState, Lap, Purpose, SlicePart, SliceTimes};
use eddy_project::{PassName, Region};
use std::sync::atomic::Ordering;

/// A callback that, before each band of a draw, returns the number of rows to draw next; `None` stops there.
pub type Rows<'a> = dyn FnMut() -> Option<u32> + 'a;

/// The purpose of drawing a frame, and the callbacks that it needs.
pub enum DrawFor<'a> {
    /// To show it. Does not wait for the device, except if that is shared with a window ([`Gpu::slices`]).
    Frame,
    /// For later frames: these are the same as after [`DrawFor::Frame`], but only draws that they depend on are done
    /// and nothing is shown. The contents of other passes are unspecified until the next frame.
    Advance,
    /// To measure the time of each pass on a device without timestamps: each pass is submitted and waited for
    /// separately. The function returns milliseconds from an arbitrary origin. The frame takes longer this way.
    Timed(&'a mut dyn FnMut() -> f64),
    /// To read back the inputs of a pass when it is drawn; for a pass of several steps, those of its last step. Waits
    /// for the device.
    Inspect(&'a PassName),
    /// To show it without blocking the device for long: waits for the device, and draws a last pass that no other pass
    /// reads in bands of rows. If the caller stops, the display keeps the previous frame, but everything that later
    /// frames read is drawn; [`Engine::resume`](super::Engine::resume) draws the rest.
    Bands(&'a mut Rows<'a>),
}

/// A frame that was drawn.
#[derive(Debug, Default)]
pub struct Drawn {
    pub stats: FrameStats,
    /// The time of each pass, for [`DrawFor::Timed`].
    pub times: Vec<PassTime>,
    /// The inputs of the pass, for [`DrawFor::Inspect`].
    pub read: Option<PassInputs>,
    /// True if the caller did not stop the frame.
    pub is_whole: bool,
    /// The number of submissions to the device.
    pub submissions: u32,
}

/// The remaining operations of the newest frame.
#[derive(Debug, Default)]
pub(super) struct Unfinished {
    ops: std::vec::IntoIter<FrameOp>,
    /// The number of rows already drawn by the first of them, an [`FrameOp::EncodeRows`].
    rows: u32,
    /// The frame is submitted in slices.
    is_sliced: bool,
}

/// The caller's callbacks and results of a frame.
pub(super) struct Caller<'a, 'c> {
    pub rows: &'a mut Rows<'a>,
    pub watch: Option<&'a mut Watch<'c>>,
    pub capture: Option<&'a mut Capture<'c>>,
}

impl Running {
    /// Schedules a frame and executes it to its end, or until the caller stops it. Returns the work of the frame and
    /// whether it is complete. With a `display`, the picture is presented.
    pub(crate) fn draw(
        &mut self,
        shared: &Shared,
        display: Option<&Display>,
        inputs: &FrameInputs,
        purpose: Purpose,
        caller: &mut Caller<'_, '_>,
    ) -> Result<(FrameStats, bool), EngineError> {
        self.drop_unfinished();
        let off = self.turn_off(shared);
        self.program.externals.iter_mut().for_each(|external| external.update(&shared.gpu, inputs));
        self.set_uniforms(&shared.gpu, inputs);
        // The inputs are the same at every step.
        self.resting.update(&self.program, self.uniforms.custom_uniforms());
        let (dependencies, inputs): (Vec<_>, Vec<_>) =
            (0..self.program.draws.len()).map(|index| self.inputs_of(index)).unzip();
        let state = FrameState {
            canvas: self.canvas,
            off: &off,
            dependencies: &dependencies,
            inputs: &inputs,
            lasting: &self.lasting,
            slices: self.slices.as_ref(),
        };
        let schedule = self.program.plan.schedule(&state, &mut self.changes, purpose);
        self.steps_drawn = schedule.steps;
        self.submissions = 0;
        let stats = FrameStats {
            passes_drawn: schedule.drawn,
            passes_cached: schedule.cached,
            bytes_cached: schedule.cached_bytes,
        };
        let is_sliced = self.slices.is_some() && matches!(purpose, Purpose::Frame | Purpose::Advance);
        self.unfinished = Some(Unfinished { ops: schedule.ops.into_iter(), rows: 0, is_sliced });
        let is_whole = self.execute(shared, display, caller).inspect_err(|_| self.changes.invalidate())?;
        Ok((stats, is_whole))
    }

    /// Draws a tile of the picture of the tiled pass: `size` of its pixels starting at `origin`, into the first texels
    /// of its target, with the inputs of the newest frame.
    pub(crate) fn draw_tile(
        &mut self,
        shared: &Shared,
        (origin, size): ((u32, u32), (u32, u32)),
        caller: &mut Caller<'_, '_>,
    ) -> Result<(), EngineError> {
        let Some(tiled) = self.program.plan.tiled else { return Ok(()) };
        self.uniforms.set_tile_origin(tiled.draw, origin);
        self.uniforms.write(&shared.gpu);
        let ops = self.program.plan.schedule_tile(size);
        self.unfinished = Some(Unfinished { ops: ops.into_iter(), rows: 0, is_sliced: false });
        self.execute(shared, None, caller)?;
        Ok(())
    }

    /// Executes the rest of the newest frame. Returns whether it is complete; if not, the caller stopped it and another
    /// call continues there.
    pub(crate) fn execute(
        &mut self,
        shared: &Shared,
        display: Option<&Display>,
        caller: &mut Caller<'_, '_>,
    ) -> Result<bool, EngineError> {
        let Some(mut unfinished) = self.unfinished.take() else { return Ok(true) };
        let gpu = &shared.gpu;
        let mut encoder = new_encoder(gpu);
        let mut slice: Vec<SlicePart> = Vec::new();
        while let Some(&op) = unfinished.ops.as_slice().first() {
            match op {
                FrameOp::StartTimestamps => self.timer.iter_mut().for_each(eddy_gpu::PassTimer::start),
                FrameOp::Encode { draw, layer } => {
                    self.encode(shared, &mut encoder, (draw, layer), None);
                    slice.push(SlicePart { draw, fraction: 1.0 / f64::from(self.program.plan.layers(draw)) });
                }
                FrameOp::EncodePart { draw, area } => {
                    self.encode(shared, &mut encoder, (draw, 0), Some(area));
                    let height = self.targets[self.program.plan.draws[draw].targets.start].size().1;
                    slice.push(SlicePart { draw, fraction: f64::from(area.height) / f64::from(height) });
                }
                FrameOp::EncodeRows { draw, area, align } => {
                    let Some(rows) = (caller.rows)() else {
                        self.unfinished = Some(unfinished);
                        return Ok(false);
                    };
                    let left = area.height - unfinished.rows;
                    let height = rows.max(1).checked_next_multiple_of(align).map_or(left, |rows| rows.min(left));
                    let part = Region { y: area.y + unfinished.rows, height, ..area };
                    self.encode(shared, &mut encoder, (draw, 0), Some(part));
                    unfinished.rows += height;
                    if unfinished.rows < area.height {
                        self.submissions += 1;
                        submit(gpu, &mut encoder);
                        gpu.wait()?;
                        continue;
                    }
                    unfinished.rows = 0;
                }
                FrameOp::Publish { draw } => self.publish(shared, &mut encoder, draw),
                FrameOp::Capture { draw } => {
                    if let Some(capture) = &mut caller.capture {
                        capture.take(self, shared, draw)?;
                    }
                }
                FrameOp::Clock(lap) => caller.watch.iter_mut().for_each(|watch| watch.lap(lap)),
                FrameOp::Present => {
                    if let Some(display) = display {
                        display.present(gpu, &mut encoder, &self.targets);
                    }
                }
                FrameOp::ResolveTimestamps => self.timer.iter_mut().for_each(|timer| timer.resolve(&mut encoder)),
                FrameOp::Submit => {
                    self.submissions += 1;
                    submit(gpu, &mut encoder);
                    self.timer.iter_mut().for_each(eddy_gpu::PassTimer::submitted);
                }
                FrameOp::SubmitAndWait => {
                    let submitted = now(gpu);
                    self.submissions += 1;
                    submit(gpu, &mut encoder);
                    gpu.wait()?;
                    self.timer.iter_mut().for_each(eddy_gpu::PassTimer::submitted);
                    if unfinished.is_sliced {
                        self.end_slice(shared, &mut slice, submitted)?;
                    }
                }
            }
            unfinished.ops.next();
        }
        self.slices.iter_mut().filter(|_| unfinished.is_sliced).for_each(SliceTimes::end_frame);
        Ok(true)
    }

    /// Adds a slice to the times of its draws.
    fn end_slice(&mut self, shared: &Shared, slice: &mut Vec<SlicePart>, submitted: f64) -> Result<(), EngineError> {
        if let Some(times) = &mut self.slices {
            times.measure(slice, now(&shared.gpu) - submitted);
        }
        slice.clear();
        if shared.stop.load(Ordering::Relaxed) { Err(EngineError::Stopped) } else { Ok(()) }
    }

    /// Records that the targets of a draw contain the encoded result.
    fn publish(&mut self, shared: &Shared, encoder: &mut wgpu::CommandEncoder, index: usize) {
        let draw = &self.program.plan.draws[index];
        for target in &mut self.targets[draw.targets.clone()] {
            target.front = target.back();
            if let Some(chain) = target.chains.get(target.front) {
                shared.mips.build(&shared.gpu, encoder, chain);
            }
        }
    }

    /// Returns the size of the picture of a draw, which for tiles is larger than its target.
    fn picture_size(&self, draw: usize) -> (u32, u32) {
        match self.program.plan.tiled.filter(|tiled| tiled.draw == draw) {
            Some(tiled) => tiled.size.of(self.canvas),
            None => self.targets[self.program.plan.draws[draw].targets.start].size(),
        }
    }

    /// Writes the uniforms of every draw.
    fn set_uniforms(&mut self, gpu: &Gpu, inputs: &FrameInputs) {
        let dialect = self.program.dialect;
        self.uniforms.set_host_uniforms(gpu, &host::values(dialect, inputs, self.canvas));
        for (index, (compiled, _)) in self.program.planned_draws().enumerate() {
            let own = self.picture_size(index);
            let mut block = uniforms::block(inputs, own, self.canvas, &compiled.channels);
            host::adapt(dialect, &mut block);
            if compiled.id.is_sound() {
                sound::set_offsets(&mut block, inputs);
            }
            self.uniforms.set(index, self.program.plan.layers(index), &block);
            let Some(meshes) = compiled.body.geometry() else { continue };
            for (n, (_, mesh)) in meshes.programs.iter().enumerate() {
                self.uniforms.set_mesh(meshes.first + n, &mesh.block(&meshes.camera, inputs, own, self.canvas));
            }
        }
        self.uniforms.write(gpu);
    }

    /// Returns what a draw depends on in this frame, and all its inputs other than targets; for
    /// [`eddy_graph::Changes::must_draw`].
    fn inputs_of(&self, index: usize) -> (Dependencies, Vec<u8>) {
        let (compiled, draw) = (&self.program.draws[index], &self.program.plan.draws[index]);
        let resting = self.resting.reads(index).filter(|_| resting::is_ordinary(&self.uniforms.uniform_block(index)));
        let (dependencies, reads) = match resting {
            Some(resting) => (resting.dependencies, resting.uniforms),
            None => (draw.dependencies(), UniformReads::of(compiled)),
        };
        let mut read = Vec::new();
        if dependencies.is_cacheable {
            // Bytes of different sets are never compared.
            read.push(resting.is_some().into());
            read.extend(reads.uniforms.bits().to_le_bytes());
            self.uniforms.add_read_by(index, compiled, reads, &mut read);
            let externals = compiled.channels.iter().zip(dependencies.channels);
            for (channel, _) in externals.filter(|(_, is_read)| *is_read) {
                if let Some(external) = &channel.external {
                    read.extend(self.program.externals[external.index].version.to_le_bytes());
                }
            }
        }
        (dependencies, read)
    }
}

/// Returns the milliseconds of the clock for slices.
fn now(gpu: &Gpu) -> f64 {
    gpu.slices.as_ref().map_or(0.0, |slices| (slices.now)())
}

fn new_encoder(gpu: &Gpu) -> wgpu::CommandEncoder {
    gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") })
}

/// Submits the encoded commands. The encoder is empty afterwards.
fn submit(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) {
    let full = std::mem::replace(encoder, new_encoder(gpu));
    gpu.queue.submit([full.finish()]);
}

/// The caller's clock, and the time of each draw by it.
pub(super) struct Watch<'a> {
    /// Returns milliseconds from an arbitrary origin.
    now: &'a mut dyn FnMut() -> f64,
    start: f64,
    /// The milliseconds to submit and wait for an empty command buffer.
    overhead: f64,
    /// The milliseconds of each draw, for all steps.
    millis: Vec<f64>,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(now: &'a mut dyn FnMut() -> f64, program: &Program) -> Self {
        Self { now, start: 0.0, overhead: 0.0, millis: vec![0.0; program.draws.len()] }
    }

    fn lap(&mut self, lap: Lap) {
        let now = (self.now)();
        match lap {
            Lap::Start => self.start = now,
            Lap::Overhead => self.overhead = now - self.start,
            Lap::Draw(draw) => self.millis[draw] += (now - self.start - self.overhead).max(0.0),
        }
    }

    /// Returns the time of each pass.
    pub(crate) fn times(&self, program: &Program) -> Vec<PassTime> {
        let times = program.draws.iter().zip(&self.millis);
        times.map(|(draw, &gpu_millis)| PassTime { pass: draw.id.clone(), gpu_millis }).collect()
    }
}
