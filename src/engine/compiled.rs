//! A pass out of the compiler, whether it is one full-screen program or the programs of several meshes.

use eddy_diag::Diagnostic;
use eddy_glsl::{Compiled, Reflection, interface};
use eddy_graph::{ChannelFacts, PassFacts};
use std::sync::Arc;

/// A pass that compiled.
pub struct CompiledPass {
    /// One, or one for each mesh the pass draws.
    pub(super) programs: Vec<CompiledProgram>,
    /// The reads of all programs together.
    pub reflection: Reflection,
    /// Warnings and notes; never an error.
    pub diagnostics: Vec<Diagnostic>,
}

/// One program of a pass. Its diagnostics are those of the pass.
#[derive(Clone)]
pub struct CompiledProgram {
    /// `None`: the triangle over the whole target.
    pub vertex: Option<Arc<Compiled>>,
    pub fragment: Arc<Compiled>,
}

impl CompiledProgram {
    /// Returns the bytes of the constant tables of both stages by their bindings; only those that there are.
    pub fn tables(&self) -> impl Iterator<Item = (u32, &[u8])> {
        let vertex = self.vertex.as_ref().map(|v| (interface::VERTEX_TABLE_BINDING, &v.uniform_tables[..]));
        let fragment = [
            (interface::TABLE_BINDING, &self.fragment.tables[..]),
            (interface::UNIFORM_TABLE_BINDING, &self.fragment.uniform_tables[..]),
        ];
        fragment.into_iter().chain(vertex).filter(|(_, bytes)| !bytes.is_empty())
    }

    /// Returns its stages.
    pub fn stages(&self) -> impl Iterator<Item = &Compiled> {
        self.vertex.iter().chain([&self.fragment]).map(|stage| &**stage)
    }

    /// Returns the number of bytes of the author's own uniforms that it reads.
    pub fn custom_uniform_bytes(&self) -> u64 {
        self.vertex.as_ref().map_or(0, |v| v.custom_uniform_bytes).max(self.fragment.custom_uniform_bytes)
    }
}

impl CompiledPass {
    /// Returns its programs: one, or one for each mesh in the order in which they are drawn.
    pub fn programs(&self) -> &[CompiledProgram] {
        &self.programs
    }

    /// Returns what the planner has to know of it.
    pub fn facts(&self) -> PassFacts {
        PassFacts {
            channels: self.reflection.channels.map(|c| ChannelFacts { is_read: c.is_read(), reaches_mips: c.mips }),
            discards: self.reflection.discards,
        }
    }

    /// A pass over the whole target.
    pub(super) fn screen(fragment: Arc<Compiled>, diagnostics: Vec<Diagnostic>) -> Self {
        let reflection = fragment.reflection.clone();
        Self { programs: vec![CompiledProgram { vertex: None, fragment }], reflection, diagnostics }
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

/// Adds what a stage reads to what others of the pass read.
fn join(all: &mut Reflection, one: &Reflection) {
    all.uniforms.insert(one.uniforms);
    one.custom_uniforms.iter().for_each(|slot| all.custom_uniforms.insert(slot));
    for (all, one) in all.channels.iter_mut().zip(one.channels) {
        all.texture |= one.texture;
        all.sampler |= one.sampler;
        all.mips |= one.mips;
    }
    all.discards |= one.discards;
    all.geometry |= one.geometry;
}
