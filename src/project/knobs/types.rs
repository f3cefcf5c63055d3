//! A knob, and the values it takes.

use crate::diag::{SourceId, Span};
use std::collections::BTreeMap;

/// The type of a knob. In GLSL a `color3` is a `vec3`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum KnobType {
    Bool,
    Int,
    Float,
    Vec2,
    Vec3,
    Vec4,
    Color3,
}

impl KnobType {
    pub const ALL: [KnobType; 7] = [
        KnobType::Bool,
        KnobType::Int,
        KnobType::Float,
        KnobType::Vec2,
        KnobType::Vec3,
        KnobType::Vec4,
        KnobType::Color3,
    ];

    /// As an `#iUniform` line spells it.
    pub fn name(self) -> &'static str {
        match self {
            KnobType::Color3 => "color3",
            other => other.glsl_name(),
        }
    }

    /// As GLSL spells it.
    pub fn glsl_name(self) -> &'static str {
        match self {
            KnobType::Bool => "bool",
            KnobType::Int => "int",
            KnobType::Float => "float",
            KnobType::Vec2 => "vec2",
            KnobType::Vec3 | KnobType::Color3 => "vec3",
            KnobType::Vec4 => "vec4",
        }
    }

    /// Numbers in a value of it.
    pub fn components(self) -> usize {
        match self {
            KnobType::Bool | KnobType::Int | KnobType::Float => 1,
            KnobType::Vec2 => 2,
            KnobType::Vec3 | KnobType::Color3 => 3,
            KnobType::Vec4 => 4,
        }
    }
}

/// A value, in the form it is saved in.
#[derive(Clone, Debug, PartialEq)]
pub enum KnobValue {
    Bool(bool),
    Int(i32),
    Float(f64),
    /// Two to four numbers.
    Vector(Vec<f64>),
    /// A value that no knob takes but a `uniform` that a text declares: longer lists of numbers, truth values, lists of
    /// lists.
    List(Vec<KnobValue>),
}

/// Values by the name of their knob.
pub type KnobValues = BTreeMap<String, KnobValue>;

impl KnobValue {
    /// A value of a type from its components, as many as the type has; a bool is true from 0.5 on.
    pub fn new(ty: KnobType, components: &[f64]) -> KnobValue {
        match ty {
            KnobType::Bool => KnobValue::Bool(components[0] >= 0.5),
            KnobType::Int => KnobValue::Int(components[0].round() as i32),
            KnobType::Float => KnobValue::Float(components[0]),
            _ => KnobValue::Vector(components[..ty.components()].to_vec()),
        }
    }

    /// Its numbers; a bool is 0 or 1.
    pub fn components(&self) -> Vec<f64> {
        match self {
            KnobValue::Bool(on) => vec![f64::from(u8::from(*on))],
            KnobValue::Int(n) => vec![f64::from(*n)],
            KnobValue::Float(x) => vec![*x],
            KnobValue::Vector(all) => all.clone(),
            KnobValue::List(all) => all.iter().flat_map(KnobValue::components).collect(),
        }
    }

    /// As GLSL writes a constant of type `ty`, which the value must be of.
    pub fn glsl(&self, ty: KnobType) -> String {
        let float = |x: &f64| format!("{:?}", *x as f32);
        match self {
            KnobValue::Bool(on) => on.to_string(),
            KnobValue::Int(n) => n.to_string(),
            KnobValue::Float(x) => float(x),
            KnobValue::Vector(_) | KnobValue::List(_) => {
                let all: Vec<String> = self.components().iter().map(float).collect();
                format!("{}({})", ty.glsl_name(), all.join(", "))
            }
        }
    }
}

/// The least and the greatest value, both included, of each component; beyond the type's components the numbers mean
/// nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnobRange {
    pub min: [f64; 4],
    pub max: [f64; 4],
}

/// A uniform that a text declares.
#[derive(Clone, Debug, PartialEq)]
pub struct Knob {
    pub name: String,
    pub ty: KnobType,
    pub default: KnobValue,
    /// `None`: any number. A `color3` that says nothing has 0 to 1.
    pub range: Option<KnobRange>,
    /// The step of a slider, where the author gives one.
    pub step: Option<[f64; 4]>,
    /// The name, where it is first declared.
    pub span: Span,
    /// The texts that declare it.
    pub declared_in: Vec<SourceId>,
}

impl Knob {
    /// The value in the form this knob's type has. Err: why it does not fit, a sentence that follows the name.
    pub fn fit(&self, value: &KnobValue) -> Result<KnobValue, String> {
        let value = self.shaped(value)?;
        if self.clamped(&value) == value {
            return Ok(value);
        }
        let range = self.range.map_or(String::new(), |r| format!("{:?} to {:?}", r.min[0], r.max[0]));
        let same = |all: &[f64; 4]| all[..self.ty.components()].iter().all(|x| *x == all[0]);
        Err(match self.range {
            Some(r) if same(&r.min) && same(&r.max) => format!("lies outside of its range, {range}"),
            _ => "lies outside of its range".to_owned(),
        })
    }

    /// Returns what the knob stands at: its value where one is set that has the right shape, within the range; else the
    /// default.
    pub fn value(&self, values: &KnobValues) -> KnobValue {
        let set = values.get(&self.name).and_then(|v| self.shaped(v).ok());
        set.map_or_else(|| self.default.clone(), |v| self.clamped(&v))
    }

    fn shaped(&self, value: &KnobValue) -> Result<KnobValue, String> {
        let n = self.ty.components();
        let finite = |x: f64| (x as f32).is_finite();
        let shaped = match (self.ty, value) {
            (KnobType::Bool, KnobValue::Bool(_)) | (KnobType::Int, KnobValue::Int(_)) => Some(value.clone()),
            (KnobType::Int, KnobValue::Float(x)) if x.fract() == 0.0 && x.abs() < 2f64.powi(31) => {
                Some(KnobValue::Int(*x as i32))
            }
            (KnobType::Float, KnobValue::Int(n)) => Some(KnobValue::Float(f64::from(*n))),
            (KnobType::Float, KnobValue::Float(x)) => finite(*x).then(|| value.clone()),
            (_, KnobValue::Vector(all)) if n > 1 && all.len() == n => {
                all.iter().all(|x| finite(*x)).then(|| value.clone())
            }
            _ => None,
        };
        shaped.ok_or_else(|| {
            let wants = match self.ty {
                KnobType::Bool => "true or false".to_owned(),
                KnobType::Int => "a whole number".to_owned(),
                KnobType::Float => "a number".to_owned(),
                _ => format!("{n} numbers"),
            };
            format!("is a {} and takes {wants}", self.ty.name())
        })
    }

    pub(super) fn clamped(&self, value: &KnobValue) -> KnobValue {
        let Some(range) = self.range else { return value.clone() };
        if self.ty == KnobType::Bool {
            return value.clone();
        }
        let mut all = value.components();
        for (i, x) in all.iter_mut().enumerate() {
            *x = x.clamp(range.min[i], range.max[i]);
        }
        KnobValue::new(self.ty, &all)
    }
}
