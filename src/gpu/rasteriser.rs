//! The differences between a GPU and a processor that draws.
//!
//! A software rasteriser, such as lavapipe or SwiftShader, shares cores and memory with the rest of the program. Only
//! this module knows what follows from that. For a GPU its methods have no effect, or return what holds for a separate
//! device.

use super::{Gpu, GpuOptions};
use std::time::Duration;

/// A software rasteriser draws squares with this many pixels a side, each on one core.
const SQUARE: u32 = 64;
/// The number of pixels that a GPU draws at once is unknown. A frame takes at least this many times as long as a tile.
const FRAME_PER_TILE: f64 = 4.0;
/// A software rasteriser starts threads of its own for each device. More devices than this are no faster.
const MAX_DEVICES: usize = 4;
/// The nice value that drawing threads get, so that input and painting are handled first.
const NICE: i32 = 5;
/// The nice value of threads that draw in the background.
const NICE_IN_BACKGROUND: i32 = 10;

/// The part of the machine that draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rasteriser {
    /// The processor's cores if it draws; `None` for a GPU.
    cores: Option<usize>,
}

impl Rasteriser {
    /// A GPU.
    pub const GPU: Self = Self { cores: None };

    /// The processor, with all of its cores.
    pub fn software() -> Self {
        Self { cores: Some(std::thread::available_parallelism().map_or(1, |n| n.get())) }
    }

    /// Returns whether frames are drawn by the processor that also runs the program.
    pub fn shares_processor(self) -> bool {
        self.cores.is_some()
    }

    /// Lowers the priority of the calling thread, which draws what the user waits for.
    pub fn lower_thread_priority(self) {
        if self.cores.is_some() {
            lower_thread_priority(NICE);
        }
    }

    /// Lowers the priority of the calling thread, which draws in the background.
    pub fn lower_background_priority(self) {
        if self.cores.is_some() {
            lower_thread_priority(NICE_IN_BACKGROUND);
        }
    }

    /// Returns the rows of a band of a frame that took `took`, so that a band takes about `band` and more urgent work
    /// can run between two; `None` for a frame that is drawn at once.
    pub fn band_rows(self, height: u32, took: Duration, band: Duration) -> Option<u32> {
        self.cores?;
        let bands = (took.as_secs_f64() / band.as_secs_f64()).round().clamp(1.0, f64::from(height.max(1)));
        let rows = height.div_ceil(bands as u32).next_multiple_of(SQUARE);
        (rows < height).then_some(rows)
    }

    /// Returns the ratio of the time of a frame to that of a tile in its corner, both with their sizes. For a GPU it is
    /// the least that is to be expected.
    pub fn frame_per_tile(self, tile: (u32, u32), frame: (u32, u32)) -> f64 {
        let Some(cores) = self.cores else { return FRAME_PER_TILE };
        let pixels = |(width, height): (u32, u32)| f64::from(width) * f64::from(height);
        let squares =
            |(width, height): (u32, u32)| f64::from(width.div_ceil(SQUARE)) * f64::from(height.div_ceil(SQUARE));
        let at_once = |size| (cores as f64).min(squares(size));
        ((pixels(frame) / at_once(frame)) / (pixels(tile) / at_once(tile))).max(1.0)
    }

    /// Returns the number of devices that draw independent small frames fastest. The processor mostly waits for its own
    /// threads then, so there is one device for each core.
    pub fn parallel_devices(self) -> usize {
        self.cores.map_or(1, |cores| cores.min(MAX_DEVICES))
    }

    /// Returns the bytes that textures of this size take of the program's memory.
    pub fn shared_memory(self, texture_bytes: u64) -> u64 {
        if self.cores.is_some() { texture_bytes } else { 0 }
    }

    /// Returns whether timestamps measure passes. Those of a software rasteriser do not include all of its threads.
    pub fn has_exact_timestamps(self) -> bool {
        self.cores.is_none()
    }
}

impl Gpu {
    /// Returns what draws on this device.
    pub fn rasteriser(&self) -> Rasteriser {
        let is_software = self.info.device_type == wgpu::DeviceType::Cpu && !self.treat_as_gpu;
        if is_software { Rasteriser::software() } else { Rasteriser::GPU }
    }

    /// Returns the device for work beside the window, such as films, the sound pass and thumbnails. On a GPU it is this
    /// one: each further device takes 50 to 200 MB of the driver's memory. Where the processor draws, it is another one,
    /// whose threads inherit the priority of the calling thread; if there is none, it is this one, too.
    pub fn for_background(&self) -> Gpu {
        if !self.rasteriser().shares_processor() {
            return self.clone();
        }
        Gpu::on_adapter(&self.info, &GpuOptions::default()).unwrap_or_else(|error| {
            log::warn!(
                "work in the background shares the window's device, as another one could not be opened: {error}"
            );
            self.clone()
        })
    }
}

/// Lowers the priority of the calling thread. On Linux the priority is per thread, and threads that a driver starts for
/// it inherit it.
#[cfg(target_os = "linux")]
fn lower_thread_priority(steps: i32) {
    if let Err(error) = rustix::process::nice(steps) {
        log::debug!("a thread keeps its priority: {error}");
    }
}

/// Lowers the priority of the calling thread. Windows has two steps below the normal priority, and threads that a
/// driver starts do not inherit it.
#[cfg(windows)]
fn lower_thread_priority(steps: i32) {
    use windows_sys::Win32::System::Threading::{
        GetCurrentThread, SetThreadPriority, THREAD_PRIORITY_BELOW_NORMAL, THREAD_PRIORITY_LOWEST,
    };
    let priority = if steps < NICE_IN_BACKGROUND { THREAD_PRIORITY_BELOW_NORMAL } else { THREAD_PRIORITY_LOWEST };
    // SAFETY: the pseudo handle of the calling thread is always valid.
    if unsafe { SetThreadPriority(GetCurrentThread(), priority) } == 0 {
        log::debug!("a thread keeps its priority: {}", std::io::Error::last_os_error());
    }
}

/// On macOS a priority belongs to the process.
#[cfg(not(any(target_os = "linux", windows)))]
fn lower_thread_priority(_: i32) {}

/// Lowers the priority of the calling thread, which competes with the window even if a GPU draws.
pub fn lower_background_priority() {
    lower_thread_priority(NICE_IN_BACKGROUND);
}

#[cfg(test)]
mod tests {
    use super::*;

    const CPU: Rasteriser = Rasteriser { cores: Some(4) };
    const BAND: Duration = Duration::from_millis(12);

    #[test]
    fn gpu_draws_whole_frames_in_its_own_memory() {
        let gpu = Rasteriser::GPU;
        assert!(!gpu.shares_processor() && gpu.has_exact_timestamps());
        assert_eq!(gpu.band_rows(1080, Duration::from_secs(1), BAND), None);
        assert_eq!((gpu.parallel_devices(), gpu.shared_memory(99)), (1, 0));
        assert_eq!(gpu.frame_per_tile((24, 12), (1920, 1080)), FRAME_PER_TILE);
    }

    #[test]
    fn bands_are_whole_squares_of_about_the_wanted_time() {
        let rows = |height, millis| CPU.band_rows(height, Duration::from_millis(millis), BAND);
        assert_eq!([0, 12, 17].map(|millis| rows(400, millis)), [None; 3]);
        assert_eq!([24, 48, 5_000].map(|millis| rows(400, millis)), [Some(256), Some(128), Some(64)]);
        assert_eq!([rows(64, 5_000), rows(1, 5_000), rows(0, 5_000)], [None; 3]);
        assert_eq!(rows(16_384, u64::from(u32::MAX)), Some(64));
    }

    #[test]
    fn frame_per_tile_counts_squares_on_all_cores() {
        assert_eq!(CPU.frame_per_tile((64, 64), (128, 128)), 1.0, "four squares on four cores");
        assert_eq!(CPU.frame_per_tile((64, 64), (640, 640)), 25.0);
        assert_eq!((CPU.parallel_devices(), CPU.shared_memory(99)), (4, 99));
    }
}
