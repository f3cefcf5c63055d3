//! Formats numbers to fit a number of letters.

/// The names of a texel's components.
pub(super) const COMPONENTS: [&str; 4] = ["r", "g", "b", "a"];

/// Formats a number as exactly as this number of letters allows; non-finite values in words.
pub(super) fn fitted(x: f32, letters: usize) -> String {
    if x.is_nan() {
        return "NaN".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "+Inf" } else { "-Inf" }.into();
    }
    let whole = if x.fract() == 0.0 && x.abs() < 1e7 { format!("{x:.0}") } else { format!("{x}") };
    if whole.len() <= letters {
        return whole;
    }
    // Plain digits if they are more precise than scientific notation.
    let is_plain = x.abs() >= 1e-3 && x.abs() < 1e6;
    let plain = (1..8).rev().map(|digits| format!("{x:.digits$}")).find(|text| is_plain && text.len() <= letters);
    let power = || (0..7).rev().map(|digits| format!("{x:.digits$e}")).find(|text| text.len() <= letters);
    plain.or_else(power).unwrap_or_else(|| format!("{x:.0e}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_use_all_available_letters() {
        assert_eq!(
            ["0.5", "0.33333334", "0.3333"].map(str::to_owned),
            [(0.5, 9), (1.0 / 3.0, 10), (1.0 / 3.0, 6)].map(|(x, n)| fitted(x, n))
        );
        assert_eq!([fitted(-12.75, 5), fitted(-12.755, 6), fitted(4096.0, 4)], ["-12.8", "-12.76", "4096"]);
        assert_eq!([fitted(1.25e-7, 7), fitted(1.0e20, 5), fitted(-1.0e20, 6)], ["1.25e-7", "1e20", "-1e20"]);
        assert_eq!(
            [fitted(f32::NAN, 3), fitted(f32::INFINITY, 4), fitted(f32::NEG_INFINITY, 4)],
            ["NaN", "+Inf", "-Inf"]
        );
        assert_eq!([fitted(0.0, 3), fitted(-0.0, 3)], ["0", "-0"]);
        for x in [1234.5678, 0.000123456, 9.99999e8, -3.4e38, 1.0e-40] {
            assert!(fitted(x, 8).len() <= 8, "{}", fitted(x, 8));
            let back: f32 = fitted(x, 8).parse().unwrap();
            assert!((back - x).abs() <= x.abs() * 0.01, "{x} as {back}");
        }
    }
}
