//! The device for tests, and the reporting of skipped tests.

use crate::{AdapterChoice, Gpu, GpuOptions};
use std::{fs::OpenOptions, io::Write};

/// Returns a device, or reports a skipped test and returns `None`. If `EDDY_REQUIRE_GPU` is set, a missing device is a
/// failure.
pub fn gpu() -> Option<Gpu> {
    gpu_with(&GpuOptions::default())
}

/// Does the same as [`gpu`], with other options.
pub fn gpu_with(options: &GpuOptions) -> Option<Gpu> {
    let error = match Gpu::new(options) {
        Ok(gpu) => return Some(gpu),
        Err(error) => error,
    };
    assert!(std::env::var_os("EDDY_REQUIRE_GPU").is_none(), "a device is required here: {error}");
    skipped(&error.to_string());
    None
}

/// Returns a device with the limits of the weakest ones that Eddy is made for: those of OpenGL ES 3.0 with textures of
/// 4,096 texels, as on a Raspberry Pi 4, and 32 bytes per sample and no filtering of 32-bit floats, as on Apple's first
/// GPUs.
pub fn weak_gpu() -> Option<Gpu> {
    let limits = wgpu::Limits {
        max_texture_dimension_1d: 4096,
        max_texture_dimension_2d: 4096,
        max_color_attachment_bytes_per_sample: 32,
        ..wgpu::Limits::downlevel_webgl2_defaults()
    };
    let limits = Some(limits);
    gpu_with(&GpuOptions { limits, use_float32_filtering: false, use_timestamps: false, ..GpuOptions::default() })
}

/// Returns a device on OpenGL, or reports a skipped test and returns `None`.
pub fn opengl() -> Option<Gpu> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::GL;
    let opened = AdapterChoice::default()
        .choose(&wgpu::Instance::new(descriptor), None)
        .and_then(|adapter| Gpu::from_adapter(&adapter, &GpuOptions::default()).map_err(|error| error.to_string()));
    opened.map_err(|error| skipped(&format!("no OpenGL: {error}"))).ok()
}

/// Makes a device refuse everything from now on, as one does that the driver has reset.
pub fn lose(gpu: &Gpu) {
    gpu.device.destroy();
    gpu.mark_lost();
}

/// Reports a test that is skipped because a program is not installed. If `EDDY_REQUIRE_GPU` is set, that is a failure:
/// `scripts/test` installs the program.
pub fn missing(program: &str) {
    assert!(std::env::var_os("EDDY_REQUIRE_GPU").is_none(), "{program} is required here");
    skipped(&format!("{program} is not installed"));
}

/// Reports a test, or a part of it, as skipped: on standard error, bypassing the harness, and in the file that
/// `EDDY_SKIPS` names, whose lines `scripts/test` counts.
pub fn skipped(why: &str) {
    let line = format!("{}: {why}\n", std::thread::current().name().unwrap_or("a test"));
    let _ = write!(std::io::stderr(), "SKIPPED {line}");
    if let Some(path) = std::env::var_os("EDDY_SKIPS") {
        let mut file = OpenOptions::new().append(true).create(true).open(path).unwrap();
        file.write_all(line.as_bytes()).unwrap();
    }
}
