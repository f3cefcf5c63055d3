//! This machine's devices, each if Eddy was built with its feature.

use crate::{
    audio::host::AudioHost,
    control::{midi::host::MidiHost, pads::PadHost},
};
use std::sync::Arc;

pub(super) fn audio() -> Option<Arc<dyn AudioHost>> {
    #[cfg(not(feature = "audio"))]
    return None;
    #[cfg(feature = "audio")]
    Some(Arc::new(crate::audio::device::Machine))
}

pub(super) fn midi() -> Option<Arc<dyn MidiHost>> {
    #[cfg(not(feature = "midi"))]
    return None;
    #[cfg(feature = "midi")]
    Some(Arc::new(crate::control::midi::machine::Machine))
}

pub(super) fn gamepads() -> Option<Arc<dyn PadHost>> {
    #[cfg(not(feature = "gamepad"))]
    return None;
    #[cfg(feature = "gamepad")]
    Some(Arc::new(crate::control::pads::machine::Machine))
}
