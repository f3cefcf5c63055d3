//! Logarithmic axes: which decades are shown, and what stands at their ticks.

/// Whole decades around positive values; `None` of none.
pub fn decades(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = values.fold((f64::MAX, 0.0f64), |(lo, hi), v| (lo.min(v), hi.max(v)));
    (high > 0.0).then(|| {
        let (a, b) = ((low * 0.9).log10().floor(), (high * 1.1).log10().ceil());
        (10f64.powf(a), 10f64.powf(b.max(a + 1.0)))
    })
}

/// A power of ten as people write it; empty for anything else.
pub fn tick(value: f64) -> String {
    let power = value.log10().round();
    if (value / 10f64.powf(power) - 1.0).abs() > 1e-6 {
        return String::new();
    }
    if (-3.0..=4.0).contains(&power) { format!("{}", 10f64.powf(power)) } else { format!("1e{power}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_whole_decades() {
        assert_eq!(decades([0.02, 0.5].into_iter()), Some((0.01, 1.0)));
        assert_eq!(decades([3.0].into_iter()), Some((1.0, 10.0)));
        assert_eq!(decades(std::iter::empty()), None);
        assert_eq!([1e-5, 0.01, 1.0, 100.0, 3.0].map(tick), ["1e-5", "0.01", "1", "100", ""]);
    }
}
