//! Animated images and sequences, which do not need ffmpeg.

use super::*;
use image::{
    Delay, Frame as ImageFrame, RgbaImage,
    codecs::gif::{GifEncoder, Repeat},
};

/// Returns an animated GIF whose frames have these lengths in milliseconds.
pub(super) fn gif(delays: &[u32]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = GifEncoder::new(&mut bytes);
    encoder.set_repeat(Repeat::Infinite).unwrap();
    for (n, delay) in delays.iter().enumerate() {
        let image = RgbaImage::from_pixel(SIDE.0, SIDE.1, image::Rgba(color(n)));
        let delay = Delay::from_numer_denom_ms(*delay, 1);
        encoder.encode_frame(ImageFrame::from_parts(image, 0, 0, delay)).unwrap();
    }
    drop(encoder);
    bytes
}

/// Returns a PNG of one colour.
fn png(n: usize) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let image = RgbaImage::from_pixel(SIDE.0, SIDE.1, image::Rgba(color(n)));
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

/// Returns a chunk of a PNG with its checksum.
fn chunk(kind: &[u8; 4], content: &[u8]) -> Vec<u8> {
    let mut crc = !0_u32;
    for byte in kind.iter().chain(content) {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = if crc & 1 != 0 { (crc >> 1) ^ 0xedb8_8320 } else { crc >> 1 };
        }
    }
    [&(content.len() as u32).to_be_bytes()[..], kind, content, &(!crc).to_be_bytes()].concat()
}

/// Returns an animated PNG whose frames have these lengths in milliseconds.
pub(super) fn apng(delays: &[u16]) -> Vec<u8> {
    let first = png(0);
    let parts = |bytes: &[u8]| -> Vec<([u8; 4], Vec<u8>)> {
        let (mut at, mut found) = (8, Vec::new());
        while at + 12 <= bytes.len() {
            let length = u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
            found.push((bytes[at + 4..at + 8].try_into().unwrap(), bytes[at + 8..at + 8 + length].to_vec()));
            at += 12 + length;
        }
        found
    };
    let mut out = first[..8].to_vec();
    let mut sequence = 0_u32;
    let control = |sequence: &mut u32, delay: u16| {
        let sizes = [*sequence, SIDE.0, SIDE.1, 0, 0].map(u32::to_be_bytes).concat();
        *sequence += 1;
        chunk(b"fcTL", &[&sizes[..], &delay.to_be_bytes(), &1000_u16.to_be_bytes(), &[0, 0]].concat())
    };
    for (kind, content) in parts(&first) {
        if kind == *b"IDAT" && sequence == 0 {
            out.extend(chunk(b"acTL", &[delays.len() as u32, 0].map(u32::to_be_bytes).concat()));
            out.extend(control(&mut sequence, delays[0]));
        }
        if kind == *b"IEND" {
            for (n, delay) in delays.iter().enumerate().skip(1) {
                out.extend(control(&mut sequence, *delay));
                for (_, data) in parts(&png(n)).into_iter().filter(|(kind, _)| kind == b"IDAT") {
                    out.extend(chunk(b"fdAT", &[&sequence.to_be_bytes()[..], &data].concat()));
                    sequence += 1;
                }
            }
        }
        out.extend(chunk(&kind, &content));
    }
    out
}

/// Returns an animated WebP whose frames have these lengths in milliseconds.
pub(super) fn webp(delays: &[u32]) -> Vec<u8> {
    let riff = |kind: &[u8; 4], content: &[u8]| {
        let padding = &[0][..content.len() % 2];
        [&kind[..], &(content.len() as u32).to_le_bytes(), content, padding].concat()
    };
    let three = |n: u32| n.to_le_bytes()[..3].to_vec();
    let mut body = b"WEBP".to_vec();
    let canvas = [vec![0x12, 0, 0, 0], three(SIDE.0 - 1), three(SIDE.1 - 1)].concat();
    body.extend(riff(b"VP8X", &canvas));
    body.extend(riff(b"ANIM", &[0; 6]));
    for (n, delay) in delays.iter().enumerate() {
        let mut still = std::io::Cursor::new(Vec::new());
        let image = RgbaImage::from_pixel(SIDE.0, SIDE.1, image::Rgba(color(n)));
        image.write_to(&mut still, image::ImageFormat::WebP).unwrap();
        // Its only chunk of pixels.
        let still = still.into_inner();
        let place = [three(0), three(0), three(SIDE.0 - 1), three(SIDE.1 - 1), three(*delay), vec![2]].concat();
        body.extend(riff(b"ANMF", &[&place[..], &still[12..]].concat()));
    }
    riff(b"RIFF", &body)
}

fn of(bytes: Vec<u8>) -> Video {
    Video::of_animation(Path::new("a"), bytes, &Pool::default()).unwrap()
}

#[test]
fn frames_last_for_their_declared_delays() {
    // The second is shorter than browsers accept: it lasts 100 ms.
    let starts = [0.0, 0.05, 0.15, 0.35, 0.38];
    for (what, video) in [
        ("gif", of(gif(&[50, 10, 200, 30, 120]))),
        ("apng", of(apng(&[50, 10, 200, 30, 120]))),
        ("webp", of(webp(&[50, 10, 200, 30, 120]))),
    ] {
        assert_eq!((video.info().width, video.info().height), SIDE, "{what}");
        assert!((video.info().seconds - 0.5).abs() < 1e-9, "{what}: {:?}", video.info());
        for round in [0.0, 0.5, 5.0, 0.0] {
            for (n, start) in starts.iter().enumerate() {
                let end = starts.get(n + 1).unwrap_or(&0.5);
                for at in [start + 1e-6, end - 1e-4] {
                    assert_eq!(shown(&video, round + at), n, "{what} at {}", round + at);
                }
            }
        }
    }
}

#[test]
fn animated_and_still_images_are_told_apart() {
    for bytes in [gif(&[50, 50]), apng(&[50, 50]), webp(&[50, 50])] {
        assert!(is_animation(&bytes) && is_animated(&bytes));
    }
    assert!(!is_animation(&png(0)) && !is_animated(&png(0)));
    assert!(is_animation(&gif(&[50])) && !is_animated(&gif(&[50])));
    assert!(!is_animation(b"") && !is_animated(b"GIF89a"));
    // A still picture is a video of one frame.
    assert_eq!(shown(&of(png(7)), 3.3), 7);
    assert_eq!(shown(&of(gif(&[40])), 3.3), 0);
}

#[test]
fn numbered_images_play_at_the_rate_of_their_folder() {
    let folder = tempfile::tempdir().unwrap();
    let walk = folder.path().join("walk-10fps");
    fs::create_dir(&walk).unwrap();
    for n in 0..15 {
        fs::write(walk.join(format!("{:03}.png", n + 8)), png(n)).unwrap();
    }
    fs::write(walk.join("024.png"), png(99)).unwrap();
    let home = folder.path().to_owned();
    let read = move |path: &Path| eddy_project::confine::read(&home, path, eddy_project::limits::MEDIA_FILE);
    let place = FileLocation { path: Path::new("walk-10fps/008.png"), read: Arc::new(read) };
    let video = Video::of_sequence(&place, &png(0), &Pool::default()).unwrap();
    assert!((video.info().seconds - 1.5).abs() < 1e-9, "the gap ends it: {:?}", video.info());
    for at in [0.0, 0.05, 0.1, 0.31, 1.45, 1.5, 2.95, 0.65] {
        assert_eq!(shown(&video, at), (at * 10.0 + 1e-6) as usize % 15, "at {at}");
    }
}
