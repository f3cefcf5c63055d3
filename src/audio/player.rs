//! The output: a mixer on a device that is opened while something is to be heard.

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

/// Plays what it is told on a device of the machine.
pub struct Player {
    keeper: Keeper<Playing>,
    mixed: Mixed,
}

impl Player {
    /// `wake` is called from another thread when the state of the device has changed.
    pub fn on_thread(host: &dyn AudioHost, wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let (playing, mixed) = Playing::new(host);
        Ok(Self { keeper: Keeper::on_thread("sound", playing, wake)?, mixed })
    }

    /// Without a thread: the device is opened and told by [`Player::step`].
    pub fn here(host: &dyn AudioHost) -> Self {
        let (playing, mixed) = Playing::new(host);
        Self { keeper: Keeper::here(playing), mixed }
    }

    /// Says what is to be played from now on.
    pub fn play(&mut self, desired: OutputState) {
        self.keeper.order(desired);
    }

    /// Asks for a device by its name, or for the system's default one.
    pub fn choose(&mut self, device: Option<String>) {
        self.keeper.choose(device);
    }

    /// Asks for the names of the devices.
    pub fn ask_names(&mut self) {
        self.keeper.ask_names();
    }

    /// Returns the names of the devices, once they have been asked for.
    pub fn names(&self) -> Option<Vec<String>> {
        self.keeper.names()
    }

    /// Does what is due, where there is no thread.
    pub fn step(&mut self, now: Instant) {
        self.keeper.step(now);
    }

    pub fn state(&self) -> DeviceState {
        self.keeper.state()
    }

    /// Buffers that came too late since the start.
    pub fn underruns(&self) -> u64 {
        self.keeper.underruns()
    }

    /// Returns what the mixer of the device that is open has done.
    pub fn mixed(&self) -> Option<Arc<MixerState>> {
        self.mixed.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// The state of the mixer of the device that is open.
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
