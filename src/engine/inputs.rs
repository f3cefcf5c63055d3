//! The inputs of one frame besides the project: time, mouse, keys, gamepads, date.

use eddy_audio::Spectrum;
use eddy_media::{Gamepads, Keyboard};
use std::sync::Arc;

/// The values of the uniforms and the keyboard texture in one frame. They are defined in `shadertoy.md`, sections 3 to
/// 6.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameInputs {
    /// `iFrame`.
    pub frame: i32,
    /// `iTime`, seconds. Kept in f64: an f32 clock steps by 8 ms after a day.
    pub time_secs: f64,
    /// `iTimeDelta`, seconds.
    pub time_delta_secs: f32,
    /// `iFrameRate`, frames per second.
    pub frame_rate: f32,
    /// `iMouse`, canvas pixels from the bottom left.
    pub mouse: [f32; 4],
    /// The position of the pointer in canvas pixels from the bottom left, whether or not a button is down; `None` before
    /// it first moves. Programs other than Shadertoy read it.
    pub pointer: Option<[f32; 2]>,
    /// The total distance in canvas pixels that the mouse was dragged, to the right and up: it rotates cameras.
    pub drag: [f32; 2],
    /// `iDate`: year, month 0-11, day 1-31, seconds since local midnight.
    pub date: [f32; 4],
    pub keyboard: Keyboard,
    pub gamepads: Gamepads,
    /// The analyser's texture of the microphone; `None` if there is no microphone or it is switched off.
    pub microphone: Option<Arc<Spectrum>>,
}

impl FrameInputs {
    /// Returns frame `frame` of a run with a fixed step of `1/fps` seconds: no input, date zero.
    pub fn at_fixed_step(frame: i32, fps: f64) -> Self {
        Self {
            frame,
            time_secs: f64::from(frame) / fps,
            time_delta_secs: (1.0 / fps) as f32,
            frame_rate: fps as f32,
            mouse: [0.0; 4],
            pointer: None,
            drag: [0.0; 2],
            date: [0.0; 4],
            keyboard: Keyboard::default(),
            gamepads: Gamepads::default(),
            microphone: None,
        }
    }
}
