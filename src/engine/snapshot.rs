//! The texels of every target at one moment, to go back to.

use super::{running::Running, shared::Shared, targets::Target};
use crate::{
    gpu::{Gpu, GpuError, Texture, TextureDescriptor},
    project::PassId,
};

/// Holds what a program's targets held between two frames. It belongs to the program and the canvas that it was taken
/// of.
pub struct Snapshot {
    targets: Vec<KeptTarget>,
    bytes: u64,
}

struct KeptTarget {
    id: PassId,
    index: usize,
    /// Copies of its textures' first levels: both of two, as `discard` leaves a texel as it was two frames before.
    textures: Vec<Texture>,
    front: usize,
}

impl Snapshot {
    pub(super) fn take(gpu: &Gpu, targets: &[Target]) -> Result<Self, GpuError> {
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("snapshot") });
        let mut kept = Vec::with_capacity(targets.len());
        for target in targets {
            let copy = |texture: &Texture| {
                let copy = Texture::new(
                    gpu,
                    &TextureDescriptor {
                        label: "snapshot",
                        width: texture.width(),
                        height: texture.height(),
                        format: texture.raw.format(),
                        levels: 1,
                        is_target: true,
                    },
                )?;
                texture.copy_overlap(&mut encoder, &copy);
                Ok(copy)
            };
            kept.push(KeptTarget {
                id: target.id.clone(),
                index: target.index,
                textures: target.textures.iter().map(copy).collect::<Result<_, GpuError>>()?,
                front: target.front,
            });
        }
        gpu.queue.submit([encoder.finish()]);
        Ok(Self { targets: kept, bytes: bytes(targets) })
    }

    /// Returns the bytes that the copies take.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    fn is_of(&self, targets: &[Target]) -> bool {
        let is_same = |(kept, target): (&KeptTarget, &Target)| {
            let kind = |t: &Texture| (t.width(), t.height(), t.raw.format());
            let same_textures = || kept.textures.iter().map(kind).eq(target.textures.iter().map(kind));
            kept.id == target.id && kept.index == target.index && same_textures()
        };
        self.targets.len() == targets.len() && self.targets.iter().zip(targets).all(is_same)
    }
}

/// Returns the bytes that a snapshot of these targets takes.
pub(super) fn bytes(targets: &[Target]) -> u64 {
    let of = |texture: &Texture| {
        let texel = u64::from(texture.raw.format().block_copy_size(None).unwrap_or(16));
        u64::from(texture.width()) * u64::from(texture.height()) * texel
    };
    targets.iter().flat_map(|target| &target.textures).map(of).sum()
}

impl Running {
    /// Puts the texels of a snapshot back. False, and nothing is changed, if it is one of other targets.
    pub(super) fn restore(&mut self, shared: &Shared, snapshot: &Snapshot) -> bool {
        if !snapshot.is_of(&self.targets) {
            return false;
        }
        let gpu = &shared.gpu;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("restore") });
        for (kept, target) in snapshot.targets.iter().zip(&mut self.targets) {
            target.front = kept.front;
            for (copy, texture) in kept.textures.iter().zip(&target.textures) {
                copy.copy_overlap(&mut encoder, texture);
            }
            for chain in &target.chains {
                shared.mips.build(gpu, &mut encoder, chain);
            }
        }
        gpu.queue.submit([encoder.finish()]);
        self.changes.invalidate();
        true
    }
}
