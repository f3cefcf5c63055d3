//! The body of one function under construction, from its parameters to its last expression; statements, constants and
//! locals are in their own files.

mod constants;
mod variables;

pub(super) use constants::Part as PartOf;

use super::{
    arguments::{Instance, Specialization},
    context::{Lowering, const_id},
    names::{FunctionNames, Precondition, StatementEvent, Unset, UnsetKind},
};
use crate::{
    ast::{List, Loc},
    builtins::Builtin,
    hir::{FuncId, LocalId, LocalKind, StmtId, TypeId},
    ir::{self, Block, Op, Param, Stmt, Value},
};
use rustc_hash::FxHashMap;

/// The form of a parameter or local variable in the generated code.
#[derive(Clone, Copy, Debug)]
pub(super) enum Slot {
    /// Its declaration has not been reached yet.
    Unset,
    /// Never written, so it is a value.
    Value(Value),
    /// A place.
    Memory(Value),
    /// Never written; its value is a constant that is indexed.
    Table(ir::ConstId),
    /// A sampler parameter.
    Channel(u8),
}

pub(super) struct Builder<'m, 'a> {
    pub cx: &'m mut Lowering<'a>,
    pub f: ir::Function,
    block: Block,
    /// The location in the text that the current code is lowered from.
    pub loc: Loc,
    /// The built-in function that the current code is an expansion of.
    pub builtin: Option<Builtin>,
    /// Control cannot reach the end of the block, so no more code is added to it.
    pub ended: bool,
    first_local: usize,
    slots: Vec<Slot>,
    /// Locals that are memory although nothing writes them: their uses are not dominated by their declaration.
    forced: Vec<bool>,
    literals: FxHashMap<(u8, u32), Value>,
    zeros: FxHashMap<TypeId, Value>,
    constants: FxHashMap<u32, Value>,
    globals: FxHashMap<ir::GlobalId, Value>,
    /// The number of loops around the current code.
    pub loops: usize,
    pub result: TypeId,
    /// The author's function; `None` for the code around the entry point.
    pub func: Option<FuncId>,
    /// The specializations of this copy, one per specializable parameter.
    pub specializations: Box<[Specialization]>,
    /// See [`FunctionNames::undefined`].
    pub undefined: Vec<Unset>,
    pub(super) marks: Vec<(Value, StatementEvent)>,
}

/// Lowers one copy of a user function.
pub(super) fn lower(cx: &mut Lowering<'_>, instance: &Instance) -> (ir::Function, FunctionNames) {
    let hir = cx.hir;
    let function = &hir[instance.func];
    let mut builder = Builder::new(cx, function.locals.start as usize, function.locals.len());
    // About as many values as the function has expressions.
    builder.f.reserve(function.exprs.len());
    builder.result = function.result;
    builder.f.result = function.result;
    builder.func = Some(instance.func);
    builder.specializations = instance.specializations.clone();
    builder.loc = function.header;
    builder.parameters(instance.func, |b, param| {
        let index = b.f.params.len() as u32;
        b.f.params.push(param);
        b.add_before(Op::Param(index))
    });
    builder.statements(function.body.unwrap_or(List::EMPTY));
    if !builder.ended && function.result != TypeId::VOID {
        // Reaching the end returns zero.
        let value = builder.undefined(function.result, UnsetKind::Result, function.name);
        builder.push(Stmt::Return(Some(value)));
    }
    let names = builder.names(instance.func);
    (builder.finish(), names)
}

impl<'m, 'a> Builder<'m, 'a> {
    /// Creates a builder for a function whose locals are `count` from `first_local`.
    pub(super) fn new(cx: &'m mut Lowering<'a>, first_local: usize, count: usize) -> Self {
        Self {
            cx,
            f: ir::Function::new(TypeId::VOID),
            block: Block::new(),
            loc: Loc::default(),
            builtin: None,
            ended: false,
            first_local,
            slots: vec![Slot::Unset; count],
            forced: vec![false; count],
            literals: FxHashMap::default(),
            zeros: FxHashMap::default(),
            constants: FxHashMap::default(),
            globals: FxHashMap::default(),
            loops: 0,
            result: TypeId::VOID,
            func: None,
            specializations: Box::default(),
            undefined: Vec::new(),
            marks: Vec::new(),
        }
    }

    pub(super) fn finish(mut self) -> ir::Function {
        self.f.body = self.block;
        self.f
    }

    /// Declares the parameters of a function; `argument` returns the next one, of this type.
    pub(super) fn parameters(&mut self, func: FuncId, mut argument: impl FnMut(&mut Self, Param) -> Value) {
        let hir = self.cx.hir;
        let specializable = self.cx.arguments.specializable(func).to_vec();
        for (local, specialization) in specializable.into_iter().zip(self.specializations.clone()) {
            let slot = match specialization {
                Specialization::None => continue,
                Specialization::Channel(channel) => Slot::Channel(channel),
                Specialization::Table(table) => Slot::Table(const_id(table)),
                Specialization::Global(global) => {
                    let variable = self.cx.global(global);
                    Slot::Memory(self.global(variable))
                }
            };
            self.set_slot(local, slot);
        }
        for (i, param) in hir.params(func).iter().enumerate() {
            let local = LocalId::new(hir[func].locals.start as usize + i);
            if !matches!(self.slot(local), Slot::Unset) {
                continue;
            }
            let in_place = self.cx.arguments.reads_in_place(hir, local);
            let by_pointer = param.kind.copies_out() || in_place || self.cx.is_long(param.ty);
            let argument = argument(self, Param { ty: param.ty, by_reference: by_pointer });
            if by_pointer {
                if param.kind == LocalKind::Out {
                    let zero = self.undefined_local(UnsetKind::Parameter, local);
                    self.store(argument, zero);
                }
                self.set_slot(local, Slot::Memory(argument));
            } else {
                self.declare(local, argument);
            }
        }
    }

    /// Adds an operation that is computed here.
    pub(super) fn add(&mut self, op: Op) -> Value {
        let ty = ir::infer::ty(&self.cx.out, &self.f, &op);
        self.add_typed(op, ty)
    }

    /// Adds an operation of this type that is computed here.
    pub(super) fn add_typed(&mut self, op: Op, ty: TypeId) -> Value {
        let value = self.f.append(op, ty, ir::Origin { loc: self.loc, builtin: self.builtin });
        self.block.push(Stmt::Let(value));
        value
    }

    /// Records a precondition of an operation, if preconditions are requested.
    pub(super) fn record_precondition(&mut self, value: Value, precondition: impl FnOnce() -> Precondition) {
        if self.cx.marks.undefined {
            let function = ir::FuncId::new(self.cx.out.functions.len());
            self.cx.names.preconditions.insert((function, value), precondition());
        }
    }

    /// Marks that control reaches a part of the text, if statements are marked.
    pub(super) fn mark_statement(&mut self, event: fn(u32) -> StatementEvent, stmt: StmtId) {
        if self.cx.marks.statements {
            let value = self.add(Op::OpaqueZero);
            self.marks.push((value, event(stmt.index() as u32)));
        }
    }

    /// Adds a free operation, which no statement computes.
    pub(super) fn add_before(&mut self, op: Op) -> Value {
        debug_assert!(op.is_free());
        let ty = ir::infer::ty(&self.cx.out, &self.f, &op);
        self.f.append(op, ty, self.loc)
    }
}

impl Builder<'_, '_> {
    pub(super) fn push(&mut self, statement: Stmt) {
        self.ended = matches!(statement, Stmt::Break | Stmt::Continue | Stmt::Return(_) | Stmt::Discard);
        self.block.push(statement);
    }

    /// Reads a place.
    pub(super) fn load(&mut self, place: Value) -> Value {
        self.add(Op::Load { place })
    }

    /// Writes to a place.
    pub(super) fn store(&mut self, place: Value, value: Value) {
        self.push(Stmt::Store { place, value });
    }

    /// Appends statements that were lowered before.
    pub(super) fn splice(&mut self, mut block: Block) {
        self.block.append(&mut block);
    }

    /// Calls a function; the result of a void one is not a value.
    pub(super) fn push_call(&mut self, function: ir::FuncId, args: Vec<Value>) -> Value {
        let ty = self.cx.out[function].result;
        self.add_typed(Op::Call { function, args: args.into() }, ty)
    }

    /// Returns a nested block, filled by `fill`, and whether its end is unreachable.
    pub(super) fn nested(&mut self, fill: impl FnOnce(&mut Self)) -> (Block, bool) {
        let outer = std::mem::take(&mut self.block);
        let outer_ended = std::mem::take(&mut self.ended);
        fill(self);
        let ended = std::mem::replace(&mut self.ended, outer_ended);
        (std::mem::replace(&mut self.block, outer), ended)
    }
}
