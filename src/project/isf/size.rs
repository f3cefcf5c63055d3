//! Widths and heights of passes: expressions of `$WIDTH`, `$HEIGHT` and inputs.

use crate::{Expression, PassSize, Syntax};

/// Evaluates an expression of numbers and `$NAME`, which `value` looks up. Returns an error for invalid syntax.
pub(super) fn evaluate(text: &str, value: &dyn Fn(&str) -> Option<f64>) -> Result<f64, String> {
    // The sign distinguishes names from functions. Here the parenthesis after a function does.
    let expression = Expression::parse(&text.replace('$', " "), Syntax::Size).map_err(|error| error.to_string())?;
    match expression.names().iter().find(|(name, _)| value(name).is_none()) {
        Some((name, _)) => Err(format!("there is no number ${name}")),
        None => Ok(expression.value(&|name| value(name).unwrap_or(f64::NAN))),
    }
}

/// Returns the size of a pass from its expressions, where `None` is the size of the picture, and a warning if there is
/// one. Fails if the size depends on that of the picture in a way that Eddy does not support.
pub(super) fn size(
    (width, height): (Option<&str>, Option<&str>),
    input: &dyn Fn(&str) -> Option<f64>,
) -> Result<(PassSize, Option<String>), String> {
    let at = |canvas: (f64, f64)| -> Result<(f64, f64), String> {
        let value = |name: &str| match name {
            "WIDTH" => Some(canvas.0),
            "HEIGHT" => Some(canvas.1),
            name => input(name),
        };
        let side = |text: Option<&str>, own: f64| text.map_or(Ok(own), |text| evaluate(text, &value));
        let (w, h) = (side(width, canvas.0)?, side(height, canvas.1)?);
        let in_range = |side: f64| (0.0..1e9).contains(&side).then_some(side.max(1.0));
        let none = || format!("it is {w} by {h} for a picture of {} by {}", canvas.0, canvas.1);
        Ok((in_range(w).ok_or_else(none)?, in_range(h).ok_or_else(none)?))
    };
    const CANVASES: [(f64, f64); 4] = [(1920.0, 1080.0), (3000.0, 4000.0), (16384.0, 8192.0), (7777.0, 16384.0)];
    let sizes = CANVASES.iter().map(|canvas| at(*canvas)).collect::<Result<Vec<_>, _>>()?;
    let first = sizes[0];
    if sizes.iter().all(|size| *size == first) {
        return Ok((PassSize::Fixed(first.0 as u32, first.1 as u32), None));
    }
    let (x, y) = (sizes[2].0 / CANVASES[2].0, sizes[2].1 / CANVASES[2].1);
    let is_scaled = |(size, canvas): (&(f64, f64), &(f64, f64))| {
        (size.0 - canvas.0 * x).abs() <= 2.0 && (size.1 - canvas.1 * y).abs() <= 2.0
    };
    let is_row = sizes.iter().all(|size| size.0 == first.0) || sizes.iter().all(|size| size.1 == first.1);
    if is_row || !sizes.iter().zip(&CANVASES).all(is_scaled) {
        return Err("it is neither fixed nor a part of the resolution in both directions".to_owned());
    }
    // Rounding down makes the last digits inexact.
    let (x, y) = (tidy(x), tidy(y));
    let by = x.max(y);
    let said =
        (x != y).then(|| format!("Eddy scales both sides alike, by {by:.3}: the file asks for {x:.3} by {y:.3}"));
    Ok((if by == 1.0 { PassSize::Canvas } else { PassSize::Scale(by) }, said))
}

/// Returns the fraction of small integers that most likely equals a factor, else the factor.
fn tidy(factor: f64) -> f64 {
    let near = (1..=512).map(f64::from).map(|n| (factor * n).round() / n).find(|part| (part - factor).abs() < 1e-4);
    near.filter(|part| *part > 0.0).unwrap_or(factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<f64, String> {
        evaluate(text, &|name| match name {
            "WIDTH" => Some(640.0),
            "amount" => Some(0.5),
            _ => None,
        })
    }

    #[test]
    fn expressions_have_the_usual_precedence() {
        assert_eq!(value("floor($WIDTH / 3.0) + 2 * -1"), Ok(211.0));
        assert_eq!(value("max(8.0, floor($WIDTH*$amount))"), Ok(320.0));
        assert_eq!(value("2 * (3 - 1) % 3"), Ok(1.0));
        for wrong in ["", "1 +", "$height", "floor(1, 2)", "sin(1)", "(1", "1 2"] {
            assert!(value(wrong).is_err(), "{wrong}");
        }
        assert!(value(&"(".repeat(10_000)).is_err());
    }

    #[test]
    fn sizes_are_fixed_or_fractions_of_the_picture() {
        let of = |w, h| size((w, h), &|name| (name == "quality").then_some(0.25));
        assert_eq!(of(None, None), Ok((PassSize::Canvas, None)));
        assert_eq!(of(Some("floor($WIDTH/3.0)"), Some("floor($HEIGHT/3.0)")), Ok((PassSize::Scale(1.0 / 3.0), None)));
        assert_eq!(of(Some("max($WIDTH*$quality,1.0)"), Some("$HEIGHT*$quality")), Ok((PassSize::Scale(0.25), None)));
        assert_eq!(of(Some("2"), Some("1.0")), Ok((PassSize::Fixed(2, 1), None)));
        let (scaled, said) = of(Some("$WIDTH/4.0"), Some("$HEIGHT/2.0")).unwrap();
        assert!(scaled == PassSize::Scale(0.5) && said.is_some());
        assert!(of(Some("$WIDTH"), Some("1")).is_err());
        assert!(of(Some("0 - 5"), Some("1")).is_err());
    }
}
