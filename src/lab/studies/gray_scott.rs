//! Gray-Scott's reaction and diffusion: stencils, steps, formats, Euler against Strang's splitting.

use crate::lab::{
    About, Extent, HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::{Norms, area_above, mean},
    reference::gray_scott::{five_point, growth, pattern, rest},
    setup::{Storage, frames_of},
};
use std::f64::consts::TAU;

pub struct GrayScott;

const EULER: &[f64] = &[0.25, 0.5, 1.0];

const METHODS: &[Method] = &[
    Method { name: "five-point", title: "5-point stencil, Euler", settings: EULER, usual: 1.0 },
    Method { name: "mehrstellen", title: "Mehrstellen 9-point stencil, Euler", settings: EULER, usual: 1.0 },
    Method { name: "five-point-rg16f", title: "5-point stencil, Euler, in rg16f", settings: EULER, usual: 1.0 },
    Method {
        name: "strang-blur",
        title: "blur and Strang's splitting",
        settings: &[0.5, 1.0, 2.0, 4.0, 8.0],
        usual: 2.0,
    },
];

/// Width of the strip on which growth is measured, and waves across it: q = .5236, close to what grows fastest.
const STRIP: u32 = 96;
const WAVES: f64 = 8.0;

fn time(extent_grid: u32) -> f64 {
    if extent_grid <= 64 { 200.0 } else { 400.0 }
}

/// A method's project at a step of `dt`, on any size.
fn method(name: &str, size: (u32, u32), dt: f64) -> Setup {
    let folder = if name == "strang-blur" { "gray_scott_blur" } else { "gray_scott_stencil" };
    let setup = Setup::new(folder, size).uniform("dt", dt);
    match name {
        "five-point" => setup.define("STENCIL", 5),
        "mehrstellen" => setup.define("STENCIL", 9),
        "five-point-rg16f" => setup.define("STENCIL", 5).storage(Storage::Half),
        _ => setup,
    }
}

/// Growth of the wave that grows almost fastest, for a unit of time: measured, of theory in steps of the method, and of
/// the continuum. Begins with 1e-4 of the growing direction about the state of rest.
pub fn grown(rig: &Rig, name: &str, dt: f64) -> Result<(f64, f64, f64), LabError> {
    let q = TAU * WAVES / f64::from(STRIP);
    let ([u, v], (continuum, [du, dv])) = (rest(), growth(q * q));
    let scale = 1e-4 / du.hypot(dv);
    let (seed_u, seed_v) = (scale * du, scale * dv);
    let texel = |i: u32| {
        let wave = (q * (f64::from(i % STRIP) + 0.5)).cos();
        [(u + seed_u * wave) as f32, (v + seed_v * wave) as f32, 0.0, 1.0]
    };
    let state: Vec<[f32; 4]> = (0..STRIP * 4).map(texel).collect();
    let total = (200.0 / dt) as u32;
    let (frames, steps) = frames_of(total, 20);
    let setup = method(name, (STRIP, 4), dt).state("field", &state).steps("solver", steps);
    let mut running = rig.open(&setup)?;
    let mut amplitude = |frames| {
        running.frames(frames)?;
        let field = running.read("field")?;
        let wave = |x: usize| (q * (x as f64 + 0.5)).cos();
        let along =
            |c: usize| field.component(c).iter().enumerate().map(|(i, w)| w * wave(i % STRIP as usize)).sum::<f64>();
        Ok::<f64, LabError>(along(0) * du + along(1) * dv)
    };
    // The other direction of the two dies out before.
    let (first, last) = (amplitude(frames / 2)?, amplitude(frames - frames / 2)?);
    let span = f64::from((frames - frames / 2) * steps) * dt;
    let theory = (1.0 + dt * growth(five_point(q)).0).ln() / dt;
    Ok(((last / first).ln() / span, theory, continuum))
}

/// Returns where u comes to rest in a sea without v: 1, unless a texel cannot hold what a step adds.
pub fn stalled(rig: &Rig, storage: Storage, feed: f64) -> Result<f64, LabError> {
    let setup = Setup::new("gray_scott_stencil", (8, 8)).define("STENCIL", 5).storage(storage).uniform("feed", feed);
    let setup = setup.initial("field", "vec4(0.9, 0.0, 0.0, 1.0)").steps("solver", 50);
    Ok(rig.after(&setup, 20, "field")?.component(0)[0])
}

impl Study for GrayScott {
    fn about(&self) -> About {
        About {
            name: "gray-scott",
            title: "Gray-Scott",
            text: "The coral pattern (F = .0545, k = .062, Du = .16, Dv = .08 texels² for a unit of time) from three \
                   smooth spots, against a spectral f64 solver with Strang's splitting. The table gives the growth of \
                   the wave of 12 texels over that of linear theory, .0100 in the continuum. The hard case is that u \
                   returns to 1 where there is no v, within .001.",
            parameter: "dt",
            unit: Unit::Scene,
            error: "of v",
        }
    }

    fn methods(&self) -> &'static [Method] {
        METHODS
    }

    fn grids(&self, extent: Extent) -> &'static [u32] {
        match extent {
            Extent::Quick => &[16, 32, 64],
            Extent::Full => &[32, 64, 128],
        }
    }

    /// A larger grid is a larger box.
    fn has_order(&self) -> bool {
        false
    }

    fn setup(&self, point: &Point) -> Setup {
        let total = (time(point.grid) / point.setting) as u32;
        method(&point.method, (point.grid, point.grid), point.setting).steps("solver", frames_of(total, 20).1)
    }

    fn measure(&self, rig: &Rig, point: &Point) -> Result<Measured, LabError> {
        let total = (time(point.grid) / point.setting) as u32;
        let (frames, _) = frames_of(total, 20);
        let v = rig.after(&self.setup(point), frames, "field")?.component(1);
        let [_, exact] = pattern(point.grid as usize, time(point.grid), time(point.grid) as u32);
        let (measured, _, continuum) = grown(rig, &point.method, point.setting)?;
        let storage = if point.method.ends_with("16f") { Storage::Half } else { Storage::AsWritten };
        let stall = stalled(rig, storage, 0.037)?;
        Ok(Measured { norms: Norms::of(&v, &exact), frames_per_unit: f64::from(frames), ..Measured::default() }
            .value("mean_v", mean(&v) / mean(&exact) - 1.0)
            .value("area", area_above(&v, 0.2) / area_above(&exact, 0.2) - 1.0)
            .value("growth", measured)
            .value("growth/theory", measured / continuum)
            .hard(HardCase::at_most("1 - u without v", 1.0 - stall, 0.001)))
    }
}
