//! Widths and heights of passes: expressions of `$WIDTH`, `$HEIGHT` and inputs.

use crate::{Expression, PassSize, Side, Syntax};

/// Evaluates an expression of numbers and `$NAME`, which `value` looks up. Returns an error for invalid syntax.
pub(super) fn evaluate(text: &str, value: &dyn Fn(&str) -> Option<f64>) -> Result<f64, String> {
    // The sign distinguishes names from functions. Here the parenthesis after a function does.
    let expression = Expression::parse(&text.replace('$', " "), Syntax::Size).map_err(|error| error.to_string())?;
    match expression.names().iter().find(|(name, _)| value(name).is_none()) {
        Some((name, _)) => Err(format!("there is no number ${name}")),
        None => Ok(expression.value(&|name| value(name).unwrap_or(f64::NAN))),
    }
}

/// Returns the size of a pass from its expressions, where `None` is the size of the picture. Fails if the size depends on
/// that of the picture in a way that Eddy does not support.
pub(super) fn size(
    (width, height): (Option<&str>, Option<&str>),
    input: &dyn Fn(&str) -> Option<f64>,
) -> Result<PassSize, String> {
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
        return Ok(PassSize::Fixed(first.0 as u32, first.1 as u32));
    }
    let widths: Vec<(f64, f64)> = sizes.iter().zip(&CANVASES).map(|(size, canvas)| (size.0, canvas.0)).collect();
    let heights: Vec<(f64, f64)> = sizes.iter().zip(&CANVASES).map(|(size, canvas)| (size.1, canvas.1)).collect();
    let why = || "it is neither fixed nor a part of the picture's width and height".to_owned();
    match (side(&widths).ok_or_else(why)?, side(&heights).ok_or_else(why)?) {
        (Side::Scale(1.0), Side::Scale(1.0)) => Ok(PassSize::Canvas),
        (Side::Scale(x), Side::Scale(y)) if x == y => Ok(PassSize::Scale(x)),
        (x, y) => Ok(PassSize::Sides(x, y)),
    }
}

/// Returns the rule by which a side follows from that of the picture, in pairs of both.
fn side(sides: &[(f64, f64)]) -> Option<Side> {
    let (first, _) = sides[0];
    if sides.iter().all(|(side, _)| *side == first) {
        return Some(Side::Fixed(first as u32));
    }
    let is_positive = |by: &f64| *by > 0.0;
    // An expression that does not round gives a number of texels that is rounded down (VVISF converts it to an integer).
    let exact = sides[2].0 / sides[2].1;
    let is_exact = sides.iter().all(|(side, canvas)| (side - canvas * exact).abs() < 1e-3);
    let is_whole = sides.iter().all(|(side, _)| side.fract() == 0.0);
    if is_exact && !is_whole {
        return Some(Side::Floor(simplest(exact - 1e-8, exact + 1e-8)));
    }
    // The factors that lead to all sides: canvas * by is from side + low to side + high.
    let factor = |low: f64, high: f64| {
        let least = sides.iter().map(|(side, canvas)| (side + low) / canvas).fold(0.0, f64::max);
        let most = sides.iter().map(|(side, canvas)| (side + high) / canvas).fold(f64::INFINITY, f64::min);
        (least < most).then(|| simplest(least, most)).filter(is_positive)
    };
    match factor(0.0, 1.0) {
        Some(1.0) => Some(Side::Scale(1.0)),
        Some(by) => Some(Side::Floor(by)),
        None => factor(-2.0, 2.0).map(Side::Scale),
    }
}

/// Returns the fraction of integers with the smallest denominator that is at least `least` and less than `most`, else
/// their mean.
fn simplest(least: f64, most: f64) -> f64 {
    // The bound of 1e-9 allows for the last bits of a quotient.
    let near = (1..=512).map(f64::from).map(|n| (least * n - 1e-9).ceil() / n).find(|part| *part < most);
    near.unwrap_or((least + most) / 2.0)
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
        let third = PassSize::Sides(Side::Floor(1.0 / 3.0), Side::Floor(1.0 / 3.0));
        assert_eq!(third.of((32, 3)), (10, 1));
        let [quarter, half] = [0.25, 0.5].map(Side::Floor);
        assert_eq!(of(None, None), Ok(PassSize::Canvas));
        assert_eq!(of(Some("floor($WIDTH/3.0)"), Some("floor($HEIGHT/3.0)")), Ok(third));
        assert_eq!(
            of(Some("max($WIDTH*$quality,1.0)"), Some("$HEIGHT*$quality")),
            Ok(PassSize::Sides(quarter, quarter))
        );
        assert_eq!(of(Some("2"), Some("1.0")), Ok(PassSize::Fixed(2, 1)));
        assert_eq!(of(Some("$WIDTH/4.0"), Some("$HEIGHT/2.0")), Ok(PassSize::Sides(quarter, half)));
        assert_eq!(of(Some("$WIDTH"), Some("1")), Ok(PassSize::Sides(Side::Scale(1.0), Side::Fixed(1))));
        assert_eq!(of(Some("16"), None), Ok(PassSize::Sides(Side::Fixed(16), Side::Scale(1.0))));
        // 8192 * 0.02 is 163.84: the quotient of whole sides is far from the factor.
        let fiftieth = Side::Floor(0.02);
        assert_eq!(
            of(Some("max(floor($WIDTH*0.02),1.0)"), Some("max(floor($HEIGHT*0.02),1.0)")),
            Ok(PassSize::Sides(fiftieth, fiftieth))
        );
        for size in 1..=400_u32 {
            assert_eq!(fiftieth.of(size), (f64::from(size) * 0.02).floor().max(1.0) as u32, "{size}");
        }
        assert_eq!(of(Some("floor($WIDTH*0.37)"), None), Ok(PassSize::Sides(Side::Floor(0.37), Side::Scale(1.0))));
        assert!(of(Some("$WIDTH*$HEIGHT"), Some("1")).is_err());
        assert!(of(Some("0 - 5"), Some("1")).is_err());
    }
}
