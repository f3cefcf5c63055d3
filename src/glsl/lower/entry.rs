//! The fragment entry point: the code of Shadertoy's `main` around the author's function, for each kind of pass.

use super::{context::Lowering, function::Builder, reachable::Reachable};
use crate::{
    Alpha, PassKind,
    hir::{FragCoord, GlobalId, GlobalStorage, Scalar, Swizzle, TypeId, Uniform, VarFlags},
    ir::{self, Binary, Block, Case, Input, Math, Op, Output, Stmt, Value},
};

/// Lowers the entry point; all functions have been lowered.
pub(super) fn lower(cx: &mut Lowering<'_>, reachable: &Reachable) -> ir::Function {
    let entry = reachable.instances.last().expect("the entry point is reached").clone();
    let author = cx.functions[&entry];
    let kind = cx.source.kind;
    let mut b = Builder::new(cx, 0, 0);
    // Lowered before the code that precedes them: they may reach globals that no function does.
    let (initialisers, _) = b.nested(|b| b.initialise_globals(reachable));
    let position = b.add_before(Op::Input(Input::Position));
    let position = if b.cx.source.tiled { b.in_whole_picture(position) } else { position };
    b.set_frag_coord(position);
    b.splice(initialisers);
    let mut beside = None;
    let result = match kind {
        PassKind::Image | PassKind::Buffer => {
            let at = b.swizzle(position, TypeId::VEC4, Swizzle::new(&[0, 1]));
            let colour = b.call_with_colour(author, vec![at]);
            match (kind, b.probed_value()) {
                (PassKind::Image, Some(value)) => value,
                (PassKind::Image, None) => b.finish_image(colour),
                (_, value) => {
                    beside = value;
                    colour
                }
            }
        }
        PassKind::Cubemap => {
            let at = b.swizzle(position, TypeId::VEC4, Swizzle::new(&[0, 1]));
            let origin = b.zero(TypeId::VEC3);
            let direction = b.cube_direction(at);
            let colour = b.call_with_colour(author, vec![at, origin, direction]);
            beside = b.probed_value();
            colour
        }
        PassKind::Sound => b.sound(author, position),
        PassKind::Main(alpha) => {
            b.push_call(author, Vec::new());
            let colour = b.main_output();
            match b.probed_value() {
                Some(value) if alpha != Alpha::Stored => value,
                value => {
                    beside = value;
                    b.with_alpha(colour, alpha)
                }
            }
        }
        PassKind::Vertex | PassKind::Fragment | PassKind::PlainVertex | PassKind::PlainFragment => {
            unreachable!("stages have an entry point of their own")
        }
    };
    let results = [result].into_iter().chain(beside);
    let parts: Vec<_> = results.zip(0..).map(|(result, location)| (Output::Target(location), result)).collect();
    parts.iter().zip(&mut b.cx.reflection.outputs).for_each(|(_, has_output)| *has_output = true);
    b.push(Stmt::Output(parts));
    b.finish()
}

impl Builder<'_, '_> {
    /// Computes the initial values of globals that are not constant, in text order.
    pub(super) fn initialise_globals(&mut self, reachable: &Reachable) {
        let hir = self.cx.hir;
        for (i, global) in hir.globals.iter().enumerate() {
            let (Some(init), None, true) = (global.init, global.value, reachable.globals[i]) else { continue };
            if matches!(global.storage, GlobalStorage::Private | GlobalStorage::Out) {
                let value = self.value(init);
                let variable = self.cx.global(GlobalId::new(i));
                let pointer = self.global(variable);
                self.store(pointer, value);
            }
        }
    }

    /// Returns the position in the whole picture of a pixel of a tile. Exact: both parts are halves below 2^23.
    fn in_whole_picture(&mut self, position: Value) -> Value {
        let origin = self.cx.tile_origin();
        let origin = self.global(origin);
        let origin = self.load(origin);
        let origin = self.add(Op::Convert { value: origin, to: Scalar::Float });
        let at = self.swizzle(position, TypeId::VEC4, Swizzle::new(&[0, 1]));
        let moved = self.op(Binary::Add, at, origin);
        let rest: Vec<Value> = (2..4).map(|index| self.add(Op::Part { base: position, index })).collect();
        self.compose(TypeId::VEC4, [vec![moved], rest].concat())
    }

    /// Sets `gl_FragCoord` as WebGL does for a triangle at depth 0: z is one half, w is one.
    fn set_frag_coord(&mut self, position: Value) {
        let Some(variable) = self.cx.resources.frag_coord else { return };
        let mut at = self.swizzle(position, TypeId::VEC4, Swizzle::new(&[0, 1]));
        let FragCoord { is_from_top, is_of_corners } = self.cx.hir.frag_coord;
        if is_from_top {
            let [x, y] = [0, 1].map(|index| self.add(Op::Part { base: at, index }));
            let resolution = self.cx.uniform(Uniform::Resolution);
            let resolution = self.global(resolution);
            let resolution = self.load(resolution);
            let height = self.add(Op::Part { base: resolution, index: 1 });
            let y = self.op(Binary::Subtract, height, y);
            at = self.compose(TypeId::VEC2, vec![x, y]);
        }
        if is_of_corners {
            let half = self.float_of(TypeId::VEC2, 0.5);
            at = self.op(Binary::Subtract, at, half);
        }
        let (half, one) = (self.float(0.5), self.float(1.0));
        let coordinate = self.compose(TypeId::VEC4, vec![at, half, one]);
        let pointer = self.global(variable);
        self.store(pointer, coordinate);
    }

    /// Calls a function whose first parameter is `out vec4`; returns the value of that argument after the call.
    fn call_with_colour(&mut self, function: ir::FuncId, rest: Vec<Value>) -> Value {
        let colour = self.temporary(TypeId::VEC4);
        let mut arguments = vec![colour];
        arguments.extend(rest);
        self.push_call(function, arguments);
        self.load(colour)
    }

    /// Returns the first output of a complete fragment shader, black and transparent if it has none.
    fn main_output(&mut self) -> Value {
        let declared = self.cx.interface.outputs.iter().find(|(_, location)| *location == 0).copied();
        if let Some((id, _)) = declared {
            return self.output_of(id);
        }
        let hir = self.cx.hir;
        let is_written = |id: &GlobalId| hir[*id].flags.contains(VarFlags::WRITTEN);
        if let Some(id) = hir.frag_color.filter(is_written) {
            return self.output_of(id);
        }
        match hir.frag_data {
            Some(id) => {
                let memory = self.cx.global(id);
                let pointer = self.global(memory);
                let first = self.add(Op::Part { base: pointer, index: 0 });
                self.load(first)
            }
            None => self.zero(TypeId::VEC4),
        }
    }

    fn with_alpha(&mut self, colour: Value, alpha: Alpha) -> Value {
        if alpha == Alpha::Stored {
            return colour;
        }
        let mut rgb = self.swizzle(colour, TypeId::VEC4, Swizzle::new(&[0, 1, 2]));
        if alpha != Alpha::Opaque {
            // Blending limits the factor to 0..1 (OpenGL ES 3.0, section 4.1.7).
            let a = self.add(Op::Part { base: colour, index: 3 });
            let (zero, one) = (self.float(0.0), self.float(1.0));
            let a = self.math3(Math::Clamp, a, zero, one);
            let factor = self.compose(TypeId::VEC3, vec![a, a, a]);
            rgb = self.op(Binary::Multiply, rgb, factor);
            if alpha == Alpha::OverTransparent {
                let a = self.op(Binary::Multiply, a, a);
                return self.compose(TypeId::VEC4, vec![rgb, a]);
            }
        }
        let one = self.float(1.0);
        self.compose(TypeId::VEC4, vec![rgb, one])
    }

    /// Sets alpha to one; a failed assertion paints red, green, blue or yellow, by the last of the numbers that failed.
    fn finish_image(&mut self, colour: Value) -> Value {
        let mut rgb = self.swizzle(colour, TypeId::VEC4, Swizzle::new(&[0, 1, 2]));
        if let Some(failed) = self.cx.resources.failed_asserts {
            let failed = self.global(failed);
            let failed = self.load(failed);
            for (bit, paint) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0]].iter().enumerate()
            {
                let mask = self.literal(Scalar::Uint, 1 << bit);
                let zero = self.literal(Scalar::Uint, 0);
                let flag = self.op(Binary::And, failed, mask);
                let condition = self.op(Binary::NotEqual, flag, zero);
                let parts = paint.map(|part| self.float(part)).to_vec();
                let paint = self.compose(TypeId::VEC3, parts);
                rgb = self.select(condition, paint, rgb);
            }
        }
        let one = self.float(1.0);
        self.compose(TypeId::VEC4, vec![rgb, one])
    }

    /// Returns the direction from the centre to a texel of the face in the uniform block: corners and order of faces
    /// are those of OpenGL ES 3.0, table 3.21.
    fn cube_direction(&mut self, at: Value) -> Value {
        let resolution = self.cx.uniform(Uniform::Resolution);
        let resolution = self.global(resolution);
        let resolution = self.load(resolution);
        let size = self.swizzle(resolution, TypeId::VEC3, Swizzle::new(&[0, 1]));
        let unit = self.op(Binary::Divide, at, size);
        let (two, one) = (self.float_of(TypeId::VEC2, 2.0), self.float_of(TypeId::VEC2, 1.0));
        let twice = self.op(Binary::Multiply, unit, two);
        let st = self.op(Binary::Subtract, twice, one);
        let s = self.add(Op::Part { base: st, index: 0 });
        let t = self.add(Op::Part { base: st, index: 1 });
        let minus = self.float(-1.0);
        let (minus_s, minus_t) = (self.op(Binary::Multiply, s, minus), self.op(Binary::Multiply, t, minus));
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
        let face = self.cx.cube_face();
        let face = self.global(face);
        let selector = self.load(face);
        let mut cases = Vec::with_capacity(6);
        for (i, parts) in faces.into_iter().enumerate() {
            let (body, _): (Block, _) = self.nested(|b| {
                let value = b.compose(TypeId::VEC3, parts.to_vec());
                b.store(direction, value);
            });
            let label = (i != 5).then_some(i as u32);
            cases.push(Case { label, body, falls_through: false });
        }
        self.push(Stmt::Switch { selector, cases });
        let direction = self.load(direction);
        self.math(Math::Normalize, direction)
    }

    /// Returns one sample per pixel, row by row of 512: left in red and green, right in blue and alpha, 16 bits each,
    /// low byte first.
    fn sound(&mut self, function: ir::FuncId, position: Value) -> Value {
        let at = self.swizzle(position, TypeId::VEC4, Swizzle::new(&[0, 1]));
        let at = self.add(Op::Convert { value: at, to: Scalar::Int });
        let column = self.add(Op::Part { base: at, index: 0 });
        let row = self.add(Op::Part { base: at, index: 1 });
        let width = self.literal(Scalar::Int, 512);
        let before = self.op(Binary::Multiply, row, width);
        let number = self.op(Binary::Add, before, column);
        let [time_offset, sample_offset] = [Uniform::TimeOffset, Uniform::SampleOffset].map(|uniform| {
            let global = self.cx.uniform(uniform);
            let place = self.global(global);
            self.load(place)
        });
        let rate = self.float(44100.0);
        let float = self.add(Op::Convert { value: number, to: Scalar::Float });
        let seconds = self.op(Binary::Divide, float, rate);
        let time = self.op(Binary::Add, time_offset, seconds);
        let sample = self.op(Binary::Add, sample_offset, number);
        let result = self.push_call(function, vec![sample, time]);
        let half = self.float_of(TypeId::VEC2, 0.5);
        let scale = self.float_of(TypeId::VEC2, 65536.0);
        let halved = self.op(Binary::Multiply, half, result);
        let shifted = self.op(Binary::Add, half, halved);
        let scaled = self.op(Binary::Multiply, shifted, scale);
        let value = self.math(Math::Floor, scaled);
        let (byte, last) = (self.float_of(TypeId::VEC2, 256.0), self.float_of(TypeId::VEC2, 255.0));
        let quotient = self.op(Binary::Divide, value, byte);
        let high = self.math(Math::Floor, quotient);
        let multiple = self.op(Binary::Multiply, byte, high);
        let low = self.op(Binary::Subtract, value, multiple);
        let (low, high) = (self.op(Binary::Divide, low, last), self.op(Binary::Divide, high, last));
        let part = |b: &mut Self, base, index| b.add(Op::Part { base, index });
        let parts = vec![part(self, low, 0), part(self, high, 0), part(self, low, 1), part(self, high, 1)];
        self.compose(TypeId::VEC4, parts)
    }
}
