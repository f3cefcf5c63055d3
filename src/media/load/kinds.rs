//! Recognises picture formats that are not supported, so that an error can name them.

/// Returns the picture format of a file by its first bytes, if Eddy does not support it.
pub(super) fn unread(bytes: &[u8]) -> Option<&'static str> {
    const SIGNATURES: [(&[u8], &str); 15] = [
        (b"II*\0", "TIFF"),
        (b"MM\0*", "TIFF"),
        (b"II+\0", "TIFF"),
        (b"8BPS", "PSD"),
        (b"gimp xcf", "XCF"),
        (b"\xabKTX 11\xbb", "KTX"),
        (b"\0\0\x01\0", "ICO"),
        (b"qoif", "QOI"),
        (b"\xff\x0a", "JPEG XL"),
        (b"\0\0\0\x0cJXL ", "JPEG XL"),
        (b"\0\0\0\x0cjP  ", "JPEG 2000"),
        (b"\xff\x4f\xff\x51", "JPEG 2000"),
        (b"farbfeld", "farbfeld"),
        (b"%PDF-", "PDF"),
        (b"SIMPLE  =", "FITS"),
    ];
    let by_magic = SIGNATURES.iter().find(|(magic, _)| bytes.starts_with(magic)).map(|(_, kind)| *kind);
    by_magic.or_else(|| iso_media(bytes)).or_else(|| netpbm(bytes)).or_else(|| svg(bytes))
}

/// Returns the picture formats in boxes of ISO/IEC 14496-12, by brand.
fn iso_media(bytes: &[u8]) -> Option<&'static str> {
    let [_, _, _, _, b'f', b't', b'y', b'p', brand @ ..] = bytes else { return None };
    match brand.get(..4)? {
        b"avif" | b"avis" => Some("AVIF"),
        b"heic" | b"heix" | b"hevc" | b"heim" | b"heis" | b"mif1" | b"msf1" => Some("HEIF"),
        _ => None,
    }
}

fn netpbm(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [b'P', b'1'..=b'7', next, ..] if next.is_ascii_whitespace() || *next == b'#' => Some("Netpbm"),
        [b'P', b'F' | b'f', next, ..] if next.is_ascii_whitespace() => Some("PFM"),
        _ => None,
    }
}

/// Recognises a text whose first element is an `svg`.
fn svg(bytes: &[u8]) -> Option<&'static str> {
    const FAR: usize = 4096;
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(FAR)]);
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let is_markup = ["<?xml", "<!--", "<!DOCTYPE svg", "<svg"].iter().any(|start| text.starts_with(start));
    (is_markup && text.contains("<svg")).then_some("SVG")
}

#[cfg(test)]
mod tests {
    use super::unread;

    #[test]
    fn formats_are_recognised_by_their_first_bytes() {
        for (bytes, kind) in [
            (&b"MM\0*\0\0\0\x08"[..], Some("TIFF")),
            (b"8BPS\0\x01", Some("PSD")),
            (b"\0\0\0\x1cftypavif\0\0\0\0", Some("AVIF")),
            (b"\0\0\0\x18ftypheic\0\0\0\0", Some("HEIF")),
            (b"\0\0\0\x18ftypmp42\0\0\0\0", None),
            (b"P6\n2 2\n255\n", Some("Netpbm")),
            (b"PF\n2 2\n-1\n", Some("PFM")),
            (b"\xef\xbb\xbf<?xml version='1.0'?>\n<!-- a --> <svg/>", Some("SVG")),
            (b"<?xml version='1.0'?><html/>", None),
            (b"Pictures", None),
            (b"", None),
            (b"\x89PNG\r\n\x1a\n", None),
        ] {
            assert_eq!(unread(bytes), kind, "{bytes:?}");
        }
    }
}
