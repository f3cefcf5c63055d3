//! Colours as `#rrggbb`.

/// Formats a colour of numbers from 0 to 1.
pub(super) fn written(rgb: [f64; 3]) -> String {
    let [r, g, b] = rgb.map(|c| (c.clamp(0.0, 1.0) * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Parses `#rrggbb` or `#rgb`, with or without the `#`. The numbers are as short as eight bits allow, for the file in
/// which they are saved.
pub(super) fn read(text: &str) -> Option<[f64; 3]> {
    let text = text.trim();
    let digits = text.strip_prefix('#').unwrap_or(text);
    if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let value = |part: &str| u8::from_str_radix(part, 16).ok();
    let bytes = match digits.len() {
        6 => [value(&digits[..2])?, value(&digits[2..4])?, value(&digits[4..])?],
        3 => [value(&digits[..1])? * 17, value(&digits[1..2])? * 17, value(&digits[2..])? * 17],
        _ => return None,
    };
    Some(bytes.map(|b| short(f64::from(b) / 255.0)))
}

/// Rounds to the fewest decimals that distinguish eight-bit values.
pub(super) fn short(c: f64) -> f64 {
    (c * 1e4).round() / 1e4
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_round_trip() {
        for text in ["#000000", "#ff8001", "#7f7f7f", "#fffffe"] {
            assert_eq!(written(read(text).unwrap()), text);
        }
        assert_eq!(read("f80"), read("#FF8800"));
        assert_eq!(read(" #fff "), Some([1.0; 3]));
        for text in ["", "#", "#ff", "#ff88", "ff88001", "#gg0000", "#äöü", "+f0"] {
            assert_eq!(read(text), None, "{text}");
        }
        assert_eq!(written([2.0, -1.0, 0.5]), "#ff0080");
    }
}
