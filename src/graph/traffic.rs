//! Bytes that a frame must move at least, from its plan alone.

use super::{FramePlan, Target, TexelSource};
use eddy_texture::TextureShape;
use std::collections::BTreeMap;

/// The minimum that is moved if everything is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// The bytes of texels written, and of texels read, each texel of each source once per draw: neighbours are served
    /// by a cache.
    pub bytes: u64,
    /// The number of texels drawn, counting every step of a group.
    pub texels: u64,
}

impl FramePlan {
    /// Returns the minimum that a frame on a canvas moves. Pictures and the keyboard are not counted, as they are read
    /// but never written.
    pub fn traffic(&self, canvas: (u32, u32)) -> Traffic {
        let mut sum = Traffic::default();
        for run in &self.runs {
            for draw in run.draws.clone() {
                let step = self.traffic_of(draw, canvas);
                sum.bytes += step.bytes * u64::from(run.steps);
                sum.texels += step.texels * u64::from(run.steps);
            }
        }
        sum
    }

    /// Returns the share of one execution of a draw.
    ///
    /// # Panics
    /// If there is no such draw.
    pub fn traffic_of(&self, draw: usize, canvas: (u32, u32)) -> Traffic {
        let count = |(w, h): (u32, u32)| u64::from(w) * u64::from(h);
        let draw = &self.draws[draw];
        let size = self.targets[draw.targets.start].size.of(canvas);
        let texels = match draw.region {
            None => count(size),
            Some(region) => region.within(size).map_or(0, |r| count((r.width, r.height))),
        };
        let mut bytes = 0;
        for target in &self.targets[draw.targets.clone()] {
            // Each level is computed from the previous one, which has four times its texels: 4/3 are read, 1/3 written.
            let mips = if target.mips { count(size) * target.format.bytes() * 5 / 3 } else { 0 };
            bytes += texels * target.format.bytes() + mips;
        }
        // The texels that are read of each source; channels may share one.
        let mut sources: BTreeMap<usize, u64> = BTreeMap::new();
        for read in draw.reads.iter().flatten() {
            let Some(index) = target_of(read) else { continue };
            let all = count(self.targets[index].size.of(canvas));
            // A part of a pass may need only a part of its inputs.
            let most = if draw.region.is_some() { all.min(texels) } else { all };
            let sum = sources.entry(index).or_default();
            *sum = most.min(*sum + read.max_texels.map_or(most, u64::from));
        }
        for (source, texels) in sources {
            bytes += texels * self.targets[source].format.bytes();
        }
        Traffic { bytes, texels }
    }

    /// Returns how often a frame executes a draw.
    pub fn steps_of(&self, draw: usize) -> u32 {
        self.runs.iter().find(|run| run.draws.contains(&draw)).map_or(1, |run| run.steps)
    }

    /// Returns the memory of the targets on the device in bytes.
    pub fn target_bytes(&self, canvas: (u32, u32)) -> u64 {
        self.targets.iter().map(|target| target.bytes(canvas)).sum()
    }
}

impl Target {
    /// Returns the shape of each of its textures.
    pub fn shape(&self, canvas: (u32, u32)) -> TextureShape {
        let (width, height) = self.size.of(canvas);
        let shape = TextureShape { dimension: self.dimension, ..TextureShape::flat(width, height, self.format) };
        if self.mips { shape.with_mips() } else { shape }
    }

    /// Returns the number of its textures.
    pub fn textures(&self) -> usize {
        if self.doubled { 2 } else { 1 }
    }

    /// Returns the memory of its textures on the device in bytes, including mip levels and the second one of a pair.
    pub fn bytes(&self, canvas: (u32, u32)) -> u64 {
        self.shape(canvas).bytes() * self.textures() as u64
    }
}

fn target_of(read: &super::Read) -> Option<usize> {
    match read.source {
        TexelSource::Target { index, .. } => Some(index),
        TexelSource::External | TexelSource::Nothing => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::{PassName, PassSize};
    use eddy_texture::{Dimension, TexelFormat};

    #[test]
    fn a_mip_chain_and_a_second_texture_are_counted() {
        let target = |doubled, mips| Target {
            id: PassName::image(),
            index: 0,
            dimension: Dimension::D2,
            size: Default::default(),
            format: Default::default(),
            doubled,
            mips,
        };
        let plan = |t| FramePlan { targets: vec![t], ..Default::default() };
        assert_eq!(plan(target(false, false)).target_bytes((4, 2)), 8 * 16);
        assert_eq!(plan(target(true, false)).target_bytes((4, 2)), 2 * 8 * 16);
        assert_eq!(plan(target(true, true)).target_bytes((4, 2)), 2 * (8 + 2 + 1) * 16);
        let half = Target { size: PassSize::Scale(0.5), format: TexelFormat::R16f, ..target(false, false) };
        assert_eq!(plan(half).target_bytes((4, 2)), 2 * 2);
    }
}
