//! A pass in one frame, prepared for walks of any of its pixels.

use super::{
    pixel::{Fragment, Origin, PixelContent},
    raster::Raster,
    writer::Writer,
};
use eddy_diag::Diagnostic;
use eddy_engine::{PassInputs, Sources};
use eddy_glsl::{
    walk::{EntryInputs, Machine, Stop},
    walkable::{Detail, Walkable},
};
use eddy_project::PassSettings;

/// The programs of a pass and, if it draws meshes, its triangles in the picture. Built once for all pixels.
pub(crate) struct PassFragments<'p> {
    inputs: &'p PassInputs,
    body: Body<'p>,
    settings: PassSettings,
    /// The expression of the boundary, if it has one.
    boundary: Option<Box<Walkable>>,
    limit: u64,
}

enum Body<'p> {
    Screen(Box<Walkable>),
    Meshes(Raster<'p>),
}

impl<'p> PassFragments<'p> {
    /// Lowers `project.passes[index]`; for one that draws meshes all vertices are transformed. A program is stopped
    /// after `limit` statements.
    ///
    /// # Panics
    /// If there is no such pass.
    pub(crate) fn new(
        sources: &Sources<'_>,
        index: usize,
        inputs: &'p PassInputs,
        detail: Detail,
        limit: u64,
    ) -> Result<Self, WalkError> {
        let pass = sources.pass(index);
        let body = match pass.body.geometry() {
            None => Body::Screen(Box::new(sources.walkable(index, detail)?)),
            Some(geometry) => Body::Meshes(Raster::new(sources, (index, geometry), inputs, detail, limit)?),
        };
        let boundary = sources.walkable_boundary(index).transpose()?.map(Box::new);
        Ok(Self { inputs, body, settings: pass.settings.clone(), boundary, limit })
    }

    /// Returns what runs for a pixel, counted from the bottom left.
    pub(crate) fn at(&self, pixel: (u32, u32)) -> Result<PixelContent<'_>, Stop> {
        let (walkable, inputs, origin) = match Writer::of(&self.settings, self.inputs.size, pixel) {
            Writer::Boundary => match &self.boundary {
                Some(walkable) => (&**walkable, EntryInputs::of_pixel(pixel), Origin::Boundary),
                None => return Ok(PixelContent::Undrawn(Origin::Boundary)),
            },
            // A pass that draws meshes first clears everything, outside of its region too.
            Writer::Nothing(region)
                if matches!(self.body, Body::Meshes(_)) && region.within(self.inputs.size).is_some() =>
            {
                return Ok(PixelContent::Undrawn(Origin::Clear));
            }
            Writer::Nothing(region) => return Ok(PixelContent::Undrawn(Origin::Outside(region))),
            Writer::Programs => match &self.body {
                Body::Screen(walkable) => (&**walkable, EntryInputs::of_pixel(pixel), Origin::Screen),
                Body::Meshes(raster) => {
                    let Some(fragment) = raster.shown(pixel)? else { return Ok(PixelContent::Undrawn(Origin::Clear)) };
                    (raster.walkable(fragment.draw), raster.entry(fragment, pixel)?, Origin::Mesh(fragment))
                }
            },
        };
        let world = self.inputs.of_draw(origin.draw());
        let lane = Machine::<f32>::lane_of(pixel);
        Ok(PixelContent::Fragment(Fragment { walkable, world, inputs, origin, lane, limit: self.limit }))
    }

    /// Returns every program of the pass.
    pub(crate) fn programs(&self) -> impl Iterator<Item = &Walkable> {
        let (screen, meshes) = match &self.body {
            Body::Screen(walkable) => (Some(&**walkable), None),
            Body::Meshes(raster) => (None, Some(raster.programs())),
        };
        screen.into_iter().chain(meshes.into_iter().flatten()).chain(self.boundary.as_deref())
    }

    /// Returns the program that runs for a pixel, consuming the pass.
    pub(crate) fn into_walkable(self, origin: Origin) -> Walkable {
        match self.body {
            Body::Screen(walkable) => *walkable,
            Body::Meshes(raster) => raster.into_walkable(origin.draw().unwrap_or_default()),
        }
    }
}

/// A pass has errors, or one of its programs does not end.
#[derive(Clone, Debug)]
pub enum WalkError {
    Diagnostics(Vec<Diagnostic>),
    Stop(Stop),
}

impl From<Vec<Diagnostic>> for WalkError {
    fn from(diagnostics: Vec<Diagnostic>) -> Self {
        WalkError::Diagnostics(diagnostics)
    }
}

impl From<Stop> for WalkError {
    fn from(stop: Stop) -> Self {
        WalkError::Stop(stop)
    }
}
