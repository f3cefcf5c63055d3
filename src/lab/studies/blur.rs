//! Blurs against the Gaussian that was asked for: of single texels at many places, which is the whole of a linear
//! filter.

use crate::{
    lab::{
        About, Extent, HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
        metrics::{Norms, drift},
    },
    project::{Channel, Filter, Input, Pass, PassId, PassSize, Project, Sampler, Source, Wrap},
};
use std::f64::consts::TAU;

pub struct Blur;

/// The blur that is asked for has the standard deviation of the nine taps.
const SIGMA: f64 = 2.138;

/// Texels between the single bright ones.
const SPACING: usize = 32;

const REACHES: &[f64] = &[1.0, 1.5, 2.0, 2.5, 3.0, 4.0];
const LEVELS: &[f64] = &[1.0, 2.0, 3.0];

const METHODS: &[Method] = &[
    Method { name: "nine", title: "nine taps that sum to .98", settings: &[1.0], usual: 1.0 },
    Method { name: "nine-normalised", title: "nine taps, normalised", settings: &[1.0], usual: 1.0 },
    Method { name: "five-filtered", title: "five filtered reads of the nine taps", settings: &[1.0], usual: 1.0 },
    Method { name: "gaussian", title: "sampled Gaussian", settings: REACHES, usual: 3.0 },
    Method { name: "gaussian-paired", title: "sampled Gaussian, taps in pairs", settings: REACHES, usual: 3.0 },
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
            id: PassId::Buffer(name.to_owned()),
            source: Source { name: format!("buffer_{name}.glsl"), path: None, text: text.into() },
            channels: [Some(Channel { input: Input::Buffer(reads), sampler }), None, None, None],
            settings: Default::default(),
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
    let place = project.passes.iter().position(|p| p.id == PassId::Buffer("field".into())).unwrap_or(0);
    if let Some(Channel { input, .. }) = &mut project.passes[place].channels[0] {
        *input = Input::Buffer(before);
    }
    project.passes.splice(place..place, passes);
}

/// Returns where the single bright texels lie: one in each square of [`SPACING`], at as many phases as there are.
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

fn exact(n: usize) -> Vec<f64> {
    let places = places(n);
    let value = |i: usize| {
        let (x, y) = ((i % n) as f64, (i / n) as f64);
        let spot = |&(px, py): &(usize, usize)| {
            let square = (x - px as f64).powi(2) + (y - py as f64).powi(2);
            if square > (8.0 * SIGMA).powi(2) { 0.0 } else { (-0.5 * square / (SIGMA * SIGMA)).exp() }
        };
        places.iter().map(spot).sum::<f64>() / (TAU * SIGMA * SIGMA)
    };
    (0..n * n).map(value).collect()
}

/// The largest distance from a bright texel to the centroid of what became of it, and the spread of the peaks over
/// their mean.
fn phases(n: usize, field: &[f64]) -> (f64, f64) {
    let (mut worst, mut peaks) = (0.0f64, Vec::new());
    for (px, py) in places(n) {
        let (x0, y0) = (px / SPACING * SPACING, py / SPACING * SPACING);
        let (mut sum, mut mx, mut my, mut peak) = (0.0, 0.0, 0.0, 0.0f64);
        for (x, y) in (y0..y0 + SPACING).flat_map(|y| (x0..x0 + SPACING).map(move |x| (x, y))) {
            let v = field[y * n + x];
            (sum, mx, my) = (sum + v, mx + v * x as f64, my + v * y as f64);
            peak = peak.max(v);
        }
        worst = worst.max((mx / sum - px as f64).hypot(my / sum - py as f64));
        peaks.push(peak);
    }
    let mean = peaks.iter().sum::<f64>() / peaks.len() as f64;
    let (low, high) = peaks.iter().fold((f64::MAX, 0.0f64), |(lo, hi), p| (lo.min(*p), hi.max(*p)));
    (worst, (high - low) / mean)
}

impl Study for Blur {
    fn about(&self) -> About {
        About {
            name: "blur",
            title: "Blur",
            text: "Single bright texels at many places, against a Gaussian of standard deviation 2.138, which is that \
                   of the well-known nine taps. The table gives what became of the sum, how far a centroid moved, and \
                   by how much peaks differ from place to place. The hard case is that an even picture stays what it \
                   was, within 1e-5.",
            parameter: "cut-off in standard deviations, or levels",
            unit: Unit::Frame,
            error: "of the blurred texels",
        }
    }

    fn methods(&self) -> &'static [Method] {
        METHODS
    }

    fn grids(&self, extent: Extent) -> &'static [u32] {
        match extent {
            Extent::Quick => &[64, 128, 256],
            Extent::Full => &[128, 256, 512],
        }
    }

    /// The Gaussian is asked for in texels.
    fn has_order(&self) -> bool {
        false
    }

    fn setup(&self, point: &Point) -> Setup {
        let size = (point.grid, point.grid);
        let texels: Vec<[f32; 4]> = spots(point.grid as usize).iter().map(|&v| [v as f32; 4]).collect();
        let taps = |method| Setup::new("blur_taps", size).define("METHOD", method).uniform("sigma", SIGMA);
        let levels = point.setting as u32;
        let pyramid =
            |method| Setup::new("blur_pyramid", size).define("METHOD", method).built(move |p| self::pyramid(p, levels));
        let setup = match point.method.as_str() {
            "nine" => taps("NINE"),
            "nine-normalised" => taps("NORMALISED"),
            "five-filtered" => taps("FIVE"),
            "gaussian" => taps("GAUSSIAN").uniform("reach", point.setting),
            "gaussian-paired" => taps("PAIRED").uniform("reach", point.setting),
            "box-pyramid" => pyramid("BOX"),
            "dual-pyramid" => pyramid("DUAL"),
            _ => pyramid("TENT"),
        };
        setup.state("source", &texels)
    }

    fn measure(&self, rig: &Rig, point: &Point) -> Result<Measured, LabError> {
        let n = point.grid as usize;
        let after = rig.after(&self.setup(point), 1, "field")?.component(0);
        let (centroid, spread) = phases(n, &after);
        let even = rig.after(&self.setup(point).initial("source", "vec4(1.0)"), 1, "field")?.component(0);
        let worst = even.iter().fold(0.0f64, |a, b| a.max((b - 1.0).abs()));
        Ok(Measured { norms: Norms::of(&after, &exact(n)), frames_per_unit: 1.0, ..Measured::default() }
            .value("mass_drift", drift(&spots(n), &after))
            .value("centroid_texels", centroid)
            .value("peak_spread", spread)
            .hard(HardCase::at_most("an even picture", worst, 1e-5)))
    }
}
