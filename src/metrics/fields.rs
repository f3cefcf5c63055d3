//! Error measures of fields, all over f64 values.

use serde::{Deserialize, Serialize};

/// Norms of the difference from a reference, each relative to the same norm of the reference. Infinite if the field
/// contains a value that is not a number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Norms {
    #[serde(with = "as_number")]
    pub l1: f64,
    #[serde(with = "as_number")]
    pub l2: f64,
    #[serde(with = "as_number")]
    pub linf: f64,
}

mod as_number {
    use crate::Number;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(x: &f64, out: S) -> Result<S::Ok, S::Error> {
        Number(*x).serialize(out)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
        Ok(Number::deserialize(from)?.0)
    }
}

impl Norms {
    /// # Panics
    /// If the lengths differ.
    pub fn of(values: &[f64], reference: &[f64]) -> Norms {
        assert_eq!(values.len(), reference.len(), "a field and its reference have as many texels");
        if values.iter().any(|v| !v.is_finite()) {
            return Norms { l1: f64::INFINITY, l2: f64::INFINITY, linf: f64::INFINITY };
        }
        let (mut e1, mut e2, mut em, mut r1, mut r2, mut rm) = (0.0, 0.0, 0.0f64, 0.0, 0.0, 0.0f64);
        for (v, r) in values.iter().zip(reference) {
            let e = (v - r).abs();
            (e1, e2, em) = (e1 + e, e2 + e * e, em.max(e));
            (r1, r2, rm) = (r1 + r.abs(), r2 + r * r, rm.max(r.abs()));
        }
        Norms { l1: e1 / r1, l2: (e2 / r2).sqrt(), linf: em / rm }
    }
}

/// Returns the arithmetic mean; NaN of nothing.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Returns the peak signal-to-noise ratio in dB, for a peak of 1; infinite for equal fields.
pub fn psnr(values: &[f64], reference: &[f64]) -> f64 {
    let square: f64 = values.iter().zip(reference).map(|(v, r)| (v - r) * (v - r)).sum();
    -10.0 * (square / values.len() as f64).log10()
}

#[cfg(test)]
mod tests {
    use super::*;

    const REFERENCE: [f64; 4] = [1.0, 2.0, 3.0, 4.0];

    #[test]
    fn norms_of_bad_fields_are_large() {
        assert_eq!(Norms::of(&REFERENCE, &REFERENCE), Norms::default());
        let shifted = Norms::of(&[2.0, 3.0, 4.0, 5.0], &REFERENCE);
        assert!((shifted.l1 - 0.4).abs() < 1e-12 && (shifted.linf - 0.25).abs() < 1e-12);
        assert!((shifted.l2 - (4.0f64 / 30.0).sqrt()).abs() < 1e-12);
        // A single bad texel affects the maximum.
        let spike = Norms::of(&[1.0, 2.0, 3.0, 8.0], &REFERENCE);
        assert!(spike.linf == 1.0 && spike.linf > spike.l2 && spike.l2 > spike.l1);
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(Norms::of(&[1.0, bad, 3.0, 4.0], &REFERENCE).l2, f64::INFINITY);
        }
    }

    #[test]
    fn psnr_is_infinite_for_equal_fields_only() {
        assert_eq!(psnr(&REFERENCE, &REFERENCE), f64::INFINITY);
        assert!((psnr(&[0.1, 0.1], &[0.0, 0.0]) - 20.0).abs() < 1e-9);
    }
}
