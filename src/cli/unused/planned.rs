//! Findings without drawing: passes, channels, components, mip levels and texels that no code reads.

use super::{Finding, Kind, is_drawn, millis};
use crate::{
    engine::{CompiledPass, PassCost, PassRole, Sources},
    glsl::{Driver, TexelUse, UniformSet},
    graph::FramePlan,
    project::{Filter, PassName, Project, TexelFormat},
};
use std::collections::HashMap;

const NAMES: [&str; 4] = ["red", "green", "blue", "alpha"];

/// A compiled pass that is drawn.
struct Reader<'a> {
    compiled: CompiledPass,
    pass: &'a crate::project::Pass,
}

pub(super) fn find(
    project: &Project,
    plan: &FramePlan,
    costs: &[PassCost],
    times: &HashMap<PassName, f64>,
    canvas: (u32, u32),
) -> Vec<Finding> {
    let mut found = Vec::new();
    let sources = Sources::new(project);
    let is_shown = |pass: &PassName| costs.iter().any(|cost| cost.pass == *pass && is_drawn(cost));
    let drawn = project.passes.iter().enumerate().filter(|(_, pass)| is_shown(&pass.id));
    let readers: Vec<Reader<'_>> = drawn
        .filter_map(|(index, pass)| {
            Some(Reader { compiled: sources.compile_pass(index, Driver::default()).ok()?, pass })
        })
        .collect();
    for cost in costs {
        match cost.role {
            PassRole::Unread => found.push(unread(project, cost, canvas)),
            PassRole::Off => {
                let when = cost.when.clone().unwrap_or_default();
                let message = format!("not drawn, as {when} is false");
                found.push(Finding { skipped: true, ..Finding::of(Kind::Pass, cost, message) });
            }
            PassRole::Outside => {
                let message = "its region is outside of its texels: remove the pass, or change the region".to_owned();
                found.push(Finding { skipped: true, bytes: cost.held_bytes, ..Finding::of(Kind::Pass, cost, message) });
            }
            PassRole::Drawn { .. } => {
                found.extend(channels(&readers, cost));
                if cost.pass != PassName::image() {
                    for target in 0..cost.formats.len() {
                        let own = Target { cost, index: target, plan, canvas };
                        found.extend(own.components(&readers));
                        found.extend(own.texels(&readers, millis(times, cost)));
                        found.extend(own.mips(project));
                    }
                }
            }
        }
    }
    found
}

/// Returns the finding for a pass that is not drawn.
fn unread(project: &Project, cost: &PassCost, (width, height): (u32, u32)) -> Finding {
    let size = project.pass(&cost.pass).map_or((width, height), |pass| pass.size().of((width, height)));
    let texels = u64::from(size.0) * u64::from(size.1);
    let bytes = cost.formats.iter().map(|format| format.bytes()).sum::<u64>() * texels;
    let message = "not drawn, as the picture does not depend on its texels".to_owned();
    Finding { skipped: true, bytes: bytes.saturating_sub(cost.held_bytes), ..Finding::of(Kind::Pass, cost, message) }
}

/// Returns the channels of a pass that name a pass and are not read.
fn channels(readers: &[Reader<'_>], cost: &PassCost) -> Vec<Finding> {
    let Some(reader) = readers.iter().find(|reader| reader.pass.id == cost.pass) else { return Vec::new() };
    // Of which channel is not known.
    let sizes = UniformSet::CHANNEL_RESOLUTION | UniformSet::CHANNEL_LOADED;
    let asks_size = reader.compiled.reflection.uniforms.intersects(sizes);
    let finding = |read: &crate::engine::PassRead| {
        let used = reader.compiled.reflection.channels[read.channel];
        let (channel, of) = (read.channel, read.pass.title());
        let message = match (used.is_read(), used.texels) {
            (false, _) if asks_size => {
                format!("of iChannel{channel}, {of}, no texel is read; the code reads iChannelResolution")
            }
            (false, _) => format!("iChannel{channel}, {of}, is not read: remove it"),
            (true, TexelUse::None) => format!("of iChannel{channel}, {of}, only the size is asked"),
            _ => return None,
        };
        Some(Finding { skipped: true, ..Finding::of(Kind::Channel, cost, message) })
    };
    cost.reads.iter().filter_map(finding).collect()
}

/// A target of a pass that is drawn.
struct Target<'a> {
    cost: &'a PassCost,
    index: usize,
    plan: &'a FramePlan,
    canvas: (u32, u32),
}

impl Target<'_> {
    /// Returns the channels that read it, with their readers.
    fn reads<'r>(&self, readers: &'r [Reader<'r>]) -> Vec<(&'r Reader<'r>, usize)> {
        let id = (&self.cost.pass, self.index);
        let channels = |reader: &'r Reader<'r>| {
            let own = reader.pass.bindings.iter().filter(move |(_, channel)| channel.input.target() == Some(id));
            let read = own.filter(|(slot, _)| {
                reader.compiled.reflection.channels.get(*slot).is_some_and(|used| used.texels != TexelUse::None)
            });
            read.map(|(slot, _)| (reader, slot)).collect::<Vec<_>>()
        };
        readers.iter().flat_map(channels).collect()
    }

    fn name(&self) -> String {
        match self.cost.formats.len() {
            1 => String::new(),
            _ => format!(" of target {}", self.index),
        }
    }

    /// Returns the bytes of its textures.
    fn held(&self) -> u64 {
        let is_it = |target: &&crate::graph::Target| target.id == self.cost.pass && target.index == self.index;
        self.plan.targets.iter().find(is_it).map_or(0, |target| target.bytes(self.canvas))
    }

    fn components(&self, readers: &[Reader<'_>]) -> Option<Finding> {
        let format = self.cost.formats[self.index];
        let reads = self.reads(readers);
        let channels = reads.iter().map(|(reader, slot)| reader.compiled.reflection.channels[*slot].components);
        let used = channels.fold(0, |all, components| all | components);
        let unused: Vec<&str> = (0..format.components()).filter(|c| used & 1 << c == 0).map(|c| NAMES[c]).collect();
        if reads.is_empty() || unused.is_empty() {
            return None;
        }
        let needed = (u8::BITS - used.leading_zeros()) as usize;
        let (verb, all) = (if unused.len() == 1 { "is" } else { "are" }, unused.join(", "));
        let mut message = format!("{all}{} {verb} read by no pass", self.name());
        let mut bytes = 0;
        if let Some(smaller) = with_components(format, needed) {
            message.push_str(&format!(": format = \"{}\" is enough", smaller.name()));
            bytes = self.held() - self.held() * smaller.bytes() / format.bytes();
        }
        Some(Finding { bytes, ..Finding::of(Kind::Components, self.cost, message) })
    }

    fn texels(&self, readers: &[Reader<'_>], ms: Option<f64>) -> Option<Finding> {
        let reads = self.reads(readers);
        let (mut width, mut height) = (0, 0);
        for (reader, slot) in &reads {
            for stage in reader.compiled.programs().iter().flat_map(|program| program.stages()) {
                let (across, up) = stage.specialisable.as_ref()?.fetched_extent(*slot as u8)?;
                (width, height) = (width.max(across), height.max(up));
            }
        }
        let size = self.cost.size;
        let (width, height) = (width.min(size.0), height.min(size.1));
        if reads.is_empty() || (width, height) == size {
            return None;
        }
        let share = 1.0 - f64::from(width) * f64::from(height) / (f64::from(size.0) * f64::from(size.1));
        let message = format!(
            "of {}x{} texels only the first {width}x{height}{} can be read: region = [0, 0, {width}, {height}] draws no more",
            size.0,
            size.1,
            self.name()
        );
        let bytes = (self.held() as f64 * share) as u64;
        Some(Finding { ms: ms.map(|ms| ms * share), bytes, ..Finding::of(Kind::Texels, self.cost, message) })
    }

    fn mips(&self, project: &Project) -> Option<Finding> {
        let id = (&self.cost.pass, self.index);
        let asks = |pass: &crate::project::Pass| {
            let own = pass.bindings.iter().filter(|(_, channel)| channel.input.target() == Some(id));
            own.map(|(_, channel)| channel.sampler.filter).any(|filter| filter == Filter::Mipmap)
        };
        let is_it = |target: &&crate::graph::Target| target.id == self.cost.pass && target.index == self.index;
        let target = self.plan.targets.iter().find(is_it)?;
        if target.mips || !project.passes.iter().any(asks) {
            return None;
        }
        let message = format!("mip levels{} are asked for by a filter, and no read can reach them", self.name());
        Some(Finding { skipped: true, bytes: self.held() / 3, ..Finding::of(Kind::Mips, self.cost, message) })
    }
}

/// Returns the smallest format of the same kind with at least this number of components, if it is smaller.
fn with_components(format: TexelFormat, count: usize) -> Option<TexelFormat> {
    let per = format.bytes() / format.components() as u64;
    let is_float = |f: TexelFormat| f.is_32_bit() || f.is_small_float();
    let same = |f: &TexelFormat| is_float(*f) == is_float(format) && f.bytes() / f.components() as u64 == per;
    let fitting = TexelFormat::ALL.into_iter().filter(same).filter(|f| f.components() >= count);
    fitting.min_by_key(|f| f.components()).filter(|f| f.components() < format.components())
}
