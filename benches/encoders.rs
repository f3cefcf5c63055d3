//! Measures whether encoding slows drawing down. `cargo bench --bench encoders [PRESET] [WxH] [FRAMES]`.
//!
//! Draws frames alone, and again while each encoder takes them, in rounds: every round includes each of them once, so
//! that a machine that becomes slower affects all. Prints the median of the time for all frames relative to that of
//! drawing alone, and how long a frame waited for the encoder: the median and the maximum. The time of an encoder after
//! the last frame is printed separately. Encoders that share the CPU with a software driver always slow it down; the
//! waits show whether they stall it.

use eddy::{
    engine::{BuildOptions, Pixels},
    film::{Cancel, Codec, Destination, Encoding, FilmSound, Format, Output, Rate, Shape, Style, Writer, check_tools},
    gpu::{Gpu, GpuOptions},
    media,
    playback::{offline::Offline, script::ScriptedInputs},
    project::{self, PassName},
    video::Tools,
};
use std::{path::Path, time::Instant};

const ROUNDS: usize = 5;
const FPS: f64 = 30.0;

/// The encoders, by a name and their format.
const ENCODERS: [(&str, Format, Option<Codec>); 13] = [
    ("png", Format::Png, None),
    ("exr", Format::Exr, None),
    ("npy", Format::Npy, None),
    ("apng", Format::Apng, None),
    ("gif", Format::Gif, None),
    ("y4m", Format::Y4m, None),
    ("raw", Format::Raw, None),
    ("mp4 h264", Format::Mp4, Some(Codec::H264)),
    ("mp4 h265", Format::Mp4, Some(Codec::H265)),
    ("mp4 av1", Format::Mp4, Some(Codec::Av1)),
    ("webm vp9", Format::Webm, Some(Codec::Vp9)),
    ("mov prores", Format::Mov, Some(Codec::ProRes)),
    ("mkv ffv1", Format::Mkv, Some(Codec::Ffv1)),
];

/// The milliseconds of a run.
#[derive(Default)]
struct Times {
    /// All frames, drawn and handed over.
    drawing: f64,
    /// Each frame, from the end of drawing until the encoder has taken it.
    waits: Vec<f64>,
    /// Finishing the file after the last frame.
    end: f64,
}

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|a| !a.starts_with('-'));
    let preset = arguments.next().unwrap_or_else(|| "fluid".into());
    let size = arguments.next().unwrap_or_else(|| "640x360".into());
    let frames: u32 = arguments.next().map_or(60, |n| n.parse().expect("a number of frames"));
    let (width, height) = size.split_once('x').expect("a size as 640x360");
    let size: (u32, u32) = (width.parse().expect("a width"), height.parse().expect("a height"));
    let Ok(gpu) = Gpu::new(&GpuOptions::default()) else { return eprintln!("there is no graphics device") };
    println!("{preset}, {}x{}, {frames} frames, {ROUNDS} rounds, {}", size.0, size.1, gpu.describe());
    let encodings: Vec<(&str, Encoding)> = ENCODERS
        .into_iter()
        .filter_map(|(name, format, codec)| {
            let encoding = Style { codec, ..Style::new(format) }.resolve().expect("a style");
            match check_tools(&encoding, size, &Tools::default()) {
                Ok(()) => Some((name, encoding)),
                Err(error) => {
                    println!("{name}: left out, {error}");
                    None
                }
            }
        })
        .collect();
    let folder = tempfile::tempdir().expect("a folder");
    let mut draw = drawing(&gpu, &preset, size);
    // Drivers compile in the first frames.
    (0..5).for_each(|_| drop(draw()));
    let mut alone = Vec::new();
    let mut all: Vec<Vec<Times>> = encodings.iter().map(|_| Vec::new()).collect();
    for _ in 0..ROUNDS {
        alone.push(run(&mut draw, frames, None).drawing);
        for ((_, encoding), times) in encodings.iter().zip(&mut all) {
            times.push(run(&mut draw, frames, Some((encoding, size, folder.path()))));
        }
    }
    let alone = median(&alone);
    println!("{:<12} {:>9.1} ms", "alone", alone);
    println!(
        "{:<12} {:>12} {:>8} {:>12} {:>12} {:>10}",
        "encoder", "drawing", "ratio", "wait, median", "wait, most", "end"
    );
    for ((name, _), times) in encodings.iter().zip(&all) {
        let drawing = median(&times.iter().map(|t| t.drawing).collect::<Vec<_>>());
        let end = median(&times.iter().map(|t| t.end).collect::<Vec<_>>());
        let waits: Vec<f64> = times.iter().flat_map(|t| t.waits.iter().copied()).collect();
        let most = waits.iter().copied().fold(0.0, f64::max);
        let (ratio, wait) = (drawing / alone, median(&waits));
        println!("{name:<12} {drawing:>9.1} ms {ratio:>8.3} {wait:>9.3} ms {most:>9.3} ms {end:>7.1} ms");
    }
}

/// Returns a function that draws the next frame of a preset and reads its picture.
fn drawing(gpu: &Gpu, preset: &str, size: (u32, u32)) -> impl FnMut() -> Pixels + use<> {
    let project = project::load(preset).expect("a project").project;
    let (media, _) = media::gather(&project, None);
    let mut offline = Offline::new(gpu, size, ScriptedInputs::new(FPS)).expect("an engine");
    offline.build(&project, &media, &BuildOptions::default()).expect("a program");
    move || {
        offline.draw().expect("a frame");
        offline.read(&PassName::image(), 0).expect("a picture")
    }
}

/// Draws a number of frames, which an encoder takes if there is one.
fn run(draw: &mut impl FnMut() -> Pixels, frames: u32, encoder: Option<(&Encoding, (u32, u32), &Path)>) -> Times {
    let rate = Rate::of(FPS).expect("a rate");
    let mut writer = encoder.map(|(encoding, (width, height), folder)| {
        let shape = Shape { width, height, rate, frames: Some(frames) };
        let to = match encoding {
            Encoding::Still(_) => Destination::Pictures,
            Encoding::Film(_) => Destination::Film(Output::File(folder.join("film"))),
        };
        Writer::start(encoding, shape, Default::default(), FilmSound::None, to, &Cancel::default()).expect("a writer")
    });
    let picture = encoder.map(|(_, _, folder)| folder.join("picture"));
    let mut times = Times::default();
    let began = Instant::now();
    for _ in 0..frames {
        let pixels = draw();
        if let Some(writer) = &mut writer {
            let began = Instant::now();
            writer.push(picture.clone(), pixels, None).expect("a frame that is taken");
            times.waits.push(millis(began));
        }
    }
    times.drawing = millis(began);
    let began = Instant::now();
    if let Some(writer) = writer {
        writer.finish().expect("a file");
    }
    times.end = millis(began);
    times
}

fn millis(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}

fn median(all: &[f64]) -> f64 {
    let mut all = all.to_vec();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or_default()
}
