//! A pass in one frame, ready to be walked at any of its pixels.

use super::{error::WalkError, origin::Origin, pixel::WalkedPixel, raster::Raster};
use crate::{
    engine::{PassInputs, Sources},
    glsl::{
        walk::{EntryInputs, Machine, Stop},
        walkable::{Detail, Walkable},
    },
};

/// The programs of a pass, and for one that draws meshes its triangles in the picture. Made once for all pixels.
pub struct WalkedPass<'p> {
    inputs: &'p PassInputs,
    body: Body<'p>,
    limit: u64,
}

enum Body<'p> {
    Screen(Box<Walkable>),
    Meshes(Raster<'p>),
}

impl<'p> WalkedPass<'p> {
    /// Lowers `project.passes[index]`; of one that draws meshes all vertices are transformed. A program is given up
    /// after `limit` statements.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn new(
        sources: &Sources<'_>,
        index: usize,
        inputs: &'p PassInputs,
        detail: Detail,
        limit: u64,
    ) -> Result<Self, WalkError> {
        let body = match sources.pass(index).settings.meshes() {
            None => Body::Screen(Box::new(sources.walkable(index, detail)?)),
            Some(geometry) => Body::Meshes(Raster::new(sources, (index, geometry), inputs, detail, limit)?),
        };
        Ok(Self { inputs, body, limit })
    }

    /// What runs for a pixel, counted from the bottom left; `None` where no triangle leaves a fragment.
    pub fn at(&self, pixel: (u32, u32)) -> Result<Option<WalkedPixel<'_>>, Stop> {
        let (walkable, inputs, origin) = match &self.body {
            Body::Screen(walkable) => (&**walkable, EntryInputs::of_pixel(pixel), Origin::Screen),
            Body::Meshes(raster) => {
                let Some(fragment) = raster.shown(pixel)? else { return Ok(None) };
                (raster.walkable(fragment.draw), raster.entry(fragment, pixel)?, Origin::Mesh(fragment))
            }
        };
        let world = self.inputs.of_draw(origin.draw());
        let lane = Machine::<f32>::lane_of(pixel);
        Ok(Some(WalkedPixel { walkable, world, inputs, origin, lane, limit: self.limit }))
    }

    /// Gives the program of what runs for a pixel away.
    pub fn into_walkable(self, origin: Origin) -> Walkable {
        match self.body {
            Body::Screen(walkable) => *walkable,
            Body::Meshes(raster) => raster.into_walkable(origin.draw().unwrap_or_default()),
        }
    }
}
