//! Parts of a gamepad, named and ordered as in the W3C's standard gamepad
//! (<https://www.w3.org/TR/gamepad/#remapping>).

/// The number of gamepads that are distinguished.
pub const PADS: usize = 4;

/// The axes of both sticks. They range from -1 to 1, to the right and up.
pub const PAD_AXES: [&str; 4] = ["left-x", "left-y", "right-x", "right-y"];

/// The buttons. Triggers range from 0 to 1, the others are 0 or 1.
pub const PAD_BUTTONS: [&str; 17] = [
    "south",
    "east",
    "west",
    "north",
    "left-shoulder",
    "right-shoulder",
    "left-trigger",
    "right-trigger",
    "select",
    "start",
    "left-stick",
    "right-stick",
    "up",
    "down",
    "left",
    "right",
    "guide",
];

/// An axis or a button of a gamepad, by its index in [`PAD_AXES`] or [`PAD_BUTTONS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PadPart {
    Axis(u8),
    Button(u8),
}

impl PadPart {
    /// Returns the part with a name. `None` if there is no such part.
    pub fn parse(name: &str) -> Option<Self> {
        let place = |names: &[&str]| names.iter().position(|known| *known == name).map(|place| place as u8);
        place(&PAD_AXES).map(Self::Axis).or_else(|| place(&PAD_BUTTONS).map(Self::Button))
    }

    pub fn name(self) -> &'static str {
        let name = match self {
            Self::Axis(place) => PAD_AXES.get(usize::from(place)),
            Self::Button(place) => PAD_BUTTONS.get(usize::from(place)),
        };
        name.copied().unwrap_or_default()
    }

    /// Returns a position normalized to the range of 0 to 1.
    pub fn part_of_way(self, value: f32) -> f64 {
        match self {
            Self::Axis(_) => f64::midpoint(f64::from(value), 1.0),
            Self::Button(_) => f64::from(value),
        }
    }
}
