//! A device that another thread opens.

use eddy_gpu::{Gpu, GpuError};
use std::sync::{Arc, OnceLock};

/// Holds the place where a device will be once it is open. Every clone is the same place.
#[derive(Clone, Default)]
pub struct Device(Arc<OnceLock<Result<Gpu, String>>>);

impl Device {
    /// A device that is open.
    pub fn open(gpu: Gpu) -> Self {
        let device = Self::default();
        device.set(Ok(gpu));
        device
    }

    /// Puts the device, or the reason why there is none, in its place. The first one counts.
    pub fn set(&self, gpu: Result<Gpu, String>) {
        let _ = self.0.set(gpu);
    }

    /// Waits until it is open.
    pub fn wait(&self) -> Result<Gpu, GpuError> {
        self.0.wait().clone().map_err(|reason| GpuError::NoDevice { adapter: "the machine".into(), reason })
    }
}
