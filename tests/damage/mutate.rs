//! Mutations that damage a file.

/// Reproducible numbers from a seed (xorshift64*).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random((seed + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// Returns a number from 0 to `end` exclusive; 0 for an `end` of 0.
    pub(crate) fn below(&mut self, end: usize) -> usize {
        (self.next() >> 33) as usize % end.max(1)
    }

    /// Returns a part of `length` bytes, usually a short one.
    fn range(&mut self, length: usize) -> std::ops::Range<usize> {
        let from = self.below(length + 1);
        let max_length = if self.below(3) == 0 { length - from } else { (length - from).min(64) };
        from..from + self.below(max_length + 1)
    }
}

const LENGTHS: [u32; 14] =
    [0, 1, 3, 4, 7, 77, 255, 256, 0x7fff, 0xffff, 0x10_0000, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff];
const NUMBERS: [&str; 20] = [
    "0",
    "-1",
    "1",
    "77",
    "255",
    "256",
    "65535",
    "65536",
    "1000000",
    "8388609",
    "2147483647",
    "3000000000",
    "4294967295",
    "9223372036854775807",
    "18446744073709551616",
    "1e9",
    "1e39",
    "1e309",
    "-0",
    "0.5",
];
const WORDS: [&str; 14] =
    ["[", "]", "{", "}", "\"", ",", ":", "null", "true", "\n", "\\u0000", "../", "builtin:cube", "é"];

/// Damages the bytes in one way; `other` is another file.
pub(crate) fn mutate(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    let length = bytes.len();
    match random.below(9) {
        0 => {
            for _ in 0..1 + random.below(8) {
                let at = random.below(length);
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1 << random.below(8);
                }
            }
        }
        1 => bytes.truncate(random.below(length + 1)),
        2 => drop(bytes.drain(random.range(length))),
        3 => {
            let piece = bytes[random.range(length)].to_vec();
            let at = random.below(length + 1);
            for _ in 0..1 + random.below(3) {
                bytes.splice(at..at, piece.iter().copied());
            }
        }
        4 | 5 => number(bytes, random),
        6 => {
            // Bytes that may be a length or a count: mostly in the headers.
            let value = LENGTHS[random.below(LENGTHS.len())];
            let at = if random.below(2) == 0 { random.below(length.min(64)) } else { random.below(length) };
            let width = [1, 2, 4][random.below(3)];
            let value = if random.below(2) == 0 { value.to_le_bytes() } else { value.to_be_bytes() };
            bytes.iter_mut().skip(at).zip(&value[..width]).for_each(|(byte, new)| *byte = *new);
        }
        7 => {
            let piece = &other[random.range(other.len())];
            let range = random.range(length);
            bytes.splice(range, piece.iter().copied());
        }
        _ => {
            let word = WORDS[random.below(WORDS.len())];
            let at = random.below(length + 1);
            bytes.splice(at..at, word.bytes());
        }
    }
}

/// Replaces a number in a text, or inserts a digit if there is none.
fn number(bytes: &mut Vec<u8>, random: &mut Random) {
    let is_start = |n: &usize| bytes[*n].is_ascii_digit() && (*n == 0 || !bytes[*n - 1].is_ascii_digit());
    let starts: Vec<usize> = (0..bytes.len()).filter(is_start).collect();
    let Some(&from) = starts.get(random.below(starts.len())) else { return };
    let to = from + bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    bytes.splice(from..to, NUMBERS[random.below(NUMBERS.len())].bytes());
}

/// Corrects the checksums of a PNG's chunks, as far as there are chunks.
pub(crate) fn fix_png_checksums(bytes: &mut [u8]) {
    if !bytes.starts_with(b"\x89PNG") {
        return;
    }
    let mut at = 8;
    while let Some(length) = bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map(u32::from_be_bytes) {
        let end = at + 8 + length as usize;
        let Some(chunk) = bytes.get(at + 4..end) else { return };
        let sum = !chunk.iter().fold(!0u32, |crc, b| {
            (0..8).fold(crc ^ u32::from(*b), |c, _| if c & 1 == 1 { 0xedb8_8320 ^ (c >> 1) } else { c >> 1 })
        });
        match bytes.get_mut(end..end + 4) {
            Some(place) => place.copy_from_slice(&sum.to_be_bytes()),
            None => return,
        }
        at = end + 4;
    }
}
