//! Number literals (sections 4.1.3 and 4.1.4), and their possible errors.

use super::token::{Kind, is_name};

/// The reason that a number literal is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum BadNumber {
    /// Letters or a second point directly after it.
    Tail,
    /// `1f`.
    IntWithF,
    /// `08`.
    Octal,
    /// More than 32 bits.
    TooLarge,
    /// `0x`.
    NoHexDigits,
    /// `1e`.
    NoExponent,
}

const REASONS: [BadNumber; 6] = [
    BadNumber::Tail,
    BadNumber::IntWithF,
    BadNumber::Octal,
    BadNumber::TooLarge,
    BadNumber::NoHexDigits,
    BadNumber::NoExponent,
];

/// Returns the message and the hint for an invalid number.
pub(crate) fn bad_number(value: u32, text: &str) -> (String, Option<String>) {
    let digits: &str = &text[..text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len())];
    match REASONS[value as usize] {
        BadNumber::Tail => (format!("`{text}` is not a number"), tail_hint(text)),
        BadNumber::IntWithF => {
            (format!("`{text}`: an integer takes no `f`"), Some(format!("write `{digits}.0` or `{digits}.0f`")))
        }
        BadNumber::Octal => {
            let decimal = text.trim_start_matches('0');
            (
                format!("`{text}` is not an octal number: a leading 0 makes a number octal, with digits from 0 to 7"),
                Some(format!("write `{decimal}` for the decimal number")),
            )
        }
        BadNumber::TooLarge => (
            format!("`{text}` does not fit in 32 bits"),
            Some("the largest integer literal is 4294967295; for a float write a point, as in `1e10` or `1.0`".into()),
        ),
        BadNumber::NoHexDigits => (format!("`{text}` has no hexadecimal digits"), None),
        BadNumber::NoExponent => {
            (format!("`{text}` has no digits after its `e`"), Some(format!("write an exponent, as in `{digits}e3`")))
        }
    }
}

fn tail_hint(text: &str) -> Option<String> {
    let lower = text.to_ascii_lowercase();
    if let Some(number) = lower.strip_suffix("lf").or(lower.strip_suffix('h')).or(lower.strip_suffix('d')) {
        return number
            .bytes()
            .all(|b| b.is_ascii_digit() || b == b'.')
            .then(|| format!("GLSL ES has only 32-bit floats: write `{number}`"));
    }
    if let Some(number) = lower.strip_suffix("ul").or(lower.strip_suffix('l')) {
        return number
            .bytes()
            .all(|b| b.is_ascii_digit())
            .then(|| format!("GLSL ES has no suffix `l`: write `{number}`"));
    }
    if text.matches('.').count() > 1 {
        return Some("a number has only one decimal point".into());
    }
    None
}

/// Returns kind, value and length of the number at the start of `text`.
pub(super) fn scan(text: &str) -> (Kind, u32, usize) {
    let bytes = text.as_bytes();
    let digits = |mut at: usize, ok: fn(u8) -> bool| {
        while at < bytes.len() && ok(bytes[at]) {
            at += 1;
        }
        at
    };
    let byte = |at: usize| bytes.get(at).copied().unwrap_or(0);
    let decimal: fn(u8) -> bool = |b| b.is_ascii_digit();
    // Trailing letters and digits invalidate the whole number.
    let tail = |reason: BadNumber, from: usize| {
        let end = digits(from, |b| is_name(b) || b == b'.');
        (Kind::BadNumber, reason as u32, end)
    };
    let trailing = |at: usize| is_name(byte(at)) || byte(at) == b'.';

    if byte(0) == b'0' && matches!(byte(1), b'x' | b'X') {
        let end = digits(2, |b| b.is_ascii_hexdigit());
        if end == 2 {
            return tail(BadNumber::NoHexDigits, end);
        }
        return integer(&text[2..end], 16, byte(end), end, &tail, &trailing);
    }
    let mut end = digits(0, decimal);
    let whole = end;
    let mut float = false;
    if byte(end) == b'.' {
        float = true;
        end = digits(end + 1, decimal);
    }
    if matches!(byte(end), b'e' | b'E') {
        let sign = usize::from(matches!(byte(end + 1), b'+' | b'-'));
        let exponent = digits(end + 1 + sign, decimal);
        if exponent == end + 1 + sign {
            // `1.e` may be a mistyped swizzle: `1.expand`.
            let reason = if is_name(byte(exponent)) { BadNumber::Tail } else { BadNumber::NoExponent };
            return tail(reason, exponent);
        }
        float = true;
        end = exponent;
    }
    if float {
        // Rust parses all such texts as floats as well; a value that is too large is infinity, as in ANGLE.
        let value: f32 = text[..end].parse().unwrap_or(f32::INFINITY);
        let end = end + usize::from(matches!(byte(end), b'f' | b'F'));
        if trailing(end) {
            return tail(BadNumber::Tail, end);
        }
        return (Kind::Float, value.to_bits(), end);
    }
    if matches!(byte(end), b'f' | b'F') && !trailing(end + 1) {
        return (Kind::BadNumber, BadNumber::IntWithF as u32, end + 1);
    }
    if byte(0) == b'0' && whole > 1 {
        if text[..whole].bytes().any(|b| b > b'7') {
            return tail(BadNumber::Octal, whole);
        }
        return integer(&text[1..whole], 8, byte(end), end, &tail, &trailing);
    }
    integer(&text[..whole], 10, byte(end), end, &tail, &trailing)
}

fn integer(
    digits: &str,
    radix: u32,
    suffix: u8,
    mut end: usize,
    tail: &dyn Fn(BadNumber, usize) -> (Kind, u32, usize),
    trailing: &dyn Fn(usize) -> bool,
) -> (Kind, u32, usize) {
    let kind = if matches!(suffix, b'u' | b'U') { Kind::Uint } else { Kind::Int };
    if kind == Kind::Uint {
        end += 1;
    }
    if trailing(end) {
        return tail(BadNumber::Tail, end);
    }
    match u32::from_str_radix(digits, radix) {
        Ok(value) => (kind, value, end),
        Err(_) => (Kind::BadNumber, BadNumber::TooLarge as u32, end),
    }
}
