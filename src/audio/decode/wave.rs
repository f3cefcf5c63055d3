//! WAV files, found by their chunks (Microsoft, Multimedia Programming Interface and Data Specifications 1.0, 1991; RF64 and
//! BW64: EBU Tech 3306, ITU-R BS.2088; RIFX is the same with the most significant byte first).
//!
//! Browsers and ffmpeg play a file whose sizes are wrong, as a recorder leaves it that was cut off. So this reader does not
//! use the size of the whole, ends the sound where the file ends, and takes a size of zero as "up to the end", as ffmpeg's
//! `libavformat/wavdec.c` does. Lists of titles and the like are not read, so they cannot be damaged.

use super::AudioError;
use std::ops::Range;

/// The bytes of a WAV file that make its sound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Wave {
    pub format: Format,
    /// The format chunk, as it is in the file.
    pub header: Range<usize>,
    pub data: Range<usize>,
    /// Numbers have their most significant byte first.
    pub is_big: bool,
}

/// The content of a format chunk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Format {
    /// The number of the codec (`wFormatTag`); of an extensible format that of its subformat.
    pub tag: u16,
    pub channels: usize,
    /// Samples a second.
    pub rate: u32,
    /// Bytes of a frame, as the file says.
    pub align: usize,
    /// Bits of a sample, as the file says.
    pub bits: u32,
}

/// A reader of numbers in the order of a file.
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

/// Returns the sound of a WAV file; `None` for a file of another kind.
pub(super) fn find(file: &[u8]) -> Option<Result<Wave, AudioError>> {
    let is_big = match file.get(..4)? {
        b"RIFF" | b"RF64" | b"BW64" => false,
        b"RIFX" => true,
        _ => return None,
    };
    (file.get(8..12)? == b"WAVE").then(|| chunks(file, is_big))
}

fn chunks(file: &[u8], is_big: bool) -> Result<Wave, AudioError> {
    /// Bytes of the name and the size of a chunk.
    const HEAD: usize = 8;
    let numbers = Numbers { file, is_big };
    let damaged = |reason: &str| AudioError::Damaged(reason.into());
    let (mut format, mut long_data, mut at) = (None, None, 12);
    while let (Some(name), Some(size)) = (file.get(at..at + 4), numbers.u32(at + 4)) {
        let start = at + HEAD;
        match name {
            // The size of the data, where 32 bits are too few.
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

/// Returns where the chunk after another starts. A chunk of an odd size is followed by a byte of padding, which some programs
/// leave out.
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
    // A subformat's identifier begins with the number of the codec, in 32 bits.
    let tag = if tag == EXTENSIBLE && size >= 40 { numbers.u32(at + 24).ok_or_else(damaged)? as u16 } else { tag };
    Ok(Format { tag, channels: channels.into(), rate, align: align.into(), bits: bits.into() })
}

impl Wave {
    /// Returns the same sound as a file with right sizes and nothing else, for a reader that insists on them.
    pub fn plain(&self, file: &[u8]) -> Vec<u8> {
        let (header, data) = (&file[self.header.clone()], &file[self.data.clone()]);
        let chunk = |name: &[u8; 4], bytes: &[u8]| {
            let padding = if bytes.len() % 2 == 1 { &[0][..] } else { &[] };
            [name, &(bytes.len() as u32).to_le_bytes()[..], bytes, padding].concat()
        };
        let chunks = [b"WAVE".to_vec(), chunk(b"fmt ", header), chunk(b"data", data)].concat();
        chunk(b"RIFF", &chunks)
    }
}
