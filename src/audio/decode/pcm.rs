//! Uncompressed samples, and those of G.711 (ITU-T G.711, tables 1a to 2b), as floats.

use super::{
    AudioError,
    wave::{Format, Wave},
};

/// Codec numbers (Microsoft, `mmreg.h`).
const PCM: u16 = 1;
const FLOAT: u16 = 3;
const A_LAW: u16 = 6;
const MU_LAW: u16 = 7;

/// A sample format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Samples {
    /// Unsigned integers of 8 bits or fewer, with silence at 128.
    Unsigned,
    /// Signed integers of this number of bytes. If the samples have fewer bits, those are the most significant ones.
    Signed(usize),
    Float32,
    Float64,
    ALaw,
    MuLaw,
}

impl Samples {
    /// Returns the sample format of a WAV format; `None` for a codec that is not read here.
    pub(super) fn of(format: &Format) -> Option<Result<Samples, AudioError>> {
        let unsupported = || Err(AudioError::Unsupported(format!("samples of {} bits", format.bits)));
        Some(match (format.tag, format.bits) {
            (PCM, 1..=8) => Ok(Samples::Unsigned),
            (PCM, bits @ 9..=32) => Ok(Samples::Signed(bits.div_ceil(8) as usize)),
            // Programs store such samples in different numbers of bytes.
            (PCM, bits @ 33..=64) => {
                let own = format.align / format.channels.max(1);
                let least = bits.div_ceil(8) as usize;
                Ok(Samples::Signed(if (least..=8).contains(&own) { own } else { least }))
            }
            (FLOAT, 32) => Ok(Samples::Float32),
            (FLOAT, 64) => Ok(Samples::Float64),
            (A_LAW, _) => Ok(Samples::ALaw),
            (MU_LAW, _) => Ok(Samples::MuLaw),
            (PCM | FLOAT, _) => unsupported(),
            _ => return None,
        })
    }

    /// Returns the number of bytes per sample.
    pub(super) fn bytes(self) -> usize {
        match self {
            Samples::Unsigned | Samples::ALaw | Samples::MuLaw => 1,
            Samples::Signed(bytes) => bytes,
            Samples::Float32 => 4,
            Samples::Float64 => 8,
        }
    }

    /// Returns a sample in -1 to 1; floats may be outside. Both ends of the range of integers up to 16 bits are those
    /// of Chromium: see [`super::scale_above_zero`].
    pub(super) fn value(self, bytes: &[u8], is_big: bool) -> f32 {
        // The same operations as for other files, so that a FLAC file of the same samples decodes to the same sound bit
        // for bit.
        let scaled = |value: i16, steps: f32| {
            let value = f32::from(value) / steps;
            if value > 0.0 { value * super::factor(steps) } else { value }
        };
        let of_i16 = |value: i16| scaled(value, 32_768.0);
        match self {
            Samples::Unsigned => scaled(i16::from(bytes[0]) - 128, 128.0),
            Samples::Signed(2) => of_i16((top(bytes, is_big) >> 48) as i16),
            Samples::Signed(_) => (top(bytes, is_big) as f64 / 2f64.powi(63)) as f32,
            Samples::Float32 => f32::from_bits((top(bytes, is_big) as u64 >> 32) as u32),
            Samples::Float64 => f64::from_bits(top(bytes, is_big) as u64) as f32,
            Samples::ALaw => of_i16(a_law(bytes[0])),
            Samples::MuLaw => of_i16(mu_law(bytes[0])),
        }
    }
}

/// Returns the bytes of a sample as the most significant ones of an integer.
fn top(bytes: &[u8], is_big: bool) -> i64 {
    let mut all = [0; 8];
    let length = bytes.len().min(8);
    for (n, byte) in bytes.iter().take(length).enumerate() {
        all[if is_big { n } else { length - 1 - n }] = *byte;
    }
    i64::from_be_bytes(all)
}

fn a_law(code: u8) -> i16 {
    let code = code ^ 0x55;
    let (exponent, mantissa) = ((code >> 4) & 7, i16::from(code & 15));
    let size = match exponent {
        0 => (mantissa << 4) + 8,
        _ => ((mantissa << 4) + 0x108) << (exponent - 1),
    };
    if code & 0x80 == 0 { -size } else { size }
}

fn mu_law(code: u8) -> i16 {
    const BIAS: i16 = 0x84;
    let code = !code;
    let size = (((i16::from(code & 15) << 3) + BIAS) << ((code >> 4) & 7)) - BIAS;
    if code & 0x80 == 0 { size } else { -size }
}

/// Returns the sound's frames as interleaved floats, in blocks of `FRAMES`.
pub(super) fn blocks<'f>(wave: &Wave, file: &'f [u8], samples: Samples) -> impl Iterator<Item = Vec<f32>> + use<'f> {
    const FRAMES: usize = 4096;
    let (frame, is_big) = (samples.bytes() * wave.format.channels.max(1), wave.is_big);
    let data = &file[wave.data.clone()];
    let whole = data.len() - data.len() % frame;
    data[..whole]
        .chunks(frame * FRAMES)
        .map(move |block| block.chunks_exact(samples.bytes()).map(|sample| samples.value(sample, is_big)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ends of the tables of G.711, scaled to 16 bits: A-law has 13 bits including the sign, mu-law 14.
    #[test]
    fn g711_codes_are_those_of_its_tables() {
        assert_eq!([0xaa, 0x2a, 0xd5, 0x55].map(a_law), [32_256, -32_256, 8, -8]);
        assert_eq!([0x80, 0x00, 0xff, 0x7f].map(mu_law), [32_124, -32_124, 0, 0]);
    }

    #[test]
    fn samples_of_every_width_are_read() {
        let signed = |bytes: &[u8]| Samples::Signed(bytes.len()).value(bytes, false);
        assert_eq!(signed(&[0x00, 0x80]), -1.0);
        assert_eq!(signed(&[0xff, 0x7f]), 1.0);
        for bytes in [3, 4, 5, 8] {
            let mut half = vec![0; bytes];
            half[bytes - 1] = 0x40;
            assert_eq!(signed(&half), 0.5, "{bytes}");
            half.reverse();
            assert_eq!(Samples::Signed(bytes).value(&half, true), 0.5, "{bytes}, the other order");
            half[0] = 0xc0;
            assert_eq!(Samples::Signed(bytes).value(&half, true), -0.5, "{bytes}");
        }
        assert_eq!([0, 128, 255].map(|code| Samples::Unsigned.value(&[code], false)), [-1.0, 0.0, 1.0]);
        assert_eq!(Samples::Float32.value(&0.3f32.to_be_bytes(), true), 0.3);
        assert_eq!(Samples::Float64.value(&(-1.5f64).to_le_bytes(), false), -1.5);
    }
}
