//! The report as text.

use super::{
    Answer, Doctor, EncoderLine,
    folders::{FolderLine, FolderState},
};
use crate::cli::terminal::one_line;
use std::fmt::Write;

/// Returns the lines of a report.
pub(super) fn of(doctor: &Doctor) -> String {
    let mut out = String::new();
    let build = &doctor.build;
    let head = |title: &str| format!("\n{title}\n");
    out.push_str("Build\n");
    line(&mut out, "Eddy", &super::build());
    line(&mut out, "system", build.system.as_deref().unwrap_or(build.os));
    line(&mut out, "processors", &build.processors.to_string());
    let libraries: Vec<String> = build.libraries.iter().map(|(name, version)| format!("{name} {version}")).collect();
    line(&mut out, "libraries", &libraries.join(", "));
    out.push_str(&head("Device"));
    match &doctor.device {
        Answer::Missing { missing } => line(&mut out, "none", missing),
        Answer::Is(device) => {
            line(&mut out, "name", &format!("{} ({})", device.name, device.backend));
            if let Some(compiler) = &device.hlsl_compiler {
                line(&mut out, "shader compiler", compiler);
            }
            line(&mut out, "features", &device.features.join(", "));
            for (name, value) in &device.limits {
                line(&mut out, name, &value.to_string());
            }
            let known = if device.faults.is_empty() { "none" } else { "" };
            line(&mut out, "driver faults", known);
            for (name, about) in &device.faults {
                line(&mut out, &format!("  {name}"), about);
            }
        }
    }
    out.push_str(&head("Adapters"));
    for adapter in &doctor.adapters {
        line(
            &mut out,
            &adapter.name,
            &format!("{}, {}, {}, {}", adapter.backend, adapter.kind, adapter.ids, adapter.driver),
        );
        line(&mut out, "  features", &adapter.features.join(", "));
    }
    out.push_str(&head("Display"));
    let display = &doctor.display;
    line(&mut out, "server", display.server);
    for (name, value) in [("desktop", &display.desktop), ("session", &display.session)] {
        if let Some(value) = value {
            line(&mut out, name, value);
        }
    }
    out.push_str(&head("Fonts"));
    for folder in &doctor.fonts {
        let files = folder.files.map_or("not there".into(), |files| format!("{files} font files"));
        line(&mut out, &folder.folder, &files);
    }
    out.push_str(&head("Sound"));
    match &doctor.audio {
        None => line(&mut out, "none", "this build has no sound devices (feature `audio` is off)"),
        Some(audio) => {
            line(&mut out, "outputs", &listed(&audio.outputs));
            line(&mut out, "inputs", &listed(&audio.inputs));
        }
    }
    out.push_str(&head("ffmpeg"));
    for (name, said) in [("ffmpeg", &doctor.ffmpeg.version), ("ffprobe", &doctor.ffmpeg.ffprobe)] {
        match said {
            Answer::Is(said) | Answer::Missing { missing: said } => line(&mut out, name, said),
        }
    }
    for EncoderLine { name, makes, is_there } in &doctor.ffmpeg.encoders {
        line(&mut out, &format!("  {name}"), &format!("{}, for {makes}", if *is_there { "yes" } else { "no" }));
    }
    out.push_str(&head("Folders"));
    for FolderLine { what, path, state } in &doctor.folders {
        let path = path.as_deref().unwrap_or("the system has none");
        let state = match state {
            FolderState::Writable => "can be written",
            FolderState::ReadOnly => "CANNOT BE WRITTEN",
            FolderState::CanBeMade => "not there yet, can be made",
            FolderState::CannotBeMade => "CANNOT BE MADE",
            FolderState::Unknown => "",
        };
        line(&mut out, what, &format!("{path}  {state}"));
    }
    out.push_str(&head("Environment"));
    doctor.environment.iter().for_each(|(name, value)| line(&mut out, name, value));
    if doctor.environment.is_empty() {
        line(&mut out, "none", "");
    }
    if !doctor.reports.is_empty() {
        out.push_str(&head("Reports of bugs"));
        doctor.reports.iter().for_each(|path| line(&mut out, path, ""));
    }
    out
}

fn line(out: &mut String, name: &str, value: &str) {
    let _ = writeln!(out, "{}", format!("  {:<24} {}", one_line(name), one_line(value)).trim_end());
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".into() } else { names.join("; ") }
}
