//! A compiled pass, whether it is one full-screen program or the programs of several meshes.

use eddy_diag::Diagnostic;
use eddy_glsl::{ChannelUse, Compiled, Reflection, TexelUse, interface};
use eddy_graph::{ChannelFacts, PassFacts};
use std::sync::Arc;

/// A pass that compiled.
pub struct CompiledPass {
    /// One program, or one per mesh that the pass draws.
    pub(super) programs: Vec<CompiledProgram>,
    /// The merged reads of all programs.
    pub reflection: Reflection,
    /// Warnings and notes; never errors.
    pub diagnostics: Vec<Diagnostic>,
}

/// One program of a pass. Its diagnostics are stored in the pass.
#[derive(Clone)]
pub struct CompiledProgram {
    /// `None`: the triangle that covers the whole target.
    pub vertex: Option<Arc<Compiled>>,
    pub fragment: Arc<Compiled>,
}

impl CompiledProgram {
    /// Returns the bytes of the constant tables of both stages by their bindings, omitting empty ones.
    pub fn tables(&self) -> impl Iterator<Item = (u32, &[u8])> {
        let vertex = self.vertex.as_ref().map(|v| (interface::VERTEX_TABLE_BINDING, &v.uniform_tables[..]));
        let fragment = [
            (interface::TABLE_BINDING, &self.fragment.tables[..]),
            (interface::UNIFORM_TABLE_BINDING, &self.fragment.uniform_tables[..]),
        ];
        fragment.into_iter().chain(vertex).filter(|(_, bytes)| !bytes.is_empty())
    }

    /// Returns its stages.
    pub fn stages(&self) -> impl Iterator<Item = &Compiled> + use<'_> {
        self.vertex.iter().chain([&self.fragment]).map(|stage| &**stage)
    }

    /// Returns the number of bytes of the author's own uniforms that it reads.
    pub fn custom_uniform_bytes(&self) -> u64 {
        self.vertex.as_ref().map_or(0, |v| v.custom_uniform_bytes).max(self.fragment.custom_uniform_bytes)
    }
}

impl CompiledPass {
    /// Returns its programs: one, or one per mesh in drawing order.
    pub fn programs(&self) -> &[CompiledProgram] {
        &self.programs
    }

    /// Returns the properties that the planner needs.
    pub fn facts(&self) -> PassFacts {
        PassFacts { channels: self.reflection.channels.map(channel_facts), discards: self.reflection.discards }
    }

    /// Returns a pass over the whole target, or the diagnostics if its stage was not compiled.
    pub(super) fn screen(
        fragment: Option<Arc<Compiled>>,
        diagnostics: Vec<Diagnostic>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let Some(fragment) = fragment else { return Err(diagnostics) };
        let reflection = fragment.reflection.clone();
        Ok(Self { programs: vec![CompiledProgram { vertex: None, fragment }], reflection, diagnostics })
    }

    /// Asks naga whether the modules are valid, as wgpu does where a device gets them: see [`Compiled::validate`].
    pub fn validate(&self) -> Result<(), Diagnostic> {
        let stages = |program: &'_ CompiledProgram| {
            program.vertex.iter().chain([&program.fragment]).cloned().collect::<Vec<_>>()
        };
        self.programs.iter().flat_map(stages).try_for_each(|stage| stage.validate())
    }

    /// Adds the program of a mesh.
    pub(super) fn add_mesh(&mut self, vertex: Arc<Compiled>, fragment: Arc<Compiled>) {
        join(&mut self.reflection, &vertex.reflection);
        join(&mut self.reflection, &fragment.reflection);
        self.programs.push(CompiledProgram { vertex: Some(vertex), fragment });
    }
}

/// Returns the facts about a channel that is used like this.
pub(super) fn channel_facts(used: ChannelUse) -> ChannelFacts {
    let max_texels = match used.texels {
        TexelUse::None => Some(0),
        TexelUse::Fixed(count) => Some(count),
        TexelUse::Any => None,
    };
    ChannelFacts { is_read: used.is_read(), reaches_mips: used.mips, max_texels }
}

/// Merges the reads of one stage into those of the pass.
fn join(all: &mut Reflection, one: &Reflection) {
    all.uniforms.insert(one.uniforms);
    all.custom_uniforms.extend(&one.custom_uniforms);
    for (all, one) in all.channels.iter_mut().zip(one.channels) {
        all.texture |= one.texture;
        all.sampler |= one.sampler;
        all.mips |= one.mips;
        all.texels = all.texels.joined(one.texels);
        all.components |= one.components;
    }
    all.discards |= one.discards;
    all.geometry |= one.geometry;
}
