//! The options that a session starts with, and the errors that prevent it from starting.

use super::drawing;
use eddy_audio::host::AudioHost;
use eddy_control::{midi::host::MidiHost, pads::PadHost};
use eddy_engine::EngineError;
use eddy_gpu::Rasteriser;
use eddy_playback::trial::TrialSettings;
use eddy_video::CameraSource;
use std::{path::PathBuf, sync::Arc, time::Duration};

/// The default of [`SessionOptions::frame_limit`].
pub const DEFAULT_FRAME_LIMIT: Duration = Duration::from_secs(2);
/// The limit that takes the place of the default where the system resets a GPU that has not answered for 2 s, as Windows
/// does (`TdrDelay`): the frame is halted before the device is lost.
const LIMIT_BEFORE_RESET: Duration = Duration::from_secs(1);

/// Returns the limit that is in effect for `limit`. One that differs from the default was chosen, and stays.
pub fn frame_limit(limit: Duration, rasteriser: Rasteriser, is_windows: bool) -> Duration {
    let resets = is_windows && !rasteriser.shares_processor();
    if resets && limit == DEFAULT_FRAME_LIMIT { LIMIT_BEFORE_RESET } else { limit }
}

/// The setup of a session. The defaults are those of the window, except for recovery files.
#[derive(Clone, Debug)]
pub struct SessionOptions {
    /// The longest debounce time between the last keystroke and a compile. It is shorter if compiling is fast, down to
    /// none.
    pub edit_debounce: Duration,
    /// Debounce time between the last change on disk and a reload.
    pub watch_debounce: Duration,
    /// The time for which incomplete projects are read again before the user is notified: an editor may still be
    /// writing them.
    pub retry_for: Duration,
    /// The folder for pictures of a project without a folder.
    pub pictures: PathBuf,
    /// The user's own copies of Shadertoy's textures.
    pub media_dir: Option<PathBuf>,
    /// The camera to use if the user turns one on without choosing.
    pub camera: CameraSource,
    /// The folder for recovery files; `None`: unsaved work is lost with the process. The window's is
    /// [`recovery_folder`](super::recovery_folder).
    pub recovery: Option<PathBuf>,
    /// Draw on a thread and a device of their own, so that no tick waits for a frame. If false, each frame is drawn in
    /// the tick in which it is due.
    pub draws_on_thread: bool,
    /// A frame drawn on the thread that takes longer pauses the picture. The default is shorter for a GPU on Windows: see
    /// [`frame_limit`].
    pub frame_limit: Duration,
    /// The settings for trial compiles of large programs in a separate process, if the driver compiles on the
    /// processor; `None` disables them.
    pub trials: Option<TrialSettings>,
    /// The folder for state that is kept between runs; `None`: none is kept.
    pub state_dir: Option<PathBuf>,
    /// The cache folder, such as for small pictures of projects; `None`: nothing is cached.
    pub cache_dir: Option<PathBuf>,
    /// The machine's sound; `None`: nothing is played or recorded.
    pub audio: Option<Arc<dyn AudioHost>>,
    /// The machine's MIDI; `None`: MIDI controls have no effect.
    pub midi: Option<Arc<dyn MidiHost>>,
    /// The machine's gamepads; `None`: channels that read them read zeros.
    pub gamepads: Option<Arc<dyn PadHost>>,
    /// Open sound and MIDI devices on threads of their own, so that no tick waits for one. If false, ticks open them.
    pub audio_on_thread: bool,
}

impl Default for SessionOptions {
    fn default() -> Self {
        Self {
            edit_debounce: Duration::from_millis(200),
            watch_debounce: Duration::from_millis(120),
            retry_for: Duration::from_secs(2),
            pictures: dirs::picture_dir().or_else(dirs::home_dir).unwrap_or_else(|| PathBuf::from(".")),
            media_dir: None,
            camera: CameraSource::First,
            recovery: None,
            draws_on_thread: false,
            frame_limit: DEFAULT_FRAME_LIMIT,
            trials: None,
            state_dir: None,
            cache_dir: None,
            audio: None,
            midi: None,
            gamepads: None,
            audio_on_thread: true,
        }
    }
}

/// The errors that prevent a session from starting.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error("cannot start a thread for compiling: {0}")]
    Thread(std::io::Error),
    #[error("cannot start a thread for drawing: {0}")]
    DrawingThread(std::io::Error),
}

impl From<drawing::Error> for SessionError {
    fn from(error: drawing::Error) -> Self {
        match error {
            drawing::Error::Engine(error) => Self::Engine(error),
            drawing::Error::Thread(error) => Self::DrawingThread(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn default_limit_is_below_the_reset_of_windows() {
        let secs = Duration::from_secs;
        assert_eq!(frame_limit(DEFAULT_FRAME_LIMIT, Rasteriser::GPU, true), secs(1));
        assert_eq!(frame_limit(DEFAULT_FRAME_LIMIT, Rasteriser::software(), true), secs(2));
        assert_eq!(frame_limit(DEFAULT_FRAME_LIMIT, Rasteriser::GPU, false), secs(2));
        assert_eq!(
            [secs(5), Duration::from_millis(500)].map(|limit| frame_limit(limit, Rasteriser::GPU, true)),
            [secs(5), Duration::from_millis(500)]
        );
    }
}
