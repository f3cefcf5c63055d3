//! `eddy render --pass sound`: writes the samples of sound passes as WAV or FLAC files of 16 bits and 44,100 samples
//! per second.

use super::{
    args::RenderArgs,
    machine::{Machine, RunError, millis_since},
    opening::Opening,
    progress::CallProgress,
    report::{Printer, Report},
    targets::{check_folder, stems, tells_case_apart},
    terminal::shown_path,
    written::make_folder,
};
use crate::{
    audio::{SAMPLE_RATE, flac, wav},
    engine::{BLOCK_FRAMES, SOUND_FRAMES},
    playback::{median, script::ScriptedInputs},
    project::{self},
};
use anyhow::Context;
use serde::Serialize;
use std::{
    io::{self, Write},
    path::{Path, PathBuf},
    time::Instant,
};

/// The file format of a sound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Wav,
    Flac,
}

/// The sound files that one call writes.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Sounds {
    format: Format,
    /// The number of samples of each.
    frames: u32,
    place: Output,
}

#[derive(Debug, PartialEq, Eq)]
enum Output {
    Nowhere,
    File(PathBuf),
    /// A folder, and the stem of each project in it.
    Folder(PathBuf, Vec<String>),
}

impl Sounds {
    /// Returns the sound files that a call writes; `None` if it writes pictures. Returns an error message if the
    /// options contradict each other.
    pub(super) fn of(args: &RenderArgs) -> Result<Option<Sounds>, String> {
        let named = args.out.as_deref().filter(|out| !out.is_dir()).and_then(format_of);
        if !args.pass.pass.is_sound() {
            return match (&args.out, named) {
                (Some(out), Some(_)) => Err(format!("--out {} is a sound: add --pass sound", out.display())),
                _ if args.secs.is_some() => Err("--secs is the length of a sound: add --pass sound".into()),
                _ => Ok(None),
            };
        }
        let pictures = [
            ("--at", !args.at.is_empty()),
            ("--frames", args.frames.is_some()),
            ("--format", args.style.format.is_some()),
            ("--shard", args.shard.is_some()),
            ("--supersample", args.supersample.is_some()),
            ("--shutter", args.shutter.is_some()),
            ("--codec", args.style.codec.is_some()),
            ("--quality", args.style.quality.is_some()),
            ("--face", args.face.is_some()),
            ("--sweep", !args.sweep.is_empty()),
            ("--probe", !args.probe.is_empty()),
            ("--assert", !args.assert.is_empty()),
            ("sound:1", args.pass.target != 0),
        ];
        if let Some((option, _)) = pictures.iter().find(|(_, is_given)| *is_given) {
            return Err(format!("{option} is about pictures, and a sound pass has none: leave it out"));
        }
        let frames = args.secs.map_or(SOUND_FRAMES, |secs| (secs.as_secs_f64() * f64::from(SAMPLE_RATE)).ceil() as u32);
        if frames > SOUND_FRAMES {
            let most = SOUND_FRAMES / SAMPLE_RATE;
            return Err(format!(
                "--secs: a sound pass is {most} s long, and silent after that; ask for {most} at most"
            ));
        }
        let place = match (&args.out, named) {
            (None, _) => Output::Nowhere,
            (Some(out), Some(_)) if args.project.len() != 1 => {
                let sounds = args.project.len();
                let shown = shown_path(out);
                return Err(format!("--out {shown} is one file, but {sounds} sounds would be written: give a folder"));
            }
            (Some(out), Some(_)) => Output::File(out.clone()),
            (Some(out), None) if out.extension().is_some() && !out.is_dir() => {
                let shown = shown_path(out);
                return Err(format!("--out {shown}: a sound is written as .wav or .flac, or into a folder"));
            }
            (Some(out), None) => Output::Folder(out.clone(), stems(&args.project, || tells_case_apart(out))?),
        };
        Ok(Some(Sounds { format: named.unwrap_or(Format::Wav), frames, place }))
    }

    /// Creates the folder, so that an unwritable location is detected before anything is drawn.
    pub(super) fn prepare(&self) -> anyhow::Result<()> {
        match &self.place {
            Output::Nowhere => Ok(()),
            Output::File(file) => check_folder(file),
            Output::Folder(folder, _) => make_folder("--out", folder),
        }
    }

    /// Writes a sound atomically. Returns the file.
    fn write(&self, project: usize, frames: &[[i16; 2]]) -> anyhow::Result<Option<PathBuf>> {
        let (path, within) = match &self.place {
            Output::Nowhere => return Ok(None),
            Output::File(file) => (file.clone(), None),
            Output::Folder(folder, stems) => {
                let name = format!("{}.wav", stems[project]);
                (folder.join(&name), Some((folder, name)))
            }
        };
        let bytes = match self.format {
            Format::Wav => wav(frames),
            Format::Flac => flac(frames).map_err(|why| anyhow::anyhow!("this is a bug in Eddy: FLAC: {why}"))?,
        };
        let written = match within {
            Some((folder, name)) => project::write_into(folder, &name, |file| file.write_all(&bytes)),
            None => project::write_with(&path, |file| file.write_all(&bytes)),
        };
        written.with_context(|| format!("cannot write {}", path.display()))?;
        Ok(Some(path))
    }
}

/// The format with a file's extension.
fn format_of(path: &Path) -> Option<Format> {
    match path.extension()?.to_string_lossy().to_ascii_lowercase().as_str() {
        "wav" => Some(Format::Wav),
        "flac" => Some(Format::Flac),
        _ => None,
    }
}

/// The report, and the result.
#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    #[serde(skip_serializing_if = "Option::is_none")]
    sound: Option<&'a SoundReport>,
}

#[derive(Serialize)]
struct SoundReport {
    seconds: f64,
    samples: usize,
    /// The median of the blocks, 6 s of sound each.
    block_ms: Option<f64>,
    file: Option<PathBuf>,
}

pub(super) fn run(args: &RenderArgs, sounds: &Sounds, inputs: &ScriptedInputs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::of(&args.run);
    let blocks = sounds.frames.div_ceil(BLOCK_FRAMES);
    let progress = CallProgress::new(args.progress(), args.project.len() * blocks as usize, "blocks");
    for (index, spec) in args.project.iter().enumerate() {
        let mut report = Report::new(spec);
        progress.open(&report.title());
        let made = machine.attempt(&mut report, |machine, report| {
            let opened = Opening::new(spec, &args.run, inputs).sound_pass().open(machine, report)?;
            let mut offline = opened.offline;
            let (mut frames, mut millis) = (Vec::new(), Vec::new());
            let progress = progress.start(&report.title(), blocks as usize, blocks);
            for block in 0..blocks {
                let began = Instant::now();
                frames.extend(offline.draw_sound(block)?);
                millis.push(millis_since(began));
                progress.step();
            }
            frames.truncate(sounds.frames as usize);
            let file = sounds.write(index, &frames)?;
            let seconds = frames.len() as f64 / f64::from(SAMPLE_RATE);
            Ok::<_, RunError>(SoundReport { seconds, samples: frames.len(), block_ms: median(millis), file })
        });
        progress.end(&report, blocks as usize);
        let words = made.as_ref().map_or(String::new(), |made| {
            let file = made.file.as_ref().map_or(String::new(), |file| format!(": {}", shown_path(file)));
            let millis = made.block_ms.unwrap_or_default();
            format!("{}: {:.1} s of sound, {millis:.0} ms per block of 6 s{file}", report.title(), made.seconds)
        });
        printer.print_as(&JsonLine { report: &report, sound: made.as_ref() }, &report, &words)?;
    }
    Ok(printer.exit_code())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::{args::Cli, command::Command};
    use clap::Parser;

    fn sounds(line: &str) -> Result<Option<Sounds>, String> {
        match Cli::try_parse_from(["eddy", "render"].into_iter().chain(line.split(' '))).unwrap().command {
            Some(Command::Render(args)) => Sounds::of(&args),
            _ => unreachable!(),
        }
    }

    #[test]
    fn a_sound_is_written_to_a_file_or_into_a_folder() {
        let of = |line| sounds(line).unwrap().unwrap();
        let file = |name: &str| Output::File(PathBuf::from(name));
        let one = of("a --pass sound --out x.FLAC --secs 0.5");
        assert_eq!((one.format, one.frames, one.place), (Format::Flac, 22_050, file("x.FLAC")));
        let whole = of("a --pass sound --out x.wav");
        assert_eq!((whole.format, whole.frames), (Format::Wav, 7_938_000));
        let folder = of("x/a.json b --pass sound --out o");
        assert_eq!(folder.place, Output::Folder(PathBuf::from("o"), vec!["a".into(), "b".into()]));
        assert_eq!(of("a --pass sound --json").place, Output::Nowhere);
        assert_eq!(sounds("a --out x.png"), Ok(None));
    }

    #[test]
    fn invalid_options_are_rejected_with_a_fix() {
        for (line, says) in [
            ("a --out x.wav", "add --pass sound"),
            ("a --out x.png --secs 3", "add --pass sound"),
            ("a --pass sound --out x.png", ".wav or .flac"),
            ("a --pass sound --out x.mp3", ".wav or .flac"),
            ("a --pass sound --out x.wav --secs 181", "180 at most"),
            ("a --pass sound --out x.wav --at 3", "--at is about pictures"),
            ("a --pass sound --out x.wav --format png", "--format is about pictures"),
            ("a --pass sound:1 --out x.wav", "sound:1"),
            ("a b --pass sound --out x.wav", "2 sounds"),
        ] {
            let message = sounds(line).expect_err(line);
            assert!(message.contains(says), "{line}: {message}");
        }
    }
}
