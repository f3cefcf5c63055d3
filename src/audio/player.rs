//! The output: a mixer on a device that is open while there is sound to play.

use crate::{
    host::{AudioHost, AudioOut, DeviceError, Events, Opened},
    keeper::{DeviceState, Keeper, Work},
    mixer::{MixerState, Remote, mixer},
    scene::OutputState,
};
use std::{
    sync::{Arc, Mutex, PoisonError},
    time::Instant,
};

/// Plays the desired output on a device of the machine.
pub struct Player {
    keeper: Keeper<Playing>,
    mixed: Mixed,
}

impl Player {
    /// Starts a thread. `wake` is called from it when the state of the device has changed.
    pub fn on_thread(host: &dyn AudioHost, wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let (playing, mixed) = Playing::new(host);
        Ok(Self { keeper: Keeper::on_thread("sound", playing, wake)?, mixed })
    }

    /// Creates a player without a thread: [`Player::step`] opens and controls the device.
    pub fn here(host: &dyn AudioHost) -> Self {
        let (playing, mixed) = Playing::new(host);
        Self { keeper: Keeper::here(playing), mixed }
    }

    /// Sets what is played from now on.
    pub fn play(&mut self, desired: OutputState) {
        self.keeper.order(desired);
    }

    /// Requests a device by its name, or the system's default one.
    pub fn choose(&mut self, device: Option<String>) {
        self.keeper.choose(device);
    }

    /// Requests the names of the devices.
    pub fn ask_names(&mut self) {
        self.keeper.ask_names();
    }

    /// Returns the names of the devices, once requested.
    pub fn names(&self) -> Option<Vec<String>> {
        self.keeper.names()
    }

    /// Does pending work if there is no thread.
    pub fn step(&mut self, now: Instant) {
        self.keeper.step(now);
    }

    /// Returns the state of the device; a change of it calls `wake`.
    pub fn state(&self) -> DeviceState {
        self.keeper.state()
    }

    /// Returns the number of late buffers since the start.
    pub fn underruns(&self) -> u64 {
        self.keeper.underruns()
    }

    /// Returns the counters of the open device's mixer.
    pub fn mixed(&self) -> Option<Arc<MixerState>> {
        self.mixed.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// The counters of the open device's mixer.
type Mixed = Arc<Mutex<Option<Arc<MixerState>>>>;

struct Playing {
    out: Box<dyn AudioOut>,
    desired: OutputState,
    remote: Option<Remote>,
    mixed: Mixed,
}

impl Playing {
    fn new(host: &dyn AudioHost) -> (Self, Mixed) {
        let mixed = Mixed::default();
        (Self { out: host.output(), desired: OutputState::default(), remote: None, mixed: Arc::clone(&mixed) }, mixed)
    }

    fn set_mixed(&self) {
        let state = self.remote.as_ref().map(|remote| remote.state.clone());
        *self.mixed.lock().unwrap_or_else(PoisonError::into_inner) = state;
    }
}

impl Work for Playing {
    type Order = OutputState;

    fn take(&mut self, desired: OutputState) {
        self.desired = desired;
    }

    fn needs_device(&self) -> bool {
        self.desired.is_heard()
    }

    fn open(&mut self, name: Option<&str>, events: Events) -> Result<Opened, DeviceError> {
        let mut made = None;
        let desired = &self.desired;
        let mut fill = |format: crate::host::Format| -> crate::host::Fill {
            let (mut mixer, mut remote) = mixer(format.rate);
            remote.send(desired);
            made = Some(remote);
            Box::new(move |out, heard_at| mixer.fill(out, format.channels, heard_at))
        };
        let opened = self.out.open(name, &mut fill, events)?;
        self.remote = made;
        self.set_mixed();
        Ok(opened)
    }

    fn feed(&mut self) -> bool {
        self.remote.as_mut().is_none_or(|remote| remote.send(&self.desired))
    }

    fn closed(&mut self) {
        self.remote = None;
        self.set_mixed();
    }

    fn names(&mut self) -> Vec<String> {
        self.out.names()
    }
}
