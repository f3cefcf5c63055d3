//! The machine's gamepads, by gilrs: evdev and udev, IOKit, or Windows.Gaming.Input.

use super::{PadEvent, PadHost, PadIn};
use eddy_project::{PADS, PadPart};
use gilrs::{Axis, Button, Event, EventType, GamepadId, Gilrs};
use std::{collections::VecDeque, time::Duration};

/// The gamepads of this machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Machine;

impl PadHost for Machine {
    fn open(&self) -> Result<Box<dyn PadIn>, String> {
        let pads = Gilrs::new().map_err(|error| error.to_string())?;
        let mut open = Open { pads, slots: [None; PADS], waiting: VecDeque::new() };
        // The gamepads that are already plugged in.
        let ids: Vec<GamepadId> = open.pads.gamepads().map(|(id, _)| id).collect();
        ids.into_iter().for_each(|id| open.connect(id));
        Ok(Box::new(open))
    }
}

struct Open {
    pads: Gilrs,
    /// The pad of each number.
    slots: [Option<GamepadId>; PADS],
    waiting: VecDeque<PadEvent>,
}

impl Open {
    fn number(&self, id: GamepadId) -> Option<usize> {
        self.slots.iter().position(|slot| *slot == Some(id))
    }

    /// Gives a pad its previous number, otherwise a free one, otherwise that of a disconnected one. A fifth pad gets
    /// none.
    fn connect(&mut self, id: GamepadId) {
        let is_gone = |slot: &Option<GamepadId>| slot.is_none_or(|id| self.pads.connected_gamepad(id).is_none());
        let free = self.slots.iter().position(Option::is_none).or_else(|| self.slots.iter().position(is_gone));
        let Some(pad) = self.number(id).or(free) else { return };
        self.slots[pad] = Some(id);
        let gamepad = self.pads.gamepad(id);
        let name = gamepad.name().to_owned();
        self.waiting.push_back(PadEvent::Connected { pad, name });
    }
}

impl PadIn for Open {
    fn next(&mut self, patience: Duration) -> Option<PadEvent> {
        if let Some(event) = self.waiting.pop_front() {
            return Some(event);
        }
        let Event { id, event, .. } = self.pads.next_event_blocking(Some(patience))?;
        match event {
            EventType::Connected => {
                self.connect(id);
                self.waiting.pop_front()
            }
            EventType::Disconnected => Some(PadEvent::Disconnected { pad: self.number(id)? }),
            EventType::AxisChanged(axis, value, _) => {
                Some(PadEvent::Moved { pad: self.number(id)?, part: part_of_axis(axis)?, value })
            }
            EventType::ButtonChanged(button, value, _) => {
                Some(PadEvent::Moved { pad: self.number(id)?, part: part_of_button(button)?, value })
            }
            _ => None,
        }
    }
}

fn part_of_axis(axis: Axis) -> Option<PadPart> {
    PadPart::parse(match axis {
        Axis::LeftStickX => "left-x",
        Axis::LeftStickY => "left-y",
        Axis::RightStickX => "right-x",
        Axis::RightStickY => "right-y",
        _ => return None,
    })
}

fn part_of_button(button: Button) -> Option<PadPart> {
    PadPart::parse(match button {
        Button::South => "south",
        Button::East => "east",
        Button::West => "west",
        Button::North => "north",
        Button::LeftTrigger => "left-shoulder",
        Button::RightTrigger => "right-shoulder",
        Button::LeftTrigger2 => "left-trigger",
        Button::RightTrigger2 => "right-trigger",
        Button::Select => "select",
        Button::Start => "start",
        Button::LeftThumb => "left-stick",
        Button::RightThumb => "right-stick",
        Button::DPadUp => "up",
        Button::DPadDown => "down",
        Button::DPadLeft => "left",
        Button::DPadRight => "right",
        Button::Mode => "guide",
        Button::C | Button::Z | Button::Unknown => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No panic, on machines with and without gamepads.
    #[test]
    fn a_machine_without_gamepads_is_silent() {
        if let Ok(mut pads) = Machine.open() {
            let _ = pads.next(Duration::from_millis(1));
        }
        assert_eq!(part_of_axis(Axis::RightStickY), Some(PadPart::Axis(3)));
        assert_eq!(part_of_button(Button::Mode), Some(PadPart::Button(16)));
    }
}
