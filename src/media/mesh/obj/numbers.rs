//! Parses the numbers of an OBJ file in the formats that exporters write.

use super::text::{Statement, quoted};
use crate::mesh::trouble::ModelError;

/// Parses the numbers of a statement after its keyword, as many as fit, and returns their count. A number that is not
/// finite is either written so in the file, or too large for a float.
pub(super) fn numbers(statement: Statement<'_>, into: &mut [f32]) -> Result<usize, ModelError> {
    let mut count = 0;
    for word in statement.words().skip(1) {
        if let Some(place) = into.get_mut(count) {
            *place = number(word).ok_or_else(|| not_a_number(statement, word))?;
        }
        count += 1;
    }
    Ok(count)
}

/// Parses an integer, saturating.
pub(super) fn whole(text: &[u8]) -> Option<i64> {
    let digits = text.strip_prefix(b"-").or(text.strip_prefix(b"+")).unwrap_or(text);
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let limit = if text.starts_with(b"-") { i64::MIN } else { i64::MAX };
    Some(str::from_utf8(text).ok()?.parse().unwrap_or(limit))
}

fn number(word: &[u8]) -> Option<f32> {
    let text = str::from_utf8(word).ok()?;
    text.parse().ok().or_else(|| no_value(text)).or_else(|| fortran(text))
}

/// Parses the texts that the C libraries of Microsoft and others print for values that are not a number: `-1.#IND`,
/// `1.#QNAN`, `-nan(ind)`.
fn no_value(text: &str) -> Option<f32> {
    let text = text.trim_start_matches(['+', '-']).to_ascii_lowercase();
    (text.starts_with("1.#") || text.starts_with("nan(")).then_some(f32::NAN)
}

/// Parses a number with a Fortran exponent: `1.5D-02`, `1.5-02`. Some programs put the sign before the letter.
fn fortran(text: &str) -> Option<f32> {
    let is_of_mantissa = |c: char| c.is_ascii_digit() || c == '.';
    let sign = usize::from(text.starts_with(['+', '-']));
    let end = sign + text[sign..].find(|c| !is_of_mantissa(c))?;
    let (mantissa, exponent) = text.split_at(end);
    let digits = exponent.trim_start_matches(['+', '-', 'e', 'E', 'd', 'D']);
    let mark = &exponent[..exponent.len() - digits.len()];
    let is_mark = matches!(mark.to_ascii_lowercase().as_str(), "d" | "d+" | "d-" | "+" | "-" | "+e" | "-e");
    let minus = if mark.contains('-') { "-" } else { "" };
    let is_whole = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    (is_mark && is_whole).then(|| format!("{mantissa}e{minus}{digits}").parse().ok())?
}

fn not_a_number(statement: Statement<'_>, word: &[u8]) -> ModelError {
    let shown = quoted(word);
    let reason = format!("{shown} is not a number");
    let commas = word.iter().filter(|b| **b == b',').count();
    let with_points: Vec<u8> = word.iter().map(|b| if *b == b',' { b'.' } else { *b }).collect();
    match commas {
        1 if number(&with_points).is_some() => {
            let hint = format!("write decimals with a point: {} for {shown}", quoted(&with_points));
            statement.error(word, format!("{reason}: it has a decimal comma"), hint)
        }
        0 => statement.error(word, reason, "write a number such as 0.25, or re-export the model"),
        _ => statement.error(word, reason, "separate the numbers by spaces, and write decimals with a point"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_in_every_form_that_exporters_write() {
        for (word, value) in [
            ("1", 1.0),
            ("+1.5", 1.5),
            (".5", 0.5),
            ("-5.", -5.0),
            ("1e-2", 0.01),
            (".8E+001", 8.0),
            ("-0", -0.0),
            ("1.5D-02", 0.015),
            ("2.5d1", 25.0),
            ("1.5+02", 150.0),
            ("-.5-1", -0.05),
            ("3.1+e2", 310.0),
        ] {
            assert_eq!(number(word.as_bytes()), Some(value), "{word}");
        }
        for word in
            ["nan", "-NaN", "inf", "-Infinity", "1.#IND", "-1.#QNAN", "1.#INF00", "-nan(ind)", "nan(0x7f)", "1e99"]
        {
            assert!(number(word.as_bytes()).is_some_and(|x| !x.is_finite()), "{word}");
        }
        for word in
            ["", "-", ".", "1,5", "zero", "1.2.3", "0x10", "1e", "1-", "5px", "--1", "1e+-2", "\u{2212}1", "\u{ff}"]
        {
            assert_eq!(number(word.as_bytes()), None, "{word}");
        }
    }
}
