//! The texels of targets at one moment, for restoring them.

use super::{running::Running, shared::Shared, targets::Target};
use eddy_gpu::{Gpu, GpuError, Texture, TextureDescriptor};
use eddy_graph::{Carried, FramePlan};
use eddy_project::PassName;
use eddy_texture::TextureShape;

/// The contents of a program's targets between two frames. It is only valid for the program and the canvas that it was
/// taken of.
pub struct Snapshot {
    targets: Vec<TargetCopy>,
    bytes: u64,
}

struct TargetCopy {
    id: PassName,
    index: usize,
    /// The shapes of all its textures, and copies of the first levels of the requested ones.
    textures: Vec<(TextureShape, Option<Texture>)>,
    front: usize,
}

/// Returns the shape of a copy. Texels can be restored to a texture of the same shape.
fn copied_shape(texture: &Texture) -> TextureShape {
    texture.shape.without_mips()
}

/// The part of the targets that is copied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    Everything,
    /// The texels that later frames read.
    Carried,
}

impl Extent {
    /// Returns the part to copy of the target at an index of the plan.
    fn of(self, plan: &FramePlan, target: usize) -> Carried {
        match self {
            Extent::Everything => Carried::All,
            Extent::Carried => plan.carried(target),
        }
    }
}

fn takes(carried: Carried, target: &Target, texture: usize) -> bool {
    match carried {
        Carried::Nothing => false,
        Carried::Newest => texture == target.front,
        Carried::All => true,
    }
}

impl Snapshot {
    pub(super) fn take(gpu: &Gpu, running: Option<&Running>, extent: Extent) -> Result<Self, GpuError> {
        let Some(running) = running else { return Ok(Self { targets: Vec::new(), bytes: 0 }) };
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("snapshot") });
        let mut kept = Vec::with_capacity(running.targets.len());
        for (index, target) in running.targets.iter().enumerate() {
            let carried = extent.of(&running.program.plan, index);
            let mut copy = |(index, texture): (usize, &Texture)| {
                let shape = copied_shape(texture);
                if !takes(carried, target, index) {
                    return Ok((shape, None));
                }
                let copy = Texture::new(gpu, &TextureDescriptor { label: "snapshot", shape, is_target: true })?;
                texture.copy_overlap(gpu, &mut encoder, &copy);
                Ok((shape, Some(copy)))
            };
            kept.push(TargetCopy {
                id: target.id.clone(),
                index: target.index,
                textures: target.textures.iter().enumerate().map(&mut copy).collect::<Result<_, GpuError>>()?,
                front: target.front,
            });
        }
        gpu.queue.submit([encoder.finish()]);
        Ok(Self { targets: kept, bytes: bytes(Some(running), extent) })
    }

    /// Returns the bytes that the copies take.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// Returns whether it was taken of targets like these, and contains what later frames read of them.
    fn is_of(&self, running: &Running) -> bool {
        let fits = |(index, (kept, target)): (usize, (&TargetCopy, &Target))| {
            let is_same = || kept.textures.iter().map(|(shape, _)| *shape).eq(target.textures.iter().map(copied_shape));
            let is_there = |texture: usize| match running.program.plan.carried(index) {
                Carried::Nothing => true,
                Carried::Newest => texture != kept.front || kept.textures[texture].1.is_some(),
                Carried::All => kept.textures[texture].1.is_some(),
            };
            kept.id == target.id && kept.index == target.index && is_same() && (0..kept.textures.len()).all(is_there)
        };
        let targets = &running.targets;
        self.targets.len() == targets.len() && self.targets.iter().zip(targets).enumerate().all(fits)
    }
}

/// Returns the bytes that a snapshot takes.
pub(super) fn bytes(running: Option<&Running>, extent: Extent) -> u64 {
    let Some(running) = running else { return 0 };
    let taken = |(index, target): (usize, &Target)| -> u64 {
        let carried = extent.of(&running.program.plan, index);
        let textures = target.textures.iter().enumerate();
        textures
            .filter(|(texture, _)| takes(carried, target, *texture))
            .map(|(_, texture)| copied_shape(texture).bytes())
            .sum()
    };
    running.targets.iter().enumerate().map(taken).sum()
}

impl Running {
    /// Restores the texels of a snapshot. Returns false without changes if it is of other targets.
    pub(super) fn restore(&mut self, shared: &Shared, snapshot: &Snapshot) -> bool {
        if !snapshot.is_of(self) {
            return false;
        }
        self.drop_unfinished();
        let gpu = &shared.gpu;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("restore") });
        for (kept, target) in snapshot.targets.iter().zip(&mut self.targets) {
            target.front = kept.front;
            for (index, ((_, copy), texture)) in kept.textures.iter().zip(&target.textures).enumerate() {
                let Some(copy) = copy else { continue };
                copy.copy_overlap(gpu, &mut encoder, texture);
                if let Some(chain) = target.chains.get(index) {
                    shared.mips.build(gpu, &mut encoder, chain);
                }
            }
        }
        gpu.queue.submit([encoder.finish()]);
        self.changes.invalidate();
        self.is_blank.clear();
        true
    }
}
