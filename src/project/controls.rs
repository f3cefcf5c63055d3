//! Controls of MIDI and OSC devices, and which of the author's own uniforms each one moves.
//!
//! A control is identified by a [`ControlAddress`], a component of a uniform by a [`ControlTarget`]. The bindings of a
//! project are in [`Project::controls`](super::Project::controls), and in `eddy.toml` under `[controls]`. The package
//! `control` decodes what the devices send.

use super::{
    limits,
    pads::{PADS, PadPart},
};
use std::{collections::BTreeMap, fmt};

/// Names of the components of vectors and of colours, in order.
const COMPONENTS: [&str; 2] = ["xyzw", "rgba"];
/// Characters that OSC 1.0 does not allow in an address: they have a meaning in patterns.
const NOT_IN_OSC: &[char] = &[' ', '#', '*', ',', '?', '[', ']', '{', '}'];
/// The number of MIDI parameter numbers: 16,383 is excluded, as it means none.
const PARAMETERS: u16 = 16_383;
/// The forms of an address, for messages.
pub(super) const FORMS: &str = "\"midi 1 cc 21\", \"midi 1 cc14 7\", \"midi 1 nrpn 300\", \"midi 1 note 60\", \"midi 1 bend\", \"pad 1 left-x\" or an OSC address such as \"/1/fader3\"";

/// A control of a device, whichever device has it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ControlAddress {
    /// A 7-bit MIDI control change. Channels are 0 to 15 here and 1 to 16 where users read them.
    ControlChange { channel: u8, number: u8 },
    /// A 14-bit MIDI control change: the controllers `number`, below 32, and `number` + 32.
    ControlChange14 { channel: u8, number: u8 },
    /// A MIDI non-registered parameter (NRPN), 0 to 16,382: controllers 99 and 98 select it, 6 and 38 carry its value.
    Nrpn { channel: u8, number: u16 },
    /// A MIDI note.
    Note { channel: u8, key: u8 },
    /// The pitch bend of a MIDI channel.
    PitchBend { channel: u8 },
    /// A part of a gamepad. Pads are 0 to 3 here and 1 to 4 where users read them.
    Pad { pad: u8, part: PadPart },
    /// An argument of the messages of an OSC address, from 0.
    Osc { path: String, argument: usize },
}

/// A component of a uniform, or the whole of a scalar uniform.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ControlTarget {
    pub uniform: String,
    /// `x`, `y`, `z`, `w` of a vector, `r`, `g`, `b` of a colour.
    pub component: Option<char>,
}

/// The control that moves each target.
pub type ControlBindings = BTreeMap<ControlTarget, ControlAddress>;

impl ControlTarget {
    /// The target of a scalar uniform.
    pub fn whole(uniform: impl Into<String>) -> Self {
        Self { uniform: uniform.into(), component: None }
    }

    /// A component by its name. `None` if no component has that name.
    pub fn of_component(uniform: impl Into<String>, component: &str) -> Option<Self> {
        let mut letters = component.chars();
        let letter = letters.next().filter(|letter| letters.next().is_none() && index_of(*letter).is_some())?;
        Some(Self { uniform: uniform.into(), component: Some(letter) })
    }

    /// Returns the index of the component, from 0.
    pub fn index(&self) -> usize {
        self.component.and_then(index_of).unwrap_or(0)
    }
}

impl fmt::Display for ControlTarget {
    /// `speed`, `center.x`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.uniform)?;
        self.component.map_or(Ok(()), |component| write!(f, ".{component}"))
    }
}

fn index_of(component: char) -> Option<usize> {
    COMPONENTS.iter().find_map(|names| names.find(component))
}

impl ControlAddress {
    /// Parses an address in the form of `eddy.toml`. `None` if it has none of these forms.
    pub fn parse(text: &str) -> Option<Self> {
        let words: Vec<&str> = text.split_ascii_whitespace().collect();
        let below = |word: &str, end: u8| word.parse::<u8>().ok().filter(|n| *n < end);
        if let [path, rest @ ..] = words.as_slice()
            && path.starts_with('/')
        {
            let argument = match rest {
                [] => 1,
                [number] => number.parse().ok().filter(|n| (1..=limits::OSC_ARGUMENTS).contains(n))?,
                _ => return None,
            };
            return is_osc_path(path).then(|| Self::Osc { path: (*path).to_owned(), argument: argument - 1 });
        }
        if let [kind, number, name] = words.as_slice()
            && kind.eq_ignore_ascii_case("pad")
        {
            let pad = below(number, PADS as u8 + 1)?.checked_sub(1)?;
            return Some(Self::Pad { pad, part: PadPart::parse(&name.to_ascii_lowercase())? });
        }
        let [midi, channel, kind, rest @ ..] = words.as_slice() else { return None };
        if !midi.eq_ignore_ascii_case("midi") {
            return None;
        }
        let channel = below(channel, 17)?.checked_sub(1)?;
        match (kind.to_ascii_lowercase().as_str(), rest) {
            ("cc", [number]) => Some(Self::ControlChange { channel, number: below(number, 128)? }),
            ("cc14", [number]) => Some(Self::ControlChange14 { channel, number: below(number, 32)? }),
            ("nrpn", [number]) => {
                let number = number.parse().ok().filter(|n| *n < PARAMETERS)?;
                Some(Self::Nrpn { channel, number })
            }
            ("note", [key]) => Some(Self::Note { channel, key: below(key, 128)? }),
            ("bend", []) => Some(Self::PitchBend { channel }),
            _ => None,
        }
    }

    /// Returns a short form of the address for a row of the window: `CC 21`, `Note 60 ch 2`, `/1/fader3`.
    pub fn label(&self) -> String {
        let of = |channel: u8| if channel == 0 { String::new() } else { format!(" ch {}", channel + 1) };
        match self {
            Self::ControlChange { channel, number } => format!("CC {number}{}", of(*channel)),
            Self::ControlChange14 { channel, number } => format!("CC {number}+{}{}", number + 32, of(*channel)),
            Self::Nrpn { channel, number } => format!("NRPN {number}{}", of(*channel)),
            Self::Note { channel, key } => format!("Note {key}{}", of(*channel)),
            Self::PitchBend { channel } => format!("Pitch bend{}", of(*channel)),
            Self::Pad { pad: 0, part } => format!("Pad {}", part.name()),
            Self::Pad { pad, part } => format!("Pad {} {}", pad + 1, part.name()),
            Self::Osc { .. } => self.to_string(),
        }
    }
}

impl ControlAddress {
    /// Returns whether it is a knob or a fader that stays where it is left, so that its position may differ from the
    /// value that it moves.
    pub fn stays_in_place(&self) -> bool {
        matches!(self, Self::ControlChange { .. } | Self::ControlChange14 { .. } | Self::Nrpn { .. })
    }
}

impl fmt::Display for ControlAddress {
    /// The form in `eddy.toml`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ControlChange { channel, number } => write!(f, "midi {} cc {number}", channel + 1),
            Self::ControlChange14 { channel, number } => write!(f, "midi {} cc14 {number}", channel + 1),
            Self::Nrpn { channel, number } => write!(f, "midi {} nrpn {number}", channel + 1),
            Self::Note { channel, key } => write!(f, "midi {} note {key}", channel + 1),
            Self::PitchBend { channel } => write!(f, "midi {} bend", channel + 1),
            Self::Pad { pad, part } => write!(f, "pad {} {}", pad + 1, part.name()),
            Self::Osc { path, argument: 0 } => f.write_str(path),
            Self::Osc { path, argument } => write!(f, "{path} {}", argument + 1),
        }
    }
}

/// Returns whether a text is a valid OSC address for a control: OSC 1.0, "OSC Address Spaces".
pub fn is_osc_path(text: &str) -> bool {
    let is_allowed = |c: char| c.is_ascii_graphic() && !NOT_IN_OSC.contains(&c);
    text.len() > 1 && text.starts_with('/') && text.len() <= limits::OSC_PATH && text.chars().all(is_allowed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_round_trip_through_text() {
        let all = [
            ControlAddress::ControlChange { channel: 0, number: 127 },
            ControlAddress::ControlChange14 { channel: 15, number: 31 },
            ControlAddress::Nrpn { channel: 15, number: 16_382 },
            ControlAddress::Note { channel: 3, key: 0 },
            ControlAddress::PitchBend { channel: 9 },
            ControlAddress::Pad { pad: 3, part: PadPart::Axis(1) },
            ControlAddress::Pad { pad: 0, part: PadPart::Button(16) },
            ControlAddress::Osc { path: "/1/fader3".into(), argument: 0 },
            ControlAddress::Osc { path: "/1/xy".into(), argument: 1 },
        ];
        for address in all {
            assert_eq!(ControlAddress::parse(&address.to_string()), Some(address.clone()), "{address}");
        }
        assert_eq!(
            ControlAddress::parse(" MIDI 2  CC 7 "),
            Some(ControlAddress::ControlChange { channel: 1, number: 7 })
        );
        let wrong = [
            "",
            "cc 21",
            "midi 0 cc 1",
            "midi 17 cc 1",
            "midi 1 cc 128",
            "midi 1 cc14 32",
            "midi 1 nrpn 16383",
            "midi 1 nrpn",
            "midi 1 note",
            "midi 1 bend 2",
            "midi 1 knob 2",
            "/",
            "/a*",
            "/a b",
            "/a 0",
            "/a 1 2",
            "/ä",
            "1/fader",
            "pad 5 south",
            "pad 0 south",
            "pad 1 knob",
        ];
        for text in wrong {
            assert_eq!(ControlAddress::parse(text), None, "{text}");
        }
        assert_eq!(ControlAddress::parse(&format!("/{}", "a".repeat(limits::OSC_PATH))), None);
    }

    #[test]
    fn components_have_two_names() {
        for (name, index) in [("x", 0), ("w", 3), ("r", 0), ("b", 2)] {
            let target = ControlTarget::of_component("tint", name).unwrap();
            assert_eq!((target.index(), target.to_string()), (index, format!("tint.{name}")));
        }
        assert_eq!(ControlTarget::of_component("tint", "xy"), None);
        assert_eq!(ControlTarget::of_component("tint", "q"), None);
        assert_eq!(ControlTarget::whole("speed").to_string(), "speed");
    }
}
