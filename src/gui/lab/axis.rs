//! Logarithmic axes for a plot that only supports linear ones: it gets log10 of each value, and these marks.

use crate::lab::report;
use egui_plot::{GridInput, GridMark};

/// The number of decades between two labels on a long axis, so that labels do not overlap.
const SPARSE: [(f64, i64); 2] = [(40.0, 10), (14.0, 2)];

/// Returns marks at the powers of ten, fainter ones at 2 to 9 times each, and finer ones within less than a decade.
pub(in crate::gui) fn marks(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let span = high - low;
    // Also rejects NaN bounds.
    if !(span > 0.0 && span < 1000.0) {
        return Vec::new();
    }
    let every = SPARSE.iter().find(|(most, _)| span > *most).map_or(1, |(_, every)| *every);
    let (first, last) = (low.floor() as i64, high.ceil() as i64);
    let mut marks = Vec::new();
    for power in first..=last {
        if power.rem_euclid(every) == 0 {
            marks.push(GridMark { value: power as f64, step_size: every as f64 });
        }
        if every == 1 {
            within(power as f64, span, &mut marks);
        }
    }
    marks.retain(|m| (low..=high).contains(&m.value));
    marks
}

/// Adds marks between 10^power and the next power. A mark's step is about its distance to the next one.
fn within(power: f64, span: f64, marks: &mut Vec<GridMark>) {
    let parts = match span {
        s if s > 0.7 => 1,
        s if s > 0.07 => 10,
        _ => 100,
    };
    for n in parts + 1..10 * parts {
        let factor = f64::from(n) / f64::from(parts);
        let step_size = if n % parts == 0 { 0.1 } else { 0.1 / f64::from(parts) };
        marks.push(GridMark { value: power + factor.log10(), step_size });
    }
}

/// Returns the label of a mark: powers of ten, and if the axis shows few of them other values too.
pub(in crate::gui) fn label(mark: GridMark, span: f64) -> String {
    let value = 10f64.powf(mark.value);
    let whole = report::tick(value);
    let leading = value / 10f64.powf(mark.value.floor());
    let is_round = [2.0, 5.0].iter().any(|round| (leading / round - 1.0).abs() < 1e-6);
    if !whole.is_empty() || span > 2.5 || (span > 0.7 && !is_round) { whole } else { short(value) }
}

/// Formats a number with three significant digits.
pub(in crate::gui) fn short(x: f64) -> String {
    let size = x.abs();
    match size {
        _ if !x.is_finite() => "diverged".into(),
        _ if size == 0.0 => "0".into(),
        s if !(1e-3..1e5).contains(&s) => format!("{x:.2e}"),
        s if s >= 100.0 => format!("{x:.0}"),
        s => {
            let digits = (2.0 - s.log10().floor()) as usize;
            let text = format!("{x:.digits$}");
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(low: f64, high: f64) -> Vec<f64> {
        marks(GridInput { bounds: (low, high), base_step_size: 0.01 }).iter().map(|m| m.value).collect()
    }

    fn labels(low: f64, high: f64) -> Vec<String> {
        let marks = marks(GridInput { bounds: (low, high), base_step_size: 0.01 });
        marks.into_iter().map(|m| label(m, high - low)).filter(|l| !l.is_empty()).collect()
    }

    #[test]
    fn decades_have_readable_labels() {
        assert_eq!(labels(-5.0, 1.0), ["1e-5", "1e-4", "0.001", "0.01", "0.1", "1", "10"]);
        assert_eq!(labels(-2.0, 0.0), ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"]);
        // Between the labels 2 to 9 are lines, evenly spaced in the value and not on the axis.
        let all = values(0.0, 3.0);
        assert_eq!(all.len(), 3 * 9 + 1);
        assert!(all.iter().any(|v| (v - 2f64.log10()).abs() < 1e-12));
    }

    #[test]
    fn axes_have_a_readable_number_of_labels() {
        for (low, high) in [(-0.3, 0.3), (0.31, 0.42), (-3.0, 9.0), (-30.0, 25.0), (1.0, 1.05), (-300.0, 300.0)] {
            let count = labels(low, high).len();
            assert!((2..=100).contains(&count), "{low} to {high}: {:?}", labels(low, high));
        }
        assert!(values(f64::NAN, 1.0).is_empty() && values(2.0, 1.0).is_empty());
        assert!(values(0.0, f64::INFINITY).is_empty());
    }

    #[test]
    fn numbers_have_three_significant_digits() {
        let formatted = [0.0, 1.0, 0.0123456, 4e-5, 12.345, 123.9, 0.5, f64::INFINITY].map(short);
        assert_eq!(formatted, ["0", "1", "0.0123", "4.00e-5", "12.3", "124", "0.5", "diverged"]);
    }
}
