//! Parsers of option values.

use crate::{
    film::{Chroma, Codec, ColorRange, Format, Quality, Rate},
    playback::{capture, recording::Recording, shard::Shard},
    project::PassName,
    texture::Face,
    video::CameraSource,
};
use std::{
    env,
    fs::{self, File},
    io::{self, BufReader},
    net::SocketAddr,
    path::PathBuf,
    sync::Arc,
    time::Duration,
};

pub(super) const PROJECT: &str = "A PROJECT is a folder with eddy.toml, a folder with common.glsl, buffer_a.glsl … \
                           image.glsl, a .glsl file, the name of a preset (see `eddy list`) or a Shadertoy API \
                           .json file. If a project has the name of a command, write `eddy ./render`.";

/// Parses a pixel, as in 80,45.
pub(super) fn pixel(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once(',').and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)));
    parts.ok_or_else(|| format!("{text} is not a pixel: write column and row, as in 80,45"))
}

pub(super) fn format(text: &str) -> Result<Format, String> {
    let names = || Format::pictures_first().map(Format::name).join(", ");
    match text {
        "wav" | "flac" => Err("a sound's format is what --out ends in, as in --pass sound --out x.flac".into()),
        _ => Format::of_name(text).ok_or_else(|| format!("unknown format; use one of {}", names())),
    }
}

/// Parses the format of a picture that the other commands write.
pub(super) fn picture_format(text: &str) -> Result<capture::Format, String> {
    match text {
        "png" => Ok(capture::Format::Png),
        "npy" => Ok(capture::Format::Npy),
        _ => Err("use png or npy".into()),
    }
}

/// Parses the name of an existing folder.
pub(super) fn folder(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match fs::metadata(&path) {
        Ok(found) if found.is_dir() => Ok(path),
        Ok(_) => Err("this is a file; give the folder that it is in".into()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Err("there is no such folder".into()),
        Err(error) => Err(error.to_string()),
    }
}

/// Parses the name of a picture file to write.
pub(super) fn png_file(text: &str) -> Result<PathBuf, String> {
    named_file(text, &["png"])
}

/// Parses the name of a values file to write.
pub(super) fn values_file(text: &str) -> Result<PathBuf, String> {
    named_file(text, &["npy", "png"])
}

/// Rejects other extensions; a name without one is accepted.
fn named_file(text: &str, endings: &[&str]) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    match path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()) {
        Some(ending) if !endings.contains(&ending.as_str()) => {
            Err(format!(".{ending} is not a format that is written; use .{}", endings.join(" or .")))
        }
        _ => Ok(path),
    }
}

pub(super) fn codec(text: &str) -> Result<Codec, String> {
    Codec::of_name(text).ok_or_else(|| format!("unknown codec; use one of {}", Codec::ALL.map(Codec::name).join(", ")))
}

pub(super) fn quality(text: &str) -> Result<Quality, String> {
    Quality::parse(text).ok_or_else(|| "write low, medium, high, lossless or a number from 0 on".into())
}

pub(super) fn range(text: &str) -> Result<ColorRange, String> {
    ColorRange::parse(text).ok_or_else(|| "write limited or full".into())
}

pub(super) fn chroma(text: &str) -> Result<Chroma, String> {
    Chroma::parse(text).ok_or_else(|| "write 420, 422 or 444".into())
}

pub(super) fn fade(text: &str) -> Result<f64, String> {
    let secs = text.parse().ok().filter(|secs: &f64| secs.is_finite() && *secs >= 0.0 && *secs < 1e6);
    secs.ok_or_else(|| "write seconds from 0 on, as in 1.5".into())
}

pub(super) fn shutter(text: &str) -> Result<f64, String> {
    let part = text.parse().ok().filter(|part: &f64| *part > 0.0 && *part <= 1.0);
    part.ok_or_else(|| "a shutter is a number above 0 and at most 1, as in 0.5".into())
}

pub(super) fn tile(text: &str) -> Result<u32, String> {
    let side = text.parse().ok().filter(|side: &u32| *side > 0 && side.is_multiple_of(4));
    side.ok_or_else(|| "the side of a tile is a multiple of 4 pixels, as in 1024".into())
}

pub(super) fn shard(text: &str) -> Result<Shard, String> {
    Shard::parse(text, |name| env::var(name).ok()).map_err(|error| error.to_string())
}

/// A pass, and the index of one of its targets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Picture {
    pub pass: PassName,
    pub target: usize,
}

pub(super) fn picture(text: &str) -> Result<Picture, String> {
    let (name, target) = match text.rsplit_once(':') {
        Some((name, number)) => {
            (name, number.parse().map_err(|_| format!("a target is a number from 0 on, not \"{number}\""))?)
        }
        None => (text, 0),
    };
    Ok(Picture { pass: pass(name)?, target })
}

/// Returns the index of a cubemap's face, or an error if the pass has no faces.
pub(crate) fn face_of(pass: &PassName, face: Option<usize>) -> Result<usize, String> {
    match face {
        Some(_) if !pass.has_faces() => Err("--face: only a cubemap has faces; add --pass cube_a".into()),
        face => Ok(face.unwrap_or_default()),
    }
}

/// Parses a cubemap's face.
pub(super) fn face(text: &str) -> Result<usize, String> {
    let face = Face::ALL.iter().position(|face| face.name().eq_ignore_ascii_case(text));
    face.ok_or_else(|| format!("a face is one of {}", Face::ALL.map(Face::name).join(", ")))
}

pub(super) fn pass(text: &str) -> Result<PassName, String> {
    PassName::parse(text)
        .ok_or_else(|| "unknown pass; write image, buffer_a, buffer_b … or the name of another buffer".into())
}

pub(super) fn size(text: &str) -> Result<(u32, u32), String> {
    let shape = || "write a size as WxH, as in 640x360".to_owned();
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(shape)?;
    let number = |s: &str| s.parse::<u32>().map_err(|_| shape());
    match (number(width)?, number(height)?) {
        (0, _) | (_, 0) => Err("a size must be at least 1".into()),
        size => Ok(size),
    }
}

pub(super) fn recording(path: &str) -> Result<Arc<Recording>, String> {
    let file = File::open(path).map_err(|error| format!("cannot read {path}: {error}"))?;
    let recording =
        Recording::read(BufReader::new(file)).map_err(|error| format!("{path}: {error}; {}", error.remedy()))?;
    Ok(Arc::new(recording))
}

pub(super) fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|secs: &f64| *secs > 0.0);
    let duration = seconds.and_then(|secs| Duration::try_from_secs_f64(secs).ok());
    duration.ok_or_else(|| "seconds must be a number above 0, as in 2.5".into())
}

pub(super) fn webcam(text: &str) -> Result<CameraSource, String> {
    Ok(CameraSource::of_text(text))
}

/// Parses `9000`, `192.168.1.2:9000` or `[::1]:9000`.
pub(super) fn osc(text: &str) -> Result<SocketAddr, String> {
    let address = match text.parse() {
        Ok(port) => Ok(SocketAddr::from(([127, 0, 0, 1], port))),
        Err(_) => text.parse(),
    };
    let address = address.map_err(|_| "write a port from 1 to 65535, or ADDR:PORT as in 0.0.0.0:9000".to_owned())?;
    if address.port() == 0 { Err("the port must be from 1 to 65535".into()) } else { Ok(address) }
}

pub(super) fn fps(text: &str) -> Result<f64, String> {
    Rate::parse(text).ok_or_else(|| "frames per second must be a number above 0, or a ratio as in 24000/1001".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn osc_listens_on_the_loopback_address_by_default() {
        let read = |text: &str| osc(text).map(|address| address.to_string()).map_err(|_| ());
        assert_eq!(read("9000"), Ok("127.0.0.1:9000".into()));
        assert_eq!(read("0.0.0.0:8000"), Ok("0.0.0.0:8000".into()));
        assert_eq!(read("[::1]:8000"), Ok("[::1]:8000".into()));
        for wrong in ["", "0", "65536", "127.0.0.1", "localhost:9000", "0.0.0.0:0", "-1"] {
            assert_eq!(read(wrong), Err(()), "{wrong}");
        }
    }
    #[test]
    fn a_folder_to_read_must_exist() {
        let dir = tempfile::tempdir().unwrap();
        let read = |name: &str| folder(dir.path().join(name).to_str().unwrap()).map(drop);
        fs::write(dir.path().join("file"), "").unwrap();
        assert_eq!(read("."), Ok(()));
        assert_eq!(read("file"), Err("this is a file; give the folder that it is in".into()));
        assert_eq!(read("none"), Err("there is no such folder".into()));
    }

    #[test]
    fn an_extension_of_another_format_is_rejected() {
        let read = |name: &str| (png_file(name).is_ok(), values_file(name).is_ok());
        assert_eq!(read("a/x.png"), (true, true));
        assert_eq!(read("x.PNG"), (true, true));
        assert_eq!(read("x"), (true, true));
        assert_eq!(read("x.npy"), (false, true));
        assert_eq!(read("x.jpg"), (false, false));
        assert_eq!(values_file("x.Txt").unwrap_err(), ".txt is not a format that is written; use .npy or .png");
    }
}
