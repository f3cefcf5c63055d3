//! Signature help: the parameters of the call that is being written, and the argument at the caret.

use super::{
    analysis::{Analysis, Position},
    infer::Infer,
    show,
    symbols::Target,
    text::Source,
};
use crate::{
    builtins::Overload,
    hir::{DeclRef, FuncId, StructId, Type, TypeId},
    lex::{Kind, words},
};
use eddy_diag::SourceId;
use std::ops::Range;

/// One signature.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    pub label: String,
    /// The range of each parameter in the label, in bytes.
    pub params: Vec<Range<usize>>,
}

/// The call around a caret.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SignatureHelp {
    /// Every overload.
    pub signatures: Vec<Signature>,
    /// The overload that best matches the arguments so far.
    pub active: usize,
    /// The argument at the caret, from 0.
    pub parameter: usize,
    /// The description of the function; may be empty.
    pub doc: String,
    /// The start of the called name.
    pub name_start: usize,
}

impl Analysis {
    /// Returns the innermost call whose parentheses contain `offset`.
    pub fn signature_help(&self, source: SourceId, offset: usize) -> Option<SignatureHelp> {
        let source = self.source_index(source)?;
        let text = &self.sources[source];
        if text.is_comment(offset) || text.is_inactive(offset) {
            return None;
        }
        let (mut before, mut from) = (text.first_from(offset), offset);
        // A token that contains the caret is not before it.
        if let Some(last) = before.checked_sub(1)
            && text.tokens[last].end as usize > offset
        {
            before = last;
        }
        loop {
            let (open, commas) = enclosing(text, before)?;
            if let Some(help) = self.call_at(source, open, commas, before.max(open + 1)) {
                return Some(help);
            }
            if from == open {
                return None;
            }
            (before, from) = (open, open);
        }
    }

    /// Returns the call whose parenthesis is token `open`; `stop` is the token after the caret.
    fn call_at(&self, source: usize, open: usize, parameter: usize, stop: usize) -> Option<SignatureHelp> {
        let text = &self.sources[source];
        let name = open.checked_sub(1)?;
        let word = text.tokens[name];
        let at: Position = (source, word.start);
        // A header declares its parameters: the name is preceded by a type.
        let declares = name > 0
            && match text.kind(name - 1) {
                Kind::Type => true,
                Kind::Ident => !word.starts_line,
                _ => false,
            };
        if declares {
            return None;
        }
        let infer = Infer::new(self, source, at);
        let args = infer.arguments(open, stop);
        let help = |signatures: Vec<Signature>, active, doc: String| {
            let name_start = word.start as usize;
            (!signatures.is_empty()).then_some(SignatureHelp { signatures, active, parameter, doc, name_start })
        };
        match word.kind {
            Kind::Type => {
                let signatures = constructors(TypeId::basic(words::basic_type(word.value)), &self.module.types);
                let active = signatures.iter().position(|s| s.params.len() > parameter).unwrap_or(0);
                help(signatures, active, String::new())
            }
            Kind::Ident => match self.look_up(word.symbol(), at, true)? {
                Target::Macro(id) => {
                    let params = self.macro_params(id)?;
                    let (label, params) = show::call_text(self.names.get(word.symbol()), &params);
                    let doc = self.declaration(Target::Macro(id)).map(|at| self.comment_above(at)).unwrap_or_default();
                    help(vec![Signature { label, params }], 0, doc)
                }
                Target::Decl(DeclRef::Struct(id)) => help(vec![self.struct_constructor(id)], 0, String::new()),
                Target::Decl(DeclRef::Func(_)) => {
                    let all: Vec<FuncId> = self.overloads_of(word.symbol(), at).collect();
                    let best = infer.best(&all, &args).filter(|&id| self.module.params(id).len() > parameter);
                    let best =
                        best.or_else(|| all.iter().copied().find(|&id| self.module.params(id).len() > parameter));
                    let active = best.and_then(|id| all.iter().position(|&other| other == id)).unwrap_or(0);
                    let doc = self.declaration(Target::Decl(DeclRef::Func(all[active])));
                    let doc = doc.map(|at| self.comment_above(at)).unwrap_or_default();
                    let signatures = all.iter().map(|&id| self.function_text(id));
                    help(signatures.map(|(label, params)| Signature { label, params }).collect(), active, doc)
                }
                Target::Decl(DeclRef::Builtin(builtin)) => {
                    let all: Vec<&Overload> = builtin.overloads.iter().filter(|o| !o.is_one_dimensional()).collect();
                    let types = &self.module.types;
                    // The arguments before the one at the caret are complete.
                    let whole = &args[..args.len().min(parameter)];
                    let takes = |o: &Overload| o.params.len() > parameter && o.accepts_first(whole, types);
                    let best = all.iter().position(|o| takes(o));
                    let active = best.or_else(|| all.iter().position(|o| o.params.len() > parameter)).unwrap_or(0);
                    let signatures = all.iter().map(|o| show::overload_text(builtin, o));
                    let signatures = signatures.map(|(label, params)| Signature { label, params }).collect();
                    help(signatures, active, builtin.text.to_owned())
                }
                _ => None,
            },
            _ => None,
        }
    }

    fn struct_constructor(&self, id: StructId) -> Signature {
        let def = self.module[id];
        let members = self.module[def.members].iter();
        let params: Vec<String> =
            members.map(|m| format!("{} {}", self.type_name(m.ty), self.names.get(m.name.symbol))).collect();
        let (label, params) = show::call_text(def.name.map_or("struct", |n| self.names.get(n.symbol)), &params);
        Signature { label, params }
    }
}

/// Returns the open parenthesis around the position before token `before`, and the number of commas between them.
fn enclosing(text: &Source, before: usize) -> Option<(usize, usize)> {
    let mut commas = 0;
    let mut i = before;
    while i > 0 {
        i -= 1;
        match text.kind(i) {
            // Skip a whole group.
            Kind::RParen | Kind::RBracket => i = text.partner(i).filter(|&open| open < i).unwrap_or(i),
            Kind::LParen => return Some((i, commas)),
            Kind::LBracket => commas = 0,
            Kind::Comma => commas += 1,
            Kind::Semicolon | Kind::LBrace | Kind::RBrace => return None,
            _ => {}
        }
    }
    None
}

/// Returns the usual constructors of a keyword type.
fn constructors(ty: TypeId, types: &crate::hir::TypeTable) -> Vec<Signature> {
    let Some(basic) = ty.as_basic() else { return Vec::new() };
    let one = |params: &[&str]| {
        let params: Vec<String> = params.iter().map(|p| (*p).to_owned()).collect();
        let (label, params) = show::call_text(basic.name(), &params);
        Signature { label, params }
    };
    let lists: &[&[&str]] = match types.get(ty) {
        Type::Scalar(_) => &[&["x"]],
        Type::Vector { size: 2, .. } => &[&["x"], &["x", "y"]],
        Type::Vector { size: 3, .. } => &[&["x"], &["x", "y", "z"], &["xy", "z"], &["x", "yz"]],
        Type::Vector { .. } => &[&["x"], &["x", "y", "z", "w"], &["xyz", "w"], &["xy", "zw"], &["x", "yzw"]],
        Type::Matrix { columns: 2, rows: 2 } => {
            &[&["diagonal"], &["column0", "column1"], &["m00", "m01", "m10", "m11"]]
        }
        Type::Matrix { columns: 2, .. } => &[&["diagonal"], &["column0", "column1"]],
        Type::Matrix { columns: 3, .. } => &[&["diagonal"], &["column0", "column1", "column2"]],
        Type::Matrix { .. } => &[&["diagonal"], &["column0", "column1", "column2", "column3"]],
        _ => &[],
    };
    lists.iter().map(|params| one(params)).collect()
}
