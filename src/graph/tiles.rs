//! Drawing a pass in tiles, into a target that is smaller than its picture: whether that is possible, and the reasons
//! why it is not.

use super::{Draw, FramePlan, TexelSource};
use eddy_project::{PassSize, Project};
use eddy_texture::Dimension;
use std::fmt;

/// The draw of a plan that is executed tile by tile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TiledDraw {
    /// Index into [`FramePlan::draws`].
    pub draw: usize,
    /// The size of the whole picture. Its target has the size of a tile.
    pub size: PassSize,
}

/// The reason why a pass cannot be drawn in tiles. Its text includes the fix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TilingError {
    /// It draws meshes.
    Meshes,
    /// It draws a cube.
    Cube,
    /// It has several targets.
    Targets,
    /// The pass with this title reads it.
    Read(String),
    /// It reads its own last frame.
    Itself,
    /// It discards pixels.
    Discards,
    /// It draws only a region.
    Region,
    /// It leaves the boundary unchanged.
    Boundary,
    /// It starts from initial texels.
    Initial,
    /// It is drawn under a condition.
    Condition,
    /// It is drawn several times a frame.
    Steps,
}

impl fmt::Display for TilingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            TilingError::Meshes => "it draws meshes, which are rasterized over the whole picture; choose a smaller resolution",
            TilingError::Cube => "the faces of a cubemap have one size; leave --tile out",
            TilingError::Targets => "it has several targets; choose a smaller resolution",
            TilingError::Read(reader) => {
                return write!(
                    f,
                    "{reader} reads all of its picture; give it a fixed size in eddy.toml, or choose a smaller resolution"
                );
            }
            TilingError::Itself => {
                "it reads its own last picture; give it a fixed size in eddy.toml, or choose a smaller resolution"
            }
            TilingError::Discards => {
                "it discards pixels, which then show what they showed before; give these pixels a colour instead, or \
                 choose a smaller resolution"
            }
            TilingError::Region => "only a region of it is drawn; remove the region in eddy.toml",
            TilingError::Boundary => "it has a boundary; remove the boundary in eddy.toml",
            TilingError::Initial => "it has initial texels; remove them in eddy.toml",
            TilingError::Condition => "it is drawn under a condition; remove `when` in eddy.toml",
            TilingError::Steps => "it is drawn in several steps a frame; choose a smaller resolution",
        })
    }
}

impl FramePlan {
    /// Shrinks the target of a pass to the size of a tile, and leaves the draw to the caller, tile by tile. The picture
    /// is the same as in one piece: every texel depends on its position and on other passes, not on the previous
    /// content, and no pass reads it. On an error nothing is changed.
    ///
    /// # Panics
    /// If no draw is of this pass.
    pub fn tile(&mut self, project: &Project, pass: usize, tile: (u32, u32)) -> Result<(), TilingError> {
        let index = self.draws.iter().position(|draw| draw.pass == pass).expect("the pass is drawn");
        let draw = &self.draws[index];
        if !project.passes[pass].body.is_screen() {
            return Err(TilingError::Meshes);
        }
        if draw.targets.len() != 1 || draw.extra_target.is_some() {
            return Err(TilingError::Targets);
        }
        let place = draw.targets.start;
        if self.targets[place].dimension != Dimension::D2 {
            return Err(TilingError::Cube);
        }
        let reads = |draw: &&Draw| {
            draw.reads.iter().flatten().any(|r| matches!(r.source, TexelSource::Target { index, .. } if index == place))
        };
        if let Some(reader) = self.draws.iter().find(reads) {
            let title = project.passes[reader.pass].id.title();
            return Err(if reader.pass == pass { TilingError::Itself } else { TilingError::Read(title) });
        }
        if draw.region.is_some() {
            return Err(TilingError::Region);
        }
        if draw.keeps_content {
            return Err(TilingError::Discards);
        }
        if draw.boundary.is_some() {
            return Err(TilingError::Boundary);
        }
        if draw.has_initial {
            return Err(TilingError::Initial);
        }
        if draw.when.is_some() {
            return Err(TilingError::Condition);
        }
        if self.steps_of(index) != 1 {
            return Err(TilingError::Steps);
        }
        let target = &mut self.targets[place];
        self.tiled = Some(TiledDraw { draw: index, size: target.size });
        target.size = PassSize::Fixed(tile.0, tile.1);
        target.mips = false;
        Ok(())
    }
}
