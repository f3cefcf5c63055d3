//! The inputs of a pass, by slot.

use super::Channel;
use std::collections::BTreeMap;

/// The number of slots in Shadertoy's language, `iChannel0` to `iChannel3`, and in the formats of Eddy and Shadertoy.
/// [`Bindings`] itself has no limit.
pub const SLOTS: usize = 4;

/// The channels of a pass by slot: slot n is `iChannelN`. A slot without a channel reads as an opaque black 2D texture
/// of size 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bindings(BTreeMap<usize, Channel>);

impl Bindings {
    pub fn get(&self, slot: usize) -> Option<&Channel> {
        self.0.get(&slot)
    }

    pub fn get_mut(&mut self, slot: usize) -> Option<&mut Channel> {
        self.0.get_mut(&slot)
    }

    /// Binds a channel to a slot; `None` empties it.
    pub fn set(&mut self, slot: usize, channel: Option<Channel>) {
        match channel {
            Some(channel) => drop(self.0.insert(slot, channel)),
            None => drop(self.0.remove(&slot)),
        }
    }

    /// Removes the channels for which `is_kept` returns false.
    pub fn retain(&mut self, is_kept: impl Fn(&Channel) -> bool) {
        self.0.retain(|_, channel| is_kept(channel));
    }

    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Every channel with its slot, in slot order.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (usize, &Channel)> {
        self.0.iter().map(|(slot, channel)| (*slot, channel))
    }

    /// Every channel, in slot order.
    pub fn channels(&self) -> impl DoubleEndedIterator<Item = &Channel> {
        self.0.values()
    }

    pub fn channels_mut(&mut self) -> impl DoubleEndedIterator<Item = &mut Channel> {
        self.0.values_mut()
    }
}

impl FromIterator<(usize, Channel)> for Bindings {
    fn from_iter<T: IntoIterator<Item = (usize, Channel)>>(channels: T) -> Self {
        Self(channels.into_iter().collect())
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
