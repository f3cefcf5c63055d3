//! A project's stages as analysed for an editor, cached while the inputs of the analysis are unchanged.

use super::{
    Sources,
    preamble::PreambleCache,
    stage_cache::{CacheMiss, DiagnosticsCache},
};
use eddy_diag::{self as diag, Diagnostic};
use eddy_glsl::{Driver, Link, services::Analysis};
use eddy_project::{FillKind, Project, Stage};
use std::sync::Arc;

/// The analysis of a stage of a pass.
#[derive(Clone, Debug)]
pub struct StageAnalysis {
    /// The index in [`Project::passes`].
    pub index: usize,
    pub stage: Stage,
    pub analysis: Arc<Analysis>,
}

/// The analyses of every stage of a project, for callers that repeat them after each edit.
#[derive(Default)]
pub struct AnalysisCache {
    kept: Vec<(CacheMiss, Arc<Analysis>)>,
    preamble: PreambleCache,
    /// The stages of passes that draw meshes: the outputs of a vertex stage are known only after compiling it.
    stages: DiagnosticsCache,
}

impl AnalysisCache {
    /// Analyses every stage of every pass, except those that have not changed since the last call.
    pub fn analyse(&mut self, project: &Project, texts: &Sources<'_>) -> Vec<StageAnalysis> {
        self.preamble.provide_to(texts);
        let before = std::mem::take(&mut self.kept);
        let mut found = Vec::new();
        for (index, pass) in project.passes.iter().enumerate() {
            for stage in pass.body.texts() {
                let key = texts.with_stage(index, stage, |source| {
                    CacheMiss::new(source, &Link::default(), |text| texts.shared(text))
                });
                let known = before.iter().find(|(other, _)| *other == key).map(|(_, analysis)| analysis.clone());
                let analysis = known.unwrap_or_else(|| Arc::new(texts.analyse_stage(index, stage)));
                self.kept.push((key, analysis.clone()));
                found.push(StageAnalysis { index, stage, analysis });
            }
        }
        self.preamble.update_from(texts);
        found
    }

    /// Returns all diagnostics of the compiler for Common alone, every pass and its fills, without duplicates. `read`
    /// is the result of [`Self::analyse`] for the same texts.
    pub fn diagnose(&mut self, project: &Project, texts: &Sources<'_>, read: &[StageAnalysis]) -> Vec<Diagnostic> {
        let mut found: Vec<Diagnostic> = texts.diagnostics.clone();
        found.extend(texts.check_common());
        for (index, pass) in project.passes.iter().enumerate() {
            if !pass.body.is_screen() {
                match self.stages.compile(texts, index) {
                    Ok(pass) => diag::append(&mut found, pass.diagnostics),
                    Err(errors) => diag::append(&mut found, errors),
                }
            } else if let Some(own) = read.iter().find(|one| one.index == index) {
                diag::append(&mut found, own.analysis.diagnostics().iter().cloned());
            }
            for kind in FillKind::ALL {
                match texts.compile_fill(index, kind, false, Driver::default()) {
                    Some(Ok(fill)) => diag::append(&mut found, fill.diagnostics),
                    Some(Err(errors)) => diag::append(&mut found, errors),
                    None => {}
                }
            }
        }
        found
    }
}
