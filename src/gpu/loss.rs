//! A device that is lost or hangs: wgpu's behaviour in that case, and reopening.

use crate::GpuError;
use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::mpsc::{RecvTimeoutError, channel},
    time::Duration,
};

/// Time for which opening a device is retried while the driver resets the lost one. An H100 (driver 580.159) returned
/// `DEVICE_LOST` after a hang; the duration of a reset was not measured.
pub const RESET_TIMEOUT: Duration = Duration::from_secs(5);
/// The time between two attempts.
const RETRY_DELAY: Duration = Duration::from_millis(250);

/// The time after which a driver that opens a device is considered hung. The first start of a driver compiles shaders
/// of its own.
const OPEN_TIMEOUT: Duration = Duration::from_secs(60);

/// The name of the thread that opens a device.
pub const OPEN_THREAD_NAME: &str = "open device";

/// Opens a device on a thread that is abandoned if the driver hangs, as that of an H200 (580.159) did while a shader of
/// another process ran endlessly.
pub fn open_with_timeout<T: Send + 'static>(
    open: impl FnOnce() -> Result<T, GpuError> + Send + 'static,
) -> Result<T, GpuError> {
    open_within(OPEN_TIMEOUT, open)
}

fn open_within<T: Send + 'static>(
    limit: Duration,
    open: impl FnOnce() -> Result<T, GpuError> + Send + 'static,
) -> Result<T, GpuError> {
    let (sender, receiver) = channel();
    let thread = std::thread::Builder::new().name(OPEN_THREAD_NAME.into()).spawn(move || drop(sender.send(open())));
    let thread = thread.map_err(|error| GpuError::NoAdapter(format!("no thread could be started: {error}")))?;
    match receiver.recv_timeout(limit) {
        Ok(opened) => opened,
        Err(RecvTimeoutError::Timeout) => Err(GpuError::NoAnswer { secs: limit.as_secs() }),
        // The driver crashed the thread.
        Err(RecvTimeoutError::Disconnected) => match thread.join() {
            Err(panic) => resume_unwind(panic),
            Ok(()) => Err(GpuError::NoAdapter("the driver ended the thread that opened it".into())),
        },
    }
}

/// Returns whether a panic is wgpu's report of a lost device: wgpu 30 returns errors of a poll, except this one
/// (`wgpu_core.rs`, `Device::poll`, whose other errors are fatal).
pub fn is_loss(panic: &str) -> bool {
    panic.starts_with("Error in Device::poll") && panic.contains("device is lost")
}

/// Polls a device. Returns an error if it was lost.
pub(crate) fn poll(device: &wgpu::Device, how: wgpu::PollType) -> Result<(), String> {
    caught(|| until_done(|| device.poll(how.clone())))
}

/// The number of waits without a timeout that time out: on OpenGL each ends after 2^31 ns, although the device still
/// draws, and at once, with the same error, if the driver cannot wait (`wgpu-hal/src/gles/fence.rs`, `wait`). Together
/// they are ten minutes or three seconds.
const WAITS: usize = 300;
const WAIT_DELAY: Duration = Duration::from_millis(10);

/// Polls until there is an answer.
fn until_done(mut poll: impl FnMut() -> Result<wgpu::PollStatus, wgpu::PollError>) -> Result<(), String> {
    for _ in 1..WAITS {
        match poll() {
            Err(wgpu::PollError::Timeout) => std::thread::sleep(WAIT_DELAY),
            done => return done.map(drop).map_err(|error| error.to_string()),
        }
    }
    poll().map(drop).map_err(|error| error.to_string())
}

fn caught(poll: impl FnOnce() -> Result<(), String>) -> Result<(), String> {
    catch_unwind(AssertUnwindSafe(poll)).unwrap_or_else(|panic| match panic.downcast_ref::<String>() {
        Some(text) if is_loss(text) => Err("the driver has reset it".into()),
        _ => resume_unwind(panic),
    })
}

/// Reopens a device after a loss, with retries until it succeeds or `patience` has elapsed; the attempts themselves may
/// exceed that. A driver that does not answer is not retried.
pub fn reopen<T>(patience: Duration, mut open: impl FnMut() -> Result<T, GpuError>) -> Result<T, GpuError> {
    for _ in 0..patience.as_millis() / RETRY_DELAY.as_millis() {
        match open() {
            Err(GpuError::NoAnswer { secs }) => return Err(GpuError::NoAnswer { secs }),
            Err(_) => std::thread::sleep(RETRY_DELAY),
            opened => return opened,
        }
    }
    open()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text as observed on an H100 with driver 580.159.
    const LOST: &str = "Error in Device::poll: Validation Error\n\nCaused by:\n  Parent device is lost\n";

    #[test]
    fn polling_a_lost_device_is_an_error_and_other_panics_are_resumed() {
        assert!(caught(|| panic!("{LOST}")).unwrap_err().contains("reset"));
        assert_eq!(caught(|| Ok(())), Ok(()));
        for other in ["Error in Device::poll: Validation Error\n\nCaused by:\n  out of memory\n", "device is lost"] {
            assert!(!is_loss(other));
            assert!(catch_unwind(|| caught(|| panic!("{other}"))).is_err());
        }
    }

    #[test]
    fn a_wait_that_times_out_goes_on() {
        let mut polls = 0;
        let done = until_done(|| {
            polls += 1;
            if polls < 4 { Err(wgpu::PollError::Timeout) } else { Ok(wgpu::PollStatus::QueueEmpty) }
        });
        assert_eq!((done, polls), (Ok(()), 4));
        assert!(until_done(|| Err(wgpu::PollError::WrongSubmissionIndex(2, 1))).is_err());
        let mut polls = 0;
        let failed = until_done(|| {
            polls += 1;
            Err(wgpu::PollError::Timeout)
        });
        assert_eq!((failed.is_err(), polls), (true, WAITS));
    }

    #[test]
    fn opening_a_device_is_retried_during_a_driver_reset() {
        let mut tries = 0;
        let opened = reopen(RESET_TIMEOUT, || {
            tries += 1;
            if tries < 3 { Err(GpuError::Lost(String::new())) } else { Ok(tries) }
        });
        assert!(matches!(opened, Ok(3)));
        let refused = |patience, error: fn() -> GpuError| {
            let mut tries = 0;
            let refused: Result<(), GpuError> = reopen(patience, || {
                tries += 1;
                Err(error())
            });
            (refused.unwrap_err().to_string(), tries)
        };
        assert_eq!(refused(Duration::ZERO, || GpuError::Lost(String::new())).1, 1);
        let (hangs, tries) = refused(RESET_TIMEOUT, || GpuError::NoAnswer { secs: 60 });
        assert!(hangs.contains("60 s") && tries == 1, "{hangs}: {tries}");
    }

    #[test]
    fn a_driver_that_hangs_is_abandoned() {
        let (_never, waits) = channel::<()>();
        let opened = open_within(Duration::from_millis(20), move || {
            let _ = waits.recv();
            Ok(())
        });
        assert!(matches!(opened, Err(GpuError::NoAnswer { .. })));
        assert!(matches!(open_within(OPEN_TIMEOUT, || Ok(7)), Ok(7)));
        assert!(catch_unwind(|| open_within(OPEN_TIMEOUT, || -> Result<(), GpuError> { panic!("driver") })).is_err());
    }
}
