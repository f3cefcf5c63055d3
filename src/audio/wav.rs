//! WAV files: PCM, 16 bits, stereo (Microsoft, Multimedia Programming Interface and Data Specifications 1.0, 1991).

use crate::SAMPLE_RATE;

/// A whole file of `frames`, left and right.
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
