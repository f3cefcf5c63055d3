//! The textures passes draw into, kept from frame to frame and, where it makes sense, from program to program.

use eddy_gpu::{Gpu, GpuError, MipChain, MipMaker, Texture, TextureDescriptor};
use eddy_graph::{self as graph, FramePlan};
use eddy_project::PassName;

/// One or two textures of a pass. Of two, one holds what was drawn last and is read; the next draw goes into the other,
/// and then they change places.
pub(super) struct Target {
    pub id: PassName,
    /// The place among the pass's targets.
    pub index: usize,
    pub textures: Vec<Texture>,
    /// For each texture, where the plan asks for mips.
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
        let chains = if planned.mips { textures.iter().map(|t| mips.chain(gpu, t)).collect() } else { Vec::new() };
        Ok(Target { id: planned.id.clone(), index: planned.index, textures, chains, front: 0 })
    }

    /// Returns true if it is the target that a plan asks for.
    fn is(&self, planned: &graph::Target) -> bool {
        self.id == planned.id && self.index == planned.index
    }

    /// Returns true if its textures are as a plan asks.
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

    /// Takes over what `old` held, if its texels are of the same kind.
    pub(crate) fn take_over(&mut self, gpu: &Gpu, mips: &MipMaker, old: &Target) {
        if old.textures[0].shape.format != self.textures[0].shape.format {
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

    pub(crate) fn clear(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, mips: &MipMaker) {
        for texture in &self.textures {
            texture.clear(gpu, encoder, wgpu::Color::TRANSPARENT);
        }
        for chain in &self.chains {
            mips.build(gpu, encoder, chain);
        }
    }
}

/// New targets of a plan, all zeros; `None` where the present one is as the plan asks.
pub(super) struct NewTargets(Vec<Option<Target>>);

impl NewTargets {
    /// Makes those targets of a plan on a canvas that `present` lacks or has otherwise.
    pub(crate) fn make(
        gpu: &Gpu,
        mips: &mut MipMaker,
        plan: &FramePlan,
        canvas: (u32, u32),
        present: &[Target],
    ) -> Result<Self, GpuError> {
        let make = |(index, planned): (usize, &graph::Target)| {
            // What no pass draws holds zeros, also where a pass that has gone drew it before.
            let is_kept = plan.is_drawn(index) && present.iter().any(|t| t.is(planned) && t.fits(planned, canvas));
            if is_kept { Ok(None) } else { Target::new(gpu, mips, planned, canvas).map(Some) }
        };
        plan.targets.iter().enumerate().map(make).collect::<Result<_, _>>().map(Self)
    }

    /// Puts the targets of the plan in place of the present ones, of which it keeps those that are as the plan asks.
    /// Returns the others, and for each target of the plan whether it is new.
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
