use super::*;
use crate::wav::wav;

fn read(file: &[u8]) -> Result<Sound, AudioError> {
    decode(file.into(), None, &Limits::default())
}

fn sine(count: usize, rate: f64) -> Vec<[i16; 2]> {
    let value = |n: usize| (20_000.0 * (std::f64::consts::TAU * 440.0 * n as f64 / rate).sin()) as i16;
    (0..count).map(|n| [value(n), -value(n)]).collect()
}

/// Integers become floats as in Chromium: both ends of their range are ends of that from -1 to 1.
#[test]
fn a_wav_file_comes_back() {
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
fn samples_of_8_bits_and_floats_come_back() {
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

/// The header says another rate, so the sound is resampled: a 440 Hz sine stays one, and its opposite on the right too.
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
fn a_long_file_is_cut_and_says_so() {
    let limits = Limits { seconds: 1, ..Limits::default() };
    let sound = decode(wav(&sine(50_000, 44_100.0)).into(), None, &limits).unwrap();
    assert_eq!((sound.frames.len(), sound.truncated), (44_100, true));
}

#[test]
fn what_is_no_sound_is_refused() {
    assert!(matches!(read(b"\x89PNG\r\n\x1a\n0000000000"), Err(AudioError::Unknown(_))));
    assert!(matches!(read(b""), Err(AudioError::Unknown(_))));
    assert_eq!(read(&wav(&[])), Err(AudioError::NoTrack));
    let mut file = wav(&sine(100, 44_100.0));
    file[24..28].copy_from_slice(&1u32.to_le_bytes());
    assert_eq!(read(&file), Err(AudioError::Rate(1, 4_000, 384_000)));
    let mut file = wav(&sine(100, 44_100.0));
    file[22..24].copy_from_slice(&511u16.to_le_bytes());
    assert_eq!(read(&file), Err(AudioError::Channels(511, 8)));
}

#[test]
fn a_decoder_that_is_late_is_left_behind() {
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
fn a_file_that_was_cut_off_plays_up_to_there() {
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
