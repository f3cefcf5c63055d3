//! Screen-space reflections: the distance between the reflected place and the end of the exactly reflected ray.

use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::Norms,
    reference::{
        rays::{V, add, on_all_cores},
        still_life::{FAR, View, first, is_table, march},
    },
    three_of,
};

/// The length of a reflected ray, in units of the scene.
const REACH: f64 = 7.0;

/// A hit with a confidence below this in the preset counts as none.
const BELIEVED: f64 = 0.5;

const STRIDES: &[f64] = &[8.0, 16.0, 24.0, 48.0, 128.0];

const METHODS: &[Method] = &[
    Method { name: "gbuffer-ssao-ssr", title: "the preset: in the picture, halved", settings: STRIDES, usual: 24.0 },
    Method { name: "march", title: "equal steps in space", settings: STRIDES, usual: 24.0 },
    Method { name: "march-halved", title: "equal steps in space, halved", settings: STRIDES, usual: 24.0 },
];

const MARCH: &str = include_str!("../../../assets/lab/reflection_march.glsl");

fn setup(method: &str, strides: f64, size: (u32, u32)) -> Setup {
    let setup = Setup::new("gbuffer-ssao-ssr", size).wants(&["d"]).restless().uniform("turning", 0.0);
    let setup = match method {
        "gbuffer-ssao-ssr" => setup,
        _ => setup.text("d", MARCH).define("HALVED", u32::from(method == "march-halved")),
    };
    setup.uniform("strides", strides)
}

/// The expected and the actual reflection of a table's pixel.
#[derive(Clone, Copy, Debug)]
struct Reflection {
    /// The end of the exact ray, in pixels; `None` if it hits nothing, or a place that the camera does not see.
    exact: Option<[f64; 2]>,
    found: Option<[f64; 2]>,
}

/// The quality of the reflections.
#[derive(Clone, Debug)]
pub struct Hits {
    /// Distances from the exact place in pixels, in increasing order.
    pub off: Vec<f64>,
    /// The number of pixels whose reflection is visible to the camera, and how many of them have one.
    pub wanted: usize,
    /// The number of pixels that cannot have a reflection, and how many of them show one.
    pub empty: usize,
    pub wrong: usize,
}

impl Hits {
    /// Returns the distance that a share of all is within.
    pub fn within(&self, part: f64) -> f64 {
        let last = self.off.len().saturating_sub(1);
        self.off.get((part * last as f64).round() as usize).copied().unwrap_or(f64::INFINITY)
    }

    pub fn found_share(&self) -> f64 {
        self.off.len() as f64 / self.wanted as f64
    }

    pub fn wrong_share(&self) -> f64 {
        self.wrong as f64 / self.empty as f64
    }

    fn of(all: &[Reflection]) -> Hits {
        let mut hits = Hits { off: Vec::new(), wanted: 0, empty: 0, wrong: 0 };
        for reflection in all {
            match (reflection.exact, reflection.found) {
                (Some(exact), found) => {
                    hits.wanted += 1;
                    hits.off.extend(found.map(|at| (at[0] - exact[0]).hypot(at[1] - exact[1])));
                }
                (None, found) => {
                    hits.empty += 1;
                    hits.wrong += usize::from(found.is_some());
                }
            }
        }
        hits.off.sort_by(f64::total_cmp);
        hits
    }
}

/// Returns the end of the ray that a table's pixel reflects, if it is visible to the camera.
fn mirrored(view: &View, pixel: [f64; 2]) -> Option<Option<[f64; 2]>> {
    let ray = view.ray(pixel);
    let table = add(view.eye, ray, first(view.eye, ray, FAR)?);
    if !is_table(table) {
        return None;
    }
    let up: V = [ray[0], -ray[1], ray[2]];
    let end = march(table, up, REACH).map(|t| add(table, up, t));
    Some(end.filter(|end| view.sees(*end)).and_then(|end| view.pixel(end)))
}

pub fn hits(rig: &Rig, method: &str, strides: f64, size: (u32, u32)) -> Result<Hits, LabError> {
    let field = rig.after(&setup(method, strides, size), 1, "d")?;
    let view = View::new(size.0, size.1);
    // About 6,000 of a picture's pixels, in all phases of the march's dither.
    let step = ((f64::from(size.0) * f64::from(size.1) / 6000.0).sqrt() as u32).max(1) | 1;
    let spots: Vec<(u32, u32)> = (0..size.1)
        .step_by(step as usize)
        .flat_map(|y| (0..size.0).step_by(step as usize).map(move |x| (x, y)))
        .collect();
    let all = on_all_cores(&spots, |&(x, y)| {
        let exact = mirrored(&view, [f64::from(x) + 0.5, f64::from(y) + 0.5])?;
        let [u, v, belief, _] = field.texels()[(y * size.0 + x) as usize].map(f64::from);
        let found = (belief > BELIEVED).then(|| [u * f64::from(size.0), v * f64::from(size.1)]);
        Some(Reflection { exact, found })
    });
    Ok(Hits::of(&all.into_iter().flatten().collect::<Vec<_>>()))
}

pub static STUDY: Study = Study {
    name: "ssr",
    title: "Screen-space reflections",
    text: "The still life of the preset on its mirroring table. A ray in f64 is mirrored in the table and \
           followed to the first thing; where the camera sees that place, the method's hit is held against it, \
           in pixels. The error is the root mean square of that, over the picture's height. Hits that a method \
           believes in by less than a half count as none. The table gives the median and what 95 % are within, \
           how many reflections were found, and how many pixels show one that cannot have any, since the ray \
           meets nothing or what the camera does not see. Hard cases: a median of at most a pixel; 3 of 4 \
           found; at most 5 % wrong.",
    parameter: "steps of a ray",
    unit: Unit::Frame,
    error: "of the place, over the picture's height",
    methods: METHODS,
    grids: three_of([80, 160, 320, 640]),
    // Steps are a part of the ray on every grid.
    has_order: false,
    ..Study::of(|point| setup(&point.method, point.setting, (point.grid, point.grid)), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let hits = hits(rig, &point.method, point.setting, (point.grid, point.grid))?;
    let (n, height) = (hits.off.len() as f64, f64::from(point.grid));
    let norms = Norms {
        l1: hits.off.iter().sum::<f64>() / n / height,
        l2: (hits.off.iter().map(|d| d * d).sum::<f64>() / n).sqrt() / height,
        linf: hits.within(1.0) / height,
    };
    Ok(Measured { norms, frames_per_unit: 1.0, ..Measured::default() }
        .value("median_px", hits.within(0.5))
        .value("within_95_px", hits.within(0.95))
        .value("found_share", hits.found_share())
        .value("wrong_share", hits.wrong_share())
        .hard(HardCase::at_most("median, pixels", hits.within(0.5), 1.0))
        .hard(HardCase::at_most("reflections not found", 1.0 - hits.found_share(), 0.25))
        .hard(HardCase::at_most("reflections that are none", hits.wrong_share(), 0.05)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_and_false_reflections_are_counted() {
        let at = |x: f64| Some([x, 0.0]);
        let all = [(at(1.0), at(1.5)), (at(1.0), at(5.0)), (at(1.0), None), (None, at(2.0)), (None, None)];
        let hits = Hits::of(&all.map(|(exact, found)| Reflection { exact, found }));
        assert_eq!(hits.off, [0.5, 4.0]);
        assert!((hits.found_share() - 2.0 / 3.0).abs() < 1e-12 && (hits.wrong_share() - 0.5).abs() < 1e-12);
        assert_eq!((hits.within(0.0), hits.within(1.0)), (0.5, 4.0));
    }

    #[test]
    fn the_balls_mirror_image_is_below_it() {
        let view = View::new(320, 180);
        // The ball's front, and the place on the table from where a ray is reflected towards it.
        let (mut found, mut higher) = (0, 0);
        for (x, y) in (0..180).step_by(4).flat_map(|y| (0..320).step_by(4).map(move |x| (x, y))) {
            let pixel = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            if let Some(Some(end)) = mirrored(&view, pixel) {
                found += 1;
                higher += usize::from(end[1] > pixel[1] - 1e-9);
            }
        }
        assert!(found > 100 && higher == found, "{higher} of {found} lie above what mirrors them");
    }
}
