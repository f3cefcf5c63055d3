//! The text form of a program, for debugging and for snapshots.
//!
//! A value is `%n`, numbered in the order of its statement, a variable of the function `$n`, one of the module `@n`, a
//! function `fn n`. Places are printed as paths: `$1.2`, `@0[%4]`. Literals are printed where they are used.

use std::fmt::Write;

use super::{Block, Detail, Function, GlobalKind, Level, Module, Op, Output, Stmt, Value};
use crate::types::{Scalar, Type, TypeId};

/// Returns the text of a program.
pub fn print(module: &Module) -> String {
    let mut out = String::new();
    for (index, global) in module.globals.iter().enumerate() {
        let ty = type_text(module, global.ty);
        let kind = match global.kind {
            GlobalKind::Private(None) => "private".into(),
            GlobalKind::Private(Some(init)) => format!("private = {}", constant(module, init.index())),
            GlobalKind::Uniform(uniform) => format!("uniform {}", uniform.name()),
            GlobalKind::CustomUniform(slot) => format!("uniform slot {slot}"),
            GlobalKind::CubeFace => "uniform cube face".into(),
            GlobalKind::TileOrigin => "uniform tile origin".into(),
            GlobalKind::Table(table) => format!("table {}", constant(module, table.index())),
            GlobalKind::Member { block, index } => {
                format!("uniform {}", module.blocks[usize::from(block)].members[usize::from(index)].name)
            }
        };
        let _ = writeln!(out, "@{index}: {ty} {kind}");
    }
    for (index, function) in module.functions.iter().enumerate() {
        if !out.is_empty() {
            out.push('\n');
        }
        let params = function.params.iter().enumerate().map(|(i, param)| {
            let reference = if param.by_reference { "&" } else { "" };
            format!("#{i}: {reference}{}", type_text(module, param.ty))
        });
        let params = params.collect::<Vec<_>>().join(", ");
        let entry = if index + 1 == module.functions.len() { "entry" } else { "fn" };
        let _ = writeln!(out, "{entry} {index}({params}) -> {} {{", type_text(module, function.result));
        let mut printer = Printer { module, function, out, numbers: vec![None; function.len()], next: 0 };
        for (i, var) in function.vars.iter().enumerate() {
            let init = var.init.map(|init| format!(" = {}", printer.value(init))).unwrap_or_default();
            let _ = writeln!(printer.out, "  ${i}: {}{init}", type_text(module, var.ty));
        }
        printer.block(&function.body, 1);
        out = printer.out;
        out.push_str("}\n");
    }
    out
}

struct Printer<'a> {
    module: &'a Module,
    function: &'a Function,
    out: String,
    /// By [`Value::index`].
    numbers: Vec<Option<u32>>,
    next: u32,
}

impl Printer<'_> {
    fn line(&mut self, depth: usize, text: &str) {
        let _ = writeln!(self.out, "{:width$}{text}", "", width = 2 * depth);
    }

    fn block(&mut self, block: &Block, depth: usize) {
        for stmt in block {
            self.statement(stmt, depth);
        }
    }

    fn statement(&mut self, stmt: &Stmt, depth: usize) {
        match stmt {
            Stmt::Let(value) => {
                // Places are printed where they are used.
                if self.function.is_place(*value) {
                    return;
                }
                let text = self.op(*value);
                let ty = self.function.ty(*value);
                if ty == TypeId::VOID {
                    return self.line(depth, &text);
                }
                let number = self.next;
                self.next += 1;
                self.numbers[value.index()] = Some(number);
                let ty = type_text(self.module, ty);
                self.line(depth, &format!("%{number}: {ty} = {text}"));
            }
            Stmt::Store { place, value } => {
                let text = format!("{} <- {}", self.value(*place), self.value(*value));
                self.line(depth, &text);
            }
            Stmt::If { condition, accept, reject } => {
                let text = format!("if {} {{", self.value(*condition));
                self.line(depth, &text);
                self.block(accept, depth + 1);
                if !reject.is_empty() {
                    self.line(depth, "} else {");
                    self.block(reject, depth + 1);
                }
                self.line(depth, "}");
            }
            Stmt::Loop { body, continuing, break_if } => {
                self.line(depth, "loop {");
                self.block(body, depth + 1);
                if !continuing.is_empty() || break_if.is_some() {
                    self.line(depth, "} continuing {");
                    self.block(continuing, depth + 1);
                    if let Some(value) = break_if {
                        let text = format!("break if {}", self.value(*value));
                        self.line(depth + 1, &text);
                    }
                }
                self.line(depth, "}");
            }
            Stmt::Switch { selector, cases } => {
                let text = format!("switch {} {{", self.value(*selector));
                self.line(depth, &text);
                let unsigned = self.function.ty(*selector) == TypeId::UINT;
                for case in cases {
                    let label = match case.label {
                        None => "default".into(),
                        Some(bits) if unsigned => format!("case {bits}"),
                        Some(bits) => format!("case {}", bits as i32),
                    };
                    let falls = if case.falls_through { " falls through" } else { "" };
                    self.line(depth, &format!("{label}:{falls}"));
                    self.block(&case.body, depth + 1);
                }
                self.line(depth, "}");
            }
            Stmt::Break => self.line(depth, "break"),
            Stmt::Continue => self.line(depth, "continue"),
            Stmt::Return(None) => self.line(depth, "return"),
            Stmt::Return(Some(value)) => {
                let text = format!("return {}", self.value(*value));
                self.line(depth, &text);
            }
            Stmt::Discard => self.line(depth, "discard"),
            Stmt::Output(parts) => {
                for (output, value) in parts {
                    let name = match output {
                        Output::Target(location) => format!("target {location}"),
                        Output::Varying { location, flat } => {
                            format!("{}varying {location}", if *flat { "flat " } else { "" })
                        }
                        Output::Position => "position".into(),
                        Output::Depth => "depth".into(),
                    };
                    let text = format!("output {name} = {}", self.value(*value));
                    self.line(depth, &text);
                }
            }
        }
    }

    /// Returns the text of an operand.
    fn value(&self, value: Value) -> String {
        if let Some(number) = self.numbers[value.index()] {
            return format!("%{number}");
        }
        match self.function[value] {
            Op::Literal(scalar, bits) => literal(scalar, bits),
            Op::Zero(ty) => format!("{}(0)", type_text(self.module, ty)),
            Op::Const(id) => constant(self.module, id.index()),
            Op::Param(index) => format!("#{index}"),
            Op::Var(id) => format!("${}", id.index()),
            Op::Global(id) => format!("@{}", id.index()),
            Op::Input(input) => format!("{input:?}"),
            Op::Part { base, index } => format!("{}.{index}", self.value(base)),
            Op::Element { base, index } => format!("{}[{}]", self.value(base), self.value(index)),
            ref op => format!("<{op:?}>"),
        }
    }

    fn list(&self, values: &[Value]) -> String {
        values.iter().map(|&value| self.value(value)).collect::<Vec<_>>().join(", ")
    }

    fn op(&self, value: Value) -> String {
        let of = |value: Value| self.value(value);
        let some = |value: Option<Value>| value.map(|value| format!(", {}", self.value(value))).unwrap_or_default();
        match &self.function[value] {
            Op::Part { base, index } => format!("{}.{index}", of(*base)),
            Op::Element { base, index } => format!("{}[{}]", of(*base), of(*index)),
            Op::Swizzle { vector, swizzle } => format!("{}{swizzle:?}", of(*vector)),
            Op::Splat { value, .. } => format!("splat {}", of(*value)),
            Op::Compose { parts, .. } => format!("compose {}", self.list(parts)),
            Op::Unary { op, operand } => format!("{} {}", name(op), of(*operand)),
            Op::Binary { op, left, right } => format!("{} {}, {}", name(op), of(*left), of(*right)),
            Op::Math { fun, arg, arg1, arg2, arg3 } => {
                format!("{} {}{}{}{}", name(fun), of(*arg), some(*arg1), some(*arg2), some(*arg3))
            }
            Op::Select { condition, accept, reject } => {
                format!("select {}, {}, {}", of(*condition), of(*accept), of(*reject))
            }
            Op::Convert { value, .. } => format!("convert {}", of(*value)),
            Op::Bitcast { value, .. } => format!("bitcast {}", of(*value)),
            Op::All(value) => format!("all {}", of(*value)),
            Op::Any(value) => format!("any {}", of(*value)),
            Op::Derivative { axis, detail: Detail::Any, value } => format!("derivative {axis:?}, {}", of(*value)),
            Op::Derivative { axis, detail, value } => format!("derivative {detail:?} {axis:?}, {}", of(*value)),
            Op::Sample { channel, coordinate, level, offset } => {
                let level = match level {
                    Level::Auto => String::new(),
                    Level::Exact(level) => format!(", level {}", of(*level)),
                    Level::Bias(bias) => format!(", bias {}", of(*bias)),
                    Level::Gradient { x, y } => format!(", gradient {}, {}", of(*x), of(*y)),
                };
                let offset = offset.map(|offset| format!(", offset {}", self.value(offset))).unwrap_or_default();
                format!("sample channel {channel}, {}{level}{offset}", of(*coordinate))
            }
            Op::Gather { channel, component, coordinate, offset } => {
                let offset = offset.map(|offset| format!(", offset {}", self.value(offset))).unwrap_or_default();
                format!("gather channel {channel}, component {component}, {}{offset}", of(*coordinate))
            }
            Op::Fetch { channel, coordinate, level } => {
                format!("fetch channel {channel}, {}, level {}", of(*coordinate), of(*level))
            }
            Op::TextureSize { channel, level } => format!("texture_size channel {channel}{}", some(*level)),
            Op::TextureLevels { channel } => format!("texture_levels channel {channel}"),
            Op::Load { place } => format!("load {}", of(*place)),
            Op::Call { function, args } => format!("call fn {}({})", function.index(), self.list(args)),
            Op::OpaqueZero => "opaque_zero".into(),
            Op::Literal(..) | Op::Zero(_) | Op::Const(_) | Op::Param(_) | Op::Var(_) | Op::Global(_) | Op::Input(_) => {
                of(value)
            }
        }
    }
}

/// Returns the snake-case name: `InverseSqrt` as `inverse_sqrt`.
fn name(op: &impl std::fmt::Debug) -> String {
    let mut out = String::new();
    for c in format!("{op:?}").chars() {
        if c.is_ascii_uppercase() && !out.is_empty() {
            out.push('_');
        }
        out.push(c.to_ascii_lowercase());
    }
    out
}

fn literal(scalar: Scalar, bits: u32) -> String {
    match scalar {
        Scalar::Bool => (bits != 0).to_string(),
        Scalar::Int => (bits as i32).to_string(),
        Scalar::Uint => format!("{bits}u"),
        Scalar::Float => format!("{:?}", f32::from_bits(bits)),
    }
}

fn constant(module: &Module, index: usize) -> String {
    /// The number of a constant's scalars that are printed.
    const SHOWN: usize = 16;
    let constant = &module.consts[index];
    let scalar = module.types.scalar(constant.ty);
    let words = constant.words.iter().take(SHOWN).map(|&bits| match scalar {
        Some(scalar) => literal(scalar, bits),
        None => format!("{bits:#x}"),
    });
    let more = if constant.words.len() > SHOWN { ", .." } else { "" };
    format!("{}({}{more})", type_text(module, constant.ty), words.collect::<Vec<_>>().join(", "))
}

fn type_text(module: &Module, ty: TypeId) -> String {
    match module.types.get(ty) {
        Type::Array { element, len } => format!("{}[{len}]", type_text(module, element)),
        Type::Struct(id) => format!("struct {}", id.index()),
        _ => ty.as_basic().map_or("?", crate::ast::BasicType::name).to_owned(),
    }
}
