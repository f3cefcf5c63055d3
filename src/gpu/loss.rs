//! A device that is lost: what wgpu makes of it, and another in its place.

use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    time::Duration,
};

/// Time for which another device is asked for while the driver resets the lost one. An H100 (driver 580.159) answered with
/// `DEVICE_LOST` after a hang; how long a reset takes was not measured.
pub const RESET: Duration = Duration::from_secs(5);
/// The time between two tries.
const PAUSE: Duration = Duration::from_millis(250);

/// Returns whether a panic is wgpu's way to say that the device was lost: wgpu 30 returns errors of a poll, but for this
/// one (`wgpu_core.rs`, `Device::poll`, whose other errors are fatal).
pub fn is_loss(panic: &str) -> bool {
    panic.starts_with("Error in Device::poll") && panic.contains("device is lost")
}

/// Polls a device. Err: it was lost.
pub(crate) fn poll(device: &wgpu::Device, how: wgpu::PollType) -> Result<(), String> {
    caught(|| device.poll(how).map(drop).map_err(|error| error.to_string()))
}

fn caught(poll: impl FnOnce() -> Result<(), String>) -> Result<(), String> {
    catch_unwind(AssertUnwindSafe(poll)).unwrap_or_else(|panic| match panic.downcast_ref::<String>() {
        Some(text) if is_loss(text) => Err("the driver has reset it".into()),
        _ => resume_unwind(panic),
    })
}

/// Opens another device in the place of a lost one: again and again until it is there or `patience` is over, which the
/// tries themselves may exceed.
pub fn reopen<T, E>(patience: Duration, mut open: impl FnMut() -> Result<T, E>) -> Result<T, E> {
    for _ in 0..patience.as_millis() / PAUSE.as_millis() {
        match open() {
            Err(_) => std::thread::sleep(PAUSE),
            opened => return opened,
        }
    }
    open()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text as an H100 brought it up, with driver 580.159.
    const LOST: &str = "Error in Device::poll: Validation Error\n\nCaused by:\n  Parent device is lost\n";

    #[test]
    fn a_poll_of_a_lost_device_is_an_error_and_any_other_panic_goes_on() {
        assert!(caught(|| panic!("{LOST}")).unwrap_err().contains("reset"));
        assert_eq!(caught(|| Ok(())), Ok(()));
        for other in ["Error in Device::poll: Validation Error\n\nCaused by:\n  out of memory\n", "device is lost"] {
            assert!(!is_loss(other));
            assert!(catch_unwind(|| caught(|| panic!("{other}"))).is_err());
        }
    }

    #[test]
    fn a_device_is_opened_again_while_the_driver_resets_it() {
        let mut tries = 0;
        let opened = reopen(RESET, || {
            tries += 1;
            if tries < 3 { Err("lost") } else { Ok(tries) }
        });
        assert_eq!(opened, Ok(3));
        let mut tries = 0;
        let refused: Result<(), &str> = reopen(Duration::ZERO, || {
            tries += 1;
            Err("lost")
        });
        assert_eq!((refused, tries), (Err("lost"), 1));
    }
}
