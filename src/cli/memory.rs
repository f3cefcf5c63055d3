//! The available memory, so that a picture that does not fit is rejected with a message about its size. Otherwise the
//! system would kill the process.

use eddy_gpu::Rasteriser;

/// Pictures with fewer pixels are not checked: they need less memory than other programs do.
const LEAST_PIXELS: u64 = 1 << 24;

/// Returns the available bytes of memory; `None` if the system does not report them.
#[cfg(not(windows))]
pub(super) fn available() -> Option<u64> {
    use std::fs;
    let machine = fs::read_to_string("/proc/meminfo").ok().and_then(|text| of_meminfo(&text));
    let number = |name: &str| -> Option<u64> {
        fs::read_to_string(format!("/sys/fs/cgroup/memory.{name}")).ok()?.trim().parse().ok()
    };
    // A container's limit: without one, there is no number.
    let container = number("max").zip(number("current")).map(|(most, taken)| most.saturating_sub(taken));
    machine.into_iter().chain(container).min()
}

/// Returns the available bytes of memory; `None` if the system does not report them. Memory beyond the commit limit is not
/// allocated, and memory beyond the physical one is written to a disk.
#[cfg(windows)]
pub(super) fn available() -> Option<u64> {
    use windows_sys::Win32::System::SystemInformation::{GlobalMemoryStatusEx, MEMORYSTATUSEX};
    let mut status = MEMORYSTATUSEX { dwLength: size_of::<MEMORYSTATUSEX>() as u32, ..MEMORYSTATUSEX::default() };
    // SAFETY: the structure has the length that it says.
    let is_known = unsafe { GlobalMemoryStatusEx(&mut status) } != 0;
    is_known.then(|| status.ullAvailPhys.min(status.ullAvailPageFile))
}

/// Returns Linux's estimate of the memory that is available for new work (proc_meminfo(5), `MemAvailable`).
#[cfg(any(not(windows), test))]
fn of_meminfo(text: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok().map(|kibibytes| kibibytes << 10)
}

/// Fails for a picture that needs more than `available`, drawn and read in one piece. The textures of a software rasteriser
/// are in the same memory.
pub(super) fn check_whole(
    (width, height): (u32, u32),
    rasteriser: Rasteriser,
    available: Option<u64>,
) -> anyhow::Result<()> {
    let pixels = u64::from(width) * u64::from(height);
    // The pixels, the buffer that they are read through, and their bytes in a file; the target and the display texture.
    let needed =
        pixels.saturating_mul(16 + 16 + 4).saturating_add(rasteriser.shared_memory(pixels.saturating_mul(16 + 4)));
    match available.filter(|available| pixels > LEAST_PIXELS && needed > *available) {
        None => Ok(()),
        Some(available) => anyhow::bail!(
            "a picture of {width}x{height} pixels takes {} of memory in one piece, and {} are available: choose a smaller \
             resolution",
            gibibytes(needed),
            gibibytes(available)
        ),
    }
}

/// Formats a number of bytes for users.
pub(super) fn gibibytes(bytes: u64) -> String {
    format!("{:.1} GiB", bytes as f64 / (1u64 << 30) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linux_meminfo_is_parsed() {
        let text = "MemTotal:       16384 kB\nMemFree:         1024 kB\nMemAvailable:    8192 kB\n";
        assert_eq!(of_meminfo(text), Some(8192 << 10));
        assert_eq!(of_meminfo("MemTotal: 1 kB"), None);
    }

    #[test]
    #[cfg(any(target_os = "linux", windows))]
    fn the_machine_reports_its_memory() {
        let available = available().expect("it is reported");
        assert!((1 << 20..1 << 50).contains(&available), "{available}");
    }

    #[test]
    fn a_picture_that_does_not_fit_is_rejected_with_its_size() {
        let gib = Some(1 << 30);
        assert!(check_whole((3840, 2160), Rasteriser::software(), Some(0)).is_ok(), "small pictures are not checked");
        assert!(check_whole((16_384, 16_384), Rasteriser::software(), None).is_ok());
        let error = check_whole((16_384, 16_384), Rasteriser::software(), gib).unwrap_err().to_string();
        assert!(error.contains("16384x16384 pixels takes 14.0 GiB") && error.contains("1.0 GiB are"), "{error}");
        assert!(check_whole((16_384, 16_384), Rasteriser::GPU, Some(9 << 30)).is_ok());
    }
}
