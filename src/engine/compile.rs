//! Compiles a project's texts to passes.

use super::{
    Sources,
    compiled::CompiledPass,
    fill_text,
    stage_cache::{self, StageCache},
};
use eddy_diag::{Diagnostic, Span};
use eddy_glsl::{
    self as glsl, Compiled, Driver, Link, MAX_CHANNELS, PassKind, PassSource, Probe, Reflection, count::Counting,
};
use eddy_project::{Body, FillKind, Geometry, Stage};
use std::sync::Arc;

type Result<T> = std::result::Result<T, Vec<Diagnostic>>;

/// The settings of a pass that its texts do not contain.
#[derive(Clone, Copy, Default)]
pub(super) struct PassOptions {
    pub bilinear_in_shader: [bool; MAX_CHANNELS],
    pub driver: Driver,
    /// A value that the pass draws too.
    pub probe: Option<Probe>,
    /// True if the pass is drawn in tiles.
    pub tiled: bool,
}

impl Sources<'_> {
    /// Compiles `project.passes[index]`, whatever its kind and whether or not it is needed, for a device that filters
    /// every channel. Needs no device, but the properties of its driver.
    ///
    /// # Panics
    /// If there is no such pass.
    pub fn compile_pass(&self, index: usize, driver: Driver) -> Result<CompiledPass> {
        let options = PassOptions { driver, ..PassOptions::default() };
        self.compile_pass_with(&mut StageCache::default(), index, options)
    }

    /// Compiles the fill of `project.passes[index]`, if there is one. It sees Common, and only those of the author's
    /// own uniforms that Common declares. A file is the input of its one channel.
    pub fn compile_fill(
        &self,
        index: usize,
        kind: FillKind,
        bilinear_in_shader: bool,
        driver: Driver,
    ) -> Option<Result<CompiledPass>> {
        let bilinear_in_shader = std::array::from_fn(|channel| channel == 0 && bilinear_in_shader);
        let options = PassOptions { bilinear_in_shader, driver, ..PassOptions::default() };
        self.compile_fill_with(&mut StageCache::default(), index, kind, options)
    }

    /// Compiles every pass, each followed by its fills, like [`Self::compile_pass`] and [`Self::compile_fill`], for one
    /// driver.
    pub fn compile_all(&self, driver: Driver) -> Vec<Result<CompiledPass>> {
        let mut cache = StageCache::default();
        let options = PassOptions { driver, ..PassOptions::default() };
        let passes = 0..self.project.passes.len();
        self.compile_ahead(&mut cache, passes.clone().map(|index| (index, options)));
        let mut outcomes = Vec::new();
        for index in passes {
            outcomes.push(self.compile_pass_with(&mut cache, index, options));
            let fills = FillKind::ALL.into_iter();
            outcomes.extend(fills.filter_map(|kind| self.compile_fill_with(&mut cache, index, kind, options)));
        }
        outcomes
    }

    /// Does the same as [`Self::compile_pass`], reusing the stages of earlier builds.
    pub(super) fn compile_pass_with(
        &self,
        cache: &mut StageCache,
        index: usize,
        options: PassOptions,
    ) -> Result<CompiledPass> {
        let pass = &self.project.passes[index];
        match &pass.body {
            Body::Screen => self.compile_screen(cache, index, options),
            Body::Meshes(geometry) => self.compile_meshes(cache, index, geometry, options),
        }
    }

    fn compile_screen(&self, cache: &mut StageCache, index: usize, options: PassOptions) -> Result<CompiledPass> {
        let (id, kind) = (self.stage_id(index, Stage::Own), self.own_kind(index));
        let link = Link::default();
        let (fragment, said) = self.with_source(index, id, kind, |source| self.compile(cache, source, &link, options));
        CompiledPass::screen(fragment, said)
    }

    /// Returns the name of the function with most of the code of `project.passes[index]`; for a pass of meshes, of its
    /// first fragment stage.
    pub(super) fn largest_function(&self, index: usize) -> Option<Span> {
        let pass = &self.project.passes[index];
        let (stage, kind) = match &pass.body {
            Body::Screen => (Stage::Own, self.own_kind(index)),
            Body::Meshes(geometry) => (geometry.draws.first()?.fragment, PassKind::Fragment),
        };
        self.with_source(index, self.stage_id(index, stage), kind, glsl::largest_function)
    }

    /// Does the same as [`Self::compile_fill`], reusing the stages of earlier builds.
    pub(super) fn compile_fill_with(
        &self,
        cache: &mut StageCache,
        index: usize,
        kind: FillKind,
        options: PassOptions,
    ) -> Option<Result<CompiledPass>> {
        let value = &self.project.passes[index].fill(kind)?.value;
        let text = fill_text::FillSource::new(value, self.fill_text(index, kind)?);
        let (fragment, said) =
            self.with_fill(text.code(), text.value(), |source| self.compile(cache, source, &Link::default(), options));
        Some(CompiledPass::screen(fragment, text.relocated(said)))
    }

    /// Compiles the program of every draw; each text once per partner stage.
    fn compile_meshes(
        &self,
        cache: &mut StageCache,
        index: usize,
        geometry: &Geometry,
        options: PassOptions,
    ) -> Result<CompiledPass> {
        let mut compile = |stage: Stage, kind: PassKind, link: &Link<'_>| {
            let mut options = options;
            // Not every device lets a vertex stage read a storage buffer.
            options.driver.tables_in_memory |= kind == PassKind::Vertex;
            self.with_source(index, self.stage_id(index, stage), kind, |source| {
                self.compile(cache, source, link, options)
            })
        };
        let targets = Some(self.project.passes[index].formats().len());
        let mut pass =
            CompiledPass { programs: Vec::new(), reflection: Reflection::default(), diagnostics: Vec::new() };
        for draw in &geometry.draws {
            let (vertex, of_vertex) = compile(draw.vertex, PassKind::Vertex, &Link::default());
            let link = Link { varyings: vertex.as_ref().map(|v| &v.reflection.varyings[..]), targets };
            let (fragment, of_fragment) = compile(draw.fragment, PassKind::Fragment, &link);
            for diagnostic in of_vertex.into_iter().chain(of_fragment) {
                if !pass.diagnostics.contains(&diagnostic) {
                    pass.diagnostics.push(diagnostic);
                }
            }
            if let (Some(vertex), Some(fragment)) = (vertex, fragment) {
                pass.add_mesh(vertex, fragment);
            }
        }
        if pass.diagnostics.iter().any(Diagnostic::is_error) { Err(pass.diagnostics) } else { Ok(pass) }
    }

    /// Compiles the counting variants of `project.passes[index]`, which draws no meshes; see [`Counting::new`].
    ///
    /// # Panics
    /// If there is no such pass.
    pub(super) fn counting(&self, index: usize, options: PassOptions, per_draw: usize) -> Result<Counting> {
        let (id, kind) = (self.stage_id(index, Stage::Own), self.own_kind(index));
        let PassOptions { bilinear_in_shader, driver, .. } = options;
        self.with_source(index, id, kind, |source| {
            let source = PassSource { bilinear_in_shader, driver, ..*source };
            Counting::new(&source, &Link::default(), self.preamble(), per_draw)
        })
    }

    fn compile(
        &self,
        cache: &mut StageCache,
        source: &PassSource<'_>,
        link: &Link<'_>,
        options: PassOptions,
    ) -> (Option<Arc<Compiled>>, Vec<Diagnostic>) {
        let PassOptions { bilinear_in_shader, driver, probe, tiled } = options;
        let source = PassSource { bilinear_in_shader, driver, probe, tiled, ..*source };
        match cache.find(&source, link, |text| self.shared(text)) {
            Ok(found) => found,
            Err(missing) => cache.add(missing, stage_cache::compile(&source, link, self.preamble())),
        }
    }
}
