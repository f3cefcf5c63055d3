//! Makes a program more exact until its picture stops changing.
//!
//! Each knob is made more exact alone, by factors of two in cost. The change of the picture from one value to the next
//! says whether it converges: a method of order p changes by 2^-p of the change before.

/// The behaviour of a knob when it was made more exact.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "lowercase", tag = "state")]
pub enum Convergence {
    /// The picture no longer changes from this value on.
    Reached { value: f64 },
    /// Each step changes the picture less; at this value the next would change it by about `rest`.
    Approaching { value: f64, rest: f64 },
    /// More exact values keep changing the picture by as much: they change its content. Errors are measured against the
    /// present value.
    Diverging { change: f64 },
    /// It was not made more exact: it is a setting of the project, or there was no time.
    Untried,
}

impl Convergence {
    /// Returns the value at which the program counts as converged; `None`: the present one.
    pub fn value(&self) -> Option<f64> {
        match self {
            Convergence::Reached { value } | Convergence::Approaching { value, .. } => Some(*value),
            Convergence::Diverging { .. } | Convergence::Untried => None,
        }
    }
}

/// A change must shrink by this factor from one step to the next.
const SHRINKS: f64 = 0.8;

/// Makes one knob more exact, from value to value of `finer`, which starts with the present one. `change` draws a value
/// and returns the difference from the one before; `None` if it cannot be drawn, or there is no time.
pub fn converge<E>(
    finer: &[f64],
    same: f64,
    mut change: impl FnMut(f64, f64) -> Result<Option<f64>, E>,
) -> Result<Convergence, E> {
    let mut last: Option<f64> = None;
    let Some(&present) = finer.first() else { return Ok(Convergence::Untried) };
    let mut at = present;
    for pair in finer.windows(2) {
        let Some(by) = change(pair[0], pair[1])? else { break };
        if by <= same {
            return Ok(Convergence::Reached { value: at });
        }
        if last.is_some_and(|last| by > last * SHRINKS) {
            // Once it has converged that far, a step that does not shrink is the noise of the method.
            return Ok(match at == finer[1] {
                true => Convergence::Diverging { change: by },
                false => Convergence::Approaching { value: at, rest: by },
            });
        }
        (at, last) = (pair[1], Some(by));
    }
    Ok(match last {
        // One step alone says nothing about the next.
        Some(by) if at == finer[1] => match finer.len() == 2 {
            true => Convergence::Approaching { value: at, rest: by },
            false => Convergence::Untried,
        },
        Some(by) => Convergence::Approaching { value: at, rest: by / 2.0 },
        None => Convergence::Untried,
    })
}

/// Returns the values of a knob from the present one to the most exact one, by factors of two; of few samples by one each.
pub fn finer(present: f64, finest: f64, is_integer: bool) -> Vec<f64> {
    let grows = finest > present;
    // Twice as many samples per side are four times as many.
    if is_integer && grows && (2.0..=4.0).contains(&present) {
        return [present, present + 1.0, present + 2.0].into_iter().filter(|v| *v <= finest).collect();
    }
    let mut values = vec![present];
    loop {
        let last = values[values.len() - 1];
        let next = if grows { last * 2.0 } else { last / 2.0 };
        let next = if is_integer { next.round() } else { next };
        if next <= 0.0 || next == last || (if grows { next > finest * 1.001 } else { next < finest * 0.999 }) {
            return values;
        }
        values.push(next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Converges a knob whose picture is one number.
    fn with(picture: impl Fn(f64) -> f64, finer: &[f64]) -> Convergence {
        let change = |a: f64, b: f64| Ok::<_, ()>(Some((picture(a) - picture(b)).abs()));
        converge(finer, 1e-3, change).unwrap()
    }

    #[test]
    fn methods_converge_and_content_does_not() {
        let values = finer(16.0, 128.0, true);
        assert_eq!(values, [16.0, 32.0, 64.0, 128.0]);
        assert_eq!(with(|v| (-v).exp(), &values), Convergence::Reached { value: 16.0 });
        assert_eq!(with(|v| if v < 20.0 { 0.1 } else { 0.0 }, &values), Convergence::Reached { value: 32.0 });
        assert!(matches!(with(|v| 1.0 / v, &values), Convergence::Approaching { value: 128.0, rest } if rest < 0.01));
        // As many spheres again: the picture is another one.
        assert!(matches!(with(|v| v, &values), Convergence::Diverging { .. }));
        assert_eq!(with(|v| v, &values[..1]), Convergence::Untried);
        assert_eq!(finer(0.01, 0.0025, false), [0.01, 0.005, 0.0025]);
        assert_eq!(finer(1.0, 4.0, true), [1.0, 2.0, 4.0]);
        assert_eq!(finer(3.0, 12.0, true), [3.0, 4.0, 5.0]);
    }

    #[test]
    fn without_time_nothing_is_claimed() {
        let none = |_: f64, _: f64| Ok::<_, ()>(None);
        assert_eq!(converge(&[1.0, 2.0, 4.0], 1e-3, none).unwrap(), Convergence::Untried);
    }
}
