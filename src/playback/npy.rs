//! Float texels as NumPy's `.npy`, version 1.0: float32, shape (height, width, 4), row 0 at the bottom.
//!
//! Format: <https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html>.

use eddy_engine::Pixels;
use eddy_media as media;
use std::io::{self, Write};

/// Writes the whole file.
pub fn write(out: &mut impl Write, pixels: &Pixels) -> io::Result<()> {
    write_header(out, (pixels.width, pixels.height))?;
    write_texels(out, &pixels.texels)
}

/// Writes the header for a picture of this width and height.
pub fn write_header(out: &mut impl Write, (width, height): (u32, u32)) -> io::Result<()> {
    out.write_all(&media::npy_header("<f4", &[height, width, 4]))
}

/// Appends texels.
pub fn write_texels(out: &mut impl Write, texels: &[[f32; 4]]) -> io::Result<()> {
    if cfg!(target_endian = "little") {
        out.write_all(bytemuck::cast_slice(texels))
    } else {
        texels.iter().flatten().try_for_each(|v| out.write_all(&v.to_le_bytes()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn header_and_bytes_follow_the_format() {
        let pixels = Pixels { width: 2, height: 1, texels: vec![[0.0, 1.0, -2.5, f32::NAN], [3.0; 4]] };
        let mut file = Vec::new();
        write(&mut file, &pixels).unwrap();
        assert_eq!(&file[..8], b"\x93NUMPY\x01\x00");
        let length = usize::from(u16::from_le_bytes([file[8], file[9]]));
        assert_eq!((10 + length) % 64, 0);
        let header = std::str::from_utf8(&file[10..10 + length]).unwrap();
        assert!(header.starts_with("{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 4), }"), "{header}");
        assert!(header.ends_with('\n'));
        let data = &file[10 + length..];
        assert_eq!(data.len(), 32);
        assert_eq!(&data[8..12], &(-2.5f32).to_le_bytes());
    }
}
