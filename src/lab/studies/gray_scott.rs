//! Gray-Scott's reaction and diffusion: stencils, steps, formats, Euler compared with Strang splitting and exponential
//! time differencing, and the preset.

use super::{
    cycle,
    fft::{self, Direction},
};
use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Running, Setup, Study, Unit,
    metrics::{Norms, area_above, mean},
    reference::gray_scott::{DIFFUSION, FEED, KILL, Statistics, five_point, growth, known, rest, seeded},
    setup::{Storage, frames_of, pass},
    three_of,
};
use eddy_project::{PassName, Project, TexelFormat};
use std::{f64::consts::TAU, sync::LazyLock};

const EULER: &[f64] = &[0.25, 0.5, 1.0];

const METHODS: &[Method] = &[
    Method { name: "five-point", title: "5-point stencil, Euler", settings: EULER, usual: 1.0 },
    Method { name: "mehrstellen", title: "Mehrstellen 9-point stencil, Euler", settings: EULER, usual: 1.0 },
    Method { name: "strang-mehrstellen", title: "9-point stencil, Strang's splitting", settings: EULER, usual: 1.0 },
    Method { name: "five-point-rgba32f", title: "5-point stencil, Euler, in rgba32f", settings: &[1.0], usual: 1.0 },
    Method { name: "five-point-rg16f", title: "5-point stencil, Euler, in rg16f", settings: EULER, usual: 1.0 },
    Method { name: "five-point-rgba16f", title: "5-point stencil, Euler, in rgba16f", settings: &[1.0], usual: 1.0 },
    Method {
        name: "strang-blur",
        title: "blur and Strang's splitting",
        settings: &[0.5, 1.0, 2.0, 4.0, 8.0],
        usual: 2.0,
    },
    Method {
        name: "etd",
        title: "exponential time differencing (ETD2) by a Fourier transform",
        settings: &[0.5, 1.0, 2.0, 4.0, 8.0],
        usual: 2.0,
    },
    Method { name: "reaction-diffusion", title: "the preset reaction-diffusion", settings: EULER, usual: 1.0 },
    Method { name: "reaction-diffusion-rg16f", title: "the preset, in rg16f", settings: &[1.0], usual: 1.0 },
    Method {
        name: "reaction-diffusion-blur",
        title: "the preset, diffusion 3",
        settings: &[1.0, 2.0, 4.0],
        usual: 2.0,
    },
];

/// The preset's rates of diffusion are Pearson's: this multiple of those of the other methods.
const FASTER: f64 = 0.209_715_2 / DIFFUSION[0];

/// Returns the width of the strip on which growth is measured, and the waves across it: .52 and .54 radians per texel
/// are close to the fastest growth. The sides of a transform are powers of two.
fn strip(name: &str) -> (u32, f64) {
    if name == "etd" { (128, 11.0) } else { (96, 8.0) }
}

const STAGE: &str = include_str!("../../../assets/lab/gray_scott_etd/stage.glsl");

/// Adds the passes of the transform of a step's terms, and of the inverse transform of its end, to `gray_scott_etd`.
fn transformed(project: &mut Project, size: (u32, u32)) {
    let texts =
        |direction| -> Vec<String> { fft::stages(size, direction).into_iter().map(|stage| stage + STAGE).collect() };
    let mut back = texts(Direction::Back);
    let end = back.pop().unwrap_or_default();
    let (passes, last) = fft::chain("back", &back, "step", TexelFormat::Rg32f);
    let field = cycle::insert(project, passes, "field");
    (field.source.text, field.bindings) = (end.into(), cycle::channels(&[&last]));
    // The waves of the terms are drawn before both passes that read them.
    let (passes, waves) = fft::chain("there", &texts(Direction::There), "terms", TexelFormat::Rgba32f);
    let step = cycle::insert(project, passes, "step");
    step.bindings = cycle::channels(&[&waves, "history"]);
    if let Some(history) = project.pass_mut(&pass("history")) {
        history.bindings = cycle::channels(&[&waves]);
    }
    let buffers: Vec<PassName> = project.passes.iter().map(|p| p.id.clone()).filter(|id| !id.is_image()).collect();
    project.groups.iter_mut().for_each(|group| group.passes.clone_from(&buffers));
}

/// The box and the time of a developed pattern, whose stripes fill it.
const LATE_GRID: u32 = 64;
const LATE: f64 = 3000.0;

/// Statistics of the reference at that time: on a torus, and within walls at the preset's rates.
static LATE_TORUS: LazyLock<Statistics> = LazyLock::new(|| late_reference(None));
static LATE_WALLS: LazyLock<Statistics> = LazyLock::new(|| late_reference(Some(DIFFUSION.map(|d| FASTER * d))));

fn late_reference(walls: Option<[f64; 2]>) -> Statistics {
    Statistics::of(&known(LATE_GRID as usize, walls, LATE), LATE_GRID as usize)
}

/// Returns the statistics of a method's developed pattern at a step of `dt`, and those of the reference.
pub fn late(rig: &Rig, name: &str, dt: f64) -> Result<[Statistics; 2], LabError> {
    let (field, group) = parts(name);
    let (frames, steps) = frames_of((LATE / dt) as u32, 20);
    let [u, v] = seeded(LATE_GRID as usize);
    let seeds: Vec<[f32; 4]> = u.iter().zip(&v).map(|(u, v)| texel(name, *u, *v)).collect();
    let setup = method(name, (LATE_GRID, LATE_GRID), dt).state(field, &seeds).steps(group, steps);
    let mut running = rig.open(&setup)?;
    running.frames(frames)?;
    let [_, v] = state(&mut running, name)?;
    let reference = if is_preset(name) { &LATE_WALLS } else { &LATE_TORUS };
    Ok([Statistics::of(&v, LATE_GRID as usize), **reference])
}

fn time(grid: u32) -> f64 {
    if grid <= 64 { 200.0 } else { 400.0 }
}

fn is_preset(name: &str) -> bool {
    name.starts_with("reaction-diffusion")
}

/// Returns the pass with the state, and the group of passes that form a step.
fn parts(name: &str) -> (&'static str, &'static str) {
    if is_preset(name) { ("a", "reaction") } else { ("field", "solver") }
}

/// Returns a texel of the state: the preset stores 1 - u.
fn texel(name: &str, u: f64, v: f64) -> [f32; 4] {
    if is_preset(name) { [(1.0 - u) as f32, v as f32, 0.0, 0.0] } else { [u as f32, v as f32, 0.0, 1.0] }
}

/// Returns u and v of every texel.
fn state(running: &mut Running, name: &str) -> Result<[Vec<f64>; 2], LabError> {
    let field = running.read(parts(name).0)?;
    let first = field.component(0);
    let u = if is_preset(name) { first.into_iter().map(|x| 1.0 - x).collect() } else { first };
    Ok([u, field.component(1)])
}

/// Returns a method's project at a step of `dt`, for any size.
fn method(name: &str, size: (u32, u32), dt: f64) -> Setup {
    let storage = if name.ends_with("16f") { Storage::Half } else { Storage::AsWritten };
    let stencil = |points: u32| Setup::new("gray_scott_stencil", size).define("STENCIL", points);
    let setup = match name {
        "strang-blur" => Setup::new("gray_scott_blur", size),
        "etd" => Setup::new("gray_scott_etd", size).built(move |project| transformed(project, size)),
        "mehrstellen" => stencil(9),
        "strang-mehrstellen" => stencil(9).define("SPLIT", 1),
        "five-point-rgba32f" | "five-point-rgba16f" => stencil(5).built(|project| {
            if let Some(field) = project.pass_mut(&pass("field")) {
                field.settings.format = TexelFormat::Rgba32f;
            }
        }),
        // With a single recipe, and without seeding.
        name if is_preset(name) => Setup::new("reaction-diffusion", size)
            .wants(&["a"])
            .uniform("sway", 0.0)
            .uniform("sower", 0.0)
            .uniform("feed", FEED)
            .uniform("kill", KILL)
            .uniform("diffusion", if name.ends_with("blur") { 3.0 } else { 1.0 }),
        _ => stencil(5),
    };
    setup.storage(storage).uniform("dt", dt)
}

/// Returns the growth of the wave that grows almost fastest, per unit of time: measured, of theory in steps of the
/// method, and of the continuum. Starts with 1e-4 of the growing direction around the steady state.
pub fn grown(rig: &Rig, name: &str, dt: f64) -> Result<(f64, f64, f64), LabError> {
    let (strip, waves) = strip(name);
    let q = TAU * waves / f64::from(strip);
    // With faster diffusion a wave behaves like a correspondingly shorter one.
    let faster = if is_preset(name) { FASTER } else { 1.0 };
    let ([u, v], (continuum, [du, dv])) = (rest(), growth(faster * q * q));
    let scale = 1e-4 / du.hypot(dv);
    let (seed_u, seed_v) = (scale * du, scale * dv);
    let seed = |i: u32| {
        let wave = (q * (f64::from(i % strip) + 0.5)).cos();
        texel(name, u + seed_u * wave, v + seed_v * wave)
    };
    let seeds: Vec<[f32; 4]> = (0..strip * 4).map(seed).collect();
    let total = (200.0 / dt) as u32;
    let (frames, steps) = frames_of(total, 20);
    let (field, group) = parts(name);
    let setup = method(name, (strip, 4), dt).state(field, &seeds).steps(group, steps);
    let mut running = rig.open(&setup)?;
    let mut amplitude = |frames| {
        running.frames(frames)?;
        let [u, v] = state(&mut running, name)?;
        let wave = |x: usize| (q * (x as f64 + 0.5)).cos();
        let along = |c: &[f64]| c.iter().enumerate().map(|(i, w)| w * wave(i % strip as usize)).sum::<f64>();
        Ok::<f64, LabError>(along(&u) * du + along(&v) * dv)
    };
    // The other direction of the two decays before.
    let (first, last) = (amplitude(frames / 2)?, amplitude(frames - frames / 2)?);
    let span = f64::from((frames - frames / 2) * steps) * dt;
    let theory = (1.0 + dt * growth(faster * five_point(q)).0).ln() / dt;
    Ok(((last / first).ln() / span, theory, continuum))
}

/// Returns where u comes to rest on a background without v: 1, unless a texel cannot represent the increment of a step.
pub fn stalled(rig: &Rig, storage: Storage, feed: f64) -> Result<f64, LabError> {
    fed(rig, if storage == Storage::Half { "five-point-rg16f" } else { "five-point" }, feed)
}

/// Does the same as [`stalled`], for a method.
fn fed(rig: &Rig, name: &str, feed: f64) -> Result<f64, LabError> {
    let (field, group) = parts(name);
    let sea = vec![texel(name, 0.9, 0.0); 64];
    let setup = method(name, (8, 8), 1.0).uniform("feed", feed).state(field, &sea).steps(group, 50);
    let mut running = rig.open(&setup)?;
    running.frames(20)?;
    Ok(state(&mut running, name)?[0][0])
}

pub static STUDY: Study = Study {
    name: "gray-scott",
    title: "Gray-Scott",
    text: "The coral pattern (F = .0545, k = .062, Du = .16, Dv = .08 texels² for a unit of time) from three \
           smooth spots, against a spectral f64 solver with Strang's splitting. The preset has its own rates \
           (Du = .2097, Dv = .1049) and walls that nothing goes through, and so has its reference; sway and \
           sower are 0. The table gives the growth of a wave of 12 texels over that of linear theory, .0100 in \
           the continuum. At its usual step each method is asked for the developed pattern too, on 64 x 64 texels \
           after 3,000 units of time, where only statistics can be compared: late_ values are by how much the mean \
           of v, the part of the texels with v above .2, and the mean wavelength of the power spectrum exceed \
           those of the reference. The hard case is that u returns to 1 where there is no v, within .001: 16 bits have \
           no room beside 1 for what a step feeds, and the preset keeps 1 - u instead.",
    parameter: "dt",
    unit: Unit::Scene,
    error: "of v",
    methods: METHODS,
    grids: three_of([16, 32, 64, 128]),
    // A larger grid is a larger box.
    has_order: false,
    signed: Some("mean_v"),
    ..Study::of(setup, measure)
};

fn setup(point: &Point) -> Setup {
    let total = (time(point.grid) / point.setting) as u32;
    let (field, group) = parts(&point.method);
    let setup = method(&point.method, (point.grid, point.grid), point.setting);
    let setup = setup.steps(group, frames_of(total, 20).1);
    if !is_preset(&point.method) {
        return setup;
    }
    let [u, v] = seeded(point.grid as usize);
    let seeds: Vec<[f32; 4]> = u.iter().zip(&v).map(|(u, v)| texel(&point.method, *u, *v)).collect();
    setup.state(field, &seeds)
}

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let total = (time(point.grid) / point.setting) as u32;
    let (frames, _) = frames_of(total, 20);
    let mut running = rig.open(&setup(point))?;
    running.frames(frames)?;
    let [_, v] = state(&mut running, &point.method)?;
    let walls = is_preset(&point.method).then(|| DIFFUSION.map(|d| FASTER * d));
    let exact = known(point.grid as usize, walls, time(point.grid));
    let (grown, _, continuum) = grown(rig, &point.method, point.setting)?;
    let stall = fed(rig, &point.method, 0.037)?;
    let mut measured =
        Measured { norms: Norms::of(&v, &exact), frames_per_unit: f64::from(frames), ..Measured::default() };
    // Only on the finest grid of a full run: the reference takes 12,000 steps of a spectral method.
    if point.is_usual(METHODS) && point.grid == 128 {
        let [found, known] = late(rig, &point.method, point.setting)?;
        measured = measured
            .value("late_mean", found.mean / known.mean - 1.0)
            .value("late_area", found.area / known.area - 1.0)
            .value("late_wavelength", found.wavelength / known.wavelength - 1.0);
    }
    Ok(measured
        .value("mean_v", mean(&v) / mean(&exact) - 1.0)
        .value("area", area_above(&v, 0.2) / area_above(&exact, 0.2) - 1.0)
        .value("growth", grown)
        .value("growth/theory", grown / continuum)
        .hard(HardCase::at_most("1 - u without v", (1.0 - stall).abs(), 0.001)))
}
