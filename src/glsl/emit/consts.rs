//! Translates constants to naga's.
//!
//! naga rejects infinities and NaN as literals. A composite that contains one is built from bit patterns where it is
//! used; a table with one is filled when the entry point starts. The same holds for a long global that the program
//! writes, if the driver requires it ([`super::long_arrays`]); the driver recognises globals that are only read as
//! constants.

use naga::{Expression, GlobalVariable, Handle, Literal, Span};

use super::context::Emitter;
use crate::{
    ir::ConstId,
    types::{Scalar, Type, TypeId},
};

/// Returns a scalar as a naga literal; `None` for infinities and NaN.
pub(super) fn literal(scalar: Scalar, bits: u32) -> Option<Literal> {
    Some(match scalar {
        Scalar::Bool => Literal::Bool(bits != 0),
        Scalar::Int => Literal::I32(bits as i32),
        Scalar::Uint => Literal::U32(bits),
        Scalar::Float => Literal::F32(Some(f32::from_bits(bits)).filter(|value| value.is_finite())?),
    })
}

impl Emitter<'_> {
    /// Returns a naga constant; `None` if it contains an infinity or NaN, or is long.
    pub(super) fn constant(&mut self, id: ConstId) -> Option<Handle<naga::Constant>> {
        if let Some(made) = self.consts.constants[id.index()] {
            return Some(made);
        }
        let ty = self.ir[id].ty;
        if self.is_long(ty) {
            return None;
        }
        let init = self.constant_init(id)?;
        let ty = self.ty(ty);
        let made = self.out.constants.append(naga::Constant { name: None, ty, init }, Span::UNDEFINED);
        self.consts.constants[id.index()] = Some(made);
        Some(made)
    }

    /// Returns a constant as a module-scope expression.
    pub(super) fn constant_init(&mut self, id: ConstId) -> Option<Handle<Expression>> {
        if let Some(init) = self.consts.inits[id.index()] {
            return init;
        }
        let constant = &self.ir[id];
        // Checked first, so that no half-built composite is left over.
        let init = self.all_finite(constant.ty, &mut constant.words.iter().copied()).then(|| {
            let mut words = constant.words.iter().copied();
            self.global_expression(constant.ty, &mut words)
        });
        self.consts.inits[id.index()] = Some(init);
        init
    }

    fn all_finite(&self, ty: TypeId, words: &mut dyn Iterator<Item = u32>) -> bool {
        match self.ir.types.get(ty) {
            Type::Array { element, len } => (0..len).all(|_| self.all_finite(element, words)),
            Type::Struct(id) => self.ir.structs[id.index()].iter().all(|&member| self.all_finite(member, words)),
            _ => {
                let scalar = self.ir.scalar(ty);
                let count = self.ir.types.components(ty).expect("a value");
                (0..count).all(|_| words.next().is_some_and(|bits| literal(scalar, bits).is_some()))
            }
        }
    }

    fn global_expression(&mut self, ty: TypeId, words: &mut dyn Iterator<Item = u32>) -> Handle<Expression> {
        let ir = self.ir;
        let components = match ir.types.get(ty) {
            Type::Scalar(scalar) => {
                return self.global_literal(scalar, words.next().expect("as many words as scalars"));
            }
            Type::Vector { scalar, size } => {
                let word = |_| self.global_literal(scalar, words.next().expect("as many words as scalars"));
                (0..size).map(word).collect()
            }
            Type::Matrix { columns, rows } => {
                let column = TypeId::vector(Scalar::Float, rows);
                (0..columns).map(|_| self.global_expression(column, words)).collect()
            }
            Type::Array { element, len } => (0..len).map(|_| self.global_expression(element, words)).collect(),
            Type::Struct(id) => {
                ir.structs[id.index()].iter().map(|&member| self.global_expression(member, words)).collect()
            }
            other => unreachable!("{other:?} is no type of a value"),
        };
        let ty = self.ty(ty);
        self.out.global_expressions.append(Expression::Compose { ty, components }, Span::UNDEFINED)
    }

    fn global_literal(&mut self, scalar: Scalar, bits: u32) -> Handle<Expression> {
        let made = self.consts.literals.get(&(scalar as u8, bits)).copied();
        made.unwrap_or_else(|| {
            let literal = literal(scalar, bits).expect("judged before");
            let made = self.out.global_expressions.append(Expression::Literal(literal), Span::UNDEFINED);
            self.consts.literals.insert((scalar as u8, bits), made);
            made
        })
    }

    /// Returns a private global with the value of a constant, for indexing.
    pub(super) fn private_table(&mut self, id: ConstId) -> Handle<GlobalVariable> {
        let ty = self.ty(self.ir[id].ty);
        let init = self.constant_init(id);
        let table = self.private(ty, init);
        if init.is_none() {
            self.consts.set_at_start.push((table, id));
            self.overwritten.insert(table);
        }
        table
    }
}
