//! A separate display for each test: Xvfb, with a window manager if one is installed.

use super::{missing, skipped};
use std::{
    io::{BufRead, BufReader},
    path::Path,
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};
use tempfile::TempDir;

/// A virtual display. Dropping it stops the server.
pub(crate) struct Display {
    server: Child,
    name: String,
    manager: Option<Manager>,
}

impl Display {
    /// Opens a display. Returns `None`, and counts a skipped test, if Xvfb or xdotool is missing; with
    /// `EDDY_REQUIRE_GPU=1` that is a failure.
    pub(crate) fn open() -> Option<Display> {
        Self::of_size(1000, 700)
    }

    /// The same, with a home folder for a window.
    pub(crate) fn with_home() -> Option<(Display, TempDir)> {
        Self::of_size_with_home(1000, 700)
    }

    pub(crate) fn of_size_with_home(width: u32, height: u32) -> Option<(Display, TempDir)> {
        Some((Self::of_size(width, height)?, tempfile::tempdir().unwrap()))
    }

    /// The same, with a screen of this size.
    pub(crate) fn of_size(width: u32, height: u32) -> Option<Display> {
        Self::with(width, height, false)
    }

    /// The same, with frames around windows, which then keep positions set by the user. Returns `None` without a window
    /// manager.
    pub(crate) fn with_frames(width: u32, height: u32) -> Option<Display> {
        let display = Self::with(width, height, true)?;
        if display.manager.is_none() {
            missing("openbox");
            return None;
        }
        Some(display)
    }

    fn with(width: u32, height: u32, has_frames: bool) -> Option<Display> {
        let absent = ["Xvfb", "xdotool"].into_iter().find(|tool| !is_installed(tool));
        if let Some(tool) = absent {
            missing(tool);
            return None;
        }
        // The server picks a free number and prints it. -r: keys do not repeat, however late they are released.
        let mut server = Command::new("Xvfb")
            .args([
                "-displayfd",
                "1",
                "-noreset",
                "-r",
                "-screen",
                "0",
                &format!("{width}x{height}x24"),
                "-nolisten",
                "tcp",
            ])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let name = format!(":{}", line.trim());
        let manager = Manager::start(&name, has_frames);
        Some(Display { server, name, manager })
    }

    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Returns whether windows are managed: they can fill the screen, and are maximised by Super+M and closed by
    /// Alt+F4.
    pub(crate) fn is_managed(&self) -> bool {
        self.manager.is_some()
    }

    /// Sets a keyboard layout, such as `de`. Returns false, and counts a skipped test, if the machine cannot.
    pub(crate) fn layout(&self, name: &str) -> bool {
        let set = Command::new("setxkbmap").env("DISPLAY", &self.name).arg(name).status();
        let is_set = set.is_ok_and(|status| status.success());
        if !is_set {
            skipped("no setxkbmap");
        }
        is_set
    }

    pub(crate) fn tool(&self, arguments: &[&str]) -> String {
        let output = Command::new("xdotool").env("DISPLAY", &self.name).args(arguments).output().unwrap();
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    }

    /// Saves a picture of the whole display, to diagnose a failure.
    pub(crate) fn photograph(&self, path: &Path) {
        let _ = Command::new("import").env("DISPLAY", &self.name).args(["-window", "root"]).arg(path).status();
    }

    /// Saves a picture of the whole display in the folder `EDDY_SHOTS`, to look at.
    pub(crate) fn shot(&self, name: &str) {
        if let Some(folder) = std::env::var_os("EDDY_SHOTS") {
            // Popups fade in.
            std::thread::sleep(Duration::from_millis(600));
            self.photograph(&Path::new(&folder).join(name));
        }
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        self.manager = None;
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

fn is_installed(tool: &str) -> bool {
    let found = Command::new("sh").args(["-c", &format!("command -v {tool} >/dev/null")]).status();
    found.is_ok_and(|status| status.success())
}

/// A window manager. Dropped before its display.
struct Manager {
    process: Child,
    /// Its settings.
    _home: tempfile::TempDir,
}

impl Manager {
    /// Returns `None` if no window manager is installed: windows are then on the bare screen.
    fn start(display: &str, has_frames: bool) -> Option<Manager> {
        if !is_installed("openbox") {
            return None;
        }
        let home = tempfile::tempdir().unwrap();
        let file = home.path().join("rc.xml");
        // Without frames a window is in the screen's corner, so that window pixels are screen pixels.
        let every = if has_frames {
            ""
        } else {
            "<application class=\"*\"><decor>no</decor><position force=\"yes\"><x>0</x><y>0</y></position></application>"
        };
        std::fs::write(&file, SETTINGS.replace("EVERY", every)).unwrap();
        let process = Command::new("openbox")
            .args(["--sm-disable", "--config-file"])
            .arg(&file)
            .env("DISPLAY", display)
            .env("HOME", home.path())
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("XDG_CONFIG_HOME")
            .env_remove("XDG_CACHE_HOME")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let manager = Manager { process, _home: home };
        // It is ready once it reports the number of desktops.
        let end = Instant::now() + Duration::from_secs(20);
        let query = || Command::new("xdotool").env("DISPLAY", display).arg("get_num_desktops").output().unwrap();
        while query().stdout.trim_ascii() != b"1" {
            assert!(Instant::now() < end, "openbox does not start");
            std::thread::sleep(Duration::from_millis(20));
        }
        Some(manager)
    }
}

impl Drop for Manager {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Openbox without its own keys, which the window would not receive, except for two with which tests do what users do
/// with a frame.
const SETTINGS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<openbox_config xmlns="http://openbox.org/3.4/rc">
  <focus><focusNew>yes</focusNew><followMouse>no</followMouse></focus>
  <placement><policy>Smart</policy></placement>
  <theme><keepBorder>no</keepBorder></theme>
  <desktops><number>1</number><popupTime>0</popupTime></desktops>
  <resize><drawContents>yes</drawContents><popupShow>Never</popupShow></resize>
  <keyboard>
    <keybind key="W-m"><action name="ToggleMaximize"/></keybind>
    <keybind key="A-F4"><action name="Close"/></keybind>
  </keyboard>
  <mouse>
    <context name="Client">
      <mousebind button="Left" action="Press"><action name="Focus"/><action name="Raise"/></mousebind>
    </context>
  </mouse>
  <applications>EVERY</applications>
</openbox_config>
"#;
