//! Sound files of all common formats, decoded as a whole.

mod pcm;
mod wave;

use crate::{SAMPLE_RATE, Sound};
use eddy_signal::resample_stereo;
use pcm::Samples;
use std::{
    io::Cursor,
    sync::{
        Arc,
        mpsc::{RecvTimeoutError, sync_channel},
    },
    thread,
    time::{Duration, Instant},
};
use symphonia::core::{
    audio::GenericAudioBufferRef,
    codecs::audio::{AudioDecoder, AudioDecoderOptions},
    errors::Error,
    formats::{FormatOptions, FormatReader, TrackType, probe::Hint},
    io::{MediaSourceStream, MediaSourceStreamOptions},
    meta::MetadataOptions,
};
use wave::{Format, Wave};

/// The limits for one file, checked before memory is allocated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The length that is decoded; the rest of a longer file is dropped.
    pub seconds: u32,
    /// The largest number of channels; all are mixed to two.
    pub channels: usize,
    /// The lowest and highest number of samples per second.
    pub rate: (u32, u32),
    /// The time after which decoding is given up.
    pub patience: Duration,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { seconds: 20 * 60, channels: 32, rate: (1_000, 768_000), patience: Duration::from_secs(60) }
    }
}

/// The reason why a file cannot be decoded.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AudioError {
    /// The content is of no known format or codec; contains the reason.
    #[error("no sound file that Eddy reads ({0})")]
    Unknown(String),
    /// A valid file of a format that is not read here. ffmpeg may read it.
    #[error("{0} are not supported")]
    Unsupported(String),
    /// A file of a known format without sound, such as a silent video.
    #[error("no sound in the file")]
    NoTrack,
    /// The file's number of channels, and [`Limits::channels`].
    #[error("{0} channels; at most {1} are read")]
    Channels(usize, usize),
    /// The file's samples per second, and the ends of [`Limits::rate`].
    #[error("{0} samples a second; {1} to {2} are read")]
    Rate(u32, u32, u32),
    /// The file breaks the rules of its format; contains the place or the reason.
    #[error("damaged: {0}")]
    Damaged(String),
    /// Decoding took longer than [`Limits::patience`].
    #[error("it was not decoded within {} s", .0.as_secs_f32())]
    Late(Duration),
    /// The decoder panicked, or has no thread.
    #[error("decoding failed: {0}")]
    Failed(String),
}

impl AudioError {
    /// Returns a hint for fixing it.
    pub fn hint(&self) -> &'static str {
        match self {
            AudioError::Unknown(_) | AudioError::Unsupported(_) => {
                "wav, mp3, ogg, flac, m4a and aac are read, and others where ffmpeg is installed; or convert it: ffmpeg -i FILE music.ogg"
            }
            AudioError::NoTrack => "choose a file with sound in it",
            AudioError::Channels(..) => "mix it down: ffmpeg -i FILE -ac 2 music.ogg",
            AudioError::Rate(..) => "resample it: ffmpeg -i FILE -ar 44100 music.ogg",
            AudioError::Damaged(_) | AudioError::Late(_) | AudioError::Failed(_) => {
                "write it again: ffmpeg -i FILE music.ogg"
            }
        }
    }
}

/// Decodes a file. `extension` is a hint if the content does not identify the format. A decoder that does not end in
/// time is abandoned on its thread.
pub fn decode(file: Arc<[u8]>, extension: Option<&str>, limits: &Limits) -> Result<Sound, AudioError> {
    let (limits, extension) = (*limits, extension.map(str::to_owned));
    within(limits.patience, move |give_up| {
        decode_packets(file, extension.as_deref(), &limits, || Instant::now() < give_up)
    })
}

/// Runs `work` on a separate thread, and returns when it ends or times out. `work` is passed the time at which it
/// should end by itself.
fn within<T: Send + 'static>(
    patience: Duration,
    work: impl FnOnce(Instant) -> Result<T, AudioError> + Send + 'static,
) -> Result<T, AudioError> {
    /// The extra time for work that notices by itself that it is late.
    const GRACE: Duration = Duration::from_millis(500);
    let (send, receive) = sync_channel(1);
    let give_up = Instant::now() + patience;
    let started = thread::Builder::new().name("sound file".into()).spawn(move || send.send(work(give_up)));
    started.map_err(|error| AudioError::Failed(error.to_string()))?;
    match receive.recv_timeout(patience + GRACE) {
        Ok(result) => result,
        Err(RecvTimeoutError::Timeout) => Err(AudioError::Late(patience)),
        Err(RecvTimeoutError::Disconnected) => Err(AudioError::Failed("the decoder has a fault".into())),
    }
}

fn decode_packets(
    file: Arc<[u8]>,
    extension: Option<&str>,
    limits: &Limits,
    go_on: impl Fn() -> bool,
) -> Result<Sound, AudioError> {
    let file = match wave::find(&file).transpose()? {
        Some(wave) => match Samples::of(&wave.format).transpose()? {
            Some(samples) => return decode_pcm(&wave, &file, samples, limits, go_on),
            None => other_codec(&wave, &file, limits)?,
        },
        None => file,
    };
    let mut format = open(file, extension)?;
    let mut track = Track::of(&*format)?;
    let mut stereo = Stereo::new(limits);
    // For damaged files some readers return the same error forever.
    let mut silent = 0;
    while silent < MOST_SILENT {
        if !go_on() {
            return Err(AudioError::Late(limits.patience));
        }
        silent += 1;
        let packet = match format.next_packet() {
            Ok(Some(packet)) => packet,
            // A truncated file plays up to the point where it ends, as in browsers.
            Ok(None) | Err(Error::IoError(_)) => break,
            Err(Error::ResetRequired) => break,
            Err(Error::DecodeError(_)) => continue,
            Err(error) => return Err(AudioError::Damaged(error.to_string())),
        };
        if packet.track_id != track.id {
            continue;
        }
        match track.decoder.decode(&packet) {
            Ok(audio) => {
                let (rate, channels) = (audio.spec().rate(), audio.spec().channels().count());
                let mut samples = Vec::new();
                stereo.expect(rate, channels, audio.frames())?;
                if audio.frames() > 0 {
                    silent = 0;
                }
                audio.copy_to_vec_interleaved::<f32>(&mut samples);
                let scale = scale_above_zero(&audio, track.bits);
                samples.iter_mut().filter(|sample| **sample > 0.0).for_each(|sample| *sample *= scale);
                if !stereo.push(&samples) {
                    break;
                }
            }
            Err(Error::DecodeError(_)) => {}
            Err(Error::IoError(_)) => break,
            Err(error) => return Err(AudioError::Damaged(error.to_string())),
        }
    }
    stereo.finish()
}

/// The number of consecutive damaged or empty packets that end a file. A second of an MP3 file at 44,100 Hz has 38
/// packets.
const MOST_SILENT: u32 = 10_000;

/// Decodes an uncompressed WAV file.
fn decode_pcm(
    wave: &Wave,
    file: &[u8],
    samples: Samples,
    limits: &Limits,
    go_on: impl Fn() -> bool,
) -> Result<Sound, AudioError> {
    let Format { channels, rate, .. } = wave.format;
    let mut stereo = Stereo::new(limits);
    stereo.expect(rate, channels, 1)?;
    for block in pcm::blocks(wave, file, samples) {
        if !go_on() {
            return Err(AudioError::Late(limits.patience));
        }
        if !stereo.push(&block) {
            break;
        }
    }
    stereo.finish()
}

/// Returns the part of a WAV file that the reader of its codec accepts: MP3 without the container, ADPCM in one with
/// correct sizes.
fn other_codec(wave: &Wave, file: &[u8], limits: &Limits) -> Result<Arc<[u8]>, AudioError> {
    // symphonia-format-riff 0.6.1 shifts a word by the number of channels without checking it.
    if wave.format.channels == 0 || wave.format.channels > limits.channels {
        return Err(AudioError::Channels(wave.format.channels, limits.channels));
    }
    match wave.format.tag {
        0x2 | 0x11 if !wave.is_big => Ok(wave.plain(file).into()),
        0x55 => Ok(file[wave.data.clone()].into()),
        tag => Err(AudioError::Unsupported(format!("WAV files with codec {tag:#06x}"))),
    }
}

fn open(file: Arc<[u8]>, extension: Option<&str>) -> Result<Box<dyn FormatReader>, AudioError> {
    let mut hint = Hint::new();
    if let Some(extension) = extension {
        hint.with_extension(extension);
    }
    let source = MediaSourceStream::new(Box::new(Cursor::new(file)), MediaSourceStreamOptions::default());
    symphonia::default::get_probe()
        .probe(&hint, source, FormatOptions::default(), MetadataOptions::default())
        .map_err(|error| AudioError::Unknown(error.to_string()))
}

/// The track to play.
struct Track {
    id: u32,
    /// Bits per sample in the file, if specified.
    bits: Option<u32>,
    decoder: Box<dyn AudioDecoder>,
}

impl Track {
    fn of(format: &dyn FormatReader) -> Result<Track, AudioError> {
        let track = format.default_track(TrackType::Audio).ok_or(AudioError::NoTrack)?;
        let parameters = track.codec_params.as_ref().and_then(|p| p.audio()).ok_or(AudioError::NoTrack)?;
        let decoder = symphonia::default::get_codecs()
            .make_audio_decoder(parameters, &AudioDecoderOptions::default())
            .map_err(|error| AudioError::Unknown(error.to_string()))?;
        Ok(Track { id: track.id, bits: parameters.bits_per_sample, decoder })
    }
}

/// Returns the scale factor of samples above zero. In Chromium the smallest integer becomes -1 and the largest 1
/// (media/base/audio_sample_types.h, `FixedSampleTypeTraits::ToFloat`), here -1 and 1 less one step. The difference is
/// an offset, which the first bins of the analyser show in 16 bits. FFmpeg, which decodes there, has integers of 8
/// (only in WAV files), 16 and 32 bits.
fn scale_above_zero(audio: &GenericAudioBufferRef<'_>, bits: Option<u32>) -> f32 {
    match (audio, bits) {
        (GenericAudioBufferRef::F32(_) | GenericAudioBufferRef::F64(_), _) => 1.0,
        (GenericAudioBufferRef::U8(_), _) => factor(128.0),
        (_, Some(..=16)) => factor(32_768.0),
        _ => 1.0,
    }
}

/// Returns that factor for integers with this number of steps on either side of zero.
fn factor(steps: f32) -> f32 {
    steps / (steps - 1.0)
}

/// The frames decoded so far, mixed to two channels, at the file's rate.
struct Stereo<'a> {
    limits: &'a Limits,
    rate: u32,
    channels: usize,
    frames: Vec<f32>,
    truncated: bool,
}

impl<'a> Stereo<'a> {
    fn new(limits: &'a Limits) -> Self {
        Stereo { limits, rate: 0, channels: 0, frames: Vec::new(), truncated: false }
    }

    /// Checks the format of a packet. A stream that changes its rate or channels is damaged.
    fn expect(&mut self, rate: u32, channels: usize, frames: usize) -> Result<(), AudioError> {
        if frames == 0 {
            return Ok(());
        }
        if channels == 0 || channels > self.limits.channels {
            return Err(AudioError::Channels(channels, self.limits.channels));
        }
        let (lowest, highest) = self.limits.rate;
        if !(lowest..=highest).contains(&rate) {
            return Err(AudioError::Rate(rate, lowest, highest));
        }
        if self.channels != 0 && (self.rate, self.channels) != (rate, channels) {
            return Err(AudioError::Damaged("the number of channels or the sample rate changes within".into()));
        }
        (self.rate, self.channels) = (rate, channels);
        Ok(())
    }

    /// Takes a packet's interleaved samples. Returns whether more are needed.
    fn push(&mut self, samples: &[f32]) -> bool {
        if self.channels == 0 {
            return true;
        }
        let room = (self.limits.seconds as usize * self.rate as usize).saturating_sub(self.frames.len() / 2);
        let frames = samples.len() / self.channels;
        self.truncated |= frames > room;
        self.frames.extend(samples.chunks_exact(self.channels).take(room).flat_map(mix));
        !self.truncated
    }

    fn finish(self) -> Result<Sound, AudioError> {
        if self.frames.is_empty() {
            return Err(AudioError::NoTrack);
        }
        let frames = if self.rate == SAMPLE_RATE {
            self.frames
        } else {
            resample_stereo(&self.frames, self.rate, SAMPLE_RATE).map_err(|e| AudioError::Damaged(e.to_string()))?
        };
        let frames = frames.chunks_exact(2).map(|f| [f[0], f[1]]).collect();
        Ok(Sound { frames, truncated: self.truncated })
    }
}

/// Returns left and right of a frame in the channel order of WAV files, mixed as in the Web Audio API ("Up-mixing and
/// down-mixing": mono to both, 4 and 5.1 channels by their rules, the first two of all others).
fn mix(frame: &[f32]) -> [f32; 2] {
    const HALF: f32 = std::f32::consts::FRAC_1_SQRT_2;
    match *frame {
        [mono] => [mono, mono],
        [left, right, back_left, back_right] => [0.5 * (left + back_left), 0.5 * (right + back_right)],
        [left, right, center, _, side_left, side_right] => {
            [left + HALF * (center + side_left), right + HALF * (center + side_right)]
        }
        [left, right, ..] => [left, right],
        [] => [0.0; 2],
    }
}

#[cfg(test)]
mod tests;
