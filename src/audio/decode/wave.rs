//! WAV files, parsed by chunks (Microsoft, Multimedia Programming Interface and Data Specifications 1.0, 1991; RF64 and
//! BW64: EBU Tech 3306, ITU-R BS.2088; RIFX is the same with the most significant byte first).
//!
//! Browsers and ffmpeg play a file with wrong sizes, as an interrupted recorder leaves it. So this reader ignores the
//! size of the whole, ends the sound at the end of the file, and treats a size of zero as "up to the end", like
//! ffmpeg's `libavformat/wavdec.c`. Lists of titles and other metadata are not read, so damage there is harmless.

use super::AudioError;
use std::ops::Range;

/// The parts of a WAV file that define its sound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Wave {
    pub format: Format,
    /// The format chunk, as stored in the file.
    pub header: Range<usize>,
    pub data: Range<usize>,
    /// Numbers have their most significant byte first.
    pub is_big: bool,
}

/// The content of a format chunk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Format {
    /// The number of the codec (`wFormatTag`); for an extensible format that of its subformat.
    pub tag: u16,
    pub channels: usize,
    /// Samples per second.
    pub rate: u32,
    /// Bytes per frame, according to the file.
    pub align: usize,
    /// Bits per sample, according to the file.
    pub bits: u32,
}

/// A reader of numbers in the file's byte order.
#[derive(Clone, Copy)]
struct Numbers<'f> {
    file: &'f [u8],
    is_big: bool,
}

impl Numbers<'_> {
    fn bytes<const N: usize>(self, at: usize) -> Option<[u8; N]> {
        let bytes = self.file.get(at..at.checked_add(N)?)?;
        let mut bytes: [u8; N] = bytes.try_into().ok()?;
        if self.is_big {
            bytes.reverse();
        }
        Some(bytes)
    }

    fn u16(self, at: usize) -> Option<u16> {
        self.bytes(at).map(u16::from_le_bytes)
    }

    fn u32(self, at: usize) -> Option<u32> {
        self.bytes(at).map(u32::from_le_bytes)
    }

    fn u64(self, at: usize) -> Option<u64> {
        self.bytes(at).map(u64::from_le_bytes)
    }
}

/// Returns the sound of a WAV file; `None` for a file of another format.
pub(super) fn find(file: &[u8]) -> Option<Result<Wave, AudioError>> {
    let is_big = match file.get(..4)? {
        b"RIFF" | b"RF64" | b"BW64" => false,
        b"RIFX" => true,
        _ => return None,
    };
    (file.get(8..12)? == b"WAVE").then(|| chunks(file, is_big))
}

fn chunks(file: &[u8], is_big: bool) -> Result<Wave, AudioError> {
    /// The bytes of the name and the size of a chunk.
    const HEAD: usize = 8;
    let numbers = Numbers { file, is_big };
    let damaged = |reason: &str| AudioError::Damaged(reason.into());
    let (mut format, mut long_data, mut at) = (None, None, 12);
    while let (Some(name), Some(size)) = (file.get(at..at + 4), numbers.u32(at + 4)) {
        let start = at + HEAD;
        match name {
            // The size of the data if it does not fit into 32 bits.
            b"ds64" => long_data = numbers.u64(start + 8),
            b"fmt " => format = Some((read_format(numbers, start, size)?, start..end(file, start, u64::from(size)))),
            b"data" => {
                let size = match (size, long_data) {
                    (u32::MAX, Some(long)) => long,
                    (0 | u32::MAX, _) => u64::MAX,
                    (size, _) => u64::from(size),
                };
                let size = if size == 0 { u64::MAX } else { size };
                let (format, header) = format.ok_or_else(|| damaged("it has no format chunk before its sound"))?;
                return Ok(Wave { format, header, data: start..end(file, start, size), is_big });
            }
            _ => {}
        }
        at = next_chunk(file, start, size);
    }
    Err(match format {
        Some(_) => AudioError::NoTrack,
        None => damaged("it ends before its format chunk"),
    })
}

fn end(file: &[u8], start: usize, size: u64) -> usize {
    let left = file.len() - start;
    start + usize::try_from(size).map_or(left, |size| size.min(left))
}

/// Returns the start of the following chunk. A chunk of an odd size is followed by a byte of padding, which some
/// programs omit.
fn next_chunk(file: &[u8], start: usize, size: u32) -> usize {
    let end = start.saturating_add(size as usize);
    let padded = end.saturating_add(size as usize % 2);
    let is_name = |at: usize| {
        file.get(at..)
            .and_then(|rest| rest.first_chunk::<4>())
            .is_some_and(|name| name.iter().all(|b| (32..127).contains(b)))
    };
    if is_name(padded) || !is_name(end) { padded } else { end }
}

fn read_format(numbers: Numbers<'_>, at: usize, size: u32) -> Result<Format, AudioError> {
    const EXTENSIBLE: u16 = 0xfffe;
    let damaged = || AudioError::Damaged("its format chunk is truncated".into());
    let (tag, channels) = (numbers.u16(at).ok_or_else(damaged)?, numbers.u16(at + 2).ok_or_else(damaged)?);
    let (rate, align) = (numbers.u32(at + 4).ok_or_else(damaged)?, numbers.u16(at + 12).ok_or_else(damaged)?);
    let bits = numbers.u16(at + 14).filter(|_| size >= 16).unwrap_or(8);
    // The identifier of a subformat starts with the number of the codec, in 32 bits.
    let tag = if tag == EXTENSIBLE && size >= 40 { numbers.u32(at + 24).ok_or_else(damaged)? as u16 } else { tag };
    Ok(Format { tag, channels: channels.into(), rate, align: align.into(), bits: bits.into() })
}

impl Wave {
    /// Returns the same sound as a minimal file with correct sizes, for a reader that depends on them.
    pub(super) fn plain(&self, file: &[u8]) -> Vec<u8> {
        let (header, data) = (&file[self.header.clone()], &file[self.data.clone()]);
        let chunk = |name: &[u8; 4], bytes: &[u8]| {
            let padding = if bytes.len() % 2 == 1 { &[0][..] } else { &[] };
            [name, &(bytes.len() as u32).to_le_bytes()[..], bytes, padding].concat()
        };
        let chunks = [b"WAVE".to_vec(), chunk(b"fmt ", header), chunk(b"data", data)].concat();
        chunk(b"RIFF", &chunks)
    }
}
