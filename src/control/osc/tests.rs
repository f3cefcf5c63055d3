//! Packets that are valid, nested, too large and damaged.

use super::{OscError, decode};
use crate::ControlEvent;
use eddy_project::limits;
use rosc::{OscBundle, OscMessage, OscPacket, OscTime, OscType, encoder};

fn packet(addr: &str, args: Vec<OscType>) -> OscPacket {
    OscPacket::Message(OscMessage { addr: addr.into(), args })
}

fn bundle(content: Vec<OscPacket>) -> OscPacket {
    OscPacket::Bundle(OscBundle { timetag: OscTime { seconds: 0, fractional: 1 }, content })
}

fn bytes(packet: &OscPacket) -> Vec<u8> {
    encoder::encode(packet).unwrap()
}

fn shown(events: &[ControlEvent]) -> Vec<(String, f64)> {
    events.iter().map(|event| (event.source.to_string(), event.value)).collect()
}

#[test]
fn numbers_of_every_type_are_events() {
    let args = vec![
        OscType::Float(0.25),
        OscType::Int(-3),
        OscType::String("text".into()),
        OscType::Double(1e-9),
        OscType::Long(1 << 40),
        OscType::Bool(true),
        OscType::Bool(false),
        OscType::Nil,
        OscType::Inf,
        OscType::Float(f32::NAN),
    ];
    let read = decode(&bytes(&packet("/1/all", args))).unwrap();
    let wanted =
        [("", 0.25), (" 2", -3.0), (" 4", 1e-9), (" 5", 1_099_511_627_776.0), (" 6", 1.0), (" 7", 0.0), (" 9", 1.0)];
    assert_eq!(shown(&read), wanted.map(|(argument, value)| (format!("/1/all{argument}"), value)));
    assert_eq!(decode(&bytes(&packet("/1", vec![]))), Ok(vec![]), "a page was chosen");
    let of_pattern = |pattern: &str| shown(&decode(&bytes(&packet(pattern, vec![OscType::Int(1)]))).unwrap());
    assert_eq!(of_pattern("/1/*"), [("/1/*".to_owned(), 1.0)]);
    assert_eq!([of_pattern("/1/[a"), of_pattern("/1/a b")], [vec![], vec![]], "neither a pattern nor an address");
}

/// Bytes written by hand, so that encoder and decoder of one library do not hide each other's errors: the example of
/// OSC 1.0.
#[test]
fn the_example_of_the_specification_is_read() {
    let read = decode(b"/oscillator/4/frequency\0,f\0\0\x43\xdc\0\0").unwrap();
    assert_eq!(shown(&read), [("/oscillator/4/frequency".to_owned(), 440.0)]);
}

#[test]
fn bundles_are_read_in_order_and_no_deeper_than_the_limit() {
    let one = |n: i32| packet("/a", vec![OscType::Int(n)]);
    let read = decode(&bytes(&bundle(vec![one(1), bundle(vec![one(2), one(3)]), one(4)]))).unwrap();
    assert_eq!(read.iter().map(|event| event.value).collect::<Vec<_>>(), [1.0, 2.0, 3.0, 4.0]);
    let nested = |depth: usize| (0..depth).fold(one(1), |inner, _| bundle(vec![inner]));
    assert_eq!(decode(&bytes(&nested(limits::OSC_DEPTH))).map(|events| events.len()), Ok(1));
    assert_eq!(decode(&bytes(&nested(limits::OSC_DEPTH + 1))), Err(OscError::Deep));
    let many = |count: usize| bytes(&bundle((0..count).map(|_| one(1)).collect()));
    assert_eq!(decode(&many(limits::OSC_MESSAGES)).map(|events| events.len()), Ok(limits::OSC_MESSAGES));
    assert_eq!(decode(&many(limits::OSC_MESSAGES + 1)), Err(OscError::ManyMessages));
    assert_eq!(decode(&vec![b'/'; limits::OSC_PACKET.bytes as usize + 1]), Err(OscError::Large));
    // Nested arrays, as deep as a packet has room for.
    let mut deep = b"/a\0\0,".to_vec();
    deep.extend([b'['; 30_000].iter().chain(&[b']'; 30_000]));
    deep.extend([0; 4]);
    assert_eq!(decode(&deep), Err(OscError::Damaged));
}

/// 5,000 packets with bytes that were changed, removed and repeated.
#[test]
fn damaged_packets_are_rejected_or_decoded_without_a_panic() {
    let args = vec![
        OscType::Float(0.5),
        OscType::Int(1),
        OscType::String("s".into()),
        OscType::Blob(vec![1, 2, 3]),
        OscType::Bool(true),
    ];
    let whole = bytes(&bundle(vec![packet("/1/fader1", args.clone()), bundle(vec![packet("/xy", args)])]));
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    let (mut read, mut refused) = (0, 0);
    for _ in 0..5_000 {
        let mut damaged = whole.clone();
        for _ in 0..=random(4) {
            let at = random(damaged.len());
            match random(5) {
                0 => damaged[at] = random(256) as u8,
                1 => damaged[at] ^= 1 << random(8),
                2 => damaged.truncate(at.max(1)),
                3 => drop(damaged.remove(at).min(damaged.len() as u8)),
                _ => damaged.extend_from_within(at..),
            }
            if damaged.is_empty() {
                damaged.push(0);
            }
        }
        match decode(&damaged) {
            Ok(events) => {
                assert!(events.len() <= limits::OSC_MESSAGES * limits::OSC_ARGUMENTS);
                assert!(events.iter().all(|event| event.value.is_finite()));
                read += 1;
            }
            Err(_) => refused += 1,
        }
    }
    assert!(read > 100 && refused > 1_000, "{read} were read, {refused} refused");
}
