//! Manual filtering, for channels whose texture the device cannot filter ([`PassSource::bilinear_in_shader`]).
//!
//! Four reads at texel centres with the channel's own (nearest) sampler, which applies its wrap mode, and a mix with
//! the weights of section 8.13 (equation 3.25 there) of the OpenGL ES 3.0 specification. Between two mip levels, the
//! same is done in both.
//!
//! [`PassSource::bilinear_in_shader`]: crate::PassSource::bilinear_in_shader

use crate::{
    ir::{
        Axis, Binary, Detail, Level, Math, Module, Op, Value,
        rewrite::{self, Rewriter, Rule},
    },
    source::MAX_CHANNELS,
    types::{Scalar, TypeId},
};

/// Expands every filtered read of these channels. Only reads of 2D textures are filtered.
pub(super) fn run(program: &mut Module, channels: [bool; MAX_CHANNELS]) {
    rewrite::each_function(program, || BilinearInShader(channels));
}

/// The channels that are filtered manually.
struct BilinearInShader([bool; MAX_CHANNELS]);

impl Rule for BilinearInShader {
    fn operation(&mut self, r: &mut Rewriter<'_>, _: Value, op: &Op) -> Option<Value> {
        let Op::Sample { channel, coordinate, level, offset } = *op else { return None };
        if !self.0.get(usize::from(channel)).is_some_and(|by_hand| *by_hand) || r.f.ty(coordinate) != TypeId::VEC2 {
            return None;
        }
        Some(Reads { r, channel, coordinate, offset }.filtered(level))
    }
}

/// The code for one filtered read.
struct Reads<'r, 'm> {
    r: &'r mut Rewriter<'m>,
    channel: u8,
    coordinate: Value,
    /// In texels.
    offset: Option<Value>,
}

impl Reads<'_, '_> {
    fn filtered(&mut self, level: Level) -> Value {
        let lod = match level {
            Level::Exact(lod) => lod,
            Level::Auto => self.implicit_lod(),
            Level::Bias(bias) => {
                let lod = self.implicit_lod();
                self.binary(Binary::Add, lod, bias)
            }
            Level::Gradient { x, y } => self.lod(x, y),
        };
        let levels = self.r.add(Op::TextureLevels { channel: self.channel });
        let levels = self.r.add(Op::Convert { value: levels, to: Scalar::Float });
        let one = self.float(1.0);
        let zero = self.float(0.0);
        let last = self.binary(Binary::Subtract, levels, one);
        let lod = self.math(Math::Clamp, lod, [Some(zero), Some(last)]);
        let fine = self.math(Math::Floor, lod, [None, None]);
        let coarse = self.math(Math::Ceil, lod, [None, None]);
        let weight = self.binary(Binary::Subtract, lod, fine);
        let fine = self.four_reads(fine);
        let coarse = self.four_reads(coarse);
        self.mix(fine, coarse, weight)
    }

    fn implicit_lod(&mut self) -> Value {
        let [x, y] = [Axis::X, Axis::Y]
            .map(|axis| self.r.add(Op::Derivative { axis, detail: Detail::Any, value: self.coordinate }));
        self.lod(x, y)
    }

    /// Computes the logarithm of the longer of the two footprints in texels (section 8.14, 3.8.10 in older editions).
    fn lod(&mut self, x: Value, y: Value) -> Value {
        let size = self.size(None);
        let [x, y] = [x, y].map(|side| {
            let side = self.binary(Binary::Multiply, side, size);
            self.math(Math::Length, side, [None, None])
        });
        let longer = self.math(Math::Max, x, [Some(y), None]);
        self.math(Math::Log2, longer, [None, None])
    }

    /// Returns the number of texels along each axis, as floats.
    fn size(&mut self, level: Option<Value>) -> Value {
        let level = level.map(|value| self.r.add(Op::Convert { value, to: Scalar::Int }));
        let ty = TypeId::vector(Scalar::Int, 2);
        let size = self.r.add_typed(Op::TextureSize { channel: self.channel, level }, ty);
        self.r.add(Op::Convert { value: size, to: Scalar::Float })
    }

    fn four_reads(&mut self, level: Value) -> Value {
        let size = self.size(Some(level));
        let mut texel = self.binary(Binary::Multiply, self.coordinate, size);
        if let Some(value) = self.offset {
            let offset = self.r.add(Op::Convert { value, to: Scalar::Float });
            texel = self.binary(Binary::Add, texel, offset);
        }
        let half = self.float(0.5);
        let half = self.r.add(Op::Splat { size: 2, value: half });
        let corner = self.binary(Binary::Subtract, texel, half);
        let whole = self.math(Math::Floor, corner, [None, None]);
        let weight = self.binary(Binary::Subtract, corner, whole);
        let reads = [[0.5, 0.5], [1.5, 0.5], [0.5, 1.5], [1.5, 1.5]].map(|centre| {
            let parts = centre.map(|x| self.float(x)).into();
            let centre = self.r.add(Op::Compose { ty: TypeId::VEC2, parts });
            let texel = self.binary(Binary::Add, whole, centre);
            let coordinate = self.binary(Binary::Divide, texel, size);
            self.r.add(Op::Sample { channel: self.channel, coordinate, level: Level::Exact(level), offset: None })
        });
        let [x, y] = [0, 1].map(|index| self.r.add(Op::Part { base: weight, index }));
        let lower = self.mix(reads[0], reads[1], x);
        let upper = self.mix(reads[2], reads[3], x);
        self.mix(lower, upper, y)
    }

    fn mix(&mut self, from: Value, to: Value, weight: Value) -> Value {
        let weight = self.r.add(Op::Splat { size: 4, value: weight });
        self.math(Math::Mix, from, [Some(to), Some(weight)])
    }

    fn float(&mut self, number: f32) -> Value {
        self.r.literal(Scalar::Float, number.to_bits())
    }

    fn binary(&mut self, op: Binary, left: Value, right: Value) -> Value {
        self.r.add(Op::Binary { op, left, right })
    }

    fn math(&mut self, fun: Math, arg: Value, [arg1, arg2]: [Option<Value>; 2]) -> Value {
        self.r.add(Op::Math { fun, arg, arg1, arg2, arg3: None })
    }
}
