//! Zeros that are written in a program, and where they get to.

use crate::glsl::{
    ir::{Binary, Block, ConstId, Function, Global, GlobalKind, Module, Op, Stmt, Value},
    types::{Scalar, Type},
};

/// The most times that all values are looked at. One time more is needed for each step by which a constant gets from
/// variable to variable against the order of the program, so that a chain of ten thousand would take as many.
pub(super) const MOST_ROUNDS: usize = 64;

/// The levels to which two expressions are compared.
const MOST_LEVELS: u32 = 8;

/// The values that are, or hold, a number that may be a zero known without running anything. Neither the order of
/// statements nor the parts of a variable are told apart: too many found cost an instruction each.
pub(super) struct Zeros {
    /// By function and [`Value::index`].
    pub(super) values: Vec<Vec<bool>>,
    vars: Vec<Vec<bool>>,
    params: Vec<Vec<bool>>,
    results: Vec<bool>,
    globals: Vec<bool>,
    /// By function: something that its values follow from has changed since they were found.
    stale: Vec<bool>,
}

impl Zeros {
    /// `None` if the program divides nothing.
    pub(super) fn of(program: &Module) -> Option<Zeros> {
        let divides = |f: &Function| {
            f.values().any(|(value, op)| match *op {
                Op::Binary { op: Binary::Divide, right, .. } => {
                    is_of_floats(program, f, value) && !matches!(f[right], Op::Literal(_, bits) if bits << 1 != 0)
                }
                _ => false,
            })
        };
        if !program.functions.iter().any(divides) {
            return None;
        }
        let mut stores: Vec<Vec<&Stmt>> = Vec::with_capacity(program.functions.len());
        for f in &program.functions {
            let mut found = Vec::new();
            collect(&f.body, &mut found);
            stores.push(found);
        }
        let none = |count: fn(&Function) -> usize| -> Vec<Vec<bool>> {
            program.functions.iter().map(|f| vec![false; count(f)]).collect()
        };
        let mut zeros = Zeros {
            values: none(Function::len),
            vars: none(|f| f.vars.len()),
            params: none(|f| f.params.len()),
            results: vec![false; program.functions.len()],
            globals: program.globals.iter().map(|global| begins_with_zero(program, global)).collect(),
            stale: vec![true; program.functions.len()],
        };
        for (index, f) in program.functions.iter().enumerate() {
            zeros.begin(index, f, &stores[index]);
        }
        for _ in 0..MOST_ROUNDS {
            if !zeros.stale.contains(&true) {
                return Some(zeros);
            }
            for (index, f) in program.functions.iter().enumerate() {
                if std::mem::take(&mut zeros.stale[index]) {
                    zeros.function(program, index, f, &stores[index]);
                }
            }
        }
        // Any may be: that costs an instruction a division.
        zeros.values.iter_mut().for_each(|values| values.fill(true));
        Some(zeros)
    }

    /// Finds the variables that hold a zero which is written as such. Most do, so that most functions are looked at
    /// once.
    fn begin(&mut self, index: usize, f: &Function, stores: &[&Stmt]) {
        let is_zero = |value: Value| matches!(f[value], Op::Literal(_, bits) if bits << 1 == 0);
        for (var, zero) in f.vars.iter().zip(&mut self.vars[index]) {
            *zero = var.init.is_some_and(is_zero);
        }
        for stmt in stores {
            if let Stmt::Store { place, value } = **stmt
                && is_zero(value)
            {
                self.write(index, f, place);
            }
        }
    }

    fn function(&mut self, program: &Module, index: usize, f: &Function, stores: &[&Stmt]) {
        let mut values = std::mem::take(&mut self.values[index]);
        for (value, op) in f.values() {
            values[value.index()] = self.value(program, index, f, (value, op), &values);
        }
        for (var, zero) in f.vars.iter().zip(&mut self.vars[index]) {
            set(zero, var.init.is_some_and(|init| values[init.index()]), &mut self.stale[index]);
        }
        for stmt in stores {
            match **stmt {
                Stmt::Store { place, value } if values[value.index()] => self.write(index, f, place),
                Stmt::Return(Some(value)) if values[value.index()] => {
                    set_of_all(&mut self.results[index], &mut self.stale)
                }
                _ => {}
            }
        }
        self.values[index] = values;
    }

    fn value(&mut self, program: &Module, index: usize, f: &Function, (of, op): (Value, &Op), values: &[bool]) -> bool {
        // What is computed later by its number, though not by its statement, may be anything.
        let is_zero = |value: Value| values[value.index()] || value > of;
        match *op {
            Op::Literal(_, bits) => bits << 1 == 0,
            Op::Zero(_) => true,
            Op::Const(id) => program[id].words.iter().any(|word| word << 1 == 0),
            Op::Param(param) => self.params[index][param as usize],
            // Of a place: what the variable holds.
            Op::Var(var) => self.vars[index][var.index()],
            Op::Global(global) => self.globals[global.index()],
            Op::Part { base, index } => match f[base] {
                Op::Const(id) if matches!(program.types.get(program[id].ty), Type::Vector { .. }) => {
                    program[id].words[index as usize] << 1 == 0
                }
                _ => is_zero(base),
            },
            Op::Swizzle { vector: of, .. }
            | Op::Splat { value: of, .. }
            | Op::Unary { operand: of, .. }
            | Op::Convert { value: of, .. }
            | Op::Bitcast { value: of, .. }
            | Op::Load { place: of } => is_zero(of),
            Op::Compose { ref parts, .. } => parts.iter().any(|&part| is_zero(part)),
            Op::Binary { op: Binary::Subtract, left, right } if is_same(f, left, right, MOST_LEVELS) => true,
            Op::Binary { op: Binary::Add | Binary::Subtract | Binary::InclusiveOr, left, right } => {
                is_zero(left) && is_zero(right)
            }
            Op::Binary { op: Binary::Multiply, left, right } => is_zero(left) || is_zero(right),
            Op::Binary { op, left, .. } => !op.is_comparison() && is_zero(left),
            Op::Math { arg, arg1, arg2, arg3, .. } => {
                is_zero(arg) || [arg1, arg2, arg3].into_iter().flatten().any(is_zero)
            }
            Op::Select { accept, reject, .. } => is_zero(accept) || is_zero(reject),
            Op::Call { function, ref args } => {
                for (param, &arg) in args.iter().enumerate() {
                    let is_reference = f.is_place(arg);
                    let flag = &mut self.params[function.index()][param];
                    match (is_zero(arg), is_reference) {
                        (true, true) => set_of_all(flag, &mut self.stale),
                        (zero, _) => set(flag, zero, &mut self.stale[function.index()]),
                    }
                    // What the callee may have put there.
                    if is_reference && self.params[function.index()][param] {
                        self.write(index, f, arg);
                    }
                }
                self.results[function.index()]
            }
            // Where it is read is not known.
            Op::Element { .. }
            | Op::Input(_)
            | Op::All(_)
            | Op::Any(_)
            | Op::Derivative { .. }
            | Op::Sample { .. }
            | Op::Fetch { .. }
            | Op::TextureSize { .. }
            | Op::TextureLevels { .. }
            | Op::OpaqueZero => false,
        }
    }

    /// A zero is written to the variable that a place is or lies in.
    fn write(&mut self, index: usize, f: &Function, place: Value) {
        match f[f.root(place)] {
            Op::Var(var) => set(&mut self.vars[index][var.index()], true, &mut self.stale[index]),
            Op::Param(param) => set_of_all(&mut self.params[index][param as usize], &mut self.stale),
            Op::Global(global) => set_of_all(&mut self.globals[global.index()], &mut self.stale),
            _ => {}
        }
    }
}

fn set(flag: &mut bool, zero: bool, stale: &mut bool) {
    *stale |= zero && !*flag;
    *flag |= zero;
}

/// Sets what values of other functions follow from as well.
fn set_of_all(flag: &mut bool, stale: &mut [bool]) {
    if !*flag {
        stale.fill(true);
    }
    *flag = true;
}

pub(super) fn is_of_floats(program: &Module, f: &Function, value: Value) -> bool {
    program.types.scalar(f.ty(value)) == Some(Scalar::Float)
}

/// Says whether two values are the same expression of the same variables, so that a driver may take their difference
/// for zero.
fn is_same(f: &Function, left: Value, right: Value, levels: u32) -> bool {
    if left == right {
        return true;
    }
    let (l, r) = (&f[left], &f[right]);
    if levels == 0 || std::mem::discriminant(l) != std::mem::discriminant(r) || matches!(l, Op::Call { .. }) {
        return false;
    }
    // The operations are compared with their operands taken out.
    let (mut of_left, mut of_right) = (Vec::new(), Vec::new());
    let (mut shape_left, mut shape_right) = (l.clone(), r.clone());
    shape_left.operands_mut(|value| of_left.push(std::mem::replace(value, left)));
    shape_right.operands_mut(|value| of_right.push(std::mem::replace(value, left)));
    shape_left == shape_right && of_left.iter().zip(&of_right).all(|(&l, &r)| is_same(f, l, r, levels - 1))
}

fn begins_with_zero(program: &Module, global: &Global) -> bool {
    let has_zero = |id: ConstId| program[id].words.iter().any(|word| word << 1 == 0);
    match global.kind {
        GlobalKind::Private(Some(init)) | GlobalKind::Table(init) => has_zero(init),
        GlobalKind::Private(None) => true,
        GlobalKind::Uniform(_) | GlobalKind::CustomUniform(_) | GlobalKind::CubeFace => false,
    }
}

/// Stores and returns.
fn collect<'a>(block: &'a Block, out: &mut Vec<&'a Stmt>) {
    for stmt in block {
        match stmt {
            Stmt::Store { .. } | Stmt::Return(Some(_)) => out.push(stmt),
            _ => stmt.blocks(|block| collect(block, out)),
        }
    }
}
