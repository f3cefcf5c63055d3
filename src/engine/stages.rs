//! A pass out of the compiler, whether it is one full-screen program or the programs of several meshes.

use super::Sources;
use crate::{
    diag::Diagnostic,
    glsl::{self, Compiled, Driver, Link, PassKind, PassSource, Reflection, interface},
    gpu::Shader,
    project::{Geometry, Stage},
};
use std::collections::HashMap;

/// A pass that compiled.
pub struct CompiledPass {
    /// One, or one for each mesh the pass draws.
    pub(super) programs: Vec<CompiledProgram>,
    /// Of all programs together.
    pub reflection: Reflection,
    /// Warnings and notes; never an error.
    pub diagnostics: Vec<Diagnostic>,
}

/// One program of a pass.
pub(super) struct CompiledProgram {
    /// `None`: the triangle over the whole target.
    pub vertex: Option<Compiled>,
    pub fragment: Compiled,
}

/// What the device is given of a stage.
pub(super) fn shader(compiled: Compiled) -> Shader {
    Shader { module: compiled.module, filled_arrays: compiled.filled_arrays }
}

impl CompiledProgram {
    /// Bytes of the constant tables of both stages, by their bindings; only those there are.
    pub fn tables(&self) -> impl Iterator<Item = (u32, &[u8])> {
        let vertex = self.vertex.as_ref().map(|v| (interface::VERTEX_TABLE_BINDING, &v.uniform_tables[..]));
        let fragment = [
            (interface::TABLE_BINDING, &self.fragment.tables[..]),
            (interface::UNIFORM_TABLE_BINDING, &self.fragment.uniform_tables[..]),
        ];
        fragment.into_iter().chain(vertex).filter(|(_, bytes)| !bytes.is_empty())
    }

    /// Bytes of the author's own uniforms that it reads.
    pub fn knob_bytes(&self) -> u64 {
        self.vertex.as_ref().map_or(0, |v| v.knob_bytes).max(self.fragment.knob_bytes)
    }
}

impl CompiledPass {
    /// A pass over the whole target.
    pub(super) fn screen(mut compiled: Compiled) -> Self {
        let diagnostics = std::mem::take(&mut compiled.diagnostics);
        let reflection = compiled.reflection.clone();
        Self { programs: vec![CompiledProgram { vertex: None, fragment: compiled }], reflection, diagnostics }
    }
}

/// Adds what a stage reads to what others of the pass read.
fn join(all: &mut Reflection, one: &Reflection) {
    all.uniforms.insert(one.uniforms);
    one.knobs.iter().for_each(|slot| all.knobs.insert(slot));
    for (all, one) in all.channels.iter_mut().zip(one.channels) {
        all.texture |= one.texture;
        all.sampler |= one.sampler;
        all.mips |= one.mips;
    }
    all.discards |= one.discards;
    all.geometry |= one.geometry;
}

type Result<T> = std::result::Result<T, Vec<Diagnostic>>;

impl Sources<'_> {
    /// Compiles the program of every draw; each text once for each partner it has.
    pub(super) fn compile_geometry(
        &self,
        index: usize,
        geometry: &Geometry,
        bilinear_by_hand: [bool; 4],
        driver: Driver,
    ) -> Result<CompiledPass> {
        let compile = |stage: Stage, kind: PassKind, link: &Link<'_>| -> Result<Compiled> {
            // A vertex stage can read no storage buffer on every device.
            let tables_in_memory = driver.tables_in_memory || kind == PassKind::Vertex;
            let driver = Driver { tables_in_memory, ..driver };
            self.with_source(index, self.stage_id(index, stage), kind, |source| {
                glsl::compile_linked(&PassSource { bilinear_by_hand, driver, ..*source }, link)
            })
        };
        let mut vertices: HashMap<Stage, Result<Compiled>> = HashMap::new();
        let mut fragments: HashMap<(Stage, Stage), Result<Compiled>> = HashMap::new();
        let mut pass =
            CompiledPass { programs: Vec::new(), reflection: Reflection::default(), diagnostics: Vec::new() };
        for draw in &geometry.draws {
            let vertex =
                vertices.entry(draw.vertex).or_insert_with(|| compile(draw.vertex, PassKind::Vertex, &Link::default()));
            let varyings = vertex.as_ref().ok().map(|v| v.reflection.varyings.clone());
            let fragment = fragments.entry((draw.vertex, draw.fragment)).or_insert_with(|| {
                let link = Link { varyings: varyings.as_deref(), targets: Some(self.targets(index)) };
                compile(draw.fragment, PassKind::Fragment, &link)
            });
            for stage in [&*vertex, &*fragment] {
                let said = match stage {
                    Ok(compiled) => &compiled.diagnostics,
                    Err(errors) => errors,
                };
                for diagnostic in said {
                    if !pass.diagnostics.contains(diagnostic) {
                        pass.diagnostics.push(diagnostic.clone());
                    }
                }
            }
            if let (Ok(vertex), Ok(fragment)) = (vertex, fragment) {
                join(&mut pass.reflection, &vertex.reflection);
                join(&mut pass.reflection, &fragment.reflection);
                pass.programs.push(CompiledProgram { vertex: Some(vertex.clone()), fragment: fragment.clone() });
            }
        }
        if pass.diagnostics.iter().any(Diagnostic::is_error) { Err(pass.diagnostics) } else { Ok(pass) }
    }
}
