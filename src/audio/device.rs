//! The machine's audio devices, by cpal.

use crate::{
    SAMPLE_RATE,
    host::{AudioHost, AudioIn, AudioOut, DeviceError, Events, Fill, Format, Opened, Take},
};
use cpal::{
    BufferSize, Data, ErrorKind, FromSample, OutputStreamTimestamp, SampleFormat, SizedSample, StreamConfig,
    StreamInstant, SupportedBufferSize, SupportedStreamConfig,
    traits::{DeviceTrait, HostTrait, StreamTrait},
};
use std::time::{Duration, Instant};

/// The number of samples that are converted at a time.
const CONVERTED: usize = 4096;
/// A device that consumes sound this far ahead of real time is not audible (ALSA's "null"): it is throttled, so that it
/// does not use a whole CPU core.
const AHEAD: Duration = Duration::from_secs(3);
/// The buffers of a device per second; two are filled ahead.
const BUFFERS_A_SECOND: u32 = 20;
/// Errors that continue for this long end a stream.
const TROUBLE: Duration = Duration::from_secs(2);
/// ALSA's device that discards everything; it is never useful to choose it.
const NULL: &str = "null";

/// The audio devices of this machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Machine;

impl AudioHost for Machine {
    fn output(&self) -> Box<dyn AudioOut> {
        Box::new(Machine)
    }

    fn input(&self) -> Box<dyn AudioIn> {
        Box::new(Machine)
    }
}

impl AudioOut for Machine {
    fn names(&mut self) -> Vec<String> {
        quiet();
        names(cpal::default_host().output_devices().map(|devices| devices.collect()))
    }

    fn open(
        &mut self,
        name: Option<&str>,
        fill: &mut dyn FnMut(Format) -> Fill,
        events: Events,
    ) -> Result<Opened, DeviceError> {
        quiet();
        let host = cpal::default_host();
        let all = || host.output_devices().map(|devices| devices.collect());
        let device = find(name, all, host.default_output_device(), "output")?;
        let refused = |error: cpal::Error| refused(&device, &error);
        let supported = device.default_output_config().map_err(refused)?;
        let (format, config) = format(&supported);
        // Long buffers add no visible delay: their content is timed for the moment when it is heard. They keep the
        // sound going while drawing uses every CPU core.
        let long = match supported.buffer_size() {
            SupportedBufferSize::Range { min, max } => (format.rate / BUFFERS_A_SECOND).clamp(*min, (*max).max(*min)),
            SupportedBufferSize::Unknown => format.rate / BUFFERS_A_SECOND,
        };
        let long = StreamConfig { buffer_size: BufferSize::Fixed(long), ..config };
        let mut open = |config| {
            let fill = held_back(fill(format), format);
            let stream =
                output(&device, supported.sample_format(), config, format, fill, report_errors(events.clone()));
            opened(&device, stream?, format)
        };
        open(long).or_else(|_| open(config))
    }
}

/// Builds a stream in the device's own sample format.
fn output(
    device: &cpal::Device,
    samples: SampleFormat,
    config: StreamConfig,
    format: Format,
    fill: Fill,
    on_error: impl FnMut(cpal::Error) + Send + 'static,
) -> Result<Result<cpal::Stream, cpal::Error>, DeviceError> {
    Ok(match samples {
        SampleFormat::F32 => played::<f32>(device, config, format, fill, on_error),
        SampleFormat::F64 => played::<f64>(device, config, format, fill, on_error),
        SampleFormat::I8 => played::<i8>(device, config, format, fill, on_error),
        SampleFormat::I16 => played::<i16>(device, config, format, fill, on_error),
        SampleFormat::I24 => played::<cpal::I24>(device, config, format, fill, on_error),
        SampleFormat::I32 => played::<i32>(device, config, format, fill, on_error),
        SampleFormat::U8 => played::<u8>(device, config, format, fill, on_error),
        SampleFormat::U16 => played::<u16>(device, config, format, fill, on_error),
        SampleFormat::U32 => played::<u32>(device, config, format, fill, on_error),
        other => return Err(unsupported(device, other)),
    })
}

impl AudioIn for Machine {
    fn names(&mut self) -> Vec<String> {
        quiet();
        names(cpal::default_host().input_devices().map(|devices| devices.collect()))
    }

    fn open(
        &mut self,
        name: Option<&str>,
        take: &mut dyn FnMut(Format) -> Take,
        events: Events,
    ) -> Result<Opened, DeviceError> {
        quiet();
        let host = cpal::default_host();
        let all = || host.input_devices().map(|devices| devices.collect());
        let device = find(name, all, host.default_input_device(), "input")?;
        let refused = |error: cpal::Error| refused(&device, &error);
        let usual = device.default_input_config().map_err(refused)?;
        // Prefer the analyser's own rate if the device supports it.
        let ranges = device.supported_input_configs().ok().into_iter().flatten();
        let ours = ranges
            .filter(|range| range.channels() == usual.channels() && range.sample_format() == usual.sample_format())
            .find_map(|range| range.try_with_sample_rate(SAMPLE_RATE));
        let supported = ours.unwrap_or(usual);
        let (format, config) = format(&supported);
        let take = take(format);
        let on_error = report_errors(events);
        let stream = match supported.sample_format() {
            SampleFormat::F32 => recorded::<f32>(&device, config, take, on_error),
            SampleFormat::F64 => recorded::<f64>(&device, config, take, on_error),
            SampleFormat::I8 => recorded::<i8>(&device, config, take, on_error),
            SampleFormat::I16 => recorded::<i16>(&device, config, take, on_error),
            SampleFormat::I24 => recorded::<cpal::I24>(&device, config, take, on_error),
            SampleFormat::I32 => recorded::<i32>(&device, config, take, on_error),
            SampleFormat::U8 => recorded::<u8>(&device, config, take, on_error),
            SampleFormat::U16 => recorded::<u16>(&device, config, take, on_error),
            SampleFormat::U32 => recorded::<u32>(&device, config, take, on_error),
            other => return Err(unsupported(&device, other)),
        };
        opened(&device, stream, format)
    }
}

/// Keeps ALSA's messages about missing devices off the terminal: a notice reports them.
fn quiet() {
    #[cfg(any(target_os = "linux", target_os = "dragonfly", target_os = "freebsd", target_os = "netbsd"))]
    let _ = alsa::Output::local_error_handler();
}

fn names(devices: Result<Vec<cpal::Device>, cpal::Error>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for device in devices.unwrap_or_default().iter().filter(|device| !is_null(device)) {
        let name = device.to_string();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

fn is_null(device: &cpal::Device) -> bool {
    device.id().is_ok_and(|id| id.id() == NULL)
}

fn find(
    name: Option<&str>,
    all: impl FnOnce() -> Result<Vec<cpal::Device>, cpal::Error>,
    default: Option<cpal::Device>,
    what: &'static str,
) -> Result<cpal::Device, DeviceError> {
    let Some(name) = name else { return default.ok_or(DeviceError::None(what)) };
    let is_it = |device: &cpal::Device| device.to_string() == name || device.id().is_ok_and(|id| id.id() == name);
    all().unwrap_or_default().into_iter().find(is_it).ok_or_else(|| DeviceError::Unknown(name.to_owned()))
}

fn format(supported: &SupportedStreamConfig) -> (Format, StreamConfig) {
    let config = supported.config();
    (Format { rate: config.sample_rate, channels: usize::from(config.channels).max(1) }, config)
}

fn refused(device: &cpal::Device, error: &cpal::Error) -> DeviceError {
    let why = match error.kind() {
        ErrorKind::DeviceNotAvailable => "is not available".to_owned(),
        ErrorKind::DeviceBusy => "is used by another program".to_owned(),
        ErrorKind::PermissionDenied => "may not be used: the system does not permit it".to_owned(),
        _ => format!("cannot be opened: {}", error.to_string().trim_end_matches('.')),
    };
    DeviceError::Refused { name: device.to_string(), why }
}

fn unsupported(device: &cpal::Device, format: SampleFormat) -> DeviceError {
    let why = format!("has the sample format {format}, which is not supported");
    DeviceError::Refused { name: device.to_string(), why }
}

fn opened(
    device: &cpal::Device,
    stream: Result<cpal::Stream, cpal::Error>,
    format: Format,
) -> Result<Opened, DeviceError> {
    let stream = stream.map_err(|error| refused(device, &error))?;
    stream.play().map_err(|error| refused(device, &error))?;
    Ok(Opened { name: device.to_string(), format, stream: Box::new(stream) })
}

/// Returns a callback for the errors of a stream. Only the first error that ends it is passed on.
///
/// ALSA's plugin for PulseAudio fails with EIO until the server has reported its delay, and continues to play. So an
/// error ends a stream only if its kind is fatal, or if errors follow each other for [`TROUBLE`].
fn report_errors(events: Events) -> impl FnMut(cpal::Error) + Send + 'static {
    let mut is_gone = false;
    let mut trouble: Option<(Instant, Instant)> = None;
    move |error| {
        let is_end = match error.kind() {
            ErrorKind::Xrun => return events.underrun(),
            // The stream continues, on another device or at another priority.
            ErrorKind::DeviceChanged | ErrorKind::RealtimeDenied => return,
            ErrorKind::DeviceNotAvailable | ErrorKind::StreamInvalidated | ErrorKind::HostUnavailable => true,
            _ => {
                let now = Instant::now();
                let since =
                    trouble.filter(|(_, last)| now.duration_since(*last) < TROUBLE / 4).map_or(now, |(first, _)| first);
                trouble = Some((since, now));
                now.duration_since(since) > TROUBLE
            }
        };
        if is_end && !std::mem::replace(&mut is_gone, true) {
            events.gone(error.to_string().trim_end_matches('.').to_owned());
        }
    }
}

/// Throttles a device that consumes sound faster than real time.
fn held_back(mut fill: Fill, format: Format) -> Fill {
    let mut since: Option<Instant> = None;
    let mut frames = 0_u64;
    Box::new(move |out, heard_at| {
        fill(out, heard_at);
        let since = *since.get_or_insert_with(Instant::now);
        frames += (out.len() / format.channels) as u64;
        let played = Duration::from_secs_f64(frames as f64 / f64::from(format.rate));
        if let Some(ahead) = played.checked_sub(since.elapsed() + AHEAD) {
            std::thread::sleep(ahead);
        }
    })
}

/// Maps the clock of a stream to the system's clock.
///
/// A callback may start long after the moment that its times refer to, if other threads use the CPU: the shortest such
/// wait of the recent past is the difference between both clocks.
#[derive(Default)]
struct StreamClock {
    /// Corresponding moments of both clocks, apart from the wait.
    base: Option<(Instant, StreamInstant)>,
    /// The shortest wait in seconds, and the time of the newest callback by the stream's clock.
    wait: f64,
    callback_secs: f64,
}

impl StreamClock {
    /// The maximum drift between the clocks, in seconds per second.
    const DRIFT: f64 = 2e-4;

    fn heard_at(&mut self, times: OutputStreamTimestamp, now: Instant) -> Instant {
        let (ours, theirs) = *self.base.get_or_insert((now, times.callback));
        let callback_secs = times.callback.duration_since(theirs).as_secs_f64();
        let wait = now.duration_since(ours).as_secs_f64() - callback_secs;
        self.wait = wait.min(self.wait + Self::DRIFT * (callback_secs - self.callback_secs).max(0.0));
        self.callback_secs = callback_secs;
        let delay = times.playback.duration_since(times.callback).as_secs_f64();
        let secs = callback_secs + self.wait + delay;
        ours.checked_add(Duration::try_from_secs_f64(secs.max(0.0)).unwrap_or_default()).unwrap_or(now)
    }
}

fn played<T: SizedSample + FromSample<f32> + Send + 'static>(
    device: &cpal::Device,
    config: StreamConfig,
    format: Format,
    mut fill: Fill,
    on_error: impl FnMut(cpal::Error) + Send + 'static,
) -> Result<cpal::Stream, cpal::Error> {
    // A multiple of whole frames.
    let mut scratch = vec![0.0_f32; (CONVERTED / format.channels).max(1) * format.channels];
    let mut clock = StreamClock::default();
    let callback = move |out: &mut Data, info: &cpal::OutputCallbackInfo| {
        let mut heard_at = clock.heard_at(info.timestamp(), Instant::now());
        if let Some(out) = out.as_slice_mut::<f32>() {
            return fill(out, heard_at);
        }
        let Some(out) = out.as_slice_mut::<T>() else { return };
        for part in out.chunks_mut(scratch.len()) {
            let mixed = &mut scratch[..part.len()];
            fill(mixed, heard_at);
            part.iter_mut().zip(mixed).for_each(|(out, sample)| *out = T::from_sample_(*sample));
            heard_at += Duration::from_secs_f64((part.len() / format.channels) as f64 / f64::from(format.rate));
        }
    };
    device.build_output_stream_raw(config, T::FORMAT, callback, on_error, None)
}

fn recorded<T: SizedSample + Send + 'static>(
    device: &cpal::Device,
    config: StreamConfig,
    mut take: Take,
    on_error: impl FnMut(cpal::Error) + Send + 'static,
) -> Result<cpal::Stream, cpal::Error>
where
    f32: FromSample<T>,
{
    let channels = usize::from(config.channels).max(1);
    let mut scratch = vec![0.0_f32; (CONVERTED / channels).max(1) * channels];
    let callback = move |heard: &Data, _: &cpal::InputCallbackInfo| {
        if let Some(heard) = heard.as_slice::<f32>() {
            return take(heard);
        }
        let Some(heard) = heard.as_slice::<T>() else { return };
        for part in heard.chunks(scratch.len()) {
            let taken = &mut scratch[..part.len()];
            taken.iter_mut().zip(part).for_each(|(sample, heard)| *sample = f32::from_sample_(*heard));
            take(taken);
        }
    };
    device.build_input_stream_raw(config, T::FORMAT, callback, on_error, None)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_late_callback_does_not_change_the_time() {
        let start = Instant::now();
        let mut clock = StreamClock::default();
        let mut worst = Duration::ZERO;
        for n in 0..200_u64 {
            let theirs = StreamInstant::from_millis(5000 + 50 * n);
            let playback = theirs + Duration::from_millis(100);
            // A wait of 1 ms, and of 40 ms for every third buffer.
            let wait = Duration::from_millis(if n % 3 == 0 { 40 } else { 1 });
            let at = start + Duration::from_millis(50 * n);
            let heard_at = clock.heard_at(OutputStreamTimestamp { callback: theirs, playback }, at + wait);
            let exact = at + Duration::from_millis(101);
            if n > 0 {
                worst = worst.max(heard_at.max(exact) - heard_at.min(exact));
            }
        }
        assert!(worst < Duration::from_micros(100), "{worst:?}");
    }
}
