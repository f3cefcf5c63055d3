//! Type inference for complete or incomplete expressions before the caret.
//!
//! Reads tokens, not the tree: the statement at the caret is usually the one that the parser could not parse. It knows
//! less than the checker and reports no errors; an unknown type is `None`.

use super::{
    analysis::{Analysis, Position},
    symbols::Target,
    text::{Directive, Source},
};
use crate::{
    ast::{BasicType, MacroId},
    builtins::Pattern,
    hir::{Builtin, DeclRef, FuncId, Scalar, StructId, Type, TypeId},
    lex::{Kind, words},
};
use std::ops::Range;

/// The limit of nested macros and of nested groups.
const MAX_DEPTH: u32 = 40;

pub(super) struct Infer<'a> {
    a: &'a Analysis,
    text: &'a Source,
    /// The position at which names are looked up.
    at: Position,
    depth: u32,
}

impl<'a> Infer<'a> {
    pub(super) fn new(a: &'a Analysis, source: usize, at: Position) -> Self {
        Self { a, text: &a.sources[source], at, depth: 0 }
    }

    fn nested(&self, source: usize) -> Option<Self> {
        (self.depth < MAX_DEPTH).then(|| Self { text: &self.a.sources[source], depth: self.depth + 1, ..*self })
    }

    /// Returns the type of the operand that ends before token `end`: `a.b[i]`, `f(x).y`, `(a + b)`.
    pub(super) fn before(&self, end: usize) -> Option<TypeId> {
        let start = self.start_of_operand(end)?;
        let (ty, stop) = self.operand(start, end)?;
        (stop == end).then_some(ty)
    }

    fn start_of_operand(&self, end: usize) -> Option<usize> {
        let text = self.text;
        let mut i = end.checked_sub(1)?;
        loop {
            match text.kind(i) {
                Kind::RBracket => {
                    i = text.partner(i)?.checked_sub(1)?;
                    continue;
                }
                Kind::RParen => {
                    let open = text.partner(i)?;
                    i = match open.checked_sub(1) {
                        Some(name) if matches!(text.kind(name), Kind::Ident | Kind::Type) => name,
                        _ => open,
                    };
                }
                Kind::Ident | Kind::Type | Kind::Int | Kind::Uint | Kind::Float => {}
                _ => return None,
            }
            match i.checked_sub(1) {
                Some(dot) if text.kind(dot) == Kind::Dot => i = dot.checked_sub(1)?,
                _ => return Some(i),
            }
        }
    }

    /// Returns the type of a whole expression.
    pub(super) fn expression(&self, range: Range<usize>) -> Option<TypeId> {
        let text = self.text;
        let mut result: Option<TypeId> = None;
        let mut op: Option<Kind> = None;
        let mut i = range.start;
        while i < range.end {
            while matches!(
                text.kind(i),
                Kind::Plus | Kind::Minus | Kind::Bang | Kind::Tilde | Kind::PlusPlus | Kind::MinusMinus
            ) {
                i += 1;
            }
            let (ty, stop) = self.operand(i, range.end)?;
            result = match (result, op) {
                (Some(left), Some(op)) => combine(self.a, op, left, ty),
                _ => Some(ty),
            };
            i = stop;
            if i >= range.end {
                break;
            }
            match text.kind(i) {
                // Both values have the same type.
                Kind::Question => return self.nested(self.at_source())?.expression(i + 1..self.colon(i, range.end)?),
                Kind::Equal | Kind::PlusEqual | Kind::MinusEqual | Kind::StarEqual | Kind::SlashEqual => return result,
                kind => op = Some(kind),
            }
            i += 1;
        }
        result
    }

    fn at_source(&self) -> usize {
        self.a.source_index(self.text.id).unwrap_or(0)
    }

    fn colon(&self, question: usize, end: usize) -> Option<usize> {
        let level = self.text.around(question);
        (question..end).find(|&i| self.text.kind(i) == Kind::Colon && self.text.around(i) == level)
    }

    /// Returns the type of the operand that starts at a token, and the token after it.
    fn operand(&self, start: usize, end: usize) -> Option<(TypeId, usize)> {
        let text = self.text;
        let token = *text.tokens.get(start)?;
        let next = start + 1;
        let called = next < end && text.kind(next) == Kind::LParen;
        let (mut ty, mut i) = match token.kind {
            Kind::Int => (TypeId::INT, next),
            Kind::Uint => (TypeId::UINT, next),
            Kind::Float => (TypeId::FLOAT, next),
            Kind::True | Kind::False => (TypeId::BOOL, next),
            Kind::LParen => {
                let close = text.partner(start)?;
                (self.nested(self.at_source())?.expression(next..close)?, close + 1)
            }
            Kind::Type if called => (TypeId::basic(words::basic_type(token.value)), text.partner(next)? + 1),
            Kind::Ident if called => {
                let close = text.partner(next)?;
                (self.call(start, next, close)?, close + 1)
            }
            Kind::Ident => (self.name(start)?, next),
            _ => return None,
        };
        while i < end {
            match text.kind(i) {
                Kind::Dot if i + 1 < end => {
                    let name = i + 1;
                    if text.kind(name + 1) == Kind::LParen && name + 1 < end {
                        ty = TypeId::INT;
                        i = text.partner(name + 1)? + 1;
                        continue;
                    }
                    // `iCh0` has no type of its own.
                    let is_name = i == next && token.kind == Kind::Ident;
                    let channel = is_name.then(|| self.a.look_up(token.symbol(), self.at, false)).flatten();
                    ty = match channel {
                        Some(Target::Decl(DeclRef::ChannelStruct(channel))) => {
                            self.a.channel_member_type(channel, text.text_of(name))?
                        }
                        _ => self.a.member_type(ty, text.text_of(name))?,
                    };
                    i = name + 1;
                }
                Kind::LBracket => {
                    ty = self.a.module.types.element(ty)?;
                    i = text.partner(i)? + 1;
                }
                Kind::PlusPlus | Kind::MinusMinus => i += 1,
                _ => break,
            }
        }
        Some((ty, i))
    }

    fn name(&self, token: usize) -> Option<TypeId> {
        match self.a.look_up(self.text.tokens[token].symbol(), self.at, false)? {
            Target::Macro(id) => self.replacement(id),
            target => self.a.type_of(target),
        }
    }

    /// Returns the type of a macro's replacement list.
    fn replacement(&self, id: MacroId) -> Option<TypeId> {
        let def = self.a.origins[id];
        let (name, whole) = (def.name_at?, def.defined_at?);
        let source = self.a.source_index(whole.source)?;
        let text = &self.a.sources[source];
        let mut start = text.token_of(name)? + 1;
        if def.function_like {
            start = text.partner(start)? + 1;
        }
        let end = text.first_from(whole.end as usize);
        let is_list = text.tokens.get(start..end)?.iter().all(|t| t.directive == Directive::Body);
        if !is_list {
            return None;
        }
        self.nested(source)?.expression(start..end)
    }

    fn call(&self, name: usize, open: usize, close: usize) -> Option<TypeId> {
        let symbol = self.text.tokens[name].symbol();
        match self.a.look_up(symbol, self.at, true)? {
            Target::Macro(id) => self.replacement(id),
            Target::Decl(DeclRef::Struct(id)) => Some(self.a.module[id].ty),
            Target::Decl(DeclRef::Func(first)) => {
                let args = self.arguments(open, close);
                let all: Vec<FuncId> = self.a.overloads_of(symbol, self.at).collect();
                Some(self.a.module[self.best(&all, &args).unwrap_or(first)].result)
            }
            Target::Decl(DeclRef::Builtin(builtin)) => self.builtin(builtin, &self.arguments(open, close)),
            _ => None,
        }
    }

    /// Returns the types of arguments; the error type if unknown.
    pub(super) fn arguments(&self, open: usize, close: usize) -> Vec<TypeId> {
        let Some(deeper) = self.nested(self.at_source()) else { return Vec::new() };
        let ranges = arguments(self.text, open, close);
        ranges.into_iter().map(|range| deeper.expression(range).unwrap_or(TypeId::ERROR)).collect()
    }

    /// Returns the overload that matches the arguments best: the right number, and most of the right types.
    pub(super) fn best(&self, all: &[FuncId], args: &[TypeId]) -> Option<FuncId> {
        all.iter().copied().rev().max_by_key(|&id| {
            let params = self.a.module.params(id);
            let fitting = params.iter().zip(args).filter(|(p, arg)| p.ty == **arg).count();
            (params.len() == args.len(), params.len() >= args.len(), fitting)
        })
    }

    fn builtin(&self, builtin: Builtin, args: &[TypeId]) -> Option<TypeId> {
        let types = &self.a.module.types;
        let all = builtin.overloads;
        if let Some(ty) = all.iter().find_map(|o| o.result_for(args, types)) {
            return Some(ty);
        }
        // With an unknown argument: most results have the size of the largest known one.
        let overload = all.iter().find(|o| o.params.len() >= args.len())?;
        let size =
            args.iter().filter(|ty| types.scalar(**ty).is_some()).filter_map(|ty| types.components(*ty)).max()?;
        match overload.result {
            Pattern::Exactly(ty) => Some(ty),
            Pattern::Gen(scalar) | Pattern::Vector(scalar) if size <= 4 => Some(TypeId::vector(scalar, size as u8)),
            Pattern::Texel => Some(TypeId::VEC4),
            _ => None,
        }
    }
}

/// Returns the arguments between two parentheses, as ranges of tokens; empty if there are none.
pub(super) fn arguments(text: &Source, open: usize, close: usize) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = open + 1;
    for i in open + 1..close {
        if text.kind(i) == Kind::Comma && text.around(i) == Some(open) {
            found.push(start..i);
            start = i + 1;
        }
    }
    if start < close {
        found.push(start..close);
    }
    found
}

/// Returns the type of a binary operator's result.
fn combine(a: &Analysis, op: Kind, left: TypeId, right: TypeId) -> Option<TypeId> {
    let types = &a.module.types;
    match op {
        Kind::Less
        | Kind::Greater
        | Kind::LessEqual
        | Kind::GreaterEqual
        | Kind::EqualEqual
        | Kind::BangEqual
        | Kind::AndAnd
        | Kind::OrOr
        | Kind::CaretCaret => return Some(TypeId::BOOL),
        Kind::Comma => return Some(right),
        _ => {}
    }
    Some(match (types.get(left), types.get(right)) {
        (Type::Matrix { rows, .. }, Type::Vector { .. }) if op == Kind::Star => TypeId::vector(Scalar::Float, rows),
        (Type::Vector { .. }, Type::Matrix { columns, .. }) if op == Kind::Star => {
            TypeId::vector(Scalar::Float, columns)
        }
        (Type::Matrix { rows, .. }, Type::Matrix { columns, .. }) if op == Kind::Star => TypeId::matrix(columns, rows),
        (Type::Scalar(_), Type::Vector { .. } | Type::Matrix { .. }) => right,
        _ => left,
    })
}

impl Analysis {
    /// Returns the type of a variable or field.
    pub(super) fn type_of(&self, target: Target) -> Option<TypeId> {
        let Target::Decl(target) = target else {
            return matches!(target, Target::DeprecatedTime).then_some(TypeId::FLOAT);
        };
        Some(match target {
            DeclRef::Local(id) => self.module[id].ty,
            DeclRef::Global(id) => self.module[id].ty,
            DeclRef::Member(id, index) => self.module[self.module[id].members].get(index as usize)?.ty,
            DeclRef::Uniform(uniform) => self.uniform_types[uniform as usize],
            DeclRef::CustomUniform(i) => self.custom_uniforms.get(usize::from(i))?.1,
            DeclRef::Channel(i) => self.channel_type(i),
            DeclRef::BuiltinVar(var) => var.ty(),
            DeclRef::BuiltinConst(_) => TypeId::INT,
            // Only its members have types; it has none in the module.
            DeclRef::ChannelStruct(_) => TypeId::ERROR,
            DeclRef::Func(_) | DeclRef::Struct(_) | DeclRef::Builtin(_) => return None,
        })
    }

    /// Returns the type of `iChannelN`.
    pub(super) fn channel_type(&self, channel: u8) -> TypeId {
        use crate::ChannelKind as C;
        TypeId::basic(match self.channels[usize::from(channel)] {
            C::Sampler1D => BasicType::Sampler1D,
            C::Sampler2D => BasicType::Sampler2D,
            C::Sampler3D => BasicType::Sampler3D,
            C::SamplerCube => BasicType::SamplerCube,
        })
    }

    fn channel_member_type(&self, channel: u8, name: &str) -> Option<TypeId> {
        match name {
            "sampler" => Some(self.channel_type(channel)),
            "size" => Some(TypeId::VEC3),
            "time" => Some(TypeId::FLOAT),
            "loaded" => Some(TypeId::INT),
            _ => None,
        }
    }

    /// Returns the structure that a type is.
    pub(super) fn struct_of(&self, ty: TypeId) -> Option<StructId> {
        match self.module.types.get(ty) {
            Type::Struct(id) => Some(id),
            _ => None,
        }
    }

    /// Returns the type of `.name` of a value.
    fn member_type(&self, ty: TypeId, name: &str) -> Option<TypeId> {
        match self.module.types.get(ty) {
            Type::Struct(id) => {
                let members = &self.module[self.module[id].members];
                members.iter().find(|m| self.names.get(m.name.symbol) == name).map(|m| m.ty)
            }
            Type::Vector { scalar, .. } if (1..=4).contains(&name.len()) => {
                Some(TypeId::vector(scalar, name.len() as u8))
            }
            _ => None,
        }
    }
}
