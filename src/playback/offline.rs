//! A project drawn without a window, at a fixed step: what `eddy render`, `eddy bench` and the tests use.
//!
//! Same project, pictures, inputs and size: same bytes. A run of N frames and one of N/2 with N/2 more after it draw
//! the same.

use crate::{
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
use eddy_project::{CustomUniformValues, PassName, Project};
use std::{
    sync::mpsc::{RecvTimeoutError, SendError, channel},
    time::{Duration, Instant},
};

/// Drivers compile on the thread that draws, and recurse as deep as an expression is nested. Pages that are not used
/// cost nothing.
const STACK_BYTES: usize = 256 << 20;

/// The name of a thread that draws a frame and may be left behind.
pub const DRAWER: &str = "frame";

/// A block of sound, 6 s of it, is given up after this time where nothing else is said: it could not be played as fast
/// as it is made.
pub const SOUND_LIMIT: Duration = Duration::from_secs(60);

/// Rows of a block that are drawn at once.
const SOUND_ROWS: u32 = 64;

/// A project being drawn frame after frame.
pub struct Offline {
    /// `None` once a frame has not come back in time.
    engine: Option<Engine>,
    frame_limit: Option<Duration>,
    inputs: ScriptedInputs,
    build_millis: Option<f64>,
    /// `iDate` of all blocks of sound.
    sound_date: Option<[f32; 4]>,
    /// The device takes the passes' times; not known before they are asked for.
    has_stamps: Option<bool>,
    /// One pass is drawn in tiles.
    tiling: Option<Tiling>,
    pub(crate) pace: Pace,
    /// The newest frame's number, and when it was begun.
    newest: (i32, Option<Instant>),
    /// The bytes that textures may take in the machine's own memory.
    memory: Option<u64>,
}

/// A frame that the device has finished.
#[derive(Clone, Debug)]
pub struct DrawnFrame {
    /// `iFrame`.
    pub number: i32,
    pub stats: FrameStats,
    /// Milliseconds of the processor until the frame was handed in, and of the clock until the device had finished it.
    pub cpu_millis: f64,
    pub millis: f64,
}

impl Offline {
    /// Makes the engine for a canvas of so many pixels. Fails for a size that the device cannot draw.
    pub fn new(gpu: &Gpu, (width, height): (u32, u32), inputs: ScriptedInputs) -> Result<Offline, EngineError> {
        Ok(Self::of(Engine::new(gpu.clone(), width, height)?, inputs))
    }

    /// Does the same for a canvas of any size, where the one pass that is drawn in tiles has to be drawn: see
    /// [`Offline::draw_strip`]. Programs are built with [`Offline::tile`].
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
        }
    }

    /// Returns how the one pass is drawn that is drawn in tiles.
    pub fn tiling(&self) -> Option<Tiling> {
        self.tiling
    }

    /// Returns what [`BuildOptions::tile`] is for this canvas.
    pub fn tile(&self) -> Option<(u32, u32)> {
        let width = self.engine.as_ref()?.size().0;
        self.tiling.map(|tiling| tiling.tile(width))
    }

    /// Refuses programs whose textures take more bytes, where they take the machine's own memory. A driver that has no
    /// memory of its own does not refuse them: it is killed.
    pub fn set_memory_limit(&mut self, bytes: Option<u64>) {
        self.memory = bytes;
    }

    /// Gives a frame up that takes longer, and the engine with it: no other can be drawn. The device stays as busy as
    /// it is.
    pub fn set_frame_limit(&mut self, limit: Option<Duration>) {
        self.frame_limit = limit;
    }

    /// Compiles a project and takes it for the frames to come. Gives warnings and notes with the texts that they point
    /// into. Fails with the author's diagnostics, or for a pass the project does not have.
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
        let needed = built.program.plan().target_bytes(engine.size());
        if let Some(available) = self.memory.filter(|most| engine.gpu().is_cpu() && needed > *most) {
            return Err(EngineError::Memory { needed, available }.into());
        }
        engine.set_program(built.program)?;
        Ok((built.diagnostics, built.sources))
    }

    /// Returns the milliseconds that the newest compile took, whether or not it made a program.
    pub fn build_millis(&self) -> Option<f64> {
        self.build_millis
    }

    /// Returns what the next frame is drawn with. A recording may give it another canvas and other values of uniforms
    /// first.
    pub fn next_inputs(&mut self) -> Result<FrameInputs, EngineError> {
        if let Some(change_of_frame) = self.inputs.next_change() {
            change(self.engine.as_mut().ok_or_else(gone)?, &change_of_frame)?;
        }
        Ok(self.inputs.next_frame())
    }

    /// Begins a recording anew once all its frames have been drawn; where none is drawn again, nothing.
    pub fn rewind_at_end(&mut self) -> Result<(), EngineError> {
        let is_over = |count: usize| usize::try_from(self.inputs.frame()).is_ok_and(|frame| frame >= count);
        if self.inputs.recorded_frames().is_some_and(is_over) { self.rewind() } else { Ok(()) }
    }

    /// Begins anew: with frame 0 and every buffer as before it.
    pub fn rewind(&mut self) -> Result<(), EngineError> {
        self.inputs.rewind();
        self.engine.as_mut().ok_or_else(gone)?.reset();
        Ok(())
    }

    /// Goes on at a frame without drawing those before it: the state is that of a run which has drawn them. Fails for a
    /// frame that is over.
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

    /// Does of the next frame what frames to come depend on, and draws no picture that only it would show: see
    /// [`DrawFor::Advance`]. Waits until the device has finished.
    pub fn advance(&mut self) -> Result<DrawnFrame, OfflineError> {
        let inputs = self.next_inputs()?;
        self.finish(inputs, |engine, inputs| Ok(engine.draw_for(inputs, DrawFor::Advance)?.stats))
    }

    fn draw_with(&mut self, inputs: FrameInputs) -> Result<DrawnFrame, OfflineError> {
        self.finish(inputs, Engine::draw)
    }

    /// Does a frame's work and waits for the device.
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

    /// Draws the next frame `parts` times, in the middles of as many parts of `secs`, which begin at its own time, and hands each
    /// to `each`. So the mean of what moves evenly is where it is in the middle of that time: see the study `shutter`. Of a project with a state, each part counts as a frame.
    pub fn draw_parts<E: From<OfflineError>>(
        &mut self,
        parts: u32,
        secs: f64,
        each: impl FnMut(&mut Offline) -> Result<(), E>,
    ) -> Result<DrawnFrame, E> {
        let inputs = self.next_inputs().map_err(OfflineError::from)?;
        self.draw_parts_of(&inputs, parts, secs, each)
    }

    /// Does the same for a frame of these inputs.
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

    /// Passes over the next frame: its input happens, and nothing is drawn.
    pub fn skip(&mut self) -> Result<(), EngineError> {
        self.next_inputs().map(drop)
    }

    /// Returns whether a frame depends on the frames before it: through passes that read what they drew last, or that keep a
    /// part of it.
    pub fn has_state(&self) -> Result<bool, EngineError> {
        Ok(self.engine()?.checkpoint_bytes() > 0)
    }

    /// Draws the next frame, and takes what a pass reads when it is drawn.
    pub fn draw_inspected(&mut self, pass: &PassName) -> Result<PassInputs, OfflineError> {
        let (inputs, pass) = (self.next_inputs()?, pass.clone());
        self.within(inputs.frame, move |engine| {
            let drawn = engine.draw_for(&inputs, DrawFor::Inspect(&pass))?;
            drawn.read.ok_or_else(|| EngineError::NoSuchPass(pass.title()))
        })
    }

    /// Draws the next frame and gives the time of each pass: by the device's timestamps, or, where it has none, each
    /// pass handed in and waited for by itself.
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

    /// Gives all blocks of sound a date in the place of that of the first frame.
    pub fn set_sound_date(&mut self, date: [f32; 4]) {
        self.sound_date = Some(date);
    }

    /// Gives the author's own uniforms values for the blocks of sound to come. Returns those that the sound pass reads.
    pub fn set_sound_values(&mut self, values: &CustomUniformValues) -> Result<Vec<[u32; 4]>, OfflineError> {
        // The first frame of a recording brings values of its own.
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
    /// [`Engine::draw_sound`]. A block is given up after [`Offline::set_frame_limit`]'s time, else after
    /// [`SOUND_LIMIT`]. `iDate` is that of the run's first frame.
    pub fn draw_sound(&mut self, number: u32) -> Result<Vec<[i16; 2]>, OfflineError> {
        let date = self.sound_date()?;
        let limit = self.frame_limit.unwrap_or(SOUND_LIMIT);
        let work = move |engine: &mut Engine| engine.draw_sound(number, date, &mut || Some(SOUND_ROWS));
        match self.within_limit(limit, work)? {
            Some(frames) => Ok(frames.unwrap_or_default()),
            None => Err(OfflineError::SoundTimedOut { block: number, limit }),
        }
    }

    /// Reads the texels of a pass's target as the newest frame left them; 0 is the first target.
    pub fn read(&mut self, pass: &PassName, target: usize) -> Result<Pixels, EngineError> {
        self.engine.as_mut().ok_or_else(gone)?.read_target(pass, target)
    }

    /// Returns the engine, for what the passes cost and what the plan leaves out. Fails once a frame was given up.
    pub fn engine(&self) -> Result<&Engine, EngineError> {
        self.engine.as_ref().ok_or_else(gone)
    }

    /// Gives the engine away. Fails once a frame was given up.
    pub fn into_engine(self) -> Result<Engine, EngineError> {
        self.engine.ok_or_else(gone)
    }

    /// Does a frame's work, on a thread that can be left behind where there is a limit.
    fn within<T: Send + 'static>(
        &mut self,
        frame: i32,
        work: impl FnOnce(&mut Engine) -> Result<T, EngineError> + Send + 'static,
    ) -> Result<T, OfflineError> {
        let Some(limit) = self.frame_limit else { return Ok(work(self.engine.as_mut().ok_or_else(gone)?)?) };
        self.within_limit(limit, work)?.ok_or(OfflineError::TimedOut { frame, limit })
    }

    /// Does a part of the newest frame's work, for which the limit counts as a whole.
    pub(crate) fn within_frame<T: Send + 'static>(
        &mut self,
        work: impl FnOnce(&mut Engine) -> Result<T, EngineError> + Send + 'static,
    ) -> Result<T, OfflineError> {
        let Some(limit) = self.frame_limit else { return Ok(work(self.engine.as_mut().ok_or_else(gone)?)?) };
        let (frame, began) = self.newest;
        let left = began.map_or(limit, |began| limit.saturating_sub(began.elapsed()));
        self.within_limit(left, work)?.ok_or(OfflineError::TimedOut { frame, limit })
    }

    /// Returns `None` where the work takes longer. It is left behind, with the engine.
    fn within_limit<T: Send + 'static>(
        &mut self,
        limit: Duration,
        work: impl FnOnce(&mut Engine) -> Result<T, EngineError> + Send + 'static,
    ) -> Result<Option<T>, OfflineError> {
        let mut engine = self.engine.take().ok_or_else(gone)?;
        let (sender, receiver) = channel();
        let work = move || {
            let done = work(&mut engine);
            // Nobody waits any more. A driver that has lost its device is not asked to take it apart: the process may be
            // leaving, and the driver with it.
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

/// Does what a recording changes of an engine before a frame.
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

/// A run cannot go on from a state.
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
