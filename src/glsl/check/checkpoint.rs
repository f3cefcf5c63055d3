//! The state of the checker between two declarations of a file, from which checking other texts can continue.
//!
//! It contains only what varies at file scope: there, no function is being checked, and no error has been reported.

use super::{
    facts::{FuncFacts, TypeFacts, basic_facts},
    fault::Fault,
    scope::Scopes,
};
use crate::{
    ast::{BasicType, Precision, Symbol},
    hir::{self, ConstId, FuncId, Module, StructId, TypeId},
};
use eddy_diag::Diagnostic;
use rustc_hash::FxHashMap;

/// The precisions in force, by [`BasicType`].
pub(super) type Precisions = [Option<Precision>; BasicType::ALL.len()];

#[derive(Clone)]
pub(crate) struct Checkpoint {
    /// The number of [`super::Ast::items`] checked so far.
    pub(super) items: usize,
    pub(super) module: Module,
    pub(super) diagnostics: Vec<Diagnostic>,
    pub(super) faults: Vec<Fault>,
    pub(super) scopes: Scopes,
    pub(super) lowered: Vec<Option<hir::ExprId>>,
    pub(super) facts: Vec<TypeFacts>,
    pub(super) members: FxHashMap<(StructId, Symbol), (usize, usize)>,
    pub(super) funcs: Vec<FuncFacts>,
    pub(super) overloads: FxHashMap<(FuncId, Vec<TypeId>), FuncId>,
    pub(super) folded_words: usize,
    pub(super) precisions: Precisions,
    pub(super) global_calls: Vec<FuncId>,
    pub(super) depth_range: Option<ConstId>,
}

impl Checkpoint {
    /// Returns the initial state: nothing is checked, and nothing is in scope.
    pub(super) fn nothing() -> Self {
        let module = Module::default();
        // Section 4.5.4, and the precision of 3D samplers in Shadertoy's header.
        let mut precisions = [None; BasicType::ALL.len()];
        for (basic, precision) in [
            (BasicType::Float, Precision::High),
            (BasicType::Int, Precision::High),
            (BasicType::Sampler2D, Precision::Low),
            (BasicType::SamplerCube, Precision::Low),
            (BasicType::Sampler3D, Precision::Medium),
        ] {
            precisions[basic as usize] = Some(precision);
        }
        let facts = basic_facts(&module.types);
        Self {
            items: 0,
            module,
            diagnostics: Vec::new(),
            faults: Vec::new(),
            scopes: Scopes::default(),
            lowered: Vec::new(),
            facts,
            members: FxHashMap::default(),
            funcs: Vec::new(),
            overloads: FxHashMap::default(),
            folded_words: 0,
            precisions,
            global_calls: Vec::new(),
            depth_range: None,
        }
    }
}
