//! `iDate` from a local date and time.

use jiff::civil::DateTime;

/// Returns year, month 0-11, day 1-31, and seconds since local midnight with milliseconds, as defined in section 4 of
/// `shadertoy.md`.
pub fn i_date(at: DateTime) -> [f32; 4] {
    let seconds = f64::from(i32::from(at.hour()) * 3600 + i32::from(at.minute()) * 60 + i32::from(at.second()));
    let millis = f64::from(at.millisecond()) / 1000.0;
    [f32::from(at.year()), f32::from(at.month() - 1), f32::from(at.day()), (seconds + millis) as f32]
}

/// The machine's current local time.
pub fn now() -> DateTime {
    jiff::Zoned::now().datetime()
}

/// Parses the value of `--date`: `2024-02-29`, `2024-02-29T13:45` or with seconds.
pub fn parse(text: &str) -> Result<DateTime, DateError> {
    text.trim().parse().map_err(|e: jiff::Error| DateError { text: text.into(), reason: e.to_string() })
}

/// The value of `--date` is invalid.
#[derive(Debug, thiserror::Error)]
#[error("{text:?} is not a date and time ({reason}); write it as 2024-02-29 or 2024-02-29T13:45:00")]
pub struct DateError {
    text: String,
    reason: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn months_count_from_zero_and_days_from_one() {
        assert_eq!(i_date(parse("2024-02-29T13:45:30.25").unwrap()), [2024.0, 1.0, 29.0, 49530.25]);
        assert_eq!(i_date(parse("2025-12-31").unwrap()), [2025.0, 11.0, 31.0, 0.0]);
    }

    #[test]
    fn invalid_dates_are_rejected_with_the_expected_form() {
        for bad in ["yesterday", "", "2024-13-01", "2024-02-30"] {
            let text = parse(bad).unwrap_err().to_string();
            assert!(text.contains("2024-02-29T13:45:00"), "{text}");
        }
    }
}
