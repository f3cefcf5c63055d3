//! The reference pictures of `eddy doctor --report`, and a short report of the built program.
//!
//! `EDDY_BLESS=1 cargo test --workspace --test it gpu_reports` redraws the references that are outside of their bounds;
//! then look at each picture that git shows as changed.

use crate::support::{
    gpu,
    program::{Bench, run},
};
use eddy::{
    engine::BuildOptions,
    gpu::Gpu,
    lab::preset_pictures::{self, Difference, PresetPicture},
    media,
    playback::offline::Offline,
    project::presets,
};
use std::{fs, path::Path, process::Command};

fn draw(gpu: &Gpu, preset: &str) -> PresetPicture {
    let project = presets::load(preset).unwrap().project;
    let (media, _) = media::gather(&project, None);
    let mut offline = Offline::new(gpu, preset_pictures::SIZE, preset_pictures::inputs()).unwrap();
    offline.build(&project, &media, &BuildOptions::default()).unwrap();
    preset_pictures::draw(&mut offline).unwrap()
}

/// Returns whether a preset's picture is within the bounds of its reference in `folder`, which is replaced if it is not and
/// `bless` is set.
fn check(gpu: &Gpu, folder: &Path, preset: &str, bless: bool) -> Result<(), String> {
    let drawn = draw(gpu, preset);
    if drawn.not_finite > 0 {
        return Err(format!("{preset}: {} pixels are infinite or not a number", drawn.not_finite));
    }
    let file = folder.join(format!("{preset}.png"));
    let reference = image::open(&file).map(|reference| reference.to_rgb8());
    let difference = reference.ok().and_then(|reference| Difference::of(&drawn.means, &reference));
    match difference {
        Some(difference) if difference.is_within(preset_pictures::bounds(preset)) => Ok(()),
        _ if bless => drawn.means.save(&file).map_err(|error| format!("{}: {error}", file.display())),
        other => Err(format!("{preset}: {other:?}")),
    }
}

#[test]
fn references_of_reports_are_what_the_presets_draw() {
    let Some(gpu) = gpu() else { return };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/report");
    let bless = std::env::var_os("EDDY_BLESS").is_some();
    // Golden pictures test all presets. Here a few are enough to find references that are out of date.
    let few = ["brick-breaker", "fluid-dye", "taa", "toon-outline"];
    let names = if bless { presets::names() } else { &few };
    let problems: Vec<String> = names.iter().filter_map(|name| check(&gpu, &folder, name, bless).err()).collect();
    let help = "EDDY_BLESS=1 redraws them";
    assert!(problems.is_empty(), "assets/report: {}\n({help})", problems.join("\n"));
}

#[test]
fn a_report_has_results_and_no_personal_data() {
    if gpu().is_none() {
        return;
    }
    let b = Bench::new();
    let home = b.path("Zaphod Beeblebrox").to_str().unwrap().to_owned();
    fs::create_dir(&home).unwrap();
    let report = |line: &str| {
        let mut command = b.command();
        command.args(line.split(' ')).env("HOME", &home).env("USER", "zaphod-b").env("LOGNAME", "zaphod-b");
        run(&mut command)
    };
    let done = report("doctor --report r.json --preset nocturne");
    assert_eq!(done.code, Some(0), "{}{}", done.out, done.err);
    assert!(done.out.contains("1 of 1 presets are drawn as expected"), "{}", done.out);
    let text = fs::read_to_string(b.path("r.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&json["format"], &json["version"]), (&"eddy gpu report".into(), &1.into()));
    let entry = &json["presets"][0];
    assert_eq!((&entry["preset"], &entry["verdict"]), (&"nocturne".into(), &"as_expected".into()));
    for field in ["compile_ms", "first_frame_ms", "frame_ms", "moved_bytes", "roofline_share"] {
        assert!(entry[field].as_f64().is_some_and(|value| value > 0.0), "{field}: {entry}");
    }
    assert!(json["copies"].as_array().unwrap().iter().all(|copy| copy["bytes_per_second"].as_f64() > Some(1e6)));
    assert!(json["transfers"].as_array().unwrap().iter().all(|transfer| transfer["readback_ms"].as_f64() > Some(0.0)));
    assert!(!text.contains(&home), "{text}");
    let host = Command::new("hostname").output();
    let host = host.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_lowercase()).unwrap_or_default();
    let lower = text.to_lowercase();
    // The name of a machine may be a part of an adapter's: `vm` of llvmpipe.
    let mut words = lower.split(|c: char| !c.is_alphanumeric() && c != '-');
    let found =
        words.find(|word| !word.is_empty() && *word == host || word.contains("zaphod") || word.contains("beeblebrox"));
    assert_eq!(found, None, "{text}");
    assert!(!text.contains("\"/") && !text.contains(" /") && !text.contains(":\\\\"), "an absolute path\n{text}");
    // An existing file is not replaced.
    let again = report("doctor --report r.json --preset nocturne");
    assert_eq!(again.code, Some(2), "{}{}", again.out, again.err);
    assert!(format!("{}{}", again.out, again.err).contains("--force"), "{}{}", again.out, again.err);
    assert_eq!(fs::read_to_string(b.path("r.json")).unwrap(), text);
    for (line, expected) in [
        ("doctor --report no/r.json", "there is no folder no"),
        ("doctor --report s.json --preset x", "no such preset"),
    ] {
        let refused = report(line);
        let said = format!("{}{}", refused.out, refused.err);
        assert!(refused.code == Some(2) && said.contains(expected), "{said}");
    }
}
