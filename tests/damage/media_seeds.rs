//! Sounds, videos, cubemaps and volumes to be damaged. Formats that Eddy does not write itself are made by ffmpeg, if
//! it is installed.

use super::seeds::{File, IMAGE, Seed, fixed, target};
use exr::prelude::{SpecificChannels, Vec2, WritableImage};
use image::{
    Delay, Frame, Rgba, RgbaImage,
    codecs::gif::{GifEncoder, Repeat},
};
use std::{
    io::Cursor,
    process::{Command, Stdio},
};

pub(crate) fn all() -> Vec<Seed> {
    let mut seeds = textures();
    seeds.push(seed("animation", "pic.gif", "video", gif()));
    let tone = ["-f", "lavfi", "-i", "sine=440:duration=0.4"];
    let sounds: [(&str, &str, &[&str]); 7] = [
        ("wav", "tone.wav", &[]),
        ("wav of 24 bits", "tone.wav", &["-c:a", "pcm_s24le"]),
        ("mp3", "tone.mp3", &["-c:a", "libmp3lame"]),
        ("ogg", "tone.ogg", &["-c:a", "libvorbis"]),
        ("flac", "tone.flac", &["-c:a", "flac"]),
        ("m4a", "tone.m4a", &["-c:a", "aac"]),
        ("aac", "tone.aac", &["-c:a", "aac"]),
    ];
    for (name, file, codec) in sounds {
        seeds.extend(ffmpeg(&tone, codec, file).map(|bytes| seed(name, file, "music", bytes)));
    }
    let picture = ["-f", "lavfi", "-i", "testsrc=size=32x18:rate=10:duration=0.5"];
    let videos: [(&str, &str, &[&str]); 3] = [
        ("mp4", "clip.mp4", &["-c:v", "libx264", "-pix_fmt", "yuv420p"]),
        ("webm", "clip.webm", &["-c:v", "libvpx-vp9", "-cpu-used", "8"]),
        ("mkv", "clip.mkv", &["-c:v", "ffv1"]),
    ];
    for (name, file, codec) in videos {
        seeds.extend(ffmpeg(&picture, codec, file).map(|bytes| seed(name, file, "video", bytes)));
    }
    seeds
}

fn seed(name: &'static str, file: &'static str, kind: &str, bytes: Vec<u8>) -> Seed {
    let kind = if kind.is_empty() { String::new() } else { format!(", kind = \"{kind}\"") };
    let toml = format!("eddy = 1\n\n[passes.image]\nchannels.0 = {{ file = \"{file}\"{kind} }}\n");
    let sampled = if kind.contains("cubemap") {
        "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, vec3(p / iResolution.xy, 1.0)); }\n"
    } else if kind.contains("volume") {
        "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, vec3(p / iResolution.xy, 0.5)); }\n"
    } else {
        IMAGE
    };
    let files: Vec<File> = vec![fixed("eddy.toml", &toml), fixed("image.glsl", sampled), target(file, bytes)];
    Seed { name, files, entry: "" }
}

/// Makes a file by ffmpeg; `None` if it is not installed or lacks the codec.
fn ffmpeg(source: &[&str], codec: &[&str], file: &str) -> Option<Vec<u8>> {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join(file);
    let mut command = Command::new("ffmpeg");
    command.args(["-v", "error", "-nostdin"]).args(source).args(codec).arg(&path);
    let status = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
    if !status.is_ok_and(|status| status.success()) {
        crate::support::skipped(&format!("damaged {file} files: ffmpeg cannot make one"));
        return None;
    }
    std::fs::read(path).ok()
}

fn gif() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = GifEncoder::new(&mut bytes);
    encoder.set_repeat(Repeat::Infinite).unwrap();
    for n in 0..3u8 {
        let picture = RgbaImage::from_fn(9, 7, |x, y| Rgba([x as u8 * 20, y as u8 * 30, n * 90, 255]));
        encoder.encode_frame(Frame::from_parts(picture, 0, 0, Delay::from_numer_denom_ms(50, 1))).unwrap();
    }
    drop(encoder);
    bytes
}

fn textures() -> Vec<Seed> {
    let texels = |count: usize| (0..count).map(|n| (n * 37) as u8).collect::<Vec<u8>>();
    let mut volume = b"BIN\0".to_vec();
    [5u32, 4, 3].iter().for_each(|side| volume.extend(side.to_le_bytes()));
    volume.extend([4, 0, 0, 0]);
    volume.extend(texels(5 * 4 * 3 * 4));
    let mut exr = Cursor::new(Vec::new());
    let rgb = SpecificChannels::rgb(|at: Vec2<usize>| (at.x() as f32, at.y() as f32, 0.5f32));
    exr::prelude::Image::from_channels((12, 9), rgb).write().to_buffered(&mut exr).unwrap();
    vec![
        seed("exr", "pic.exr", "", exr.into_inner()),
        seed("bin", "fog.bin", "volume", volume),
        seed("ktx2", "pic.ktx2", "", ktx2(37, [4, 6, 0], 1, &texels(4 * 6 * 4))),
        seed("ktx2 cubemap", "sky.ktx2", "cubemap", ktx2(37, [2, 2, 0], 6, &texels(2 * 2 * 6 * 4))),
        seed("dds", "pic.dds", "", dds(28, [8, 8], &texels(8 * 8 * 4))),
        // BC1: 8 bytes per 4x4 texels.
        seed("dds of blocks", "pic.dds", "", dds(71, [8, 8], &texels(4 * 8))),
    ]
}

/// Returns a KTX2 file of one level, not compressed. `format` is a VkFormat. KTX 2.0 specification, section 3.
fn ktx2(format: u32, [width, height, depth]: [u32; 3], faces: u32, level: &[u8]) -> Vec<u8> {
    const DESCRIPTOR: u64 = 104;
    let mut file = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    // Header; index: descriptor of 4 bytes, no keys, no global data.
    for field in [format, 1, width, height, depth, 0, faces, 1, 0, DESCRIPTOR as u32, 4, 0, 0, 0, 0, 0, 0] {
        file.extend(field.to_le_bytes());
    }
    for field in [DESCRIPTOR + 4, level.len() as u64, level.len() as u64] {
        file.extend(field.to_le_bytes());
    }
    file.extend(4u32.to_le_bytes());
    file.extend(level);
    file
}

/// Returns a DDS file with the header for DXGI formats, of one level.
fn dds(format: u32, [width, height]: [u32; 2], texels: &[u8]) -> Vec<u8> {
    let mut words = vec![u32::from_le_bytes(*b"DDS "), 124, 0x1007, height, width, 0, 0, 1];
    words.extend([0; 11]);
    words.extend([32, 4, u32::from_le_bytes(*b"DX10"), 0, 0, 0, 0, 0]);
    words.extend([0x1000, 0, 0, 0, 0]);
    words.extend([format, 3, 0, 1, 0]);
    words.into_iter().flat_map(u32::to_le_bytes).chain(texels.iter().copied()).collect()
}
