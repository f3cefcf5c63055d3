//! Runs a vertex stage on the processor, four vertices at a time.

use eddy_engine::{DrawInputs, MeshInputs};
use eddy_glsl::{
    Attribute,
    ir::{Input, Op, Output},
    walk::{Cell, Drawn, EntryInputs, Float, LANES, Machine, NoObserver, Shadowed, SlotCells, Stop},
    walkable::Walkable,
};
use eddy_media::mesh::Vertex;
use std::thread;

/// The minimum number of vertices per thread.
const MIN_VERTICES_PER_THREAD: usize = 1024;

/// The vertex stage of a draw, and its inputs.
pub(super) struct VertexStage<'p> {
    walkable: &'p Walkable,
    world: DrawInputs<'p>,
    mesh: &'p MeshInputs,
    /// The attributes that the stage reads.
    attributes: Vec<Attribute>,
    limit: u64,
}

impl<'p> VertexStage<'p> {
    /// Returns a stage that stops a vertex after `limit` statements.
    pub(super) fn new(walkable: &'p Walkable, world: DrawInputs<'p>, mesh: &'p MeshInputs, limit: u64) -> Self {
        let reads = |attribute: &Attribute| {
            let mut entry = walkable.program.functions.iter().flat_map(|function| function.values());
            entry.any(|(_, op)| {
                matches!(op, Op::Input(Input::Attribute { location, .. }) if *location == attribute.location())
            })
        };
        let attributes = Attribute::ALL.into_iter().filter(reads).collect();
        Self { walkable, world, mesh, attributes, limit }
    }

    /// Returns the clip-space positions of all vertices of the mesh, computed on all processors.
    pub(super) fn positions(&self) -> Result<Vec<[f32; 4]>, Stop> {
        let count = self.mesh.mesh.vertices.len();
        let threads =
            thread::available_parallelism().map_or(1, |n| n.get()).min(count.div_ceil(MIN_VERTICES_PER_THREAD)).max(1);
        let a_thread = count.div_ceil(threads).next_multiple_of(LANES).max(LANES);
        let parts: Result<Vec<Vec<[f32; 4]>>, Stop> = thread::scope(|scope| {
            let starts = (0..count).step_by(a_thread);
            let spawned = starts.map(|first| scope.spawn(move || self.part(first..count.min(first + a_thread))));
            let spawned: Vec<_> = spawned.collect();
            spawned.into_iter().map(|t| t.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
        });
        Ok(parts?.concat())
    }

    fn part(&self, range: std::ops::Range<usize>) -> Result<Vec<[f32; 4]>, Stop> {
        let mut positions = Vec::with_capacity(range.len());
        let mut machine = self.machine::<f32>();
        for first in range.clone().step_by(LANES) {
            let count = LANES.min(range.end - first);
            machine.set_inputs(self.inputs(std::array::from_fn(|lane| (first + lane.min(count - 1)) as u32)));
            let drawn = machine.run(0, &mut NoObserver)?;
            positions.extend((0..count).map(|lane| position(&drawn, lane).map(Float::to_f32)));
        }
        Ok(positions)
    }

    /// Returns the corners of a triangle of the mesh, in both precisions.
    pub(super) fn corners(&self, triangle: usize) -> Result<[Corner; 3], Stop> {
        let [a, b, c] = self::triangle(self.mesh, triangle);
        let mut machine = self.machine::<Shadowed>();
        machine.set_inputs(self.inputs([a, b, c, c]));
        let drawn = machine.run(0, &mut NoObserver)?;
        Ok(std::array::from_fn(|lane| Corner {
            position: position(&drawn, lane),
            varyings: drawn
                .outputs
                .iter()
                .filter_map(|(output, cells)| match *output {
                    Output::Varying { location, flat } => {
                        Some(CornerVarying { location, is_flat: flat, cells: cells[lane].clone() })
                    }
                    _ => None,
                })
                .collect(),
        }))
    }

    fn machine<R: Float>(&self) -> Machine<'_, R> {
        Machine::new(&self.walkable.program, &self.world, self.inputs([0; LANES]), self.limit)
    }

    fn inputs(&self, vertices: [u32; LANES]) -> EntryInputs {
        let slots = self.attributes.iter().map(|attribute| {
            let cells: SlotCells =
                vertices.map(|vertex| components(&self.mesh.mesh.vertices[vertex as usize], *attribute));
            (attribute.location(), cells)
        });
        EntryInputs { slots: slots.collect(), vertices, ..EntryInputs::of_pixel((0, 0)) }
    }
}

/// Returns the vertices of a triangle of a mesh; the first is the provoking one.
pub(super) fn triangle(mesh: &MeshInputs, triangle: usize) -> [u32; 3] {
    std::array::from_fn(|corner| mesh.mesh.indices[3 * triangle + corner])
}

fn components(vertex: &Vertex, attribute: Attribute) -> [Cell<Shadowed>; 4] {
    let numbers = match attribute {
        Attribute::Position => &vertex.position[..],
        Attribute::Normal => &vertex.normal,
        Attribute::Tangent => &vertex.tangent,
        Attribute::Uv => &vertex.uv,
        Attribute::Color => &vertex.color,
    };
    let number = |at: usize| numbers.get(at).copied().unwrap_or_default();
    std::array::from_fn(|at| Cell::Float(Shadowed::exact(number(at).into())))
}

fn position<R: Float>(drawn: &Drawn<R>, lane: usize) -> [R; 4] {
    let cells = drawn.output(Output::Position, lane);
    std::array::from_fn(|i| cells.map_or(R::from_f64(f64::NAN), |cells| cells[i].float()))
}

/// The outputs of a vertex stage for one vertex, in both precisions.
#[derive(Clone, Debug)]
pub(super) struct Corner {
    /// In the clip space of a device: y = w is row 0, and depth goes from 0 to w.
    pub position: [Shadowed; 4],
    /// By their locations.
    pub varyings: Vec<CornerVarying>,
}

/// The output of a vertex at one location.
#[derive(Clone, Debug)]
pub(super) struct CornerVarying {
    pub location: u32,
    pub is_flat: bool,
    /// One to four components.
    pub cells: Vec<Cell<Shadowed>>,
}
