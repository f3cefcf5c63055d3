//! Checks the rules that can be checked statically. A broken rule is a bug of the part of the compiler that ran last.

use super::{Block, FuncId, Function, Module, Op, Stmt, Value};
use crate::types::{Scalar, Type, TypeId};

/// Checks a program; the error names the broken rule and the place.
///
/// - Each value is computed once, and its statement dominates its uses.
/// - Places are operands of loads, stores, parts and calls only; stores never write read-only memory.
/// - Types agree.
/// - A variable without an initial value is not read before it is written, in text order.
/// - A `Break` or `Continue` is inside a loop or switch, and is the last statement of its block.
pub fn verify(module: &Module) -> Result<(), String> {
    for (index, function) in module.functions.iter().enumerate() {
        let mut check = Check {
            module,
            function,
            index,
            available: vec![false; function.len()],
            written: function.vars.iter().map(|var| var.init.is_some()).collect(),
            breakable: 0,
            loops: 0,
        };
        for (value, op) in function.values() {
            if op.is_free() {
                check.available[value.index()] = true;
            }
        }
        check.block(&function.body).map_err(|reason| format!("function {index}: {reason}"))?;
    }
    Ok(())
}

/// Checks a program in debug builds, and so in all tests, after the part of the compiler of this name.
///
/// # Panics
/// If a rule is broken.
pub fn assert_kept(module: &Module, culprit: &str) {
    if cfg!(debug_assertions)
        && let Err(reason) = verify(module)
    {
        let text = super::print::print(module);
        panic!("`{culprit}` breaks a rule of the intermediate representation: {reason}\n{text}");
    }
}

struct Check<'a> {
    module: &'a Module,
    function: &'a Function,
    /// The number of the function, which may only call earlier ones.
    index: usize,
    /// True if the value has been computed on every path to this point, by [`Value::index`].
    available: Vec<bool>,
    /// True if a variable has an initial value or has been written, by [`VarId::index`](super::VarId::index).
    written: Vec<bool>,
    /// The number of enclosing loops and switches; `loops` is that of loops only.
    breakable: usize,
    loops: usize,
}

impl Check<'_> {
    fn block(&mut self, block: &Block) -> Result<(), String> {
        let mut defined = Vec::new();
        for (i, stmt) in block.iter().enumerate() {
            let ends = matches!(stmt, Stmt::Break | Stmt::Continue | Stmt::Return(_) | Stmt::Discard | Stmt::Output(_));
            if ends && i + 1 < block.len() {
                return Err(format!("statements follow {stmt:?}"));
            }
            self.statement(stmt, &mut defined)?;
        }
        for value in defined {
            self.available[value.index()] = false;
        }
        Ok(())
    }

    fn statement(&mut self, stmt: &Stmt, defined: &mut Vec<Value>) -> Result<(), String> {
        match stmt {
            Stmt::Let(value) => {
                self.op(*value)?;
                if std::mem::replace(&mut self.available[value.index()], true) {
                    return Err(format!("{value:?} is computed twice"));
                }
                defined.push(*value);
                self.memory(*value)?;
            }
            Stmt::Store { place, value } => {
                self.writes(*place);
                self.place(*place)?;
                self.value(*value)?;
                self.expect(*value, self.function.ty(*place))?;
                if let Op::Global(id) = self.function[self.function.root(*place)]
                    && self.module[id].kind.is_read_only()
                {
                    return Err(format!("a store to {:?}", self.module[id]));
                }
            }
            Stmt::If { condition, accept, reject } => {
                self.value(*condition)?;
                self.expect(*condition, TypeId::BOOL)?;
                self.block(accept)?;
                self.block(reject)?;
            }
            Stmt::Loop { body, continuing, break_if } => {
                self.breakable += 1;
                self.loops += 1;
                self.block(body)?;
                self.continuing(continuing, *break_if)?;
                self.breakable -= 1;
                self.loops -= 1;
            }
            Stmt::Switch { selector, cases } => {
                self.value(*selector)?;
                if !matches!(self.function.ty(*selector), TypeId::INT | TypeId::UINT) {
                    return Err(format!("{selector:?} selects a case"));
                }
                self.breakable += 1;
                for case in cases {
                    self.block(&case.body)?;
                }
                self.breakable -= 1;
            }
            Stmt::Break if self.breakable == 0 => return Err("a break without a loop".into()),
            Stmt::Continue if self.loops == 0 => return Err("a continue without a loop".into()),
            Stmt::Return(value) => {
                if let Some(value) = value {
                    self.value(*value)?;
                    self.expect(*value, self.function.result)?;
                } else if self.function.result != TypeId::VOID {
                    return Err("a return without a value".into());
                }
            }
            Stmt::Output(parts) => {
                for (_, value) in parts {
                    self.value(*value)?;
                }
            }
            Stmt::Break | Stmt::Continue | Stmt::Discard => {}
        }
        Ok(())
    }

    /// Records what a call may write, and rejects loads of memory that has not been written.
    fn memory(&mut self, value: Value) -> Result<(), String> {
        let function = self.function;
        match function[value] {
            Op::Load { place } => match function[function.root(place)] {
                Op::Var(var) if !self.written[var.index()] => Err(format!("{value:?} reads what nothing has written")),
                _ => Ok(()),
            },
            Op::Call { ref args, .. } => {
                args.iter().filter(|&&arg| function.is_place(arg)).for_each(|&arg| self.writes(arg));
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn writes(&mut self, place: Value) {
        if let Op::Var(var) = self.function[self.function.root(place)] {
            self.written[var.index()] = true;
        }
    }

    /// Checks the part of a loop that may compute the value of `break_if`.
    fn continuing(&mut self, block: &Block, break_if: Option<Value>) -> Result<(), String> {
        let mut defined = Vec::new();
        for stmt in block {
            self.statement(stmt, &mut defined)?;
        }
        if let Some(value) = break_if {
            self.value(value)?;
            self.expect(value, TypeId::BOOL)?;
        }
        for value in defined {
            self.available[value.index()] = false;
        }
        Ok(())
    }

    fn value(&self, value: Value) -> Result<(), String> {
        if !self.available[value.index()] {
            return Err(format!("{value:?} = {:?} is used where it is not computed", self.function[value]));
        }
        if self.function.is_place(value) {
            return Err(format!("{value:?} is a place, and used as a value"));
        }
        Ok(())
    }

    fn place(&self, place: Value) -> Result<(), String> {
        if !self.available[place.index()] {
            return Err(format!("{place:?} = {:?} is used where it is not computed", self.function[place]));
        }
        if !self.function.is_place(place) {
            return Err(format!("{place:?} = {:?} is no place", self.function[place]));
        }
        Ok(())
    }

    fn expect(&self, value: Value, ty: TypeId) -> Result<(), String> {
        let found = self.function.ty(value);
        match found == ty {
            true => Ok(()),
            false => Err(format!("{value:?} = {:?} has type {found:?}, not {ty:?}", self.function[value])),
        }
    }

    fn op(&self, value: Value) -> Result<(), String> {
        let f = self.function;
        let op = &f[value];
        if op.is_free() {
            return Err(format!("{value:?} = {op:?} needs no statement"));
        }
        match *op {
            Op::Part { base, index } => {
                if !self.available[base.index()] {
                    return self.value(base);
                }
                if index >= self.module.extent(f.ty(base)) {
                    return Err(format!("{value:?} = {op:?} is out of range"));
                }
            }
            Op::Element { base, index } => {
                self.value(index)?;
                if !matches!(f.ty(index), TypeId::INT | TypeId::UINT) {
                    return Err(format!("{value:?} = {op:?} is indexed by {:?}", f.ty(index)));
                }
                if !f.is_place(base) {
                    self.value(base)?;
                    if !matches!(self.module.types.get(f.ty(base)), Type::Vector { .. }) {
                        return Err(format!("{value:?} = {op:?} indexes a value that is no vector"));
                    }
                }
            }
            Op::Load { place } => self.place(place)?,
            Op::Call { function, ref args } => self.call(function, args)?,
            _ => {
                let mut result = Ok(());
                op.operands(|operand| {
                    if result.is_ok() {
                        result = self.value(operand);
                    }
                });
                result?;
            }
        }
        self.types(value)
    }

    fn call(&self, callee: FuncId, args: &[Value]) -> Result<(), String> {
        if callee.index() >= self.index {
            return Err(format!("a call of {callee:?}, which comes later"));
        }
        let params = &self.module[callee].params;
        if params.len() != args.len() {
            return Err(format!("a call of {callee:?} with {} arguments", args.len()));
        }
        for (param, &arg) in params.iter().zip(args) {
            match param.by_reference {
                true => self.place(arg)?,
                false => self.value(arg)?,
            }
            self.expect(arg, param.ty)?;
        }
        Ok(())
    }

    fn types(&self, value: Value) -> Result<(), String> {
        let f = self.function;
        let op = &f[value];
        let module = self.module;
        let scalar = |value: Value| module.types.scalar(f.ty(value));
        let fits = match *op {
            Op::Binary { left, right, .. } => {
                scalar(left) == scalar(right)
                    || matches!(op, Op::Binary { op: super::Binary::ShiftLeft | super::Binary::ShiftRight, .. })
            }
            Op::Select { condition, accept, reject } => {
                scalar(condition) == Some(Scalar::Bool) && f.ty(accept) == f.ty(reject)
            }
            Op::All(operand) | Op::Any(operand) => scalar(operand) == Some(Scalar::Bool),
            Op::Compose { ty, ref parts } => self.composes(ty, parts),
            _ => true,
        };
        let inferred = match op {
            Op::TextureSize { .. } => f.ty(value),
            _ => super::infer::ty(module, f, op),
        };
        if !fits || inferred != f.ty(value) {
            return Err(format!("{value:?} = {op:?} does not fit its operands, or is no {:?}", f.ty(value)));
        }
        Ok(())
    }

    fn composes(&self, ty: TypeId, parts: &[Value]) -> bool {
        let f = self.function;
        match self.module.types.get(ty) {
            Type::Vector { scalar, size } => {
                let components = |part: &Value| self.module.types.components(f.ty(*part)).unwrap_or(0);
                parts.iter().map(components).sum::<u32>() == u32::from(size)
                    && parts.iter().all(|&part| self.module.types.scalar(f.ty(part)) == Some(scalar))
            }
            _ => {
                parts.len() == self.module.extent(ty) as usize
                    && (0..).zip(parts).all(|(i, &part)| f.ty(part) == self.module.part(ty, i))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ast::Loc;

    #[test]
    fn load_of_unwritten_memory_is_rejected() {
        let mut f = Function::new(TypeId::VOID);
        let var = f.add_var(TypeId::FLOAT);
        let place = f.append(Op::Var(var), TypeId::FLOAT, Loc::default());
        let zero = f.append(Op::Literal(Scalar::Float, 0), TypeId::FLOAT, Loc::default());
        let load = f.append(Op::Load { place }, TypeId::FLOAT, Loc::default());
        let mut module = Module { functions: vec![f], ..Module::default() };
        module.functions[0].body = vec![Stmt::Let(load)];
        assert!(verify(&module).is_err());
        module.functions[0].body = vec![Stmt::Store { place, value: zero }, Stmt::Let(load)];
        assert_eq!(verify(&module), Ok(()));
        module.functions[0].body = vec![Stmt::Let(load)];
        module.functions[0].vars[0].init = Some(zero);
        assert_eq!(verify(&module), Ok(()));
    }
}
