//! `textureGather`: one component of the four texels that a filtered read mixes.

use super::{
    number::{Cell, Float},
    state::{Frame, State},
    world::Lod,
};
use crate::{ir::Value, types::SamplerDim};

impl<R: Float> State<'_, R> {
    /// Reads one component of four texels: filtered reads at their centres.
    pub(super) fn gather(
        &self,
        frame: &Frame<R>,
        (channel, component, coordinate, offset): (u8, u8, Value, Option<Value>),
        lane: usize,
        out: &mut Vec<Cell<R>>,
    ) {
        let mut texels = [0; 3];
        let offset = offset.map_or(&[][..], |offset| self.value(frame, offset, lane));
        texels.iter_mut().zip(offset).for_each(|(n, cell)| *n = cell.bits() as i32);
        let mut at = [0.0; 3];
        let cells = self.value(frame, coordinate, lane);
        at.iter_mut().zip(cells).for_each(|(at, cell)| *at = cell.float().to_f64());
        let size = self.world.size(channel, 0).map(|n| f64::from(n.max(1)));
        let is_cube = self.module.textures.get(usize::from(channel)).is_some_and(|t| t.dim == SamplerDim::Cube);
        let face = is_cube.then(|| Face::of(at));
        let [s, t, layer] = face.map_or(at, |face| face.coordinates(at));
        let corner = [s * size[0] - 0.5, t * size[1] - 0.5].map(f64::floor);
        // From the upper left, clockwise.
        for (right, up) in [(0.0, 1.0), (1.0, 1.0), (1.0, 0.0), (0.0, 0.0)] {
            let centre = [(corner[0] + right + 0.5) / size[0], (corner[1] + up + 0.5) / size[1]];
            let at = face.map_or([centre[0], centre[1], layer], |face| face.direction(centre));
            let texel = self.world.sample(channel, at, Lod::Exact(0.0), texels);
            out.push(Cell::Float(R::from_f64(texel[usize::from(component)])));
        }
    }
}

/// A face of a cube map (table 8.19 of the OpenGL 4.6 specification).
#[derive(Clone, Copy)]
struct Face {
    /// The axes of the face's coordinates and the one across it, with their signs.
    axes: [(usize, f64); 3],
}

impl Face {
    /// Returns the face that a direction meets.
    fn of(direction: [f64; 3]) -> Self {
        let [x, y, z] = direction.map(f64::abs);
        let across = if x >= y && x >= z {
            0
        } else if y >= z {
            1
        } else {
            2
        };
        let sign = 1f64.copysign(direction[across]);
        let axes = match across {
            0 => [(2, -sign), (1, -1.0), (0, sign)],
            1 => [(0, 1.0), (2, sign), (1, sign)],
            _ => [(0, sign), (1, -1.0), (2, sign)],
        };
        Self { axes }
    }

    /// Returns the coordinates from 0 to 1 on the face, and 0.
    fn coordinates(self, direction: [f64; 3]) -> [f64; 3] {
        let [s, t, across] = self.axes.map(|(axis, sign)| direction[axis] * sign);
        [(s / across + 1.0) / 2.0, (t / across + 1.0) / 2.0, 0.0]
    }

    /// Returns the direction of a place on the face.
    fn direction(self, place: [f64; 2]) -> [f64; 3] {
        let mut direction = [0.0; 3];
        let parts = [place[0] * 2.0 - 1.0, place[1] * 2.0 - 1.0, 1.0];
        for ((axis, sign), part) in self.axes.into_iter().zip(parts) {
            direction[axis] = sign * part;
        }
        direction
    }
}
