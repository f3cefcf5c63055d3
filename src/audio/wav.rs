//! WAV files: PCM, 16 bits, stereo (Microsoft, Multimedia Programming Interface and Data Specifications 1.0, 1991).

use crate::SAMPLE_RATE;

/// Returns a whole file of `frames`, left and right.
///
/// # Panics
/// Panics beyond 4 GiB, which is more than six hours.
pub fn wav(frames: &[[i16; 2]]) -> Vec<u8> {
    let data = u32::try_from(frames.len() * 4).expect("a WAV file holds at most 4 GiB");
    let mut file = Vec::with_capacity(44 + data as usize);
    file.extend(b"RIFF");
    file.extend((36 + data).to_le_bytes());
    file.extend(b"WAVEfmt ");
    file.extend(16u32.to_le_bytes());
    for field in [1u16, 2] {
        file.extend(field.to_le_bytes());
    }
    file.extend(SAMPLE_RATE.to_le_bytes());
    file.extend((4 * SAMPLE_RATE).to_le_bytes());
    for field in [4u16, 16] {
        file.extend(field.to_le_bytes());
    }
    file.extend(b"data");
    file.extend(data.to_le_bytes());
    file.extend(frames.iter().flatten().flat_map(|sample| sample.to_le_bytes()));
    file
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_its_header_and_its_samples() {
        let file = wav(&[[1, -1], [0x1234, -32768]]);
        assert_eq!(file.len(), 44 + 8);
        assert_eq!((&file[..4], &file[8..16], &file[36..40]), (&b"RIFF"[..], &b"WAVEfmt "[..], &b"data"[..]));
        let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap());
        assert_eq!([word(4), word(16), word(24), word(28), word(40)], [44, 16, 44_100, 176_400, 8]);
        assert_eq!(file[20..24], [1, 0, 2, 0], "PCM, two channels");
        assert_eq!(file[32..36], [4, 0, 16, 0], "bytes of a frame, bits of a sample");
        assert_eq!(file[44..], [1, 0, 0xff, 0xff, 0x34, 0x12, 0, 0x80]);
    }
}
