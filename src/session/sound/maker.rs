//! The thread that renders tracks: builds the sound pass on a device of its own, and draws block after block.

use super::{Order, Shared};
use crate::drawing::Open;
use eddy_audio::Track;
use eddy_background::Control;
use eddy_engine::{
    BLOCK_FRAMES, BLOCK_SECS, BuildError, BuildOptions, Builder, Engine, EngineError, SOUND_FRAMES, Trial,
};
use eddy_gpu as gpu;
use std::{
    sync::Arc,
    thread,
    time::{Duration, Instant},
};

/// The amount by which the thread's priority is lowered (nice) if a processor draws: pictures, which use 5, go first.
const STEPS_BACK: i32 = 10;
/// The approximate duration of a band of a block, for which the picture waits if both share a device.
const BAND: Duration = Duration::from_millis(6);
/// Longest pause after a band.
const PAUSE: Duration = Duration::from_millis(30);
/// The rows of the first band, and the maximum of one: a block has 512.
const ROWS: (u32, u32) = (4, 128);
/// A block that takes longer is abandoned, and the sound with it: a block plays for 6 s.
const BLOCK_LIMIT: Duration = Duration::from_secs(60);

/// The thread's function, which opens its device at the first order.
pub(super) fn work(
    open: Open,
    is_cpu: bool,
    trial: Option<Trial>,
    shared: Arc<Shared>,
) -> impl FnMut(Order, &Control<()>) -> Result<(), String> + Send {
    let mut maker: Option<Maker> = None;
    move |order, control| {
        let _at_work = shared.begin();
        let maker_of_order = match &mut maker {
            Some(maker) => maker,
            None => {
                if is_cpu {
                    gpu::lower_thread_priority(STEPS_BACK);
                }
                let made = open().map_err(EngineError::from).and_then(Maker::new);
                maker.insert(made.map_err(|error| error.to_string())?)
            }
        };
        let made = maker_of_order.make(&order, trial.as_ref(), control, &shared);
        if made.is_err() && !control.is_cancelled() {
            // Its device may be lost: the next order opens another.
            maker = None;
        }
        made
    }
}

struct Maker {
    builder: Builder,
    engine: Engine,
    /// The project of the program, by [`Order::opened`].
    opened: u64,
}

impl Maker {
    fn new(gpu: gpu::Gpu) -> Result<Self, EngineError> {
        Ok(Self { builder: Builder::new(gpu.clone()), engine: Engine::new(gpu, 16, 16)?, opened: 0 })
    }

    /// Starts a new track unless the order has the same sound as the previous one, and renders the missing blocks.
    fn make(
        &mut self,
        order: &Order,
        trial: Option<&Trial>,
        control: &Control<()>,
        shared: &Shared,
    ) -> Result<(), String> {
        let options = BuildOptions { trial: trial.cloned(), ..BuildOptions::sound() };
        let program = match self.builder.build(&order.project, &order.media, &options) {
            Ok(built) => built.program,
            Err(BuildError::Diagnostics { diagnostics, .. }) => {
                let error = diagnostics.into_iter().find(|diagnostic| diagnostic.is_error());
                return Err(error.map_or_else(|| "it does not compile".into(), |error| error.message));
            }
            Err(BuildError::Engine(error)) => return Err(error.to_string()),
        };
        control.check()?;
        let is_same = self.opened == order.opened
            && self.engine.program().is_some_and(|before| before.makes_same_sound(&program));
        let track = match shared.track().filter(|_| is_same) {
            Some(track) => track,
            None => {
                self.engine.set_program(program).map_err(|error| error.to_string())?;
                self.opened = order.opened;
                let track = Arc::new(Track::new(SOUND_FRAMES as usize, BLOCK_FRAMES as usize));
                shared.set_track(order.number, track.clone());
                track
            }
        };
        control.report(());
        while let Some(block) = shared.next_block(&track) {
            let frames = self.draw(block, order, control, shared)?;
            track.write(block, frames);
            control.report(());
        }
        Ok(())
    }

    /// Draws a block in bands, with pauses between them in which pictures are drawn: no pauses for what is about to
    /// play.
    fn draw(
        &mut self,
        block: usize,
        order: &Order,
        control: &Control<()>,
        shared: &Shared,
    ) -> Result<Vec<[i16; 2]>, String> {
        let mut rows = ROWS.0;
        let mut began: Option<Instant> = None;
        let mut spent = Duration::ZERO;
        let drawn = self.engine.draw_sound(block as u32, order.date, &mut || {
            if let Some(began) = began {
                let took = began.elapsed();
                spent += took;
                if took < BAND / 2 {
                    rows = (2 * rows).min(ROWS.1);
                } else if took > 2 * BAND {
                    rows = (rows / 2).max(ROWS.0);
                }
                if !shared.is_urgent(block) {
                    thread::sleep(took.min(PAUSE));
                }
            }
            if control.is_cancelled() || spent > BLOCK_LIMIT {
                return None;
            }
            shared.goes_on();
            began = Some(Instant::now());
            Some(rows)
        });
        match drawn {
            Ok(Some(frames)) => Ok(frames),
            Ok(None) => {
                control.check()?;
                let limit = BLOCK_LIMIT.as_secs();
                Err(format!("{BLOCK_SECS:.0} s of sound took more than {limit} s to compute"))
            }
            Err(error) => Err(error.to_string()),
        }
    }
}
