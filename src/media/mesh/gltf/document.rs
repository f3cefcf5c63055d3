//! The part of a glTF file's JSON text that defines a shape, by section 5 of the specification. Everything else
//! (materials, pictures, animations, cameras) is skipped unread, so that it cannot prevent a shape from being drawn.

use serde::{
    Deserialize, Deserializer,
    de::{Error, IgnoredAny, MapAccess, SeqAccess, Unexpected, Visitor},
};
use serde_json::value::RawValue;
use std::{borrow::Cow, fmt, marker::PhantomData};

/// An index into one of the root's lists.
pub(super) type Index = u32;

/// The version of a file: all that is read before the rest.
#[derive(Deserialize)]
pub(super) struct Head<'a> {
    #[serde(borrow)]
    pub asset: Option<Asset<'a>>,
    /// A list since 2.0, an object before.
    #[serde(borrow)]
    pub nodes: Option<&'a RawValue>,
}

/// Versions as they are written: a text, or a number in files older than 1.0.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Asset<'a> {
    #[serde(borrow)]
    pub version: Option<&'a RawValue>,
    #[serde(borrow)]
    pub min_version: Option<&'a RawValue>,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct Root<'a> {
    pub accessors: Vec<Accessor>,
    #[serde(borrow)]
    pub buffers: Vec<Buffer<'a>>,
    pub buffer_views: Vec<BufferView>,
    #[serde(borrow)]
    pub extensions_used: Vec<Text<'a>>,
    #[serde(borrow)]
    pub extensions_required: Vec<Text<'a>>,
    /// Parsed only if texture coordinates are quantised.
    #[serde(borrow)]
    pub materials: Option<&'a RawValue>,
    pub meshes: Vec<Mesh>,
    pub nodes: Vec<Node>,
    #[serde(default, deserialize_with = "maybe_whole")]
    pub scene: Option<Index>,
    pub scenes: Vec<Scene>,
    pub skins: Vec<Skin>,
}

/// A text that is borrowed unless it contains escapes.
#[derive(Deserialize)]
#[serde(transparent)]
pub(super) struct Text<'a>(#[serde(borrow)] pub Cow<'a, str>);

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Buffer<'a> {
    #[serde(borrow)]
    pub uri: Option<Text<'a>>,
    #[serde(deserialize_with = "whole")]
    pub byte_length: u64,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct BufferView {
    #[serde(deserialize_with = "whole")]
    pub buffer: Index,
    #[serde(default, deserialize_with = "whole")]
    pub byte_offset: u64,
    #[serde(deserialize_with = "whole")]
    pub byte_length: u64,
    #[serde(default, deserialize_with = "maybe_whole")]
    pub byte_stride: Option<u64>,
    #[serde(default)]
    pub extensions: ViewExtensions,
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct ViewExtensions {
    #[serde(rename = "EXT_meshopt_compression")]
    pub ext_meshopt: Option<IgnoredAny>,
    #[serde(rename = "KHR_meshopt_compression")]
    pub khr_meshopt: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    #[serde(default, deserialize_with = "maybe_whole")]
    pub buffer_view: Option<Index>,
    #[serde(default, deserialize_with = "whole")]
    pub byte_offset: u64,
    #[serde(deserialize_with = "whole")]
    pub component_type: u32,
    #[serde(default)]
    pub normalized: bool,
    #[serde(deserialize_with = "whole")]
    pub count: u64,
    #[serde(rename = "type")]
    pub dimensions: Dimensions,
    pub sparse: Option<Box<Sparse>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub(super) enum Dimensions {
    #[serde(rename = "SCALAR")]
    Scalar,
    #[serde(rename = "VEC2")]
    Vec2,
    #[serde(rename = "VEC3")]
    Vec3,
    #[serde(rename = "VEC4")]
    Vec4,
    #[serde(rename = "MAT2")]
    Mat2,
    #[serde(rename = "MAT3")]
    Mat3,
    #[serde(rename = "MAT4")]
    Mat4,
    /// A value defined by an extension.
    #[serde(other)]
    Other,
}

#[derive(Deserialize)]
pub(super) struct Sparse {
    #[serde(deserialize_with = "whole")]
    pub count: u64,
    pub indices: SparseIndices,
    pub values: SparseValues,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseIndices {
    #[serde(deserialize_with = "whole")]
    pub buffer_view: Index,
    #[serde(default, deserialize_with = "whole")]
    pub byte_offset: u64,
    #[serde(deserialize_with = "whole")]
    pub component_type: u32,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct SparseValues {
    #[serde(deserialize_with = "whole")]
    pub buffer_view: Index,
    #[serde(default, deserialize_with = "whole")]
    pub byte_offset: u64,
}

#[derive(Deserialize)]
pub(super) struct Mesh {
    pub primitives: Vec<Primitive>,
    #[serde(default)]
    pub weights: Option<Vec<f32>>,
}

#[derive(Deserialize)]
pub(super) struct Primitive {
    pub attributes: Attributes,
    #[serde(default, deserialize_with = "maybe_whole")]
    pub indices: Option<Index>,
    #[serde(default, deserialize_with = "maybe_whole")]
    pub material: Option<Index>,
    #[serde(default = "Primitive::triangles", deserialize_with = "whole")]
    pub mode: u32,
    #[serde(default)]
    pub targets: Vec<Attributes>,
    #[serde(default)]
    pub extensions: PrimitiveExtensions,
}

impl Primitive {
    const fn triangles() -> u32 {
        4
    }
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct PrimitiveExtensions {
    #[serde(rename = "KHR_draco_mesh_compression")]
    pub draco: Option<IgnoredAny>,
}

/// The accessors of a primitive's attributes, or of those that a morph target displaces. Attributes that the vertex
/// buffer does not support are skipped.
#[derive(Default)]
pub(super) struct Attributes {
    pub position: Option<Index>,
    pub normal: Option<Index>,
    pub tangent: Option<Index>,
    pub uv: Option<Index>,
    pub color: Option<Index>,
    /// By the number of the set, in any order.
    pub joints: Vec<(u32, Index)>,
    pub weights: Vec<(u32, Index)>,
}

impl Attributes {
    /// Returns all of them, each with its semantic.
    pub(super) fn all(&self) -> impl Iterator<Item = (Cow<'static, str>, Index)> {
        let plain = [
            ("POSITION", self.position),
            ("NORMAL", self.normal),
            ("TANGENT", self.tangent),
            ("TEXCOORD_0", self.uv),
            ("COLOR_0", self.color),
        ];
        let plain = plain.into_iter().filter_map(|(name, index)| Some((Cow::Borrowed(name), index?)));
        let joints = self.joints.iter().map(|(set, index)| (format!("JOINTS_{set}").into(), *index));
        plain.chain(joints).chain(self.weights.iter().map(|(set, index)| (format!("WEIGHTS_{set}").into(), *index)))
    }
}

impl<'de> Deserialize<'de> for Attributes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Names;
        impl<'de> Visitor<'de> for Names {
            type Value = Attributes;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("attributes with their accessors")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Attributes, A::Error> {
                let mut found = Attributes::default();
                while let Some(Text(name)) = map.next_key()? {
                    let set = |prefix: &str| name.strip_prefix(prefix).and_then(|n| n.parse::<u32>().ok());
                    let place = match &*name {
                        "POSITION" => &mut found.position,
                        "NORMAL" => &mut found.normal,
                        "TANGENT" => &mut found.tangent,
                        "TEXCOORD_0" => &mut found.uv,
                        "COLOR_0" => &mut found.color,
                        _ => {
                            if let Some(set) = set("JOINTS_") {
                                found.joints.push((set, map.next_value::<IntegerLike<Index>>()?.0));
                            } else if let Some(set) = set("WEIGHTS_") {
                                found.weights.push((set, map.next_value::<IntegerLike<Index>>()?.0));
                            } else {
                                map.next_value::<IgnoredAny>()?;
                            }
                            continue;
                        }
                    };
                    if place.replace(map.next_value::<IntegerLike<Index>>()?.0).is_some() {
                        return Err(A::Error::custom(format_args!("{name} is there twice")));
                    }
                }
                found.joints.sort_unstable();
                found.weights.sort_unstable();
                Ok(found)
            }
        }
        deserializer.deserialize_map(Names)
    }
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Node {
    #[serde(deserialize_with = "whole_list")]
    pub children: Vec<Index>,
    #[serde(default, deserialize_with = "maybe_whole")]
    pub mesh: Option<Index>,
    #[serde(default, deserialize_with = "maybe_whole")]
    pub skin: Option<Index>,
    /// In column-major order.
    pub matrix: Option<Box<[f64; 16]>>,
    pub translation: Option<[f64; 3]>,
    /// A quaternion, its real part last.
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    pub weights: Option<Vec<f32>>,
    pub extensions: NodeExtensions,
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct NodeExtensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    pub instancing: Option<Box<Instancing>>,
    #[serde(rename = "KHR_node_visibility")]
    pub visibility: Option<Visibility>,
}

#[derive(Deserialize)]
pub(super) struct Instancing {
    #[serde(default)]
    pub attributes: InstanceAttributes,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "SCREAMING_SNAKE_CASE", default)]
pub(super) struct InstanceAttributes {
    #[serde(default, deserialize_with = "maybe_whole")]
    pub translation: Option<Index>,
    #[serde(default, deserialize_with = "maybe_whole")]
    pub rotation: Option<Index>,
    #[serde(default, deserialize_with = "maybe_whole")]
    pub scale: Option<Index>,
}

impl InstanceAttributes {
    pub(super) fn all(&self) -> impl Iterator<Item = (&'static str, Index)> {
        let all = [("TRANSLATION", self.translation), ("ROTATION", self.rotation), ("SCALE", self.scale)];
        all.into_iter().filter_map(|(name, index)| Some((name, index?)))
    }
}

#[derive(Deserialize)]
pub(super) struct Visibility {
    #[serde(default = "Visibility::shown")]
    pub visible: bool,
}

impl Visibility {
    const fn shown() -> bool {
        true
    }
}

#[derive(Default, Deserialize)]
#[serde(default)]
pub(super) struct Scene {
    #[serde(deserialize_with = "whole_list")]
    pub nodes: Vec<Index>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Skin {
    #[serde(deserialize_with = "whole_list")]
    pub joints: Vec<Index>,
    #[serde(default, deserialize_with = "maybe_whole")]
    pub inverse_bind_matrices: Option<Index>,
}

/// An integer that may be written with a fraction of zero, as some programs do: `3.0`.
struct IntegerLike<T>(T);

impl<'de, T: TryFrom<u64>> Deserialize<'de> for IntegerLike<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Number<T>(PhantomData<T>);
        impl<T: TryFrom<u64>> Visitor<'_> for Number<T> {
            type Value = IntegerLike<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a whole number from 0 on")
            }

            fn visit_u64<E: Error>(self, n: u64) -> Result<IntegerLike<T>, E> {
                T::try_from(n).map(IntegerLike).map_err(|_| E::invalid_value(Unexpected::Unsigned(n), &self))
            }

            fn visit_f64<E: Error>(self, x: f64) -> Result<IntegerLike<T>, E> {
                // Above this, floats cannot represent every integer.
                const MOST: f64 = (1u64 << 53) as f64;
                if x.fract() == 0.0 && (0.0..=MOST).contains(&x) {
                    return self.visit_u64(x as u64);
                }
                Err(E::invalid_value(Unexpected::Float(x), &self))
            }
        }
        deserializer.deserialize_u64(Number(PhantomData))
    }
}

fn whole<'de, D: Deserializer<'de>, T: TryFrom<u64>>(deserializer: D) -> Result<T, D::Error> {
    IntegerLike::deserialize(deserializer).map(|whole| whole.0)
}

fn maybe_whole<'de, D: Deserializer<'de>, T: TryFrom<u64>>(deserializer: D) -> Result<Option<T>, D::Error> {
    Ok(Option::<IntegerLike<T>>::deserialize(deserializer)?.map(|whole| whole.0))
}

fn whole_list<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Index>, D::Error> {
    struct List;
    impl<'de> Visitor<'de> for List {
        type Value = Vec<Index>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a list of whole numbers")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<Index>, A::Error> {
            let mut all = Vec::new();
            while let Some(IntegerLike(index)) = list.next_element()? {
                all.push(index);
            }
            Ok(all)
        }
    }
    deserializer.deserialize_seq(List)
}
