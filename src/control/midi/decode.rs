//! The bytes of MIDI 1.0 to events.
//!
//! Status bytes, running status and system messages are those of the "MIDI 1.0 Detailed Specification" (MIDI Manufacturers
//! Association, 4.2); controllers 0 to 31 are the coarse and 32 to 63 the fine parts of 14-bit controllers there.

use crate::ControlEvent;
use eddy_project::ControlAddress;
use std::time::{Duration, Instant};

/// The fine part of a 14-bit controller follows the coarse one within this.
const PAIR: Duration = Duration::from_millis(50);

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
                if let Some(value) = self.pair(channel, first, data, now) {
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
                let whole = (u16::from(coarse.value) << 7) | u16::from(value);
                coarse.is_pair.then(|| f64::from(whole) / 16_383.0)
            }
            _ => None,
        }
    }
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
