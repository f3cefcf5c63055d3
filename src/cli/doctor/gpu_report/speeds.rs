//! The speeds of the device that do not depend on a project: of a pass that only copies, and of pictures between the device
//! and the program.

use crate::{
    cli::{
        machine::{Machine, RunError, millis_since},
        report::Report,
    },
    gpu::{Readback, Texture, TextureDescriptor, TextureShape},
    lab::{Rig, cost},
    playback::median,
    texture::TexelFormat,
};

use serde::Serialize;
use std::time::Instant;

/// The sizes in pixels that are measured on every machine.
pub(super) const SIZES: [(u32, u32); 2] = [(1920, 1080), (3840, 2160)];

/// The number of measured transfers in each direction, after one that allocates.
const TRANSFERS: u32 = 5;

/// The speed of passes that copy rgba32f texels.
#[derive(Debug, Serialize)]
pub(super) struct Copy {
    pub size: (u32, u32),
    /// The bytes read and written per second.
    pub bytes_per_second: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

impl Copy {
    pub(super) fn measure(machine: &mut Machine, size: (u32, u32)) -> Self {
        let mut report = Report::new("copy");
        let bytes_per_second = machine.attempt(&mut report, |machine, _| {
            let rig = Rig::new(machine.gpu()?);
            // A software rasteriser takes tenths of a second for a pass.
            let (passes, turn_millis) = if rig.gpu().rasteriser().shares_processor() { (1, 1.0) } else { (16, 20.0) };
            cost::copied_bytes_per_second(&rig, size, passes, turn_millis)
                .map_err(|error| RunError::Other(error.into()))
        });
        Self { size, bytes_per_second, error: report.first_error() }
    }
}

/// The times of moving one picture of 8-bit RGBA between the program's memory and the device, in milliseconds. Each
/// includes a wait for the device.
#[derive(Debug, Serialize)]
pub(super) struct Transfer {
    size: (u32, u32),
    bytes: u64,
    upload_ms: Option<f64>,
    /// Includes the copy out of mapped memory.
    readback_ms: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

impl Transfer {
    pub(super) fn measure(machine: &mut Machine, size: (u32, u32)) -> Self {
        let mut report = Report::new("transfer");
        let (width, height) = size;
        let shape = TextureShape::flat(width, height, TexelFormat::Rgba8);
        let times = machine.attempt(&mut report, |machine, _| {
            let gpu = machine.gpu()?;
            let texture = Texture::new(&gpu, &TextureDescriptor { label: "transfer", shape, is_target: true })?;
            let mut readback = Readback::default();
            let picture = vec![0x5a; shape.bytes() as usize];
            let (mut uploads, mut readbacks) = (Vec::new(), Vec::new());
            for _ in 0..=TRANSFERS {
                let began = Instant::now();
                texture.write(&gpu, &picture);
                gpu.queue.submit([]);
                gpu.wait()?;
                uploads.push(millis_since(began));
                let began = Instant::now();
                let read = readback.rgba8(&gpu, &texture)?;
                readbacks.push(millis_since(began));
                if read != picture {
                    return Err(
                        anyhow::anyhow!("the picture that was read back is not the one that was uploaded").into()
                    );
                }
            }
            Ok((median(uploads.split_off(1)), median(readbacks.split_off(1))))
        });
        let (upload_ms, readback_ms) = times.unwrap_or_default();
        Self { size, bytes: shape.bytes(), upload_ms, readback_ms, error: report.first_error() }
    }
}
