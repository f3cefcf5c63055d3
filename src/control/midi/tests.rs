//! Bytes of MIDI devices: whole messages, parts, and random bytes.

use super::MidiDecoder;
use eddy_project::ControlAddress;
use std::time::{Duration, Instant};

fn read(bytes: &[u8]) -> Vec<(String, f64)> {
    let mut events = Vec::new();
    MidiDecoder::default().feed(bytes, Instant::now(), &mut events);
    events.into_iter().map(|event| (event.source.to_string(), event.value)).collect()
}

fn assert_events(bytes: &[u8], wanted: &[(&str, f64)]) {
    let wanted: Vec<(String, f64)> = wanted.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    assert_eq!(read(bytes), wanted, "{bytes:x?}");
}

#[test]
fn controls_notes_and_bends_are_positions() {
    assert_events(&[0xb0, 70, 127], &[("midi 1 cc 70", 1.0)]);
    assert_events(&[0xbf, 70, 0], &[("midi 16 cc 70", 0.0)]);
    assert_events(
        &[0x90, 60, 127, 0x80, 60, 64, 0x90, 60, 0],
        &[("midi 1 note 60", 1.0), ("midi 1 note 60", 0.0), ("midi 1 note 60", 0.0)],
    );
    assert_events(&[0xe1, 0, 64], &[("midi 2 bend", 0.5)]);
    assert_events(&[0xe0, 0, 0, 0xe0, 127, 127], &[("midi 1 bend", 0.0), ("midi 1 bend", 1.0)]);
    assert_events(&[0xc0, 5, 0xd0, 90, 0xa0, 60, 90], &[]);
}

#[test]
fn running_status_and_interleaved_messages_are_decoded() {
    assert_events(&[0xb0, 70, 127, 71, 0], &[("midi 1 cc 70", 1.0), ("midi 1 cc 71", 0.0)]);
    assert_events(&[0xb0, 70, 0xf8, 127], &[("midi 1 cc 70", 1.0)]);
    // A system exclusive message, which ends running status.
    assert_events(&[0xb0, 0xf0, 1, 2, 3, 0xf7, 70, 127, 0xb0, 70, 127], &[("midi 1 cc 70", 1.0)]);
    assert_events(&[70, 127], &[]);
    // A message in two parts.
    let (mut decoder, mut events) = (MidiDecoder::default(), Vec::new());
    for part in [&[0xb0_u8][..], &[70], &[127]] {
        decoder.feed(part, Instant::now(), &mut events);
    }
    assert_eq!(events.len(), 1);
}

#[test]
fn coarse_and_fine_controllers_form_a_pair_if_sent_together() {
    let start = Instant::now();
    let (mut decoder, mut events) = (MidiDecoder::default(), Vec::new());
    let mut send = |millis: u64, number: u8, value: u8| {
        decoder.feed(&[0xb0, number, value], start + Duration::from_millis(millis), &mut events);
        let found = std::mem::take(&mut events);
        found.into_iter().find(|event| matches!(event.source, ControlAddress::ControlChange14 { .. })).map(|e| e.value)
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

/// Returns the parameters that `bytes` set, without the events of the controllers themselves.
fn parameters(bytes: &[u8]) -> Vec<(String, f64)> {
    read(bytes).into_iter().filter(|(name, _)| name.contains("nrpn")).collect()
}

#[test]
fn parameters_are_selected_by_two_controllers_and_set_by_one_or_two() {
    let fine = |coarse: u16, fine: u16| f64::from(coarse * 128 + fine) / 16_383.0;
    let of = |values: &[f64]| values.iter().map(|value| ("midi 1 nrpn 300".to_owned(), *value)).collect::<Vec<_>>();
    // 300 is 2 * 128 + 44.
    let select = [0xb0, 99, 2, 98, 44];
    let cases: [(&[u8], &[f64]); 8] = [
        (&[], &[]),
        (&[6, 127], &[1.0]),
        // Coarse and fine: the first coarse part may be the whole value, and later ones wait.
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
    // Each channel has its own selection, and the controllers themselves still make events.
    assert_eq!(parameters(&[0xb0, 99, 0, 98, 1, 0xb1, 6, 1]), []);
    assert_events(&[0xb0, 6, 127], &[("midi 1 cc 6", 1.0)]);
}

#[test]
fn random_bytes_decode_to_valid_positions_or_nothing() {
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
