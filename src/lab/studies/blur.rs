//! Blurs compared with the requested Gaussian: for single texels at many places, which characterises a linear filter
//! completely.

use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::{Norms, drift},
    three_of,
};
use eddy_project::{Channel, Filter, Input, Pass, PassName, PassSize, Project, Sampler, Source, Wrap};
use std::f64::consts::TAU;

/// The requested blur has the standard deviation of the nine taps; and the widest of the preset's slider, for methods
/// that take a standard deviation.
const SIGMA: f64 = 2.138;
const WIDE_SIGMA: f64 = 2.5;

/// The distance between the single bright texels.
const SPACING: usize = 32;

const REACHES: &[f64] = &[1.0, 1.5, 2.0, 2.5, 3.0, 4.0];
const LEVELS: &[f64] = &[1.0, 2.0, 3.0];

const METHODS: &[Method] = &[
    Method { name: "nine", title: "nine taps that sum to .98", settings: &[1.0], usual: 1.0 },
    Method { name: "nine-normalised", title: "nine taps, normalised", settings: &[1.0], usual: 1.0 },
    Method { name: "five-filtered", title: "five filtered reads of the nine taps", settings: &[1.0], usual: 1.0 },
    Method { name: "gaussian", title: "sampled Gaussian", settings: REACHES, usual: 3.0 },
    Method { name: "gaussian-paired", title: "sampled Gaussian, taps in pairs", settings: REACHES, usual: 3.0 },
    Method {
        name: "gaussian-blur",
        title: "the preset gaussian-blur: taps, pairs, a mip level",
        settings: &[1.0, 2.0, 3.0],
        usual: 1.0,
    },
    Method { name: "box-pyramid", title: "mip levels, bilinear", settings: LEVELS, usual: 1.0 },
    Method { name: "dual-pyramid", title: "dual filter", settings: LEVELS, usual: 1.0 },
    Method { name: "tent-pyramid", title: "13 reads down, tent up", settings: LEVELS, usual: 1.0 },
];

const DOWN: &str = include_str!("../../../assets/lab/blur_pyramid/down.glsl");
const UP: &str = include_str!("../../../assets/lab/blur_pyramid/up.glsl");

/// Adds `levels` passes down and those back up before `field`.
pub(super) fn pyramid(project: &mut Project, levels: u32) {
    let pass = |name: &str, text: &str, level: u32, reads: String| {
        let sampler = Sampler { filter: Filter::Linear, wrap: Wrap::Clamp, vflip: true };
        let mut pass = Pass {
            id: PassName::buffer(name),
            source: Source { name: format!("buffer_{name}.glsl"), path: None, text: text.into() },
            bindings: [Some(Channel { input: Input::buffer(reads), sampler })].into(),
            settings: Default::default(),
            body: Default::default(),
        };
        pass.settings.size = PassSize::Scale(0.5f64.powi(level as i32));
        pass
    };
    let mut passes = Vec::new();
    let mut before = "source".to_owned();
    for level in 1..=levels {
        passes.push(pass(&format!("down{level}"), DOWN, level, before));
        before = format!("down{level}");
    }
    for level in (1..levels).rev() {
        passes.push(pass(&format!("up{level}"), UP, level, before));
        before = format!("up{level}");
    }
    let place = project.passes.iter().position(|p| p.id == PassName::buffer("field")).unwrap_or(0);
    if let Some(Channel { input, .. }) = project.passes[place].bindings.get_mut(0) {
        *input = Input::buffer(before);
    }
    project.passes.splice(place..place, passes);
}

/// Returns the places of the single bright texels: one in each square of [`SPACING`], at as many phases as possible.
fn places(n: usize) -> Vec<(usize, usize)> {
    let cells = n / SPACING;
    let middle = SPACING / 2;
    (0..cells * cells)
        .map(|i| {
            let (cx, cy) = (i % cells, i / cells);
            (cx * SPACING + middle - 4 + (cx + 3 * cy) % 8, cy * SPACING + middle - 4 + (cy + 5 * cx) % 8)
        })
        .collect()
}

fn spots(n: usize) -> Vec<f64> {
    let mut field = vec![0.0; n * n];
    places(n).into_iter().for_each(|(x, y)| field[y * n + x] = 1.0);
    field
}

/// Returns whether a method takes a standard deviation.
fn takes_sigma(method: &str) -> bool {
    matches!(method, "gaussian" | "gaussian-paired" | "gaussian-blur")
}

/// Returns the pass from which a method reads its picture, and the one with the result.
fn ends(method: &str) -> (&'static str, &'static str) {
    if method == "gaussian-blur" { ("a", "c") } else { ("source", "field") }
}

/// Returns a point's project that blurs by a standard deviation, if it takes one.
fn setup(point: &Point, sigma: f64) -> Setup {
    let size = (point.grid, point.grid);
    let texels: Vec<[f32; 4]> = spots(point.grid as usize).iter().map(|&v| [v as f32; 4]).collect();
    let taps = |method| Setup::new("blur_taps", size).define("METHOD", method).uniform("sigma", sigma);
    let levels = point.setting as u32;
    let pyramid =
        |method| Setup::new("blur_pyramid", size).define("METHOD", method).built(move |p| self::pyramid(p, levels));
    let setup = match point.method.as_str() {
        "nine" => taps("NINE"),
        "nine-normalised" => taps("NORMALISED"),
        "five-filtered" => taps("FIVE"),
        "gaussian" => taps("GAUSSIAN").uniform("reach", point.setting),
        "gaussian-paired" => taps("PAIRED").uniform("reach", point.setting),
        "gaussian-blur" => {
            let preset = Setup::new("gaussian-blur", size).wants(&["c"]).uniform("sigma", sigma);
            return preset.uniform("variant", point.setting).given("a", &texels);
        }
        "box-pyramid" => pyramid("BOX"),
        "dual-pyramid" => pyramid("DUAL"),
        _ => pyramid("TENT"),
    };
    setup.state("source", &texels)
}

fn exact(n: usize, sigma: f64) -> Vec<f64> {
    let places = places(n);
    let value = |i: usize| {
        let (x, y) = ((i % n) as f64, (i / n) as f64);
        let spot = |&(px, py): &(usize, usize)| {
            let square = (x - px as f64).powi(2) + (y - py as f64).powi(2);
            if square > (8.0 * sigma).powi(2) { 0.0 } else { (-0.5 * square / (sigma * sigma)).exp() }
        };
        places.iter().map(spot).sum::<f64>() / (TAU * sigma * sigma)
    };
    (0..n * n).map(value).collect()
}

/// The results for bright texels.
struct Phases {
    /// The largest distance from a texel to its centroid.
    shift: f64,
    /// The spread of the peaks relative to their mean.
    spread: f64,
    /// The standard deviation along an axis around the centroid: of the mean variance of both axes and all texels.
    sigma: f64,
}

fn phases(n: usize, field: &[f64]) -> Phases {
    let (mut worst, mut peaks, mut variances) = (0.0f64, Vec::new(), Vec::new());
    for (px, py) in places(n) {
        let (x0, y0) = (px / SPACING * SPACING, py / SPACING * SPACING);
        let (mut sum, mut mx, mut my, mut square, mut peak) = (0.0, 0.0, 0.0, 0.0, 0.0f64);
        for (x, y) in (y0..y0 + SPACING).flat_map(|y| (x0..x0 + SPACING).map(move |x| (x, y))) {
            let v = field[y * n + x];
            let (x, y) = (x as f64 - px as f64, y as f64 - py as f64);
            (sum, mx, my, square) = (sum + v, mx + v * x, my + v * y, square + v * (x * x + y * y));
            peak = peak.max(v);
        }
        let shift = (mx / sum).hypot(my / sum);
        worst = worst.max(shift);
        peaks.push(peak);
        variances.push(0.5 * (square / sum - shift * shift));
    }
    let mean = peaks.iter().sum::<f64>() / peaks.len() as f64;
    let (low, high) = peaks.iter().fold((f64::MAX, 0.0f64), |(lo, hi), p| (lo.min(*p), hi.max(*p)));
    let variance = variances.iter().sum::<f64>() / variances.len() as f64;
    Phases { shift: worst, spread: (high - low) / mean, sigma: variance.sqrt() }
}

pub(super) static STUDY: Study = Study {
    name: "blur",
    title: "Blur",
    text: "Single bright texels at many places, against a Gaussian of standard deviation 2.138, which is that \
           of the well-known nine taps. The table gives what became of the sum, how far a centroid moved, by \
           how much peaks differ from place to place, and the standard deviation that is delivered, about the \
           centroid; of methods that take one also the error and what is delivered where 2.5 is asked for. The \
           hard case is that an even picture stays what it was, within 1e-5.",
    parameter: "cut-off in standard deviations, levels, or the preset's variant",
    unit: Unit::Frame,
    error: "of the blurred texels",
    methods: METHODS,
    grids: three_of([64, 128, 256, 512]),
    // The Gaussian is specified in texels.
    has_order: false,
    ..Study::of(|point| setup(point, SIGMA), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let n = point.grid as usize;
    let (source, result) = ends(&point.method);
    let after = rig.after(&(STUDY.setup)(point), 1, result)?.component(0);
    let phases = self::phases(n, &after);
    let even = rig.after(&(STUDY.setup)(point).initial(source, "vec4(1.0)"), 1, result)?.component(0);
    let worst = even.iter().fold(0.0f64, |a, b| a.max((b - 1.0).abs()));
    let norms = Norms::of(&after, &exact(n, SIGMA));
    let mut measured = Measured { norms, frames_per_unit: 1.0, ..Measured::default() }
        .value("mass_drift", drift(&spots(n), &after))
        .value("centroid_texels", phases.shift)
        .value("peak_spread", phases.spread)
        .value("sigma", phases.sigma);
    if takes_sigma(&point.method) {
        let wide = rig.after(&setup(point, WIDE_SIGMA), 1, result)?.component(0);
        measured = measured
            .value("l2_at_2.5", Norms::of(&wide, &exact(n, WIDE_SIGMA)).l2)
            .value("sigma_at_2.5", self::phases(n, &wide).sigma);
    }
    Ok(measured.hard(HardCase::at_most("an even picture", worst, 1e-5)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn width_and_shift_of_a_spot_are_measured() {
        let n = 2 * SPACING;
        for sigma in [1.5, 2.5] {
            let found = phases(n, &exact(n, sigma));
            assert!((found.sigma / sigma - 1.0).abs() < 1e-3 && found.shift < 1e-3, "{sigma}: {}", found.sigma);
        }
        // Two adjacent texels instead of one: shifted by a half, and a half wide along one axis.
        let mut field = vec![0.0; n * n];
        places(n).into_iter().for_each(|(x, y)| field[y * n + x..y * n + x + 2].fill(0.5));
        let found = phases(n, &field);
        assert!((found.shift - 0.5).abs() < 1e-12 && (found.sigma - 0.125f64.sqrt()).abs() < 1e-12);
        assert_eq!(found.spread, 0.0);
    }
}
