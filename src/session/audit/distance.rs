//! The distance of the two precisions from each other.

use eddy_glsl::walk::Shadowed;

/// Returns the distance of one number; infinite where one of the two alone is a number.
pub fn apart(x: Shadowed) -> f64 {
    let single = f64::from(x.single);
    match (single.is_nan(), x.double.is_nan()) {
        (true, true) => 0.0,
        (false, false) if single == x.double => 0.0,
        // An infinity of single precision is a large number of double precision.
        (false, false) if (x.double as f32) == x.single => 0.0,
        (false, false) => (single - x.double).abs(),
        _ => f64::INFINITY,
    }
}

/// The largest of a pixel's components.
pub fn error_of(drawn: &[Shadowed; 4]) -> f64 {
    drawn.iter().map(|&x| apart(x)).fold(0.0, f64::max)
}
