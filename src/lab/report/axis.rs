//! Logarithmic axes: the decades that are shown, and the labels of their ticks.

/// Returns whole decades around positive values; `None` if there are none.
pub fn decades(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = values.fold((f64::MAX, 0.0f64), |(lo, hi), v| (lo.min(v), hi.max(v)));
    (high > 0.0).then(|| {
        let (a, b) = ((low * 0.9).log10().floor(), (high * 1.1).log10().ceil());
        (10f64.powf(a), 10f64.powf(b.max(a + 1.0)))
    })
}

/// Formats a power of ten for display; empty for other numbers.
pub fn tick(value: f64) -> String {
    let power = value.log10().round();
    if (value / 10f64.powf(power) - 1.0).abs() > 1e-6 {
        return String::new();
    }
    if (-3.0..=4.0).contains(&power) { format!("{}", 10f64.powf(power)) } else { format!("1e{power}") }
}

/// Axes of fewer decades than `FEW` have labels between the powers of ten; those of more than `MANY` do not label
/// every power.
const FEW: usize = 3;
const MANY: usize = 10;

/// The lines of an axis.
pub(super) struct Marks {
    /// Lines with a label: powers of ten, on a short axis 2 and 5 times each too, on a very long one not every power.
    pub labelled: Vec<f64>,
    pub others: Vec<f64>,
}

/// Returns the marks of an axis of whole decades from `low` to `high`.
pub(super) fn marks((low, high): (f64, f64)) -> Marks {
    let [first, last] = [low, high].map(|v| v.log10().round() as i32);
    let count = usize::try_from(last - first).unwrap_or(0);
    let every = count.div_ceil(MANY).max(1);
    let mut marks = Marks { labelled: Vec::new(), others: Vec::new() };
    for (n, power) in (first..=last).enumerate() {
        let factors = if power < last { 1..=9 } else { 1..=1 };
        for factor in factors {
            let value = f64::from(factor) * 10f64.powi(power);
            let is_labelled = match factor {
                1 => n % every == 0,
                2 | 5 => count < FEW,
                _ => false,
            };
            let list = if is_labelled { &mut marks.labelled } else { &mut marks.others };
            list.push(value);
        }
    }
    marks
}

/// Returns the label of a line: 1 to 9 times a power of ten.
pub(super) fn label(value: f64) -> String {
    // Rounding must not turn a power into slightly less than that power.
    let power = (value.log10() + 1e-9).floor();
    let leading = (value / 10f64.powf(power)).round();
    if (-3.0..=4.0).contains(&power) {
        let digits = (-power).max(0.0) as usize;
        format!("{:.digits$}", leading * 10f64.powf(power))
    } else {
        format!("{leading}e{power}")
    }
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

    #[test]
    fn axes_of_any_length_have_enough_labels() {
        let labels = |ends| marks(ends).labelled.into_iter().map(label).collect::<Vec<_>>();
        assert_eq!(labels((0.01, 0.1)), ["0.01", "0.02", "0.05", "0.1"]);
        assert_eq!(labels((1.0, 100.0)), ["1", "2", "5", "10", "20", "50", "100"]);
        assert_eq!(labels((1e-5, 1e-4)), ["1e-5", "2e-5", "5e-5", "1e-4"]);
        assert_eq!(labels((1e3, 1e5)), ["1000", "2000", "5000", "10000", "20000", "50000", "1e5"]);
        assert_eq!(labels((1e-2, 10.0)), ["0.01", "0.1", "1", "10"]);
        assert_eq!(labels((1e-30, 1.0)).len(), 11);
        // All other lines are present exactly once.
        let Marks { labelled, others } = marks((0.01, 10.0));
        assert_eq!((labelled.len(), others.len()), (4, 3 * 8));
    }
}
