//! FLAC files (RFC 9639): 16 bits, stereo, lossless.

use crate::SAMPLE_RATE;
use flacenc::{bitsink::ByteSink, component::BitRepr, config::Encoder, error::Verify, source::MemSource};

/// Returns a whole file of `frames`, left and right. An error is a message, and a bug in Eddy.
pub fn flac(frames: &[[i16; 2]]) -> Result<Vec<u8>, String> {
    let config = Encoder::default().into_verified().map_err(|(_, error)| error.to_string())?;
    let samples: Vec<i32> = frames.iter().flatten().map(|sample| i32::from(*sample)).collect();
    let source = MemSource::from_samples(&samples, 2, 16, SAMPLE_RATE as usize);
    let stream = flacenc::encode_with_fixed_block_size(&config, source, config.block_size);
    let mut stream = stream.map_err(|error| error.to_string())?;
    // The last block is shorter and is not counted (section 8.2): readers recognise a fixed block size by this.
    let block = config.block_size;
    stream.stream_info_mut().set_block_sizes(block, block).map_err(|error| error.to_string())?;
    let mut sink = ByteSink::new();
    stream.write(&mut sink).map_err(|error| error.to_string())?;
    Ok(sink.as_slice().to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Limits, decode};

    /// Tones, noise, silence, the extremes, and a last block that is not full.
    #[test]
    fn a_file_decodes_to_the_same_samples() {
        let mut noise = 1u32;
        let frames: Vec<[i16; 2]> = (0..50_001)
            .map(|n| {
                noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let tone = (9000.0 * (f64::from(n) * 0.0627).sin()) as i16;
                match n / 10_000 {
                    0 => [tone, -tone],
                    1 => [(noise >> 16) as i16, (noise >> 8) as i16],
                    2 => [0, 0],
                    3 => [if n % 2 == 0 { i16::MAX } else { i16::MIN }, tone],
                    _ => [tone / 2, tone / 2],
                }
            })
            .collect();
        let file = flac(&frames).unwrap();
        assert!(file.starts_with(b"fLaC") && file.len() < frames.len() * 4);
        let sound = decode(file.into(), Some("flac"), &Limits::default()).unwrap();
        assert_eq!(sound.frames.len(), frames.len());
        let whole = |sample: f32| (sample * if sample > 0.0 { 32767.0 } else { 32768.0 }).round() as i16;
        let back = sound.frames.iter().map(|frame| frame.map(whole));
        assert!(back.eq(frames.iter().copied()));
    }
}
