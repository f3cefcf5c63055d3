//! The bytes of MIDI 1.0 to events.
//!
//! Status bytes, running status and system messages are those of the "MIDI 1.0 Detailed Specification" (MIDI Manufacturers
//! Association, 4.2); controllers 0 to 31 are the coarse and 32 to 63 the fine parts of 14-bit controllers there. Controllers 99
//! and 98 select a non-registered parameter, 101 and 100 a registered one, and 6 with 38 ("data entry") set its value.

use crate::ControlEvent;
use eddy_project::ControlAddress;
use std::time::{Duration, Instant};

/// The fine part of a 14-bit controller follows the coarse one within this.
const PAIR: Duration = Duration::from_millis(50);

/// Controllers that set the parameter that is selected, coarse and fine.
const DATA_ENTRY: u8 = 6;
const DATA_ENTRY_FINE: u8 = 38;
/// Controllers that select a parameter.
const NRPN_FINE: u8 = 98;
const NRPN_COARSE: u8 = 99;
const RPN_FINE: u8 = 100;
const RPN_COARSE: u8 = 101;
/// The parameter number that stands for none: 127 in both parts.
const NO_PARAMETER: u16 = 16_383;

const NOTE_OFF: u8 = 0x80;
const NOTE_ON: u8 = 0x90;
const KEY_PRESSURE: u8 = 0xa0;
const CONTROL_CHANGE: u8 = 0xb0;
const PROGRAM_CHANGE: u8 = 0xc0;
const CHANNEL_PRESSURE: u8 = 0xd0;
const PITCH_BEND: u8 = 0xe0;
const SYSTEM: u8 = 0xf0;
/// From here on bytes may stand within another message.
const REAL_TIME: u8 = 0xf8;

/// Reads what one device sends.
#[derive(Debug, Default)]
pub struct MidiDecoder {
    /// The status of the message under way; 0: none, and data bytes mean nothing.
    status: u8,
    first: Option<u8>,
    /// The newest coarse part of each channel's controllers 0 to 31.
    coarse: [[Option<Coarse>; 32]; 16],
    /// The parameter that is selected on each channel.
    parameters: [Parameter; 16],
}

/// The non-registered parameter that is selected on a channel, as far as its number has come.
#[derive(Clone, Copy, Debug, Default)]
struct Parameter {
    coarse: Option<u8>,
    fine: Option<u8>,
    /// The coarse part of its newest value.
    value: Option<u8>,
    /// A fine part of a value has come: the next coarse part waits for its own.
    is_fine: bool,
}

impl Parameter {
    fn number(&self) -> Option<u16> {
        let number = (u16::from(self.coarse?) << 7) | u16::from(self.fine?);
        (number != NO_PARAMETER).then_some(number)
    }

    /// Takes a controller. Returns the parameter that it sets with its position, once that is known.
    fn take(&mut self, controller: u8, data: u8) -> Option<(u16, f64)> {
        match controller {
            NRPN_COARSE => self.select(|it| it.coarse = Some(data)),
            NRPN_FINE => self.select(|it| it.fine = Some(data)),
            // What is set from now on is a registered parameter, such as the range of the pitch bend.
            RPN_COARSE | RPN_FINE => *self = Self::default(),
            DATA_ENTRY => {
                let number = self.number()?;
                self.value = Some(data);
                // Many senders have no fine part.
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

    /// Takes a part of the number. The value of another parameter is forgotten.
    fn select(&mut self, part: impl FnOnce(&mut Self)) {
        let before = self.number();
        part(self);
        if self.number() != before {
            (self.value, self.is_fine) = (None, false);
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Coarse {
    value: u8,
    at: Instant,
    /// A fine part has followed one before.
    is_pair: bool,
}

impl MidiDecoder {
    /// Reads bytes that came at a moment. They may begin or end within a message.
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

    /// Notes a part of a 14-bit controller. Returns its position once it is whole.
    fn pair(&mut self, channel: u8, number: u8, value: u8, now: Instant) -> Option<f64> {
        let of_channel = &mut self.coarse[usize::from(channel)];
        match number {
            0..32 => {
                let coarse = &mut of_channel[usize::from(number)];
                let is_pair = coarse.is_some_and(|before| before.is_pair);
                *coarse = Some(Coarse { value, at: now, is_pair });
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

/// Returns the position that two parts of 7 bits say.
fn fourteen(coarse: u8, fine: u8) -> f64 {
    f64::from((u16::from(coarse) << 7) | u16::from(fine)) / 16_383.0
}

/// Returns the position of a pitch bend: 0 at one end, 1 at the other, and exactly a half at rest (8192), which is not the middle
/// of 0 to 16,383.
fn bend(fine: u8, coarse: u8) -> f64 {
    let whole = f64::from((u16::from(coarse) << 7) | u16::from(fine));
    if whole <= 8192.0 { whole / 16_384.0 } else { 0.5 + (whole - 8192.0) / 16_382.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8]) -> Vec<(String, f64)> {
        let mut events = Vec::new();
        MidiDecoder::default().feed(bytes, Instant::now(), &mut events);
        events.into_iter().map(|event| (event.source.to_string(), event.value)).collect()
    }

    fn is(bytes: &[u8], wanted: &[(&str, f64)]) {
        let wanted: Vec<(String, f64)> = wanted.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        assert_eq!(read(bytes), wanted, "{bytes:x?}");
    }

    #[test]
    fn controls_notes_and_bends_are_positions() {
        is(&[0xb0, 70, 127], &[("midi 1 cc 70", 1.0)]);
        is(&[0xbf, 70, 0], &[("midi 16 cc 70", 0.0)]);
        is(
            &[0x90, 60, 127, 0x80, 60, 64, 0x90, 60, 0],
            &[("midi 1 note 60", 1.0), ("midi 1 note 60", 0.0), ("midi 1 note 60", 0.0)],
        );
        is(&[0xe1, 0, 64], &[("midi 2 bend", 0.5)]);
        is(&[0xe0, 0, 0, 0xe0, 127, 127], &[("midi 1 bend", 0.0), ("midi 1 bend", 1.0)]);
        is(&[0xc0, 5, 0xd0, 90, 0xa0, 60, 90], &[]);
    }

    #[test]
    fn running_status_and_what_stands_within_a_message_are_understood() {
        is(&[0xb0, 70, 127, 71, 0], &[("midi 1 cc 70", 1.0), ("midi 1 cc 71", 0.0)]);
        is(&[0xb0, 70, 0xf8, 127], &[("midi 1 cc 70", 1.0)]);
        // A system exclusive message, which ends running status.
        is(&[0xb0, 0xf0, 1, 2, 3, 0xf7, 70, 127, 0xb0, 70, 127], &[("midi 1 cc 70", 1.0)]);
        is(&[70, 127], &[]);
        // A message in two parts.
        let (mut decoder, mut events) = (MidiDecoder::default(), Vec::new());
        for part in [&[0xb0_u8][..], &[70], &[127]] {
            decoder.feed(part, Instant::now(), &mut events);
        }
        assert_eq!(events.len(), 1);
    }

    #[test]
    fn two_controllers_are_a_pair_where_one_follows_the_other_at_once() {
        let begin = Instant::now();
        let (mut decoder, mut events) = (MidiDecoder::default(), Vec::new());
        let mut send = |millis: u64, number: u8, value: u8| {
            decoder.feed(&[0xb0, number, value], begin + Duration::from_millis(millis), &mut events);
            let found = std::mem::take(&mut events);
            found
                .into_iter()
                .find(|event| matches!(event.source, ControlAddress::ControlChange14 { .. }))
                .map(|e| e.value)
        };
        assert_eq!(send(0, 39, 127), None, "nothing came before it");
        assert_eq!(send(0, 7, 127), None);
        assert_eq!(send(500, 39, 127), None, "another knob, half a second later");
        assert_eq!(send(600, 7, 127), None);
        assert_eq!(send(601, 39, 127), Some(1.0));
        assert_eq!(send(700, 7, 64), None, "its fine part comes");
        assert_eq!(send(701, 39, 0), Some(8192.0 / 16_383.0));
        assert_eq!(send(900, 39, 1), Some(8193.0 / 16_383.0), "the fine part alone");
        assert_eq!(send(901, 64, 1), None, "no part of a pair");
    }

    /// Returns the parameters that some bytes set, without the controllers by which they do.
    fn parameters(bytes: &[u8]) -> Vec<(String, f64)> {
        read(bytes).into_iter().filter(|(name, _)| name.contains("nrpn")).collect()
    }

    #[test]
    fn a_parameter_is_selected_by_two_controllers_and_set_by_one_or_two() {
        let fine = |coarse: u16, fine: u16| f64::from(coarse * 128 + fine) / 16_383.0;
        let of = |values: &[f64]| values.iter().map(|value| ("midi 1 nrpn 300".to_owned(), *value)).collect::<Vec<_>>();
        // 300 is 2 * 128 + 44.
        let select = [0xb0, 99, 2, 98, 44];
        let cases: [(&[u8], &[f64]); 8] = [
            (&[], &[]),
            (&[6, 127], &[1.0]),
            // Coarse and fine: the first coarse part may be all there is, and later ones wait.
            (&[6, 64, 38, 1], &[64.0 / 127.0, fine(64, 1)]),
            (&[6, 64, 38, 1, 6, 65, 38, 2], &[64.0 / 127.0, fine(64, 1), fine(65, 2)]),
            (&[38, 5], &[]),
            // The null parameter, and a registered one.
            (&[99, 127, 98, 127, 6, 1], &[]),
            (&[101, 0, 100, 0, 6, 2], &[]),
            // Selected again by both parts, as many senders do before each value.
            (&[99, 2, 98, 44, 6, 0], &[0.0]),
        ];
        for (rest, wanted) in cases {
            assert_eq!(parameters(&[&select[..], rest].concat()), of(wanted), "{rest:?}");
        }
        assert_eq!(parameters(&[0xb0, 6, 1, 99, 2, 6, 1]), [], "nothing is selected yet");
        let other = parameters(&[0xb0, 99, 2, 98, 44, 6, 1, 38, 1, 98, 45, 6, 127]);
        assert_eq!(other.last(), Some(&("midi 1 nrpn 301".to_owned(), 1.0)), "another parameter has no fine part yet");
        // Channels have a selection each, and the controllers themselves are still there.
        assert_eq!(parameters(&[0xb0, 99, 0, 98, 1, 0xb1, 6, 1]), []);
        is(&[0xb0, 6, 127], &[("midi 1 cc 6", 1.0)]);
    }

    #[test]
    fn any_bytes_give_positions_or_nothing() {
        let (mut decoder, mut events, mut state) = (MidiDecoder::default(), Vec::new(), 1_u32);
        for _ in 0..5_000 {
            let mut bytes = [0; 16];
            bytes.fill_with(|| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                (state >> 24) as u8
            });
            decoder.feed(&bytes, Instant::now(), &mut events);
        }
        assert!(events.len() > 1_000 && events.iter().all(|event| (0.0..=1.0).contains(&event.value)));
    }
}
