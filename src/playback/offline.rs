//! Draws a project without a window, at a fixed step: used by `eddy render`, `eddy bench` and the tests.
//!
//! The same project, pictures, inputs and size produce the same bytes. A run of N frames and one of N/2 followed by N/2
//! more draw the same.

use crate::{
    assertion::Conditions,
    recording::Change,
    script::ScriptedInputs,
    tiles::{Pace, Tiling},
};
use eddy_diag::{Diagnostic, SourceMap};
use eddy_engine::{
    BLOCK_SECS, BuildError, BuildOptions, DrawFor, Engine, EngineError, FrameInputs, FrameStats, PassInputs, PassTime,
    Pixels, Program, State, StateError,
};
use eddy_gpu::{Gpu, GpuError};
use eddy_media::MediaSet;
use eddy_project::{CustomUniformValues, CustomUniforms, PassName, Project};
use std::{
    sync::mpsc::{RecvTimeoutError, SendError, channel},
    time::{Duration, Instant},
};

/// Drivers compile on the thread that draws, and recurse as deeply as an expression is nested. Untouched pages cost
/// nothing.
const STACK_BYTES: usize = 256 << 20;

/// The name of a thread that draws a frame and may be abandoned.
pub const DRAWER: &str = "frame";

/// The default time after which a block of sound, which plays for 6 s, is abandoned: rendering would be slower than
/// playing.
pub const SOUND_LIMIT: Duration = Duration::from_secs(60);

/// Rows of a block that are drawn at once.
const SOUND_ROWS: u32 = 64;

/// A project that is drawn frame by frame.
pub struct Offline {
    /// `None` once a frame has timed out.
    engine: Option<Engine>,
    frame_limit: Option<Duration>,
    inputs: ScriptedInputs,
    build_millis: Option<f64>,
    /// `iDate` of all blocks of sound.
    sound_date: Option<[f32; 4]>,
    /// True if the device supports timestamps of passes; `None` until they are first requested.
    has_stamps: Option<bool>,
    /// One pass is drawn in tiles.
    tiling: Option<Tiling>,
    pub(crate) pace: Pace,
    /// The newest frame's number, and when it was started.
    newest: (i32, Option<Instant>),
    /// The maximum bytes of textures in system memory.
    memory: Option<u64>,
    /// The inputs of the frames so far: the uniforms that the recording has set, the longest `iTimeDelta` in seconds, and
    /// whether the mouse was pressed.
    seen: (Option<CustomUniformValues>, f64, bool),
}

/// A frame that the device has finished.
#[derive(Clone, Debug)]
pub struct DrawnFrame {
    /// `iFrame`.
    pub number: i32,
    pub stats: FrameStats,
    /// Milliseconds of CPU time until the frame was submitted, and of wall-clock time until the device had finished it.
    pub cpu_millis: f64,
    pub millis: f64,
}

impl Offline {
    /// Creates the engine for a canvas of this size. Fails for a size that the device cannot draw.
    pub fn new(gpu: &Gpu, (width, height): (u32, u32), inputs: ScriptedInputs) -> Result<Offline, EngineError> {
        Ok(Self::of(Engine::new(gpu.clone(), width, height)?, inputs))
    }

    /// Does the same for a canvas of any size, whose picture's pass is drawn in tiles: see [`Offline::draw_strip`].
    /// Programs are built with [`Offline::tile`].
    pub fn tiled(
        gpu: &Gpu,
        (width, height): (u32, u32),
        tiling: Tiling,
        inputs: ScriptedInputs,
    ) -> Result<Offline, EngineError> {
        let engine = Engine::for_tiles(gpu.clone(), width, height)?;
        Ok(Offline { tiling: Some(tiling), ..Self::of(engine, inputs) })
    }

    fn of(engine: Engine, inputs: ScriptedInputs) -> Offline {
        Offline {
            engine: Some(engine),
            frame_limit: None,
            inputs,
            build_millis: None,
            sound_date: None,
            has_stamps: None,
            tiling: None,
            pace: Pace::default(),
            newest: (0, None),
            memory: None,
            seen: (None, 0.0, false),
        }
    }

    /// Returns the tiling of the pass that is drawn in tiles.
    pub fn tiling(&self) -> Option<Tiling> {
        self.tiling
    }

    /// Returns the value of [`BuildOptions::tile`] for this canvas.
    pub fn tile(&self) -> Option<(u32, u32)> {
        let width = self.engine.as_ref()?.size().0;
        self.tiling.map(|tiling| tiling.tile(width))
    }

    /// Rejects programs whose textures take more bytes, if they use system memory. A driver without memory of its own
    /// does not reject them: the process is killed.
    pub fn set_memory_limit(&mut self, bytes: Option<u64>) {
        self.memory = bytes;
    }

    /// Abandons a frame that takes longer, together with the engine: no other can be drawn. The device stays busy.
    pub fn set_frame_limit(&mut self, limit: Option<Duration>) {
        self.frame_limit = limit;
    }

    /// Compiles a project and uses it for the next frames. Returns warnings and notes with the texts that they point
    /// into. Fails with the author's diagnostics, or for a pass that the project does not have.
    pub fn build(
        &mut self,
        project: &Project,
        media: &MediaSet,
        options: &BuildOptions,
    ) -> Result<(Vec<Diagnostic>, SourceMap), BuildError> {
        let began = Instant::now();
        let engine = self.engine.as_mut().ok_or_else(gone)?;
        let built = Program::build(engine.gpu(), project, media, options);
        self.build_millis = Some(millis_since(began));
        let built = built?;
        let needed = engine.gpu().rasteriser().shared_memory(built.program.plan().target_bytes(engine.size()));
        if let Some(available) = self.memory.filter(|most| needed > *most) {
            return Err(EngineError::Memory { needed, available }.into());
        }
        engine.set_program(built.program)?;
        Ok((built.diagnostics, built.sources))
    }

    /// Returns the duration of the newest compile in milliseconds, whether or not it produced a program.
    pub fn build_millis(&self) -> Option<f64> {
        self.build_millis
    }

    /// Returns the inputs of the next frame. A recording may first change the canvas and the values of uniforms.
    pub fn next_inputs(&mut self) -> Result<FrameInputs, EngineError> {
        if let Some(change_of_frame) = self.inputs.next_change() {
            change(self.engine.as_mut().ok_or_else(gone)?, &change_of_frame)?;
            self.seen.0 = change_of_frame.values.or(self.seen.0.take());
        }
        let inputs = self.inputs.next_frame();
        self.seen.1 = self.seen.1.max(inputs.time_delta_secs.into());
        self.seen.2 |= inputs.mouse[2] > 0.0;
        Ok(inputs)
    }

    /// Returns the conditions of the frames so far, on which assertions may depend. `uniforms` are the project's.
    pub fn conditions(&self, project: &Project, uniforms: &CustomUniforms) -> Result<Conditions, EngineError> {
        let (values, longest_step, is_dragged) = &self.seen;
        let values = values.as_ref().unwrap_or(&project.custom_uniform_values);
        Ok(Conditions::new(uniforms, values, self.engine()?.size(), *longest_step, *is_dragged))
    }

    /// Restarts a recording once all its frames have been drawn; without one, does nothing.
    pub fn rewind_at_end(&mut self) -> Result<(), EngineError> {
        let is_over = |count: usize| usize::try_from(self.inputs.frame()).is_ok_and(|frame| frame >= count);
        if self.inputs.recorded_frames().is_some_and(is_over) { self.rewind() } else { Ok(()) }
    }

    /// Restarts at frame 0, with every buffer as before it.
    pub fn rewind(&mut self) -> Result<(), EngineError> {
        self.inputs.rewind();
        self.seen = (None, 0.0, false);
        self.engine.as_mut().ok_or_else(gone)?.reset();
        Ok(())
    }

    /// Resumes at a frame without drawing those before it: the state is that of a run which has drawn them. Fails for a
    /// frame that has passed.
    pub fn resume(&mut self, frame: u32, state: &State) -> Result<(), ResumeError> {
        let over = || ResumeError::Over { frame, next: self.inputs.frame() };
        let frame = i32::try_from(frame).ok().filter(|frame| *frame >= self.inputs.frame()).ok_or_else(over)?;
        while self.inputs.frame() < frame {
            self.next_inputs()?;
        }
        Ok(self.engine.as_mut().ok_or_else(gone)?.set_state(state)?)
    }

    /// Draws the next frame and waits until the device has finished it.
    pub fn draw(&mut self) -> Result<DrawnFrame, OfflineError> {
        let inputs = self.next_inputs()?;
        self.draw_with(inputs)
    }

    /// Computes the state that later frames depend on, without drawing pictures that only this frame shows: see
    /// [`DrawFor::Advance`]. Waits until the device has finished.
    pub fn advance(&mut self) -> Result<DrawnFrame, OfflineError> {
        let inputs = self.next_inputs()?;
        self.finish(inputs, |engine, inputs| Ok(engine.draw_for(inputs, DrawFor::Advance)?.stats))
    }

    fn draw_with(&mut self, inputs: FrameInputs) -> Result<DrawnFrame, OfflineError> {
        self.finish(inputs, Engine::draw)
    }

    /// Executes a frame's work and waits for the device.
    fn finish(
        &mut self,
        inputs: FrameInputs,
        work: fn(&mut Engine, &FrameInputs) -> Result<FrameStats, EngineError>,
    ) -> Result<DrawnFrame, OfflineError> {
        let number = inputs.frame;
        self.newest = (number, Some(Instant::now()));
        self.within(number, move |engine| {
            let began = Instant::now();
            let stats = work(engine, &inputs)?;
            let cpu_millis = millis_since(began);
            engine.gpu().wait()?;
            Ok(DrawnFrame { number, stats, cpu_millis, millis: millis_since(began) })
        })
    }

    /// Draws the next frame `parts` times, at the midpoints of as many parts of `secs` that start at its own time, and
    /// passes each to `each`. So the mean of a steady motion is centred in that time: see the study `shutter`. In a
    /// project with state, each part counts as a frame.
    pub fn draw_parts<E: From<OfflineError>>(
        &mut self,
        parts: u32,
        secs: f64,
        each: impl FnMut(&mut Offline) -> Result<(), E>,
    ) -> Result<DrawnFrame, E> {
        let inputs = self.next_inputs().map_err(OfflineError::from)?;
        self.draw_parts_of(&inputs, parts, secs, each)
    }

    /// Does the same for a frame with these inputs.
    pub fn draw_parts_of<E: From<OfflineError>>(
        &mut self,
        inputs: &FrameInputs,
        parts: u32,
        secs: f64,
        mut each: impl FnMut(&mut Offline) -> Result<(), E>,
    ) -> Result<DrawnFrame, E> {
        let number = inputs.frame;
        let (mut stats, mut cpu_millis, mut millis) = (FrameStats::default(), 0.0, 0.0);
        for part in 0..parts.max(1) {
            let late = secs * (f64::from(part) + 0.5) / f64::from(parts.max(1));
            let mut inputs = inputs.clone();
            inputs.time_secs += late;
            inputs.date[3] += late as f32;
            let drawn = self.draw_with(inputs)?;
            (stats, cpu_millis, millis) = (drawn.stats, cpu_millis + drawn.cpu_millis, millis + drawn.millis);
            each(self)?;
        }
        Ok(DrawnFrame { number, stats, cpu_millis, millis })
    }

    /// Skips the next frame: its input is applied, and nothing is drawn.
    pub fn skip(&mut self) -> Result<(), EngineError> {
        self.next_inputs().map(drop)
    }

    /// Returns whether a frame depends on earlier frames: through passes that read their last picture, or that keep a
    /// part of it.
    pub fn has_state(&self) -> Result<bool, EngineError> {
        Ok(self.engine()?.checkpoint_bytes() > 0)
    }

    /// Draws the next frame, and returns the inputs of a pass.
    pub fn draw_inspected(&mut self, pass: &PassName) -> Result<PassInputs, OfflineError> {
        let (inputs, pass) = (self.next_inputs()?, pass.clone());
        self.within(inputs.frame, move |engine| {
            let drawn = engine.draw_for(&inputs, DrawFor::Inspect(&pass))?;
            drawn.read.ok_or_else(|| EngineError::NoSuchPass(pass.title()))
        })
    }

    /// Draws the next frame and returns the time of each pass: by the device's timestamps, or, if it has none, by
    /// submitting each pass and waiting for it.
    pub fn draw_timed(&mut self) -> Result<Vec<PassTime>, OfflineError> {
        if self.has_stamps.is_none() {
            self.has_stamps = Some(self.engine.as_mut().ok_or_else(gone)?.set_timing(true));
        }
        if self.has_stamps == Some(true) {
            self.draw()?;
            return Ok(self.engine.as_mut().and_then(Engine::pass_times).unwrap_or_default());
        }
        let inputs = self.next_inputs()?;
        self.within(inputs.frame, move |engine| {
            let began = Instant::now();
            Ok(engine.draw_for(&inputs, DrawFor::Timed(&mut || millis_since(began)))?.times)
        })
    }

    /// Sets the date of all blocks of sound, instead of that of the first frame.
    pub fn set_sound_date(&mut self, date: [f32; 4]) {
        self.sound_date = Some(date);
    }

    /// Sets the author's own uniforms for the next blocks of sound. Returns the values that the sound pass reads.
    pub fn set_sound_values(&mut self, values: &CustomUniformValues) -> Result<Vec<[u32; 4]>, OfflineError> {
        // The first frame of a recording sets its own values.
        self.sound_date()?;
        Ok(self.engine.as_mut().ok_or_else(gone)?.set_sound_values(values))
    }

    fn sound_date(&mut self) -> Result<[f32; 4], OfflineError> {
        let date = match self.sound_date {
            Some(date) => date,
            None => self.next_inputs()?.date,
        };
        self.sound_date = Some(date);
        Ok(date)
    }

    /// Draws block `number` of the sound pass of a program that was built with [`BuildOptions::sound`]: see
    /// [`Engine::draw_sound`]. A block is abandoned after the time of [`Offline::set_frame_limit`], or after
    /// [`SOUND_LIMIT`] if there is none. `iDate` is that of the run's first frame.
    pub fn draw_sound(&mut self, number: u32) -> Result<Vec<[i16; 2]>, OfflineError> {
        let date = self.sound_date()?;
        let limit = self.frame_limit.unwrap_or(SOUND_LIMIT);
        let work = move |engine: &mut Engine| engine.draw_sound(number, date, &mut || Some(SOUND_ROWS));
        match self.within_limit(limit, work)? {
            Some(frames) => Ok(frames.unwrap_or_default()),
            None => Err(OfflineError::SoundTimedOut { block: number, limit }),
        }
    }

    /// Reads the texels of a pass's target after the newest frame; 0 is the first target.
    pub fn read(&mut self, pass: &PassName, target: usize) -> Result<Pixels, EngineError> {
        self.engine.as_mut().ok_or_else(gone)?.read_target(pass, target)
    }

    /// Returns the engine, for the cost of passes and what the plan leaves out. Fails once a frame was abandoned.
    pub fn engine(&self) -> Result<&Engine, EngineError> {
        self.engine.as_ref().ok_or_else(gone)
    }

    /// Returns the engine by value. Fails once a frame was abandoned.
    pub fn into_engine(self) -> Result<Engine, EngineError> {
        self.engine.ok_or_else(gone)
    }

    /// Executes a frame's work, on a thread that can be abandoned if there is a limit.
    pub(crate) fn within<T: Send + 'static>(
        &mut self,
        frame: i32,
        work: impl FnOnce(&mut Engine) -> Result<T, EngineError> + Send + 'static,
    ) -> Result<T, OfflineError> {
        let Some(limit) = self.frame_limit else { return Ok(work(self.engine.as_mut().ok_or_else(gone)?)?) };
        self.within_limit(limit, work)?.ok_or(OfflineError::TimedOut { frame, limit })
    }

    /// Executes a part of the newest frame's work, to which the limit applies as a whole.
    pub(crate) fn within_frame<T: Send + 'static>(
        &mut self,
        work: impl FnOnce(&mut Engine) -> Result<T, EngineError> + Send + 'static,
    ) -> Result<T, OfflineError> {
        let Some(limit) = self.frame_limit else { return Ok(work(self.engine.as_mut().ok_or_else(gone)?)?) };
        let (frame, began) = self.newest;
        let left = began.map_or(limit, |began| limit.saturating_sub(began.elapsed()));
        self.within_limit(left, work)?.ok_or(OfflineError::TimedOut { frame, limit })
    }

    /// Returns `None` if the work takes longer. The thread is abandoned, with the engine.
    fn within_limit<T: Send + 'static>(
        &mut self,
        limit: Duration,
        work: impl FnOnce(&mut Engine) -> Result<T, EngineError> + Send + 'static,
    ) -> Result<Option<T>, OfflineError> {
        let mut engine = self.engine.take().ok_or_else(gone)?;
        let (sender, receiver) = channel();
        let work = move || {
            let done = work(&mut engine);
            // The receiver is gone. A driver that has lost its device is not called to destroy it: the process may be
            // exiting, and unloading the driver.
            if let Err(SendError((engine, _))) = sender.send((engine, done))
                && engine.gpu().is_lost()
            {
                std::mem::forget(engine);
            }
        };
        let thread = std::thread::Builder::new().name(DRAWER.into()).stack_size(STACK_BYTES).spawn(work);
        let thread = thread.map_err(OfflineError::Thread)?;
        match receiver.recv_timeout(limit) {
            Ok((engine, done)) => {
                self.engine = Some(engine);
                Ok(Some(done?))
            }
            Err(RecvTimeoutError::Timeout) => Ok(None),
            Err(RecvTimeoutError::Disconnected) => match thread.join() {
                Err(panic) => std::panic::resume_unwind(panic),
                Ok(()) => Err(gone().into()),
            },
        }
    }
}

/// Applies a recording's changes to an engine before a frame.
pub fn change(engine: &mut Engine, change: &Change) -> Result<(), EngineError> {
    if let Some((width, height)) = change.size {
        engine.resize(width, height)?;
    }
    if let Some(values) = &change.values {
        engine.set_custom_uniforms(values);
    }
    if change.reset {
        engine.reset();
    }
    Ok(())
}

/// The reason why a run cannot resume from a state.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    State(#[from] StateError),
    #[error("frame {frame} is over: frame {next} is drawn next")]
    Over { frame: u32, next: i32 },
}

/// A frame could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum OfflineError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error("frame {frame} was stopped after {} s: lower the resolution, simplify the code, or give it more time \
             with --frame-timeout", limit.as_secs_f64())]
    TimedOut { frame: i32, limit: Duration },
    #[error("block {block} of the sound pass, {:.1} s of sound, was stopped after {} s: simplify the code, or give it more \
             time with --frame-timeout", BLOCK_SECS, limit.as_secs_f64())]
    SoundTimedOut { block: u32, limit: Duration },
    #[error("cannot start a thread for drawing: {0}")]
    Thread(std::io::Error),
}

fn gone() -> EngineError {
    GpuError::Lost("an earlier frame was stopped".into()).into()
}

fn millis_since(began: Instant) -> f64 {
    began.elapsed().as_nanos() as f64 / 1e6
}
