//! `eddy doctor`: the information about this machine for a report. Nothing is sent anywhere, no sound device is opened,
//! and the home folder is shown as `~`.

mod folders;
mod gpu_report;
mod text;

use super::{
    args::DoctorArgs,
    command::{CommandError, Run},
    terminal,
};
use crate::{
    gpu::{AdapterReport, DeviceReport, GpuError},
    session::home_as_tilde,
    video::Tools,
};
use folders::FolderLine;
use serde::Serialize;
use std::{
    collections::BTreeMap,
    env,
    io::{self, Write},
    path::Path,
    process::{Command, Stdio},
};

/// The encoders of ffmpeg for films, and their purposes.
const ENCODERS: [(&str, &str); 11] = [
    ("libx264", "h264"),
    ("libx264rgb", "h264 without loss"),
    ("libx265", "h265"),
    ("libvpx-vp9", "vp9"),
    ("libsvtav1", "av1"),
    ("libaom-av1", "av1 of small or 4:4:4 films"),
    ("prores_ks", "prores"),
    ("ffv1", "ffv1"),
    ("aac", "sound of mp4"),
    ("libopus", "sound of webm"),
    ("flac", "sound of mkv"),
];

/// Environment variables that affect Eddy. Their values contain no personal data.
const VARIABLES: [&str; 15] = [
    "WGPU_BACKEND",
    "WGPU_ADAPTER_NAME",
    "WGPU_DX12_COMPILER",
    "WGPU_VALIDATION",
    "VK_ICD_FILENAMES",
    "VK_DRIVER_FILES",
    "VK_LOADER_DRIVERS_SELECT",
    "LIBGL_ALWAYS_SOFTWARE",
    "MESA_LOADER_DRIVER_OVERRIDE",
    "RUST_LOG",
    "RUST_BACKTRACE",
    "WINIT_UNIX_BACKEND",
    "WINIT_X11_SCALE_FACTOR",
    "LANG",
    "LC_ALL",
];

/// The output of the command.
#[derive(Debug, Serialize)]
pub(super) struct Doctor {
    build: Build,
    /// The device that Eddy draws with.
    device: Answer<Device>,
    adapters: Vec<Adapter>,
    display: Display,
    fonts: Vec<FontFolder>,
    /// `None` if this build has no sound devices.
    audio: Option<Audio>,
    ffmpeg: Ffmpeg,
    folders: Vec<FolderLine>,
    environment: BTreeMap<&'static str, String>,
    /// Reports of panics, the newest last.
    reports: Vec<String>,
}

/// A value, or the reason why it is missing.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Answer<T> {
    Is(T),
    Missing { missing: String },
}

impl<T> From<Result<T, String>> for Answer<T> {
    fn from(result: Result<T, String>) -> Self {
        match result {
            Ok(found) => Answer::Is(found),
            Err(missing) => Answer::Missing { missing },
        }
    }
}

#[derive(Debug, Serialize)]
struct Build {
    eddy: &'static str,
    features: Vec<&'static str>,
    optimised: bool,
    os: &'static str,
    arch: &'static str,
    system: Option<String>,
    processors: usize,
    libraries: BTreeMap<String, String>,
}

#[derive(Debug, Serialize)]
struct Device {
    name: String,
    backend: String,
    /// The compiler of shaders on Direct3D 12.
    #[serde(skip_serializing_if = "Option::is_none")]
    hlsl_compiler: Option<String>,
    features: Vec<String>,
    limits: BTreeMap<&'static str, u64>,
    /// The names of the driver's faults, with Eddy's workarounds.
    faults: BTreeMap<&'static str, &'static str>,
}

#[derive(Debug, Serialize)]
struct Adapter {
    name: String,
    backend: String,
    kind: String,
    driver: String,
    /// Hexadecimal PCI ids.
    ids: String,
    features: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Display {
    /// `wayland`, `x11`, `windows`, `macos` or `none`.
    server: &'static str,
    desktop: Option<String>,
    session: Option<String>,
}

#[derive(Debug, Serialize)]
struct FontFolder {
    folder: String,
    /// The number of font files in it and its subfolders; `None` if it does not exist.
    files: Option<usize>,
}

#[derive(Debug, Serialize)]
struct Audio {
    outputs: Vec<String>,
    inputs: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Ffmpeg {
    /// The first line of ffmpeg's version, or the reason why it cannot be run.
    version: Answer<String>,
    ffprobe: Answer<String>,
    encoders: Vec<EncoderLine>,
}

/// An encoder for films.
#[derive(Debug, Serialize)]
struct EncoderLine {
    name: &'static str,
    /// The codecs or formats that need it.
    makes: &'static str,
    is_there: bool,
}

impl Run for DoctorArgs {
    const OPENS_DEVICE: bool = true;

    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(run(self)?)
    }
}

fn run(args: &DoctorArgs) -> io::Result<u8> {
    assert!(!args.panic, "`eddy doctor --panic` was called");
    if let Some(file) = &args.report {
        return gpu_report::run(args, file);
    }
    let doctor = Doctor::examine();
    if args.json {
        terminal::print_json(&doctor)?;
    } else {
        let mut out = terminal::stdout();
        out.write_all(home_as_tilde(&text::of(&doctor)).as_bytes())?;
        out.flush()?;
    }
    // A machine without a device cannot draw.
    Ok(if matches!(doctor.device, Answer::Is(_)) { 0 } else { super::TROUBLE })
}

/// Returns one line about the build, for reports of panics.
pub(super) fn build() -> String {
    let Build { eddy, features, optimised, os, arch, .. } = Build::of_this();
    let profile = if optimised { "optimised" } else { "debug" };
    format!("eddy {eddy} ({profile}; {}), {os} {arch}", features.join(", "))
}

impl Doctor {
    fn examine() -> Doctor {
        let device = DeviceReport::of_default();
        let adapters = match device {
            // It would not answer now either.
            Err(GpuError::NoAnswer { .. }) => Vec::new(),
            _ => AdapterReport::all().unwrap_or_default(),
        };
        let device = device.map_err(|error| error.to_string()).map(Device::of);
        let tilde = |text: String| home_as_tilde(&text);
        Doctor {
            build: Build { system: system(), libraries: libraries(), ..Build::of_this() },
            device: device.into(),
            adapters: adapters.into_iter().map(adapter).collect(),
            display: Display::of_environment(),
            fonts: fonts(),
            audio: audio(),
            ffmpeg: Ffmpeg::examine(&Tools::default()),
            folders: folders::all(),
            environment: VARIABLES.into_iter().filter_map(|name| Some((name, tilde(env::var(name).ok()?)))).collect(),
            reports: folders::reports(),
        }
    }
}

impl Device {
    fn of(report: DeviceReport) -> Device {
        Device {
            name: report.adapter,
            backend: report.backend,
            hlsl_compiler: report.hlsl_compiler,
            features: report.features,
            limits: report.limits.into_iter().collect(),
            faults: report.faults.into_iter().map(|fault| (fault.name, fault.about)).collect(),
        }
    }
}

impl Build {
    fn of_this() -> Build {
        let all = [
            ("audio", cfg!(feature = "audio")),
            ("gamepad", cfg!(feature = "gamepad")),
            ("gui", cfg!(feature = "gui")),
            ("midi", cfg!(feature = "midi")),
        ];
        Build {
            eddy: env!("CARGO_PKG_VERSION"),
            features: all.into_iter().filter(|(_, is_on)| *is_on).map(|(name, _)| name).collect(),
            optimised: !cfg!(debug_assertions),
            os: env::consts::OS,
            arch: env::consts::ARCH,
            system: None,
            processors: std::thread::available_parallelism().map_or(1, usize::from),
            libraries: BTreeMap::new(),
        }
    }
}

/// Returns the version of Windows, as far as the manifest knows it. That of Windows 11 is 10.0, with a build from 22000 on.
#[cfg(windows)]
fn system() -> Option<String> {
    use windows_sys::Win32::System::SystemInformation::{GetVersionExW, OSVERSIONINFOW};
    let size = size_of::<OSVERSIONINFOW>() as u32;
    let mut version = OSVERSIONINFOW { dwOSVersionInfoSize: size, ..OSVERSIONINFOW::default() };
    // SAFETY: the structure has the size that it says.
    let is_known = unsafe { GetVersionExW(&mut version) } != 0;
    let OSVERSIONINFOW { dwMajorVersion: major, dwMinorVersion: minor, dwBuildNumber: build, .. } = version;
    is_known.then(|| format!("Windows {major}.{minor}, build {build}"))
}

/// Returns the name of the distribution, and the kernel's version.
#[cfg(not(windows))]
fn system() -> Option<String> {
    let name = std::fs::read_to_string("/etc/os-release").ok()?;
    let name = name.lines().find_map(|line| line.strip_prefix("PRETTY_NAME="))?.trim_matches('"').to_owned();
    let kernel = std::fs::read_to_string("/proc/sys/kernel/osrelease").unwrap_or_default();
    Some(if kernel.is_empty() { name } else { format!("{name}, kernel {}", kernel.trim()) })
}

/// Returns the name of the machine.
fn hostname() -> Option<String> {
    let name = std::fs::read_to_string("/proc/sys/kernel/hostname").or_else(|_| {
        let output = Command::new("hostname").stdin(Stdio::null()).output()?;
        Ok::<_, io::Error>(String::from_utf8_lossy(&output.stdout).into_owned())
    });
    Some(name.ok()?.trim().to_owned()).filter(|name| !name.is_empty())
}

/// Returns the versions of libraries that may be at fault, as in this build.
fn libraries() -> BTreeMap<String, String> {
    const NAMES: [&str; 6] = ["clap", "cpal", "egui", "naga", "wgpu", "winit"];
    let lock = include_str!("../../../Cargo.lock");
    let mut found = BTreeMap::new();
    let mut name = "";
    for line in lock.lines() {
        let value = |key: &str| line.strip_prefix(key)?.strip_suffix('"');
        if let Some(package) = value("name = \"") {
            name = package;
        } else if let Some(version) = value("version = \"").filter(|_| NAMES.contains(&name)) {
            found.insert(name.to_owned(), version.to_owned());
        }
    }
    found
}

fn adapter(found: AdapterReport) -> Adapter {
    let AdapterReport { name, backend, device_type, driver, driver_info, vendor, device, features } = found;
    let driver = [driver, driver_info].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(", ");
    Adapter { name, backend, kind: device_type, driver, ids: format!("{vendor:04x}:{device:04x}"), features }
}

impl Display {
    fn of_environment() -> Display {
        // `quiet` has set the second.
        let is_set = |name: &str| env::var_os(name).is_some_and(|value| !value.is_empty() && value != "/dev/null");
        let server = match () {
            () if cfg!(windows) => "windows",
            () if cfg!(target_os = "macos") => "macos",
            () if is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET") => "wayland",
            () if is_set("DISPLAY") => "x11",
            () => "none",
        };
        Display { server, desktop: env::var("XDG_CURRENT_DESKTOP").ok(), session: env::var("XDG_SESSION_TYPE").ok() }
    }
}

/// Returns the system's font folders, and the user's.
fn fonts() -> Vec<FontFolder> {
    let folders = if cfg!(windows) {
        let of_windows = env::var_os("SystemRoot").map(|folder| Path::new(&folder).join("Fonts"));
        // Fonts that were installed for one user alone, since Windows 10.
        let own = dirs::data_local_dir().map(|folder| folder.join("Microsoft\\Windows\\Fonts"));
        of_windows.into_iter().chain(own).collect()
    } else {
        let system: &[&str] = match () {
            () if cfg!(target_os = "macos") => &["/System/Library/Fonts", "/Library/Fonts"],
            () => &["/usr/share/fonts", "/usr/local/share/fonts"],
        };
        let folders = system.iter().map(|folder| Path::new(folder).to_owned());
        folders.chain(dirs::font_dir()).collect::<Vec<_>>()
    };
    let line = |folder: std::path::PathBuf| FontFolder {
        files: folder.is_dir().then(|| count_fonts(&folder, 0)),
        folder: home_as_tilde(&folder.display().to_string()),
    };
    folders.into_iter().map(line).collect()
}

/// The maximum depth of font folders, which stops at one that links to itself.
const FONT_DEPTH: u32 = 6;

fn count_fonts(folder: &Path, depth: u32) -> usize {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let is_font = |path: &Path| {
        let ends = |e: &&str| path.extension().is_some_and(|x| x.eq_ignore_ascii_case(e));
        ["ttf", "otf", "ttc", "otc"].iter().any(ends)
    };
    let count = |path: std::path::PathBuf| match path.is_dir() {
        true if depth < FONT_DEPTH => count_fonts(&path, depth + 1),
        true => 0,
        false => usize::from(is_font(&path)),
    };
    entries.map(count).sum()
}

/// Lists devices by name without opening any.
#[cfg(feature = "audio")]
fn audio() -> Option<Audio> {
    use crate::audio::{device::Machine, host::AudioHost};
    Some(Audio { outputs: Machine.output().names(), inputs: Machine.input().names() })
}

#[cfg(not(feature = "audio"))]
fn audio() -> Option<Audio> {
    None
}

impl Ffmpeg {
    fn examine(tools: &Tools) -> Ffmpeg {
        let there = tools.encoders().unwrap_or_default();
        let has = |name: &str| there.iter().any(|there| there == name);
        Ffmpeg {
            version: first_line(&tools.ffmpeg).into(),
            ffprobe: first_line(&tools.ffprobe).into(),
            encoders: ENCODERS
                .into_iter()
                .map(|(name, makes)| EncoderLine { name, makes, is_there: has(name) })
                .collect(),
        }
    }
}

/// Returns the first line of a program's version.
fn first_line(program: &Path) -> Result<String, String> {
    let mut command = Command::new(program);
    command.args(["-hide_banner", "-version"]).stdin(Stdio::null());
    let output = command.output().map_err(|error| format!("{} cannot be run: {error}", program.display()))?;
    let text = String::from_utf8_lossy(&output.stdout);
    Ok(text.lines().next().unwrap_or_default().to_owned())
}
