//! Single waves in a fluid at rest, whose development is known from linear theory: shear, sound, and the checkerboard
//! that a grid may not see.

use super::flow::{Flow, Solver, without_format};
use crate::{LabError, Rig, metrics::checkerboard, reference::linear::one_pass_growth};
use std::f64::consts::TAU;

/// Returns the amplitude of u = sin(k y), one wave in the box, after `time`, relative to its exact decay: 1 - 4 nu dt
/// sin^2(k / 2) per step of explicit viscosity, its limit for short steps if viscosity is exact on the grid, exp(-nu
/// k^2 t) for a lattice and for `fluid-accurate`.
pub fn shear_wave(rig: &Rig, name: &str, flow: Flow, time: f64) -> Result<f64, LabError> {
    let Flow { n, dt, viscosity } = flow;
    let k = TAU / f64::from(n);
    let solver = Solver::new(name, flow).start_from(|_, y| [(k * y).sin(), 0.0], |_, _| 0.0);
    let (frames, time) = solver.frames(time);
    let mut running = rig.open(&solver.setup)?;
    running.frames(frames)?;
    let velocity = solver.velocity(&mut running)?;
    let on_grid = 4.0 * viscosity * (k / 2.0).sin().powi(2);
    let exact = match without_format(name) {
        "maccormack-strang" | "reflection" | "covector" | "weno" | "apic" | "flip" => (-on_grid * time).exp(),
        name if name.starts_with("lattice") || name == "fluid-accurate" => (-viscosity * k * k * time).exp(),
        _ => (1.0 - on_grid * dt).powf(time / dt),
    };
    let shape = solver.sampled(|_, y| [(k * y).sin(), 0.0]);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    Ok(dot(&velocity, &shape) / dot(&shape, &shape) / exact)
}

/// Returns the remaining part of a checkerboard in the pressure or density after a number of steps. `None` for a method
/// that keeps neither.
pub fn checkerboard_left(rig: &Rig, name: &str, flow: Flow, steps: u32) -> Result<Option<f64>, LabError> {
    let (solver, n) = (Solver::new(name, flow), flow.n as usize);
    let sign = |x: f64, y: f64| if (x.floor() + y.floor()) % 2.0 == 0.0 { 0.01 } else { -0.01 };
    let solver = solver.start_with_pressure(sign);
    let mut running = rig.open(&solver.setup)?;
    let Some(before) = solver.pressure(&mut running)? else { return Ok(None) };
    running.frames(steps / solver.steps)?;
    let after = solver.pressure(&mut running)?.unwrap_or_default();
    if after.iter().any(|p| !p.is_finite()) {
        return Ok(Some(f64::INFINITY));
    }
    Ok(Some((checkerboard(&after, n) / checkerboard(&before, n)).abs()))
}

/// Returns the growth of sound of wave number pi / 2 along both axes in the one-pass fluid of a viscosity below K,
/// relative to linear theory. Logarithms of the factor per step, over a number of steps.
pub fn growth_of_sound(rig: &Rig, flow: Flow, stiffness: f64, steps: u32) -> Result<f64, LabError> {
    let quarter = TAU / 4.0;
    let wave = move |x: f64, y: f64| 1e-4 * (quarter * (x + y)).sin();
    let Flow { dt, viscosity, .. } = flow;
    let solver = Solver::new("guay", flow).stiffness(stiffness);
    let solver = solver.start_from(|x, y| [wave(x, y); 2], |_, _| 0.0);
    let mut running = rig.open(&solver.setup)?;
    // Weighted so that the energy of a wave without viscosity grows uniformly, although its phase rotates.
    let mut amplitude = |frames| {
        running.frames(frames)?;
        let square = |v: Vec<f64>, about: f64| v.iter().map(|x| (x - about).powi(2)).sum::<f64>();
        let field = running.read("field")?;
        let both = square(field.components(0, 1), 0.0) + stiffness / dt * square(field.component(2), 1.0);
        Ok::<f64, LabError>(both.sqrt())
    };
    let (before, after) = (amplitude(0)?, amplitude(steps)?);
    let measured = (after / before).ln() / f64::from(steps);
    Ok(measured / one_pass_growth(dt, viscosity, stiffness, quarter, quarter).ln())
}
