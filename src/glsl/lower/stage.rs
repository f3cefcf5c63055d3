//! The entry points of stages: the code between the author's `main` and the pipeline. It copies inputs into the
//! variables that the author reads, and outputs from those that the author writes.

use super::{context::Lowering, function::Builder, reachable::Reachable};
use crate::{
    Attribute,
    hir::{BuiltinVar, GlobalId, Scalar, Swizzle, Type, TypeId},
    ir::{self, Binary, Input, Op, Output, Stmt, Value},
    plain::ClipSpace,
    stages::slots,
};

/// Lowers the entry point; all functions have been lowered.
pub(super) fn lower(cx: &mut Lowering<'_>, reachable: &Reachable) -> ir::Function {
    let entry = reachable.instances.last().expect("the entry point is reached").clone();
    let author = cx.functions[&entry];
    let is_vertex = cx.source.kind.is_vertex();
    let inputs: Vec<(GlobalId, u32)> =
        cx.interface.inputs.iter().copied().filter(|(id, _)| reachable.globals[id.index()]).collect();
    cx.reflection.varyings = cx.interface.varyings.clone();
    if cx.source.kind.is_plain() {
        let [mut read, mut written] = cx.interface.variables.clone();
        read.retain(|variable| inputs.iter().any(|(_, location)| *location == variable.location));
        read.sort_by_key(|variable| variable.location);
        written.sort_by_key(|variable| variable.location);
        (cx.reflection.shader.inputs, cx.reflection.shader.outputs) = (read, written);
    } else if is_vertex {
        let read = |a: &Attribute| inputs.iter().any(|(_, location)| *location == a.location());
        cx.reflection.attributes = Attribute::ALL.into_iter().filter(read).collect();
    }
    let mut b = Builder::new(cx, 0, 0);
    let (initialisers, _) = b.nested(|b| b.initialise_globals(reachable));
    b.splice(initialisers);
    for (id, location) in inputs {
        b.input(id, location, is_vertex);
    }
    if is_vertex {
        b.numbers();
    } else {
        b.fragment_inputs();
    }
    b.push_call(author, Vec::new());
    let parts = if is_vertex { b.vertex_outputs() } else { b.fragment_outputs() };
    b.push(Stmt::Output(parts));
    b.finish()
}

impl Builder<'_, '_> {
    /// Adds pointers to the slots of a variable, with their types, in the order of their locations.
    fn slot_pointers(&mut self, pointer: Value, ty: TypeId, out: &mut Vec<(Value, TypeId)>) {
        match self.cx.hir.types.get(ty) {
            Type::Matrix { columns, rows } => {
                for index in 0..u32::from(columns) {
                    let column = self.add(Op::Part { base: pointer, index });
                    out.push((column, TypeId::vector(Scalar::Float, rows)));
                }
            }
            Type::Array { element, len } => {
                for index in 0..len {
                    let part = self.add(Op::Part { base: pointer, index });
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

    /// Stores the values at `location` and the following ones in an input.
    fn input(&mut self, id: GlobalId, location: u32, is_vertex: bool) {
        let flat = self.cx.hir[id].flat;
        for (n, (pointer, ty)) in self.slots_of(id).into_iter().enumerate() {
            let location = location + n as u32;
            let value = self.add_before(Op::Input(match is_vertex {
                true => Input::Attribute { location, ty },
                false => Input::Varying { location, ty, flat },
            }));
            self.store(pointer, value);
        }
    }

    /// Sets `gl_VertexID` and `gl_InstanceID`, if they are read.
    fn numbers(&mut self) {
        for (variable, input) in
            [(BuiltinVar::VertexId, Input::VertexIndex), (BuiltinVar::InstanceId, Input::InstanceIndex)]
        {
            let Some(&memory) = self.cx.resources.stage.get(&variable) else { continue };
            let number = self.add_before(Op::Input(input));
            let number = self.add(Op::Convert { value: number, to: Scalar::Int });
            let pointer = self.global(memory);
            self.store(pointer, number);
        }
    }

    fn fragment_inputs(&mut self) {
        let (coord, depth) = (self.cx.resources.frag_coord, self.cx.resources.frag_depth);
        if coord.is_some() || depth.is_some() {
            let position = self.add_before(Op::Input(Input::Position));
            if let Some(coord) = coord {
                let pointer = self.global(coord);
                self.store(pointer, position);
            }
            if let Some(depth) = depth {
                // Its value if the author does not write it.
                let z = self.add(Op::Part { base: position, index: 2 });
                let pointer = self.global(depth);
                self.store(pointer, z);
            }
        }
        if let Some(&facing) = self.cx.resources.stage.get(&BuiltinVar::FrontFacing) {
            let is_front = self.add_before(Op::Input(Input::FrontFacing));
            let pointer = self.global(facing);
            self.store(pointer, is_front);
        }
    }

    /// Converts a position from OpenGL's clip space to WebGPU's.
    fn clip_space(&mut self, position: Value) -> Value {
        let source = self.cx.source;
        let clip_space = if source.kind.is_plain() { source.plain.clip_space } else { ClipSpace::GL_TEXTURE };
        if clip_space == ClipSpace::UNCHANGED {
            return position;
        }
        let [x, mut y, mut z, w] = [0, 1, 2, 3].map(|index| self.add(Op::Part { base: position, index }));
        let (minus, half) = (self.float(-1.0), self.float(0.5));
        if clip_space.flip_y {
            y = self.op(Binary::Multiply, y, minus);
        }
        if clip_space.map_depth {
            let sum = self.op(Binary::Add, z, w);
            z = self.op(Binary::Multiply, sum, half);
        }
        self.compose(TypeId::VEC4, vec![x, y, z, w])
    }

    fn vertex_outputs(&mut self) -> Vec<(Output, Value)> {
        let position = self.cx.stage_variable(BuiltinVar::Position);
        let pointer = self.global(position);
        let position = self.load(pointer);
        let value = self.clip_space(position);
        let mut parts = vec![(Output::Position, value)];
        for (id, location) in self.cx.interface.outputs.clone() {
            let flat = self.cx.hir[id].flat;
            for (n, (pointer, _)) in self.slots_of(id).into_iter().enumerate() {
                let value = self.load(pointer);
                parts.push((Output::Varying { location: location + n as u32, flat }, value));
            }
        }
        parts
    }

    fn fragment_outputs(&mut self) -> Vec<(Output, Value)> {
        let mut parts = Vec::new();
        for (id, location) in self.cx.interface.outputs.clone() {
            self.cx.reflection.outputs[location as usize] = true;
            let value = self.output_of(id);
            parts.push((Output::Target(location), value));
        }
        if let Some(depth) = self.cx.resources.frag_depth {
            let pointer = self.global(depth);
            let value = self.load(pointer);
            parts.push((Output::Depth, value));
        }
        parts
    }

    /// Returns the value of an output as a vector of four components.
    pub(super) fn output_of(&mut self, id: GlobalId) -> Value {
        let ty = self.cx.hir[id].ty;
        let scalar = self.cx.hir.types.scalar(ty).unwrap_or(Scalar::Float);
        let one = if scalar == Scalar::Float { 1.0f32.to_bits() } else { 1 };
        let memory = self.cx.global(id);
        let pointer = self.global(memory);
        let written = self.load(pointer);
        match self.cx.hir.types.components(ty).unwrap_or(1) as usize {
            4 => written,
            size => {
                // Missing components are those that a texture format returns.
                let mut components = vec![match size {
                    1 => written,
                    _ => self.swizzle(written, ty, Swizzle::new(&[0, 1, 2][..size])),
                }];
                components.extend((size..3).map(|_| self.literal(scalar, 0)));
                components.push(self.literal(scalar, one));
                self.compose(TypeId::vector(scalar, 4), components)
            }
        }
    }
}
