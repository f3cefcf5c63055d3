//! The fragment entry point: what the site's `main` does around the author's function, for each kind of pass.

use naga::{
    BinaryOperator as Op, Binding, Block, BuiltIn, EntryPoint, Expression, Function, FunctionArgument, FunctionResult,
    MathFunction as Math, ScalarKind, ShaderStage, Statement, SwitchCase, SwitchValue,
};

use super::{
    Lowering,
    function::{Builder, Value},
    reach::Reach,
    resources::{self, CUBE_FACE},
};
use crate::glsl::{
    PassKind,
    hir::{GlobalId, GlobalStorage, Scalar, Swizzle, TypeId, Uniform},
    interface::ENTRY_POINT,
};

/// Adds the entry point; every function is there already.
pub(super) fn lower(cx: &mut Lowering<'_>, reach: &Reach) {
    let entry = reach.instances.last().expect("the entry point is reached").clone();
    let author = cx.functions[&entry];
    let kind = cx.source.kind;
    let vec4 = cx.ty(TypeId::VEC4);
    let mut b = Builder::new(cx, 0, 0);
    b.f.arguments.push(FunctionArgument {
        name: None,
        ty: vec4,
        binding: Some(Binding::BuiltIn(BuiltIn::Position { invariant: false })),
    });
    b.f.result = Some(FunctionResult {
        ty: vec4,
        binding: Some(Binding::Location {
            location: 0,
            interpolation: Some(naga::Interpolation::Perspective),
            sampling: Some(naga::Sampling::Center),
            blend_src: None,
            per_primitive: false,
        }),
    });
    // Lowered before what precedes them: they may reach globals and tables that no function does.
    let (initialisers, _) = b.nested(|b| b.initialise_globals(reach));
    b.set_tables();
    let position = b.given(Expression::FunctionArgument(0));
    b.set_frag_coord(position);
    b.set_unknown_zero(|b| b.add(Expression::AccessIndex { base: position, index: 0 }));
    b.push(Statement::Block(initialisers));
    let result = match kind {
        PassKind::Image | PassKind::Buffer => {
            let at = b.swizzle(position, TypeId::VEC4, Swizzle::new(&[0, 1]));
            let colour = b.call_with_colour(author, vec![at]);
            if kind == PassKind::Image { b.finish_image(colour) } else { colour }
        }
        PassKind::Cubemap => {
            let at = b.swizzle(position, TypeId::VEC4, Swizzle::new(&[0, 1]));
            let origin = b.zero(TypeId::VEC3);
            let direction = b.cube_direction(at);
            b.call_with_colour(author, vec![at, origin, direction])
        }
        PassKind::Sound => b.sound(author, position),
        PassKind::Vertex | PassKind::Fragment => unreachable!("stages have an entry point of their own"),
    };
    b.push(Statement::Return { value: Some(result) });
    let function = b.finish();
    cx.out.entry_points.push(EntryPoint {
        name: ENTRY_POINT.into(),
        stage: ShaderStage::Fragment,
        early_depth_test: None,
        workgroup_size: [0; 3],
        workgroup_size_overrides: None,
        function,
        mesh_info: None,
        task_payload: None,
        incoming_ray_payload: None,
    });
}

impl Builder<'_, '_> {
    /// Values of globals that are no constants, in text order.
    pub(super) fn initialise_globals(&mut self, reach: &Reach) {
        let hir = self.cx.hir;
        for (i, global) in hir.globals.iter().enumerate() {
            let (Some(init), None, true) = (global.init, global.value, reach.globals[i]) else { continue };
            if matches!(global.storage, GlobalStorage::Private | GlobalStorage::Out) {
                let value = self.value(init);
                let variable = self.cx.global(GlobalId::new(i));
                let pointer = self.global(variable);
                self.store(pointer, value);
            }
        }
    }

    /// Tables and globals whose value naga has no constant for.
    pub(super) fn set_tables(&mut self) {
        for (variable, id) in std::mem::take(&mut self.cx.consts.set_at_start) {
            let value = self.constant(id);
            let pointer = self.global(variable);
            self.store(pointer, value);
        }
    }

    /// As WebGL has it for a triangle at depth 0: z is one half, w is one.
    fn set_frag_coord(&mut self, position: Value) {
        let Some(variable) = self.cx.resources.frag_coord else { return };
        let at = self.swizzle(position, TypeId::VEC4, Swizzle::new(&[0, 1]));
        let (half, one) = (self.float(0.5), self.float(1.0));
        let coordinate = self.compose(TypeId::VEC4, vec![at, half, one]);
        let pointer = self.global(variable);
        self.store(pointer, coordinate);
    }

    /// Calls a function whose first parameter is `out vec4`; gives what it left there.
    fn call_with_colour(&mut self, function: naga::Handle<Function>, rest: Vec<Value>) -> Value {
        let colour = self.temporary(TypeId::VEC4);
        let mut arguments = vec![colour];
        arguments.extend(rest);
        self.push(Statement::Call { function, arguments, result: None });
        self.load(colour)
    }

    /// Alpha is one; a failed assertion paints red, green, blue or yellow, the last of these that failed.
    fn finish_image(&mut self, colour: Value) -> Value {
        let mut rgb = self.swizzle(colour, TypeId::VEC4, Swizzle::new(&[0, 1, 2]));
        if let Some(failed) = self.cx.resources.failed_asserts {
            let failed = self.global(failed);
            let failed = self.load(failed);
            for (bit, paint) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0]].iter().enumerate()
            {
                let mask = self.literal(Scalar::Uint, 1 << bit);
                let zero = self.literal(Scalar::Uint, 0);
                let flag = self.op(Op::And, failed, mask);
                let condition = self.op(Op::NotEqual, flag, zero);
                let parts = paint.map(|part| self.float(part)).to_vec();
                let paint = self.compose(TypeId::VEC3, parts);
                rgb = self.select(condition, paint, rgb);
            }
        }
        let one = self.float(1.0);
        self.compose(TypeId::VEC4, vec![rgb, one])
    }

    /// The direction from the centre to a texel of the face the uniform block names: corners as OpenGL ES 3.0, table 3.21, has
    /// them, in its order of faces.
    fn cube_direction(&mut self, at: Value) -> Value {
        let (member, name) = resources::uniform(Uniform::Resolution);
        self.cx.reflection.uniforms.insert(name);
        let resolution = self.block_member(member);
        let resolution = self.load(resolution);
        let size = self.swizzle(resolution, TypeId::VEC3, Swizzle::new(&[0, 1]));
        let unit = self.op(Op::Divide, at, size);
        let (two, one) = (self.float_of(TypeId::VEC2, 2.0), self.float_of(TypeId::VEC2, 1.0));
        let twice = self.op(Op::Multiply, unit, two);
        let st = self.op(Op::Subtract, twice, one);
        let s = self.add(Expression::AccessIndex { base: st, index: 0 });
        let t = self.add(Expression::AccessIndex { base: st, index: 1 });
        let minus = self.float(-1.0);
        let (minus_s, minus_t) = (self.op(Op::Multiply, s, minus), self.op(Op::Multiply, t, minus));
        let one = self.float(1.0);
        let direction = self.temporary(TypeId::VEC3);
        let faces = [
            [one, minus_t, minus_s],
            [minus, minus_t, s],
            [s, one, t],
            [s, minus, minus_t],
            [s, minus_t, one],
            [minus_s, minus_t, minus],
        ];
        let pad = self.block_member(CUBE_FACE);
        let face = self.add(Expression::AccessIndex { base: pad, index: 0 });
        let selector = self.load(face);
        let mut cases = Vec::with_capacity(6);
        for (i, parts) in faces.into_iter().enumerate() {
            let (body, _): (Block, _) = self.branch_block(|b| {
                let value = b.compose(TypeId::VEC3, parts.to_vec());
                b.store(direction, value);
            });
            let value = if i == 5 { SwitchValue::Default } else { SwitchValue::I32(i as i32) };
            cases.push(SwitchCase { value, body, fall_through: false });
        }
        self.push(Statement::Switch { selector, cases });
        let direction = self.load(direction);
        self.math(Math::Normalize, direction)
    }

    /// One sample a pixel, row by row of 512: left in red and green, right in blue and alpha, 16 bits each, low byte first.
    fn sound(&mut self, function: naga::Handle<Function>, position: Value) -> Value {
        let at = self.swizzle(position, TypeId::VEC4, Swizzle::new(&[0, 1]));
        let at = self.add(Expression::As { expr: at, kind: ScalarKind::Sint, convert: Some(4) });
        let column = self.add(Expression::AccessIndex { base: at, index: 0 });
        let row = self.add(Expression::AccessIndex { base: at, index: 1 });
        let width = self.literal(Scalar::Int, 512);
        let before = self.op(Op::Multiply, row, width);
        let number = self.op(Op::Add, before, column);
        let [time_offset, sample_offset] = [Uniform::TimeOffset, Uniform::SampleOffset].map(|uniform| {
            let (member, name) = resources::uniform(uniform);
            self.cx.reflection.uniforms.insert(name);
            let pointer = self.block_member(member);
            self.load(pointer)
        });
        let rate = self.float(44100.0);
        let float = self.add(Expression::As { expr: number, kind: ScalarKind::Float, convert: Some(4) });
        let seconds = self.op(Op::Divide, float, rate);
        let time = self.op(Op::Add, time_offset, seconds);
        let sample = self.op(Op::Add, sample_offset, number);
        let result = self.computed_elsewhere(Expression::CallResult(function));
        self.push(Statement::Call { function, arguments: vec![sample, time], result: Some(result) });
        let half = self.float_of(TypeId::VEC2, 0.5);
        let scale = self.float_of(TypeId::VEC2, 65536.0);
        let halved = self.op(Op::Multiply, half, result);
        let shifted = self.op(Op::Add, half, halved);
        let scaled = self.op(Op::Multiply, shifted, scale);
        let value = self.math(Math::Floor, scaled);
        let (byte, last) = (self.float_of(TypeId::VEC2, 256.0), self.float_of(TypeId::VEC2, 255.0));
        let quotient = self.op(Op::Divide, value, byte);
        let high = self.math(Math::Floor, quotient);
        let multiple = self.op(Op::Multiply, byte, high);
        let low = self.op(Op::Subtract, value, multiple);
        let (low, high) = (self.op(Op::Divide, low, last), self.op(Op::Divide, high, last));
        let part = |b: &mut Self, base, index| b.add(Expression::AccessIndex { base, index });
        let parts = vec![part(self, low, 0), part(self, high, 0), part(self, low, 1), part(self, high, 1)];
        self.compose(TypeId::VEC4, parts)
    }
}
