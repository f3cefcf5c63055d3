//! Texture functions (section 8.8) on channels.

use naga::{Expression, ImageQuery, SampleLevel, ScalarKind};

use super::function::{Builder, Value};
use crate::glsl::{
    ChannelKind,
    hir::{Builtin, ExprId, ExprKind, Scalar, Swizzle, TypeId},
};

/// What distinguishes the sampling functions.
struct Form {
    /// The coordinate's last component divides.
    proj: bool,
    offset: bool,
    level: Level,
}

enum Level {
    /// With or without a bias at the end.
    Implicit,
    Lod,
    Grad,
}

fn form(builtin: Builtin) -> Form {
    use Builtin as B;
    let (proj, offset, level) = match builtin {
        B::Texture => (false, false, Level::Implicit),
        B::TextureOffset => (false, true, Level::Implicit),
        B::TextureProj => (true, false, Level::Implicit),
        B::TextureProjOffset => (true, true, Level::Implicit),
        B::TextureLod => (false, false, Level::Lod),
        B::TextureLodOffset => (false, true, Level::Lod),
        B::TextureProjLod => (true, false, Level::Lod),
        B::TextureProjLodOffset => (true, true, Level::Lod),
        B::TextureGrad => (false, false, Level::Grad),
        B::TextureGradOffset => (false, true, Level::Grad),
        B::TextureProjGrad => (true, false, Level::Grad),
        B::TextureProjGradOffset => (true, true, Level::Grad),
        other => unreachable!("{other:?} does not sample"),
    };
    Form { proj, offset, level }
}

impl Builder<'_, '_> {
    pub fn texture(&mut self, builtin: Builtin, ty: TypeId, args: &[ExprId]) -> Value {
        let channel = self.channel(args[0]);
        match builtin {
            Builtin::TextureSize => self.texture_size(channel, ty, args[1]),
            Builtin::TexelFetch | Builtin::TexelFetchOffset => self.texel_fetch(channel, args),
            _ => self.sample(channel, form(builtin), args),
        }
    }

    fn kind(&self, channel: u8) -> ChannelKind {
        self.cx.source.channels[usize::from(channel)]
    }

    /// Dimensions a coordinate of the channel has.
    fn dimensions(&self, channel: u8) -> u8 {
        match self.kind(channel) {
            ChannelKind::Sampler2D => 2,
            ChannelKind::Sampler3D | ChannelKind::SamplerCube => 3,
        }
    }

    fn texture_size(&mut self, channel: u8, ty: TypeId, lod: ExprId) -> Value {
        let level = match self.literal_bits(lod) {
            Some(0) => None,
            _ => {
                self.cx.reflection.channels[usize::from(channel)].mips = true;
                Some(self.value(lod))
            }
        };
        let image = self.cx.texture(channel);
        let image = self.global(image);
        let size = self.add(Expression::ImageQuery { image, query: ImageQuery::Size { level } });
        debug_assert_eq!(self.cx.hir.types.scalar(ty), Some(Scalar::Int));
        self.bitcast(size, ScalarKind::Sint)
    }

    /// `texelFetch(sampler, coordinate, level[, offset])`. Outside the texture it gives zeros: the driver sees to it.
    fn texel_fetch(&mut self, channel: u8, args: &[ExprId]) -> Value {
        let mut coordinate = self.value(args[1]);
        let level = self.value(args[2]);
        if self.literal_bits(args[2]) != Some(0) {
            self.cx.reflection.channels[usize::from(channel)].mips = true;
        }
        if let Some(&offset) = args.get(3) {
            let offset = self.value(offset);
            coordinate = self.op(naga::BinaryOperator::Add, coordinate, offset);
        }
        let image = self.cx.texture(channel);
        let image = self.global(image);
        self.add(Expression::ImageLoad { image, coordinate, array_index: None, sample: None, level: Some(level) })
    }

    fn sample(&mut self, channel: u8, form: Form, args: &[ExprId]) -> Value {
        let hir = self.cx.hir;
        let mut rest = args[2..].iter().copied();
        let mut next = || rest.next();
        let mut coordinate = self.value(args[1]);
        let mut level = match form.level {
            Level::Implicit => SampleLevel::Auto,
            Level::Lod => {
                let lod = next().expect("a level");
                let is_base = self.literal_bits(lod).is_some_and(|bits| f32::from_bits(bits) == 0.0);
                self.cx.reflection.channels[usize::from(channel)].mips |= !is_base;
                SampleLevel::Exact(self.value(lod))
            }
            Level::Grad => {
                let (x, y) = (next().expect("a gradient"), next().expect("a gradient"));
                SampleLevel::Gradient { x: self.value(x), y: self.value(y) }
            }
        };
        let offset = if form.offset { next() } else { None };
        if let (Level::Implicit, Some(bias)) = (form.level, next()) {
            level = SampleLevel::Bias(self.value(bias));
        }
        if self.cx.source.kind == crate::glsl::PassKind::Vertex
            && matches!(level, SampleLevel::Auto | SampleLevel::Bias(_))
        {
            // Section 8.8: without derivatives it is the base level that is read.
            level = SampleLevel::Exact(self.float(0.0));
        }
        match level {
            SampleLevel::Auto | SampleLevel::Bias(_) | SampleLevel::Gradient { .. } => {
                self.cx.reflection.channels[usize::from(channel)].mips = true;
            }
            SampleLevel::Exact(_) | SampleLevel::Zero => {}
        }
        if form.proj {
            coordinate = self.divide_by_last(coordinate, hir[args[1]].ty, self.dimensions(channel));
        }
        if self.cx.source.bilinear_by_hand[usize::from(channel)] && self.kind(channel) == ChannelKind::Sampler2D {
            let offset = offset.map(|offset| self.value(offset));
            return self.sample_by_hand(channel, coordinate, level, offset);
        }
        let offset = offset.map(|offset| self.constant_offset(offset));
        self.image_sample(channel, coordinate, level, offset)
    }

    pub fn image_sample(&mut self, channel: u8, coordinate: Value, level: SampleLevel, offset: Option<Value>) -> Value {
        let (image, sampler) = (self.cx.texture(channel), self.cx.sampler(channel));
        let (image, sampler) = (self.global(image), self.global(sampler));
        self.add(Expression::ImageSample {
            image,
            sampler,
            gather: None,
            coordinate,
            array_index: None,
            offset,
            level,
            depth_ref: None,
            clamp_to_edge: false,
        })
    }

    /// A constant offset, in the form naga's validator takes for constant.
    fn constant_offset(&mut self, offset: ExprId) -> Value {
        debug_assert!(matches!(self.cx.hir[offset].kind, ExprKind::Const(_) | ExprKind::Literal(_)));
        self.value(offset)
    }

    fn divide_by_last(&mut self, coordinate: Value, ty: TypeId, dimensions: u8) -> Value {
        let last = self.extent(ty) - 1;
        let divisor = self.add(Expression::AccessIndex { base: coordinate, index: last });
        let components: Vec<u8> = (0..dimensions).collect();
        let numerator = self.swizzle(coordinate, ty, Swizzle::new(&components));
        // Times the reciprocal, as drivers do that read with a projection themselves.
        let one = self.float(1.0);
        let scale = self.op(naga::BinaryOperator::Divide, one, divisor);
        let ty = TypeId::vector(Scalar::Float, dimensions);
        self.each(ty, [(ty, numerator), (TypeId::FLOAT, scale)], |b, [x, scale]| {
            b.op(naga::BinaryOperator::Multiply, x, scale)
        })
    }
}
