//! Frames per second as a ratio of integers, which is how files store them.

/// The largest number of a ratio: APNG has 16 bits for each.
const MOST: u64 = 65_535;

/// `numerator / denominator` frames per second, in lowest terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rate {
    pub numerator: u32,
    pub denominator: u32,
}

impl Rate {
    /// Returns the simplest ratio within a billionth of a rate, or the nearest one with numbers up to 65,535 if there
    /// is none: the convergents of its continued fraction (Hardy and Wright, An Introduction to the Theory of Numbers,
    /// chapter X). `None` for rates that are not between 1/65,535 and 65,535.
    pub fn of(fps: f64) -> Option<Rate> {
        if !(1.0 / MOST as f64..=MOST as f64).contains(&fps) {
            return None;
        }
        let (mut before, mut last) = ((0u64, 1u64), (1u64, 0u64));
        let mut rest = fps;
        loop {
            let whole = rest.floor() as u64;
            let next = (whole.saturating_mul(last.0) + before.0, whole.saturating_mul(last.1) + before.1);
            if next.0 > MOST || next.1 > MOST {
                break;
            }
            (before, last) = (last, next);
            let ratio = last.0 as f64 / last.1 as f64;
            if last.0 > 0 && (ratio / fps - 1.0).abs() < 1e-9 {
                break;
            }
            rest = 1.0 / (rest - rest.floor());
            if !rest.is_finite() {
                break;
            }
        }
        (last.0 > 0 && last.1 > 0).then_some(Rate { numerator: last.0 as u32, denominator: last.1 as u32 })
    }

    /// Parses frames per second from a number or a ratio, as in `24000/1001`. The rounded numbers by which the rates of
    /// NTSC are known, such as 23.976 and 29.97, mean the exact rates.
    pub fn parse(text: &str) -> Option<f64> {
        let number = |text: &str| text.trim().parse::<f64>().ok();
        let fps = match text.split_once('/') {
            Some((numerator, denominator)) => number(numerator)? / number(denominator)?,
            None => number(text)?,
        };
        let fps = match text.trim() {
            "23.976" | "23.98" => 24_000.0 / 1001.0,
            "29.97" => 30_000.0 / 1001.0,
            "47.952" | "47.95" => 48_000.0 / 1001.0,
            "59.94" => 60_000.0 / 1001.0,
            "119.88" => 120_000.0 / 1001.0,
            _ => fps,
        };
        (fps.is_finite() && fps > 0.0).then_some(fps)
    }

    pub fn per_second(self) -> f64 {
        f64::from(self.numerator) / f64::from(self.denominator)
    }

    /// Formats the ratio for ffmpeg and Y4M, with `sign` between the numbers.
    pub(super) fn text(self, sign: char) -> String {
        format!("{}{sign}{}", self.numerator, self.denominator)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_read_as_numbers_and_as_ratios() {
        for (text, right) in [
            ("24000/1001", 24_000.0 / 1001.0),
            ("23.976", 24_000.0 / 1001.0),
            (" 29.97 ", 30_000.0 / 1001.0),
            ("60000 / 1001", 60_000.0 / 1001.0),
            ("12.5", 12.5),
            ("60", 60.0),
        ] {
            assert_eq!(Rate::parse(text), Some(right), "{text}");
        }
        for text in ["1/0", "0/1", "-1/2", "1/2/3", "a/b", "/", "", "nan", "inf", "0", "inf/inf"] {
            assert_eq!(Rate::parse(text), None, "{text}");
        }
    }

    #[test]
    fn rates_are_simple_ratios() {
        for (fps, numerator, denominator) in [
            (60.0, 60, 1),
            (29.97, 2997, 100),
            (23.976, 2997, 125),
            (30_000.0 / 1001.0, 30_000, 1001),
            (60_000.0 / 1001.0, 60_000, 1001),
            (12.5, 25, 2),
            (100.0 / 3.0, 100, 3),
            (0.1, 1, 10),
            (1.0 / 3600.0, 1, 3600),
            (65_535.0, 65_535, 1),
        ] {
            assert_eq!(Rate::of(fps), Some(Rate { numerator, denominator }), "{fps}");
        }
        for fps in [0.0, 1e-9, 1e9, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(Rate::of(fps), None, "{fps}");
        }
        for fps in [std::f64::consts::PI, std::f64::consts::E * 10.0, 59.123456] {
            let rate = Rate::of(fps).unwrap();
            assert!((rate.per_second() / fps - 1.0).abs() < 1e-6, "{fps}: {rate:?}");
        }
    }
}
