//! The one preset whose picture moves.
//!
//! It is drawn on a thread of its own, only while requested, so that neither the window nor thumbnails of textures wait
//! for a frame.

use crate::{
    engine::{BuildOptions, Engine, FrameInputs, Program},
    gpu::Gpu,
    media,
    project::presets,
};
use egui::{ColorImage, TextureHandle, TextureOptions};
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc, Condvar, Mutex, PoisonError,
        mpsc::{Receiver, SyncSender, TrySendError, sync_channel},
    },
    time::{Duration, Instant},
};

/// The size of the picture in pixels: sharp on a card at twice the density.
const SIZE: (u32, u32) = (320, 180);
/// The number of frames that are drawn before the first is shown: until then the built-in picture is better.
const HIDDEN: i32 = 24;
/// The minimum time between two frames that are shown; two are drawn in it.
const INTERVAL: Duration = Duration::from_millis(33);

pub(super) struct Live {
    gpu: Gpu,
    wake: Arc<dyn Fn() + Send + Sync>,
    wanted: Arc<LiveRequests>,
    /// `None` before the first request.
    frames: Option<Receiver<(String, ColorImage)>>,
    shown: Option<(String, TextureHandle)>,
}

/// The preset that the thread is to draw.
#[derive(Default)]
struct LiveRequests {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    name: Option<String>,
    /// No longer needed: the thread ends.
    is_over: bool,
}

impl Live {
    pub(super) fn new(gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        Self { gpu, wake, wanted: Arc::default(), frames: None, shown: None }
    }

    pub(super) fn want(&mut self, name: Option<&str>) {
        let is_new = {
            let mut state = self.wanted.state.lock().unwrap_or_else(PoisonError::into_inner);
            let is_new = state.name.as_deref() != name;
            if is_new {
                state.name = name.map(str::to_owned);
            }
            is_new
        };
        if !is_new {
            return;
        }
        self.wanted.changed.notify_one();
        if self.shown.as_ref().is_some_and(|(shown, _)| Some(shown.as_str()) != name) {
            self.shown = None;
        }
        if name.is_some() && self.frames.is_none() {
            self.start();
        }
    }

    fn start(&mut self) {
        // At most one frame is queued: a window that paints more slowly gets the newest possible.
        let (sender, frames) = sync_channel(1);
        let (gpu, wake, wanted) = (self.gpu.clone(), self.wake.clone(), self.wanted.clone());
        let work = move || {
            gpu.rasteriser().lower_background_priority();
            let gpu = gpu.for_background();
            while let Some(name) = wanted.next() {
                // A panic only ends this picture.
                let drawn = catch_unwind(AssertUnwindSafe(|| draw(&gpu, &name, &wanted, &sender, &*wake)));
                if let Err(why) = drawn.unwrap_or_else(|_| Err("this is a bug in Eddy".into())) {
                    log::warn!("{name} cannot be played: {why}");
                }
                wanted.wait_for_another(&name);
            }
        };
        match std::thread::Builder::new().name("live thumbnail".into()).stack_size(64 << 20).spawn(work) {
            Ok(_) => self.frames = Some(frames),
            // The pictures then do not move, which is the only loss.
            Err(e) => log::warn!("cannot start a thread for live thumbnails: {e}"),
        }
    }

    /// Takes the newest frame.
    pub(super) fn update(&mut self, ctx: &egui::Context) {
        let Some((name, image)) = self.frames.as_ref().and_then(|frames| frames.try_iter().last()) else { return };
        match &mut self.shown {
            Some((shown, texture)) if *shown == name => texture.set(image, TextureOptions::LINEAR),
            _ if self.wanted.is(&name) => {
                let texture = ctx.load_texture("live thumbnail", image, TextureOptions::LINEAR);
                self.shown = Some((name, texture));
            }
            _ => {}
        }
    }

    pub(super) fn frame(&self, name: &str) -> Option<TextureHandle> {
        self.shown.as_ref().filter(|(shown, _)| shown == name).map(|(_, texture)| texture.clone())
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        self.wanted.state.lock().unwrap_or_else(PoisonError::into_inner).is_over = true;
        self.wanted.changed.notify_one();
    }
}

impl LiveRequests {
    /// Waits until a preset is requested; returns `None` at the end.
    fn next(&self) -> Option<String> {
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let waits = |state: &mut State| state.name.is_none() && !state.is_over;
        let state = self.changed.wait_while(state, waits).unwrap_or_else(PoisonError::into_inner);
        state.name.clone().filter(|_| !state.is_over)
    }

    fn wait_for_another(&self, name: &str) {
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let waits = |state: &mut State| state.name.as_deref() == Some(name) && !state.is_over;
        drop(self.changed.wait_while(state, waits));
    }

    fn is(&self, name: &str) -> bool {
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        state.name.as_deref() == Some(name) && !state.is_over
    }

    /// Waits until `end`, or until something else is requested.
    fn wait_until(&self, name: &str, end: Instant) {
        let state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let waits = |state: &mut State| state.name.as_deref() == Some(name) && !state.is_over;
        let left = end.saturating_duration_since(Instant::now());
        drop(self.changed.wait_timeout_while(state, left, waits));
    }
}

/// Draws a preset for as long as it is requested.
fn draw(
    gpu: &Gpu,
    name: &str,
    wanted: &LiveRequests,
    frames: &SyncSender<(String, ColorImage)>,
    wake: &(dyn Fn() + Send + Sync),
) -> Result<(), String> {
    let project = presets::load(name).map_err(|e| e.to_string())?.project;
    let (set, _) = media::gather(&project, None);
    let built = Program::build(gpu, &project, &set, &BuildOptions::default()).map_err(|e| e.to_string())?;
    let mut engine = Engine::new(gpu.clone(), SIZE.0, SIZE.1).map_err(|e| e.to_string())?;
    engine.set_program(built.program).map_err(|e| e.to_string())?;
    let mut number = 0;
    while wanted.is(name) {
        let start = Instant::now();
        for _ in 0..2 {
            let mut inputs = FrameInputs::at_fixed_step(number, 60.0);
            inputs.mouse = stroke(number);
            engine.draw(&inputs).map_err(|e| e.to_string())?;
            gpu.wait().map_err(|e| e.to_string())?;
            number += 1;
        }
        if number < HIDDEN {
            continue;
        }
        let pixels = engine.read_image().map_err(|e| e.to_string())?;
        let size = [pixels.width as usize, pixels.height as usize];
        let mut bytes = pixels.to_rgba8();
        bytes.chunks_exact_mut(4).for_each(|texel| texel[3] = 255);
        match frames.try_send((name.to_owned(), ColorImage::from_rgba_unmultiplied(size, &bytes))) {
            Ok(()) | Err(TrySendError::Full(_)) => wake(),
            Err(TrySendError::Disconnected(_)) => return Ok(()),
        }
        // A slow device rests for as long as it draws.
        let now = Instant::now();
        wanted.wait_until(name, (start + INTERVAL).max(now + (now - start)));
    }
    Ok(())
}

/// Returns the position of a pointer that is dragged in waves across the picture, for shaders that react to the mouse.
fn stroke(frame: i32) -> [f32; 4] {
    /// The number of frames of a stroke and the pause after it.
    const STROKE: i32 = 70;
    const PAUSE: i32 = 50;
    let (width, height) = (SIZE.0 as f32, SIZE.1 as f32);
    let at = |step: i32| {
        let t = (step as f32 / STROKE as f32).min(1.0);
        [(width * (0.15 + 0.7 * t)).floor(), (height * (0.5 + 0.22 * (t * 9.0).sin())).floor()]
    };
    if frame < 4 {
        return [0.0, 0.0, -0.0, -0.0];
    }
    let step = (frame - 4) % (STROKE + PAUSE);
    let ([x, y], [from_x, from_y]) = (at(step), at(0));
    match step {
        0 => [x, y, from_x, from_y],
        1..STROKE => [x, y, from_x, -from_y],
        _ => [x, y, -from_x, -from_y],
    }
}
