//! The times of operations on a device, by which counts become milliseconds.
//!
//! They are measured once: small programs, each with many operations of one class in a loop that no compiler can remove,
//! are drawn in turn, and their times taken apart by what they count ([`measure`]). The result is kept in a file for
//! this device and the version of its driver.

mod benches;
mod file;
mod fit;
mod measure;

pub use measure::measure;

use eddy_engine::{BuildError, counts::Prices};
use eddy_gpu::Gpu;
use std::path::Path;

/// Returns the prices of a device that are kept in a cache folder, or else usual ratios: for shares of a time.
pub fn kept_or_usual(gpu: &Gpu, cache_dir: Option<&Path>) -> Prices {
    let device = gpu.describe();
    cache_dir.and_then(|dir| file::read(&file::path(dir, &device), &device)).unwrap_or_default()
}

/// Returns the prices of a device: those that are kept in a cache folder, or else measured now, which takes some
/// seconds, and kept there. A folder that cannot be written is ignored: the next run measures again.
pub fn of_device(gpu: &Gpu, cache_dir: Option<&Path>) -> Result<Prices, BuildError> {
    let device = gpu.describe();
    let path = cache_dir.map(|dir| file::path(dir, &device));
    if let Some(kept) = path.as_ref().and_then(|path| file::read(path, &device)) {
        return Ok(kept);
    }
    let prices = measure(gpu)?;
    if let Some(path) = path
        && let Err(why) = file::write(&path, &prices)
    {
        log::warn!("cannot keep the prices of operations in {}: {why}", path.display());
    }
    Ok(prices)
}
