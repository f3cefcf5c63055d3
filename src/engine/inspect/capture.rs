//! Reads back what a draw is about to read.

use super::{PassInputs, TextureCopy, texture::Level};
use crate::{
    engine::{EngineError, program::CompiledDraw, running::Running, shared::Shared},
    gpu::{FloatConverter, Gpu, Readback, Texture},
    graph::{Draw, Source},
    project::{Filter, PassId, Wrap},
};

/// Takes the inputs of one pass while a frame is drawn; of a pass of several steps, those of its last.
pub(in crate::engine) struct Capture<'a> {
    pass: &'a PassId,
    converter: &'a FloatConverter,
    pub taken: Option<PassInputs>,
}

impl<'a> Capture<'a> {
    pub fn new(pass: &'a PassId, converter: &'a FloatConverter) -> Self {
        Self { pass, converter, taken: None }
    }

    pub fn wants(&self, compiled: &CompiledDraw) -> bool {
        compiled.id == *self.pass
    }

    /// Reads everything that a draw reads. What was encoded before has been handed in.
    pub fn take(&mut self, running: &Running, shared: &Shared, index: usize) -> Result<(), EngineError> {
        let (compiled, draw) = (&running.program.draws[index], &running.program.plan.draws[index]);
        let mut channels = [const { None }; 4];
        for (channel, copy) in channels.iter_mut().enumerate() {
            *copy = Some(self.channel(running, shared, (compiled, draw), channel)?);
        }
        self.taken = Some(PassInputs {
            uniforms: running.uniforms.uniform_block(index),
            custom_uniforms: running.uniforms.custom_uniforms().to_vec(),
            channels: channels.map(|copy| copy.unwrap_or_else(TextureCopy::black)),
            size: running.targets[draw.targets.start].size(),
        });
        Ok(())
    }

    fn channel(
        &self,
        running: &Running,
        shared: &Shared,
        (compiled, draw): (&CompiledDraw, &Draw),
        channel: usize,
    ) -> Result<TextureCopy, EngineError> {
        let bound = &compiled.channels[channel];
        let read = draw.reads[channel].as_ref();
        let texture = match read.map(|read| &read.source) {
            _ if !bound.texture => None,
            Some(Source::Target { index, .. }) => Some(running.targets[*index].newest()),
            Some(Source::Keyboard) => Some(&shared.keyboard.texture),
            Some(Source::Media | Source::Nothing) | None => bound.media.as_ref(),
        };
        let Some(texture) = texture else { return Ok(TextureCopy::black()) };
        let (filter, wrap) = read.map_or((Filter::Nearest, Wrap::Clamp), |r| (r.sampler.filter, r.sampler.wrap));
        let levels = (0..texture.levels()).map(|level| self.level(&shared.gpu, texture, level));
        Ok(TextureCopy { levels: levels.collect::<Result<_, _>>()?, filter, wrap })
    }

    fn level(&self, gpu: &Gpu, texture: &Texture, level: u32) -> Result<Level, EngineError> {
        let floats = self.converter.convert_level(gpu, texture, level)?;
        let texels = Readback::default().rgba32float(gpu, &floats)?;
        Ok(Level { width: floats.width(), height: floats.height(), texels })
    }
}
