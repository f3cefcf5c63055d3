//! Cameras: the newest picture of a camera, by ffmpeg.
//!
//! Pictures are read as fast as the camera delivers them, and each replaces the previous one: there is no queue. When a
//! camera ends or is unplugged, its last picture stays.

use super::{
    Frame, Tools, VideoError, check_size,
    ffmpeg::{LogLine, Message, messages},
    process::{self, Pipes, Stop},
};
use std::{
    fmt, fs,
    io::Read,
    path::Path,
    process::{Command, Stdio},
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError, mpsc::RecvTimeoutError},
    thread,
    time::{Duration, Instant},
};

/// The size of a channel before its camera is on, as on Shadertoy.
pub const PLACEHOLDER: (u32, u32) = (320, 240);
/// The size that is requested from a camera, as on Shadertoy: it may deliver another.
const ASKED: [&str; 4] = ["-framerate", "30", "-video_size", "1280x720"];

/// The selection of a camera.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum CameraSource {
    /// The first camera of the system.
    First,
    /// A camera by its name in the system: `/dev/video0`, `0`, `HD Webcam`.
    Device(String),
    /// A graph of ffmpeg's filters that produces pictures in place of a camera: `lavfi:testsrc`.
    Filters(String),
}

impl CameraSource {
    /// Parses the value of the command line's option.
    pub fn of_text(text: &str) -> CameraSource {
        match text.strip_prefix("lavfi:") {
            Some(filters) => CameraSource::Filters(filters.to_owned()),
            None if text.is_empty() => CameraSource::First,
            None => CameraSource::Device(text.to_owned()),
        }
    }
}

impl fmt::Display for CameraSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CameraSource::First => f.write_str("the camera"),
            CameraSource::Device(name) => f.write_str(name),
            CameraSource::Filters(filters) => write!(f, "lavfi:{filters}"),
        }
    }
}

/// A picture from a camera.
#[derive(Clone, Debug)]
pub struct CameraFrame {
    pub width: u32,
    pub height: u32,
    pub frame: Frame,
}

/// A camera that is on. It is turned off when its last handle is dropped.
#[derive(Clone)]
pub struct Camera(Arc<Owner>);

struct Owner {
    source: CameraSource,
    shared: Arc<Shared>,
}

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    came: Condvar,
    stop: Stop,
}

#[derive(Default)]
struct State {
    newest: Option<CameraFrame>,
    error: Option<VideoError>,
    found: Vec<CameraDevice>,
    is_closed: bool,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Owner {
    fn drop(&mut self) {
        self.shared.lock().is_closed = true;
        self.shared.stop.stop();
    }
}

impl PartialEq for Camera {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Debug for Camera {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Camera").field(&self.0.source).finish()
    }
}

impl Camera {
    /// Turns a camera on. Returns at once; pictures arrive later. `came` is called when the first one arrives, or when
    /// the camera fails.
    pub fn open(source: CameraSource, tools: &Tools, came: impl Fn() + Send + 'static) -> Camera {
        let shared = Arc::new(Shared::default());
        let worker = shared.clone();
        let (tools, wanted) = (tools.clone(), source.clone());
        let started = thread::Builder::new().name("camera".into()).spawn(move || {
            let mut ended = Err(VideoError::Camera("there is none".into()));
            // Some cameras refuse the requested size.
            for asked in [&ASKED[..], &[]] {
                ended = worker.read(&wanted, asked, &tools, &came);
                let state = worker.lock();
                if state.is_closed || state.newest.is_some() || matches!(ended, Err(VideoError::NoProgram { .. })) {
                    break;
                }
            }
            let mut state = worker.lock();
            if !state.is_closed {
                state.error = Some(ended.err().unwrap_or_else(|| VideoError::Camera("it has ended".into())));
            }
            drop(state);
            worker.came.notify_all();
            came();
        });
        if let Err(e) = started {
            shared.lock().error = Some(VideoError::Camera(e.to_string()));
        }
        Camera(Arc::new(Owner { source, shared }))
    }

    /// A camera that shows one picture: that of another camera in a frame that is drawn again.
    pub fn still(picture: CameraFrame) -> Camera {
        let state = State { newest: Some(picture), ..State::default() };
        let shared = Arc::new(Shared { state: Mutex::new(state), ..Shared::default() });
        Camera(Arc::new(Owner { source: CameraSource::First, shared }))
    }

    /// Turns it off even if other handles remain: the drawing thread may keep one for a while.
    pub fn turn_off(&self) {
        self.0.shared.lock().is_closed = true;
        self.0.shared.stop.stop();
    }

    pub fn source(&self) -> &CameraSource {
        &self.0.source
    }

    /// Returns the newest picture, if one has arrived.
    pub fn newest(&self) -> Option<CameraFrame> {
        self.0.shared.lock().newest.clone()
    }

    /// Returns the error if no more pictures will arrive.
    pub fn error(&self) -> Option<VideoError> {
        self.0.shared.lock().error.clone()
    }

    /// Returns the cameras of the machine; empty until this one has started, and for filters.
    pub fn found(&self) -> Vec<CameraDevice> {
        self.0.shared.lock().found.clone()
    }

    /// Waits for the first picture.
    pub fn wait(&self, patience: Duration) -> Result<CameraFrame, VideoError> {
        let give_up = Instant::now() + patience;
        let mut state = self.0.shared.lock();
        loop {
            if let Some(newest) = &state.newest {
                return Ok(newest.clone());
            }
            if let Some(error) = &state.error {
                return Err(error.clone());
            }
            let Some(wait) = give_up.checked_duration_since(Instant::now()) else {
                return Err(VideoError::Camera("it takes too long".into()));
            };
            let waited = self.0.shared.came.wait_timeout(state, wait);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

impl Shared {
    /// Reads pictures until there are no more.
    fn read(&self, source: &CameraSource, asked: &[&str], tools: &Tools, came: &impl Fn()) -> Result<(), VideoError> {
        let mut command = Command::new(&tools.ffmpeg);
        command.stdin(Stdio::null()).args(["-hide_banner", "-nostdin", "-nostats", "-loglevel", "info"]);
        command.args(["-fflags", "nobuffer"]);
        match source {
            CameraSource::Filters(filters) => command.args(["-re", "-f", "lavfi", "-i", filters]),
            CameraSource::Device(name) => device(&mut command, name, asked),
            CameraSource::First => {
                let Some(first) = cameras(tools).into_iter().next() else {
                    return Err(VideoError::Camera("this machine has none".into()));
                };
                device(&mut command, &first.id, asked)
            }
        };
        if !matches!(source, CameraSource::Filters(_)) {
            let found = cameras(tools);
            self.lock().found = found;
        }
        let old = tools.is_old();
        command.args(["-map", "0:v:0", "-an", "-vf"]);
        command.arg("scale=flags=bilinear+full_chroma_int+accurate_rnd,format=rgba,showinfo=checksum=0");
        command.args(if old { ["-vsync", "passthrough"] } else { ["-fps_mode", "passthrough"] });
        command.args(["-f", "rawvideo", "-pix_fmt", "rgba", "pipe:1"]);
        let Pipes { mut stdout, stderr, .. } = process::spawn(&mut command, &self.stop)?;
        let messages = messages(stderr);
        let said = |last: String| VideoError::Camera(if last.is_empty() { "it has ended".into() } else { last });
        let (width, height) = loop {
            match messages.recv_timeout(tools.patience) {
                Ok(Message::Line(LogLine::Frame(_, Some(size)))) => break size,
                Ok(Message::Line(_)) => {}
                Ok(Message::End(last)) => return Err(said(last)),
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {
                    self.stop.stop();
                    return Err(VideoError::Hangs { program: tools.ffmpeg.display().to_string() });
                }
            }
        };
        check_size(width, height)?;
        let mut is_first = true;
        loop {
            let mut texels = vec![0; width as usize * height as usize * 4];
            if stdout.read_exact(&mut texels).is_err() {
                break;
            }
            // Log lines of pictures that were read are no longer needed.
            while messages.try_recv().is_ok_and(|message| matches!(message, Message::Line(_))) {}
            let mut state = self.lock();
            if state.is_closed {
                return Ok(());
            }
            state.newest = Some(CameraFrame { width, height, frame: Frame { texels: Arc::new(texels) } });
            drop(state);
            self.came.notify_all();
            if std::mem::take(&mut is_first) {
                came();
            }
        }
        Err(VideoError::Camera("it has ended".into()))
    }
}

/// Adds a camera of the system to a command line.
fn device<'c>(command: &'c mut Command, name: &str, asked: &[&str]) -> &'c mut Command {
    if cfg!(target_os = "macos") {
        command.args(["-f", "avfoundation"]).args(asked).args(["-i", &format!("{name}:none")])
    } else if cfg!(windows) {
        command.args(["-f", "dshow"]).args(asked).args(["-i", &format!("video={name}")])
    } else {
        command.args(["-f", "v4l2"]).args(asked).args(["-i", name])
    }
}

/// A camera of the system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CameraDevice {
    /// The identifier for [`CameraSource::Device`].
    pub id: String,
    /// The display name.
    pub name: String,
}

/// Returns the cameras of the machine, without opening any.
pub fn cameras(tools: &Tools) -> Vec<CameraDevice> {
    if cfg!(target_os = "linux") {
        return of_folder(Path::new("/sys/class/video4linux"));
    }
    let mut command = Command::new(&tools.ffmpeg);
    command.stdin(Stdio::null()).args(["-hide_banner", "-nostdin"]);
    if cfg!(target_os = "macos") {
        command.args(["-f", "avfoundation", "-list_devices", "true", "-i", ""]);
    } else {
        command.args(["-f", "dshow", "-list_devices", "true", "-i", "dummy"]);
    }
    let said = process::messages_of(&mut command, tools).unwrap_or_default();
    if cfg!(target_os = "macos") { of_avfoundation(&said) } else { of_dshow(&said) }
}

/// Returns the cameras that Linux lists. Of a camera's nodes only the first delivers pictures.
fn of_folder(folder: &Path) -> Vec<CameraDevice> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut found: Vec<(u32, CameraDevice)> = entries
        .filter_map(|entry| {
            let node = entry.file_name().into_string().ok()?;
            let number = node.strip_prefix("video")?.parse().ok()?;
            let read = |name: &str| fs::read_to_string(entry.path().join(name)).map(|text| text.trim().to_owned());
            let is_first = read("index").map_or(true, |index| index == "0");
            let name = read("name").unwrap_or_else(|_| node.clone());
            is_first.then(|| (number, CameraDevice { id: format!("/dev/{node}"), name }))
        })
        .collect();
    found.sort_by_key(|(number, _)| *number);
    found.into_iter().map(|(_, device)| device).collect()
}

/// Parses the cameras in ffmpeg's list on macOS: `[AVFoundation indev @ 0x7f] [0] FaceTime HD Camera`.
fn of_avfoundation(said: &[String]) -> Vec<CameraDevice> {
    let lines = said.iter().skip_while(|line| !line.contains("video devices")).skip(1);
    let lines = lines.take_while(|line| !line.contains("audio devices"));
    let device = |line: &String| {
        let (id, name) = line.split_once("] [")?.1.split_once("] ")?;
        Some(CameraDevice { id: id.to_owned(), name: name.to_owned() })
    };
    lines.filter_map(device).collect()
}

/// Parses the cameras in ffmpeg's list on Windows: `[dshow @ 000001] "HD Webcam" (video)`.
fn of_dshow(said: &[String]) -> Vec<CameraDevice> {
    let device = |line: &String| {
        let name = line.strip_suffix(" (video)")?.split_once("] \"")?.1.strip_suffix('"')?;
        Some(CameraDevice { id: name.to_owned(), name: name.to_owned() })
    };
    said.iter().filter_map(device).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<String> {
        text.lines().map(str::to_owned).collect()
    }

    #[test]
    fn lists_of_cameras_are_read() {
        let mac = lines(
            "[AVFoundation indev @ 0x7f] AVFoundation video devices:\n[AVFoundation indev @ 0x7f] [0] FaceTime HD Camera\n\
             [AVFoundation indev @ 0x7f] [1] Capture screen 0\n[AVFoundation indev @ 0x7f] AVFoundation audio devices:\n\
             [AVFoundation indev @ 0x7f] [0] Microphone\n: Input/output error",
        );
        let names: Vec<_> = of_avfoundation(&mac).into_iter().map(|c| (c.id, c.name)).collect();
        assert_eq!(names, [("0".into(), "FaceTime HD Camera".into()), ("1".into(), "Capture screen 0".into())]);
        let windows = lines(
            "[dshow @ 01] \"HD Webcam\" (video)\n[dshow @ 01]   Alternative name \"@device\"\n[dshow @ 01] \"Mic\" (audio)",
        );
        assert_eq!(of_dshow(&windows), [CameraDevice { id: "HD Webcam".into(), name: "HD Webcam".into() }]);
        let folder = tempfile::tempdir().unwrap();
        for (node, index, name) in
            [("video10", "0", "B"), ("video0", "0", "A"), ("video1", "1", "A"), ("radio0", "0", "R")]
        {
            fs::create_dir(folder.path().join(node)).unwrap();
            fs::write(folder.path().join(node).join("index"), index).unwrap();
            fs::write(folder.path().join(node).join("name"), format!("{name}\n")).unwrap();
        }
        let found: Vec<_> = of_folder(folder.path()).into_iter().map(|c| format!("{} {}", c.id, c.name)).collect();
        assert_eq!(found, ["/dev/video0 A", "/dev/video10 B"]);
    }

    #[test]
    fn a_source_is_a_device_or_filters() {
        assert_eq!(CameraSource::of_text(""), CameraSource::First);
        assert_eq!(CameraSource::of_text("lavfi:testsrc=s=8x8"), CameraSource::Filters("testsrc=s=8x8".into()));
        assert_eq!(CameraSource::of_text("/dev/video2").to_string(), "/dev/video2");
    }
}
