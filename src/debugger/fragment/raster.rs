//! The triangles of a pass that draws meshes, with its depth buffer and targets.

use super::{
    clip::clipped,
    coverage::{Coverage, subpixel},
    pass::WalkError,
    pixel::MeshFragment,
    vertices::{Corner, VertexStage, triangle},
    weights::{self, Weights},
};
use eddy_engine::{PassInputs, Sources};
use eddy_glsl::{
    ir::{Module, Output, Stmt},
    walk::{Cell, EntryInputs, LANES, Machine, NoObserver, Shadowed, SlotCells, Stop, quad},
    walkable::{Detail, Walkable},
};
use eddy_project::{Cull, DepthTest, Geometry, Stage};

/// The depth of every texel before the first draw: the far plane.
const FAR: f32 = 1.0;

/// A piece of a triangle inside the view volume.
struct Piece {
    coverage: Coverage,
    triangle: usize,
}

/// A draw with transformed vertices.
struct Assembled {
    /// Indices of its vertex stage and fragment stage.
    vertices: usize,
    fragments: usize,
    depth: DepthTest,
    depth_write: bool,
    color_write: bool,
    positions: Vec<[f32; 4]>,
    /// In drawing order; culled ones are left out.
    pieces: Vec<Piece>,
}

/// A fragment stage, for the vertex stage before it.
struct FragmentStage {
    stages: (Stage, Stage),
    walkable: Walkable,
    facts: FragmentFacts,
}

/// The draws of a pass in one frame.
pub(super) struct Raster<'p> {
    inputs: &'p PassInputs,
    vertices: Vec<(Stage, Walkable)>,
    fragments: Vec<FragmentStage>,
    draws: Vec<Assembled>,
    limit: u64,
}

impl<'p> Raster<'p> {
    /// Lowers the stages of `project.passes[index]` and transforms all vertices. A program is stopped after `limit`
    /// statements.
    pub(super) fn new(
        sources: &Sources<'_>,
        (index, geometry): (usize, &Geometry),
        inputs: &'p PassInputs,
        detail: Detail,
        limit: u64,
    ) -> Result<Self, WalkError> {
        let mut raster = Self { inputs, vertices: Vec::new(), fragments: Vec::new(), draws: Vec::new(), limit };
        for (number, draw) in geometry.draws.iter().enumerate().take(inputs.meshes.len()) {
            let known = raster.vertices.iter().position(|(stage, _)| *stage == draw.vertex);
            if known.is_none() {
                raster.vertices.push((draw.vertex, sources.walkable_vertices(index, draw.vertex)?));
            }
            let vertices = known.unwrap_or(raster.vertices.len() - 1);
            let stages = (draw.vertex, draw.fragment);
            let known = raster.fragments.iter().position(|known| known.stages == stages);
            if known.is_none() {
                let varyings = &raster.vertices[vertices].1.varyings;
                let walkable = sources.walkable_fragments(index, (draw.fragment, varyings), detail)?;
                let facts = FragmentFacts::of(&walkable.program);
                raster.fragments.push(FragmentStage { stages, walkable, facts });
            }
            let mut assembled = Assembled {
                vertices,
                fragments: known.unwrap_or(raster.fragments.len() - 1),
                depth: draw.depth,
                depth_write: draw.depth_write,
                color_write: draw.color_write,
                positions: Vec::new(),
                pieces: Vec::new(),
            };
            let stage = raster.stage(number, vertices);
            assembled.positions = stage.positions()?;
            let mesh = &inputs.meshes[number];
            for number in 0..mesh.mesh.indices.len() / 3 {
                let polygon = clipped(triangle(mesh, number).map(|vertex| assembled.positions[vertex as usize]));
                let places: Vec<_> =
                    polygon.iter().map(|corner| subpixel(corner.map(|x| x as f32), inputs.size)).collect();
                let fan = places.windows(2).skip(1).filter_map(|two| Coverage::new([places[0], two[0], two[1]]));
                let seen = fan.filter(|coverage| is_drawn(draw.cull, coverage.is_front));
                assembled.pieces.extend(seen.map(|coverage| Piece { coverage, triangle: number }));
            }
            raster.draws.push(assembled);
        }
        Ok(raster)
    }

    /// Returns every stage of the draws.
    pub(super) fn programs(&self) -> impl Iterator<Item = &Walkable> {
        let vertices = self.vertices.iter().map(|(_, walkable)| walkable);
        vertices.chain(self.fragments.iter().map(|stage| &stage.walkable))
    }

    /// Returns the fragment whose colour is in the first target's texel; `None` if there is none.
    pub(super) fn shown(&self, pixel: (u32, u32)) -> Result<Option<MeshFragment>, Stop> {
        let lane = Machine::<f32>::lane_of(pixel);
        let (mut held, mut shown) = (FAR, None);
        for (number, draw) in self.draws.iter().enumerate() {
            let stage = &self.fragments[draw.fragments];
            for piece in draw.pieces.iter().filter(|piece| piece.coverage.covers(pixel)) {
                let fragment =
                    MeshFragment { draw: number, triangle: piece.triangle, is_front: piece.coverage.is_front };
                let mut depth = self.depth(fragment, quad(pixel)[lane]);
                if !stage.facts.sets_depth && !passes(draw.depth, depth, held) {
                    continue;
                }
                if stage.facts.may_discard || stage.facts.sets_depth {
                    let (inputs, world) = (self.entry(fragment, pixel)?, self.inputs.of_draw(Some(number)));
                    let mut machine = Machine::<f32>::new(&stage.walkable.program, &world, inputs, self.limit);
                    let drawn = machine.run(lane, &mut NoObserver)?;
                    if drawn.discarded[lane] {
                        continue;
                    }
                    if let Some(set) = drawn.output(Output::Depth, lane) {
                        depth = set[0].float().clamp(0.0, FAR);
                    }
                    if !passes(draw.depth, depth, held) {
                        continue;
                    }
                }
                if draw.depth_write {
                    held = depth;
                }
                if draw.color_write && stage.facts.colours_first {
                    shown = Some(fragment);
                }
            }
        }
        Ok(shown)
    }

    /// Returns the inputs of the quad of a pixel that shows a fragment. Its other pixels may be outside the triangle;
    /// their inputs are extrapolated on its plane.
    pub(super) fn entry(&self, fragment: MeshFragment, pixel: (u32, u32)) -> Result<EntryInputs, Stop> {
        let draw = &self.draws[fragment.draw];
        let corners = self.stage(fragment.draw, draw.vertices).corners(fragment.triangle)?;
        let singles = corners.each_ref().map(|corner| corner.position.map(|number| number.single.into()));
        let doubles = corners.each_ref().map(|corner| corner.position.map(|number| number.double));
        let weights = [singles, doubles].map(|positions| {
            let weights = Weights::new(positions, self.inputs.size);
            quad(pixel).map(|place| weights.at(place))
        });
        let [single, double] = &weights;
        let position = std::array::from_fn(|lane| {
            let [x, y] = quad(pixel)[lane].map(Shadowed::exact);
            let (near, exact) = (weights::depth(single[lane], singles), weights::depth(double[lane], doubles));
            let both = |i: usize| Shadowed { single: near[i] as f32, double: exact[i] };
            [x, y, both(0), both(1)]
        });
        let slots = (0..corners[0].varyings.len()).map(|n| {
            let cells: SlotCells = std::array::from_fn(|lane| varying(&corners, n, [single[lane], double[lane]]));
            (corners[0].varyings[n].location, cells)
        });
        Ok(EntryInputs { position, is_front: fragment.is_front, vertices: [0; LANES], slots: slots.collect() })
    }

    /// Returns the fragment stage of a draw.
    pub(super) fn walkable(&self, draw: usize) -> &Walkable {
        &self.fragments[self.draws[draw].fragments].walkable
    }

    /// Returns the fragment stage of a draw, consuming the raster.
    pub(super) fn into_walkable(mut self, draw: usize) -> Walkable {
        self.fragments.swap_remove(self.draws[draw].fragments).walkable
    }

    fn stage(&self, draw: usize, vertices: usize) -> VertexStage<'_> {
        let world = self.inputs.of_draw(Some(draw));
        VertexStage::new(&self.vertices[vertices].1, world, &self.inputs.meshes[draw], self.limit)
    }

    /// Returns the depth of a fragment at a position in pixels, as stored in a depth buffer of 32-bit floats.
    fn depth(&self, fragment: MeshFragment, place: [f64; 2]) -> f32 {
        let draw = &self.draws[fragment.draw];
        let corners = triangle(&self.inputs.meshes[fragment.draw], fragment.triangle);
        let corners = corners.map(|vertex| draw.positions[vertex as usize].map(f64::from));
        let weights = Weights::new(corners, self.inputs.size).at(place);
        (weights::depth(weights, corners)[0] as f32).clamp(0.0, FAR)
    }
}

/// Returns a varying for these weights of the corners, in single and in double precision; for a flat one that of the
/// provoking vertex, which is the first (WebGPU, `@interpolate(flat, first)`).
fn varying(corners: &[Corner; 3], n: usize, [single, double]: [[f64; 3]; 2]) -> [Cell<Shadowed>; 4] {
    let of = |corner: usize| &corners[corner].varyings[n].cells;
    std::array::from_fn(|i| match of(0).get(i) {
        None => Cell::Bits(0),
        Some(&cell) if corners[0].varyings[n].is_flat => cell,
        Some(_) => {
            let numbers: [Shadowed; 3] = std::array::from_fn(|corner| of(corner)[i].float());
            Cell::Float(Shadowed {
                single: weights::mix(single, numbers.map(|number| number.single.into())) as f32,
                double: weights::mix(double, numbers.map(|number| number.double)),
            })
        }
    })
}

fn is_drawn(cull: Cull, is_front: bool) -> bool {
    match cull {
        Cull::Back => is_front,
        Cull::Front => !is_front,
        Cull::None => true,
    }
}

/// Compares a fragment's depth with the stored one: section 4.1.5 of the OpenGL ES 3.0 specification.
fn passes(test: DepthTest, depth: f32, held: f32) -> bool {
    match test {
        DepthTest::Less => depth < held,
        DepthTest::LessEqual => depth <= held,
        DepthTest::Equal => depth == held,
        DepthTest::GreaterEqual => depth >= held,
        DepthTest::Greater => depth > held,
        DepthTest::NotEqual => depth != held,
        DepthTest::Always => true,
    }
}

/// Static facts about a fragment stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct FragmentFacts {
    /// True if some path through it ends in `discard`.
    pub may_discard: bool,
    /// True if it sets `gl_FragDepth`.
    pub sets_depth: bool,
    /// True if it has a colour for the first target.
    pub colours_first: bool,
}

impl FragmentFacts {
    pub(super) fn of(program: &Module) -> Self {
        let mut facts = Self::default();
        program.functions.iter().for_each(|function| facts.add(&function.body));
        facts
    }

    fn add(&mut self, block: &[Stmt]) {
        for stmt in block {
            match stmt {
                Stmt::Discard => self.may_discard = true,
                Stmt::Output(parts) => {
                    let has = |wanted: Output| parts.iter().any(|(output, _)| *output == wanted);
                    self.sets_depth |= has(Output::Depth);
                    self.colours_first |= has(Output::Target(0));
                }
                _ => stmt.blocks(|inner| self.add(inner)),
            }
        }
    }
}
