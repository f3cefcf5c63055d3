//! Radiance pictures (`.hdr`), whose header the image crate reads in only one spelling.
//!
//! The format: <https://radsite.lbl.gov/radiance/refer/filefmts.pdf>, "Picture File Format". A picture's scanlines may
//! have any of eight orientations; EXPOSURE and similar fields describe how the values were processed and are ignored,
//! as elsewhere.

use image::metadata::Orientation;

/// The header of a Radiance picture.
#[derive(Debug, PartialEq)]
pub(super) struct Header {
    /// The number of its bytes, up to the first scanline.
    length: usize,
    scanlines: u32,
    /// The number of texels per scanline.
    texels: u32,
    /// The transform that makes the picture upright, for scanlines read from the left, the first at the top.
    pub orientation: Orientation,
}

/// Parses the header of a picture that starts with the signature. The error is a message.
pub(super) fn header(bytes: &[u8]) -> Option<Result<Header, String>> {
    bytes.starts_with(b"#?").then(|| read(bytes))
}

fn read(bytes: &[u8]) -> Result<Header, String> {
    let mut length = 0;
    let mut line = || {
        let end = memchr::memchr(b'\n', &bytes[length..])?;
        let text = String::from_utf8_lossy(&bytes[length..length + end]).trim().to_owned();
        length += end + 1;
        Some(text)
    };
    let cut = || "its header has no end".to_owned();
    loop {
        let said = line().ok_or_else(cut)?;
        let format = said.strip_prefix("FORMAT").and_then(|rest| rest.trim_start().strip_prefix('='));
        match format.map(str::trim) {
            None if said.is_empty() => break,
            None | Some("32-bit_rle_rgbe") => {}
            Some("32-bit_rle_xyze") => {
                return Err("its colours are CIE XYZ, and Eddy reads RGB: ra_xyze -r converts them".into());
            }
            Some(other) => return Err(format!("its colours are in the format {}", brief(other))),
        }
    }
    let resolution = line().ok_or_else(cut)?;
    let (scanlines, texels, orientation) = axes(&resolution)
        .ok_or_else(|| format!("its size is {:?}, but should look like \"-Y 480 +X 640\"", brief(&resolution)))?;
    Ok(Header { length, scanlines, texels, orientation })
}

/// Parses the number of scanlines, the number of texels per scanline, and their directions.
fn axes(resolution: &str) -> Option<(u32, u32, Orientation)> {
    let words: Vec<&str> = resolution.split_whitespace().collect();
    let [lines, scanlines, along, texels] = words[..] else { return None };
    // Y points upward and X to the right.
    let orientation = match (lines, along) {
        ("-Y", "+X") => Orientation::NoTransforms,
        ("-Y", "-X") => Orientation::FlipHorizontal,
        ("+Y", "-X") => Orientation::Rotate180,
        ("+Y", "+X") => Orientation::FlipVertical,
        ("+X", "-Y") => Orientation::Rotate90FlipH,
        ("-X", "-Y") => Orientation::Rotate90,
        ("-X", "+Y") => Orientation::Rotate270FlipH,
        ("+X", "+Y") => Orientation::Rotate270,
        _ => return None,
    };
    Some((scanlines.parse().ok()?, texels.parse().ok()?, orientation))
}

/// Returns the start of a text that may be long.
fn brief(text: &str) -> String {
    text.chars().take(40).collect()
}

impl Header {
    /// Returns the picture with the only header that the image crate reads, and its scanlines unchanged.
    pub(super) fn plain(&self, bytes: &[u8]) -> Vec<u8> {
        let head = format!("#?RADIANCE\n\n-Y {} +X {}\n", self.scanlines, self.texels);
        [head.as_bytes(), &bytes[self.length..]].concat()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_read_in_every_spelling() {
        let size = |text: &str| {
            let header = header(text.as_bytes()).expect("a signature").expect(text);
            assert_eq!(&text[header.length..], "texels", "{text}");
            (header.scanlines, header.texels, header.orientation)
        };
        for head in [
            "#?RADIANCE\n",
            "#?RGBE\n",
            "#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n",
            "#?AUTOPANO\n# a comment\nSOFTWARE=x\nEXPOSURE=nothing\nCOLORCORR= 1 2\nPRIMARIES=1 2 3\nview -vtv\nFORMAT = 32-bit_rle_rgbe\n",
        ] {
            let end = if head.contains('\r') { "\r\n" } else { "\n" };
            let text = format!("{head}{end}-Y 2  +X 03 {end}texels");
            assert_eq!(size(&text), (2, 3, Orientation::NoTransforms));
        }
        assert_eq!(size("#?RGBE\n\n+X 3 +Y 2\ntexels"), (3, 2, Orientation::Rotate270));
        assert_eq!(header(b"no signature"), None);
        for (text, says) in [
            ("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n", "CIE XYZ"),
            ("#?RADIANCE\nFORMAT=Radiance_spectra\n\n-Y 1 +X 1\n", "Radiance_spectra"),
            ("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "no end"),
            ("#?RADIANCE\n\n-Y 1 -Y 1\n", "-Y 480 +X 640"),
            ("#?RADIANCE\n\n-Y -1 +X 1\n", "-Y 480 +X 640"),
            ("#?RADIANCE\n\n-Y 99999999999 +X 1\n", "-Y 480 +X 640"),
        ] {
            let error = header(text.as_bytes()).expect("a signature").expect_err(text);
            assert!(error.contains(says), "{error}");
        }
    }
}
