//! Lists the declarations of a text outside of functions, in text order.

use super::{analysis::Analysis, symbols::Target};
use crate::{
    ast::{Loc, MacroId},
    hir::{DeclRef, FuncId, GlobalId, GlobalStorage, StructId},
};
use eddy_diag::{SourceId, Span};
use std::ops::Range;

/// One declaration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outlined {
    pub name: String,
    pub kind: OutlineKind,
    /// Its declaration on one line.
    pub detail: String,
    /// The name only.
    pub place: Range<usize>,
    /// The whole declaration, which contains `place`.
    pub whole: Range<usize>,
    /// Members of a struct.
    pub members: Vec<Outlined>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OutlineKind {
    Function,
    Struct,
    Field,
    Constant,
    Global,
    Uniform,
    Macro,
}

impl Analysis {
    /// Returns the functions, structs, variables and macros of a text, in text order. The prototypes of a function with
    /// a definition are left out.
    pub fn outline(&self, source: SourceId) -> Vec<Outlined> {
        let mut found = Vec::new();
        let mut add = |target: Target, kind: OutlineKind, whole: Option<Span>, members: Vec<Outlined>| {
            let Some(place) = self.declaration(target).filter(|span| span.source == source) else { return };
            let range = place.range();
            // A declaration from a macro is shown at its name.
            let around = |span: &Span| span.source == source && span.start <= place.start && place.end <= span.end;
            let whole = whole.filter(around).map_or(range.clone(), Span::range);
            let lines = self.declared_as(target);
            let detail = lines.first().map(|line| line.trim_end_matches(" {").to_owned()).unwrap_or_default();
            let name = self.text_of(place).to_owned();
            found.push(Outlined { name, kind, detail, place: range, whole, members });
        };
        for (i, function) in self.module.functions.iter().enumerate() {
            add(
                Target::Decl(DeclRef::Func(FuncId::new(i))),
                OutlineKind::Function,
                Some(self.whole(function.loc)),
                vec![],
            );
        }
        for (i, def) in self.module.structs.iter().enumerate() {
            let id = StructId::new(i);
            let members = self.members_of(id, source);
            add(Target::Decl(DeclRef::Struct(id)), OutlineKind::Struct, Some(self.whole(def.loc)), members);
        }
        for (i, global) in self.module.globals.iter().enumerate() {
            let kind = match global.storage {
                GlobalStorage::Const => OutlineKind::Constant,
                GlobalStorage::Uniform => OutlineKind::Uniform,
                _ => OutlineKind::Global,
            };
            add(Target::Decl(DeclRef::Global(GlobalId::new(i))), kind, Some(self.whole(global.loc)), vec![]);
        }
        for (i, def) in self.origins.macros.iter().enumerate() {
            add(Target::Macro(MacroId::new(i)), OutlineKind::Macro, def.defined_at, vec![]);
        }
        found.sort_by_key(|one| (one.place.start, one.place.end));
        found.dedup_by(|a, b| a.place == b.place);
        found
    }

    fn members_of(&self, id: StructId, source: SourceId) -> Vec<Outlined> {
        let members = self.module[self.module[id].members].iter().enumerate();
        let member = |index: usize| {
            let target = Target::Decl(DeclRef::Member(id, index as u32));
            let place = self.declaration(target).filter(|span| span.source == source)?;
            Some(Outlined {
                name: self.text_of(place).to_owned(),
                kind: OutlineKind::Field,
                detail: self.declared_as(target).concat(),
                place: place.range(),
                whole: place.range(),
                members: Vec::new(),
            })
        };
        members.filter_map(|(index, _)| member(index)).collect()
    }

    fn whole(&self, loc: Loc) -> Span {
        self.origins.span(loc)
    }
}
