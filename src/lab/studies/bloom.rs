//! Bloom by pyramids: the light and place of a bright texel at every phase of the pyramid, in the middle and at the
//! edges.

use super::blur::pyramid;
use crate::{
    Field, HardCase, LabError, Measured, Method, Point, Rig, Running, Setup, Study, Unit,
    metrics::{Norms, mean},
    three_of,
};

/// The number of the canvas's texels per texel of the widest level: the period of the phases of a pyramid of five
/// levels.
pub const PERIOD: u32 = 32;

/// The number of pictures that are compared texel by texel: two of each column of phases.
const COMPARED: u32 = 2 * PERIOD;

const LEVELS: &[f64] = &[2.0, 3.0, 4.0, 5.0];

const METHODS: &[Method] = &[
    Method { name: "bloom", title: "the preset bloom", settings: &[0.6, 1.15, 2.0], usual: 1.15 },
    Method { name: "bloom-sized", title: "the preset bloom-sized", settings: &[0.3, 0.62, 1.0], usual: 0.62 },
    Method { name: "box-pyramid", title: "mip levels, bilinear", settings: LEVELS, usual: 4.0 },
    Method { name: "dual-pyramid", title: "dual filter", settings: LEVELS, usual: 4.0 },
    Method { name: "tent-pyramid", title: "13 reads down, tent up", settings: LEVELS, usual: 4.0 },
];

/// Returns a method at a setting and a size, as it ships.
fn whole(method: &str, setting: f64, size: (u32, u32)) -> Setup {
    let preset = |name| Setup::new(name, size).wants_picture().uniform("strength", 1.0).uniform("spread", setting);
    let levels = setting as u32;
    let peer = |form| Setup::new("blur_pyramid", size).define("METHOD", form).built(move |p| pyramid(p, levels));
    match method {
        "bloom" => preset("bloom"),
        "bloom-sized" => preset("bloom-sized"),
        "box-pyramid" => peer("BOX"),
        "dual-pyramid" => peer("DUAL"),
        _ => peer("TENT"),
    }
}

/// Does the same, and measures the spread light, without the sharp part and before tone mapping.
pub fn setup(method: &str, setting: f64, size: (u32, u32)) -> Setup {
    let setup = whole(method, setting, size);
    match method {
        "bloom" => setup.wants_value("image", "vec3 light"),
        "bloom-sized" => setup.wants_value("image", "vec3 wide"),
        _ => setup,
    }
}

/// Returns the pass from which a method reads its picture.
fn source(setup: &Setup) -> &'static str {
    if setup.folder() == "blur_pyramid" { "source" } else { "a" }
}

/// Reads the spread light.
fn light(setup: &Setup, running: &mut Running) -> Result<Field, LabError> {
    if setup.folder() == "blur_pyramid" { running.read("field") } else { running.read_value() }
}

/// The result for a bright texel of 1.
#[derive(Clone, Debug)]
pub struct Spot {
    pub at: [u32; 2],
    /// The sum of all texels.
    pub total: f64,
    /// The distance from the bright texel to the centroid, in pixels.
    pub shift: f64,
    /// The second moment about the bright texel along one axis, in square pixels: the mean of both axes.
    pub variance: f64,
    /// The picture itself, row 0 first.
    pub light: Vec<f64>,
}

impl Spot {
    fn of(at: [u32; 2], width: usize, light: Vec<f64>) -> Spot {
        let (mut total, mut moment, mut square) = (0.0, [0.0; 2], 0.0);
        for (i, v) in light.iter().enumerate() {
            let d = [(i % width) as f64 - f64::from(at[0]), (i / width) as f64 - f64::from(at[1])];
            total += v;
            (0..2).for_each(|axis| moment[axis] += v * d[axis]);
            square += v * (d[0] * d[0] + d[1] * d[1]);
        }
        let shift = moment[0].hypot(moment[1]) / total;
        Spot { at, total, shift, variance: 0.5 * square / total, light }
    }
}

/// Returns the nth of all phases around the middle of a canvas. The first [`PERIOD`] contain every phase of either axis
/// once.
pub fn phase(n: u32, (width, height): (u32, u32)) -> [u32; 2] {
    let x = n % PERIOD;
    [width / 2 - PERIOD / 2 + x, height / 2 - PERIOD / 2 + (n / PERIOD + 11 * x) % PERIOD]
}

/// Draws a bright texel at each place, each in a separate component, three per frame.
pub fn spots(rig: &Rig, setup: &Setup, places: &[[u32; 2]], mut each: impl FnMut(Spot)) -> Result<(), LabError> {
    for part in places.chunks(96) {
        let list: Vec<String> = part.iter().map(|[x, y]| format!("ivec2({x}, {y})")).collect();
        let scene = format!(
            "const ivec2 AT[{n}] = ivec2[{n}]({list});
             void mainImage(out vec4 light, in vec2 fragCoord) {{
                 light = vec4(0.0, 0.0, 0.0, 1.0);
                 for (int c = 0; c < 3; c++) {{
                     int n = 3 * iFrame + c;
                     if (n < {n} && ivec2(fragCoord) == AT[min(n, {n} - 1)]) light[c] = 1.0;
                 }}
             }}",
            n = part.len(),
            list = list.join(", "),
        );
        let mut running = rig.open(&setup.clone().text(source(setup), scene))?;
        for three in part.chunks(3) {
            running.frames(1)?;
            let field = light(setup, &mut running)?;
            for (c, at) in three.iter().enumerate() {
                each(Spot::of(*at, field.width(), field.component(c)));
            }
        }
    }
    Ok(())
}

/// The worst values of many spots.
#[derive(Clone, Copy, Debug)]
pub struct SpotExtremes {
    pub low: f64,
    pub high: f64,
    pub shift: f64,
}

impl SpotExtremes {
    pub const NONE: SpotExtremes = SpotExtremes { low: f64::INFINITY, high: 0.0, shift: 0.0 };

    pub fn add(&mut self, spot: &Spot) {
        (self.low, self.high) = (self.low.min(spot.total), self.high.max(spot.total));
        self.shift = self.shift.max(spot.shift);
    }

    /// Returns the largest part of a spot's light that was gained or lost.
    pub fn gain(&self) -> f64 {
        (self.high - 1.0).abs().max((self.low - 1.0).abs())
    }
}

/// Returns places at which a kernel extends over an edge or a corner.
pub fn edges((width, height): (u32, u32)) -> Vec<[u32; 2]> {
    let (right, top, x, y) = (width - 1, height - 1, width / 2, height / 2);
    vec![
        [0, 0],
        [right, 0],
        [0, top],
        [right, top],
        [0, y],
        [right, y],
        [x, 0],
        [x, top],
        [right - 8, 5],
        [right - 20, y],
        [x, top - 14],
        [right - 35, top - 3],
    ]
}

/// Returns a canvas of similar size whose sides are not divisible by any pyramid.
fn odd(grid: u32) -> (u32, u32) {
    ((grid + grid / 3) | 1, (grid - grid / 4) | 1)
}

/// Returns spots that are shifted to the middle, one after the other; and the same number of copies of their mean.
fn moved_to_the_middle(spots: &[Spot], n: usize) -> (Vec<f64>, Vec<f64>) {
    // As far as every spot extends.
    let reach = n / 2 - PERIOD as usize;
    let side = 2 * reach + 1;
    let all: Vec<f64> = spots
        .iter()
        .flat_map(|spot| {
            let [x0, y0] = spot.at.map(|v| v as usize - reach);
            (0..side * side).map(move |i| spot.light[(y0 + i / side) * n + x0 + i % side])
        })
        .collect();
    let mut middle = vec![0.0; side * side];
    all.iter().enumerate().for_each(|(i, v)| middle[i % (side * side)] += v / spots.len() as f64);
    let repeated = spots.iter().flat_map(|_| middle.iter().copied()).collect();
    (all, repeated)
}

/// Returns the mean increase of brightness of a wall of 0.05 caused by a texel of a million in it.
fn firefly(rig: &Rig, setup: &Setup) -> Result<f64, LabError> {
    let wall = |hot: &str| {
        let (width, height) = setup.size();
        let middle = format!("ivec2({}, {})", width / 2, height / 2);
        let scene = format!(
            "void mainImage(out vec4 light, in vec2 fragCoord) {{
                 light = vec4(vec3(ivec2(fragCoord) == {middle} ? {hot} : 0.05), 1.0);
             }}"
        );
        let mut running = rig.open(&setup.clone().text(source(setup), scene))?;
        running.frames(1)?;
        Ok::<_, LabError>(mean(&light(setup, &mut running)?.component(0)))
    };
    Ok(wall("1e6")? - wall("0.05")?)
}

pub static STUDY: Study = Study {
    name: "bloom",
    title: "Bloom",
    text: "A bright texel on black, at phases of the pyramid (all 1,024 for the usual setting of a full run, \
           else 64), on the canvas of the plot and on one of odd sides. Whatever the shape of a glow, it must \
           not depend on where it is: the error is that of the pictures, moved to the middle, from their mean. \
           Hard cases: a spot's total stays within 1 % and its centroid within .25 pixel at every phase; its \
           total stays within 1 % at the edges of the odd canvas, where what leaves comes back; a texel of a \
           million in a wall makes the mean no brighter than by .005. The peers are the plain pyramids of the \
           study of blurs.",
    parameter: "weight of the wider levels, or levels",
    unit: Unit::Frame,
    error: "of a spot's glow from its mean over the phases",
    methods: METHODS,
    grids: three_of([64, 128, 256, 512]),
    // A pyramid's kernel has the same width in texels on every canvas.
    has_order: false,
    ..Study::of(drawn, measure)
};

fn drawn(point: &Point) -> Setup {
    let setup = whole(&point.method, point.setting, (point.grid, point.grid));
    let source = source(&setup);
    // Something to draw in every frame, like a scene. Only integers (M. Jarzynski, M. Olano, "Hash Functions for GPU
    // Rendering", JCGT 9(3), 2020: pcg3d).
    let scene = "void mainImage(out vec4 light, in vec2 fragCoord) {
        uvec3 v = uvec3(ivec3(ivec2(fragCoord) / 8, iFrame)) * 1664525u + 1013904223u;
        v.x += v.y * v.z;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v ^= v >> 16u;
        light = vec4(vec3((v.x + v.y * v.z) >> 8u) / 16777216.0, 1.0);
    }";
    setup.text(source, scene)
}

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let n = point.grid;
    let count = if point.is_usual(METHODS) && n >= 512 { PERIOD * PERIOD } else { COMPARED };
    let (mut worst, mut compared) = (SpotExtremes::NONE, Vec::new());
    let at = |size, count| (0..count).map(|i| phase(i, size)).collect::<Vec<_>>();
    let on_grid = setup(&point.method, point.setting, (n, n));
    spots(rig, &on_grid, &at((n, n), count), |spot| {
        worst.add(&spot);
        if compared.len() < COMPARED as usize {
            compared.push(spot);
        }
    })?;
    let (all, middle) = moved_to_the_middle(&compared, n as usize);
    let peaks: Vec<f64> = compared.iter().map(|s| s.light.iter().copied().fold(0.0, f64::max)).collect();
    let (low, high) = peaks.iter().fold((f64::MAX, 0.0f64), |(lo, hi), p| (lo.min(*p), hi.max(*p)));
    let variance = compared.iter().map(|s| s.variance).sum::<f64>() / compared.len() as f64;
    let (size, mut beside) = (odd(n), SpotExtremes::NONE);
    let on_odd = setup(&point.method, point.setting, size);
    spots(rig, &on_odd, &at(size, PERIOD), |spot| worst.add(&spot))?;
    spots(rig, &on_odd, &edges(size), |spot| beside.add(&spot))?;
    Ok(Measured { norms: Norms::of(&all, &middle), frames_per_unit: 1.0, ..Measured::default() }
        .value("total_low", worst.low)
        .value("total_high", worst.high)
        .value("centroid_px", worst.shift)
        .value("peak_spread", (high - low) / mean(&peaks))
        .value("sigma_px", variance.sqrt())
        .value("edge_total_low", beside.low)
        .value("edge_total_high", beside.high)
        .hard(HardCase::at_most("total at every phase", worst.gain(), 0.01))
        .hard(HardCase::at_most("centroid at every phase, pixels", worst.shift, 0.25))
        .hard(HardCase::at_most("total at the edges of odd sizes", beside.gain(), 0.01))
        .hard(HardCase::at_most("a texel of a million", firefly(rig, &on_grid)?, 0.005)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_phase_occurs_once() {
        let size = (256, 192);
        let mut all: Vec<[u32; 2]> = (0..PERIOD * PERIOD).map(|n| phase(n, size)).collect();
        for axis in 0..2 {
            let mut first: Vec<u32> = all[..PERIOD as usize].iter().map(|p| p[axis] % PERIOD).collect();
            first.sort_unstable();
            assert_eq!(first, (0..PERIOD).collect::<Vec<_>>());
        }
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), (PERIOD * PERIOD) as usize);
    }

    #[test]
    fn shifts_and_losses_of_light_are_detected() {
        let mut light = vec![0.0; 64 * 64];
        light[20 * 64 + 31] = 0.5;
        light[20 * 64 + 33] = 0.45;
        let spot = Spot::of([31, 20], 64, light);
        assert!((spot.total - 0.95).abs() < 1e-12 && (spot.shift - 0.9 / 0.95).abs() < 1e-12, "{spot:?}");
        let mut worst = SpotExtremes::NONE;
        worst.add(&spot);
        assert!((worst.gain() - 0.05).abs() < 1e-12 && worst.shift > 0.25);
    }

    #[test]
    fn a_glow_that_depends_on_its_place_is_far_from_the_mean() {
        let n = 128;
        let glow = |at: [u32; 2], peak: f64| {
            let mut light = vec![0.0; n * n];
            light[at[1] as usize * n + at[0] as usize] = peak;
            Spot::of(at, n, light)
        };
        let error = |peaks: [f64; 2]| {
            let spots = [glow([60, 64], peaks[0]), glow([67, 66], peaks[1])];
            let (all, middle) = moved_to_the_middle(&spots, n);
            Norms::of(&all, &middle).l2
        };
        assert!(error([1.0, 1.0]) < 1e-12 && (error([1.0, 0.5]) - 0.25 / 0.75).abs() < 1e-12);
    }
}
