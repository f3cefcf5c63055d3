//! Completion: the names and words that are valid at the caret.

use super::{
    analysis::{Analysis, Position},
    docs,
    infer::Infer,
    rank, show,
    symbols::Target,
    text::{Directive, Source},
};
use crate::{
    ast::{BasicType, MacroId, Symbol},
    check::env::{self, Env},
    hir::{Builtin, DeclRef, FuncId, GlobalId, GlobalStorage, LocalKind, Scalar, StructId, Type, TypeId, Uniform},
    lex::{Kind as Token, words},
    near,
    source::PassKind,
};
use eddy_diag::SourceId;
use std::{collections::HashSet, ops::Range};

/// The kind of a completion, for an icon next to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CompletionKind {
    Local,
    Parameter,
    Global,
    Constant,
    Function,
    Struct,
    Field,
    Macro,
    Builtin,
    /// A uniform, channel or variable that is predefined by Shadertoy or the language.
    Uniform,
    Type,
    Keyword,
}

/// One completion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// The text that is shown, and that replaces the typed part.
    pub label: String,
    pub kind: CompletionKind,
    /// Its type, or signature; may be empty.
    pub detail: String,
    /// Explanation; may be empty.
    pub doc: String,
    /// Smaller ranks higher among equally good matches.
    order: u32,
}

/// The completions at a caret.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Completions {
    /// Bytes of the text that a completion replaces: the word's part before the caret.
    pub replace: Range<usize>,
    /// All completions, not filtered by what was typed.
    pub items: Vec<Completion>,
    /// The caret is after a `.`.
    pub is_member: bool,
}

impl Completions {
    /// Returns the indices of the items that match `typed`, best first; if none does, of those that `typed` may be a
    /// misspelling of.
    pub fn matching(&self, typed: &str) -> Vec<usize> {
        let fits = self.items.iter().enumerate();
        let mut found: Vec<(u32, u32, &str, usize)> = fits
            .filter_map(|(i, item)| Some((rank::misfit(typed, &item.label)?, item.order, item.label.as_str(), i)))
            .collect();
        if found.is_empty()
            && typed.len() > 2
            && let Some(near) = near::nearest_identifier(typed, self.items.iter().map(|item| item.label.as_str()))
        {
            return self.items.iter().position(|item| item.label == near).into_iter().collect();
        }
        found.sort_unstable();
        found.into_iter().map(|f| f.3).collect()
    }
}

impl Analysis {
    /// Returns the completions at `offset` of a text. None in comments, in skipped text, in numbers, and where a new
    /// name is being declared.
    pub fn completions(&self, source: SourceId, offset: usize) -> Completions {
        let none = Completions { replace: offset..offset, ..Completions::default() };
        let Some(source) = self.source_index(source) else { return none };
        let text = &self.sources[source];
        if !text.text.is_char_boundary(offset) || text.is_comment(offset) || text.is_inactive(offset) {
            return none;
        }
        // After the caret's word: `next` is the first token that is not before it.
        let mut next = text.first_from(offset);
        let mut start = offset;
        if let Some(last) = next.checked_sub(1)
            && text.tokens[last].end as usize >= offset
        {
            if text.tokens[last].is_word() {
                (next, start) = (last, text.tokens[last].start as usize);
            } else if matches!(
                text.kind(last),
                Token::Int | Token::Uint | Token::Float | Token::BadNumber | Token::Text
            ) {
                return none;
            } else if text.tokens[last].end as usize > offset {
                // Inside an operator.
                return none;
            }
        }
        let at: Position = (source, start as u32);
        let replace = start..offset;
        let before = next.checked_sub(1);
        let in_line = |i: usize| !text.text[text.tokens[i].end as usize..start].contains('\n');
        if let Some(i) = before.filter(|&i| text.tokens[i].directive != Directive::No && in_line(i)) {
            return Completions { replace, items: self.in_directive(text, i, at), is_member: false };
        }
        if let Some(dot) = before.filter(|&i| text.kind(i) == Token::Dot) {
            let items = self.members_before(source, dot, at);
            return Completions { replace, items, is_member: true };
        }
        if before.is_some_and(|i| self.declares_name(text, i, at)) {
            return none;
        }
        let is_start = before.is_none_or(|i| matches!(text.kind(i), Token::Semicolon | Token::RBrace | Token::LBrace));
        let in_function = before.is_some_and(|i| {
            let brace = if text.kind(i) == Token::LBrace { Some(i) } else { text.around(i) };
            brace.is_some()
        });
        let mut items = self.everything_at(at);
        if is_start && !in_function {
            items.retain(|item| {
                use CompletionKind as K;
                matches!(item.kind, K::Type | K::Struct | K::Keyword | K::Macro)
            });
            items.push(self.entry_point());
        }
        Completions { replace, items, is_member: false }
    }

    /// Returns whether the word after a token is a name being declared: `float x`, `Ray r`.
    fn declares_name(&self, text: &Source, before: usize, at: Position) -> bool {
        match text.kind(before) {
            Token::Type | Token::Struct => true,
            Token::Ident => {
                let is_member = before > 0 && text.kind(before - 1) == Token::Dot;
                let symbol = text.tokens[before].symbol();
                !is_member && matches!(self.look_up(symbol, at, false), Some(Target::Decl(DeclRef::Struct(_))))
            }
            _ => false,
        }
    }

    /// Returns all names that are visible at a position.
    pub(super) fn everything_at(&self, at: Position) -> Vec<Completion> {
        let mut items = Vec::with_capacity(256);
        let mut seen: HashSet<Symbol> = HashSet::new();
        let locals = self.locals_at(at);
        let nearest_first = locals.iter().rev().enumerate();
        for (order, &id) in nearest_first {
            let local = &self.module[id];
            let Some(name) = local.name.filter(|n| seen.insert(n.symbol)) else { continue };
            let kind = match local.kind {
                LocalKind::Var => CompletionKind::Local,
                LocalKind::Const => CompletionKind::Constant,
                _ => CompletionKind::Parameter,
            };
            items.push(self.declared_item(Target::Decl(DeclRef::Local(id)), name.symbol, kind, order.min(900) as u32));
        }
        for (i, def) in self.origins.macros.iter().enumerate().rev() {
            let id = MacroId::new(i);
            if def.name_at.is_some() && self.macro_at(def.name, at) == Some(id) && seen.insert(def.name) {
                items.push(self.declared_item(Target::Macro(id), def.name, CompletionKind::Macro, 1_002));
            }
        }
        for (i, global) in self.module.globals.iter().enumerate().rev() {
            let is_before = self.position_of(global.name.token).is_some_and(|place| self.is_before(place, at));
            if is_before && seen.insert(global.name.symbol) {
                let constant = global.storage == GlobalStorage::Const;
                let kind = if constant { CompletionKind::Constant } else { CompletionKind::Global };
                let target = Target::Decl(DeclRef::Global(GlobalId::new(i)));
                items.push(self.declared_item(target, global.name.symbol, kind, 1_000));
            }
        }
        for (i, def) in self.module.structs.iter().enumerate() {
            let Some(name) =
                def.name.filter(|n| self.position_of(n.token).is_some_and(|place| self.is_before(place, at)))
            else {
                continue;
            };
            if !self.names.get(name.symbol).starts_with("gl_") && seen.insert(name.symbol) {
                let target = Target::Decl(DeclRef::Struct(StructId::new(i)));
                items.push(self.declared_item(target, name.symbol, CompletionKind::Struct, 1_003));
            }
        }
        self.add_functions(at, &mut seen, &mut items);
        self.add_predefined(&seen, &mut items);
        items
    }

    /// Adds user functions; overloads share an item.
    fn add_functions(&self, at: Position, seen: &mut HashSet<Symbol>, items: &mut Vec<Completion>) {
        let mut overloads: Vec<(Symbol, FuncId)> =
            self.functions_before(at).map(|id| (self.module[id].name.symbol, id)).collect();
        overloads.sort_unstable_by_key(|o| o.0);
        for group in overloads.chunk_by(|a, b| a.0 == b.0) {
            let (symbol, first) = group[0];
            if !seen.insert(symbol) {
                continue;
            }
            let target = Target::Decl(DeclRef::Func(first));
            let mut item = self.declared_item(target, symbol, CompletionKind::Function, 1_001);
            more_overloads(&mut item.detail, group.len() - 1);
            items.push(item);
        }
    }

    /// Adds the predefined names that are not hidden by a declaration of the author.
    fn add_predefined(&self, seen: &HashSet<Symbol>, items: &mut Vec<Completion>) {
        let hidden = |name: &str| self.names.find(name).is_some_and(|symbol| seen.contains(&symbol));
        let mut add = |name: &str, kind, detail: String, doc: &str, order| {
            if !hidden(name) {
                items.push(Completion { label: name.to_owned(), kind, detail, doc: doc.to_owned(), order });
            }
        };
        let env = Env::Pass(self.kind);
        let line = |target| self.declared_as(Target::Decl(target)).pop().unwrap_or_default();
        for &uniform in Uniform::ALL.iter().filter(|u| env.has(**u)) {
            let doc = docs::variable(uniform.name()).unwrap_or_default();
            add(uniform.name(), CompletionKind::Uniform, line(DeclRef::Uniform(uniform)), doc, 1_500);
        }
        for (i, (name, _)) in self.custom_uniforms.iter().enumerate() {
            let doc = if self.kind.declares_inputs() { "" } else { "Declared by an `#iUniform` line." };
            add(name, CompletionKind::Uniform, line(DeclRef::CustomUniform(i as u16)), doc, 1_100);
        }
        for (name, channel) in &self.samplers {
            add(name, CompletionKind::Uniform, line(DeclRef::Channel(*channel)), "", 1_100);
        }
        let channels = env::CHANNELS.into_iter().enumerate().filter(|_| !self.kind.declares_inputs());
        for (i, name) in channels {
            let doc = docs::variable(name).unwrap_or_default();
            add(name, CompletionKind::Uniform, line(DeclRef::Channel(i as u8)), doc, 1_499);
        }
        let is_here = |builtin: &Builtin| !builtin.is_of_image || self.kind == PassKind::Image;
        for builtin in Builtin::all().filter(|builtin| builtin.exists_in(self.dialect) && is_here(builtin)) {
            let texts = show::builtin_texts(builtin);
            let mut detail = texts.first().cloned().unwrap_or_default();
            more_overloads(&mut detail, texts.len().saturating_sub(1));
            add(builtin.name, CompletionKind::Builtin, detail, builtin.text, 2_000);
        }
        let is_known = |ty: &&BasicType| **ty != BasicType::Sampler1D || self.kind.declares_inputs();
        for &ty in BasicType::ALL.iter().filter(is_known) {
            let is_plain =
                !ty.name().contains("ampler") || matches!(ty.name(), "sampler2D" | "sampler3D" | "samplerCube");
            add(ty.name(), CompletionKind::Type, String::new(), "", if is_plain { 2_100 } else { 2_900 });
        }
        for name in words::keywords() {
            add(name, CompletionKind::Keyword, String::new(), docs::keyword(name).unwrap_or_default(), 2_200);
        }
        for (name, var) in env::VARIABLES.into_iter().filter(|v| env.has_variable(v.1)) {
            let doc = docs::variable(name).unwrap_or_default();
            add(name, CompletionKind::Uniform, line(DeclRef::BuiltinVar(var)), doc, 2_500);
        }
        for (name, value) in env::LIMITS {
            let doc = docs::variable(name).unwrap_or_default();
            add(name, CompletionKind::Constant, format!("const int {name} = {value}"), doc, 2_950);
        }
    }

    fn declared_item(&self, target: Target, symbol: Symbol, kind: CompletionKind, order: u32) -> Completion {
        let lines = self.declared_as(target);
        let detail = if lines.len() > 1 { lines[0].trim_end_matches(" {").to_owned() } else { lines.concat() };
        let own = self.declaration(target).map(|at| self.comment_above(at)).unwrap_or_default();
        let name = self.names.get(symbol);
        let doc = if own.is_empty() { docs::variable(name).unwrap_or_default().to_owned() } else { own };
        Completion { label: name.to_owned(), kind, detail, doc, order }
    }

    /// Returns the function that a pass of this kind must define, as a completion.
    fn entry_point(&self) -> Completion {
        let entry = env::entry(self.kind);
        Completion {
            label: entry.name.to_owned(),
            kind: CompletionKind::Function,
            detail: entry.usage.trim_end_matches(" { .. }").to_owned(),
            doc: docs::variable(entry.name).unwrap_or_default().to_owned(),
            order: 1_001,
        }
    }

    /// Returns the fields of a struct, the components of a vector, or `length()` of an array.
    fn members_before(&self, source: usize, dot: usize, at: Position) -> Vec<Completion> {
        let text = &self.sources[source];
        let item = |label: &str, detail: String, doc: String, order: usize| Completion {
            label: label.to_owned(),
            kind: CompletionKind::Field,
            detail,
            doc,
            order: order as u32,
        };
        let base = dot.checked_sub(1).filter(|&i| text.kind(i) == Token::Ident);
        let base = base.and_then(|i| self.look_up(text.tokens[i].symbol(), at, false));
        if let Some(Target::Decl(DeclRef::ChannelStruct(_))) = base {
            let members = docs::channel_members().iter().enumerate();
            return members.map(|(i, (name, ty, doc))| item(name, format!("{ty} {name}"), (*doc).into(), i)).collect();
        }
        let Some(ty) = Infer::new(self, source, at).before(dot) else { return Vec::new() };
        match self.module.types.get(ty) {
            Type::Struct(id) => {
                let members = self.module[self.module[id].members].iter().enumerate();
                let doc = |m: &crate::hir::StructMember| self.comment_above(self.spelled(m.name.token));
                members
                    .map(|(i, m)| {
                        let name = self.names.get(m.name.symbol);
                        item(name, format!("{} {name}", self.type_name(m.ty)), doc(m), i)
                    })
                    .collect()
            }
            Type::Vector { scalar, size } => swizzles(scalar, size, item),
            Type::Array { len, .. } => {
                vec![item("length()", format!("int = {len}"), "Number of elements.".into(), 0)]
            }
            _ => Vec::new(),
        }
    }

    /// Returns words that may follow token `before` of a directive.
    fn in_directive(&self, text: &Source, before: usize, at: Position) -> Vec<Completion> {
        let word = |label: &str, doc: &str| Completion {
            label: label.to_owned(),
            kind: CompletionKind::Keyword,
            detail: String::new(),
            doc: doc.to_owned(),
            order: 0,
        };
        if text.kind(before) == Token::Hash && text.tokens[before].directive == Directive::Head {
            return docs::directives().map(|name| word(name, docs::directive(name).unwrap_or_default())).collect();
        }
        let head = (0..=before).rev().find(|&i| text.tokens[i].directive == Directive::Head);
        let names_one = head == Some(before);
        let mut items = self.everything_at(at);
        match head.map(|i| text.text_of(i)) {
            Some("define") if names_one => return Vec::new(),
            Some("define") => return items,
            Some("if" | "elif") => items.retain(|item| item.kind == CompletionKind::Macro),
            Some("ifdef" | "ifndef" | "undef") if names_one => items.retain(|item| item.kind == CompletionKind::Macro),
            _ => return Vec::new(),
        }
        if let Some("if" | "elif") = head.map(|i| text.text_of(i)) {
            items.push(word("defined", "1 if a macro of this name is defined, else 0: `defined(NAME)`."));
        }
        items
    }
}

fn more_overloads(detail: &mut String, more: usize) {
    if more > 0 {
        detail.push_str(&format!("  (+{more})"));
    }
}

/// Returns the components of a vector that are worth proposing; others can be typed.
fn swizzles(scalar: Scalar, size: u8, item: impl Fn(&str, String, String, usize) -> Completion) -> Vec<Completion> {
    let names: &[&str] = match size {
        2 => &["x", "y", "xy", "yx", "xyxy", "r", "g", "s", "t"],
        3 => &["x", "y", "z", "xy", "xz", "yz", "xyz", "zyx", "r", "g", "b", "rg", "rgb", "bgr"],
        _ => &["x", "y", "z", "w", "xy", "zw", "xyz", "xyzw", "r", "g", "b", "a", "rg", "rgb", "rgba"],
    };
    let at = |(i, name): (usize, &&str)| {
        let ty = TypeId::vector(scalar, name.len() as u8).as_basic().map_or("", BasicType::name);
        item(name, ty.to_owned(), String::new(), i)
    };
    names.iter().enumerate().map(at).collect()
}
