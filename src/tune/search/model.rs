//! Predicts the time and the error of a setting from those that were measured, perhaps of smaller pictures.
//!
//! Time is a product: loops nest, and a share of the time that a knob does not change is in its own curve. Error is a sum:
//! what two approximations change is mostly apart. Both are corrected by what nearby combinations were off (weights of a
//! Gaussian in octaves of each knob), so that a product that is a sum in truth is found out by one measurement.

use super::Point;

/// The width of the correction in octaves.
const REACH: f64 = 0.8;
/// The weight of the model itself against that of the measurements.
const TRUST: f64 = 0.15;
/// Errors below this are equal.
const LEAST_ERROR: f64 = 1e-6;

pub(super) struct Model<'p> {
    base: &'p Point,
    /// The model of smaller pictures, with the logarithm of the ratio of the errors to those there.
    smaller: Option<(Box<Model<'p>>, f64)>,
    /// For each knob the measured values, sorted, with the logarithm of the ratio of times and the increase of the error.
    curves: Vec<Vec<(f64, f64, f64)>>,
    /// The measured combinations in octaves, with the logarithms of measured over predicted.
    off: Vec<(Vec<f64>, f64, f64)>,
}

fn octaves(values: &[f64]) -> Vec<f64> {
    values.iter().map(|v| if *v > 0.0 { v.log2() } else { -20.0 }).collect()
}

impl<'p> Model<'p> {
    /// Returns `None` if the setting `base` was not measured. `smaller` are the points of smaller pictures, if any.
    pub(super) fn new(points: &'p [Point], smaller: &'p [Point], base: &[f64]) -> Option<Self> {
        let smaller = if smaller.is_empty() { None } else { Some(Box::new(Model::new(smaller, &[], base)?)) };
        let base = points.iter().find(|p| p.values == base)?;
        let mut curves = vec![Vec::new(); base.values.len()];
        for point in points {
            let mut apart = (0..base.values.len()).filter(|k| point.values[*k] != base.values[*k]);
            let (Some(knob), None) = (apart.next(), apart.next()) else { continue };
            let value = point.values[knob];
            curves[knob].push((value, (point.millis / base.millis).ln(), point.error - base.error));
        }
        for (knob, curve) in curves.iter_mut().enumerate() {
            curve.push((base.values[knob], 0.0, 0.0));
            curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let smaller = smaller.map(|smaller| {
            // Of settings that have an error at all.
            let ratios: Vec<f64> = points
                .iter()
                .map(|point| (point.error, smaller.predict(&point.values).1))
                .filter(|(error, predicted)| error.min(*predicted) > 1e-4)
                .map(|(error, predicted)| (error / predicted).ln())
                .collect();
            let ratio = ratios.iter().sum::<f64>() / (ratios.len() as f64 + 0.3);
            (smaller, ratio)
        });
        let mut model = Self { base, smaller, curves, off: Vec::new() };
        let off = |point: &Point| {
            let (millis, error) = model.plain(&point.values);
            let error = (point.error.max(LEAST_ERROR) / error.max(LEAST_ERROR)).ln();
            (octaves(&point.values), (point.millis / millis).ln(), error)
        };
        model.off = points.iter().map(off).collect();
        Some(model)
    }

    pub(super) fn base(&self) -> &[f64] {
        &self.base.values
    }

    pub(super) fn base_millis(&self) -> f64 {
        self.base.millis
    }

    /// Returns milliseconds and error without corrections.
    fn plain(&self, values: &[f64]) -> (f64, f64) {
        if let Some((smaller, errors)) = &self.smaller {
            let (millis, error) = smaller.predict(values);
            return (millis * self.base.millis / smaller.base.millis, error * errors.exp());
        }
        let (mut log, mut error) = (0.0, self.base.error);
        for (curve, value) in self.curves.iter().zip(values) {
            let (time, more) = interpolated(curve, *value);
            log += time;
            error += more;
        }
        (self.base.millis * log.exp(), error.max(0.0))
    }

    /// Returns milliseconds and error of a setting.
    pub(super) fn predict(&self, values: &[f64]) -> (f64, f64) {
        let (millis, error) = self.plain(values);
        let at = octaves(values);
        let (mut weights, mut time, mut more) = (TRUST, 0.0, 0.0);
        for (place, off_time, off_error) in &self.off {
            let square: f64 = place.iter().zip(&at).map(|(a, b)| (a - b).powi(2)).sum();
            let weight = (-square / (2.0 * REACH * REACH)).exp();
            weights += weight;
            time += weight * off_time;
            more += weight * off_error;
        }
        (millis * (time / weights).exp(), error.max(LEAST_ERROR) * (more / weights).exp())
    }
}

/// Returns time and error at a value: linear in its logarithm, and beyond the ends as between the last two.
fn interpolated(curve: &[(f64, f64, f64)], value: f64) -> (f64, f64) {
    let log = |v: f64| if v > 0.0 { v.log2() } else { -20.0 };
    if let [(_, time, error)] = curve {
        return (*time, *error);
    }
    let above = curve.partition_point(|(v, ..)| *v < value).clamp(1, curve.len() - 1);
    let ((v0, t0, e0), (v1, t1, e1)) = (curve[above - 1], curve[above]);
    let part = (log(value) - log(v0)) / (log(v1) - log(v0));
    let error = match e0 > 0.0 && e1 > 0.0 && (0.0..=1.0).contains(&part) {
        // Errors of methods are powers of their steps.
        true => (e0.ln() + (e1.ln() - e0.ln()) * part).exp(),
        false => e0 + (e1 - e0) * part,
    };
    (t0 + (t1 - t0) * part, error)
}
