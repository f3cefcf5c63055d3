//! Videos that are made here, so that the number of a frame can be read back from its colour.

mod animated;
mod camera;
mod damage;
mod files;
mod safety;

use super::*;
use std::{
    fs,
    io::Write,
    process::{Command, Stdio},
};

/// Says that a test is left out, as `eddy_gpu::testing` does.
fn skipped(why: &str) {
    let line = format!("{}: {why}\n", std::thread::current().name().unwrap_or("a test"));
    let _ = write!(std::io::stderr(), "SKIPPED {line}");
    if let Some(path) = std::env::var_os("EDDY_SKIPS") {
        let file = fs::OpenOptions::new().append(true).create(true).open(path);
        file.unwrap().write_all(line.as_bytes()).unwrap();
    }
}

/// Returns whether ffmpeg is here, or says that the test is left out.
fn has_ffmpeg() -> bool {
    let runs = Command::new("ffmpeg").arg("-version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    let is_here = runs.is_ok_and(|status| status.success());
    if !is_here {
        assert!(std::env::var_os("EDDY_REQUIRE_GPU").is_none(), "ffmpeg is required here");
        skipped("ffmpeg is not installed");
    }
    is_here
}

const SIDE: (u32, u32) = (16, 12);

/// The colour of a frame: its number in red and green.
fn color(n: usize) -> [u8; 4] {
    [(n % 16 * 16) as u8, (n / 16 * 16) as u8, 128, 255]
}

/// The number of the frame that a colour is nearest to.
fn number(frame: &Frame) -> usize {
    let middle = frame.texels.len() / 8 * 4 + SIDE.0 as usize / 2 * 4;
    let [r, g, ..] = frame.texels[middle..] else { panic!("a frame without texels") };
    let near = |v: u8| (usize::from(v) + 8) / 16;
    near(g) * 16 + near(r)
}

/// Encodes frames by ffmpeg; `args` stand between the input and the name.
fn encode(path: &Path, frames: usize, rate: &str, args: &[&str]) {
    let size = format!("{}x{}", SIDE.0, SIDE.1);
    let mut child = Command::new("ffmpeg")
        .args(["-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba", "-s", &size, "-r", rate, "-i", "pipe:0"])
        .args(args)
        .arg(path)
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    for n in 0..frames {
        pipe.write_all(&color(n).repeat((SIDE.0 * SIDE.1) as usize)).unwrap();
    }
    drop(pipe);
    assert!(child.wait().unwrap().success(), "{}", path.display());
}

/// No loss.
const FFV1: [&str; 4] = ["-c:v", "ffv1", "-pix_fmt", "bgra"];

fn open(path: &Path) -> Result<Video, VideoError> {
    open_with(path, &Tools::default(), &Pool::default())
}

fn open_with(path: &Path, tools: &Tools, pool: &Pool) -> Result<Video, VideoError> {
    let file = fs::File::open(path).unwrap();
    Video::of_file(path, file, path.canonicalize().unwrap(), tools, pool)
}

fn shown(video: &Video, seconds: f64) -> usize {
    let shown = video.frame_at(seconds, Pace::Exact);
    assert!(!shown.is_late);
    number(&shown.frame.expect("a frame"))
}

/// Numbers that look random and are the same in each run (splitmix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    fn unit(&mut self) -> f64 {
        self.next() as f64 / u64::MAX as f64
    }
}
