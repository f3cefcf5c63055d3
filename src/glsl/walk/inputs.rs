//! Values that the device passes to an entry point, lane by lane.

use super::{
    number::{Cell, Float, Shadowed},
    state::LANES,
};

/// The components at one location, for each lane.
pub type SlotCells = [[Cell<Shadowed>; 4]; LANES];

/// The inputs of four fragments of a quad, or of four vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct EntryInputs {
    /// `gl_FragCoord`: x and y in pixels, the depth from 0 to 1, and 1 / w of clip space (section 7.2 of the GLSL ES
    /// 3.00 specification).
    pub position: [[Shadowed; 4]; LANES],
    /// `gl_FrontFacing`: the fragments belong to a front-facing triangle.
    pub is_front: bool,
    /// `gl_VertexID`.
    pub vertices: [u32; LANES],
    /// Attributes or varyings, each with its location. A component that a vector lacks is not read.
    pub slots: Vec<(u32, SlotCells)>,
}

impl EntryInputs {
    /// Returns the 2x2 block that contains a pixel of a whole picture: a triangle at depth 0 covers it.
    pub fn of_pixel(pixel: (u32, u32)) -> Self {
        Self {
            position: quad(pixel).map(|[x, y]| [x, y, 0.0, 1.0].map(Shadowed::exact)),
            is_front: true,
            vertices: [0; LANES],
            slots: Vec::new(),
        }
    }

    /// Fills `out` with the first components at a location; zeros if the location is unused.
    pub(super) fn slot<R: Float>(&self, location: u32, lane: usize, out: &mut [Cell<R>]) {
        let Some((_, cells)) = self.slots.iter().find(|(there, _)| *there == location) else {
            return out.fill(Cell::Bits(0));
        };
        for (out, cell) in out.iter_mut().zip(cells[lane]) {
            *out = match cell {
                Cell::Float(number) => Cell::Float(R::with_shadow(number.single.into(), number.double)),
                Cell::Bits(bits) => Cell::Bits(bits),
            };
        }
    }
}

/// Returns the centres of the pixels of the 2x2 block that contains a pixel, lane by lane.
pub fn quad((x, y): (u32, u32)) -> [[f64; 2]; LANES] {
    std::array::from_fn(|lane| {
        let (dx, dy) = (lane as u32 & 1, lane as u32 >> 1);
        [f64::from((x & !1) + dx) + 0.5, f64::from((y & !1) + dy) + 0.5]
    })
}
