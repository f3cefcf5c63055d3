//! Times as text, and the length of the timeline.

/// Returns the number of seconds of a timeline that contains all of these: a round number, with room to continue.
pub(super) fn end(all: impl IntoIterator<Item = f64>) -> f64 {
    const ROUND: [f64; 9] = [10.0, 20.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0];
    let last = all.into_iter().filter(|secs| secs.is_finite()).fold(0.0, f64::max);
    let hours = || 3600.0 * (last / 3600.0).floor() + 3600.0;
    ROUND.into_iter().find(|round| last <= 0.95 * round).unwrap_or_else(hours)
}

/// Formats seconds, with minutes and hours if there are any: `9.25`, `1:02.50`, `1:00:00.00`.
pub(crate) fn written(secs: f64) -> String {
    let hundredths = (secs.max(0.0) * 100.0).round() as u64;
    let (whole, part) = (hundredths / 100, hundredths % 100);
    let (hours, minutes, seconds) = (whole / 3600, whole / 60 % 60, whole % 60);
    match (hours, minutes) {
        (0, 0) => format!("{seconds}.{part:02}"),
        (0, _) => format!("{minutes}:{seconds:02}.{part:02}"),
        _ => format!("{hours}:{minutes:02}:{seconds:02}.{part:02}"),
    }
}

/// Parses the output of [`written`], or seconds alone, as in `90` or `12.5 s`. Returns `None` if it is not a time.
pub(super) fn read(text: &str) -> Option<f64> {
    let text = text.trim().trim_end_matches('s').trim_end();
    let parts: Vec<&str> = text.split(':').collect();
    let (seconds, before) = parts.split_last()?;
    let is_plain = |text: &&str| !text.is_empty() && text.bytes().all(|c| c.is_ascii_digit());
    if before.len() > 2 || !before.iter().all(is_plain) {
        return None;
    }
    let seconds: f64 = seconds.trim().parse().ok().filter(|secs: &f64| secs.is_finite() && *secs >= 0.0)?;
    let larger = before.iter().try_fold(0.0, |sum, part| Some(60.0 * (sum + part.parse::<f64>().ok()?)))?;
    Some(larger + seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_round_trip() {
        for secs in [0.0, 9.25, 59.99, 60.0, 62.5, 3599.0, 3600.0, 86_399.01] {
            assert!((read(&written(secs)).unwrap() - secs).abs() < 1e-9, "{secs}: {}", written(secs));
        }
        assert_eq!([9.25, 62.5, 3600.0].map(written), ["9.25", "1:02.50", "1:00:00.00"]);
        assert_eq!([read("90"), read(" 12.5 s"), read("2:03"), read(".5")], [90.0, 12.5, 123.0, 0.5].map(Some));
        for bad in ["", "s", "-1", "1:", ":5", "1:2:3:4", "a:1", "nan", "inf", "1:-2", "1.5:2"] {
            assert_eq!(read(bad), None, "{bad}");
        }
    }

    #[test]
    fn timeline_length_is_round_with_room() {
        assert_eq!(end([0.0]), 10.0);
        assert_eq!(end([9.6, 3.0]), 20.0);
        assert_eq!(end([5.0, 100.0, f64::NAN]), 120.0);
        assert_eq!(end([3599.0]), 3600.0 * 1.0_f64.max(end([3599.0]) / 3600.0));
        assert_eq!(end([8000.0]), 10_800.0);
    }
}
