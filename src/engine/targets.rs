//! The textures passes draw into, kept from frame to frame and, where it makes sense, from program to program.

use crate::{
    gpu::{Gpu, GpuError, MipChain, MipMaker, Texture, TextureDescriptor, mip_levels},
    graph::FramePlan,
    project::PassId,
};

/// Buffers hold what was written: 32-bit floats, as on the site. Image has the same, so that a picture loses nothing before
/// it is shown or saved.
pub(super) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// One or two textures of a pass, which take turns: frame by frame the engine's phase is 0, 1, 0, 1, …; a doubled target is
/// drawn into texture `phase`, so that texture `1 - phase` holds last frame's picture.
pub(super) struct Target {
    pub id: PassId,
    pub textures: Vec<Texture>,
    /// For each texture, where the plan asks for mips.
    pub chains: Vec<MipChain>,
}

impl Target {
    fn new(
        gpu: &Gpu,
        mips: &mut MipMaker,
        planned: &crate::graph::Target,
        (width, height): (u32, u32),
    ) -> Result<Target, GpuError> {
        let label = planned.id.title();
        let levels = if planned.mips { mip_levels(width, height) } else { 1 };
        let descriptor = TextureDescriptor { label: &label, width, height, format: FORMAT, levels, is_target: true };
        let count = if planned.doubled { 2 } else { 1 };
        let textures = (0..count).map(|_| Texture::new(gpu, &descriptor)).collect::<Result<Vec<_>, _>>()?;
        let chains = if planned.mips { textures.iter().map(|t| mips.chain(gpu, t)).collect() } else { Vec::new() };
        Ok(Target { id: planned.id.clone(), textures, chains })
    }

    /// The texture that a frame of the given phase draws into.
    pub fn at(&self, phase: usize) -> &Texture {
        &self.textures[phase % self.textures.len()]
    }

    /// The mip chain of [`Target::at`].
    pub fn chain_at(&self, phase: usize) -> Option<&MipChain> {
        self.chains.get(phase % self.textures.len())
    }

    /// Takes over what `old` held. `next_phase` is that of the frame to come, so the newest picture lies at the other one.
    fn take_over(&self, gpu: &Gpu, mips: &MipMaker, old: &Target, next_phase: usize) {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("keep") });
        for (index, texture) in self.textures.iter().enumerate() {
            let from = if self.textures.len() == 1 { old.at(1 - next_phase) } else { old.at(index) };
            from.copy_overlap(&mut encoder, texture);
        }
        for chain in &self.chains {
            mips.build(&mut encoder, chain);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    pub fn clear(&self, encoder: &mut wgpu::CommandEncoder, mips: &MipMaker) {
        for texture in &self.textures {
            texture.clear(encoder);
        }
        for chain in &self.chains {
            mips.build(encoder, chain);
        }
    }
}

/// Targets for a plan at a size. What `old` has of the same pass is kept, texel for texel from the bottom left.
pub(super) fn make(
    gpu: &Gpu,
    mips: &mut MipMaker,
    plan: &FramePlan,
    size: (u32, u32),
    old: Vec<Target>,
    next_phase: usize,
) -> Result<Vec<Target>, (GpuError, Vec<Target>)> {
    let mut made = Vec::with_capacity(plan.targets.len());
    for planned in &plan.targets {
        match Target::new(gpu, mips, planned, size) {
            Ok(target) => made.push(target),
            Err(error) => return Err((error, old)),
        }
    }
    for target in &made {
        if let Some(before) = old.iter().find(|t| t.id == target.id) {
            target.take_over(gpu, mips, before, next_phase);
        }
    }
    Ok(made)
}
