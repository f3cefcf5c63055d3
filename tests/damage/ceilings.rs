//! Malicious files: the peak memory of reading each of them stays below the row of its reader in the table "Memory and
//! time of each reader" of SECURITY.md.

use super::{MEMORY, mutate::Random};
use eddy::{
    engine::TargetForm,
    media::{self, MediaKey, mesh},
    playback::{
        checkpoint::{self, Moment},
        scene::Scene,
    },
    project::{Media, MeshSource, PassName, limits},
};
use eddy_texture::{Dimension, TexelFormat, TextureShape};
use flate2::{Compression, write::ZlibEncoder};
use image::{DynamicImage, ImageFormat};
use std::{
    fs,
    io::{Cursor, Write},
    path::Path,
    time::{Duration, Instant},
};

pub(crate) const MIB: usize = 1 << 20;
/// The number of inputs of each kind.
const INPUTS: u64 = 300;

/// The results for the inputs of one kind.
pub(crate) struct Row {
    name: &'static str,
    inputs: u64,
    read: u64,
    peak: usize,
    longest: Duration,
    /// The maximum number of bytes per byte of a file of 64 KiB or more.
    ratio: usize,
}

/// Reads `INPUTS` files made by `make`, and fails if reading one uses more bytes at once than `max_bytes` allows.
pub(crate) fn measure(
    name: &'static str,
    file: &str,
    make: impl Fn(&mut Random) -> Vec<u8>,
    read: impl Fn(&Path) -> bool,
    max_bytes: impl Fn(&[u8]) -> usize,
) -> Row {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join(file);
    let mut row = Row { name, inputs: INPUTS, read: 0, peak: 0, longest: Duration::ZERO, ratio: 0 };
    for n in 0..INPUTS {
        let bytes = make(&mut Random::new(n));
        fs::write(&path, &bytes).unwrap();
        let (length, max_bytes) = (bytes.len(), max_bytes(&bytes));
        drop(bytes);
        let (before, start) = (MEMORY.start(), Instant::now());
        row.read += u64::from(read(&path));
        let peak = MEMORY.peak().saturating_sub(before);
        row.longest = row.longest.max(start.elapsed());
        row.peak = row.peak.max(peak);
        if length >= 64 << 10 {
            row.ratio = row.ratio.max(peak / length);
        }
        assert!(
            peak <= max_bytes,
            "{name}: input {n} of {length} bytes takes {peak} bytes, but the limit is {max_bytes}"
        );
    }
    row
}

/// Compares every reader with its row. Part of the only test of this program, as memory is measured for the whole
/// process.
pub(crate) fn check() {
    let mut rows = vec![pictures(), scenes(), checkpoints(), models()];
    rows.extend(super::readers::rows());
    rows.extend(super::streams::rows());
    println!("  inputs    read     peak  longest  max bytes per byte");
    for row in &rows {
        let (peak, millis) = (row.peak >> 10, row.longest.as_millis());
        println!("{:8} {:7} {peak:5} KiB {millis:5} ms {:6}  {}", row.inputs, row.read, row.ratio, row.name);
        // If nothing of a generator's files is read, it tests only the first lines of a reader.
        assert!(row.read * 20 > row.inputs && row.read < row.inputs, "{}: {} read", row.name, row.read);
    }
}

/// PNG files of 1 to 4 channels, whose texels may be missing: a decoded picture is in memory once.
fn pictures() -> Row {
    let make = |random: &mut Random| {
        let side = 256 + random.below(768) as u32;
        let image = match random.below(8) {
            0 => DynamicImage::new_luma8(side, side),
            1 => DynamicImage::new_luma_a8(side, side),
            2 => DynamicImage::new_rgb8(side, side),
            3 => DynamicImage::new_luma16(side, side),
            4 => DynamicImage::new_luma_a16(side, side),
            5 => DynamicImage::new_rgb16(side, side),
            6 => DynamicImage::new_rgba16(side, side),
            _ => DynamicImage::new_rgba8(side, side),
        };
        let mut png = Cursor::new(Vec::new());
        image.write_to(&mut png, ImageFormat::Png).unwrap();
        let mut png = png.into_inner();
        // Some claim to be larger than they are, beyond the memory of any machine.
        if random.below(3) == 0 {
            let width = [1025u32, 32_768, 40_000, u32::MAX >> 1][random.below(4)];
            png[16..20].copy_from_slice(&width.to_be_bytes());
            super::mutate::fix_png_checksums(&mut png);
        }
        png
    };
    let read = |path: &Path| {
        let key = MediaKey { media: Media::Picked(path.into()), dimension: Dimension::D2, vflip: true };
        media::load(&key, None, None).is_ok()
    };
    // One copy of the texels, of the size in the header, if it is within the limits; otherwise nothing is decoded.
    let max_bytes = |png: &[u8]| {
        let side = |at: usize| u64::from(u32::from_be_bytes([png[at], png[at + 1], png[at + 2], png[at + 3]]));
        let (width, height) = (side(16), side(20));
        let is_decoded = width <= u64::from(limits::PICTURE_SIDE);
        // The decoder has a few rows of its own.
        // Depth and colour type (PNG, third edition, section 11.2.1): channels of 16 bits are decoded as such.
        let channels = match png[25] {
            0 => 1,
            4 => 2,
            2 => 3,
            _ => 4,
        };
        let texel = if png[24] == 16 { (2 * channels).max(4) } else { 4 };
        let texels = if is_decoded { texel * width as usize * (height as usize + 16) } else { 0 };
        texels + 2 * png.len() + MIB
    };
    measure("PNG", "a.png", make, read, max_bytes)
}

/// Image files whose project has many values, a large manifest, or a late frame.
fn scenes() -> Row {
    let project = r#"{\"eddy_snapshot\":1,\"name\":\"p\",\"origin\":\"unsaved\",\"manifest\":\"eddy = 1\\n[passes.image]\\n\",\"texts\":[{\"pass\":\"image\",\"stage\":null,\"name\":\"image.glsl\",\"path\":null,\"text\":\"x\"}],\"picked\":[]}"#;
    let make = move |random: &mut Random| {
        let frame = [0u32, 35_999, 100_000_000, i32::MAX as u32, u32::MAX][random.below(5)];
        let more = match random.below(4) {
            0 => String::new(),
            1 => format!(r#","x":[{}0]"#, "0,".repeat(1 << random.below(22))),
            2 => format!(r#","x":{}{}"#, "[".repeat(1 << random.below(18)), "]".repeat(4)),
            _ => format!(r#","x":[{}[]]"#, "[],".repeat(1 << random.below(21))),
        };
        let text = format!(
            r#"{{"eddy_picture":1,"eddy":"1","device":"d","pass":"image","frame":{frame},"size":[8,8],"project":"{project}","script":{{"fps":60.0}}{more}}}"#
        );
        let mut data = b"eddy\0\x01\0\0\0".to_vec();
        let mut packed = ZlibEncoder::new(&mut data, Compression::fast());
        packed.write_all(text.as_bytes()).unwrap();
        packed.finish().unwrap();
        let mut png = Cursor::new(Vec::new());
        DynamicImage::new_rgb8(8, 8).write_to(&mut png, ImageFormat::Png).unwrap();
        let png = png.into_inner();
        [&png[..33], &(data.len() as u32).to_be_bytes(), b"iTXt", &data, &[0; 4], &png[33..]].concat()
    };
    let read = |path: &Path| Scene::read(path).is_ok_and(|scene| scene.frames(true).is_ok());
    // The text is at most 8 MiB here, and is read in a buffer that doubles; nothing else grows with it.
    measure("project in an image", "a.png", make, read, |file| 48 * MIB + 2 * file.len())
}

/// Checkpoints that list targets that are missing or smaller in the program.
fn checkpoints() -> Row {
    let moment = || Moment {
        eddy: "1".into(),
        project: "p".into(),
        fingerprint: "0".into(),
        frame: 2,
        size: (64, 64),
        device: "d".into(),
    };
    let shape = TextureShape::flat(64, 64, TexelFormat::Rgba32f);
    let form = TargetForm { pass: PassName::buffer("A"), index: 0, shape, textures: 2, is_read: true };
    let make = move |random: &mut Random| {
        let entry = |pass: &str, side: u32| {
            format!(
                r#"{{"pass":"{pass}","target":0,"format":"rgba32f","width":{side},"height":{side},"faces":1,"textures":1}}"#
            )
        };
        let own = entry("buffer_a", [64, 64, 65, 1024][random.below(4)]);
        let foreign = (0..random.below(3)).map(|n| entry(&format!("buffer_b{n}"), 256 << random.below(8)));
        let targets: Vec<String> = std::iter::once(own).chain(foreign).collect();
        let head = format!(
            r#"{{"eddy_checkpoint":1,"eddy":"1","project":"p","fingerprint":"0","frame":2,"size":[64,64],"device":"d","targets":[{}]}}"#,
            targets.join(",")
        );
        let mut file = format!("{head}\n").into_bytes();
        let mut packed = flate2::write::GzEncoder::new(&mut file, Compression::fast());
        let bytes = [64 * 64 * 16, 64 * 64 * 16, 64 * MIB][random.below(3)];
        packed.write_all(&vec![0; bytes]).unwrap();
        packed.finish().unwrap();
        file
    };
    let read = move |path: &Path| checkpoint::read(path, &moment(), std::slice::from_ref(&form)).is_ok();
    // Two textures of the program, a first line of at most 1 MiB, and the memory for decompression.
    measure("checkpoint", "a.eddystate", make, read, move |_| 2 * shape.bytes() as usize + 4 * MIB)
}

/// glTF files whose accessors count more elements than the file contains.
fn models() -> Row {
    let make = |random: &mut Random| {
        let count = 1u64 << random.below(40);
        let indices = ["", r#","indices":1"#][random.below(2)];
        let view = ["", r#""bufferView":0,"#][random.below(2)];
        let nodes = 1 + random.below(30);
        let list = |text: &str| vec![text; nodes].join(",");
        let scene: Vec<String> = (0..nodes).map(|n| n.to_string()).collect();
        format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],"nodes":[{}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}{indices}}}]}}],
            "accessors":[{{{view}"componentType":5126,"count":{},"type":"VEC3"}},
            {{"componentType":5121,"count":{count},"type":"SCALAR"}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}}],
            "buffers":[{{"byteLength":36,"uri":"data:;base64,{}"}}]}}"#,
            scene.join(","),
            list(r#"{"mesh":0}"#),
            if view.is_empty() { count } else { 3 },
            "A".repeat(48),
        )
        .into_bytes()
    };
    let read = |path: &Path| {
        let name = path.file_name().unwrap();
        mesh::load(&MeshSource::File(name.into()), None, path.parent()).is_ok()
    };
    // 65,536 zeros, each a vertex of 64 bytes and an index, which flat normals and joining copy.
    measure("glTF without data", "a.gltf", make, read, |file| 4 * 65_536 * 68 + 64 * file.len() + MIB)
}
