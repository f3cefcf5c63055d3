//! The entry points of stages: what lies between the author's `main` and the pipeline. Inputs are put into the variables the
//! author reads, and what the author left in others is handed on.

use naga::{
    BinaryOperator as Op, Binding, BuiltIn, EntryPoint, Expression, FunctionArgument, FunctionResult, Interpolation,
    Sampling, ScalarKind, ShaderStage, Statement, StructMember, TypeInner,
};

use super::{
    Lowering,
    function::{Builder, Value},
    reach::Reach,
};
use crate::glsl::{
    Attribute, PassKind,
    hir::{BuiltinVar, GlobalId, Scalar, Swizzle, Type, TypeId},
    interface::ENTRY_POINT,
    stages::slots,
};

const POSITION: BuiltIn = BuiltIn::Position { invariant: false };

/// Adds the entry point; every function is there already.
pub(super) fn lower(cx: &mut Lowering<'_>, reach: &Reach) {
    let entry = reach.instances.last().expect("the entry point is reached").clone();
    let author = cx.functions[&entry];
    let is_vertex = cx.source.kind == PassKind::Vertex;
    let inputs: Vec<(GlobalId, u32)> =
        cx.interface.inputs.iter().copied().filter(|(id, _)| reach.globals[id.index()]).collect();
    cx.reflection.varyings = cx.interface.varyings.clone();
    if is_vertex {
        let read = |a: &Attribute| inputs.iter().any(|(_, location)| *location == a.location());
        cx.reflection.attributes = Attribute::ALL.into_iter().filter(read).collect();
    }
    let mut b = Builder::new(cx, 0, 0);
    let (initialisers, _) = b.nested(|b| b.initialise_globals(reach));
    b.set_tables();
    let seems_to_discard = !is_vertex && b.cx.source.driver.may_discard;
    // Also lowered before what it reads is set.
    let (discard, _) = b.nested(|b| {
        if seems_to_discard {
            b.seem_to_discard();
        }
    });
    b.set_unknown_zero(|b| match is_vertex {
        true => b.given_builtin(TypeId::UINT, BuiltIn::VertexIndex),
        false => {
            let position = b.given_builtin(TypeId::VEC4, POSITION);
            b.add(Expression::AccessIndex { base: position, index: 0 })
        }
    });
    b.push(Statement::Block(initialisers));
    for (id, location) in inputs {
        b.input(id, location, is_vertex);
    }
    if is_vertex {
        b.numbers();
    } else {
        b.fragment_inputs();
    }
    b.push(Statement::Block(discard));
    b.push(Statement::Call { function: author, arguments: Vec::new(), result: None });
    let parts = if is_vertex { b.vertex_outputs() } else { b.fragment_outputs() };
    b.hand_on(parts);
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

/// A part of what an entry point returns.
struct Part {
    ty: TypeId,
    binding: Binding,
    value: Value,
}

/// What lies at a location; `interpolation` for what passes between stages.
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
    fn argument(&mut self, ty: TypeId, binding: Binding) -> Value {
        let ty = self.cx.ty(ty);
        let index = self.f.arguments.len() as u32;
        self.f.arguments.push(FunctionArgument { name: None, ty, binding: Some(binding) });
        self.given(Expression::FunctionArgument(index))
    }

    /// The argument that brings a built-in, which may be there already.
    fn given_builtin(&mut self, ty: TypeId, builtin: BuiltIn) -> Value {
        let binding = Binding::BuiltIn(builtin);
        match self.f.arguments.iter().position(|a| a.binding == Some(binding.clone())) {
            Some(index) => self.given(Expression::FunctionArgument(index as u32)),
            None => self.argument(ty, binding),
        }
    }

    /// Pointers to the slots of a variable, with their types, in the order of their locations.
    fn slot_pointers(&mut self, pointer: Value, ty: TypeId, out: &mut Vec<(Value, TypeId)>) {
        match self.cx.hir.types.get(ty) {
            Type::Matrix { columns, rows } => {
                for index in 0..u32::from(columns) {
                    let column = self.add(Expression::AccessIndex { base: pointer, index });
                    out.push((column, TypeId::vector(Scalar::Float, rows)));
                }
            }
            Type::Array { element, len } => {
                for index in 0..len {
                    let part = self.add(Expression::AccessIndex { base: pointer, index });
                    self.slot_pointers(part, element, out);
                }
            }
            _ => out.push((pointer, ty)),
        }
    }

    fn slots_of(&mut self, id: GlobalId) -> Vec<(Value, TypeId)> {
        let variable = self.cx.global(id);
        let pointer = self.global(variable);
        let ty = self.cx.hir[id].ty;
        let mut all = Vec::new();
        self.slot_pointers(pointer, ty, &mut all);
        debug_assert_eq!(slots(self.cx.hir, ty).map(|s| s.len()), Some(all.len()));
        all
    }

    /// Puts what lies at `location` and behind it into an input.
    fn input(&mut self, id: GlobalId, location: u32, is_vertex: bool) {
        let between = if is_vertex { None } else { interpolation(self.cx.hir[id].flat) };
        for (n, (pointer, ty)) in self.slots_of(id).into_iter().enumerate() {
            let value = self.argument(ty, at(location + n as u32, between));
            self.store(pointer, value);
        }
    }

    /// `gl_VertexID` and `gl_InstanceID`, where they are read.
    fn numbers(&mut self) {
        for (variable, builtin) in
            [(BuiltinVar::VertexId, BuiltIn::VertexIndex), (BuiltinVar::InstanceId, BuiltIn::InstanceIndex)]
        {
            let Some(&memory) = self.cx.resources.stage.get(&variable) else { continue };
            let number = self.given_builtin(TypeId::UINT, builtin);
            let number = self.add(Expression::As { expr: number, kind: ScalarKind::Sint, convert: Some(4) });
            let pointer = self.global(memory);
            self.store(pointer, number);
        }
    }

    fn fragment_inputs(&mut self) {
        let (coord, depth) = (self.cx.resources.frag_coord, self.cx.resources.frag_depth);
        if coord.is_some() || depth.is_some() {
            let position = self.given_builtin(TypeId::VEC4, POSITION);
            if let Some(coord) = coord {
                let pointer = self.global(coord);
                self.store(pointer, position);
            }
            if let Some(depth) = depth {
                // What it is where the author leaves it alone.
                let z = self.add(Expression::AccessIndex { base: position, index: 2 });
                let pointer = self.global(depth);
                self.store(pointer, z);
            }
        }
        if let Some(&facing) = self.cx.resources.stage.get(&BuiltinVar::FrontFacing) {
            let is_front = self.given_builtin(TypeId::BOOL, BuiltIn::FrontFacing);
            let pointer = self.global(facing);
            self.store(pointer, is_front);
        }
    }

    fn vertex_outputs(&mut self) -> Vec<Part> {
        let position = self.cx.stage_variable(BuiltinVar::Position);
        let pointer = self.global(position);
        let position = self.load(pointer);
        let [x, y, z, w] = [0, 1, 2, 3].map(|index| self.add(Expression::AccessIndex { base: position, index }));
        let (minus, half) = (self.float(-1.0), self.float(0.5));
        let y = self.op(Op::Multiply, y, minus);
        let sum = self.op(Op::Add, z, w);
        let z = self.op(Op::Multiply, sum, half);
        let value = self.compose(TypeId::VEC4, vec![x, y, z, w]);
        let binding = Binding::BuiltIn(POSITION);
        let mut parts = vec![Part { ty: TypeId::VEC4, binding, value }];
        for (id, location) in self.cx.interface.outputs.clone() {
            let between = interpolation(self.cx.hir[id].flat);
            for (n, (pointer, ty)) in self.slots_of(id).into_iter().enumerate() {
                let value = self.load(pointer);
                parts.push(Part { ty, binding: at(location + n as u32, between), value });
            }
        }
        parts
    }

    fn fragment_outputs(&mut self) -> Vec<Part> {
        let mut parts = Vec::new();
        for (id, location) in self.cx.interface.outputs.clone() {
            self.cx.reflection.outputs[location as usize] = true;
            let ty = self.cx.hir[id].ty;
            let memory = self.cx.global(id);
            let pointer = self.global(memory);
            let written = self.load(pointer);
            let value = match self.cx.hir.types.components(ty).unwrap_or(1) as usize {
                4 => written,
                size => {
                    // As a format reads what it lacks.
                    let mut components = vec![match size {
                        1 => written,
                        _ => self.swizzle(written, ty, Swizzle::new(&[0, 1, 2][..size])),
                    }];
                    components.extend((size..3).map(|_| self.float(0.0)));
                    components.push(self.float(1.0));
                    self.compose(TypeId::VEC4, components)
                }
            };
            parts.push(Part { ty: TypeId::VEC4, binding: at(location, None), value });
        }
        if let Some(depth) = self.cx.resources.frag_depth {
            let pointer = self.global(depth);
            let value = self.load(pointer);
            parts.push(Part { ty: TypeId::FLOAT, binding: Binding::BuiltIn(BuiltIn::FragDepth), value });
        }
        parts
    }

    /// Returns all parts at once.
    fn hand_on(&mut self, parts: Vec<Part>) {
        if parts.is_empty() {
            self.push(Statement::Return { value: None });
            return;
        }
        // No memory has this struct: any places that do not overlap will do.
        const PLACE: u32 = 16;
        let span = parts.len() as u32 * PLACE;
        let (mut members, mut components) = (Vec::new(), Vec::new());
        for (n, Part { ty, binding, value }) in parts.into_iter().enumerate() {
            let ty = self.cx.ty(ty);
            members.push(StructMember { name: None, ty, binding: Some(binding), offset: n as u32 * PLACE });
            components.push(value);
        }
        let ty = self.cx.insert_type(TypeInner::Struct { members, span });
        let value = self.add(Expression::Compose { ty, components });
        self.f.result = Some(FunctionResult { ty, binding: None });
        self.push(Statement::Return { value: Some(value) });
    }
}
