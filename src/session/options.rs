//! The settings that a session starts with, and the reasons why it may not start.

use super::drawing;
use eddy_audio::host::AudioHost;
use eddy_control::{midi::host::MidiHost, pads::PadHost};
use eddy_engine::EngineError;
use eddy_playback::trial::TrialSettings;
use eddy_video::CameraSource;
use std::{path::PathBuf, sync::Arc, time::Duration};

/// Holds how a session is set up. The defaults are what the window uses, but for recovery files.
#[derive(Clone, Debug)]
pub struct SessionOptions {
    /// The longest quiet time after the last keystroke before a compile. It is shorter where compiling is fast, down to
    /// none.
    pub edit_debounce: Duration,
    /// Quiet time after the last change on disk before a reload.
    pub watch_debounce: Duration,
    /// The time for which files that make no whole project are read again before the user hears of it: an editor may be
    /// half way through writing them.
    pub retry_for: Duration,
    /// The folder for pictures of a project that has none of its own.
    pub pictures: PathBuf,
    /// The user's own copies of the site's textures.
    pub media_dir: Option<PathBuf>,
    /// The camera that is used where a person turns one on and chooses none.
    pub camera: CameraSource,
    /// The folder for recovery files; `None`: unsaved work ends with the process. The window's is
    /// [`recovery_folder`](super::recovery_folder).
    pub recovery: Option<PathBuf>,
    /// Draw on a thread and a device of their own, so that no tick waits for a frame. Off, each frame is drawn in the
    /// tick that it is due in.
    pub draws_on_thread: bool,
    /// A frame that is drawn apart and takes longer pauses the picture.
    pub frame_limit: Duration,
    /// The settings of trials of large programs in a process of their own, where the driver compiles on the processor;
    /// without, there are none.
    pub trials: Option<TrialSettings>,
    /// The folder for what is remembered between two starts; without, nothing is.
    pub state_dir: Option<PathBuf>,
    /// The folder for what can be made again, as small pictures of projects; without, nothing is.
    pub cache_dir: Option<PathBuf>,
    /// The sound of the machine; without, nothing is heard and nothing recorded.
    pub audio: Option<Arc<dyn AudioHost>>,
    /// The MIDI of the machine; without, no control of a MIDI device moves anything.
    pub midi: Option<Arc<dyn MidiHost>>,
    /// The gamepads of the machine; without, channels that read them read zeros.
    pub gamepads: Option<Arc<dyn PadHost>>,
    /// Open devices of sound and MIDI on threads of their own, so that no tick waits for one. Off, ticks open them.
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
            frame_limit: Duration::from_secs(2),
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

/// The session cannot start.
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
