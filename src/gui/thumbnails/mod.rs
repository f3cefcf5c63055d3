//! Small pictures: of presets, which lie in the program and come alive under the pointer, and of textures. They are
//! made in the background and kept while the window is open.

mod live;

use crate::{
    gpu::Gpu,
    media::{self, MediaKey, Texels},
    project::{TexelFormat, presets},
};
use egui::{ColorImage, TextureHandle, TextureOptions};
use live::Live;
use std::{
    collections::HashMap,
    fs::File,
    io::{Cursor, Read as _},
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    sync::{
        Arc,
        mpsc::{Receiver, Sender, channel},
    },
};

/// Longest side of a texture's picture.
const SWATCH: usize = 96;
/// The most bytes and pixels a side that a recent project's picture may have.
const RECENT_BYTES: u64 = 1 << 20;
const RECENT_SIDE: u32 = 1024;

/// The subject of a small picture.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Subject {
    Preset(String),
    /// The file of a recent project's picture, and which of those that were written there it is.
    Recent(PathBuf, u64),
    /// A picture a channel can read; files lie relative to the folder.
    Texture(MediaKey, Option<PathBuf>),
}

/// The state of a small picture.
#[derive(Clone)]
pub enum Thumbnail {
    Waiting,
    Ready(TextureHandle),
    /// The reason why there is none.
    Failed(String),
}

pub struct Thumbnails {
    known: HashMap<Subject, Thumbnail>,
    wanted: Sender<Subject>,
    made: Receiver<(Subject, Result<ColorImage, String>)>,
    live: Live,
}

impl Thumbnails {
    /// Starts the thread that makes them. `wake` is called when there is a new one.
    pub fn new(gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        let (wanted, wanted_here) = channel::<Subject>();
        let (made_here, made) = channel();
        let live = Live::new(gpu, wake.clone());
        let work = move || {
            while let Ok(subject) = wanted_here.recv() {
                // A panic is this picture's alone; the others are still wanted.
                let image = catch_unwind(AssertUnwindSafe(|| make(&subject)));
                let image = image.unwrap_or_else(|_| Err("this is a bug in Eddy".into()));
                if made_here.send((subject, image)).is_err() {
                    return;
                }
                wake();
            }
        };
        if let Err(e) = std::thread::Builder::new().name("thumbnails".into()).spawn(work) {
            // The cards then stay without pictures, which is all they lose.
            log::warn!("cannot start a thread for thumbnails: {e}");
        }
        Self { known: HashMap::new(), wanted, made, live }
    }

    /// Takes in what has been made since.
    pub fn update(&mut self, ctx: &egui::Context) {
        while let Ok((subject, image)) = self.made.try_recv() {
            let thumbnail = match image {
                Ok(image) => Thumbnail::Ready(ctx.load_texture(format!("{subject:?}"), image, TextureOptions::LINEAR)),
                Err(e) => Thumbnail::Failed(e),
            };
            self.known.insert(subject, thumbnail);
        }
        self.live.update(ctx);
    }

    /// Says which preset's picture moves; none: all stand still.
    pub fn animate(&mut self, name: Option<&str>) {
        self.live.want(name);
    }

    /// The newest frame of a preset's picture that moves.
    pub fn live(&self, name: &str) -> Option<TextureHandle> {
        self.live.frame(name)
    }

    /// The picture, as far as it is known; asks for it the first time.
    pub fn get(&mut self, subject: Subject) -> Thumbnail {
        if let Some(known) = self.known.get(&subject) {
            return known.clone();
        }
        if self.wanted.send(subject.clone()).is_err() {
            self.known.insert(subject, Thumbnail::Failed("the thumbnail thread has ended".into()));
            return Thumbnail::Waiting;
        }
        // The picture that was there before has served.
        if let Subject::Recent(file, _) = &subject {
            self.known.retain(|known, _| !matches!(known, Subject::Recent(other, _) if other == file));
        }
        self.known.insert(subject, Thumbnail::Waiting);
        Thumbnail::Waiting
    }
}

fn make(subject: &Subject) -> Result<ColorImage, String> {
    match subject {
        Subject::Preset(name) => preset(name),
        Subject::Recent(file, _) => recent(file),
        Subject::Texture(key, folder) => {
            let texels = media::load(key, folder.as_deref(), None).map_err(|e| e.to_string())?;
            Ok(swatch(&texels.flattened()))
        }
    }
}

/// The picture that lies in the program.
fn preset(name: &str) -> Result<ColorImage, String> {
    let bytes = presets::thumbnail(name).ok_or_else(|| format!("{name} has no thumbnail"))?;
    let image = image::load_from_memory(bytes).map_err(|e| e.to_string())?.to_rgba8();
    let size = [image.width() as usize, image.height() as usize];
    Ok(ColorImage::from_rgba_unmultiplied(size, image.as_raw()))
}

/// The picture of a recent project. Others can write where it lies: no more is read than one of ours has.
fn recent(file: &Path) -> Result<ColorImage, String> {
    let file = File::open(file).map_err(|e| e.to_string())?;
    let mut bytes = Vec::new();
    file.take(RECENT_BYTES).read_to_end(&mut bytes).map_err(|e| e.to_string())?;
    let mut reader = image::ImageReader::with_format(Cursor::new(bytes), image::ImageFormat::Jpeg);
    let mut limits = image::Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(RECENT_SIDE), Some(RECENT_SIDE));
    reader.limits(limits);
    let image = reader.decode().map_err(|e| e.to_string())?.to_rgba8();
    let size = [image.width() as usize, image.height() as usize];
    Ok(ColorImage::from_rgba_unmultiplied(size, image.as_raw()))
}

/// A texture as a small opaque picture, its top row first.
fn swatch(texels: &Texels) -> ColorImage {
    let (width, height) = (texels.shape.width.max(1) as usize, texels.shape.height.max(1) as usize);
    let step = width.max(height).div_ceil(SWATCH).max(1);
    let size = [width.div_ceil(step), height.div_ceil(step)];
    let mut bytes = Vec::with_capacity(size[0] * size[1] * 4);
    for y in 0..size[1] {
        for x in 0..size[0] {
            // Row 0 lies at the bottom.
            bytes.extend(texel(texels, x * step, height - 1 - y * step));
        }
    }
    ColorImage::from_rgba_unmultiplied(size, &bytes)
}

fn texel(texels: &Texels, x: usize, y: usize) -> [u8; 4] {
    let at = (y * texels.shape.width as usize + x) * texels.texel_bytes();
    let Some(bytes) = texels.bytes.get(at..at + texels.texel_bytes()) else { return [0, 0, 0, 255] };
    match texels.shape.format {
        TexelFormat::R8 => [bytes[0], bytes[0], bytes[0], 255],
        TexelFormat::Rgba8 => [bytes[0], bytes[1], bytes[2], 255],
        TexelFormat::Rgba32f => {
            let channel = |i: usize| {
                let value = bytes[4 * i..4 * i + 4].try_into().map_or(0.0, f32::from_le_bytes);
                (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
            };
            [channel(0), channel(1), channel(2), 255]
        }
        // No picture is decoded to any other.
        _ => [0, 0, 0, 255],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_has_a_picture() {
        for name in presets::names() {
            let image = preset(name).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(image.size, [320, 180], "{name}");
        }
        assert!(preset("no-such-preset").is_err());
    }

    #[test]
    fn a_recent_picture_that_is_missing_damaged_or_too_large_is_none() {
        let dir = tempfile::tempdir().unwrap();
        let path = |name: &str| dir.path().join(name);
        let save = |name: &str, side: u32| image::RgbImage::new(side, 4).save(path(name)).unwrap();
        save("good.jpg", 320);
        save("large.jpg", RECENT_SIDE + 1);
        assert_eq!(recent(&path("good.jpg")).unwrap().size, [320, 4]);
        let bytes = std::fs::read(path("good.jpg")).unwrap();
        std::fs::write(path("half.jpg"), &bytes[..bytes.len() / 4]).unwrap();
        std::fs::write(path("none.jpg"), "no picture").unwrap();
        std::fs::write(path("empty.jpg"), "").unwrap();
        for bad in ["missing.jpg", "large.jpg", "half.jpg", "none.jpg", "empty.jpg"] {
            assert!(recent(&path(bad)).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_swatch_is_the_right_way_up_and_opaque() {
        let bytes = [[1, 2, 3, 0], [4, 5, 6, 0], [7, 8, 9, 0], [10, 11, 12, 0]].concat();
        let image = swatch(&Texels::flat(2, 2, TexelFormat::Rgba8, bytes));
        assert_eq!(image.size, [2, 2]);
        assert_eq!(image.pixels[0].to_array(), [7, 8, 9, 255]);
        let wide = Texels::flat(300, 1, TexelFormat::R8, vec![9; 300]);
        assert_eq!(swatch(&wide).size, [75, 1]);
    }
}
