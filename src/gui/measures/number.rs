//! Formats numbers for reading.

/// Formats a number with the digits of single precision; non-finite values in words.
pub(super) fn words(x: f64) -> String {
    if x.is_nan() {
        return "NaN".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "+Inf" } else { "-Inf" }.into();
    }
    let size = x.abs();
    if x == 0.0 || (x.fract() == 0.0 && size < 1e9) {
        return format!("{x:.0}");
    }
    if !(1e-4..1e7).contains(&size) {
        return format!("{x:.5e}");
    }
    let digits = (6.0 - size.log10().floor()).clamp(0.0, 10.0) as usize;
    let text = format!("{x:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// Returns the label of a mark on an axis with this step.
pub(super) fn tick(x: f64, step: f64) -> String {
    if x.abs() < step * 1e-3 {
        return "0".into();
    }
    if !(1e-4..1e6).contains(&x.abs().max(step)) {
        return format!("{x:.1e}");
    }
    let digits = (-step.log10()).ceil().clamp(0.0, 6.0) as usize;
    format!("{x:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_as_many_digits_as_needed() {
        let formatted = [0.0, -0.0, 3.0, 16777225.0, 0.1, -1234.5678, 2e-7, 1.5e12, 123456.75].map(words);
        assert_eq!(formatted, ["0", "-0", "3", "16777225", "0.1", "-1234.568", "2.00000e-7", "1.50000e12", "123456.8"]);
        assert_eq!([f64::NAN, f64::INFINITY, f64::NEG_INFINITY].map(words), ["NaN", "+Inf", "-Inf"]);
        assert_eq!([tick(0.5, 0.1), tick(20.0, 10.0), tick(2e8, 1e8), tick(1e-17, 0.1)], ["0.5", "20", "2.0e8", "0"]);
    }
}
