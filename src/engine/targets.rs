//! The textures that passes draw into, kept from frame to frame and, where possible, from program to program.

use eddy_gpu::{Gpu, GpuError, MipChain, MipMaker, Texture, TextureDescriptor};
use eddy_graph::{self as graph, FramePlan};
use eddy_project::PassName;

/// One or two textures of a pass. With two, one contains the last picture and is read; the next draw goes into the
/// other, and then they are swapped.
pub(super) struct Target {
    pub id: PassName,
    /// The index among the pass's targets.
    pub index: usize,
    pub textures: Vec<Texture>,
    /// One per texture, if the plan needs mip levels.
    pub chains: Vec<MipChain>,
    /// The index of the texture that was drawn last.
    pub front: usize,
}

impl Target {
    fn new(gpu: &Gpu, mips: &mut MipMaker, planned: &graph::Target, canvas: (u32, u32)) -> Result<Target, GpuError> {
        let label = match planned.index {
            0 => planned.id.title(),
            n => format!("{}, target {n}", planned.id.title()),
        };
        let descriptor = TextureDescriptor { label: &label, shape: planned.shape(canvas), is_target: true };
        let textures =
            (0..planned.textures()).map(|_| Texture::new(gpu, &descriptor)).collect::<Result<Vec<_>, _>>()?;
        let mipped = textures.iter().filter(|_| planned.mips);
        let chains = mipped.map(|texture| mips.chain(gpu, texture)).collect::<Result<_, _>>()?;
        Ok(Target { id: planned.id.clone(), index: planned.index, textures, chains, front: 0 })
    }

    /// Returns true if it is this target of a plan.
    fn is(&self, planned: &graph::Target) -> bool {
        self.id == planned.id && self.index == planned.index
    }

    /// Returns true if its textures match a plan.
    fn fits(&self, planned: &graph::Target, canvas: (u32, u32)) -> bool {
        self.textures[0].shape == planned.shape(canvas) && self.textures.len() == planned.textures()
    }

    /// The texture that was drawn last.
    pub(crate) fn newest(&self) -> &Texture {
        &self.textures[self.front]
    }

    /// Returns the index of the texture that the next draw goes into.
    pub(crate) fn back(&self) -> usize {
        (self.front + 1) % self.textures.len()
    }

    pub(crate) fn size(&self) -> (u32, u32) {
        (self.textures[0].width(), self.textures[0].height())
    }

    /// Copies the contents of `old`, if its texels have the same format.
    pub(crate) fn take_over(&mut self, gpu: &Gpu, mips: &MipMaker, old: &Target) {
        if old.textures[0].shape.format != self.textures[0].shape.format {
            return;
        }
        self.front = old.front % self.textures.len();
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("keep") });
        for (index, texture) in self.textures.iter().enumerate() {
            let from = if self.textures.len() == 1 { old.newest() } else { &old.textures[index % old.textures.len()] };
            from.copy_overlap(gpu, &mut encoder, texture);
        }
        for chain in &self.chains {
            mips.build(gpu, &mut encoder, chain);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    pub(crate) fn clear(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, mips: &MipMaker) {
        for texture in &self.textures {
            texture.clear(gpu, encoder, wgpu::Color::TRANSPARENT);
        }
        for chain in &self.chains {
            mips.build(gpu, encoder, chain);
        }
    }
}

/// New targets of a plan, all zeros; `None` if the present one matches the plan.
pub(super) struct NewTargets(Vec<Option<Target>>);

impl NewTargets {
    /// Creates the targets of a plan on a canvas for which `present` has no match.
    pub(crate) fn make(
        gpu: &Gpu,
        mips: &mut MipMaker,
        plan: &FramePlan,
        canvas: (u32, u32),
        present: &[Target],
    ) -> Result<Self, GpuError> {
        let make = |(index, planned): (usize, &graph::Target)| {
            // Targets that no pass draws are zeros, even if a removed pass drew into them before.
            let is_kept = plan.is_drawn(index) && present.iter().any(|t| t.is(planned) && t.fits(planned, canvas));
            if is_kept { Ok(None) } else { Target::new(gpu, mips, planned, canvas).map(Some) }
        };
        plan.targets.iter().enumerate().map(make).collect::<Result<_, _>>().map(Self)
    }

    /// Replaces the present targets by those of the plan, keeping the ones that match. Returns the others, and for each
    /// target of the plan whether it is new.
    pub(crate) fn replace(self, plan: &FramePlan, present: &mut Vec<Target>) -> (Vec<Target>, Vec<bool>) {
        let is_new = self.0.iter().map(Option::is_some).collect();
        let mut old = std::mem::take(present);
        for (made, planned) in self.0.into_iter().zip(&plan.targets) {
            let kept = || old.iter().position(|t| t.is(planned)).map(|at| old.swap_remove(at));
            present.extend(made.or_else(kept));
        }
        (old, is_new)
    }
}
