//! `eddy doctor --report FILE`: what this machine's graphics adapter draws, and how fast, as one JSON object for a bug
//! report. `docs/gpu-reports.md` describes its fields.
//!
//! Nothing in the file names the user, the machine or a folder ([`private`]). A part that fails is an entry with its
//! error, and does not end the report.

mod presets;
mod private;
mod speeds;

use super::{Answer, Build, Device, libraries};
use crate::{
    cli::{
        args::DoctorArgs,
        failure::error_chain,
        library::suggest_force,
        machine::{Machine, RunError, millis_since},
        progress::{CallProgress, Style},
        report::{Printer, Report, Status},
        terminal::shown_path,
    },
    gpu::{AdapterReport, DeviceReport, Gpu},
    project::{self, Overwrite, ProjectError, presets::names},
};
use presets::{PresetEntry, Verdict};
use private::Names;
use serde::Serialize;
use speeds::{Copy, Transfer};
use std::{collections::BTreeMap, io, path::Path, process::Command, time::Instant};

/// The version of the format. It changes when a field is removed or changes its meaning.
const VERSION: u32 = 1;

/// Limits below which something that Eddy offers does not work or is smaller.
const WANTED_LIMITS: [(&str, u64); 7] = [
    ("max_texture_dimension_2d", 8192),
    ("max_texture_dimension_3d", 2048),
    ("max_sampled_textures_per_shader_stage", 16),
    ("max_samplers_per_shader_stage", 16),
    ("max_color_attachments", 8),
    ("max_color_attachment_bytes_per_sample", 128),
    ("max_storage_buffers_per_shader_stage", 1),
];

/// The content of the file.
#[derive(Debug, Serialize)]
struct GpuReport {
    /// Always `eddy gpu report`.
    format: &'static str,
    version: u32,
    build: BuildEntry,
    system: System,
    device: Answer<DeviceEntry>,
    /// All adapters of the machine.
    adapters: Vec<super::Adapter>,
    /// The speed of copying passes: the roofline.
    copies: Vec<Copy>,
    transfers: Vec<Transfer>,
    presets: Vec<PresetEntry>,
    /// The duration of the whole report.
    seconds: f64,
}

#[derive(Debug, Serialize)]
struct BuildEntry {
    eddy: &'static str,
    optimised: bool,
    libraries: BTreeMap<String, String>,
}

#[derive(Debug, Serialize)]
struct System {
    /// `linux`, `windows` or `macos`.
    os: &'static str,
    /// The distribution and the version of the system; `None` if they are unknown.
    version: Option<String>,
    arch: &'static str,
    processors: usize,
}

#[derive(Debug, Serialize)]
struct DeviceEntry {
    driver: String,
    /// True if the processor draws.
    is_software: bool,
    #[serde(flatten)]
    device: Device,
    /// Limits that are smaller than everything in Eddy needs, with the needed values.
    small_limits: BTreeMap<&'static str, u64>,
}

impl DeviceEntry {
    fn of(gpu: &Gpu) -> Self {
        let device = Device::of(DeviceReport::of(gpu));
        let is_small = |(name, wanted): &(&'static str, u64)| device.limits.get(name).is_some_and(|is| is < wanted);
        Self {
            driver: [gpu.info.driver.as_str(), &gpu.info.driver_info].join(" ").trim().to_owned(),
            is_software: gpu.rasteriser().shares_processor(),
            small_limits: WANTED_LIMITS.into_iter().filter(is_small).collect(),
            device,
        }
    }
}

/// Writes the report. Returns the exit code: 0 if every preset draws what is expected, 1 if one does not, 2 if there is no
/// device or no file.
pub(super) fn run(args: &DoctorArgs, file: &Path) -> io::Result<u8> {
    let mut line = Report::new(&shown_path(file));
    let mut printer = Printer::new(false);
    let mut machine = Machine::default();
    let words = match write(file, args, &mut machine) {
        Ok(written) => {
            line.status = written.status();
            written.words(&shown_path(file))
        }
        Err(RunError::Other(error)) => {
            line.fail(Status::Error, error_chain(&error));
            String::new()
        }
        Err(RunError::Unsupported(what)) => {
            line.fail(Status::Unsupported, what);
            String::new()
        }
        Err(RunError::Diagnostics(found, sources)) => {
            line.diagnose(&found, &sources, None);
            String::new()
        }
    };
    printer.print(&line, &words)?;
    Ok(printer.exit_code())
}

/// Measures everything and writes the file. An existing file is rejected before anything is measured.
fn write(file: &Path, args: &DoctorArgs, machine: &mut Machine) -> Result<GpuReport, RunError> {
    let presets = presets_of(&args.preset)?;
    if !args.force && file.symlink_metadata().is_ok() {
        return Err(suggest_force(ProjectError::WouldOverwrite { paths: vec![file.to_owned()] }.into()));
    }
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let Some(folder) = folder.filter(|folder| !folder.is_dir()) {
        return Err(anyhow::anyhow!("--report {}: there is no folder {}", shown_path(file), shown_path(folder)).into());
    }
    let report = GpuReport::measure(machine, &presets);
    let mut json = serde_json::to_value(&report).map_err(anyhow::Error::from)?;
    Names::of_this_machine().remove_from(&mut json);
    let mut text = serde_json::to_string_pretty(&json).map_err(anyhow::Error::from)?;
    text.push('\n');
    let overwrite = if args.force { Overwrite::Allow } else { Overwrite::Refuse };
    project::write_named(file, text.into_bytes(), overwrite).map_err(RunError::from).map_err(suggest_force)?;
    Ok(report)
}

/// Returns the presets with these names, or all.
fn presets_of(named: &[String]) -> Result<Vec<&'static str>, RunError> {
    let find = |name: &String| {
        let there = names().iter().copied().find(|preset| preset == name);
        there.ok_or_else(|| anyhow::anyhow!("--preset {name}: there is no such preset; `eddy list` shows them").into())
    };
    if named.is_empty() { Ok(names().to_vec()) } else { named.iter().map(find).collect() }
}

impl GpuReport {
    fn measure(machine: &mut Machine, presets: &[&'static str]) -> Self {
        let began = Instant::now();
        let call = CallProgress::new(Style::Auto, 1, "steps");
        let steps = presets.len() + 1 + speeds::SIZES.len() * 2;
        let progress = call.start("report", 1, steps as u32);
        let build = Build::of_this();
        let mut report = Self {
            format: "eddy gpu report",
            version: VERSION,
            build: BuildEntry { eddy: build.eddy, optimised: build.optimised, libraries: libraries() },
            system: System { os: build.os, version: version(), arch: build.arch, processors: build.processors },
            device: Answer::Missing { missing: String::new() },
            adapters: Vec::new(),
            copies: Vec::new(),
            transfers: Vec::new(),
            presets: Vec::new(),
            seconds: 0.0,
        };
        let gpu = match machine.gpu() {
            Ok(gpu) => gpu,
            Err(error) => {
                report.device = Answer::Missing { missing: error_chain(&error) };
                report.seconds = began.elapsed().as_secs_f64();
                return report;
            }
        };
        report.device = Answer::Is(DeviceEntry::of(&gpu));
        report.adapters = AdapterReport::all().unwrap_or_default().into_iter().map(super::adapter).collect();
        let is_software = gpu.rasteriser().shares_processor();
        let size = presets::timed_size(is_software);
        drop(gpu);
        let sizes = [size].into_iter().chain(speeds::SIZES.into_iter().filter(|other| *other != size));
        for size in sizes {
            report.copies.push(Copy::measure(machine, size));
            progress.step();
        }
        for size in speeds::SIZES {
            report.transfers.push(Transfer::measure(machine, size));
            progress.step();
        }
        let copied = report.copies.iter().find(|copy| copy.size == size).and_then(|copy| copy.bytes_per_second);
        for name in presets {
            report.presets.push(PresetEntry::measure(machine, name, size, copied));
            progress.step();
        }
        report.seconds = millis_since(began) / 1e3;
        report
    }

    fn named(&self, verdict: Verdict) -> Vec<&str> {
        self.presets.iter().filter(|entry| entry.verdict == verdict).map(|entry| entry.preset).collect()
    }

    fn status(&self) -> Status {
        match self.device {
            Answer::Missing { .. } => Status::Error,
            Answer::Is(_) if self.presets.iter().all(|entry| entry.verdict == Verdict::AsExpected) => Status::Ok,
            Answer::Is(_) => Status::Diagnostics,
        }
    }

    /// Returns the summary that is printed.
    fn words(&self, file: &str) -> String {
        let device = match &self.device {
            Answer::Missing { missing } => return format!("{file}: {missing}"),
            Answer::Is(entry) => format!("{} ({}, {})", entry.device.name, entry.device.backend, entry.driver),
        };
        let mut words = format!(
            "{file}: {} of {} presets are drawn as expected on {device}, in {:.0} s",
            self.named(Verdict::AsExpected).len(),
            self.presets.len(),
            self.seconds
        );
        for (verdict, what) in [(Verdict::Differs, "different pictures"), (Verdict::Failed, "errors")] {
            let names = self.named(verdict);
            if !names.is_empty() {
                words.push_str(&format!("\n  {what}: {}", names.join(", ")));
            }
        }
        for copy in &self.copies {
            let (width, height) = copy.size;
            if let Some(bytes) = copy.bytes_per_second {
                words.push_str(&format!("\n  a copying pass of {width}x{height} moves {:.1} GB/s", bytes / 1e9));
            }
        }
        words
    }
}

/// Returns the name and version of the system, without anything that its owner has chosen.
fn version() -> Option<String> {
    let output = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).output().ok()?;
        let text = String::from_utf8_lossy(&output.stdout).trim().to_owned();
        (!text.is_empty()).then_some(text)
    };
    match std::env::consts::OS {
        "windows" => output("cmd", &["/C", "ver"]),
        "macos" => output("sw_vers", &["-productVersion"]),
        _ => {
            let release = std::fs::read_to_string("/etc/os-release").ok()?;
            let value = |key: &str| {
                let line = release.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix('='));
                line.map(|value| value.trim_matches('"').to_owned())
            };
            let kernel = std::fs::read_to_string("/proc/sys/kernel/osrelease").unwrap_or_default();
            let kernel: Vec<&str> = kernel.trim().split(['.', '-']).take(2).collect();
            let system = [value("ID")?, value("VERSION_ID").unwrap_or_default()].join(" ");
            Some(format!("{}, kernel {}", system.trim(), kernel.join(".")))
        }
    }
}

#[cfg(test)]
mod tests;
