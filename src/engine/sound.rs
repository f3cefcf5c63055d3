//! Sound passes: a block of samples is drawn as a picture, one sample per texel, and read back.
//!
//! Blocks, times and the 16 bits of a sample are Shadertoy's (`shadertoy.md`, section 8). The shader's entry point
//! writes the four bytes of a sample as Shadertoy's does (`glsl/lower/entry.rs`), into a target of the same format, so
//! that the rounding is the same. A block is drawn in bands of rows, so that a device that also draws pictures is not
//! blocked for long.

use super::{
    Engine, EngineError, FrameInputs, Program,
    custom_uniforms::block,
    frame::{Caller, Rows},
    program::{BoundChannel, CompiledDraw, DrawBody},
};
use eddy_audio::SAMPLE_RATE;
use eddy_glsl::interface::UniformBlock;
use eddy_graph::Purpose;
use eddy_project::{CustomUniformValues, PassName};
use std::sync::Arc;

/// The samples of a block: 512x512 texels.
pub const BLOCK_FRAMES: u32 = 512 * 512;

/// The duration of a block in seconds.
pub const BLOCK_SECS: f64 = BLOCK_FRAMES as f64 / SAMPLE_RATE as f64;

/// The samples of a whole sound pass: 180 s, after which it is silent.
pub const SOUND_FRAMES: u32 = 180 * SAMPLE_RATE;

/// The blocks of a whole sound pass. The last one extends beyond its end.
pub const SOUND_BLOCKS: u32 = SOUND_FRAMES.div_ceil(BLOCK_FRAMES);

impl Engine {
    /// Draws block `number` of the sound pass of a program that was built with
    /// [`BuildOptions::sound`](super::BuildOptions::sound), and waits for it: [`BLOCK_FRAMES`] samples, left and right.
    /// `date` is `iDate`, whose seconds are whole there. Before each band, `rows` returns how many of the 512 rows to
    /// draw next; `None` abandons the block.
    pub fn draw_sound(
        &mut self,
        number: u32,
        date: [f32; 4],
        rows: &mut Rows<'_>,
    ) -> Result<Option<Vec<[i16; 2]>>, EngineError> {
        let none = || EngineError::NoSuchPass(PassName::sound().title());
        let running = self.running.as_mut().ok_or_else(none)?;
        let [year, month, day, seconds] = date;
        let inputs = FrameInputs {
            frame: number as i32,
            time_secs: f64::from(number) * f64::from(BLOCK_FRAMES) / f64::from(SAMPLE_RATE),
            date: [year, month, day, seconds.floor()],
            ..FrameInputs::at_fixed_step(0, 60.0)
        };
        let mut caller = Caller { rows, watch: None, capture: None };
        let (_, is_whole) = running.draw(&self.shared, None, &inputs, Purpose::Sound, &mut caller)?;
        if !is_whole {
            running.drop_unfinished();
            return Ok(None);
        }
        self.shared.gpu.take_error("a block of sound")?;
        let bytes = self.readback.rgba8(&self.shared.gpu, running.target(&PassName::sound(), 0)?.newest())?;
        Ok(Some(bytes.chunks_exact(4).map(|texel| [sample(texel[0], texel[1]), sample(texel[2], texel[3])]).collect()))
    }
}

impl Engine {
    /// Sets the author's own uniforms for later blocks, and returns the values that the sound pass reads: equal values
    /// yield equal blocks.
    pub fn set_sound_values(&mut self, values: &CustomUniformValues) -> Vec<[u32; 4]> {
        self.set_custom_uniforms(values);
        let Some(program) = self.program() else { return Vec::new() };
        let slots = block(&program.custom_uniforms, values);
        program.draws.iter().flat_map(|draw| read_of(draw, &slots)).collect()
    }
}

/// The values that a draw reads, out of all slots.
fn read_of(draw: &CompiledDraw, slots: &[[u32; 4]]) -> Vec<[u32; 4]> {
    draw.custom_uniforms.iter().filter_map(|slot| slots.get(usize::from(*slot)).copied()).collect()
}

/// Sets the uniforms of sound passes: block `iFrame` starts at `iTime`.
pub(super) fn set_offsets(uniforms: &mut UniformBlock, inputs: &FrameInputs) {
    uniforms.time_offset = inputs.time_secs as f32;
    uniforms.sample_offset = inputs.frame.wrapping_mul(BLOCK_FRAMES as i32);
}

/// Converts the two bytes of a texel to a sample, as Shadertoy writes it to a WAV file. 65,535 would be 32,768, one
/// more than 16 bits can represent.
fn sample(low: u8, high: u8) -> i16 {
    let value = i32::from(low) + 256 * i32::from(high) - 32_767;
    value.min(i32::from(i16::MAX)) as i16
}

impl Program {
    /// Returns whether two programs of sound passes generate the same samples: the same code reads the same textures
    /// and the same values of uniforms. Equal code is identified by the pipelines of one [`Builder`](super::Builder).
    pub fn makes_same_sound(&self, other: &Program) -> bool {
        let is_same = |(a, b): (&CompiledDraw, &CompiledDraw)| {
            let is_same_code =
                matches!((&a.body, &b.body), (DrawBody::Screen(a), DrawBody::Screen(b)) if Arc::ptr_eq(a, b));
            let mut channels = a.channels.iter().zip(&b.channels);
            is_same_code
                && channels.all(|(a, b)| self.texels(a) == other.texels(b))
                && self.values_read(a) == other.values_read(b)
        };
        let reads = |program: &Program| program.plan.draws.iter().map(|draw| draw.reads.clone()).collect::<Vec<_>>();
        self.draws.len() == other.draws.len()
            && reads(self) == reads(other)
            && self.draws.iter().zip(&other.draws).all(is_same)
    }

    /// All properties of a channel: how it is read, and its texels by address.
    fn texels(&self, channel: &BoundChannel) -> impl PartialEq + use<> {
        let external = channel.external.as_ref().map(|bound| &self.externals[bound.index]);
        let texels = external.map(|external| (external.key.clone(), external.texels().map(Arc::as_ptr)));
        (channel.dimension, channel.texture, channel.sampler, channel.filter_mode, channel.resolution, texels)
    }

    /// The values of the author's own uniforms that a draw reads.
    fn values_read(&self, draw: &CompiledDraw) -> Vec<[u32; 4]> {
        read_of(draw, &block(&self.custom_uniforms, &self.custom_uniform_values))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_converted_to_samples_as_on_shadertoy() {
        assert_eq!(SOUND_BLOCKS, 31);
        // 32,768 of 65,536 is 0, and is played as 2 * 32,768 / 65,535 - 1.
        assert_eq!([sample(0, 0), sample(0xff, 0x7f), sample(0, 0x80), sample(0xff, 0xff)], [-32_767, 0, 1, 32_767]);
        // 1 is 65,536: the high byte, 256, is stored as 255, the low one is 0.
        assert_eq!(sample(0, 0xff), 32_513);
    }
}
