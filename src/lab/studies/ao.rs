//! Screen-space ambient occlusion, compared with 1,024 rays per point in the scene itself.

use super::{
    ao_closed::{closed, closed_of_meshes},
    ao_setup::{ROOM_RADIUS, TABLE_RADIUS, is_sliced, room_falloff, setup, texel},
};
use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Setup, Study, Unit,
    metrics::Norms,
    reference::{
        rays::{Errors, Meshes, add, dot, hidden, on_all_cores, unit},
        still_life::{FAR, View, first, is_table, normal},
    },
    three_of,
};

/// The number of rays per point along either side of the square of strata.
const SIDE: u32 = 32;

/// The number of a picture's points that are compared with rays.
const POINTS: f64 = 900.0;

/// The maximum distance from the plane of a point: with a larger one, or with a normal whose component along the
/// point's is smaller, a point of the room's meshes belongs to another surface.
const STEP: f64 = 0.05 * ROOM_RADIUS;
const BENT: f64 = 0.7;

const SAMPLES: &[f64] = &[8.0, 16.0, 32.0, 64.0];

const METHODS: &[Method] = &[
    Method {
        name: "horizons",
        title: "preset gbuffer-ssao-ssr: sectors of slices",
        settings: &[8.0, 16.0, 24.0, 32.0, 64.0],
        usual: 24.0,
    },
    Method {
        name: "gtao",
        title: "GTAO: the highest horizon of a slice",
        settings: &[8.0, 16.0, 24.0, 32.0, 64.0],
        usual: 24.0,
    },
    Method { name: "rays", title: "preset ssao: rays of four samples", settings: SAMPLES, usual: 64.0 },
    Method { name: "points", title: "ssao, method 1: points of the hemisphere", settings: SAMPLES, usual: 64.0 },
    Method { name: "sphere", title: "ssao, method 2: points of the sphere", settings: SAMPLES, usual: 64.0 },
];

/// A point of a picture: the hidden part of its sky by the method, and by rays.
#[derive(Clone, Copy, Debug)]
pub struct Occluded {
    pub measured: f64,
    pub expected: f64,
    /// It is on the table, or on the room's floor.
    pub is_plane: bool,
    /// It is within two pixels of another surface in the picture.
    pub is_edge: bool,
}

/// The errors of points: all, those within two pixels of another surface, and the others.
#[derive(Clone, Copy, Debug)]
pub struct ByEdge {
    pub all: Errors,
    pub edges: Errors,
    pub inside: Errors,
}

impl ByEdge {
    pub fn of(found: &[Occluded]) -> ByEdge {
        let errors = |wanted: &dyn Fn(&Occluded) -> bool| {
            Errors::of(found.iter().filter(|o| wanted(o)).map(|o| (o.measured, o.expected)))
        };
        ByEdge { all: errors(&|_| true), edges: errors(&|o| o.is_edge), inside: errors(&|o| !o.is_edge) }
    }

    /// Returns the share of the points at edges.
    pub fn edge_share(&self) -> f64 {
        self.edges.count as f64 / self.all.count.max(1) as f64
    }
}

/// Returns the pixel itself and eight around it, two pixels away, inside the canvas.
fn around((x, y): (u32, u32), (width, height): (u32, u32)) -> impl Iterator<Item = (u32, u32)> {
    (0..9u32).map(move |i| {
        let [column, row] = [x + i % 3 * 2, y + i / 3 * 2].map(|n| n.saturating_sub(2));
        (column.min(width - 1), row.min(height - 1))
    })
}

/// Returns the maximum that a method hides where nothing is hidden, on the scene's plane.
pub fn open_most(found: &[Occluded]) -> f64 {
    found.iter().filter(|o| o.is_plane && o.expected == 0.0).map(|o| o.measured).fold(0.0, f64::max)
}

fn spots((width, height): (u32, u32)) -> Vec<(u32, u32)> {
    let step = ((f64::from(width) * f64::from(height) / POINTS).sqrt() as u32).max(1) | 1;
    let along = move |n: u32| (step / 2..n).step_by(step as usize);
    along(height).flat_map(|y| along(width).map(move |x| (x, y))).collect()
}

/// Compares in the still life. Points are found by rays from the camera; only the edges are read from the G-buffer,
/// whose pixel there may belong to the other side.
fn on_the_table(rig: &Rig, setup: &Setup) -> Result<Vec<Occluded>, LabError> {
    let size = setup.size();
    let mut running = rig.open(setup)?;
    running.frames(1)?;
    let (surfaces, measured) = (running.read("a")?, running.read("c")?);
    let view = View::new(size.0, size.1);
    let material = |x: u32, y: u32| texel(&surfaces, x, y)[3] as u32;
    let found = on_all_cores(&spots(size), |&(x, y)| {
        let is_edge = around((x, y), size).any(|(column, row)| material(column, row) != material(x, y));
        let ray = view.ray([f64::from(x) + 0.5, f64::from(y) + 0.5]);
        let at = add(view.eye, ray, first(view.eye, ray, FAR)?);
        let normal = normal(at);
        let falloff = |d: f64| ((TABLE_RADIUS - d) / (0.4 * TABLE_RADIUS)).clamp(0.0, 1.0);
        let hit = |from, ray| first(from, ray, TABLE_RADIUS);
        let expected = hidden(add(at, normal, 1e-4), normal, SIDE, hit, falloff);
        Some(Occluded { measured: texel(&measured, x, y)[0], expected, is_plane: is_table(at), is_edge })
    });
    Ok(found.into_iter().flatten().collect())
}

/// Compares with the meshes in a room. Points and their smooth normals are those of the geometry pass.
fn in_the_room(rig: &Rig, setup: &Setup) -> Result<Vec<Occluded>, LabError> {
    let lacks = || LabError::Setup { method: setup.folder().into(), what: "meshes that are its own".into() };
    let mut running = rig.open(setup)?;
    running.frames(1)?;
    let (world, normals) = (running.read_target("geometry", 1)?, running.read_target("geometry", 2)?);
    let open = running.read("blur")?;
    let (project, _) = setup.project()?;
    let pass = project.pass(&crate::setup::pass("geometry"));
    let geometry = pass.and_then(|p| p.body.geometry()).ok_or_else(lacks)?;
    let meshes = Meshes::of(&geometry.draws).map_err(|_| lacks())?;
    let falloff = |d: f64| room_falloff(ROOM_RADIUS, d);
    let found = on_all_cores(&spots(setup.size()), |&(x, y)| {
        let [place, normal] = [&world, &normals].map(|field| texel(field, x, y));
        if place[3] == 0.0 {
            return None;
        }
        let [at, normal] = [place, normal].map(|t| [t[0], t[1], t[2]]);
        // Meshes have facets.
        let from = add(at, normal, 2.5e-3);
        let hit = |from, ray| meshes.hit(from, ray, ROOM_RADIUS);
        let expected = hidden(from, unit(normal), SIDE, hit, falloff);
        let is_plane = at[1].abs() < 2e-3 && normal[1] > 0.99;
        let is_edge = around((x, y), setup.size()).any(|(column, row)| {
            let [other, bent] = [&world, &normals].map(|field| texel(field, column, row));
            let off = [0, 1, 2].map(|i| other[i] - at[i]);
            other[3] == 0.0 || dot(off, normal).abs() > STEP || dot([bent[0], bent[1], bent[2]], normal) < BENT
        });
        Some(Occluded { measured: 1.0 - texel(&open, x, y)[0], expected, is_plane, is_edge })
    });
    Ok(found.into_iter().flatten().collect())
}

/// Returns the result of a method in its own scene.
pub fn occlusion(rig: &Rig, method: &str, samples: f64, size: (u32, u32)) -> Result<Vec<Occluded>, LabError> {
    let setup = setup(method, samples, size);
    if is_sliced(method) { on_the_table(rig, &setup) } else { in_the_room(rig, &setup) }
}

pub static STUDY: Study = Study {
    name: "ao",
    title: "Ambient occlusion",
    text: "Some 900 points of each preset's scene, the still life on its table and the meshes in their room, \
           against 1,024 stratified rays a point, weighted by the cosine, of the preset's radius and falloff, \
           in f64. The error is the root mean square of the hidden part of the sky, of which 1 is all, over all \
           points. The table also gives it for the points within two pixels of another surface and for the \
           others, and how many of the points are at such edges; the mean of the error, the points that are hidden by .1 too much (a halo), and the most \
           where nothing hides; and, each in scenes of its own, the largest errors beside a wall and below a \
           sphere. Of the slices, with a radius of 4, these are from (1 - cos t) / 2 and R² h / (r² + \
           h²)^(3/2); of the samples, with the preset's radius, from the mean of a disc's segments over their \
           lengths and from the sphere itself by rays. Hard cases: at most .05 from the rays; an \
           open plane less than .01; a halo on at most 1 % of the points. Costs are those of the whole preset, \
           every pass drawn. GTAO is the preset with the highest horizon of each side of a slice in place of its \
           sectors (Jimenez, Wu, Pesce and Jarabo 2016; XeGTAO 2021), at the same samples.",
    parameter: "samples",
    unit: Unit::Frame,
    error: "of the hidden part of the sky, of which 1 is all",
    methods: METHODS,
    grids: three_of([80, 160, 320, 640]),
    // The radius scales with the scene on every grid, and so do the errors.
    has_order: false,
    ..Study::of(|point| setup(&point.method, point.setting, (point.grid, point.grid)), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let found = occlusion(rig, &point.method, point.setting, (point.grid, point.grid))?;
    let by_edge = ByEdge::of(&found);
    let off = by_edge.all;
    let size = found.iter().map(|o| (o.measured - o.expected).abs()).sum::<f64>() / found.len() as f64;
    let halo = found.iter().filter(|o| o.measured - o.expected > 0.1).count() as f64 / found.len() as f64;
    let open = open_most(&found);
    let norms = Norms { l1: size, l2: off.rms, linf: off.most };
    let measured = Measured { norms, frames_per_unit: 1.0, ..Measured::default() }
        .value("edge_rms", by_edge.edges.rms)
        .value("inside_rms", by_edge.inside.rms)
        .value("edge_share", by_edge.edge_share())
        .value("bias", off.mean)
        .value("halo_share", halo)
        .value("open_most", open)
        .hard(HardCase::at_most("rays", off.rms, 0.05))
        .hard(HardCase::at_most("an open plane", open, 0.01))
        .hard(HardCase::at_most("points in a halo", halo, 0.01));
    let closed = match point.method.as_str() {
        method if is_sliced(method) => closed(rig, method, point.setting, point.grid)?,
        method => closed_of_meshes(rig, method, point.setting, point.grid)?,
    };
    let measured = measured.value("wall_error", closed.wall).value("sphere_error", closed.sphere);
    Ok(measured.hard(HardCase::at_most("an endless plane", closed.open, 0.01)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::ao_setup::slices;

    #[test]
    fn samples_are_slices_times_steps_on_both_sides() {
        for samples in METHODS[0].settings {
            let (slices, steps) = slices(*samples);
            assert_eq!(2.0 * slices * steps, *samples);
        }
    }
}
