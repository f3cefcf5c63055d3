//! The structure of Shadertoy's JSON, as far as Eddy reads it.
//!
//! A file may be a stranger's. Unknown members are skipped without allocating, every list has a limit, and the members
//! of a shader besides its passes are kept as text until their length is known.

use crate::limits;
use serde::{
    Deserialize, Deserializer,
    de::{Error, IgnoredAny, MapAccess, SeqAccess, Visitor},
};
use serde_json::value::RawValue;
use std::{borrow::Cow, fmt, marker::PhantomData};

/// The limit for a pass's inputs, and for its outputs; Shadertoy has four inputs and one output.
const INPUTS: usize = 64;
/// The limit for passes, including Common.
const PASSES: usize = limits::PASSES + 1;
/// The limit for shaders in a list from which one can be selected.
const SHADERS: usize = 100_000;

/// Deserializes an object member by member. As with `JSON.parse`, the last of several members with the same name wins;
/// `null` counts as absent.
macro_rules! object {
    ($(#[$doc:meta])* $name:ident $(<$life:lifetime>)? { $($field:ident: $ty:ty = $key:literal,)* }) => {
        $(#[$doc])*
        #[derive(Default)]
        pub(super) struct $name $(<$life>)? {
            $(pub(super) $field: Option<$ty>,)*
        }

        impl<'de $(: $life, $life)?> Deserialize<'de> for $name $(<$life>)? {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Members $(<$life>(PhantomData<&$life ()>))?;
                impl<'de $(: $life, $life)?> Visitor<'de> for Members $(<$life>)? {
                    type Value = $name $(<$life>)?;

                    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                        f.write_str("an object")
                    }

                    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                        let mut read = $name::default();
                        while let Some(key) = map.next_key::<Cow<'_, str>>()? {
                            match &*key {
                                $($key => read.$field = map.next_value()?,)*
                                _ => {
                                    map.next_value::<IgnoredAny>()?;
                                }
                            }
                        }
                        Ok(read)
                    }
                }
                deserializer.deserialize_map(object!(@members $($life)?))
            }
        }
    };
    (@members) => { Members };
    (@members $life:lifetime) => { Members(PhantomData) };
}

object! {
    Shader<'t> {
        ver: Scalar = "ver",
        info: &'t RawValue = "info",
        renderpass: BoundedList<RenderPass, PASSES> = "renderpass",
    }
}

object! {
    RenderPass {
        inputs: BoundedList<RenderInput, INPUTS> = "inputs",
        outputs: BoundedList<Output, INPUTS> = "outputs",
        code: String = "code",
        name: Scalar = "name",
        r#type: String = "type",
    }
}

object! {
    RenderInput {
        id: Scalar = "id",
        filepath: String = "filepath",
        src: String = "src",
        r#type: String = "type",
        ctype: String = "ctype",
        channel: Scalar = "channel",
        sampler: RenderSampler = "sampler",
    }
}

object! {
    Output {
        id: Scalar = "id",
    }
}

object! {
    RenderSampler {
        filter: String = "filter",
        wrap: String = "wrap",
        vflip: Scalar = "vflip",
    }
}

object! {
    /// The members that identify one of several shaders.
    Head {
        info: HeadInfo = "info",
    }
}

object! {
    HeadInfo {
        id: Scalar = "id",
        name: Scalar = "name",
    }
}

/// Ids, numbers and booleans are strings in Shadertoy's files and bare values in others.
pub(super) enum Scalar {
    Text(String),
    Number(serde_json::Number),
    Bool(bool),
}

impl<'de> Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Any;
        impl Visitor<'_> for Any {
            type Value = Scalar;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a text or a number")
            }
            fn visit_str<E: Error>(self, text: &str) -> Result<Scalar, E> {
                Ok(Scalar::Text(text.to_owned()))
            }
            fn visit_bool<E: Error>(self, on: bool) -> Result<Scalar, E> {
                Ok(Scalar::Bool(on))
            }
            fn visit_i64<E: Error>(self, n: i64) -> Result<Scalar, E> {
                Ok(Scalar::Number(n.into()))
            }
            fn visit_u64<E: Error>(self, n: u64) -> Result<Scalar, E> {
                Ok(Scalar::Number(n.into()))
            }
            fn visit_f64<E: Error>(self, x: f64) -> Result<Scalar, E> {
                Ok(serde_json::Number::from_f64(x).map_or(Scalar::Text(x.to_string()), Scalar::Number))
            }
        }
        deserializer.deserialize_any(Any)
    }
}

impl Scalar {
    pub(super) fn text(&self) -> String {
        match self {
            Scalar::Text(t) => t.clone(),
            Scalar::Number(n) => n.to_string(),
            Scalar::Bool(b) => b.to_string(),
        }
    }
}

/// A list of at most `MAX` entries.
pub(super) struct BoundedList<T, const MAX: usize>(pub Vec<T>);

impl<'de, T: Deserialize<'de>, const MAX: usize> Deserialize<'de> for BoundedList<T, MAX> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct List<T, const MAX: usize>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>, const MAX: usize> Visitor<'de> for List<T, MAX> {
            type Value = Vec<T>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Vec<T>, A::Error> {
                let mut all = Vec::new();
                while let Some(one) = seq.next_element()? {
                    if all.len() == MAX {
                        return Err(A::Error::custom(format_args!("this list has more than {MAX} entries, the limit")));
                    }
                    all.push(one);
                }
                Ok(all)
            }
        }
        deserializer.deserialize_seq(List::<T, MAX>(PhantomData)).map(BoundedList)
    }
}

/// The content of a file before it is known whether it is a shader.
pub(super) enum RootContent<'t> {
    Object(Object<'t>),
    List(Shaders<'t>),
    Bare,
}

/// The first [`SHADERS`] entries of a list, and the number of all entries.
#[derive(Default)]
pub(super) struct Shaders<'t> {
    pub first: Vec<&'t RawValue>,
    pub count: usize,
}

impl<'t> Shaders<'t> {
    fn read<A: SeqAccess<'t>>(mut seq: A) -> Result<Self, A::Error> {
        let mut all = Shaders::default();
        while all.first.len() < SHADERS {
            let Some(one) = seq.next_element::<&RawValue>()? else { break };
            all.first.push(one);
        }
        all.count = all.first.len();
        while seq.next_element::<IgnoredAny>()?.is_some() {
            all.count += 1;
        }
        Ok(all)
    }
}

impl<'t> Deserialize<'t> for Shaders<'t> {
    fn deserialize<D: Deserializer<'t>>(deserializer: D) -> Result<Self, D::Error> {
        struct List;
        impl<'t> Visitor<'t> for List {
            type Value = Shaders<'t>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list of shaders")
            }
            fn visit_seq<A: SeqAccess<'t>>(self, seq: A) -> Result<Shaders<'t>, A::Error> {
                Shaders::read(seq)
            }
        }
        deserializer.deserialize_seq(List)
    }
}

/// The members that distinguish the formats.
#[derive(Default)]
pub(super) struct Object<'t> {
    pub renderpass: bool,
    pub shader: Option<&'t RawValue>,
    /// The list in the file that a profile's page exports.
    pub shaders: Option<&'t RawValue>,
    pub error: Option<&'t RawValue>,
    /// The names of the first members.
    pub keys: Vec<String>,
}

impl<'t> Deserialize<'t> for RootContent<'t> {
    fn deserialize<D: Deserializer<'t>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Shape)
    }
}

struct Shape;

impl<'t> Visitor<'t> for Shape {
    type Value = RootContent<'t>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a shader")
    }

    fn visit_map<A: MapAccess<'t>>(self, mut map: A) -> Result<RootContent<'t>, A::Error> {
        let mut object = Object::default();
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "Shader" => object.shader = Some(map.next_value()?),
                "shaders" => object.shaders = Some(map.next_value()?),
                "Error" => object.error = Some(map.next_value()?),
                _ => {
                    map.next_value::<IgnoredAny>()?;
                }
            }
            object.renderpass |= key == "renderpass";
            if object.keys.len() < 5 {
                object.keys.push(key);
            }
        }
        Ok(RootContent::Object(object))
    }

    fn visit_seq<A: SeqAccess<'t>>(self, seq: A) -> Result<RootContent<'t>, A::Error> {
        Shaders::read(seq).map(RootContent::List)
    }

    fn visit_bool<E>(self, _: bool) -> Result<RootContent<'t>, E> {
        Ok(RootContent::Bare)
    }

    fn visit_i64<E>(self, _: i64) -> Result<RootContent<'t>, E> {
        Ok(RootContent::Bare)
    }

    fn visit_u64<E>(self, _: u64) -> Result<RootContent<'t>, E> {
        Ok(RootContent::Bare)
    }

    fn visit_f64<E>(self, _: f64) -> Result<RootContent<'t>, E> {
        Ok(RootContent::Bare)
    }

    fn visit_str<E>(self, _: &str) -> Result<RootContent<'t>, E> {
        Ok(RootContent::Bare)
    }

    fn visit_unit<E>(self) -> Result<RootContent<'t>, E> {
        Ok(RootContent::Bare)
    }
}

/// Formats a text of the file for a message: shortened, and on one line.
pub(super) fn shown(text: &str) -> String {
    text.chars().take(80).collect::<String>().escape_debug().to_string()
}
