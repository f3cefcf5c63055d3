//! Module-scope variables: uniform blocks, channels, and memory shared by functions.
//!
//! Each is declared, and added to the reflection, when it is first used.

use std::num::NonZeroU32;

use naga::{
    AddressSpace, ArraySize, GlobalVariable, Handle, ImageClass, ImageDimension, ResourceBinding, ScalarKind, Span,
    StructMember, TypeInner, VectorSize,
};

use super::context::Emitter;
use crate::{
    CustomUniform, UniformSet, UniformSource,
    builtins::Uniform,
    interface::{self, GeometryBlock, UniformBlock},
    ir::{GlobalId, GlobalKind},
    types::{SamplerDim, Scalar, TypeId},
};

/// A member of the block: name, offset, and its kind.
macro_rules! members {
    ($($name:literal $field:ident $kind:ident;)*) => {
        [$(($name, std::mem::offset_of!(UniformBlock, $field) as u32, Member::$kind)),*]
    };
}

#[derive(Clone, Copy)]
enum Member {
    Float,
    Int,
    Vec3,
    Vec4,
    Int2,
    Int4,
    /// `float[4]` in slots of 16 bytes.
    Floats,
    Vec3s,
}

/// Fields of [`UniformBlock`] in order.
const MEMBERS: [(&str, u32, Member); 15] = members! {
    "iResolution" resolution Vec3;
    "iTime" time Float;
    "iMouse" mouse Vec4;
    "iDate" date Vec4;
    "iTimeDelta" time_delta Float;
    "iFrameRate" frame_rate Float;
    "iSampleRate" sample_rate Float;
    "iFrame" frame Int;
    "iChannelTime" channel_time Floats;
    "iChannelResolution" channel_resolution Vec3s;
    "iTimeOffset" time_offset Float;
    "iSampleOffset" sample_offset Int;
    "cube_face" cube_face Int2;
    "iChannelLoaded" channel_loaded Int4;
    "tile_origin" tile_origin Int2;
};

/// Returns the index of a uniform in [`MEMBERS`], and its flag in the reflection.
pub(super) fn uniform(uniform: Uniform) -> (u32, UniformSet) {
    let flag = UniformSet::of(uniform).expect("a uniform of this block");
    // The flags are in the order of the members, between which is the cube's face.
    let index = flag.bits().trailing_zeros();
    (if index < CUBE_FACE { index } else { index + 1 }, flag)
}

/// The index of the cube face in [`MEMBERS`].
pub(super) const CUBE_FACE: u32 = 12;

/// The index of the tile's origin in [`MEMBERS`].
pub(super) const TILE_ORIGIN: u32 = 14;

/// A member of the block that is always zero.
pub(super) const ZERO: (u32, u32) = (CUBE_FACE, 1);

impl Emitter<'_> {
    pub(super) fn variable(
        &mut self,
        space: AddressSpace,
        ty: Handle<naga::Type>,
        binding: Option<ResourceBinding>,
        init: Option<Handle<naga::Expression>>,
    ) -> Handle<GlobalVariable> {
        let memory_decorations = naga::MemoryDecorations::empty();
        let variable = GlobalVariable { name: None, space, binding, ty, init, memory_decorations };
        self.out.global_variables.append(variable, Span::UNDEFINED)
    }

    /// Returns memory of one invocation, zero at its start unless `init` is given.
    pub(super) fn private(
        &mut self,
        ty: Handle<naga::Type>,
        init: Option<Handle<naga::Expression>>,
    ) -> Handle<GlobalVariable> {
        self.variable(AddressSpace::Private, ty, None, init)
    }

    /// Returns the uniform block.
    pub(super) fn block(&mut self) -> Handle<GlobalVariable> {
        if let Some(block) = self.resources.block {
            return block;
        }
        let mut members = Vec::with_capacity(MEMBERS.len());
        for (name, offset, member) in MEMBERS {
            let four = ArraySize::Constant(NonZeroU32::new(4).expect("not zero"));
            let vector = |size, scalar| TypeInner::Vector { size, scalar };
            let inner = match member {
                Member::Float => TypeInner::Scalar(naga::Scalar::F32),
                Member::Int => TypeInner::Scalar(naga::Scalar::I32),
                Member::Vec3 => vector(VectorSize::Tri, naga::Scalar::F32),
                Member::Vec4 => vector(VectorSize::Quad, naga::Scalar::F32),
                Member::Int2 => vector(VectorSize::Bi, naga::Scalar::I32),
                Member::Int4 => vector(VectorSize::Quad, naga::Scalar::I32),
                Member::Floats => TypeInner::Array { base: self.ty(TypeId::VEC4), size: four, stride: 16 },
                Member::Vec3s => TypeInner::Array { base: self.ty(TypeId::VEC3), size: four, stride: 16 },
            };
            let ty = self.insert_type(inner);
            members.push(StructMember { name: Some(name.into()), ty, binding: None, offset });
        }
        let span = size_of::<UniformBlock>() as u32;
        let ty = self.insert_type(TypeInner::Struct { members, span });
        let binding = ResourceBinding { group: interface::UNIFORM_GROUP, binding: 0 };
        let block = self.variable(AddressSpace::Uniform, ty, Some(binding), None);
        self.resources.block = Some(block);
        block
    }

    /// Returns the variable with the matrices and the camera that a mesh is drawn with.
    pub(super) fn geometry_block(&mut self) -> Handle<GlobalVariable> {
        if let Some(block) = self.resources.geometry {
            return block;
        }
        let mat4 = TypeId::matrix(4, 4);
        let fields = [
            ("iModel", mat4, std::mem::offset_of!(GeometryBlock, model)),
            ("iView", mat4, std::mem::offset_of!(GeometryBlock, view)),
            ("iProjection", mat4, std::mem::offset_of!(GeometryBlock, projection)),
            ("iNormalMatrix", TypeId::matrix(3, 3), std::mem::offset_of!(GeometryBlock, normal)),
            ("iCameraPosition", TypeId::VEC3, std::mem::offset_of!(GeometryBlock, camera)),
        ];
        let mut member = |(name, ty, offset): (&str, TypeId, usize)| {
            let ty = self.ty(ty);
            StructMember { name: Some(name.into()), ty, binding: None, offset: offset as u32 }
        };
        let members = fields.into_iter().map(&mut member).collect();
        let span = size_of::<GeometryBlock>() as u32;
        let ty = self.insert_type(TypeInner::Struct { members, span });
        let binding = ResourceBinding { group: interface::UNIFORM_GROUP, binding: interface::GEOMETRY_BINDING };
        let block = self.variable(AddressSpace::Uniform, ty, Some(binding), None);
        self.resources.geometry = Some(block);
        self.reflection.geometry = true;
        block
    }

    /// Returns the number of slots up to the last that the pass may name.
    pub(super) fn custom_uniform_slots(&self) -> u32 {
        let slot = |uniform: &CustomUniform<'_>| match uniform.source {
            UniformSource::Slot(slot) => Some(u32::from(slot) + 1),
            _ => None,
        };
        self.source.custom_uniforms.iter().filter_map(slot).max().unwrap_or(0)
    }

    /// Returns the custom uniforms: an array of slots, because every backend uses the same layout for that.
    pub(super) fn custom_uniform_block(&mut self) -> Handle<GlobalVariable> {
        if let Some(block) = self.resources.custom_uniform_block {
            return block;
        }
        let base = self.ty(TypeId::vector(Scalar::Uint, 4));
        let size = ArraySize::Constant(NonZeroU32::new(self.custom_uniform_slots()).expect("at least one"));
        let ty = self.insert_type(TypeInner::Array { base, size, stride: interface::CUSTOM_UNIFORM_BYTES as u32 });
        let binding = ResourceBinding { group: interface::UNIFORM_GROUP, binding: interface::CUSTOM_UNIFORM_BINDING };
        let block = self.variable(AddressSpace::Uniform, ty, Some(binding), None);
        self.resources.custom_uniform_block = Some(block);
        block
    }

    /// Returns the texture of a channel.
    pub(super) fn texture(&mut self, channel: u8) -> Handle<GlobalVariable> {
        if let Some(&texture) = self.resources.textures.get(&channel) {
            return texture;
        }
        let texture = &self.ir.textures[usize::from(channel)];
        let dim = match texture.dim {
            SamplerDim::D1 | SamplerDim::D2 | SamplerDim::D2Array => ImageDimension::D2,
            SamplerDim::D3 => ImageDimension::D3,
            SamplerDim::Cube => ImageDimension::Cube,
        };
        let kind = match texture.scalar {
            Scalar::Int => ScalarKind::Sint,
            Scalar::Uint => ScalarKind::Uint,
            Scalar::Float | Scalar::Bool => ScalarKind::Float,
        };
        let class = match texture.shadow {
            true => ImageClass::Depth { multi: false },
            false => ImageClass::Sampled { kind, multi: false },
        };
        let ty = self.insert_type(TypeInner::Image { dim, arrayed: texture.dim == SamplerDim::D2Array, class });
        let made = self.handle(ty, channel, 0);
        self.resources.textures.insert(channel, made);
        self.reflection.channel(channel).texture = true;
        made
    }

    /// Returns the sampler of a channel.
    pub(super) fn sampler(&mut self, channel: u8) -> Handle<GlobalVariable> {
        if let Some(&sampler) = self.resources.samplers.get(&channel) {
            return sampler;
        }
        let comparison = self.ir.textures[usize::from(channel)].shadow;
        let ty = self.insert_type(TypeInner::Sampler { comparison });
        let made = self.handle(ty, channel, 1);
        self.resources.samplers.insert(channel, made);
        self.reflection.channel(channel).sampler = true;
        made
    }

    /// Returns a variable at the binding `after` places after the first of a channel.
    fn handle(&mut self, ty: Handle<naga::Type>, channel: u8, after: u32) -> Handle<GlobalVariable> {
        let texture = &self.ir.textures[usize::from(channel)];
        let binding = ResourceBinding { group: texture.group, binding: texture.binding + after };
        let made = self.variable(AddressSpace::Handle, ty, Some(binding), None);
        if !texture.name.is_empty() {
            let suffix = if after == 0 { "" } else { "_sampler" };
            self.out.global_variables[made].name = Some(format!("{}{suffix}", texture.name));
        }
        made
    }

    /// Returns private memory, set to its constant value if it has one.
    pub(super) fn private_global(&mut self, id: GlobalId) -> Handle<GlobalVariable> {
        if let Some(&Some(made)) = self.resources.private.get(id.index()) {
            return made;
        }
        let global = self.ir[id];
        let GlobalKind::Private(init) = global.kind else { unreachable!("not private: {global:?}") };
        let ty = self.ty(global.ty);
        let is_copied = self.is_long(global.ty);
        let value = init.filter(|_| !is_copied).and_then(|init| self.constant_init(init));
        let made = self.private(ty, value);
        if let (Some(init), None) = (init, value) {
            self.consts.set_at_start.push((made, init));
            self.overwritten.insert(made);
        }
        if self.resources.private.len() <= id.index() {
            self.resources.private.resize(self.ir.globals.len().max(id.index() + 1), None);
        }
        self.resources.private[id.index()] = Some(made);
        made
    }

    /// Returns the variable with the zero that the driver cannot know; the entry point sets it.
    pub(super) fn opaque_zero(&mut self) -> Handle<GlobalVariable> {
        if self.resources.opaque_zero.is_none() {
            let ty = self.ty(TypeId::INT);
            self.resources.opaque_zero = Some(self.private(ty, None));
        }
        self.resources.opaque_zero.expect("just set")
    }
}
