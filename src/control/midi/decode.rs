//! Decodes the bytes of MIDI 1.0 to events.
//!
//! Status bytes, running status and system messages follow the "MIDI 1.0 Detailed Specification" (MIDI Manufacturers
//! Association, 4.2); there, controllers 0 to 31 are the coarse and 32 to 63 the fine parts of 14-bit controllers.
//! Controllers 99 and 98 select a non-registered parameter, 101 and 100 a registered one, and 6 with 38 ("data entry")
//! set its value.

use crate::ControlEvent;
use eddy_project::ControlAddress;
use std::time::{Duration, Instant};

/// The maximum time between the coarse and the fine part of a 14-bit controller.
const PAIR: Duration = Duration::from_millis(50);

/// The controllers that set the selected parameter, coarse and fine.
const DATA_ENTRY: u8 = 6;
const DATA_ENTRY_FINE: u8 = 38;
/// The controllers that select a parameter.
const NRPN_FINE: u8 = 98;
const NRPN_COARSE: u8 = 99;
const RPN_FINE: u8 = 100;
const RPN_COARSE: u8 = 101;
/// The parameter number for "none": 127 in both parts.
const NO_PARAMETER: u16 = 16_383;

const NOTE_OFF: u8 = 0x80;
const NOTE_ON: u8 = 0x90;
const KEY_PRESSURE: u8 = 0xa0;
const CONTROL_CHANGE: u8 = 0xb0;
const PROGRAM_CHANGE: u8 = 0xc0;
const CHANNEL_PRESSURE: u8 = 0xd0;
const PITCH_BEND: u8 = 0xe0;
const SYSTEM: u8 = 0xf0;
/// The first of the bytes that may occur within another message.
const REAL_TIME: u8 = 0xf8;

/// A decoder for the bytes of one device.
#[derive(Debug, Default)]
pub struct MidiDecoder {
    /// The status of the current message; 0 if there is none, so that data bytes are ignored.
    status: u8,
    first: Option<u8>,
    /// The newest coarse part of each channel's controllers 0 to 31.
    coarse: [[Option<CoarseValue>; 32]; 16],
    /// The selected parameter of each channel.
    parameters: [Parameter; 16],
}

/// The selected non-registered parameter of a channel, as far as its number has been received.
#[derive(Clone, Copy, Debug, Default)]
struct Parameter {
    coarse: Option<u8>,
    fine: Option<u8>,
    /// The coarse part of its newest value.
    value: Option<u8>,
    /// A fine part of a value was received: the next coarse part waits for its own.
    is_fine: bool,
}

impl Parameter {
    fn number(&self) -> Option<u16> {
        let number = (u16::from(self.coarse?) << 7) | u16::from(self.fine?);
        (number != NO_PARAMETER).then_some(number)
    }

    /// Takes a controller. Returns the parameter that it sets and its position, once that is complete.
    fn take(&mut self, controller: u8, data: u8) -> Option<(u16, f64)> {
        match controller {
            NRPN_COARSE => self.select(|it| it.coarse = Some(data)),
            NRPN_FINE => self.select(|it| it.fine = Some(data)),
            // From now on a registered parameter is set, such as the range of the pitch bend.
            RPN_COARSE | RPN_FINE => *self = Self::default(),
            DATA_ENTRY => {
                let number = self.number()?;
                self.value = Some(data);
                // Many senders do not send the fine part.
                return (!self.is_fine).then(|| (number, f64::from(data) / 127.0));
            }
            DATA_ENTRY_FINE => {
                let (number, coarse) = (self.number()?, self.value?);
                self.is_fine = true;
                return Some((number, fourteen(coarse, data)));
            }
            _ => {}
        }
        None
    }

    /// Takes a part of the number. The value of another parameter is discarded.
    fn select(&mut self, part: impl FnOnce(&mut Self)) {
        let before = self.number();
        part(self);
        if self.number() != before {
            (self.value, self.is_fine) = (None, false);
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct CoarseValue {
    value: u8,
    at: Instant,
    /// A fine part has followed an earlier one.
    is_pair: bool,
}

impl MidiDecoder {
    /// Decodes bytes that were received at `now`. They may start or end within a message.
    pub fn feed(&mut self, bytes: &[u8], now: Instant, events: &mut Vec<ControlEvent>) {
        for byte in bytes {
            match *byte {
                REAL_TIME.. => {}
                SYSTEM.. => (self.status, self.first) = (0, None),
                status @ 0x80.. => (self.status, self.first) = (status, None),
                data => self.data(data, now, events),
            }
        }
    }

    fn data(&mut self, data: u8, now: Instant, events: &mut Vec<ControlEvent>) {
        let (kind, channel) = (self.status & 0xf0, self.status & 0x0f);
        if matches!(kind, 0 | PROGRAM_CHANGE | CHANNEL_PRESSURE) {
            return;
        }
        let Some(first) = self.first.take() else {
            self.first = Some(data);
            return;
        };
        let mut add = |source, value| events.push(ControlEvent { source, value });
        let seventh = f64::from(data) / 127.0;
        match kind {
            NOTE_ON => add(ControlAddress::Note { channel, key: first }, seventh),
            NOTE_OFF => add(ControlAddress::Note { channel, key: first }, 0.0),
            PITCH_BEND => add(ControlAddress::PitchBend { channel }, bend(first, data)),
            CONTROL_CHANGE => {
                add(ControlAddress::ControlChange { channel, number: first }, seventh);
                if let Some((number, value)) = self.parameters[usize::from(channel)].take(first, data) {
                    add(ControlAddress::Nrpn { channel, number }, value);
                } else if let Some(value) = self.pair(channel, first, data, now) {
                    add(ControlAddress::ControlChange14 { channel, number: first - 32 }, value);
                }
            }
            KEY_PRESSURE.. | 0..KEY_PRESSURE => {}
        }
    }

    /// Takes a part of a 14-bit controller. Returns its position once it is complete.
    fn pair(&mut self, channel: u8, number: u8, value: u8, now: Instant) -> Option<f64> {
        let of_channel = &mut self.coarse[usize::from(channel)];
        match number {
            0..32 => {
                let coarse = &mut of_channel[usize::from(number)];
                let is_pair = coarse.is_some_and(|before| before.is_pair);
                *coarse = Some(CoarseValue { value, at: now, is_pair });
                None
            }
            32..64 => {
                let coarse = of_channel[usize::from(number - 32)].as_mut()?;
                coarse.is_pair |= now.saturating_duration_since(coarse.at) <= PAIR;
                coarse.is_pair.then(|| fourteen(coarse.value, value))
            }
            _ => None,
        }
    }
}

/// Returns the position of two parts of 7 bits.
fn fourteen(coarse: u8, fine: u8) -> f64 {
    f64::from((u16::from(coarse) << 7) | u16::from(fine)) / 16_383.0
}

/// Returns the position of a pitch bend: 0 at one end, 1 at the other, and exactly a half at rest (8192), which is not
/// the middle of 0 to 16,383.
fn bend(fine: u8, coarse: u8) -> f64 {
    let whole = f64::from((u16::from(coarse) << 7) | u16::from(fine));
    if whole <= 8192.0 { whole / 16_384.0 } else { 0.5 + (whole - 8192.0) / 16_382.0 }
}
