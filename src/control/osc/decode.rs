//! Decodes the bytes of a packet to events.

use super::pattern::{Pattern, is_pattern};
use crate::ControlEvent;
use eddy_project::{ControlAddress, is_osc_path, limits};
use rosc::{OscPacket, OscType};

/// The first bytes of a bundle, before its time tag of 8 bytes.
const BUNDLE: &[u8] = b"#bundle\0";
const TIME_TAG: usize = 8;

/// The error of an unreadable packet. Events before the damage are discarded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OscError {
    /// It is not a packet of OSC 1.0, or is cut off.
    #[error("the packet is damaged")]
    Damaged,
    /// It is longer than [`limits::OSC_PACKET`].
    #[error("the packet is larger than {}", limits::OSC_PACKET)]
    Large,
    /// Its bundles contain more than [`limits::OSC_MESSAGES`] messages.
    #[error("the packet has more than {} messages", limits::OSC_MESSAGES)]
    ManyMessages,
    /// Its bundles are nested deeper than [`limits::OSC_DEPTH`].
    #[error("bundles are nested more than {} deep", limits::OSC_DEPTH)]
    Deep,
}

/// Returns an event for each number in a packet, in order. Time tags are ignored: everything happens now.
pub fn decode(packet: &[u8]) -> Result<Vec<ControlEvent>, OscError> {
    if packet.len() as u64 > limits::OSC_PACKET.bytes {
        return Err(OscError::Large);
    }
    let mut events = Vec::new();
    let mut messages = 0;
    // The remaining parts, the next one last, each with the number of bundles around it.
    let mut left = vec![(packet, 0)];
    while let Some((part, depth)) = left.pop() {
        let Some(contents) = part.strip_prefix(BUNDLE) else {
            messages += 1;
            if messages > limits::OSC_MESSAGES {
                return Err(OscError::ManyMessages);
            }
            message(part, &mut events)?;
            continue;
        };
        if depth == limits::OSC_DEPTH {
            return Err(OscError::Deep);
        }
        let mut rest = contents.get(TIME_TAG..).ok_or(OscError::Damaged)?;
        let first = left.len();
        while !rest.is_empty() {
            let (size, tail) = rest.split_first_chunk::<4>().ok_or(OscError::Damaged)?;
            let size = u32::from_be_bytes(*size) as usize;
            let (element, tail) = tail.split_at_checked(size).ok_or(OscError::Damaged)?;
            left.push((element, depth + 1));
            rest = tail;
            if left.len() > limits::OSC_MESSAGES {
                return Err(OscError::ManyMessages);
            }
        }
        left[first..].reverse();
    }
    Ok(events)
}

/// Adds the numbers of a message. A message whose address is neither valid for a control nor a pattern is skipped.
fn message(bytes: &[u8], events: &mut Vec<ControlEvent>) -> Result<(), OscError> {
    let address = bytes.split(|byte| *byte == 0).next().unwrap_or_default();
    if address.first() != Some(&b'/') {
        return Err(OscError::Damaged);
    }
    // The type tags start at the next multiple of four bytes after the address and its zero.
    let tags = bytes.get((address.len() / 4 + 1) * 4..).unwrap_or_default();
    let tags = tags.split(|byte| *byte == 0).next().unwrap_or_default();
    if tags.len() > limits::OSC_ARGUMENTS + 1 {
        return Err(OscError::Damaged);
    }
    let Ok((_, OscPacket::Message(message))) = rosc::decoder::decode_udp(bytes) else { return Err(OscError::Damaged) };
    let is_pattern = || is_pattern(&message.addr) && Pattern::parse(&message.addr).is_some();
    if !is_osc_path(&message.addr) && !is_pattern() {
        return Ok(());
    }
    let numbers = message.args.iter().enumerate().filter_map(|(argument, value)| Some((argument, number(value)?)));
    events.extend(numbers.map(|(argument, value)| ControlEvent {
        source: ControlAddress::Osc { path: message.addr.clone(), argument },
        value,
    }));
    Ok(())
}

/// Returns the number of an argument, if it is one.
fn number(value: &OscType) -> Option<f64> {
    let number = match value {
        OscType::Int(n) => f64::from(*n),
        OscType::Long(n) => *n as f64,
        OscType::Float(x) => f64::from(*x),
        OscType::Double(x) => *x,
        OscType::Bool(on) => f64::from(u8::from(*on)),
        // "Infinitum", which OSC 1.1 calls an impulse: a button is pressed.
        OscType::Inf => 1.0,
        _ => return None,
    };
    number.is_finite().then_some(number)
}
