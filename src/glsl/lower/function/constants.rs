//! Literals, zeros and folded composites, each created once per function; memory of the module.

use super::Builder;
use crate::{
    ast::Ident,
    hir::{ConstId, LocalId, Scalar, Type, TypeId},
    ir::{self, Op, Value},
    lower::{
        context::const_id,
        names::{Unset, UnsetKind},
    },
};

/// One component of a value, as far as it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::lower) enum Part {
    Known(f32),
    /// Component `.1` of a vector, or a scalar.
    Of(Value, u32),
}

impl Builder<'_, '_> {
    /// Returns a scalar constant, bit for bit.
    pub(crate) fn literal(&mut self, scalar: Scalar, bits: u32) -> Value {
        let key = (scalar as u8, bits);
        if let Some(&value) = self.literals.get(&key) {
            return value;
        }
        let value = self.add_before(Op::Literal(scalar, bits));
        self.literals.insert(key, value);
        value
    }

    pub(crate) fn float(&mut self, value: f32) -> Value {
        self.literal(Scalar::Float, value.to_bits())
    }

    /// Returns the number of a value that is a literal float.
    pub(crate) fn number(&self, value: Value) -> Option<f32> {
        match self.f[value] {
            Op::Literal(Scalar::Float, bits) => Some(f32::from_bits(bits)),
            _ => None,
        }
    }

    /// Returns the bits of a literal int or uint.
    pub(crate) fn integer(&self, value: Value) -> Option<u32> {
        match self.f[value] {
            Op::Literal(Scalar::Int | Scalar::Uint, bits) => Some(bits),
            _ => None,
        }
    }

    pub(crate) fn zero(&mut self, ty: TypeId) -> Value {
        if ty == TypeId::FLOAT {
            return self.float(0.0);
        }
        if let Some(&value) = self.zeros.get(&ty) {
            return value;
        }
        let value = self.add_before(Op::Zero(ty));
        self.zeros.insert(ty, value);
        value
    }

    /// Returns the zero that WebGL uses where GLSL leaves a value undefined: a variable that was never written, the
    /// result of a function that ends without one. `name` is that of the declaration which should have initialised it.
    pub(crate) fn undefined(&mut self, ty: TypeId, kind: UnsetKind, name: Ident) -> Value {
        if !self.cx.marks.undefined {
            return self.zero(ty);
        }
        let value = self.add_before(Op::Zero(ty));
        self.undefined.push(Unset { value, kind, name: name.symbol, loc: name.loc() });
        value
    }

    /// As [`Builder::undefined`], for a local variable or a parameter.
    pub(crate) fn undefined_local(&mut self, kind: UnsetKind, local: LocalId) -> Value {
        let declared = &self.cx.hir[local];
        match declared.name {
            Some(name) => self.undefined(declared.ty, kind, name),
            // An unnamed parameter: the value that is copied from it is still undefined.
            None => {
                let function = self.func.map(|func| self.cx.hir[func].name);
                match function {
                    Some(name) => self.undefined(declared.ty, kind, name),
                    None => self.zero(declared.ty),
                }
            }
        }
    }

    /// Returns a folded composite.
    pub(crate) fn constant(&mut self, id: ConstId) -> Value {
        self.const_value(const_id(id))
    }

    /// Returns a constant of the module.
    pub(crate) fn const_value(&mut self, id: ir::ConstId) -> Value {
        let key = id.index() as u32;
        if let Some(&value) = self.constants.get(&key) {
            return value;
        }
        let value = self.add_before(Op::Const(id));
        self.constants.insert(key, value);
        value
    }

    /// Returns whether a variable can be initialised with a constant: it is not long, and contains only finite numbers.
    pub(crate) fn is_initialiser(&mut self, id: ConstId) -> bool {
        let constant = &self.cx.out[const_id(id)];
        let ty = constant.ty;
        let is_number = |bits: &u32| f32::from_bits(*bits).is_finite();
        (constant.words.iter().all(is_number) || !self.cx.out.contains_floats(ty)) && !self.cx.is_long(ty)
    }

    pub(crate) fn compose(&mut self, ty: TypeId, parts: Vec<Value>) -> Value {
        self.add(Op::Compose { ty, parts: parts.into() })
    }

    /// Returns the place of a global.
    pub(crate) fn global(&mut self, global: ir::GlobalId) -> Value {
        if let Some(&value) = self.globals.get(&global) {
            return value;
        }
        let value = self.add_before(Op::Global(global));
        self.globals.insert(global, value);
        value
    }

    /// Returns the components of a float constant; one for a scalar or a splat.
    pub(crate) fn floats(&self, value: Value) -> Option<Vec<f32>> {
        match &self.f[value] {
            Op::Literal(..) => Some(vec![self.number(value)?]),
            Op::Splat { value, .. } => self.floats(*value),
            Op::Compose { parts, .. } => parts.iter().map(|&part| self.number(part)).collect(),
            Op::Const(id) => {
                let constant = &self.cx.out[*id];
                let is_vector =
                    matches!(self.cx.out.types.get(constant.ty), Type::Vector { scalar: Scalar::Float, .. });
                let numbers = || constant.words.iter().map(|&bits| f32::from_bits(bits));
                (is_vector && numbers().all(f32::is_finite)).then(|| numbers().collect())
            }
            Op::Part { base, index } => match self.f[*base] {
                Op::Const(_) => Some(vec![*self.floats(*base)?.get(*index as usize)?]),
                _ => None,
            },
            _ => None,
        }
    }

    pub(crate) fn part(&self, value: Value, index: u32) -> Part {
        if let Some(floats) = self.floats(value) {
            return Part::Known(floats[(index as usize).min(floats.len() - 1)]);
        }
        match self.f[value] {
            Op::Splat { value, .. } => Part::Of(value, 0),
            _ => Part::Of(value, index),
        }
    }
}
