//! The inputs of a pass, by slot.

use super::Channel;
use std::collections::BTreeMap;

/// The number of slots in Shadertoy's language, `iChannel0` to `iChannel3`, and in the formats of Eddy and Shadertoy.
/// [`Bindings`] itself has no limit.
pub const SLOTS: usize = 4;

/// The number of slots of a pass in any dialect: the sampled textures that every device offers to a stage (WebGPU,
/// limit `maxSampledTexturesPerShaderStage`).
pub const MAX_CHANNELS: usize = 16;

/// The channels of a pass by slot: slot n is `iChannelN`. A slot without a channel reads as an opaque black 2D texture
/// of size 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bindings {
    channels: BTreeMap<usize, Channel>,
    /// The names of samplers that are not called `iChannelN`.
    names: BTreeMap<usize, String>,
}

impl Bindings {
    pub fn get(&self, slot: usize) -> Option<&Channel> {
        self.channels.get(&slot)
    }

    pub fn get_mut(&mut self, slot: usize) -> Option<&mut Channel> {
        self.channels.get_mut(&slot)
    }

    /// Binds a channel to a slot; `None` empties it.
    pub fn set(&mut self, slot: usize, channel: Option<Channel>) {
        match channel {
            Some(channel) => drop(self.channels.insert(slot, channel)),
            None => drop(self.channels.remove(&slot)),
        }
    }

    /// Returns the name of the sampler of a slot, if the text calls it other than `iChannelN`.
    pub fn name(&self, slot: usize) -> Option<&str> {
        self.names.get(&slot).map(String::as_str)
    }

    /// Sets the name of the sampler of a slot. A slot keeps it while no channel is bound to it.
    pub fn set_name(&mut self, slot: usize, name: &str) {
        self.names.insert(slot, name.to_owned());
    }

    /// The names of samplers, in slot order.
    pub fn names(&self) -> impl Iterator<Item = (usize, &str)> {
        self.names.iter().map(|(slot, name)| (*slot, name.as_str()))
    }

    /// Removes the channels for which `is_kept` returns false.
    pub fn retain(&mut self, is_kept: impl Fn(&Channel) -> bool) {
        self.channels.retain(|_, channel| is_kept(channel));
    }

    pub fn is_empty(&self) -> bool {
        self.channels.is_empty()
    }

    /// Every channel with its slot, in slot order.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (usize, &Channel)> {
        self.channels.iter().map(|(slot, channel)| (*slot, channel))
    }

    /// Every channel, in slot order.
    pub fn channels(&self) -> impl DoubleEndedIterator<Item = &Channel> {
        self.channels.values()
    }

    pub fn channels_mut(&mut self) -> impl DoubleEndedIterator<Item = &mut Channel> {
        self.channels.values_mut()
    }
}

impl FromIterator<(usize, Channel)> for Bindings {
    fn from_iter<T: IntoIterator<Item = (usize, Channel)>>(channels: T) -> Self {
        Self { channels: channels.into_iter().collect(), names: BTreeMap::new() }
    }
}

/// Binds the first slots in order; `None` leaves a slot empty.
impl<const N: usize> From<[Option<Channel>; N]> for Bindings {
    fn from(channels: [Option<Channel>; N]) -> Self {
        channels.into_iter().enumerate().filter_map(|(slot, channel)| Some((slot, channel?))).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Input;

    #[test]
    fn slots_are_sparse_and_sorted() {
        let channel = |name: &str| Channel::new(Input::buffer(name));
        let mut bindings = Bindings::default();
        bindings.set(9, Some(channel("B")));
        bindings.set(2, Some(channel("A")));
        assert_eq!(bindings.iter().map(|(slot, _)| slot).collect::<Vec<_>>(), [2, 9]);
        assert_eq!((bindings.get(2), bindings.get(3)), (Some(&channel("A")), None));
        bindings.set(9, None);
        assert_eq!(bindings, [None, None, Some(channel("A"))].into());
        bindings.set(2, None);
        assert!(bindings.is_empty());
    }
}
