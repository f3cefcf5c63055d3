//! The difference between the two precisions.

use eddy_glsl::walk::Shadowed;

/// Returns the difference for one number; infinite if only one of the two is a number.
pub(super) fn difference(x: Shadowed) -> f64 {
    let single = f64::from(x.single);
    match (single.is_nan(), x.double.is_nan()) {
        (true, true) => 0.0,
        (false, false) if single == x.double => 0.0,
        // An infinity in single precision is a large number in double precision.
        (false, false) if (x.double as f32) == x.single => 0.0,
        (false, false) => (single - x.double).abs(),
        _ => f64::INFINITY,
    }
}

/// Returns the largest difference of a pixel's components.
pub(super) fn error_of(drawn: &[Shadowed; 4]) -> f64 {
    drawn.iter().map(|&x| difference(x)).fold(0.0, f64::max)
}
