//! Resolves types as written to [`TypeId`]s: names, dimensions, struct definitions; and formats types for messages.

use rustc_hash::FxHashMap;

use super::{
    checker::Checker,
    facts::{MAX_WORDS, NOTHING, TypeFacts},
    scope::Binding,
};
use crate::{
    ast::{self, Dim, List, Loc, StructDefId, TypeSpecId, TypeSpecKind},
    hir::{self, DeclRef, Scalar, Struct, StructId, StructMember, Type, TypeId},
    source::Dialect,
};

/// The number of members from which on a struct's members are looked up in a table.
pub(super) const MANY_MEMBERS: usize = 16;

/// The maximum nesting depth of structs that WebGL's compiler accepts.
const MAX_NESTING: u8 = 4;

/// The maximum number of dimensions of an array: functions call themselves for each.
const MAX_DIMENSIONS: usize = 16;

/// The size of an array as written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Size {
    /// `[]`: determined by the initialiser or the constructor's arguments.
    Unsized,
    Known(u32),
    /// Invalid, and reported.
    Invalid,
}

impl<'a> Checker<'a> {
    #[inline]
    pub(super) fn facts(&self, ty: TypeId) -> TypeFacts {
        self.facts[ty.0 as usize]
    }

    #[inline]
    pub(super) fn is_sampler(&self, ty: TypeId) -> bool {
        matches!(self.module.types.get(ty), Type::Sampler { .. })
    }

    /// Returns an array type; reports sizes past the limit.
    pub(super) fn array_type(&mut self, element: TypeId, len: u32, loc: Loc) -> TypeId {
        if element == TypeId::ERROR {
            return TypeId::ERROR;
        }
        let facts = self.facts(element);
        let words = u64::from(facts.words) * u64::from(len);
        if words > u64::from(MAX_WORDS) {
            self.error(loc, format!("this array takes {} MiB; the limit is 16 MiB", words.div_ceil(1 << 18)));
            self.hint("store large tables in a buffer and read them with texelFetch");
            return TypeId::ERROR;
        }
        let ty = self.module.types.array(element, len);
        if ty.0 as usize == self.facts.len() {
            self.facts.push(TypeFacts { words: words as u32, arrays: true, ..facts });
        }
        ty
    }

    /// Returns the type without its dimensions.
    pub(super) fn base_type(&mut self, spec: TypeSpecId) -> TypeId {
        let spec = self.ast[spec];
        match spec.kind {
            TypeSpecKind::Error => TypeId::ERROR,
            TypeSpecKind::Basic(basic) => TypeId::basic(basic),
            TypeSpecKind::Named(symbol) => match self.scopes.get(symbol) {
                Binding::Struct(id) => {
                    self.record_use(spec.loc.first, DeclRef::Struct(id));
                    self.module[id].ty
                }
                Binding::Poison => TypeId::ERROR,
                Binding::None => {
                    self.unknown_type(symbol, spec.loc.first);
                    TypeId::ERROR
                }
                other => {
                    let name = self.name(symbol);
                    let what = self.describe_binding(other);
                    self.error(spec.loc.first, format!("`{name}` is {what}, not a type"));
                    TypeId::ERROR
                }
            },
            TypeSpecKind::Struct(def) => self.define_struct(def),
        }
    }

    /// Returns the size in one pair of brackets.
    pub(super) fn size(&mut self, dim: Dim) -> Size {
        let Some(expr) = dim.size else { return Size::Unsized };
        let id = self.expr(expr);
        let ty = self.ty(id);
        let loc = self.loc(id);
        if ty == TypeId::ERROR {
            return Size::Invalid;
        }
        if ty != TypeId::INT && ty != TypeId::UINT {
            let found = self.type_name(ty);
            self.error(loc, format!("an array's size must be an `int` or `uint`, not `{found}`"));
            if let ast::ExprKind::Float(value) = self.ast[expr].kind {
                self.hint(format!("write {}", value.trunc()));
            }
            return Size::Invalid;
        }
        let Some(&[bits]) = self.words(id) else {
            if self.is_broken() {
                return Size::Invalid;
            }
            self.error(loc, "an array's size must be a constant expression");
            self.hint("use a literal, a `const int` or a #define");
            return Size::Invalid;
        };
        if bits == 0 || (ty == TypeId::INT && (bits as i32) < 0) {
            self.error(loc, "an array's size must be greater than zero");
            return Size::Invalid;
        }
        Size::Known(bits)
    }

    /// Returns the sizes from the dimensions of a type and of a declarator, the outermost first: at most one in ESSL
    /// 3.00. `float[3] a[2]` is an array of two arrays of three (GLSL 4.60, section 4.1.9).
    pub(super) fn sizes(&mut self, of_type: List<Dim>, of_name: List<Dim>) -> Vec<(Size, Loc)> {
        let ast = self.ast;
        let is_nested = self.settings.dialect.has_arrays_of_arrays();
        let mut found: Vec<(Size, Loc)> = Vec::new();
        let mut all: Vec<Dim> = ast[of_name].iter().chain(&ast[of_type]).copied().collect();
        if !is_nested {
            all.sort_by_key(|dim| dim.loc.first);
        }
        for dim in all {
            let size = self.size(dim);
            match found.first_mut().filter(|_| !is_nested) {
                None => found.push((size, dim.loc)),
                Some((first, _)) => {
                    if *first != Size::Invalid {
                        self.error(dim.loc, "GLSL ES 3.00 has no arrays of arrays");
                        self.hint("use one array and compute the index, `a[y * WIDTH + x]`, or an array of structs");
                    }
                    *first = Size::Invalid;
                }
            }
        }
        found
    }

    /// Returns the array type of these sizes, the outermost first; those that are not written are the sizes of a value
    /// of type `like`. `Err` with the place of one that it does not have.
    pub(super) fn sized_type(&mut self, base: TypeId, sizes: &[(Size, Loc)], like: TypeId) -> Result<TypeId, Loc> {
        if let Some(&(_, loc)) = sizes.get(MAX_DIMENSIONS) {
            self.error(loc, format!("an array can have at most {MAX_DIMENSIONS} dimensions"));
            return Ok(TypeId::ERROR);
        }
        let mut value = Some(like);
        let mut lengths = Vec::with_capacity(sizes.len());
        for _ in sizes {
            let (element, len) = match value.map(|ty| self.module.types.get(ty)) {
                Some(Type::Array { element, len }) => (Some(element), Some(len)),
                _ => (None, None),
            };
            lengths.push(len);
            value = element;
        }
        let mut ty = base;
        for (&(size, loc), len) in sizes.iter().zip(lengths).rev() {
            let len = match size {
                Size::Known(len) => len,
                Size::Invalid => return Ok(TypeId::ERROR),
                Size::Unsized => len.ok_or(loc)?,
            };
            ty = self.element_checked(ty, len, loc);
        }
        Ok(ty)
    }

    /// Returns a complete type with its dimensions; `[]` is an error described by `what`.
    pub(super) fn complete_type(&mut self, base: TypeId, of_type: List<Dim>, of_name: List<Dim>, what: &str) -> TypeId {
        let sizes = self.sizes(of_type, of_name);
        self.sized_type(base, &sizes, TypeId::ERROR).unwrap_or_else(|loc| {
            self.error(loc, format!("{what} needs a size between the brackets"));
            TypeId::ERROR
        })
    }

    fn element_checked(&mut self, element: TypeId, len: u32, loc: Loc) -> TypeId {
        if element == TypeId::VOID {
            self.error(loc, "an array cannot have elements of type `void`");
            return TypeId::ERROR;
        }
        self.array_type(element, len, loc)
    }

    fn define_struct(&mut self, def: StructDefId) -> TypeId {
        let ast = self.ast;
        let def = ast[def];
        let mut members: Vec<StructMember> = Vec::new();
        let mut seen: FxHashMap<ast::Symbol, usize> = FxHashMap::default();
        let mut facts = NOTHING;
        for field in &ast[def.fields] {
            let spec = ast[field.ty];
            if let TypeSpecKind::Struct(inner) = spec.kind {
                self.error(ast[inner].loc, "a struct cannot be defined inside another struct");
                self.hint("define it before this one and use its name here");
            }
            let base = self.base_type(field.ty);
            self.field_qualifiers(field.qualifiers, base);
            for declarator in &ast[field.declarators] {
                let name = self.name(declarator.name.symbol);
                let mut ty = self.complete_type(base, spec.dims, declarator.dims, "an array in a struct");
                if ty == TypeId::VOID {
                    self.error(spec.loc, format!("the member `{name}` cannot be of type `void`"));
                    ty = TypeId::ERROR;
                }
                let symbol = declarator.name.symbol;
                let first = match members.len() < MANY_MEMBERS {
                    true => members.iter().position(|m| m.name.symbol == symbol),
                    false => {
                        if seen.is_empty() {
                            seen.extend(members.iter().enumerate().map(|(i, m)| (m.name.symbol, i)));
                        }
                        seen.get(&symbol).copied()
                    }
                };
                if let Some(first) = first {
                    let first = members[first].name;
                    self.error(declarator.name, format!("this struct already has a member `{name}`"));
                    self.label(first, "the first one");
                    continue;
                }
                if self.facts(ty).nesting == MAX_NESTING {
                    let shown = self.type_name(ty);
                    self.error(
                        declarator.name,
                        format!("a `{shown}` inside this struct exceeds WebGL's limit of {MAX_NESTING} nested structs"),
                    );
                    ty = TypeId::ERROR;
                }
                facts.add(self.facts(ty));
                if members.len() >= MANY_MEMBERS {
                    seen.insert(symbol, members.len());
                }
                members.push(StructMember { name: declarator.name, ty });
            }
        }
        facts.nesting += 1;
        if facts.words > MAX_WORDS {
            self.error(def.loc, "this struct takes more than the limit of 16 MiB");
            facts.words = MAX_WORDS;
        }
        if members.is_empty() && ast[def.fields].is_empty() && !self.broken_tree {
            self.error(def.loc, "a struct needs at least one member");
        }
        let ty = self.add_struct(def.name, &members, def.loc, facts);
        if let Some(name) = def.name
            && let Type::Struct(id) = self.module.types.get(ty)
        {
            self.declare(name, Binding::Struct(id));
        }
        ty
    }

    pub(super) fn add_struct(
        &mut self,
        name: Option<ast::Ident>,
        members: &[StructMember],
        loc: Loc,
        facts: impl Into<Option<TypeFacts>>,
    ) -> TypeId {
        let facts = facts.into().unwrap_or_else(|| {
            let mut sum = NOTHING;
            members.iter().for_each(|member| sum.add(self.facts(member.ty)));
            TypeFacts { words: sum.words.min(MAX_WORDS), nesting: sum.nesting.saturating_add(1), ..sum }
        });
        let id = StructId::new(self.module.structs.len());
        let ty = self.module.types.add_struct(id);
        let members = self.module.list(members);
        self.module.structs.push(Struct { name, ty, members, loc });
        self.facts.push(facts);
        self.note_members(id);
        ty
    }

    /// Formats a type for messages.
    pub(super) fn type_name(&self, ty: TypeId) -> String {
        self.module.type_text(self.names, ty)
    }

    /// Formats a type with its article: `an `int``.
    pub(super) fn with_article(&self, ty: TypeId) -> String {
        let name = self.type_name(ty);
        let article = if name.starts_with(['a', 'e', 'i', 'o', 'A', 'E', 'I', 'O']) { "an" } else { "a" };
        format!("{article} `{name}`")
    }

    /// Declares a name, or reports that it already exists in this scope.
    pub(super) fn declare(&mut self, name: ast::Ident, binding: Binding) -> bool {
        // A text may declare its own variables with the names of the program that it is not written for.
        let is_given = |previous: &Binding| {
            use Binding as B;
            matches!(previous, B::Uniform(_) | B::Channel(_) | B::ChannelStruct(_) | B::CustomUniform(_))
        };
        let is_free = |previous: &Binding| self.settings.dialect.is_any() && is_given(previous);
        if let Some(previous) = self.scopes.get_innermost(name.symbol).filter(|previous| !is_free(previous)) {
            if previous != Binding::Poison {
                self.redeclared(name, previous);
            }
            return false;
        }
        self.scopes.declare(name.symbol, binding);
        true
    }

    #[cold]
    fn redeclared(&mut self, name: ast::Ident, previous: Binding) {
        let text = self.name(name.symbol);
        let at = self.declared_at(previous);
        let given = matches!(
            previous,
            Binding::Uniform(_) | Binding::Channel(_) | Binding::ChannelStruct(_) | Binding::BuiltinVar(_)
        );
        if matches!(previous, Binding::CustomUniform(_)) {
            let by = match self.settings.dialect {
                Dialect::Shadertoy => "by an #iUniform line",
                Dialect::Ghostty => "by Ghostty's prefix or an #iUniform line",
                Dialect::Any(_) => "by the host",
            };
            self.error(name, format!("`{text}` is already declared {by}"));
            self.hint("remove this declaration, or choose another name");
            return;
        }
        if given {
            let header = self.settings.dialect.header();
            self.error(name, format!("`{text}` is already declared by {header}"));
            self.hint("remove this declaration, or choose another name");
            return;
        }
        let parameter = match previous {
            Binding::Local(local) => self.module[local].kind.is_param(),
            _ => false,
        };
        if parameter {
            self.error(name, format!("`{text}` is already the name of a parameter of this function"));
        } else {
            self.error(name, format!("`{text}` is already declared in this scope"));
        }
        if let Some(at) = at {
            self.label(at, "the first declaration");
        }
        self.hint("choose another name, or remove the type to assign to the first one");
    }

    /// Returns the location of the declaration of a name, if it is in the text.
    pub(super) fn declared_at(&self, binding: Binding) -> Option<Loc> {
        match binding {
            Binding::Function(id) => self.function_at(id),
            Binding::Struct(id) => self.module[id].name.map(Loc::from),
            Binding::Block(name) => Some(name.into()),
            Binding::Global(id) => Some(self.module[id].name.into()),
            Binding::Local(id) => self.module[id].name.map(Loc::from),
            _ => None,
        }
    }

    /// Describes a binding for messages: `a variable`, `a function`...
    pub(super) fn describe_binding(&self, binding: Binding) -> &'static str {
        match binding {
            Binding::Builtin(_) => "a built-in function",
            Binding::Function(_) => "a function",
            Binding::Struct(_) => "a struct",
            Binding::Block(_) => "a uniform block",
            Binding::Local(id) if self.module[id].kind.is_param() => "a parameter",
            Binding::Channel(_) => "a channel's sampler",
            Binding::Uniform(_)
            | Binding::CustomUniform(_)
            | Binding::DeprecatedTime
            | Binding::ChannelStruct(_)
            | Binding::DepthRange => "a uniform",
            Binding::BuiltinConst(_) => "a constant",
            _ => "a variable",
        }
    }

    /// Returns the component type and the number of components of a scalar or vector.
    #[inline]
    pub(super) fn vector_shape(&self, ty: TypeId) -> Option<(Scalar, u8)> {
        match self.module.types.get(ty) {
            Type::Scalar(scalar) => Some((scalar, 1)),
            Type::Vector { scalar, size } => Some((scalar, size)),
            _ => None,
        }
    }

    pub(super) fn struct_of(&self, ty: TypeId) -> Option<hir::StructId> {
        match self.module.types.get(ty) {
            Type::Struct(id) => Some(id),
            _ => None,
        }
    }
}
