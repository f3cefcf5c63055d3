//! The shapes of the site's JSON, as far as Eddy reads them.
//!
//! A file may be a stranger's. What is not read is passed over without taking memory, every list has a limit, and what
//! a shader says besides its passes is kept as text until its length is known.

use crate::project::limits;
use serde::{
    Deserialize, Deserializer,
    de::{Error, IgnoredAny, MapAccess, SeqAccess, Visitor},
};
use serde_json::value::RawValue;
use std::{fmt, marker::PhantomData};

/// Inputs and outputs that a pass may list; it has four of the one and one of the other.
const INPUTS: usize = 64;
/// Passes and Common.
const PASSES: usize = limits::PASSES + 1;

#[derive(Deserialize)]
pub struct Shader<'t> {
    pub ver: Option<Scalar>,
    #[serde(borrow)]
    pub info: Option<&'t RawValue>,
    pub renderpass: Few<RenderPass, PASSES>,
}

#[derive(Deserialize)]
pub struct RenderPass {
    pub inputs: Option<Few<RenderInput, INPUTS>>,
    pub outputs: Option<Few<Output, INPUTS>>,
    pub code: String,
    #[serde(default)]
    pub name: String,
    pub r#type: String,
}

#[derive(Deserialize)]
pub struct RenderInput {
    pub id: Option<Scalar>,
    pub filepath: Option<String>,
    pub src: Option<String>,
    pub r#type: Option<String>,
    pub ctype: Option<String>,
    pub channel: Scalar,
    pub sampler: Option<RenderSampler>,
}

#[derive(Deserialize)]
pub struct Output {
    pub id: Option<Scalar>,
}

#[derive(Deserialize)]
pub struct RenderSampler {
    pub filter: Option<String>,
    pub wrap: Option<String>,
    pub vflip: Option<Scalar>,
}

/// Ids, numbers and truths come as texts from the site and bare from others.
#[derive(Deserialize)]
#[serde(untagged)]
pub enum Scalar {
    Text(String),
    Number(serde_json::Number),
    Bool(bool),
}

impl Scalar {
    pub fn text(&self) -> String {
        match self {
            Scalar::Text(t) => t.clone(),
            Scalar::Number(n) => n.to_string(),
            Scalar::Bool(b) => b.to_string(),
        }
    }
}

/// A list of at most `MAX` entries.
pub struct Few<T, const MAX: usize>(pub Vec<T>);

impl<'de, T: Deserialize<'de>, const MAX: usize> Deserialize<'de> for Few<T, MAX> {
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
                        return Err(A::Error::custom(format_args!(
                            "this list has more than {MAX} entries, the most that Eddy reads"
                        )));
                    }
                    all.push(one);
                }
                Ok(all)
            }
        }
        deserializer.deserialize_seq(List::<T, MAX>(PhantomData)).map(Few)
    }
}

/// The content of a file before it is known to be a shader.
pub enum Top<'t> {
    Object(Object<'t>),
    /// The first entry, and how many there are.
    List(Option<&'t RawValue>, usize),
    Bare,
}

/// The members by which the shapes are told apart.
#[derive(Default)]
pub struct Object<'t> {
    pub renderpass: bool,
    pub shader: Option<&'t RawValue>,
    pub error: Option<&'t RawValue>,
    /// The first members' names.
    pub keys: Vec<String>,
}

impl<'t> Deserialize<'t> for Top<'t> {
    fn deserialize<D: Deserializer<'t>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Shape)
    }
}

struct Shape;

impl<'t> Visitor<'t> for Shape {
    type Value = Top<'t>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a shader")
    }

    fn visit_map<A: MapAccess<'t>>(self, mut map: A) -> Result<Top<'t>, A::Error> {
        let mut object = Object::default();
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "Shader" => object.shader = Some(map.next_value()?),
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
        Ok(Top::Object(object))
    }

    fn visit_seq<A: SeqAccess<'t>>(self, mut seq: A) -> Result<Top<'t>, A::Error> {
        let first = seq.next_element::<&RawValue>()?;
        let mut count = usize::from(first.is_some());
        while seq.next_element::<IgnoredAny>()?.is_some() {
            count += 1;
        }
        Ok(Top::List(first, count))
    }

    fn visit_bool<E>(self, _: bool) -> Result<Top<'t>, E> {
        Ok(Top::Bare)
    }

    fn visit_i64<E>(self, _: i64) -> Result<Top<'t>, E> {
        Ok(Top::Bare)
    }

    fn visit_u64<E>(self, _: u64) -> Result<Top<'t>, E> {
        Ok(Top::Bare)
    }

    fn visit_f64<E>(self, _: f64) -> Result<Top<'t>, E> {
        Ok(Top::Bare)
    }

    fn visit_str<E>(self, _: &str) -> Result<Top<'t>, E> {
        Ok(Top::Bare)
    }

    fn visit_unit<E>(self) -> Result<Top<'t>, E> {
        Ok(Top::Bare)
    }
}
