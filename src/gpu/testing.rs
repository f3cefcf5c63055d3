//! The device that tests draw on, and how they say that there is none.

use crate::{Gpu, GpuOptions};
use std::{fs::OpenOptions, io::Write};

/// Returns a device, or `None` after saying so. Where `EDDY_REQUIRE_GPU` is set a missing device is a failure.
pub fn gpu() -> Option<Gpu> {
    gpu_with(&GpuOptions::default())
}

/// As [`gpu`], with other options.
pub fn gpu_with(options: &GpuOptions) -> Option<Gpu> {
    let error = match Gpu::new(options) {
        Ok(gpu) => return Some(gpu),
        Err(error) => error,
    };
    assert!(std::env::var_os("EDDY_REQUIRE_GPU").is_none(), "a device is required here: {error}");
    skipped(&error.to_string());
    None
}

/// Makes a device refuse everything from now on, as one does that the driver has reset.
pub fn lose(gpu: &Gpu) {
    gpu.device.destroy();
    gpu.mark_lost();
}

/// Says that a test is left out as a program is not installed. Where `EDDY_REQUIRE_GPU` is set that is a failure:
/// `scripts/test` installs the program.
pub fn missing(program: &str) {
    assert!(std::env::var_os("EDDY_REQUIRE_GPU").is_none(), "{program} is required here");
    skipped(&format!("{program} is not installed"));
}

/// Says that a test, or a part of it, is left out: on standard error, past the harness, and in the file that
/// `EDDY_SKIPS` names, whose lines `scripts/test` counts.
pub fn skipped(why: &str) {
    let line = format!("{}: {why}\n", std::thread::current().name().unwrap_or("a test"));
    let _ = write!(std::io::stderr(), "SKIPPED {line}");
    if let Some(path) = std::env::var_os("EDDY_SKIPS") {
        let mut file = OpenOptions::new().append(true).create(true).open(path).unwrap();
        file.write_all(line.as_bytes()).unwrap();
    }
}
