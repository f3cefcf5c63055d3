//! The textures passes draw into, kept from frame to frame and, where it makes sense, from program to program.

use crate::{
    gpu::{Gpu, GpuError, MipChain, MipMaker, Texture, TextureDescriptor, mip_levels},
    graph::FramePlan,
    project::{PassFormat, PassId},
};

pub(super) fn texture_format(format: PassFormat) -> wgpu::TextureFormat {
    use wgpu::TextureFormat as T;
    match format {
        PassFormat::R8 => T::R8Unorm,
        PassFormat::Rg8 => T::Rg8Unorm,
        PassFormat::Rgba8 => T::Rgba8Unorm,
        PassFormat::R16f => T::R16Float,
        PassFormat::Rg16f => T::Rg16Float,
        PassFormat::Rgba16f => T::Rgba16Float,
        PassFormat::R32f => T::R32Float,
        PassFormat::Rg32f => T::Rg32Float,
        PassFormat::Rgba32f => T::Rgba32Float,
    }
}

/// One or two textures of a pass. Of two, one holds what was drawn last and is read; the next draw goes into the other, and
/// then they change places.
pub(super) struct Target {
    pub id: PassId,
    /// Which of the pass's targets.
    pub index: usize,
    pub textures: Vec<Texture>,
    /// For each texture, where the plan asks for mips.
    pub chains: Vec<MipChain>,
    /// Which texture was drawn last.
    pub front: usize,
}

impl Target {
    fn new(
        gpu: &Gpu,
        mips: &mut MipMaker,
        planned: &crate::graph::Target,
        canvas: (u32, u32),
    ) -> Result<Target, GpuError> {
        let (width, height) = planned.size.of(canvas);
        let format = texture_format(planned.format);
        let label = match planned.index {
            0 => planned.id.title(),
            n => format!("{}, target {n}", planned.id.title()),
        };
        let levels = if planned.mips { mip_levels(width, height) } else { 1 };
        let descriptor = TextureDescriptor { label: &label, width, height, format, levels, is_target: true };
        let count = if planned.doubled { 2 } else { 1 };
        let textures = (0..count).map(|_| Texture::new(gpu, &descriptor)).collect::<Result<Vec<_>, _>>()?;
        let chains = if planned.mips { textures.iter().map(|t| mips.chain(gpu, t)).collect() } else { Vec::new() };
        Ok(Target { id: planned.id.clone(), index: planned.index, textures, chains, front: 0 })
    }

    /// What was drawn last.
    pub fn newest(&self) -> &Texture {
        &self.textures[self.front]
    }

    /// Index of the texture that the next draw goes into.
    pub fn back(&self) -> usize {
        (self.front + 1) % self.textures.len()
    }

    pub fn size(&self) -> (u32, u32) {
        (self.textures[0].width(), self.textures[0].height())
    }

    /// Takes over what `old` held, if its texels are of the same kind.
    pub fn take_over(&mut self, gpu: &Gpu, mips: &MipMaker, old: &Target) {
        if old.textures[0].raw.format() != self.textures[0].raw.format() {
            return;
        }
        self.front = old.front % self.textures.len();
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("keep") });
        for (index, texture) in self.textures.iter().enumerate() {
            let from = if self.textures.len() == 1 { old.newest() } else { &old.textures[index % old.textures.len()] };
            from.copy_overlap(&mut encoder, texture);
        }
        for chain in &self.chains {
            mips.build(gpu, &mut encoder, chain);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    pub fn clear(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, mips: &MipMaker) {
        for texture in &self.textures {
            texture.clear(gpu, encoder);
        }
        for chain in &self.chains {
            mips.build(gpu, encoder, chain);
        }
    }
}

/// Targets for a plan on a canvas, all zeros.
pub(super) fn make(
    gpu: &Gpu,
    mips: &mut MipMaker,
    plan: &FramePlan,
    canvas: (u32, u32),
) -> Result<Vec<Target>, GpuError> {
    plan.targets.iter().map(|planned| Target::new(gpu, mips, planned, canvas)).collect()
}
