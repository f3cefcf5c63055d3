//! Mixes sources in a device's callback at the time of the picture, with fades where that time changes.
//!
//! Works on memory alone and knows no device. [`Mixer::fill`] takes no lock and neither allocates nor frees memory:
//! orders arrive through a ring buffer, and scenes that are no longer played are returned through another.

mod deck;
#[cfg(test)]
mod tests;

use crate::{
    SAMPLE_RATE,
    kernel::Kernel,
    scene::{OutputState, Scene, Timeline},
};
use deck::Deck;
use rtrb::{Consumer, Producer, RingBuffer};
use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Instant,
};

/// The length of fades in seconds.
const FADE_SECS: f64 = 0.005;
/// The seconds in which the volume goes from zero to full.
const VOLUME_SECS: f64 = 0.02;
/// Seconds from the picture's time above which the sound jumps there.
const JUMP_SECS: f64 = 0.02;
/// Below that distance, the speed changes by this factor times the distance in seconds.
const PULL: f64 = 0.5;
/// The maximum change of speed: 5 cents, which is inaudible.
const MOST_PULL: f64 = 0.003;
/// The seconds over which the distance is averaged: the delay that a device reports is uncertain by a part of its
/// buffer, and more while other programs delay its thread.
const AVERAGED_SECS: f64 = 1.0;
/// The number of scenes that play at once: the current one and those that fade out.
const DECKS: usize = 4;
/// The capacities of the rings for orders, and for sources that wait to be freed.
const ORDERS: usize = 16;
const FREED: usize = 64;

/// Mixes the desired output into the buffers of one device.
pub(crate) struct Mixer {
    rate: f64,
    orders: Consumer<OutputState>,
    freed: Producer<Arc<Scene>>,
    desired: OutputState,
    /// The timeline of the last buffer.
    line: Option<Timeline>,
    decks: [Option<Deck>; DECKS],
    kernel: Kernel,
    gain: f32,
    /// The averaged delay of the sound relative to the picture, in seconds.
    lag: f64,
    state: Arc<MixerState>,
}

/// The controlling end of a mixer.
pub(crate) struct Remote {
    orders: Producer<OutputState>,
    freed: Consumer<Arc<Scene>>,
    pub state: Arc<MixerState>,
}

/// Counters of a mixer.
#[derive(Default)]
pub struct MixerState {
    buffers: AtomicU64,
    jumps: AtomicU64,
    lag: AtomicU64,
}

impl MixerState {
    /// Returns the number of buffers that were filled.
    pub fn buffers(&self) -> u64 {
        self.buffers.load(Ordering::Relaxed)
    }

    /// Returns how often the sound jumped to the picture's time.
    pub fn jumps(&self) -> u64 {
        self.jumps.load(Ordering::Relaxed)
    }

    /// Returns the averaged delay of the sound relative to the picture, in seconds.
    pub fn behind_secs(&self) -> f64 {
        f64::from_bits(self.lag.load(Ordering::Relaxed))
    }
}

/// Creates a mixer for a device of `rate` samples per second, which initially plays nothing.
pub(crate) fn mixer(rate: u32) -> (Mixer, Remote) {
    let (to, orders) = RingBuffer::new(ORDERS);
    let (freed, back) = RingBuffer::new(FREED);
    let state = Arc::new(MixerState::default());
    let mixer = Mixer {
        rate: f64::from(rate.max(1)),
        orders,
        freed,
        desired: OutputState::default(),
        line: None,
        decks: std::array::from_fn(|_| None),
        kernel: Kernel::default(),
        gain: 0.0,
        lag: 0.0,
        state: state.clone(),
    };
    (mixer, Remote { orders: to, freed: back, state })
}

impl Remote {
    /// Sets what is played from the next buffer on. Returns false if the mixer cannot take an order now; the caller
    /// retries.
    pub(crate) fn send(&mut self, desired: &OutputState) -> bool {
        self.free();
        self.orders.push(desired.clone()).is_ok()
    }

    /// Frees scenes that the mixer no longer plays.
    pub(crate) fn free(&mut self) {
        while self.freed.pop().is_ok() {}
    }
}

impl Mixer {
    /// Fills a buffer of interleaved frames, the first of which is heard at a moment. The first two channels are left
    /// and right, a single channel is the mean of both, and further ones are silent.
    pub(crate) fn fill(&mut self, out: &mut [f32], channels: usize, heard_at: Instant) {
        let channels = channels.max(1);
        let frames = out.len() / channels;
        self.take_orders();
        let ratio = self.steer(frames, heard_at);
        let fade = (1.0 / (FADE_SECS * self.rate)) as f32;
        let volume = (1.0 / (VOLUME_SECS * self.rate)) as f32;
        let Self { decks, kernel, .. } = self;
        for frame in out.chunks_mut(channels) {
            let mut sum = [0.0; 2];
            for deck in decks.iter_mut().flatten() {
                let [left, right] = deck.next(kernel, ratio, fade);
                sum[0] += left;
                sum[1] += right;
            }
            self.gain += (self.desired.gain - self.gain).clamp(-volume, volume);
            let [left, right] = sum.map(|sample| (sample * self.gain).clamp(-1.0, 1.0));
            match frame {
                [one] => *one = 0.5 * (left + right),
                [first, second, rest @ ..] => {
                    (*first, *second) = (left, right);
                    rest.fill(0.0);
                }
                [] => {}
            }
        }
        for place in decks {
            let Some(mut deck) = place.take_if(|deck| deck.is_over()) else { continue };
            // Dropping it here might free memory here. It waits for room.
            if let Err(rtrb::PushError::Full(scene)) = self.freed.push(deck.scene) {
                deck.scene = scene;
                *place = Some(deck);
            }
        }
        self.state.buffers.fetch_add(1, Ordering::Relaxed);
        self.state.lag.store(self.lag.to_bits(), Ordering::Relaxed);
    }

    fn take_orders(&mut self) {
        while self.freed.slots() > DECKS
            && let Ok(desired) = self.orders.pop()
        {
            let before = std::mem::replace(&mut self.desired, desired);
            // The ring has room for it.
            let _ = self.freed.push(before.scene);
        }
    }

    /// Aligns the sound with the picture's time. Returns the samples of a source per sample of the device.
    fn steer(&mut self, frames: usize, heard_at: Instant) -> f64 {
        let before = std::mem::replace(&mut self.line, self.desired.line);
        let Some(line) = self.desired.line else {
            self.decks.iter_mut().flatten().for_each(|deck| deck.target = 0.0);
            return before.map_or(1.0, |line| line.speed * f64::from(SAMPLE_RATE) / self.rate);
        };
        let ratio = line.speed * f64::from(SAMPLE_RATE) / self.rate;
        let wanted = line.position_at(heard_at);
        let Some(playing) = self.decks.iter_mut().flatten().find(|deck| deck.target > 0.0) else {
            self.lag = 0.0;
            if !self.desired.scene.sources.is_empty() {
                self.start(wanted, ratio);
            }
            return ratio;
        };
        let is_other = !Arc::ptr_eq(&playing.scene, &self.desired.scene);
        let at = playing.position;
        let turned = before.is_some_and(|before| {
            before != line && (before.secs_at(heard_at) - line.secs_at(heard_at)).abs() > JUMP_SECS
        });
        let lag = (wanted - at) / f64::from(SAMPLE_RATE);
        let share = 1.0 - (-(frames as f64) / self.rate / AVERAGED_SECS).exp();
        self.lag += share * (lag - self.lag);
        if turned || self.lag.abs() > JUMP_SECS * line.speed.max(1.0) {
            if self.start(wanted, ratio) {
                self.lag = 0.0;
                self.state.jumps.fetch_add(1, Ordering::Relaxed);
            } else {
                // Retry with the next buffer.
                self.line = before;
            }
        } else if is_other {
            self.start(at, ratio);
        }
        ratio * (1.0 + (PULL * self.lag / line.speed).clamp(-MOST_PULL, MOST_PULL))
    }

    /// Starts to play the desired scene at a position, and fades out the current one. Returns false if there is no
    /// room.
    fn start(&mut self, position: f64, ratio: f64) -> bool {
        let Some(place) = self.decks.iter().position(Option::is_none) else { return false };
        self.decks.iter_mut().flatten().for_each(|deck| deck.target = 0.0);
        self.decks[place] = Some(Deck::new(self.desired.scene.clone(), position, ratio));
        true
    }
}
