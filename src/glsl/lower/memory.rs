//! What variables hold: from a read or a write of one, or of a part of one, until something writes there.
//!
//! Then terms of two expressions are seen to be the same, and constants reach the place where they are used, as OpenGL's compilers
//! have it.

use naga::{Expression, Handle, Statement, Type, TypeInner};

use super::function::{Builder, Value};

impl Builder<'_, '_> {
    /// What a pointer points to.
    pub fn load(&mut self, pointer: Value) -> Value {
        let variable = self.variable(pointer);
        let known = self.loaded.get(&variable);
        if let Some(&value) = known.and_then(|parts| parts.get(&pointer)) {
            return value;
        }
        let members: Vec<(u32, Value)> = known.map_or_else(Vec::new, |parts| {
            let member = |(&part, &value): (&Value, &Value)| match self.f.expressions[part] {
                Expression::AccessIndex { base, index } if base == pointer => Some((index, value)),
                _ => None,
            };
            parts.iter().filter_map(member).collect()
        });
        let value = self.add(Expression::Load { pointer });
        if self.is_structure(pointer) {
            self.members.extend(members.into_iter().map(|(index, member)| ((value, index), member)));
        }
        self.know(variable, pointer, value);
        value
    }

    /// Writes to memory. Of a scalar or vector that is no part of an array, matrix or vector it is known from then on what it
    /// holds.
    pub fn store(&mut self, pointer: Value, value: Value) {
        self.push(Statement::Store { pointer, value });
        let Some(ty) = self.pointee(pointer) else { return };
        if matches!(self.cx.out.types[ty].inner, TypeInner::Scalar(_) | TypeInner::Vector { .. }) {
            self.name(value);
            self.constructed.insert(value);
            if let Expression::Compose { components, .. } = &self.f.expressions[value] {
                self.constructed.extend(components);
            }
            let variable = self.variable(pointer);
            self.know(variable, pointer, value);
        }
    }

    /// Something is written by a pointer: what is known of other members of a structure stays.
    pub fn forget(&mut self, pointer: Value) {
        let (variable, path) = self.path(pointer);
        self.written.insert(variable);
        let Some(mut parts) = self.loaded.remove(&variable) else { return };
        parts.retain(|&part, _| {
            let (_, other) = self.path(part);
            let shared = path.len().min(other.len());
            path[..shared] != other[..shared]
        });
        if !parts.is_empty() {
            self.loaded.insert(variable, parts);
        }
    }

    /// What a pointer points into. Different ones are different memory: arguments are passed in place where they are the only way
    /// to what they point to.
    fn variable(&self, mut pointer: Value) -> Value {
        while let Expression::Access { base, .. } | Expression::AccessIndex { base, .. } = self.f.expressions[pointer] {
            pointer = base;
        }
        pointer
    }

    /// The variable that a pointer points into, and the members of structures that lead to what it points to or, where that
    /// lies within something else, to that.
    fn path(&self, mut pointer: Value) -> (Value, Vec<u32>) {
        let mut path = Vec::new();
        loop {
            match self.f.expressions[pointer] {
                Expression::AccessIndex { base, index } => {
                    if self.is_structure(base) {
                        path.push(index);
                    } else {
                        path.clear();
                    }
                    pointer = base;
                }
                Expression::Access { base, .. } => {
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
        self.pointee(pointer).is_some_and(|ty| matches!(self.cx.out.types[ty].inner, TypeInner::Struct { .. }))
    }

    /// The type of a variable of this module, or of a member of one.
    fn pointee(&self, pointer: Value) -> Option<Handle<Type>> {
        match self.f.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(self.f.local_variables[variable].ty),
            Expression::GlobalVariable(variable) => Some(self.cx.out.global_variables[variable].ty),
            Expression::AccessIndex { base, index } => match &self.cx.out.types[self.pointee(base)?].inner {
                TypeInner::Struct { members, .. } => Some(members[index as usize].ty),
                _ => None,
            },
            _ => None,
        }
    }

    /// What `pointer`, into `variable`, points to is `value`.
    fn know(&mut self, variable: Value, pointer: Value, value: Value) {
        self.loaded.entry(variable).or_default().insert(pointer, value);
        self.loaded_in_order.push((variable, pointer));
    }
}
