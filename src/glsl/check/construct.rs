//! Constructors (section 5.4): scalars, vectors, matrices, structs and arrays.

use super::{call, checker::Checker, fold, types::Size, words::ScalarWords};
use crate::{
    ast::{self, List, Loc, TypeSpecId, TypeSpecKind},
    hir::{ExprId, ExprKind, Scalar, StructId, Swizzle, Type, TypeId},
    types,
};

impl Checker<'_> {
    /// Checks a constructor written with a type: `vec3(..)`, `float[](..)`, `S[2](..)`.
    pub(super) fn construct(&mut self, spec: TypeSpecId, args: List<ast::ExprId>, loc: Loc) -> ExprId {
        let written = self.ast[spec];
        if let TypeSpecKind::Struct(_) = written.kind {
            self.error(written.loc, "a struct cannot be defined inside an expression");
            return self.error_expr(loc);
        }
        let base = self.base_type(spec);
        let sizes = self.sizes(written.dims, List::EMPTY);
        let Some((&(size, at), inner)) = sizes.split_first() else {
            return self.construct_type(base, args, loc);
        };
        if base == TypeId::ERROR || size == Size::Invalid {
            return self.error_expr(loc);
        }
        if base == TypeId::VOID || self.facts(base).opaque {
            let name = self.type_name(base);
            self.error(loc, format!("there are no constructors of arrays of `{name}`"));
            return self.error_expr(loc);
        }
        let count = args.len() as u32;
        let len = match size {
            Size::Known(len) => len,
            _ => count,
        };
        if count == 0 {
            self.error(loc, "an array constructor needs an argument for each element");
            return self.error_expr(loc);
        }
        // The sizes of elements that are arrays may follow from the first of them.
        let first = self.ty(self.lowered_expr(self.ast[args][0]));
        let element = match self.sized_type(base, inner, first) {
            Ok(element) if element != TypeId::ERROR => element,
            Err(at) if first != TypeId::ERROR => {
                let name = self.type_name(base);
                self.error(at, format!("the elements must be arrays of `{name}`, whose size is not written here"));
                return self.error_expr(loc);
            }
            _ => return self.error_expr(loc),
        };
        let of = self.type_name(element);
        if len != count {
            let (name, open) = (types::array_text(&of, &len.to_string()), types::array_text(&self.type_name(base), ""));
            let (needed, given) = (call::count(len as usize, "argument"), call::count_given(count as usize));
            self.error(loc, format!("`{name}` needs {needed}, {given}"));
            self.hint(format!("write `{open}{}(..)` to have them counted", "[]".repeat(inner.len())));
            let ty = self.array_type(element, len, at);
            return self.error_expr_of(ty, loc);
        }
        let ty = self.array_type(element, len, at);
        let message = format!("an element of `{}` cannot be {{}}", types::array_text(&of, ""));
        if !self.each_argument(args, |_, _| element, |_, _| message.clone()) {
            return self.error_expr_of(ty, loc);
        }
        self.composite(args, ty, loc, ExprKind::Array)
    }

    /// Checks a constructor of a type without dimensions.
    pub(super) fn construct_type(&mut self, ty: TypeId, args: List<ast::ExprId>, loc: Loc) -> ExprId {
        let target = self.module.types.get(ty);
        match target {
            Type::Error => return self.error_expr(loc),
            Type::Struct(id) => return self.construct_struct(id, args, loc),
            Type::Void | Type::Sampler { .. } => {
                let name = self.type_name(ty);
                self.error(loc, format!("there is no constructor of `{name}`"));
                return self.error_expr(loc);
            }
            Type::Scalar(_) | Type::Vector { .. } | Type::Matrix { .. } | Type::Array { .. } => {}
        }
        let ast = self.ast;
        let base = self.expr_stack.len();
        let mut known = true;
        for &arg in &ast[args] {
            let id = self.lowered_expr(arg);
            known &= self.is_component_argument(id, ty);
            self.expr_stack.push(id);
        }
        let id = if !known {
            self.error_expr_of(ty, loc)
        } else if base == self.expr_stack.len() {
            let name = self.type_name(ty);
            self.error(loc, format!("`{name}()` needs at least one argument"));
            self.hint(format!(
                "write `{name}({})`",
                if self.module.types.scalar(ty) == Some(Scalar::Float) { "0.0" } else { "0" }
            ));
            self.error_expr_of(ty, loc)
        } else {
            match target {
                Type::Matrix { .. } => self.construct_matrix(ty, base, loc),
                _ => self.construct_vector(ty, base, args, loc),
            }
        };
        self.expr_stack.truncate(base);
        id
    }

    /// Returns whether an argument has components; reports those that have none.
    fn is_component_argument(&mut self, arg: ExprId, target: TypeId) -> bool {
        let ty = self.ty(arg);
        if ty == TypeId::ERROR {
            return false;
        }
        if self.module.types.scalar(ty).is_some() {
            return true;
        }
        if !self.is_void(arg) {
            let (name, found, at) = (self.type_name(target), self.type_name(ty), self.loc(arg));
            self.error(at, format!("a `{name}` cannot be built from `{found}`"));
            if let Some(element) = self.module.types.element(ty) {
                let of = self.type_name(element);
                self.hint(format!("index the array first: `a[i]` is a `{of}`"));
            }
        }
        false
    }

    /// Makes a scalar or vector from the arguments on the stack above `base`.
    fn construct_vector(&mut self, ty: TypeId, base: usize, written: List<ast::ExprId>, loc: Loc) -> ExprId {
        let (scalar, size) = self.vector_shape(ty).expect("a scalar or vector");
        let count = self.expr_stack.len() - base;
        if count == 1 {
            return self.convert_whole(ty, self.expr_stack[base], loc);
        }
        let mut filled = 0;
        for i in base..base + count {
            if filled >= u32::from(size) {
                let at = self.loc(self.expr_stack[i]);
                let name = self.type_name(ty);
                self.error(at, format!("too many arguments: a `{name}` is full before this one"));
                if count == 2 && size == 1 {
                    self.hint("a scalar takes one value");
                }
                return self.error_expr_of(ty, loc);
            }
            filled += self.module.types.components(self.ty(self.expr_stack[i])).unwrap_or(0);
        }
        if filled < u32::from(size) {
            self.too_few(ty, filled, size.into(), loc);
            return self.error_expr_of(ty, loc);
        }
        if self.expr_stack[base..].iter().all(|&id| self.is_constant(id)) {
            let (mut words, mut gap) = (ScalarWords::default(), None);
            for i in base..base + count {
                let id = self.expr_stack[i];
                let from = self.module.types.scalar(self.ty(id)).expect("has components");
                let room = usize::from(size) - words.as_slice().len();
                for &bits in self.words(id).expect("constant").iter().take(room) {
                    gap = gap.or(fold::conversion_gap(bits, from, scalar));
                    words.push(fold::convert(bits, from, scalar));
                }
            }
            return self.converted(ty, (&words, gap), loc);
        }
        debug_assert_eq!(written.len(), count);
        let mut filled = 0;
        for i in base..base + count {
            let id = self.expr_stack[i];
            filled += self.module.types.components(self.ty(id)).unwrap_or(0);
            let surplus = filled.saturating_sub(size.into());
            self.expr_stack[i] = self.components_of(id, scalar, surplus);
        }
        let args = self.module.list(&self.expr_stack[base..]);
        let flags = self.inherited(&self.expr_stack[base..]);
        self.push(ExprKind::Vector(args), ty, flags, loc)
    }

    #[cold]
    fn too_few(&mut self, ty: TypeId, given: u32, needed: u32, loc: Loc) {
        let name = self.type_name(ty);
        self.error(loc, format!("a `{name}` needs {needed} components, the arguments have {given}"));
        if given > 1 && given < needed && self.vector_shape(ty).is_some() {
            let missing = vec!["0.0"; (needed - given) as usize].join(", ");
            self.hint(format!("add what is missing, as in `{name}(.., {missing})`"));
        }
    }

    /// Converts one argument of a vector constructor to the target's component type. Float matrices stay whole;
    /// otherwise the components that are used (all but `surplus`) become a vector first.
    fn components_of(&mut self, id: ExprId, scalar: Scalar, surplus: u32) -> ExprId {
        let (ty, loc) = (self.ty(id), self.loc(id));
        match self.module.types.get(ty) {
            Type::Matrix { columns, rows } if scalar != Scalar::Float => {
                let wanted = (u32::from(columns) * u32::from(rows) - surplus) as u8;
                let flags = self.inherited(&[id]);
                if wanted == 1 {
                    let first = self.first_of_matrix(id, rows, loc);
                    return self.convert_to(first, scalar, loc);
                }
                let args = self.module.list(&[id]);
                let vector = self.push(ExprKind::Vector(args), TypeId::vector(Scalar::Float, wanted), flags, loc);
                self.convert_to(vector, scalar, loc)
            }
            Type::Matrix { .. } => id,
            _ => self.convert_to(id, scalar, loc),
        }
    }

    fn first_of_matrix(&mut self, id: ExprId, rows: u8, loc: Loc) -> ExprId {
        let flags = self.inherited(&[id]);
        let zero = self.literal(0, TypeId::INT, loc);
        let column =
            self.push(ExprKind::Index { base: id, index: zero }, TypeId::vector(Scalar::Float, rows), flags, loc);
        let zero = self.literal(0, TypeId::INT, loc);
        self.push(ExprKind::Index { base: column, index: zero }, TypeId::FLOAT, flags, loc)
    }

    /// Converts a scalar or vector to another component type; returns the same expression if it already has that type.
    pub(super) fn convert_to(&mut self, id: ExprId, scalar: Scalar, loc: Loc) -> ExprId {
        let (from, size) = self.vector_shape(self.ty(id)).expect("a scalar or vector");
        if from == scalar {
            return self.as_value(id);
        }
        let ty = TypeId::vector(scalar, size);
        if let Some(words) = self.words(id) {
            let gap = words.iter().find_map(|&bits| fold::conversion_gap(bits, from, scalar));
            let words: ScalarWords = words.iter().map(|&bits| fold::convert(bits, from, scalar)).collect();
            return self.converted(ty, (&words, gap), loc);
        }
        let flags = self.inherited(&[id]);
        self.push(ExprKind::Convert(id), ty, flags, loc)
    }

    /// Returns a converted constant; reports values that were out of range.
    fn converted(&mut self, ty: TypeId, (words, gap): (&ScalarWords, Option<&'static str>), loc: Loc) -> ExprId {
        let id = self.constant(ty, words.as_slice(), loc);
        if let Some(what) = gap {
            self.undefined(loc, what);
            self.warning(loc, what);
        }
        id
    }

    /// Makes a scalar or vector from one argument.
    fn convert_whole(&mut self, ty: TypeId, arg: ExprId, loc: Loc) -> ExprId {
        let (scalar, size) = self.vector_shape(ty).expect("a scalar or vector");
        let at = self.ty(arg);
        if at == ty {
            return self.as_value(arg);
        }
        let given = self.module.types.components(at).expect("has components");
        let from = self.module.types.scalar(at).expect("has components");
        if given > 1 && given < u32::from(size) {
            self.too_few(ty, given, size.into(), loc);
            return self.error_expr_of(ty, loc);
        }
        if let Some(words) = self.words(arg) {
            let of = |i: usize| words[if given == 1 { 0 } else { i }];
            let gap = (0..usize::from(size)).find_map(|i| fold::conversion_gap(of(i), from, scalar));
            let words: ScalarWords = (0..usize::from(size)).map(|i| fold::convert(of(i), from, scalar)).collect();
            return self.converted(ty, (&words, gap), loc);
        }
        let flags = self.inherited(&[arg]);
        match self.module.types.get(at) {
            Type::Matrix { rows, .. } if size == 1 => {
                let first = self.first_of_matrix(arg, rows, loc);
                self.convert_to(first, scalar, loc)
            }
            Type::Matrix { .. } => {
                let args = self.module.list(&[arg]);
                let vector = self.push(ExprKind::Vector(args), TypeId::vector(Scalar::Float, size), flags, loc);
                self.convert_to(vector, scalar, loc)
            }
            Type::Scalar(_) if size > 1 => {
                let arg = self.convert_to(arg, scalar, loc);
                self.push(ExprKind::Splat(arg), ty, flags, loc)
            }
            _ if given > u32::from(size) => {
                let swizzle = Swizzle::new(&[0, 1, 2, 3][..usize::from(size)]);
                let part = self.push(ExprKind::Swizzle { base: arg, swizzle }, TypeId::vector(from, size), flags, loc);
                self.convert_to(part, scalar, loc)
            }
            _ => self.convert_to(arg, scalar, loc),
        }
    }

    /// Makes a matrix from the arguments on the stack above `base`.
    fn construct_matrix(&mut self, ty: TypeId, base: usize, loc: Loc) -> ExprId {
        let Type::Matrix { columns, rows } = self.module.types.get(ty) else { unreachable!("a matrix") };
        let needed = u32::from(columns) * u32::from(rows);
        let count = self.expr_stack.len() - base;
        if count == 1 {
            let arg = self.expr_stack[base];
            let flags = self.inherited(&[arg]);
            match self.module.types.get(self.ty(arg)) {
                Type::Scalar(_) => {
                    let arg = self.convert_to(arg, Scalar::Float, loc);
                    if let Some(&[bits]) = self.words(arg) {
                        let words: ScalarWords = (0..needed)
                            .map(|i| if i / u32::from(rows) == i % u32::from(rows) { bits } else { 0 })
                            .collect();
                        return self.constant(ty, words.as_slice(), loc);
                    }
                    return self.push(ExprKind::MatrixDiagonal(arg), ty, flags, loc);
                }
                Type::Matrix { .. } if self.ty(arg) == ty => return self.as_value(arg),
                Type::Matrix { columns: of_columns, rows: of_rows } => {
                    if let Some(words) = self.words(arg) {
                        let cell = |column: u8, row: u8| {
                            if column < of_columns && row < of_rows {
                                words[usize::from(column) * usize::from(of_rows) + usize::from(row)]
                            } else {
                                f32::to_bits(if column == row { 1.0 } else { 0.0 })
                            }
                        };
                        let words: ScalarWords = (0..columns)
                            .flat_map(|c| (0..rows).map(move |r| (c, r)))
                            .map(|(c, r)| cell(c, r))
                            .collect();
                        return self.constant(ty, words.as_slice(), loc);
                    }
                    return self.push(ExprKind::MatrixResize(arg), ty, flags, loc);
                }
                _ => {}
            }
        }
        let name = self.type_name(ty);
        let mut filled = 0;
        for i in base..base + count {
            let id = self.expr_stack[i];
            let at = self.loc(id);
            if let Type::Matrix { .. } = self.module.types.get(self.ty(id)) {
                self.error(at, format!("a matrix must be the only argument of `{name}`"));
                self.hint("give its columns instead: `m[0], m[1], ..`");
                return self.error_expr_of(ty, loc);
            }
            if filled >= needed {
                self.error(at, format!("too many arguments: a `{name}` is full before this one"));
                return self.error_expr_of(ty, loc);
            }
            filled += self.module.types.components(self.ty(id)).unwrap_or(0);
            self.expr_stack[i] = self.convert_to(id, Scalar::Float, at);
        }
        if filled < needed {
            self.too_few(ty, filled, needed, loc);
            if count == 1 {
                self.hint(format!("for a diagonal matrix write `{name}(1.0)`"));
            }
            return self.error_expr_of(ty, loc);
        }
        if self.expr_stack[base..].iter().all(|&id| self.is_constant(id)) {
            let all = self.expr_stack[base..].iter().flat_map(|&id| self.words(id).expect("constant").iter().copied());
            let words: ScalarWords = all.take(needed as usize).collect();
            return self.constant(ty, words.as_slice(), loc);
        }
        let args = self.module.list(&self.expr_stack[base..]);
        let flags = self.inherited(&self.expr_stack[base..]);
        self.push(ExprKind::Matrix(args), ty, flags, loc)
    }

    pub(super) fn construct_struct(&mut self, id: StructId, args: List<ast::ExprId>, loc: Loc) -> ExprId {
        let hir = self.module[id];
        let name = self.type_name(hir.ty);
        let members = hir.members;
        if members.len() != args.len() {
            if args.is_empty() || self.ast[args].iter().all(|&arg| self.ty(self.lowered_expr(arg)) != TypeId::ERROR) {
                let (needed, given) = (call::count(members.len(), "argument"), call::count_given(args.len()));
                self.error(loc, format!("`{name}(..)` needs {needed}, one per member; {given}"));
                if let Some(declared) = hir.name {
                    self.label(declared, "the struct");
                }
            }
            return self.error_expr_of(hir.ty, loc);
        }
        if self.facts(hir.ty).opaque {
            self.error(loc, format!("`{name}` has a sampler and cannot be constructed"));
            return self.error_expr_of(hir.ty, loc);
        }
        let fits = self.each_argument(
            args,
            |checker, i| checker.module[members][i].ty,
            |checker, i| {
                let member = checker.module[members][i];
                let (of, ty) = (checker.name(member.name.symbol), checker.with_article(member.ty));
                format!("the member `{of}` of `{name}` is {ty}, not {{}}")
            },
        );
        if !fits {
            return self.error_expr_of(hir.ty, loc);
        }
        self.composite(args, hir.ty, loc, ExprKind::Struct)
    }

    /// Returns whether each argument has the expected type; reports all that do not in one message, that of the first.
    fn each_argument(
        &mut self,
        args: List<ast::ExprId>,
        want: impl Fn(&Self, usize) -> TypeId,
        message: impl Fn(&Self, usize) -> String,
    ) -> bool {
        let ast = self.ast;
        let mut fits = true;
        let mut wrong = Vec::new();
        let mut said = String::new();
        for (i, &arg) in ast[args].iter().enumerate() {
            let wanted = want(self, i);
            let value = self.implicit(arg, wanted);
            if self.ty(value) == wanted && wanted != TypeId::ERROR {
                continue;
            }
            fits = false;
            if self.ty(value) != TypeId::ERROR && wanted != TypeId::ERROR && !self.is_void(value) {
                if wrong.is_empty() {
                    said = message(self, i);
                }
                wrong.push((value, arg, wanted));
            }
        }
        self.wrong_types(&wrong, &said);
        fits
    }

    /// Makes a struct or array from arguments whose types are correct.
    fn composite(
        &mut self,
        args: List<ast::ExprId>,
        ty: TypeId,
        loc: Loc,
        kind: impl FnOnce(List<ExprId>) -> ExprKind,
    ) -> ExprId {
        let ast = self.ast;
        let base = self.expr_stack.len();
        for &arg in &ast[args] {
            let id = self.lowered_expr(arg);
            self.expr_stack.push(id);
        }
        let id = if self.expr_stack[base..].iter().all(|&id| self.is_constant(id)) {
            let count = self.expr_stack[base..].iter().map(|&id| self.words(id).map_or(0, <[u32]>::len)).sum();
            if !self.has_room(count, loc) {
                self.expr_stack.truncate(base);
                return self.error_expr_of(ty, loc);
            }
            let start = self.word_stack.len();
            let mut words = std::mem::take(&mut self.word_stack);
            for &id in &self.expr_stack[base..] {
                words.extend_from_slice(self.words(id).expect("constant"));
            }
            let id = self.constant(ty, &words[start..], loc);
            words.truncate(start);
            self.word_stack = words;
            id
        } else {
            let flags = self.inherited(&self.expr_stack[base..]);
            let args = self.module.list(&self.expr_stack[base..]);
            self.push(kind(args), ty, flags, loc)
        };
        self.expr_stack.truncate(base);
        id
    }
}
