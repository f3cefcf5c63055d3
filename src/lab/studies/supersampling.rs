//! Several samples per pixel, as by `eddy render --supersample`, and filters that smooth the edges of one sample,
//! compared with the mean over the pixel's area.

use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit, metrics::Norms, reference::coverage, three_of,
};

const SIDES: &[f64] = &[1.0, 2.0, 3.0, 4.0, 6.0, 8.0];
/// The number of pixels along which a filter follows an edge.
const REACHES: &[f64] = &[4.0, 8.0, 16.0, 32.0, 64.0];

const METHODS: &[Method] = &[
    Method { name: "grid", title: "a grid of N x N samples, as --supersample N", settings: SIDES, usual: 4.0 },
    Method { name: "halton", title: "N² points of Halton's sequence", settings: SIDES, usual: 4.0 },
    Method { name: "jittered", title: "a random sample in each of N x N cells", settings: SIDES, usual: 4.0 },
    Method { name: "fxaa", title: "FXAA of one sample", settings: REACHES, usual: 32.0 },
    Method {
        name: "smaa",
        title: "SMAA 1x of one sample, without corners and diagonals",
        settings: REACHES,
        usual: 32.0,
    },
];

const SCENE: &str = include_str!("../../../assets/lab/pixel_samples/scene.glsl");

/// The picture that filters read, in place of the project's own.
const ONE_SAMPLE: &str = "
void mainImage(out vec4 source, in vec2 fragCoord) {
    source = vec4(vec3(scene(fragCoord, 0.5 * iResolution.y)), 1.0);
}
";

/// The four pictures, and their content.
const PARTS: [&str; 4] = ["edges", "lines", "chessboard", "zone_plate"];

/// Returns a canvas of n x n pixels by a method with its setting.
pub fn setup(method: &str, setting: u32, n: u32) -> Setup {
    let filter = match method {
        "fxaa" => "FXAA",
        "smaa" => "SMAA",
        _ => return samples(method, setting, n, 1),
    };
    let setup = Setup::new("edge_smoothing", (n, n)).text("source", format!("{SCENE}{ONE_SAMPLE}"));
    setup.define("METHOD", filter).define("REACH", setting).restless()
}

/// Returns side x side samples per pixel. `zoom` texels of the canvas correspond to one of the scene.
pub fn samples(method: &str, side: u32, n: u32, zoom: u32) -> Setup {
    let name = match method {
        "grid" => "GRID",
        "halton" => "HALTON",
        _ => "JITTER",
    };
    let size = (n * zoom, n * zoom);
    let setup = Setup::new("pixel_samples", size).define("METHOD", name).define("SIDE", side);
    setup.define("ZOOM", format!("{zoom}.0")).restless()
}

/// Returns the values of one of the four pictures in a square of n x n, in order.
pub(super) fn quarter(values: &[f64], n: usize, part: usize) -> Vec<f64> {
    let h = n / 2;
    let first = (part / 2 * n + part % 2) * h;
    (0..h * h).map(|i| values[first + i / h * n + i % h]).collect()
}

/// Returns the root mean square of differences.
pub(super) fn rms(values: &[f64], truth: &[f64]) -> f64 {
    (values.iter().zip(truth).map(|(v, t)| (v - t) * (v - t)).sum::<f64>() / values.len() as f64).sqrt()
}

/// The errors of a method, relative to white over black.
#[derive(Clone, Debug)]
pub struct Errors {
    pub norms: Norms,
    /// The root mean squares in the pictures of edges, lines, the chessboard and the zone plate.
    pub rms: [f64; 4],
    /// The excess light of the thin lines, as a part of theirs.
    pub lines_gain: f64,
    /// The largest error at the edges of squares.
    pub worst_edge: f64,
    /// The root mean square in the rows below the horizon, where a pixel contains a square of the chessboard or more.
    pub horizon: f64,
}

/// Draws a method and compares it with the exact pictures.
pub fn errors(rig: &Rig, method: &str, setting: u32, n: u32) -> Result<Errors, LabError> {
    let drawn = rig.after(&setup(method, setting, n), 1, "field")?.component(0);
    Ok(compared(&drawn, n as usize))
}

fn compared(drawn: &[f64], n: usize) -> Errors {
    let truth = coverage::picture(n);
    let of = |part| (quarter(drawn, n, part), quarter(&truth, n, part));
    let rms_of = |part| {
        let (values, truth) = of(part);
        rms(&values, &truth)
    };
    let ((lines, true_lines), (edges, true_edges), (board, true_board)) = (of(1), of(0), of(2));
    let light = |values: &[f64]| values.iter().sum::<f64>();
    // A square is 1/3 of the distance below the horizon wide, and d²/3h high.
    let rows = ((3.0 * (n / 2) as f64).sqrt() as usize).min(n / 4);
    let first = board.len() - rows * (n / 2);
    Errors {
        norms: Norms::of(drawn, &truth),
        rms: [0, 1, 2, 3].map(rms_of),
        lines_gain: light(&lines) / light(&true_lines) - 1.0,
        worst_edge: edges.iter().zip(&true_edges).map(|(v, t)| (v - t).abs()).fold(0.0, f64::max),
        horizon: rms(&board[first..], &true_board[first..]),
    }
}

pub static STUDY: Study = Study {
    name: "supersampling",
    title: "Samples of a pixel",
    text: "Two squares, one of them almost upright, eight lines of .4 pixels, a chessboard to the horizon and a zone plate \
           to beyond one wave a pixel. The truth is the mean over each pixel's area: polygons clipped at the pixel, \
           Fresnel's integrals, and the chessboard in closed form along a row. The table has the root mean square of each \
           part, of white over black. Filters see one sample a pixel. Hard cases: lines keep their light within 2 %, no pixel of an edge is off by more \
           than .125, and the rows below the horizon, where a pixel has a square or more, by .05 in the mean square.",
    parameter: "N, of N x N samples a pixel; or pixels that a filter follows an edge for",
    unit: Unit::Frame,
    error: "of the mean over a pixel",
    methods: METHODS,
    grids: three_of([32, 64, 128, 256]),
    // Lines and pixels keep their size on every canvas.
    has_order: false,
    ..Study::of(|point| setup(&point.method, point.setting as u32, point.grid), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let found = errors(rig, &point.method, point.setting as u32, point.grid)?;
    let measured = Measured { norms: found.norms, frames_per_unit: 1.0, ..Measured::default() };
    let named = PARTS.iter().zip(found.rms);
    Ok(named
        .fold(measured, |measured, (name, rms)| measured.value(&format!("{name}_rms"), rms))
        .value("lines_gain", found.lines_gain)
        .value("worst_edge", found.worst_edge)
        .value("horizon_rms", found.horizon)
        .hard(HardCase::at_most("light of thin lines", found.lines_gain.abs(), 0.02))
        .hard(HardCase::at_most("the worst pixel of an edge", found.worst_edge, 0.125))
        .hard(HardCase::at_most("rows below the horizon", found.horizon, 0.05)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_pictures_are_detected() {
        let n = 32;
        let truth = coverage::picture(n);
        let none = compared(&truth, n);
        assert!(none.norms.l2 == 0.0 && none.rms == [0.0; 4] && none.worst_edge == 0.0 && none.horizon == 0.0);
        // Missing lines, and a horizon of moiré.
        let wrong = |i: usize| match (i % n < n / 2, i / n < n / 2) {
            (false, true) => 0.0,
            (true, false) if i / n == n - 1 => (i % 2) as f64,
            _ => truth[i],
        };
        let found = compared(&(0..n * n).map(wrong).collect::<Vec<_>>(), n);
        assert_eq!((found.lines_gain, found.worst_edge, found.rms[3]), (-1.0, 0.0, 0.0));
        assert!(found.horizon > 0.1 && found.rms[1] > 0.05, "{found:?}");
    }
}
