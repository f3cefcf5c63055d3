//! Literals, zeros and folded composites, each made once a function; memory of the module.

use naga::{Expression, Handle};

use super::{Builder, Value};
use crate::glsl::{
    hir::{ConstId, Scalar, Type, TypeId},
    lower::consts,
};

impl Builder<'_, '_> {
    /// A scalar constant, bit for bit.
    pub fn literal(&mut self, scalar: Scalar, bits: u32) -> Value {
        let key = (scalar as u8, bits);
        if let Some(&value) = self.literals.get(&key) {
            return value;
        }
        match consts::literal(scalar, bits) {
            Some(literal) => {
                let value = self.given(Expression::Literal(literal));
                self.literals.insert(key, value);
                value
            }
            // Not kept: it is computed in the block at hand.
            None => {
                let bits = self.literal(Scalar::Uint, bits);
                self.add(Expression::As { expr: bits, kind: naga::ScalarKind::Float, convert: None })
            }
        }
    }

    pub fn float(&mut self, value: f32) -> Value {
        self.literal(Scalar::Float, value.to_bits())
    }

    pub fn zero(&mut self, ty: TypeId) -> Value {
        if ty == TypeId::FLOAT {
            return self.float(0.0);
        }
        let ty = self.cx.ty(ty);
        if let Some(&value) = self.zeros.get(&ty) {
            return value;
        }
        let value = self.given(Expression::ZeroValue(ty));
        self.zeros.insert(ty, value);
        value
    }

    /// A folded composite.
    pub fn constant(&mut self, id: ConstId) -> Value {
        let key = id.index() as u32;
        if let Some(&value) = self.constants.get(&key) {
            return value;
        }
        match self.cx.constant(id) {
            Some(constant) => {
                let value = self.given(Expression::Constant(constant));
                self.constants.insert(key, value);
                value
            }
            None => {
                let hir = self.cx.hir;
                let constant = hir[id];
                if let Some(place) = self.long_table(id) {
                    return self.load_place(place);
                }
                self.value_of_words(constant.ty, &mut hir[constant.words].iter().copied())
            }
        }
    }

    fn value_of_words(&mut self, ty: TypeId, words: &mut dyn Iterator<Item = u32>) -> Value {
        let hir = self.cx.hir;
        let parts = match hir.types.get(ty) {
            Type::Scalar(scalar) => return self.literal(scalar, words.next().expect("as many words as scalars")),
            Type::Struct(id) => hir[hir[id].members].iter().map(|m| self.value_of_words(m.ty, words)).collect(),
            Type::Array { element, len } => (0..len).map(|_| self.value_of_words(element, words)).collect(),
            Type::Matrix { columns, rows } => {
                let column = TypeId::vector(Scalar::Float, rows);
                (0..columns).map(|_| self.value_of_words(column, words)).collect()
            }
            Type::Vector { scalar, size } => {
                let scalar = TypeId::vector(scalar, 1);
                (0..size).map(|_| self.value_of_words(scalar, words)).collect()
            }
            other => unreachable!("{other:?} is no type of a value"),
        };
        self.compose(ty, parts)
    }

    pub fn compose(&mut self, ty: TypeId, components: Vec<Value>) -> Value {
        let ty = self.cx.ty(ty);
        self.add(Expression::Compose { ty, components })
    }

    /// The pointer to (or handle of) a module-scope variable.
    pub fn global(&mut self, global: Handle<naga::GlobalVariable>) -> Value {
        if let Some(&value) = self.globals.get(&global) {
            return value;
        }
        let value = self.given(Expression::GlobalVariable(global));
        self.globals.insert(global, value);
        value
    }
}
