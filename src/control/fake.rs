//! MIDI devices and gamepads for tests: they are plugged in, unplugged and send when the test tells them to.

use crate::{
    midi::host::{MidiError, MidiHost, MidiIn, Opened, Take},
    pads::{PadEvent, PadHost, PadIn},
};
use std::{
    collections::{BTreeMap, VecDeque},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::Duration,
};

/// The devices by name, each with the callback that takes what it sends, if open.
type Devices = BTreeMap<String, Option<Take>>;

/// The MIDI devices of a simulated machine.
#[derive(Clone, Default)]
pub struct FakeMidi(Arc<Mutex<Devices>>);

impl std::fmt::Debug for FakeMidi {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.lock().keys()).finish()
    }
}

impl FakeMidi {
    fn lock(&self) -> MutexGuard<'_, Devices> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Connects a device; one that is connected already stays open.
    pub fn plug_in(&self, name: &str) {
        self.lock().entry(name.to_owned()).or_default();
    }

    /// Disconnects a device, and drops the callback that was passed to `open`.
    pub fn unplug(&self, name: &str) {
        self.lock().remove(name);
    }

    /// Returns whether a device is connected and open.
    pub fn is_open(&self, name: &str) -> bool {
        self.lock().get(name).is_some_and(Option::is_some)
    }

    /// Sends bytes from a device to the callback that was passed to `open`, if any.
    pub fn send(&self, name: &str, bytes: &[u8]) {
        if let Some(Some(take)) = self.lock().get_mut(name) {
            take(bytes);
        }
    }
}

impl MidiHost for FakeMidi {
    fn input(&self) -> Box<dyn MidiIn> {
        Box::new(self.clone())
    }
}

struct Close(FakeMidi, String);

impl Drop for Close {
    fn drop(&mut self) {
        if let Some(device) = self.0.lock().get_mut(&self.1) {
            *device = None;
        }
    }
}

impl MidiIn for FakeMidi {
    fn names(&mut self) -> Result<Vec<String>, MidiError> {
        Ok(self.lock().keys().cloned().collect())
    }

    fn open(&mut self, name: &str, take: Take) -> Result<Opened, MidiError> {
        let mut devices = self.lock();
        let device = devices.get_mut(name).ok_or_else(|| MidiError::Unknown(name.to_owned()))?;
        *device = Some(take);
        drop(devices);
        Ok(Box::new(Close(self.clone(), name.to_owned())))
    }
}

/// Simulated gamepads.
#[derive(Clone, Debug, Default)]
pub struct FakePads(Arc<Mutex<VecDeque<PadEvent>>>);

impl FakePads {
    /// Queues an event for the listener.
    pub fn happens(&self, event: PadEvent) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push_back(event);
    }
}

impl PadHost for FakePads {
    fn open(&self) -> Result<Box<dyn PadIn>, String> {
        Ok(Box::new(self.clone()))
    }
}

impl PadIn for FakePads {
    fn next(&mut self, _: Duration) -> Option<PadEvent> {
        let event = self.0.lock().unwrap_or_else(PoisonError::into_inner).pop_front();
        if event.is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        event
    }
}
