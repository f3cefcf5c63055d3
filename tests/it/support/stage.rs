//! A session without a window, ticked by the test, with a project's folder.

use eddy::{
    gpu::Gpu,
    project::{PassName, Tab},
    session::{
        CanvasCommand, CaptureCommand, Command, EditCommand, FileCommand, Level, Outcome, Session, SessionOptions,
        Tick, TransportCommand,
    },
};
use std::{
    fs,
    path::{Path, PathBuf},
    sync::Arc,
    time::{Duration, Instant},
};

pub(crate) fn image_tab() -> Tab {
    Tab::image()
}

/// Returns an Image pass of one colour.
pub(crate) fn plain(red: f32) -> String {
    format!("void mainImage(out vec4 o, in vec2 p) {{\n    o = vec4({red:?}, 0.0, 0.0, 1.0);\n}}\n")
}

pub(crate) struct Stage {
    pub session: Session,
    pub dir: tempfile::TempDir,
    frames: u32,
}

impl Stage {
    /// Opens a paused session of 8x4 pixels with the given files as a folder, and draws its first frame.
    pub(crate) fn open(gpu: Gpu, files: &[(&str, &str)]) -> Stage {
        let mut stage = Self::bare(gpu);
        for (name, text) in files {
            stage.write(name, text);
        }
        let folder = stage.folder();
        stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
        stage.session.apply(TransportCommand::Pause);
        stage.until_compiled();
        stage
    }

    pub(crate) fn bare(gpu: Gpu) -> Stage {
        Self::with_options(gpu, |_| SessionOptions::default())
    }

    /// Like [`Stage::bare`], with more options, which may name paths in the stage's own folder.
    pub(crate) fn with_options(gpu: Gpu, options: impl FnOnce(&Path) -> SessionOptions) -> Stage {
        let dir = tempfile::tempdir().unwrap();
        fs::create_dir(dir.path().join("project")).unwrap();
        let options = SessionOptions {
            pictures: dir.path().join("pictures"),
            retry_for: Duration::from_millis(400),
            ..options(dir.path())
        };
        let mut session = Session::with_options(gpu, Arc::new(|| ()), options).unwrap();
        session.apply(CanvasCommand::SetFixedSize(Some((8, 4))));
        Stage { session, dir, frames: 0 }
    }

    pub(crate) fn folder(&self) -> PathBuf {
        self.dir.path().join("project")
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder().join(name)
    }

    pub(crate) fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        fs::write(self.path(name), text).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}; {:?}", self.session.notices()))
    }

    pub(crate) fn tick(&mut self) -> Tick {
        let tick = self.session.tick(Instant::now());
        self.frames += u32::from(tick.frame_drawn);
        tick
    }

    /// Applies a command and ticks once.
    pub(crate) fn act(&mut self, command: Command) {
        self.session.apply(command);
        self.tick();
    }

    /// Applies a command and waits until the resulting program is compiled.
    pub(crate) fn compile(&mut self, command: Command) {
        self.session.apply(command);
        self.until_compiled();
    }

    /// Lets the watcher report files that were written before the session started to watch: ticks until no work is
    /// pending for a while.
    pub(crate) fn settle(&mut self) {
        let mut quiet = 0;
        while quiet < 15 {
            std::thread::sleep(Duration::from_millis(20));
            quiet = if self.tick().wake_at.is_none() { quiet + 1 } else { 0 };
        }
    }

    /// Returns the number of frames drawn so far.
    pub(crate) fn frames(&self) -> u32 {
        self.frames
    }

    /// Ticks until `condition` is true.
    pub(crate) fn until(&mut self, what: &str, condition: impl Fn(&Session) -> bool) {
        let end = Instant::now() + Duration::from_secs(30);
        while !condition(&self.session) {
            assert!(Instant::now() < end, "timed out waiting for {what}; notices: {:#?}", self.session.notices());
            self.tick();
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Ticks for a while, to check that something does not happen.
    pub(crate) fn for_a_while(&mut self) {
        let end = Instant::now() + Duration::from_millis(700);
        while Instant::now() < end {
            self.tick();
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    pub(crate) fn until_compiled(&mut self) {
        self.until("a finished compile", |s| !s.compile_state().compiling && s.compile_state().last.is_some());
        self.tick();
    }

    pub(crate) fn is_ok(&self) -> bool {
        matches!(self.session.compile_state().last, Some(Outcome::Ok { .. }))
    }

    pub(crate) fn edit(&mut self, text: &str) {
        self.session.apply(EditCommand::EditText { tab: image_tab(), text: text.into() });
    }

    pub(crate) fn notices(&self, level: Level) -> Vec<&str> {
        self.session.notices().iter().filter(|n| n.level == level).map(|n| n.text.as_str()).collect()
    }

    /// Returns the number of notices of any level with this prefix.
    pub(crate) fn count(&self, start: &str) -> usize {
        self.session.notices().iter().filter(|n| n.text.starts_with(start)).count()
    }

    /// Returns the red of the picture's first pixel, read from a screenshot.
    pub(crate) fn red(&mut self) -> u8 {
        let path = self.screenshot();
        image::open(&path).unwrap().to_rgba8().get_pixel(0, 0).0[0]
    }

    /// Ticks until the picture's first pixel has this red. A compile can start and end within one tick, so a test
    /// cannot wait for its start, only for its result.
    pub(crate) fn until_red(&mut self, red: u8) {
        let end = Instant::now() + Duration::from_secs(30);
        while self.red() != red {
            assert!(
                Instant::now() < end,
                "timed out waiting for a red of {red}; notices: {:#?}",
                self.session.notices()
            );
            self.for_a_while();
        }
    }

    pub(crate) fn screenshot(&mut self) -> PathBuf {
        let before = self.session.notices().len();
        self.session.apply(CaptureCommand::Screenshot);
        // A session that draws on a thread has it when the frame in flight is drawn.
        self.until("a notice of the picture", |s| s.notices().len() > before);
        let notice = self.session.notices().last().unwrap();
        assert!(notice.text.starts_with("saved "), "{}", notice.text);
        notice.path.clone().unwrap()
    }
}

/// Saves like many editors: writes a new file and renames it over the old one.
pub(crate) fn replace(path: &Path, text: &str) {
    let new = path.with_extension("tmp~");
    fs::write(&new, text).unwrap();
    fs::rename(new, path).unwrap();
}
