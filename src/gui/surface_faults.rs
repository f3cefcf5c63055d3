//! Faults of the window's surface that a test requests: what a driver reports after a suspension, a change of the screen or
//! a reset.

use std::{env, fs, path::PathBuf};

/// The environment variable with the path of a file. When the file appears, it is removed, and the surface behaves as the
/// words in it say, one frame each: `lost`, `outdated`, `timeout` or `occluded`.
const VARIABLE: &str = "EDDY_TEST_SURFACE_FAULTS";

/// The requested faults that have not happened yet.
#[derive(Default)]
pub(super) struct Faults {
    file: Option<PathBuf>,
    /// The next one is the last.
    waiting: Vec<String>,
}

impl Faults {
    pub(super) fn of_environment() -> Self {
        Self { file: env::var_os(VARIABLE).map(PathBuf::from), waiting: Vec::new() }
    }

    /// Returns what the surface reports in place of a frame, if a fault is requested.
    pub(super) fn next(&mut self) -> Option<wgpu::CurrentSurfaceTexture> {
        let file = self.file.as_ref()?;
        if let Ok(words) = fs::read_to_string(file)
            && fs::remove_file(file).is_ok()
        {
            self.waiting = words.split_whitespace().rev().map(str::to_owned).collect();
        }
        match self.waiting.pop()?.as_str() {
            "lost" => Some(wgpu::CurrentSurfaceTexture::Lost),
            "outdated" => Some(wgpu::CurrentSurfaceTexture::Outdated),
            "timeout" => Some(wgpu::CurrentSurfaceTexture::Timeout),
            "occluded" => Some(wgpu::CurrentSurfaceTexture::Occluded),
            _ => None,
        }
    }
}
