//! The entry point: its inputs and outputs, and the globals that are set before its body runs.

use naga::{
    BinaryOperator, Binding, BuiltIn, EntryPoint, Expression, FunctionArgument, FunctionResult, Handle, Interpolation,
    Sampling, ScalarKind, ShaderStage, Statement, StructMember, TypeInner,
};

use super::{context::Emitter, function::Builder};
use crate::{
    interface::ENTRY_POINT,
    ir::{self, Input, Output, Value},
    types::{Scalar, TypeId},
};

const POSITION: BuiltIn = BuiltIn::Position { invariant: false };

/// Adds the entry point; all functions have been emitted.
pub(super) fn emit(cx: &mut Emitter<'_>, function: &ir::Function) {
    let is_vertex = cx.source.kind.is_vertex();
    let mut b = Builder::new(cx, function);
    b.block(&function.body);
    b.emit();
    // All constants that functions use are known by now: they are set before the body runs.
    let body = std::mem::take(&mut b.block);
    for (variable, id) in std::mem::take(&mut b.cx.consts.set_at_start) {
        let value = b.composed(id);
        let pointer = b.variable(variable);
        b.push(Statement::Store { pointer, value });
    }
    b.set_opaque_zero(is_vertex);
    b.emit();
    let mut body = body;
    b.block.append(&mut body);
    let function = b.finish();
    cx.out.entry_points.push(EntryPoint {
        name: ENTRY_POINT.into(),
        stage: if is_vertex { ShaderStage::Vertex } else { ShaderStage::Fragment },
        early_depth_test: None,
        workgroup_size: [0; 3],
        workgroup_size_overrides: None,
        function,
        mesh_info: None,
        task_payload: None,
        incoming_ray_payload: None,
    });
}

/// Returns the binding of a location; `interpolation` is for values that pass between stages.
fn at(location: u32, interpolation: Option<Interpolation>) -> Binding {
    let sampling = match interpolation {
        Some(Interpolation::Flat) => Some(Sampling::First),
        Some(_) => Some(Sampling::Center),
        None => None,
    };
    Binding::Location { location, interpolation, sampling, blend_src: None, per_primitive: false }
}

fn interpolation(flat: bool) -> Option<Interpolation> {
    Some(if flat { Interpolation::Flat } else { Interpolation::Perspective })
}

impl Builder<'_, '_> {
    /// Returns the index of the argument for an input, adding it if necessary.
    pub(super) fn argument_of(&mut self, input: Input) -> u32 {
        let (ty, binding) = match input {
            Input::Position => (TypeId::VEC4, Binding::BuiltIn(POSITION)),
            Input::VertexIndex => (TypeId::UINT, Binding::BuiltIn(BuiltIn::VertexIndex)),
            Input::InstanceIndex => (TypeId::UINT, Binding::BuiltIn(BuiltIn::InstanceIndex)),
            Input::FrontFacing => (TypeId::BOOL, Binding::BuiltIn(BuiltIn::FrontFacing)),
            Input::Attribute { location, ty } => (ty, at(location, None)),
            Input::Varying { location, ty, flat } => (ty, at(location, interpolation(flat))),
        };
        if let Some(index) = self.f.arguments.iter().position(|a| a.binding == Some(binding.clone())) {
            return index as u32;
        }
        let ty = self.cx.ty(ty);
        self.f.arguments.push(FunctionArgument { name: None, ty, binding: Some(binding) });
        self.f.arguments.len() as u32 - 1
    }

    fn input(&mut self, input: Input) -> Handle<Expression> {
        let index = self.argument_of(input);
        self.add_preemitted(Expression::FunctionArgument(index))
    }

    /// Computes the zero that is unknown to the driver, if any code reads it, as the sign of a number whose bits, read
    /// as an `int`, are never negative: the pixel position, or the vertex index.
    fn set_opaque_zero(&mut self, is_vertex: bool) {
        let Some(variable) = self.cx.resources.opaque_zero else { return };
        let number = if is_vertex {
            self.input(Input::VertexIndex)
        } else {
            let position = self.input(Input::Position);
            self.add(Expression::AccessIndex { base: position, index: 0 })
        };
        let bits = self.add(Expression::As { expr: number, kind: ScalarKind::Sint, convert: None });
        let places = self.literal(Scalar::Uint, 31);
        let sign = Expression::Binary { op: BinaryOperator::ShiftRight, left: bits, right: places };
        let sign = self.add(sign);
        let pointer = self.variable(variable);
        self.push(Statement::Store { pointer, value: sign });
    }

    /// Returns all outputs at once.
    pub(super) fn output(&mut self, parts: &[(Output, Value)]) {
        if parts.is_empty() {
            self.push(Statement::Return { value: None });
            return;
        }
        let is_vertex = self.cx.source.kind.is_vertex();
        // Integers are not interpolated.
        let is_whole = |value: Value| self.cx.ir.scalar(self.ir.ty(value)) != Scalar::Float;
        let is_whole: Vec<bool> = parts.iter().map(|(_, value)| is_whole(*value)).collect();
        let mut bound = Vec::with_capacity(parts.len());
        for (&(output, value), is_whole) in parts.iter().zip(is_whole) {
            let binding = match output {
                Output::Target(location) if self.cx.source.kind.is_stage() || is_whole => at(location, None),
                // The binding that passes have always had.
                Output::Target(location) => at(location, interpolation(false)),
                Output::Varying { location, flat } => at(location, interpolation(flat)),
                Output::Position => Binding::BuiltIn(POSITION),
                Output::Depth => Binding::BuiltIn(BuiltIn::FragDepth),
            };
            let ty = self.cx.ty(self.ir.ty(value));
            bound.push((ty, binding, self.value(value)));
        }
        if let [(ty, binding, value)] = &bound[..]
            && !is_vertex
            && !self.cx.source.kind.is_stage()
        {
            self.f.result = Some(FunctionResult { ty: *ty, binding: Some(binding.clone()) });
            let value = *value;
            self.push(Statement::Return { value: Some(value) });
            return;
        }
        // This struct is never in memory, so any offsets that do not overlap will do.
        const PLACE: u32 = 16;
        let span = bound.len() as u32 * PLACE;
        let (mut members, mut components) = (Vec::new(), Vec::new());
        for (n, (ty, binding, value)) in bound.into_iter().enumerate() {
            members.push(StructMember { name: None, ty, binding: Some(binding), offset: n as u32 * PLACE });
            components.push(value);
        }
        let ty = self.cx.insert_type(TypeInner::Struct { members, span });
        let value = self.add(Expression::Compose { ty, components });
        self.f.result = Some(FunctionResult { ty, binding: None });
        self.push(Statement::Return { value: Some(value) });
    }
}
