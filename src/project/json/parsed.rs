//! Accepts what `JSON.parse` accepts and serde_json rejects: unpaired surrogates in escapes, and numbers too large for
//! a double. JavaScript produces both: its strings are UTF-16 and its large numbers are infinite.

use std::borrow::Cow;

/// Rewrites a JSON text, keeping its length, so that serde_json reads it as `JSON.parse` reads the original: an
/// unpaired surrogate becomes U+FFFD, as when JavaScript encodes it as UTF-8, and an infinite number `null`, as when
/// JavaScript serializes it as JSON.
pub(super) fn readable(text: &str) -> Cow<'_, str> {
    let bytes = text.as_bytes();
    let mut changes: Vec<(usize, usize, &'static str)> = Vec::new();
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'"' => at = string(bytes, at + 1, &mut changes),
            b'-' | b'0'..=b'9' => {
                let end = at
                    + bytes[at..]
                        .iter()
                        .position(|b| !matches!(b, b'0'..=b'9' | b'-' | b'+' | b'.' | b'e' | b'E'))
                        .unwrap_or(bytes.len() - at);
                // The smallest number that is too large is 2e308: five characters, or more than 300 digits.
                let may_be = end - at > 300 || bytes[at..end].iter().any(|b| matches!(b, b'e' | b'E'));
                if may_be && text[at..end].parse::<f64>().is_ok_and(f64::is_infinite) {
                    changes.push((at, end, "null"));
                }
                at = end;
            }
            _ => at += 1,
        }
    }
    if changes.is_empty() {
        return Cow::Borrowed(text);
    }
    let (mut out, mut done) = (String::with_capacity(text.len()), 0);
    for (start, end, word) in changes {
        out.push_str(&text[done..start]);
        out.push_str(word);
        out.extend(std::iter::repeat_n(' ', end - start - word.len()));
        done = end;
    }
    out.push_str(&text[done..]);
    Cow::Owned(out)
}

/// Records the unpaired surrogates in a string, whose first byte is at `at`. Returns the offset after its end.
fn string(bytes: &[u8], mut at: usize, changes: &mut Vec<(usize, usize, &'static str)>) -> usize {
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'"' => return at + 1,
            b'\\' => match escaped(bytes, at) {
                Some(0xd800..=0xdbff) if matches!(escaped(bytes, at + 6), Some(0xdc00..=0xdfff)) => at += 12,
                Some(0xd800..=0xdfff) => {
                    changes.push((at, at + 6, "\\ufffd"));
                    at += 6;
                }
                _ => at += 2,
            },
            _ => at += 1,
        }
    }
    at
}

/// Returns the UTF-16 code unit of a `\u` escape with four hexadecimal digits.
fn escaped(bytes: &[u8], at: usize) -> Option<u16> {
    let digits = bytes.get(at..at + 6)?.strip_prefix(b"\\u")?;
    let digits = std::str::from_utf8(digits).ok().filter(|d| d.bytes().all(|b| b.is_ascii_hexdigit()))?;
    u16::from_str_radix(digits, 16).ok()
}

/// Decodes the text of a UTF-16 file, as PowerShell writes downloads; `None` for any other. UTF-16 is detected by its
/// byte order mark, or by the zero byte in its first character, which is ASCII.
pub(crate) fn utf16(bytes: &[u8]) -> Option<String> {
    let (is_little, skipped) = match bytes {
        [0xff, 0xfe, ..] => (true, 2),
        [0xfe, 0xff, ..] => (false, 2),
        [first, 0, ..] if first.is_ascii() && *first != 0 => (true, 0),
        [0, second, ..] if second.is_ascii() && *second != 0 => (false, 0),
        _ => return None,
    };
    let units = bytes[skipped..].chunks(2).map(|pair| match (is_little, pair) {
        (true, [low, high]) => u16::from_le_bytes([*low, *high]),
        (false, [high, low]) => u16::from_be_bytes([*high, *low]),
        _ => 0xfffd,
    });
    Some(char::decode_utf16(units).map(|c| c.unwrap_or('\u{fffd}')).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn output_of_javascript_is_accepted() {
        for (text, readable_as) in [
            (r#""\ud83d""#, r#""\ufffd""#),
            (r#""\uDE00x""#, r#""\ufffdx""#),
            (r#""\ud83d\ud83d\ude00""#, r#""\ufffd\ud83d\ude00""#),
            (r#"[1e999,-2E400 , 1]"#, r#"[null ,null   , 1]"#),
        ] {
            assert_eq!(readable(text), readable_as);
            assert!(serde_json::from_str::<serde_json::Value>(&readable(text)).is_ok());
        }
        for same in [r#""\ud83d\ude00 \\ud83d \"\\""#, "[1e300, 1e-999, 12]", "\"1e999\"", r#""\ud8"#, "\"\\", "1e", ""]
        {
            assert!(matches!(readable(same), Cow::Borrowed(_)), "{same}");
        }
        let long = format!("[{}]", "9".repeat(400));
        assert!(readable(&long).starts_with("[null   "));
    }

    #[test]
    fn utf_16_is_detected_by_its_mark_or_its_first_character() {
        let bytes = |text: &str, big: bool| -> Vec<u8> {
            text.encode_utf16().flat_map(|u| if big { u.to_be_bytes() } else { u.to_le_bytes() }).collect()
        };
        for big in [false, true] {
            assert_eq!(utf16(&bytes("\u{feff}{\u{e9}😀}", big)).unwrap(), "{\u{e9}😀}");
            assert_eq!(utf16(&bytes("{\u{e9}}", big)).unwrap(), "{\u{e9}}");
        }
        assert_eq!(utf16(&[0xff, 0xfe, b'a', 0, 0x3d, 0xd8, b'b']).unwrap(), "a\u{fffd}\u{fffd}");
        for other in [&b"{}"[..], b"", b"{", "\u{feff}{}".as_bytes(), &[0, 0, 0, 0]] {
            assert_eq!(utf16(other), None);
        }
    }
}
