//! Damaged files: none panics, and each ends in time.

use super::{
    animated::{apng, gif, webp},
    *,
};
use std::time::Instant;

/// Flips bits, cuts out, doubles or overwrites parts, or truncates.
fn damaged(whole: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = whole.to_vec();
    for _ in 0..1 + random.below(4) {
        let length = bytes.len().max(1) as u64;
        let at = random.below(length) as usize;
        let end = (at + 1 + random.below(16) as usize).min(bytes.len());
        match random.below(6) {
            0 | 1 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << random.below(8)),
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..end)),
            4 => {
                let part = bytes[at..end].to_vec();
                bytes.splice(at..at, part);
            }
            _ => bytes.iter_mut().skip(at).take(4).for_each(|byte| *byte = random.next() as u8),
        }
    }
    bytes
}

/// Plays a few positions of a video.
fn play(video: &Video) {
    for at in [0.0, 0.2, 3.1, 0.1] {
        let shown = video.frame_at(at, Pace::Exact);
        if let Some(frame) = shown.frame {
            assert_eq!(frame.texels.len(), video.info().frame_bytes());
        }
    }
}

#[test]
fn damaged_animations() {
    let mut random = Random(3);
    for (what, whole) in [("gif", gif(&[50, 10, 200])), ("apng", apng(&[50, 10, 200])), ("webp", webp(&[50, 10, 200]))]
    {
        let (mut played, mut longest) = (0, Duration::ZERO);
        for case in 0..500 {
            let bytes = damaged(&whole, &mut random);
            let began = Instant::now();
            if let Ok(video) = Video::of_animation(Path::new("a"), bytes, &Pool::default()) {
                play(&video);
                played += 1;
            }
            longest = longest.max(began.elapsed());
            assert!(began.elapsed() < Duration::from_secs(8), "{what} {case}: {:?}", began.elapsed());
        }
        println!("{what}: {played} of 500 played, the longest took {longest:?}");
        assert!(played > 50, "{what}: {played}");
    }
}

#[test]
fn damaged_files() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let mut random = Random(4);
    // Each case starts three processes. `EDDY_VIDEO_CASES=500` makes it a long run.
    let cases: u64 = std::env::var("EDDY_VIDEO_CASES").map_or(25, |n| n.parse().unwrap());
    for (name, args) in [
        ("a.mp4", &["-c:v", "libx264", "-pix_fmt", "yuv420p"][..]),
        ("a.webm", &["-c:v", "libvpx", "-pix_fmt", "yuv420p"]),
    ] {
        let path = folder.path().join(name);
        encode(&path, 8, "25", args);
        let whole = fs::read(&path).unwrap();
        let (mut played, mut longest) = (0, Duration::ZERO);
        for case in 0..cases {
            fs::write(&path, damaged(&whole, &mut random)).unwrap();
            let began = Instant::now();
            let tools = Tools { patience: Duration::from_secs(5), ..Tools::default() };
            if let Ok(video) = open_with(&path, &tools, &Pool::default()) {
                play(&video);
                played += 1;
            }
            longest = longest.max(began.elapsed());
            assert!(began.elapsed() < Duration::from_secs(25), "{name} {case}: {:?}", began.elapsed());
        }
        println!("{name}: {played} of {cases} played, the longest took {longest:?}");
    }
}
