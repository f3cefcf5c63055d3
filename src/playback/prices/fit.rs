//! Least squares with terms that are not negative.

/// Returns the terms `x >= 0` that minimise the squared relative errors of `rows * x` against `measured`, and, with the
/// factor `trust`, their squared relative distance from `usual`: coordinate descent, one term after the other (V. Franc,
/// V. Hlaváč and M. Navara, "Sequential coordinate-wise algorithm for the non-negative least squares problem", CAIP 2005).
pub(super) fn fit(rows: &[Vec<f64>], measured: &[f64], usual: &[f64], trust: f64) -> Vec<f64> {
    let mut x = usual.to_vec();
    let scaled: Vec<Vec<f64>> =
        rows.iter().zip(measured).map(|(row, time)| row.iter().map(|part| part / time).collect()).collect();
    let mut left: Vec<f64> = scaled.iter().map(|row| 1.0 - dot(row, &x)).collect();
    for _ in 0..4000 {
        for term in 0..x.len() {
            let prior = trust / usual[term].powi(2);
            let squares: f64 = scaled.iter().map(|row| row[term] * row[term]).sum::<f64>() + prior;
            let gradient: f64 = scaled.iter().zip(&left).map(|(row, left)| row[term] * left).sum::<f64>()
                + prior * (usual[term] - x[term]);
            let new = (x[term] + gradient / squares).max(0.0);
            let step = new - x[term];
            if step != 0.0 {
                left.iter_mut().zip(&scaled).for_each(|(left, row)| *left -= step * row[term]);
                x[term] = new;
            }
        }
    }
    x
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::fit;

    #[test]
    fn times_are_taken_apart() {
        let rows = [vec![10.0, 0.0, 1.0], vec![10.0, 5.0, 1.0], vec![2.0, 9.0, 1.0], vec![0.0, 0.0, 1.0]];
        let times = rows.each_ref().map(|row| row[0] * 2.0 + row[1] * 7.0 + row[2] * 3.0);
        let found = fit(&rows, &times, &[1.0, 1.0, 1.0], 1e-9);
        assert!(found.iter().zip([2.0, 7.0, 3.0]).all(|(found, real)| (found - real).abs() < 1e-3), "{found:?}");
    }

    #[test]
    fn terms_are_not_negative_and_unmeasured_ones_stay() {
        let found = fit(&[vec![1.0, 1.0, 0.0], vec![1.0, 0.0, 0.0]], &[1.0, 2.0], &[1.0, 1.0, 4.0], 1e-6);
        assert!(found[1] >= 0.0 && found[1] < 1e-3 && (found[2] - 4.0).abs() < 1e-6, "{found:?}");
    }
}
