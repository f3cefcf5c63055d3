//! The real window on a display of its own: Xvfb, the `eddy` binary with `--json`, xdotool for hands.

use super::skipped;
use serde_json::Value;
use std::{
    io::{BufRead, BufReader},
    path::Path,
    process::{Child, Command, Stdio},
    sync::mpsc::{Receiver, RecvTimeoutError, channel},
    time::{Duration, Instant},
};

/// The software driver paints slowly on a busy machine; a test waits for what it can see, never for a fixed time, and
/// gives up after this.
const PATIENCE: Duration = Duration::from_secs(60);
/// A window that says nothing for so long has come to rest.
const SETTLED: Duration = Duration::from_millis(400);

/// The file in the home folder that a window's standard error goes to.
pub const STANDARD_ERROR: &str = "stderr.txt";

/// A display that nobody sees. Ends with the value.
pub struct Display {
    server: Child,
    name: String,
}

impl Display {
    /// `None` after saying so where the machine has no Xvfb or xdotool; with `EDDY_REQUIRE_GPU=1` that is a failure.
    pub fn open() -> Option<Display> {
        let missing = ["Xvfb", "xdotool"].into_iter().find(|tool| {
            !Command::new("sh")
                .args(["-c", &format!("command -v {tool} >/dev/null")])
                .status()
                .is_ok_and(|s| s.success())
        });
        if let Some(tool) = missing {
            assert!(std::env::var_os("EDDY_REQUIRE_GPU").is_none(), "{tool} is required here");
            skipped(&format!("no {tool}"));
            return None;
        }
        // The server picks a free number and says which.
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-noreset", "-screen", "0", "1000x700x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut line).unwrap();
        Some(Display { server, name: format!(":{}", line.trim()) })
    }

    fn tool(&self, arguments: &[&str]) -> String {
        let output = Command::new("xdotool").env("DISPLAY", &self.name).args(arguments).output().unwrap();
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }

    /// A picture of the whole display, for a person to look at when something is wrong.
    pub fn photograph(&self, path: &Path) {
        let _ = Command::new("import").env("DISPLAY", &self.name).args(["-window", "root"]).arg(path).status();
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// A running `eddy` window.
pub struct Window<'a> {
    display: &'a Display,
    process: Child,
    lines: Receiver<Value>,
    /// Everything said so far.
    pub events: Vec<Value>,
    id: String,
    home: std::path::PathBuf,
}

impl<'a> Window<'a> {
    /// Opens a window with the given arguments, `home` being the home folder (and so where pictures go).
    pub fn open(display: &'a Display, home: &Path, arguments: &[&str]) -> Window<'a> {
        let runtime = home.join("runtime");
        std::fs::create_dir_all(&runtime).unwrap();
        let mut process = Command::new(env!("CARGO_BIN_EXE_eddy"))
            .args(["--json", "--size", "760x440"])
            .args(arguments)
            .env("DISPLAY", &display.name)
            .env_remove("WAYLAND_DISPLAY")
            .env("HOME", home)
            .env("XDG_RUNTIME_DIR", runtime)
            .env_remove("XDG_PICTURES_DIR")
            .current_dir(home)
            .stdout(Stdio::piped())
            .stderr(std::fs::File::create(home.join(STANDARD_ERROR)).unwrap())
            .spawn()
            .unwrap();
        let (sender, lines) = channel();
        let output = process.stdout.take().unwrap();
        std::thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if let Ok(value) = serde_json::from_str(&line)
                    && sender.send(value).is_err()
                {
                    break;
                }
            }
        });
        let mut window =
            Window { display, process, lines, events: Vec::new(), id: String::new(), home: home.to_owned() };
        window.wait_for("the window to start", |e| e["event"] == "started");
        window.id = {
            let pid = window.process.id().to_string();
            display.tool(&["search", "--sync", "--onlyvisible", "--pid", &pid]).lines().last().unwrap_or("").to_owned()
        };
        window.display.tool(&["windowfocus", "--sync", &window.id]);
        // Without a project the gallery covers the picture.
        let is_gallery = arguments.is_empty();
        window.wait_for("the first layout", |e| e["event"] == "layout" && (is_gallery || e["viewport"].is_array()));
        window
    }

    /// The first event from now on that fits; panics with what was said instead when patience ends.
    pub fn wait_for(&mut self, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
        let end = Instant::now() + PATIENCE;
        loop {
            match self.lines.recv_timeout(end.saturating_duration_since(Instant::now())) {
                Ok(event) => {
                    self.events.push(event.clone());
                    if fits(&event) {
                        return event;
                    }
                }
                Err(RecvTimeoutError::Timeout) => self.fail(&format!("waited in vain for {what}")),
                Err(RecvTimeoutError::Disconnected) => self.fail(&format!("the window ended while waiting for {what}")),
            }
        }
    }

    /// As [`Window::wait_for`], but an event that was said already counts too if it is the newest of its name.
    pub fn wait_until(&mut self, what: &str, name: &str, fits: impl Fn(&Value) -> bool) -> Value {
        self.drain();
        match self.newest(name) {
            Some(event) if fits(&event) => event,
            _ => self.wait_for(what, |e| e["event"] == name && fits(e)),
        }
    }

    /// Takes in what has been said meanwhile.
    pub fn drain(&mut self) {
        while let Ok(event) = self.lines.try_recv() {
            self.events.push(event);
        }
    }

    pub fn newest(&self, name: &str) -> Option<Value> {
        self.events.iter().rev().find(|e| e["event"] == name).cloned()
    }

    /// Frames that were told of after the newest layout.
    fn frames_since_layout(&self) -> usize {
        self.events.iter().rev().take_while(|e| e["event"] != "layout").filter(|e| e["event"] == "frame").count()
    }

    fn fail(&self, why: &str) -> ! {
        let shot = std::env::temp_dir().join(format!("eddy-window-{}.png", self.process.id()));
        self.display.photograph(&shot);
        let error = std::fs::read_to_string(self.home.join(STANDARD_ERROR)).unwrap_or_default();
        let tail: Vec<_> = self.events.iter().rev().take(12).rev().map(Value::to_string).collect();
        panic!("{why}; the display is in {}; last events:\n{}\n{error}", shot.display(), tail.join("\n"));
    }

    /// Where a named widget is: its centre, in pixels of the window.
    pub fn centre(&mut self, widget: &str) -> (i64, i64) {
        let name = widget.to_owned();
        let has = |e: &Value| e["rects"][&name].is_array();
        let mut layout = self.wait_until(&format!("the widget {widget}"), "layout", has);
        // A popup finds its place in its second frame: look again until nothing moves any more. While a picture plays
        // its frames tell, however far apart; a paused window says nothing when it has come to rest.
        let plays = |frame: Option<Value>| frame.is_some_and(|f| f["playing"] == true);
        let patience = if plays(self.newest("frame")) { PATIENCE } else { SETTLED };
        while let Ok(event) = self.lines.recv_timeout(patience) {
            self.events.push(event.clone());
            if event["event"] == "layout" && has(&event) {
                layout = event;
            } else if event["event"] == "frame" && self.frames_since_layout() > 2 {
                break;
            }
        }
        let r: Vec<i64> =
            layout["rects"][widget].as_array().unwrap().iter().map(|v| v.as_f64().unwrap() as i64).collect();
        (r[0] + r[2] / 2, r[1] + r[3] / 2)
    }

    /// The picture's place in the window: x, y, width, height.
    pub fn viewport(&mut self) -> [f64; 4] {
        self.drain();
        let layout = self.newest("layout").unwrap();
        std::array::from_fn(|i| layout["viewport"][i].as_f64().unwrap())
    }

    /// A point of the picture, from its bottom left, as fractions.
    pub fn picture_point(&mut self, u: f64, v: f64) -> (i64, i64) {
        let [x, y, width, height] = self.viewport();
        ((x + u * width) as i64, (y + (1.0 - v) * height) as i64)
    }

    pub fn move_to(&self, (x, y): (i64, i64)) {
        self.display.tool(&["mousemove", "--sync", "--window", &self.id, &x.to_string(), &y.to_string()]);
    }

    pub fn press(&self) {
        self.display.tool(&["mousedown", "1"]);
    }

    pub fn release(&self) {
        self.display.tool(&["mouseup", "1"]);
    }

    pub fn click(&self, at: (i64, i64)) {
        self.move_to(at);
        self.display.tool(&["click", "1"]);
    }

    pub fn click_on(&mut self, widget: &str) {
        let at = self.centre(widget);
        self.click(at);
    }

    /// Gives the window a size at once, without waiting for it to follow.
    pub fn resize(&self, width: u32, height: u32) {
        self.display.tool(&["windowsize", &self.id, &width.to_string(), &height.to_string()]);
    }

    /// The process has not ended.
    pub fn lives(&mut self) -> bool {
        self.process.try_wait().unwrap().is_none()
    }

    /// What the window has written to standard error.
    pub fn complaints(&self) -> String {
        std::fs::read_to_string(self.home.join(STANDARD_ERROR)).unwrap()
    }

    /// Presses and releases keys, in xdotool's names: `ctrl+z`, `F12`, `Left`.
    pub fn keys(&self, keys: &[&str]) {
        for key in keys {
            self.display.tool(&["key", "--clearmodifiers", key]);
        }
    }

    pub fn type_text(&self, text: &str) {
        self.display.tool(&["type", "--delay", "15", text]);
    }
}

impl Drop for Window<'_> {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
