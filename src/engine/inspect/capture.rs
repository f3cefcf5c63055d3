//! Reads back the inputs of a draw before it runs.

use super::{LevelBy, MeshInputs, PassInputs, TextureCopy, texture::Level};
use crate::{
    EngineError, external::External, mesh_instance::MeshInstance, program::CompiledDraw, running::Running,
    shared::Shared,
};
use eddy_glsl::MAX_CHANNELS;
use eddy_gpu::{FloatConverter, Gpu, Readback, Texture};
use eddy_graph::{ReadTiming, TexelSource};
use eddy_media::Texels;
use eddy_project::{Filter, Wrap};
use eddy_texture::{Dimension, TextureShape};
use std::sync::Arc;

/// Captures the inputs of one pass while a frame is drawn; for a pass of several steps, those of its last.
pub(crate) struct Capture<'a> {
    converter: &'a FloatConverter,
    /// True if the pass has been drawn already.
    is_after_frame: bool,
    pub taken: Option<PassInputs>,
}

impl<'a> Capture<'a> {
    pub(crate) fn new(converter: &'a FloatConverter) -> Self {
        Self { converter, is_after_frame: false, taken: None }
    }

    /// Captures the inputs of a pass after the frame: they exist until something new is drawn.
    pub(crate) fn after_frame(converter: &'a FloatConverter) -> Self {
        Self { converter, is_after_frame: true, taken: None }
    }

    /// Reads all inputs of a draw. Previously encoded commands have been submitted.
    pub(crate) fn take(&mut self, running: &Running, shared: &Shared, index: usize) -> Result<(), EngineError> {
        let (compiled, draw) = (&running.program.draws[index], &running.program.plan.draws[index]);
        let mut channels = [const { None }; MAX_CHANNELS];
        for (channel, copy) in channels.iter_mut().enumerate() {
            *copy = Some(self.channel(running, shared, (compiled, index), channel)?);
        }
        let meshes = compiled.body.geometry().map_or_else(Vec::new, |meshes| {
            let each = meshes.programs.iter().enumerate();
            let of = |(n, (_, placed)): (usize, &(_, MeshInstance))| MeshInputs {
                mesh: placed.mesh.clone(),
                geometry: running.uniforms.mesh_block(meshes.first + n),
            };
            each.map(of).collect()
        });
        self.taken = Some(PassInputs {
            face: 0,
            uniforms: running.uniforms.uniform_block(index),
            custom_uniforms: running.uniforms.custom_uniforms().to_vec(),
            channels: channels.map(|copy| copy.unwrap_or_else(TextureCopy::black)),
            size: running.targets[draw.targets.start].size(),
            meshes,
        });
        Ok(())
    }

    fn channel(
        &self,
        running: &Running,
        shared: &Shared,
        (compiled, index): (&CompiledDraw, usize),
        channel: usize,
    ) -> Result<TextureCopy, EngineError> {
        let bound = &compiled.channels[channel];
        let read = running.program.plan.draws[index].reads[channel].as_ref();
        let texture = texture_of(running, (compiled, index), channel, self.is_after_frame)?;
        let Some(texture) = texture else { return Ok(TextureCopy::black()) };
        let (filter, wrap) = read.map_or((Filter::Nearest, Wrap::Clamp), |r| (r.sampler.filter, r.sampler.wrap));
        let dimension = texture.shape.dimension;
        let levels = match dimension {
            Dimension::D3 => {
                let external = bound.external.as_ref().map(|external| &running.program.externals[external.index]);
                external.and_then(External::texels).map_or_else(Vec::new, |texels| volume_levels(texels, texture.shape))
            }
            Dimension::D2 | Dimension::Cube => (0..texture.shape.levels)
                .map(|level| self.level(&shared.gpu, texture, level))
                .collect::<Result<_, _>>()?,
        };
        Ok(TextureCopy { dimension, levels, filter, wrap, level_by: LevelBy::Pixel })
    }

    fn level(&self, gpu: &Gpu, texture: &Texture, level: u32) -> Result<Level, EngineError> {
        let mut texels = Vec::new();
        for layer in 0..texture.shape.layers() {
            let floats = self.converter.convert_level(gpu, texture, (layer, level))?;
            texels.extend(Readback::default().rgba32float(gpu, &floats)?);
        }
        let [width, height, _] = texture.shape.level(level);
        Ok(Level { width, height, depth: texture.shape.layers(), texels })
    }
}

/// Returns the texture that a channel of a draw reads, or read if the frame has been drawn; `None` for none.
pub(crate) fn texture_of<'r>(
    running: &'r Running,
    (compiled, index): (&'r CompiledDraw, usize),
    channel: usize,
    is_after_frame: bool,
) -> Result<Option<&'r Texture>, EngineError> {
    let bound = &compiled.channels[channel];
    let read = running.program.plan.draws[index].reads[channel].as_ref();
    Ok(match read.map(|read| &read.source) {
        _ if !bound.texture => None,
        Some(TexelSource::Target { index: target, when: ReadTiming::LastFrame }) if is_after_frame => {
            Some(before(running, index, *target)?)
        }
        Some(TexelSource::Target { index, .. }) => Some(running.targets[*index].newest()),
        Some(TexelSource::External | TexelSource::Nothing) | None => {
            bound.external.as_ref().map(|external| &external.texture)
        }
    })
}

/// Returns the texture of a target that draw `reader` read, which happens before the target is drawn.
fn before(running: &Running, reader: usize, target: usize) -> Result<&Texture, EngineError> {
    let plan = &running.program.plan;
    let held = &running.targets[target];
    let Some(drawer) = plan.draws.iter().position(|draw| draw.targets.contains(&target)) else {
        return Ok(held.newest());
    };
    let run_of = |draw: usize| plan.runs.iter().position(|run| run.draws.contains(&draw));
    match running.steps_drawn.get(drawer) {
        // It was not drawn, as none of its inputs had changed.
        None | Some(0) => Ok(held.newest()),
        Some(&steps) if steps > 1 && run_of(drawer) != run_of(reader) => {
            Err(EngineError::Overwritten { reader: running.program.draws[reader].id.title(), read: held.id.title() })
        }
        Some(_) => Ok(&held.textures[held.back()]),
    }
}

/// The levels of a volume, as they were uploaded to the device.
fn volume_levels(texels: &Arc<Texels>, shape: TextureShape) -> Vec<Level> {
    let levels = std::iter::successors(Some(Texels::clone(texels)), |finer| Some(finer.halved()));
    let level = |texels: Texels| {
        let [width, height, depth] = texels.shape.level(0);
        Level { width, height, depth, texels: texels.floats() }
    };
    levels.take(shape.levels as usize).map(level).collect()
}
