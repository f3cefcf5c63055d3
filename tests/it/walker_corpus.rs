//! Real shaders, walker compared with device: every pass of every file in a folder of Shadertoy's JSON, at a few
//! pixels.
//!
//! `EDDY_CORPUS` is the folder, `EDDY_CORPUS_PIXELS` (20) the number of pixels per pass, `EDDY_CORPUS_FRAME` (3) the
//! frame, `EDDY_CORPUS_SECONDS` (30) the time limit per shader, `EDDY_CORPUS_COUNT` the largest number of shaders. Each
//! is drawn by a separate process, as drivers hang on some of them. `EDDY_CORPUS=FOLDER cargo test --test it
//! walker_corpus::a_corpus -- --ignored --nocapture` prints a line for each visibly different pixel, and the counts.

use crate::support::{
    env::number,
    explained::{Explained, STATEMENTS, VISIBLE},
    walked::is_same,
    *,
};
use eddy::{
    debugger::{
        audit::spread,
        trace::{Extent, TraceError, Tracer, ulps},
    },
    engine::{BuildOptions, Engine, FrameInputs, Program, Sources},
    media,
    project::{self, PassName, Project},
};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::{Duration, Instant},
};

const SIZE: (u32, u32) = (64, 36);
/// The allowed distance in ULPs, for the last bits of functions.
const NEAR_ULPS: u32 = 64;
/// The allowed absolute difference, for values near zero.
const NEAR: f64 = 4e-6;

/// The prefix of a process's output lines about a pixel or its shader.
const PREFIX: &str = "CORPUS ";

/// Returns how a pixel compares, from best to worst, and its difference.
fn class(walked: [f32; 4], drawn: [f32; 4]) -> (&'static str, f64) {
    let mut largest = 0.0f64;
    let mut is_near = true;
    for (a, b) in walked.into_iter().zip(drawn) {
        if is_same(a, b) {
            continue;
        }
        let difference = (f64::from(a) - f64::from(b)).abs();
        let difference = if difference.is_nan() { f64::INFINITY } else { difference };
        is_near &= ulps(a, b) <= NEAR_ULPS || difference <= NEAR;
        // Values that a screen clamps to the same are equal.
        let shown = |x: f32| if x.is_nan() { 0.0 } else { f64::from(x.clamp(0.0, 1.0)) };
        let is_buffer_like = !(0.0..=1.0).contains(&a) || !(0.0..=1.0).contains(&b);
        let relative = difference / f64::from(b.abs()).max(1.0);
        largest = largest.max(if is_buffer_like { relative } else { (shown(a) - shown(b)).abs() });
    }
    match largest {
        0.0 => ("same", 0.0),
        _ if is_near => ("near", largest),
        largest if largest < VISIBLE => ("invisible", largest),
        largest => ("visible", largest),
    }
}

/// Draws a shader and walks its passes; prints the results.
fn compare(path: &Path) -> Result<(), String> {
    let gpu = gpu().ok_or("no device")?;
    let project = project::load(&path.to_string_lossy()).map_err(|e| e.to_string())?.project;
    let wanted: Vec<PassName> =
        project.passes.iter().map(|pass| &pass.id).filter(|id| id.is_picture()).cloned().collect();
    let (media, _) = media::gather(&project, None);
    let options = BuildOptions { requested: wanted.clone(), skip: false, ..BuildOptions::default() };
    let built = Program::build(&gpu, &project, &media, &options).map_err(|e| format!("not built: {e}"))?;
    let mut engine = Engine::new(gpu, SIZE.0, SIZE.1).map_err(|e| e.to_string())?;
    engine.set_program(built.program).map_err(|e| e.to_string())?;
    let frame = number("EDDY_CORPUS_FRAME", 3) as i32;
    for frame in 0..=frame {
        let inputs = FrameInputs { mouse: [20.0, 18.0, 20.0, 18.0], ..FrameInputs::at_fixed_step(frame, 60.0) };
        engine.draw(&inputs).map_err(|e| e.to_string())?;
    }
    // The test harness has started a line.
    println!("\n{PREFIX}drawn");
    let sources = Sources::new(&project);
    for id in &wanted {
        walk_pass(&mut engine, (&project, &sources), id, path)?;
    }
    Ok(())
}

fn walk_pass(
    engine: &mut Engine,
    (project, sources): (&Project, &Sources<'_>),
    id: &PassName,
    path: &Path,
) -> Result<(), String> {
    let index = project.passes.iter().position(|pass| pass.id == *id).expect("a drawn pass");
    let (read, drawn) = (engine.inspect(id).map_err(|e| e.to_string())?, engine.read(id).map_err(|e| e.to_string())?);
    let extent = Extent { statements: STATEMENTS, steps: 0 };
    let tracer = Tracer::new(sources, index, &read, extent).map_err(|e| e.to_string())?;
    let pass = Explained { sources, index, read: &read };
    let count = number("EDDY_CORPUS_PIXELS", 20) as u32;
    for pixel in spread((count.div_ceil(4), 4), read.size) {
        let found = match tracer.trace(pixel) {
            Ok(trace) => trace.value,
            Err(TraceError::Endless(_)) => {
                println!("{PREFIX}long");
                continue;
            }
            Err(error) => return Err(error.to_string()),
        };
        let texel = texel(&drawn, pixel.0, pixel.1);
        let Some(walked) = found else {
            println!("{PREFIX}discarded");
            continue;
        };
        let (class, difference) = class(walked, texel);
        if matches!(class, "same" | "near") {
            println!("{PREFIX}{class}");
            continue;
        }
        let why = pass.why(pixel, difference);
        println!("{PREFIX}{class}: {why}");
        if class == "visible" {
            println!("{}, {} at {pixel:?}: {walked:?}, drawn {texel:?}: {why}", path.display(), id.title());
        }
    }
    Ok(())
}

/// The work of a process: the shader in `EDDY_CORPUS_ONE`.
#[test]
#[ignore = "started by `a_corpus_matches_the_device`"]
fn one_shader_of_the_corpus() {
    let path = std::env::var_os("EDDY_CORPUS_ONE").expect("EDDY_CORPUS_ONE names the shader");
    if let Err(why) = compare(Path::new(&path)) {
        println!("\n{PREFIX}failed");
        println!("{}: {}", path.display(), why.lines().next().unwrap_or_default());
    }
}

/// Runs a shader in a separate process; returns `None` on a timeout or if the process fails.
fn shader(path: &Path, limit: Duration) -> Option<String> {
    let mut output = tempfile::tempfile().unwrap();
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["walker_corpus::one_shader_of_the_corpus", "--exact", "--ignored", "--nocapture", "--test-threads", "1"])
        .env("EDDY_CORPUS_ONE", path)
        .stdout(output.try_clone().unwrap())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let start = Instant::now();
    let status = loop {
        match child.try_wait().unwrap() {
            Some(status) => break Some(status),
            None if start.elapsed() > limit => {
                child.kill().unwrap();
                child.wait().unwrap();
                break None;
            }
            None => std::thread::sleep(Duration::from_millis(10)),
        }
    };
    use std::io::{Read, Seek};
    let mut text = String::new();
    output.rewind().unwrap();
    output.read_to_string(&mut text).ok()?;
    status.filter(std::process::ExitStatus::success).map(|_| text)
}

#[test]
#[ignore = "needs a folder of Shadertoy's JSON"]
fn a_corpus_matches_the_device() {
    let folder = std::env::var_os("EDDY_CORPUS").expect("EDDY_CORPUS names the folder");
    let limit = Duration::from_secs(number("EDDY_CORPUS_SECONDS", 30));
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    files.sort();
    files.truncate(number("EDDY_CORPUS_COUNT", u64::MAX) as usize);
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    let mut add = |what: &str| *counts.entry(what.to_owned()).or_default() += 1;
    for path in &files {
        let Some(text) = shader(path, limit) else {
            add("shaders: given up");
            println!("{}: given up", path.display());
            continue;
        };
        for line in text.lines() {
            match line.strip_prefix(PREFIX) {
                Some(what @ ("drawn" | "failed")) => add(&format!("shaders: {what}")),
                Some(what) => add(&format!("pixels: {what}")),
                None if line.starts_with(&*path.to_string_lossy()) => println!("{line}"),
                None => {}
            }
        }
    }
    println!("{} files", files.len());
    counts.iter().for_each(|(what, count)| println!("{count:>8} {what}"));
    let of =
        |what: &str| counts.iter().filter(|(name, _)| name.starts_with(what)).map(|(_, count)| count).sum::<usize>();
    assert!(of("shaders: drawn") > 0, "no shader is drawn");
    // Every visible difference has a reason.
    let unexplained = counts.get("pixels: visible: not explained").copied().unwrap_or(0);
    assert_eq!(unexplained, 0, "of {} pixels", of("pixels"));
}
