//! The reads of a program, from its operations.

use crate::{
    UniformSet,
    ir::{Function, GlobalKind, Level, Module, Op, Stmt, Value},
    reflection::{ChannelUse, TexelUse},
    source::MAX_CHANNELS,
    types::Scalar,
};
use std::collections::BTreeSet;

/// The inputs that a program reads, apart from custom uniforms. Conservative: a read that may happen is listed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reads {
    pub uniforms: UniformSet,
    /// Some member of the [`GeometryBlock`](crate::interface::GeometryBlock) is read.
    pub geometry: bool,
    /// [`ChannelUse::sampler`] is not determined.
    pub channels: [ChannelUse; MAX_CHANNELS],
    /// `discard` is reachable.
    pub discards: bool,
}

impl Reads {
    /// Returns what the operations of a program read. Operations that no statement computes are counted, too.
    pub(crate) fn of(module: &Module) -> Reads {
        let mut reads = Reads::default();
        let mut fixed: [BTreeSet<Vec<u32>>; MAX_CHANNELS] = Default::default();
        for f in &module.functions {
            reads.discards |= f.body.iter().any(discards);
            for (_, op) in f.values() {
                reads.add(module, f, op, &mut fixed);
            }
            reads.add_components(f);
        }
        for (channel, fixed) in reads.channels.iter_mut().zip(fixed) {
            if channel.texels == TexelUse::None && !fixed.is_empty() {
                channel.texels = TexelUse::Fixed(fixed.len() as u32);
            }
        }
        reads
    }

    fn add(&mut self, module: &Module, f: &Function, op: &Op, fixed: &mut [BTreeSet<Vec<u32>>; MAX_CHANNELS]) {
        let is_base = |level: Value| matches!(f[level], Op::Literal(_, 0) | Op::Zero(_));
        let (channel, texels, mips) = match *op {
            Op::Global(id) => {
                if let GlobalKind::Uniform(uniform) = module[id].kind {
                    match UniformSet::of(uniform) {
                        Some(flag) => self.uniforms.insert(flag),
                        None => self.geometry = true,
                    }
                }
                return;
            }
            Op::Sample { channel, level, .. } => {
                let mips = !matches!(level, Level::Exact(level) if is_base(level));
                (channel, TexelUse::Any, mips)
            }
            Op::Gather { channel, .. } => (channel, TexelUse::Any, false),
            Op::Fetch { channel, coordinate, level } => {
                let words = words(module, f, coordinate).zip(words(module, f, level));
                let place = words.map(|(place, level)| [place, level].concat());
                match (place, fixed.get_mut(usize::from(channel))) {
                    (Some(place), Some(fixed)) => {
                        fixed.insert(place);
                        (channel, TexelUse::None, !is_base(level))
                    }
                    _ => (channel, TexelUse::Any, !is_base(level)),
                }
            }
            Op::TextureSize { channel, level } => (channel, TexelUse::None, level.is_some()),
            Op::TextureLevels { channel } => (channel, TexelUse::None, true),
            _ => return,
        };
        let Some(entry) = self.channels.get_mut(usize::from(channel)) else { return };
        entry.texture = true;
        entry.mips |= mips;
        if texels == TexelUse::Any {
            entry.texels = texels;
        }
    }
}

impl Reads {
    /// Adds the components of texels that operations of a function use.
    fn add_components(&mut self, f: &Function) {
        let channel_of = |value: Value| match f[value] {
            Op::Sample { channel, .. } | Op::Fetch { channel, .. } => Some(usize::from(channel)),
            _ => None,
        };
        let mut add_to = |channel: usize, components: u8| {
            if let Some(entry) = self.channels.get_mut(channel) {
                entry.components |= components;
            }
        };
        let mut add = |value: Value, components: u8| {
            if let Some(channel) = channel_of(value) {
                add_to(channel, components);
            }
        };
        let mut gathered = Vec::new();
        for (_, op) in f.values() {
            match *op {
                Op::Part { base, index } => add(base, 1 << index.min(3)),
                Op::Swizzle { vector, swizzle } => add(vector, swizzle.iter().fold(0, |all, index| all | 1 << index)),
                // Its four values are one component of four texels.
                Op::Gather { channel, component, .. } => {
                    gathered.push((usize::from(channel), 1 << component.min(3)));
                    op.operands(|operand| add(operand, ALL_COMPONENTS));
                }
                _ => op.operands(|operand| add(operand, ALL_COMPONENTS)),
            }
        }
        each_operand(&f.body, &mut |operand| add(operand, ALL_COMPONENTS));
        gathered.into_iter().for_each(|(channel, components)| add_to(channel, components));
    }
}

const ALL_COMPONENTS: u8 = 0b1111;

/// Visits the operands of statements, at any depth.
fn each_operand(block: &[Stmt], visit: &mut impl FnMut(Value)) {
    for stmt in block {
        stmt.operands(&mut *visit);
        stmt.blocks(|block| each_operand(block, visit));
    }
}

/// Returns the components of a constant vector of ints.
fn words(module: &Module, f: &Function, value: Value) -> Option<Vec<u32>> {
    match f[value] {
        Op::Literal(Scalar::Int | Scalar::Uint, bits) => Some(vec![bits]),
        Op::Zero(ty) => Some(vec![0; module.types.components(ty)? as usize]),
        Op::Const(id) => Some(module[id].words.clone()),
        Op::Splat { size, value } => Some(words(module, f, value)?.repeat(usize::from(size))),
        Op::Compose { ref parts, .. } => {
            let parts: Option<Vec<_>> = parts.iter().map(|&part| words(module, f, part)).collect();
            Some(parts?.concat())
        }
        _ => None,
    }
}

fn discards(stmt: &Stmt) -> bool {
    matches!(stmt, Stmt::Discard) || stmt.any_block(|block| block.iter().any(discards))
}
