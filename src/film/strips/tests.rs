//! Tests that a picture in strips equals the picture in one piece.

use super::*;
use std::{fs, path::Path};

fn pixels(width: u32, height: u32) -> Pixels {
    let texels = (0..width * height).map(|n| [n as f32 / 500.0, 0.5, -(n as f32), 1.0]).collect();
    Pixels { width, height, texels }
}

/// Writes a picture in strips of this number of rows.
fn write(path: &Path, still: Still, texels: TexelFormat, picture: &Pixels, rows: usize) -> Result<(), FilmError> {
    let size = (picture.width, picture.height);
    let mut writer = StripWriter::start(still, texels, size, Output::File(path.into()), None)?;
    let strip = |texels: &[[f32; 4]]| {
        let height = texels.len() as u32 / picture.width;
        Pixels { width: picture.width, height, texels: texels.to_vec() }
    };
    let mut strips: Vec<Pixels> = picture.texels.chunks(rows * picture.width as usize).map(strip).collect();
    if still.is_top_first() {
        strips.reverse();
    }
    strips.into_iter().try_for_each(|strip| writer.push(strip))?;
    writer.finish()
}

#[test]
fn a_picture_in_strips_is_the_picture_in_one_piece() {
    let dir = tempfile::tempdir().unwrap();
    let picture = pixels(21, 37);
    for (still, texels) in [
        (Still::Npy, TexelFormat::Rgba32f),
        (Still::Exr, TexelFormat::Rgba32f),
        (Still::Exr, TexelFormat::Rg16f),
        (Still::Png { depth: 8 }, TexelFormat::Rgba32f),
        (Still::Png { depth: 16 }, TexelFormat::Rgba32f),
    ] {
        let mut whole = io::Cursor::new(Vec::new());
        still.write(&mut whole, &picture, texels).unwrap();
        for rows in [1, 5, 16, 40] {
            let path = dir.path().join("picture");
            write(&path, still, texels, &picture, rows).unwrap();
            let bytes = fs::read(&path).unwrap();
            if let Still::Png { .. } = still {
                let decode = |bytes: &[u8]| image::load_from_memory(bytes).unwrap();
                assert_eq!(decode(&bytes), decode(whole.get_ref()), "{still:?}, {rows} rows");
            } else {
                assert!(bytes == *whole.get_ref(), "{still:?}, {rows} rows");
            }
        }
    }
}

#[test]
fn an_abandoned_picture_leaves_no_file() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.png");
    let output = || Output::File(path.clone());
    let texels = TexelFormat::Rgba32f;
    let mut writer = StripWriter::start(Still::Png { depth: 8 }, texels, (4, 4), output(), None).unwrap();
    writer.push(pixels(4, 2)).unwrap();
    drop(writer);
    let mut writer = StripWriter::start(Still::Npy, texels, (4, 4), output(), None).unwrap();
    writer.push(pixels(4, 2)).unwrap();
    assert!(writer.finish().is_err(), "rows are missing");
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 0);
}
