//! The options that all commands which draw frames share.

use super::elsewhere::HostProgram;
use super::values::{folder, fps, recording, seconds, size, webcam};
use crate::cli::tiles::Tiles;
use crate::{
    glsl::opt::PassSet,
    playback::{
        date,
        recording::Recording,
        script::{ScriptedInputs, parse_keys, parse_mouse},
    },
    video::CameraSource,
};
use clap::Args;
use jiff::civil::DateTime;
use std::{path::PathBuf, sync::Arc, time::Duration};

/// The default for frames per second of iTime.
pub(super) const DEFAULT_FPS: f64 = 60.0;

/// Says how frames are drawn, wherever frames are drawn.
#[derive(Clone, Debug, Args)]
pub(crate) struct RunArgs {
    /// Draw files as custom shaders of this program, with a stand-in for what it draws: ghostty, a terminal
    #[arg(long = "as", value_name = "PROGRAM")]
    pub guest: Option<HostProgram>,
    /// Resolution of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "640x360", value_parser = size, allow_hyphen_values = true)]
    pub size: (u32, u32),
    /// Frames per second of iTime, as in 25, 29.97 or 24000/1001 [default: 60, or 50 for a GIF, its limit]
    #[arg(long, value_name = "N", value_parser = fps, allow_hyphen_values = true)]
    pub fps: Option<f64>,
    /// Says that the format of the film decided the rate.
    #[arg(skip)]
    pub fps_note: Option<String>,
    /// Mouse events by frame, in pixels of the picture from the bottom left: "0:down 40,40; 4:move 80,45; 10:up"
    #[arg(long, value_name = "SCRIPT", default_value = "")]
    pub mouse: String,
    /// Key events by frame, with Shadertoy's key codes: "0:down 32; 3:up 32"
    #[arg(long, value_name = "SCRIPT", default_value = "")]
    pub keys: String,
    /// Date and time of frame 0; iDate advances from it with iTime [default: iDate is (0, 0, 0, iTime)]
    #[arg(long, value_name = "YYYY-MM-DDTHH:MM:SS", value_parser = date::parse)]
    pub date: Option<DateTime>,
    /// Replay a recording made with "Record input" in the window: each frame gets its recorded time, date, mouse, keys,
    /// resolution and uniforms
    #[arg(long, value_name = "FILE", value_parser = recording)]
    #[arg(conflicts_with_all = ["size", "mouse", "keys", "date"])]
    pub replay: Option<Arc<Recording>>,
    /// Folder with Shadertoy's textures, used instead of the built-in ones where a file name matches
    #[arg(long, value_name = "DIR", value_parser = folder)]
    pub media: Option<PathBuf>,
    /// Camera that webcam channels show: /dev/video0, 0 or a name as the system has it, or a test picture by ffmpeg as in
    /// lavfi:testsrc [default: none, black]
    #[arg(long, value_name = "CAMERA", value_parser = webcam)]
    pub webcam: Option<CameraSource>,
    /// Set a uniform declared by an #iUniform line, as in viscosity=0.3 or tint=1,0.5,0; may be repeated
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Draw all passes in all frames, even if not needed; the pictures stay the same
    #[arg(long)]
    pub no_skip: bool,
    /// Stop a project when a frame takes longer than this [default: no limit]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub frame_timeout: Option<Duration>,
    /// CPU time limit for compiling a large pass with a driver that compiles on the CPU [default: 8]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, allow_hyphen_values = true)]
    pub compile_timeout: Option<Duration>,
    /// Graphics adapter: a part of its name, high-performance or low-power [default: WGPU_ADAPTER_NAME, or high-performance]
    #[arg(long, value_name = "ADAPTER")]
    pub adapter: Option<String>,
    #[command(flatten)]
    pub without_pass: DisabledPasses,
    /// Not an option: `eddy render` sets it.
    #[arg(skip)]
    pub tiles: Tiles,
}

impl RunArgs {
    /// Returns the number of recorded frames, if a recording is replayed.
    pub(crate) fn recorded(&self) -> Option<u32> {
        let recording = self.replay.as_ref()?;
        Some(u32::try_from(recording.frames.len()).unwrap_or(u32::MAX))
    }

    /// Returns the size of the canvas in frame 0.
    pub(crate) fn canvas(&self) -> (u32, u32) {
        let first = self.replay.as_ref().and_then(|recording| recording.frames.first());
        first.map_or(self.size, |frame| frame.size)
    }

    /// Fails if a recording has fewer frames.
    pub(crate) fn within_recording(&self, frames: u32) -> Result<(), String> {
        match self.recorded() {
            Some(recorded) if recorded < frames => {
                Err(format!("--replay: {frames} frames were requested, but only {recorded} were recorded"))
            }
            _ => Ok(()),
        }
    }

    /// Does the same as [`Self::inputs`] for a run of this number of frames, which a recording must have.
    pub(crate) fn inputs_of(&self, frames: u32) -> Result<ScriptedInputs, String> {
        self.within_recording(frames)?;
        self.inputs()
    }

    /// Returns the frames per second of iTime.
    pub(crate) fn fps(&self) -> f64 {
        self.fps.unwrap_or(DEFAULT_FPS)
    }

    /// Returns the inputs of frames 0, 1, 2 … from the scripts, the date and the rate, or an error for an invalid
    /// script.
    pub(crate) fn inputs(&self) -> Result<ScriptedInputs, String> {
        let mouse = parse_mouse(&self.mouse).map_err(|e| format!("--mouse: {e}"))?;
        let keys = parse_keys(&self.keys).map_err(|e| format!("--keys: {e}"))?;
        Ok(ScriptedInputs::new(self.fps())
            .with_mouse(mouse)
            .with_keys(keys)
            .with_date(self.date)
            .with_replay(self.replay.clone()))
    }
}

/// Passes of the shader compiler's optimiser that are left out: for who works on it.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct DisabledPasses {
    /// Skip an optimisation; may be repeated
    #[arg(long = "without-pass", value_name = "NAME", value_parser = PassSet::of, hide = true)]
    passes: Vec<PassSet>,
}

impl DisabledPasses {
    pub(crate) fn set(&self) -> PassSet {
        self.passes.iter().fold(PassSet::default(), |all, &set| all.with(set))
    }
}
