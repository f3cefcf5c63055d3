//! What variables hold: from a read or a write of one, or of a part of one, until something writes there.
//!
//! Then terms of two expressions are seen to be the same, and constants reach the place where they are used, as OpenGL's compilers
//! have it.

use crate::glsl::ir::{Op, Stmt, Value};
use std::collections::HashSet;

use super::{
    function::{Builder, Slot},
    walk::{Node, walk},
    writes,
};
use crate::glsl::{
    ast::List,
    hir::{Builtin, ExprId, ExprKind, FuncId, StmtId, Type, TypeId},
};

/// A structure of more scalars is not told apart when it is written as a whole.
const MOST_SCALARS: usize = 256;

/// Parts of one variable of which it is known what they hold. All are looked through where one of them is written; a
/// shader that a person wrote knows a few dozen.
const MOST_PARTS: usize = 512;

/// Module-scope variables of which that is known. All are looked through where a loop begins.
const MOST_GLOBALS: usize = 1024;

impl Builder<'_, '_> {
    /// What a pointer points to.
    pub fn load(&mut self, pointer: Value) -> Value {
        let variable = self.variable(pointer);
        let known = self.loaded.get(&variable);
        if let Some(&value) = known.and_then(|parts| parts.get(&pointer)) {
            return value;
        }
        if let Op::Part { base, index } = self.f[pointer]
            && let Some(&whole) = known.and_then(|parts| parts.get(&base))
        {
            return self.add(Op::Part { base: whole, index });
        }
        let is_structure = self.is_structure(pointer);
        let members: Vec<(u32, Value)> = known.filter(|_| is_structure).map_or_else(Vec::new, |parts| {
            let member = |(&part, &value): (&Value, &Value)| match self.f[part] {
                Op::Part { base, index } if base == pointer => Some((index, value)),
                _ => None,
            };
            parts.iter().filter_map(member).collect()
        });
        let value = self.add(Op::Load { place: pointer });
        if is_structure {
            self.members.extend(members.into_iter().map(|(index, member)| ((value, index), member)));
        }
        self.know(variable, pointer, value);
        value
    }

    /// Writes to memory. Of a scalar or vector that is no part of an array, matrix or vector it is known from then on what it
    /// holds.
    pub fn store(&mut self, pointer: Value, value: Value) {
        self.push(Stmt::Store { place: pointer, value });
        let Some(ty) = self.pointee(pointer) else { return };
        if self.is_vector_or_scalar(ty) {
            self.name(value);
            self.constructed.insert(value);
            if let Op::Compose { parts: components, .. } = &self.f[value] {
                self.constructed.extend(components);
            }
            let variable = self.variable(pointer);
            self.know(variable, pointer, value);
        } else if self.is_structure(pointer) && self.is_few_parts(ty) {
            let variable = self.variable(pointer);
            self.know_members(variable, pointer, value);
        }
    }

    /// Whether what a type holds is not too much to be told apart.
    fn is_few_parts(&self, ty: TypeId) -> bool {
        self.cx.out.scalars_up_to(ty, MOST_SCALARS) <= MOST_SCALARS
    }

    /// A structure was written: what is known of its members is known of those of the memory.
    fn know_members(&mut self, variable: Value, pointer: Value, value: Value) {
        let Some(ty) = self.pointee(pointer) else { return };
        if !matches!(self.cx.out.types.get(ty), Type::Struct(_)) {
            return;
        }
        for index in 0..self.cx.out.extent(ty) {
            let Some(member) = self.known_component(value, index) else { continue };
            let place = self.add(Op::Part { base: pointer, index });
            if self.is_structure(place) {
                self.know_members(variable, place, member);
            } else {
                self.know(variable, place, member);
            }
        }
    }

    /// Something is written by a pointer: what is known of other members of a structure stays.
    pub fn forget(&mut self, pointer: Value) {
        let (variable, path) = self.path(pointer);
        self.forget_part(variable, &path);
    }

    /// Forgets all that a loop of these statements and expressions writes, in one round or another.
    pub fn forget_written(&mut self, body: List<StmtId>, others: impl IntoIterator<Item = ExprId>) {
        if self.loaded.is_empty() {
            return;
        }
        let hir = self.cx.hir;
        let others: Vec<ExprId> = others.into_iter().collect();
        let mut written: HashSet<ExprId> = HashSet::new();
        let mut called: HashSet<FuncId> = HashSet::new();
        let mut asserts = false;
        walk(hir, &hir[body], &others, |node, _| {
            let Node::Expr(expr) = node else { return };
            writes::places(hir, expr, |place| _ = written.insert(place));
            match hir[expr].kind {
                ExprKind::Call { func, .. } => _ = called.insert(func),
                ExprKind::Builtin { builtin: Builtin::StAssert, .. } => asserts = true,
                _ => {}
            }
        });
        let mut globals = HashSet::new();
        // What is neither the author's local nor global.
        let mut others = asserts || !called.is_empty();
        for place in written {
            match hir[writes::root(hir, place)].kind {
                ExprKind::Local(local) => {
                    if let Slot::Memory(pointer) = self.slot(local) {
                        // A local is all of its memory.
                        self.forget_part(pointer, &writes::members(hir, place));
                    }
                }
                ExprKind::Global(global) => _ = globals.insert(global),
                _ => others = true,
            }
        }
        for variable in self.loaded_globals.iter().copied().collect::<Vec<_>>() {
            let Op::Global(handle) = self.f[variable] else { continue };
            let written = match self.cx.authors_global(handle) {
                Some(global) => {
                    globals.contains(&global) || called.iter().any(|&func| self.cx.arguments.writes(func, global))
                }
                None => others,
            };
            if written {
                self.forget_part(variable, &[]);
            }
        }
    }

    fn forget_part(&mut self, variable: Value, path: &[u32]) {
        self.written.insert(variable);
        let Some(mut parts) = self.loaded.remove(&variable) else { return };
        if !path.is_empty() {
            parts.retain(|&part, _| {
                let (_, other) = self.path(part);
                let shared = path.len().min(other.len());
                path[..shared] != other[..shared]
            });
            if !parts.is_empty() {
                self.loaded.insert(variable, parts);
                return;
            }
        }
        self.loaded_globals.remove(&variable);
    }

    /// Forgets all module-scope variables: a function is called.
    pub fn forget_globals(&mut self) {
        self.globals_written = true;
        for variable in self.loaded_globals.drain() {
            self.loaded.remove(&variable);
        }
    }

    /// What a pointer points into. Different ones are different memory: arguments are passed in place where they are the only way
    /// to what they point to.
    fn variable(&self, mut pointer: Value) -> Value {
        while let Op::Element { base, .. } | Op::Part { base, .. } = self.f[pointer] {
            pointer = base;
        }
        pointer
    }

    /// The variable that a pointer points into, and the members of structures that lead to what it points to or, where that
    /// lies within something else, to that.
    fn path(&self, mut pointer: Value) -> (Value, Vec<u32>) {
        let mut path = Vec::new();
        loop {
            match self.f[pointer] {
                Op::Part { base, index } => {
                    if self.is_structure(base) {
                        path.push(index);
                    } else {
                        path.clear();
                    }
                    pointer = base;
                }
                Op::Element { base, .. } => {
                    path.clear();
                    pointer = base;
                }
                _ => break,
            }
        }
        path.reverse();
        (pointer, path)
    }

    fn is_structure(&self, pointer: Value) -> bool {
        self.pointee(pointer).is_some_and(|ty| matches!(self.cx.out.types.get(ty), Type::Struct(_)))
    }

    /// The type of a variable of this module, or of a member of one.
    fn pointee(&self, pointer: Value) -> Option<TypeId> {
        match self.f[pointer] {
            Op::Var(_) | Op::Global(_) => Some(self.f.ty(pointer)),
            Op::Part { base, .. } => {
                let structure = self.pointee(base)?;
                matches!(self.cx.out.types.get(structure), Type::Struct(_)).then(|| self.f.ty(pointer))
            }
            _ => None,
        }
    }

    /// What `pointer`, into `variable`, points to is `value`.
    fn know(&mut self, variable: Value, pointer: Value, value: Value) {
        if matches!(self.f[variable], Op::Global(_)) && !self.loaded_globals.contains(&variable) {
            if self.loaded_globals.len() >= MOST_GLOBALS {
                return;
            }
            self.loaded_globals.insert(variable);
        }
        // Of an array all is forgotten at once.
        let all_known = self.loaded.get(&variable).is_some_and(|parts| parts.len() >= MOST_PARTS);
        if all_known && self.is_structure(variable) {
            return;
        }
        self.loaded.entry(variable).or_default().insert(pointer, value);
        self.loaded_in_order.push((variable, pointer));
    }
}
