//! The real window on a separate display: Xvfb, the `eddy` binary with `--json`, and xdotool for input.

pub(crate) use super::{display::Display, folder_of};
use serde_json::Value;
use std::{
    ffi::OsStr,
    io::{BufRead, BufReader},
    path::Path,
    process::{Child, Command, Stdio},
    sync::mpsc::{Receiver, RecvTimeoutError, channel},
    time::{Duration, Instant},
};

/// The software driver draws slowly on a busy machine; tests wait for visible results, never for a fixed time, and give
/// up after this.
const WAIT_TIMEOUT: Duration = Duration::from_secs(60);
/// The time within which a playing picture has its next frame, also on a busy machine; otherwise it has been paused.
const NEXT_FRAME: Duration = Duration::from_secs(10);
/// A window without events for this time has settled.
const SETTLED: Duration = Duration::from_millis(400);

/// The time within which a playing window has drawn its first frames, if it draws any.
const FIRST_FRAMES: Duration = Duration::from_secs(4);

/// The file in the home folder that receives a window's standard error.
pub(crate) const STANDARD_ERROR: &str = "stderr.txt";

/// A running `eddy` window.
pub(crate) struct Window<'a> {
    display: &'a Display,
    process: Child,
    lines: Receiver<Value>,
    /// All events so far.
    pub events: Vec<Value>,
    id: String,
    home: std::path::PathBuf,
}

impl<'a> Window<'a> {
    /// Opens a window with the given arguments and home folder, which also receives pictures.
    pub(crate) fn open(display: &'a Display, home: &Path, arguments: &[&str]) -> Window<'a> {
        Self::open_as(display, home, Some("760x440"), &[], arguments)
    }

    /// The same, with a size, or the size at which it was last closed, and with further environment variables.
    pub(crate) fn open_as(
        display: &'a Display,
        home: &Path,
        size: Option<&str>,
        environment: &[(&str, &str)],
        arguments: &[&str],
    ) -> Window<'a> {
        let mut window = Self::start(display, home, size, environment, arguments);
        // Without a project the gallery covers the picture.
        if !arguments.is_empty() {
            window.wait_until("the picture's place", "layout", |e| e["viewport"].is_array());
        }
        window
    }

    /// The same if the picture's panel may have been closed before.
    pub(crate) fn start(
        display: &'a Display,
        home: &Path,
        size: Option<&str>,
        environment: &[(&str, &str)],
        arguments: &[&str],
    ) -> Window<'a> {
        // `EDDY_BINARY` is another build, for example an optimised one.
        let program = std::env::var_os("EDDY_BINARY").unwrap_or_else(|| env!("CARGO_BIN_EXE_eddy").into());
        Self::start_program(&program, display, home, size, environment, arguments)
    }

    /// The same with another program, which takes the arguments of `eddy`.
    pub(crate) fn start_program(
        program: &OsStr,
        display: &'a Display,
        home: &Path,
        size: Option<&str>,
        environment: &[(&str, &str)],
        arguments: &[&str],
    ) -> Window<'a> {
        let runtime = home.join("runtime");
        std::fs::create_dir_all(&runtime).unwrap();
        // A slow frame on a busy machine must not pause.
        let has_limit = arguments.contains(&"--frame-timeout");
        let patient: &[&str] = if has_limit { &[] } else { &["--frame-timeout", "60"] };
        let mut process = Command::new(program)
            .arg("--json")
            .args(size.into_iter().flat_map(|size| ["--size", size]))
            .args(patient)
            .args(arguments)
            .env("DISPLAY", display.name())
            .env_remove("WAYLAND_DISPLAY")
            .env("HOME", home)
            .env("XDG_RUNTIME_DIR", runtime)
            .env_remove("DBUS_SESSION_BUS_ADDRESS")
            .envs(environment.iter().copied())
            .env_remove("XDG_PICTURES_DIR")
            .env_remove("XDG_CONFIG_HOME")
            .env_remove("XDG_STATE_HOME")
            .env_remove("XDG_CACHE_HOME")
            // No file dialogs of the desktop: no programs, and no portal (see above).
            .env("PATH", home.join("no-programs"))
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
        window.wait_until("the first layout", "layout", |_| true);
        window
    }

    /// Opens a window with a project and waits until it is compiled.
    pub(crate) fn open_project(display: &'a Display, home: &Path, project: &Path) -> Window<'a> {
        let mut window = Self::open(display, home, &[project.to_str().unwrap()]);
        window.wait_compiled();
        window
    }

    /// The same, with a window size.
    pub(crate) fn of_size(display: &'a Display, home: &Path, size: &str, project: &str) -> Window<'a> {
        let mut window = Self::open_as(display, home, Some(size), &[], &[project]);
        window.wait_compiled();
        window
    }

    /// Waits until the newest text of the project that was opened last is compiled without errors.
    pub(crate) fn wait_compiled(&mut self) {
        self.drain();
        let fits = |e: &Value| e["event"] == "compiled" && e["compiling"] == false && e["ok"] == true;
        let newest = self.events.iter().rev().find(|e| e["event"] == "compiled" || e["event"] == "opened");
        if !newest.is_some_and(fits) {
            self.wait_for("a compile", fits);
        }
    }

    /// Returns the first event from now on for which `fits` is true; panics with the last events after the timeout.
    pub(crate) fn wait_for(&mut self, what: &str, fits: impl Fn(&Value) -> bool) -> Value {
        let end = Instant::now() + WAIT_TIMEOUT;
        loop {
            match self.lines.recv_timeout(end.saturating_duration_since(Instant::now())) {
                Ok(event) => {
                    self.events.push(event.clone());
                    if fits(&event) {
                        return event;
                    }
                }
                Err(RecvTimeoutError::Timeout) => self.fail(&format!("timed out waiting for {what}")),
                Err(RecvTimeoutError::Disconnected) => self.fail(&format!("the window ended while waiting for {what}")),
            }
        }
    }

    /// Like [`Window::wait_for`], but also accepts the newest event of this name so far.
    pub(crate) fn wait_until(&mut self, what: &str, name: &str, fits: impl Fn(&Value) -> bool) -> Value {
        self.drain();
        match self.newest(name) {
            Some(event) if fits(&event) => event,
            _ => self.wait_for(what, |e| e["event"] == name && fits(e)),
        }
    }

    /// Waits until a named widget is shown.
    pub(crate) fn wait_shown(&mut self, widget: &str) {
        self.wait_until(&format!("{widget} to be shown"), "layout", |e| e["rects"][widget].is_array());
    }

    /// Waits until a named widget is hidden.
    pub(crate) fn wait_hidden(&mut self, widget: &str) {
        self.wait_until(&format!("{widget} to be hidden"), "layout", |e| e["rects"][widget].is_null());
    }

    /// Receives the pending events.
    pub(crate) fn drain(&mut self) {
        while let Ok(event) = self.lines.try_recv() {
            self.events.push(event);
        }
    }

    pub(crate) fn newest(&self, name: &str) -> Option<Value> {
        self.events.iter().rev().find(|e| e["event"] == name).cloned()
    }

    /// Returns the number of frame events after the newest layout.
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

    /// Returns the centre of a named widget, in pixels of the window.
    pub(crate) fn centre(&mut self, widget: &str) -> (i64, i64) {
        let r = self.rect(widget).map(|x| x as i64);
        (r[0] + r[2] / 2, r[1] + r[3] / 2)
    }

    /// Returns its rectangle: x, y, width, height.
    pub(crate) fn rect(&mut self, widget: &str) -> [f64; 4] {
        let name = widget.to_owned();
        let has = |e: &Value| e["rects"][&name].is_array();
        let mut layout = self.wait_until(&format!("the widget {widget}"), "layout", has);
        // A popup gets its position in its second frame: reads layouts until it does not move. While a picture plays,
        // its frame events show the progress, however far apart; a window that is paused, or covered by the gallery,
        // sends no events once it has settled.
        let is_halted = self.newest("halt").is_some_and(|halt| halt["kind"].is_string());
        let frame = self.newest("frame").filter(|frame| frame["playing"] == true && layout["viewport"].is_array());
        let timeout = match frame.filter(|_| !is_halted) {
            Some(frame) if frame["fps"].is_number() => NEXT_FRAME,
            // It is starting to play, or has no frame to draw.
            Some(_) => FIRST_FRAMES,
            None => SETTLED,
        };
        while let Ok(event) = self.lines.recv_timeout(timeout) {
            self.events.push(event.clone());
            if event["event"] == "layout" && has(&event) {
                layout = event;
            } else if event["event"] == "frame" && self.frames_since_layout() > 2 {
                break;
            }
        }
        std::array::from_fn(|i| layout["rects"][widget][i].as_f64().unwrap())
    }

    /// Returns the picture's rectangle in the window: x, y, width, height.
    pub(crate) fn viewport(&mut self) -> [f64; 4] {
        self.drain();
        let layout = self.newest("layout").unwrap();
        std::array::from_fn(|i| layout["viewport"][i].as_f64().unwrap())
    }

    /// Returns a point of the picture, from its bottom left, as fractions.
    pub(crate) fn picture_point(&mut self, u: f64, v: f64) -> (i64, i64) {
        let [x, y, width, height] = self.viewport();
        ((x + u * width) as i64, (y + (1.0 - v) * height) as i64)
    }

    pub(crate) fn move_to(&self, (x, y): (i64, i64)) {
        self.display.tool(&["mousemove", "--sync", "--window", &self.id, &x.to_string(), &y.to_string()]);
    }

    pub(crate) fn press(&self) {
        self.display.tool(&["mousedown", "1"]);
    }

    /// Turns the wheel by one step at the pointer.
    pub(crate) fn wheel(&self, up: bool) {
        self.display.tool(&["click", if up { "4" } else { "5" }]);
    }

    /// Clicks a mouse button at the pointer.
    pub(crate) fn button(&self, number: &str) {
        self.display.tool(&["click", number]);
    }

    pub(crate) fn release(&self) {
        self.display.tool(&["mouseup", "1"]);
    }

    /// Draws short strokes all over the picture, one move per frame, until this frame is drawn.
    pub(crate) fn draw_strokes_until(&mut self, frame: i64) {
        let mut step = 0;
        while self.newest("frame").is_none_or(|e| e["frame"].as_i64() < Some(frame)) {
            let at = |n: u32| 0.2 + 0.6 * f64::from(n * 37 % 100) / 100.0;
            let to = self.picture_point(at(step), at(step + 5));
            self.move_to(to);
            match step % 12 {
                1 => self.press(),
                9 => self.release(),
                _ => {}
            }
            self.wait_for("a frame", |e| e["event"] == "frame");
            step += 1;
        }
        self.release();
    }

    pub(crate) fn click(&self, at: (i64, i64)) {
        self.move_to(at);
        self.display.tool(&["click", "1"]);
    }

    /// Clicks while holding keys, in xdotool's names.
    pub(crate) fn click_holding(&self, keys: &[&str], at: (i64, i64)) {
        self.move_to(at);
        self.hold(keys);
        self.display.tool(&["click", "1"]);
        self.release_keys(keys);
    }

    /// Holds keys down.
    pub(crate) fn hold(&self, keys: &[&str]) {
        keys.iter().for_each(|key| drop(self.display.tool(&["keydown", key])));
    }

    pub(crate) fn release_keys(&self, keys: &[&str]) {
        keys.iter().for_each(|key| drop(self.display.tool(&["keyup", key])));
    }

    pub(crate) fn click_on(&mut self, widget: &str) {
        let at = self.centre(widget);
        self.click(at);
    }

    /// Requests a size, without waiting for the window to follow.
    pub(crate) fn ask_size(&self, width: u32, height: u32) {
        self.display.tool(&["windowsize", &self.id, &width.to_string(), &height.to_string()]);
    }

    /// Sets a size in pixels, and waits for the new layout: a click on a widget that is about to move would miss it.
    pub(crate) fn resize(&mut self, width: u32, height: u32) {
        self.ask_size(width, height);
        let is = |e: &Value, i: usize, pixels: u32| {
            let points = e["window"][i].as_f64().zip(e["pixels_per_point"].as_f64());
            points.is_some_and(|(points, scale)| (points * scale - f64::from(pixels)).abs() < 2.0)
        };
        self.wait_until("the new size", "layout", |e| is(e, 0, width) && is(e, 1, height));
    }

    /// Kills the process at once (SIGKILL), like a power cut.
    pub(crate) fn kill(mut self) {
        self.process.kill().unwrap();
        self.process.wait().unwrap();
    }

    /// Returns the CPU time of the window so far, on all cores.
    pub(crate) fn cpu_time(&self) -> Duration {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.process.id())).unwrap();
        // After the name in parentheses, which may contain any character: the 12th and 13th field, in hundredths of a
        // second.
        let fields = stat.rsplit_once(')').unwrap().1;
        let ticks: u64 = fields.split_whitespace().skip(11).take(2).map(|n| n.parse::<u64>().unwrap()).sum();
        Duration::from_millis(ticks * 10)
    }

    pub(crate) fn process_id(&self) -> u32 {
        self.process.id()
    }

    /// Returns the resident memory in bytes; 0 once the process has ended.
    pub(crate) fn resident(&self) -> u64 {
        let statm = std::fs::read_to_string(format!("/proc/{}/statm", self.process.id())).unwrap_or_default();
        statm.split_whitespace().nth(1).and_then(|pages| pages.parse::<u64>().ok()).unwrap_or(0) * 4096
    }

    /// Returns the peak resident memory so far, in bytes; 0 once the process has ended.
    pub(crate) fn peak_resident(&self) -> u64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.process.id())).unwrap_or_default();
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB"));
        peak.and_then(|kilobytes| kilobytes.parse::<u64>().ok()).unwrap_or(0) * 1024
    }

    /// Returns the X server's number of the window.
    pub(crate) fn number(&self) -> u32 {
        self.id.parse().unwrap()
    }

    /// Drops all events except the newest of each name.
    pub(crate) fn forget_all_but_newest(&mut self) {
        let mut named = std::collections::BTreeSet::new();
        let newest = self.events.drain(..).rev().filter(|e| named.insert(e["event"].to_string())).collect::<Vec<_>>();
        self.events.extend(newest.into_iter().rev());
    }

    /// Returns the title of the window.
    pub(crate) fn title(&self) -> String {
        self.display.tool(&["getwindowname", &self.id])
    }

    /// Waits for the process to end. Returns its exit code; `None` if a signal ended it, or on a timeout.
    pub(crate) fn wait_exit(&mut self) -> Option<i32> {
        let end = Instant::now() + WAIT_TIMEOUT;
        while Instant::now() < end {
            if let Some(status) = self.process.try_wait().unwrap() {
                return status.code();
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        None
    }

    /// Returns whether the process is running.
    pub(crate) fn is_running(&mut self) -> bool {
        self.process.try_wait().unwrap().is_none()
    }

    /// Returns the window's standard error.
    pub(crate) fn stderr(&self) -> String {
        std::fs::read_to_string(self.home.join(STANDARD_ERROR)).unwrap()
    }

    /// Presses and releases keys, in xdotool's names: `ctrl+z`, `F12`, `Left`.
    pub(crate) fn keys(&self, keys: &[&str]) {
        for key in keys {
            self.display.tool(&["key", "--clearmodifiers", key]);
        }
    }

    /// The same, while other keys are held.
    pub(crate) fn keys_as_held(&self, keys: &[&str]) {
        keys.iter().for_each(|key| drop(self.display.tool(&["key", key])));
    }

    /// Types a text and presses Return.
    pub(crate) fn submit(&self, text: &str) {
        self.type_text(text);
        self.keys(&["Return"]);
    }

    /// Pauses the picture and waits until it is paused.
    pub(crate) fn pause(&mut self) {
        self.keys(&["alt+Up"]);
        self.wait_until("the pause", "frame", |e| e["playing"] == false);
    }

    /// Replaces the content of the focused field and presses Return.
    pub(crate) fn enter(&self, text: &str) {
        self.keys(&["ctrl+a"]);
        self.submit(text);
    }

    /// Clicks on a field, replaces its content and presses Return.
    pub(crate) fn fill(&mut self, field: &str, text: &str) {
        self.click_on(field);
        self.enter(text);
    }

    /// Opens the palette and types in it.
    pub(crate) fn search_palette(&mut self, text: &str) {
        self.keys(&["ctrl+shift+p"]);
        self.wait_shown("field:palette");
        self.type_text(text);
    }

    /// Saves the project and waits until it is saved.
    pub(crate) fn save(&mut self) {
        self.keys(&["ctrl+s"]);
        self.wait_until("the save", "dirty", |e| e["dirty"] == false);
    }

    pub(crate) fn type_text(&self, text: &str) {
        self.display.tool(&["type", "--delay", "15", text]);
    }
}

impl Drop for Window<'_> {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
