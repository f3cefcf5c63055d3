use super::*;
use crate::wav::wav;

fn read(file: &[u8]) -> Result<Sound, AudioError> {
    decode(file.into(), None, &Limits::default())
}

fn sine(count: usize, rate: f64) -> Vec<[i16; 2]> {
    let value = |n: usize| (20_000.0 * (std::f64::consts::TAU * 440.0 * n as f64 / rate).sin()) as i16;
    (0..count).map(|n| [value(n), -value(n)]).collect()
}

/// Integers become floats as in Chromium: both ends of their range map to -1 and 1.
#[test]
fn a_wav_file_round_trips() {
    let mut frames = sine(5000, 44_100.0);
    frames[7] = [i16::MIN, i16::MAX];
    let sound = read(&wav(&frames)).unwrap();
    assert_eq!(sound.frames.len(), 5000);
    assert_eq!(sound.frames[7], [-1.0, 1.0]);
    for (got, wrote) in sound.frames.iter().flatten().zip(frames.iter().flatten()) {
        let exact = f64::from(*wrote) / if *wrote < 0 { 32_768.0 } else { 32_767.0 };
        assert!((f64::from(*got) - exact).abs() <= 1e-7, "{wrote}: {got}");
    }
}

#[test]
fn samples_of_8_bits_and_floats_round_trip() {
    let with = |format: u16, bits: u16, data: &[u8]| {
        let mut file = wav(&vec![[0; 2]; data.len() / 4]);
        file[20..22].copy_from_slice(&format.to_le_bytes());
        file[28..32].copy_from_slice(&(44_100 * 2 * u32::from(bits / 8)).to_le_bytes());
        file[32..34].copy_from_slice(&(2 * bits / 8).to_le_bytes());
        file[34..36].copy_from_slice(&bits.to_le_bytes());
        let start = file.len() - data.len();
        file[start..].copy_from_slice(data);
        read(&file).unwrap().frames
    };
    assert_eq!(with(1, 8, &[0, 255, 128, 64]), [[-1.0, 1.0], [0.0, -0.5]]);
    let floats: Vec<u8> = [0.25f32, -0.25, 1.0, 0.75].iter().flat_map(|x| x.to_le_bytes()).collect();
    assert_eq!(with(3, 32, &floats), [[0.25, -0.25], [1.0, 0.75]]);
}

/// The header contains another rate, so the sound is resampled: a 440 Hz sine stays one, and so does its negative on
/// the right.
#[test]
fn another_rate_is_resampled() {
    let mut file = wav(&sine(48_000, 48_000.0));
    file[24..28].copy_from_slice(&48_000u32.to_le_bytes());
    let sound = read(&file).unwrap();
    assert!((sound.frames.len() as i64 - 44_100).abs() < 8, "{}", sound.frames.len());
    let worst = (2000..42_000)
        .map(|n| {
            let exact = 20_000.0 / 32_768.0 * (std::f64::consts::TAU * 440.0 * n as f64 / 44_100.0).sin();
            let [left, right] = sound.frames[n].map(f64::from);
            (left - exact).abs().max((right + exact).abs())
        })
        .fold(0.0, f64::max);
    assert!(worst < 2e-4, "{worst}");
}

#[test]
fn a_long_file_is_truncated_and_marked() {
    let limits = Limits { seconds: 1, ..Limits::default() };
    let sound = decode(wav(&sine(50_000, 44_100.0)).into(), None, &limits).unwrap();
    assert_eq!((sound.frames.len(), sound.truncated), (44_100, true));
}

#[test]
fn other_files_are_rejected() {
    assert!(matches!(read(b"\x89PNG\r\n\x1a\n0000000000"), Err(AudioError::Unknown(_))));
    assert!(matches!(read(b""), Err(AudioError::Unknown(_))));
    assert_eq!(read(&wav(&[])), Err(AudioError::NoTrack));
    let mut file = wav(&sine(100, 44_100.0));
    file[24..28].copy_from_slice(&1u32.to_le_bytes());
    assert_eq!(read(&file), Err(AudioError::Rate(1, 1_000, 768_000)));
    let mut file = wav(&sine(100, 44_100.0));
    file[22..24].copy_from_slice(&511u16.to_le_bytes());
    assert_eq!(read(&file), Err(AudioError::Channels(511, 32)));
}

#[test]
fn a_decoder_that_times_out_is_abandoned() {
    let none = Limits { patience: Duration::ZERO, ..Limits::default() };
    assert_eq!(decode(wav(&sine(9, 1.0)).into(), None, &none), Err(AudioError::Late(Duration::ZERO)));
    let patience = Duration::from_millis(20);
    let hangs = |_: Instant| -> Result<(), AudioError> {
        loop {
            thread::park();
        }
    };
    assert_eq!(within(patience, hangs), Err(AudioError::Late(patience)));
    let panics = |_: Instant| -> Result<(), AudioError> { std::panic::resume_unwind(Box::new(())) };
    assert!(matches!(within(patience, panics), Err(AudioError::Failed(_))));
}

#[test]
fn a_truncated_file_plays_to_its_end() {
    let file = wav(&sine(50_000, 44_100.0));
    let sound = read(&file[..file.len() / 2]).unwrap();
    assert!((20_000..=25_000).contains(&sound.frames.len()), "{}", sound.frames.len());
}

#[test]
fn channels_are_mixed() {
    assert_eq!(mix(&[0.5]), [0.5, 0.5]);
    assert_eq!(mix(&[1.0, 0.0, 0.5, 0.25]), [0.75, 0.125]);
    assert_eq!(mix(&[0.1, 0.2, 0.0, 9.0, 0.0, 0.0]), [0.1, 0.2]);
}

/// A WAV file of mono samples at 44,100 Hz, with other chunks before its data.
fn wav_of(tag: u16, bits: u16, between: &[u8], data: &[u8]) -> Vec<u8> {
    let mut file = wav(&[]);
    let align = bits.div_ceil(8);
    for (at, field) in [(20, tag), (22, 1), (32, align), (34, bits)] {
        file[at..at + 2].copy_from_slice(&field.to_le_bytes());
    }
    file[28..32].copy_from_slice(&(44_100 * u32::from(align)).to_le_bytes());
    file.truncate(36);
    file.extend(between);
    file.extend(b"data");
    file.extend((data.len() as u32).to_le_bytes());
    file.extend(data);
    let size = file.len() as u32 - 8;
    file[4..8].copy_from_slice(&size.to_le_bytes());
    file
}

fn left(file: &[u8]) -> Vec<f32> {
    read(file).unwrap().frames.iter().map(|frame| frame[0]).collect()
}

/// A file as a recorder leaves it when interrupted, which Chromium plays.
#[test]
fn wrong_sizes_in_a_wav_file_are_ignored() {
    let data: Vec<u8> = (0..200i16).flat_map(|n| (n * 100).to_le_bytes()).collect();
    let good = wav_of(1, 16, &[], &data);
    let right = left(&good);
    assert_eq!(right.len(), 200);
    for riff in [0, 3, 4, 100, u32::MAX] {
        for size in [data.len() as u32, 0, u32::MAX, data.len() as u32 + 1] {
            let mut file = good.clone();
            file[4..8].copy_from_slice(&riff.to_le_bytes());
            file[40..44].copy_from_slice(&size.to_le_bytes());
            assert_eq!(left(&file), right, "{riff} {size}");
        }
    }
    for list in [
        &b"LIST\x05\0\0\0INFOx\0"[..],
        b"LIST\x05\0\0\0INFOx",
        b"LIST\x0c\0\0\0INFOINAM\xff\xff\xff\xff",
        b"LIST\0\0\0\0",
        b"JUNK\x03\0\0\0abc\0fact\x04\0\0\0\xff\xff\xff\xff",
    ] {
        assert_eq!(left(&wav_of(1, 16, list, &data)), right, "{list:?}");
    }
    let mut after = good.clone();
    after.extend(b"LIST\x04\0\0\0INFO");
    assert_eq!(left(&after), right, "what follows the sound is not played");
    assert_eq!(left(&good[..good.len() - 1]), right[..199], "half a sample at the end is left out");
}

#[test]
fn sizes_of_64_bits_are_read() {
    let data: Vec<u8> = (0..20i16).flat_map(|n| (n * 100).to_le_bytes()).collect();
    let plain = wav_of(1, 16, &[], &data);
    for (name, samples) in [(b"RF64", 20), (b"BW64", 20), (b"RF64", 7)] {
        let mut file = [name, &[0xff; 4], &b"WAVEds64\x1c\0\0\0"[..]].concat();
        for size in [0, 2 * samples as u64, samples as u64] {
            file.extend(size.to_le_bytes());
        }
        file.extend([0; 4]);
        file.extend(&plain[12..]);
        let at = file.len() - data.len() - 4;
        file[at..at + 4].fill(0xff);
        assert_eq!(left(&file), left(&plain)[..samples], "{samples}");
    }
}

#[test]
fn uncompressed_samples_of_every_format_are_read() {
    for (tag, bits, data, right) in [
        // 12 bits are stored in the upper bits of 16.
        (1, 12, &[0x00, 0x40, 0x00, 0x80][..], [0.5 * 32_768.0 / 32_767.0, -1.0]),
        (1, 24, &[0, 0, 0x40, 0, 0, 0x80], [0.5, -1.0]),
        (1, 20, &[0, 0, 0x40, 0, 0, 0x80], [0.5, -1.0]),
        (1, 32, &[0, 0, 0, 0x40, 0, 0, 0, 0x80], [0.5, -1.0]),
        (1, 5, &[0, 128], [-1.0, 0.0]),
        (6, 8, &[0x2a, 0xd5], [-32_256.0 / 32_768.0, 8.0 / 32_767.0]),
        (7, 8, &[0x00, 0xff], [-32_124.0 / 32_768.0, 0.0]),
    ] {
        assert_eq!(left(&wav_of(tag, bits, &[], data)), right, "codec {tag} of {bits} bits");
    }
    // The same with the most significant byte first.
    let mut file = wav_of(1, 16, &[], &[0x40, 0x00, 0x80, 0x00]);
    file[..4].copy_from_slice(b"RIFX");
    for field in [4..8, 16..20, 20..22, 22..24, 24..28, 28..32, 32..34, 34..36, 40..44] {
        file[field].reverse();
    }
    assert_eq!(left(&file), [0.5 * 32_768.0 / 32_767.0, -1.0]);
    // An extensible format, whose subformat defines its samples.
    let floats: Vec<u8> = [0.25f32, -2.0].iter().flat_map(|value| value.to_le_bytes()).collect();
    let plain = wav_of(3, 32, &[], &floats);
    let extension = [&[22, 0, 32, 0, 4, 0, 0, 0, 3, 0][..], &[0; 14]].concat();
    let mut file = [&plain[..36], &extension, &plain[36..]].concat();
    file[16] = 40;
    file[20..22].copy_from_slice(&[0xfe, 0xff]);
    assert_eq!(left(&file), [0.25, -2.0]);
    // The same with the most significant byte first: the identifier starts with a number of 32 bits.
    file[..4].copy_from_slice(b"RIFX");
    for field in [4..8, 16..20, 20..22, 22..24, 24..28, 28..32, 32..34, 34..36, 36..38, 38..40, 40..44, 44..48, 64..68]
    {
        file[field].reverse();
    }
    file[68..].chunks_exact_mut(4).for_each(<[u8]>::reverse);
    assert_eq!(left(&file), [0.25, -2.0]);
}

#[test]
fn a_wav_file_with_many_channels_plays_its_first_two() {
    let mut file = wav_of(1, 8, &[], &[0, 255, 128, 128, 128, 128, 128, 128, 128, 128]);
    file[22] = 10;
    assert_eq!(read(&file).unwrap().frames, [[-1.0, 1.0]]);
}

#[test]
fn unsupported_codecs_differ_from_damage() {
    let error = read(&wav_of(0x31, 8, &[], &[0; 100])).unwrap_err();
    assert_eq!(error.to_string(), "WAV files with codec 0x0031 are not supported");
    let error = read(&wav_of(3, 16, &[], &[0; 100])).unwrap_err();
    assert_eq!(error.to_string(), "samples of 16 bits are not supported");
    assert!(matches!(read(b"RIFF\0\0\0\0WAVEfmt \x10\0\0\0\x01\0"), Err(AudioError::Damaged(_))));
    assert!(matches!(read(b"RIFF\0\0\0\0WAVE"), Err(AudioError::Damaged(_))));
}

/// Every truncation and every changed byte of a file results in a sound or an error.
#[test]
fn malformed_wav_files_do_not_panic() {
    let file = wav_of(1, 16, b"LIST\x05\0\0\0INFOx\0", &[1; 64]);
    for end in 0..file.len() {
        let _ = decode_packets(file[..end].into(), None, &Limits::default(), || true);
    }
    for at in 0..60 {
        for value in [0, 1, 2, 0x11, 0x7f, 0x80, 0xfe, 0xff] {
            let mut file = file.clone();
            file[at] = value;
            let _ = decode_packets(file.into(), None, &Limits::default(), || true);
        }
    }
}
