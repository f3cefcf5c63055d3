//! Long values that are stored as a whole: copies by loops, and constructors that contain them.
//!
//! Elements that a constructor computes remain one store each. Storing them in short arrays that loops copy was tried:
//! arrays of numbers compiled faster, and arrays of structures slower.

use naga::{
    AddressSpace, ArraySize, BinaryOperator, Block, Expression, Function, Handle, Range, Span, Statement, Type,
    TypeInner,
};

use super::writer::{MIN_ARRAY, Value, Writer};

/// The number of scalars from which on an array, and a constant, is copied by a loop. lavapipe stores to an element
/// with a loop index lane by lane, which takes up to twice as long.
pub(crate) const MIN_COPY: u32 = 128;

/// Loads whose memory has not been written since, each with its pointer's root.
#[derive(Default)]
pub(super) struct Loads(Vec<(Value, Value)>);

impl Loads {
    /// Adds the loads among expressions that are computed now.
    pub(super) fn record(&mut self, range: Range<Expression>, function: &Function) {
        self.0.extend(range.filter_map(|value| match function.expressions[value] {
            Expression::Load { pointer } => Some((value, root(function, pointer))),
            _ => None,
        }));
    }

    /// Removes the loads of memory that is stored to by this pointer.
    pub(super) fn invalidate(&mut self, pointer: Value, function: &Function) {
        let written = root(function, pointer);
        self.0.retain(|&(_, read)| are_disjoint(function, written, read));
    }

    pub(super) fn invalidate_all(&mut self) {
        self.0.clear();
    }
}

/// Returns the variable, or the argument, that a pointer is derived from.
fn root(function: &Function, mut pointer: Value) -> Value {
    while let Expression::Access { base, .. } | Expression::AccessIndex { base, .. } = function.expressions[pointer] {
        pointer = base;
    }
    pointer
}

/// Returns whether two roots are certainly different memory. A pointer argument may point to any variable.
fn are_disjoint(function: &Function, a: Value, b: Value) -> bool {
    use Expression::{GlobalVariable, LocalVariable};
    match (&function.expressions[a], &function.expressions[b]) {
        (LocalVariable(a), LocalVariable(b)) => a != b,
        (GlobalVariable(a), GlobalVariable(b)) => a != b,
        (LocalVariable(_), GlobalVariable(_)) | (GlobalVariable(_), LocalVariable(_)) => true,
        _ => false,
    }
}

impl Writer<'_> {
    /// Stores a value by loops; returns `false` if the original store must be kept.
    pub(super) fn store_long(&mut self, pointer: Value, value: Value, loads: &Loads, block: &mut Block) -> bool {
        let Some(ty) = self.pointee(pointer) else { return false };
        if self.sizes.longest(ty) < MIN_ARRAY {
            return false;
        }
        if let Expression::ZeroValue(_) = self.function.expressions[value] {
            self.fill(pointer, ty, block);
            return true;
        }
        if !self.should_use_loops(ty, value, loads) {
            return false;
        }
        if let Expression::Load { pointer: from } = self.function.expressions[value] {
            self.copy(pointer, from, ty, block);
            return true;
        }
        let target = root(self.function, pointer);
        if self.reads(value, target) {
            return false;
        }
        self.construct(pointer, ty, value, loads, block);
        true
    }

    /// Returns whether storing this value by loops is possible and better.
    fn should_use_loops(&self, ty: Handle<Type>, value: Value, loads: &Loads) -> bool {
        let is_long = self.sizes.longest(ty) >= MIN_COPY;
        is_long
            && match self.function.expressions[value] {
                Expression::Load { pointer } => {
                    let from = root(self.function, pointer);
                    let stays = match self.function.expressions[from] {
                        Expression::GlobalVariable(variable) => {
                            matches!(self.globals.get(variable.index()), Some((_, AddressSpace::Storage { .. })))
                        }
                        _ => false,
                    };
                    stays || loads.0.iter().any(|(load, _)| *load == value)
                }
                Expression::Compose { .. } => true,
                _ => false,
            }
    }

    /// Returns whether a constructor's long parts are read from memory that may overlap the target.
    fn reads(&self, value: Value, target: Value) -> bool {
        match &self.function.expressions[value] {
            Expression::Load { pointer } => {
                let is_long = self.pointee(*pointer).is_some_and(|ty| self.sizes.longest(ty) >= MIN_COPY);
                is_long && !are_disjoint(self.function, root(self.function, *pointer), target)
            }
            Expression::Compose { components, .. } => components.iter().any(|&part| self.reads(part, target)),
            _ => false,
        }
    }

    /// Stores a constructor's parts.
    fn construct(&mut self, pointer: Value, ty: Handle<Type>, value: Value, loads: &Loads, block: &mut Block) {
        let use_loops = self.should_use_loops(ty, value, loads);
        let components = match self.function.expressions[value] {
            Expression::Load { pointer: from } if use_loops => return self.copy(pointer, from, ty, block),
            Expression::ZeroValue(_) => return self.fill(pointer, ty, block),
            Expression::Compose { ref components, .. } if use_loops => components.clone(),
            _ => return block.push(Statement::Store { pointer, value }, Span::UNDEFINED),
        };
        let parts: Vec<_> = match self.types[ty].inner {
            TypeInner::Struct { ref members, .. } => members.iter().map(|member| member.ty).collect(),
            TypeInner::Array { base, .. } if self.sizes.longest(base) >= MIN_COPY => vec![base; components.len()],
            _ => return block.push(Statement::Store { pointer, value }, Span::UNDEFINED),
        };
        for ((index, ty), value) in (0..).zip(parts).zip(components) {
            let place = self.emit(Expression::AccessIndex { base: pointer, index }, block);
            self.construct(place, ty, value, loads, block);
        }
    }

    /// Copies the value that `from` points to.
    fn copy(&mut self, to: Value, from: Value, ty: Handle<Type>, block: &mut Block) {
        match self.types[ty].inner {
            TypeInner::Array { base, size: ArraySize::Constant(len), .. } if self.sizes.scalars(ty) >= MIN_ARRAY => {
                let len = self.unknown(len.get(), block);
                self.count(len, block, |writer, index, body| {
                    let [to, from] = [to, from].map(|base| writer.emit(Expression::Access { base, index }, body));
                    writer.copy(to, from, base, body);
                });
            }
            TypeInner::Struct { ref members, .. } if self.sizes.longest(ty) >= MIN_ARRAY => {
                let members: Vec<_> = members.iter().map(|member| member.ty).collect();
                for (index, member) in (0..).zip(members) {
                    let parts = [to, from].map(|base| self.emit(Expression::AccessIndex { base, index }, block));
                    self.copy(parts[0], parts[1], member, block);
                }
            }
            _ => {
                let value = self.emit(Expression::Load { pointer: from }, block);
                block.push(Statement::Store { pointer: to, value }, Span::UNDEFINED);
            }
        }
    }

    /// Returns a number that no driver knows, so that none unrolls a loop with this number of iterations.
    fn unknown(&mut self, number: u32, block: &mut Block) -> Value {
        let number = self.uint(number);
        let Some(opaque) = self.opaque else { return number };
        let pointer = self.expression(Expression::GlobalVariable(opaque));
        let right = self.emit(Expression::Load { pointer }, block);
        self.emit(Expression::Binary { op: BinaryOperator::Add, left: number, right }, block)
    }

    /// Returns the type that a pointer points to; `None` for a component.
    fn pointee(&self, pointer: Value) -> Option<Handle<Type>> {
        let part = |base: Value, index: Option<u32>| match &self.types[self.pointee(base)?].inner {
            TypeInner::Array { base, .. } => Some(*base),
            TypeInner::Struct { members, .. } => Some(members.get(index? as usize)?.ty),
            _ => None,
        };
        match self.function.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(self.function.local_variables[variable].ty),
            Expression::GlobalVariable(variable) => self.globals.get(variable.index()).map(|(ty, _)| *ty),
            Expression::FunctionArgument(index) => match self.types[self.function.arguments[index as usize].ty].inner {
                TypeInner::Pointer { base, .. } => Some(base),
                _ => None,
            },
            Expression::Access { base, .. } => part(base, None),
            Expression::AccessIndex { base, index } => part(base, Some(index)),
            _ => None,
        }
    }
}
