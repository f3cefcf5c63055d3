//! A custom uniform, and the values it takes.

use eddy_diag::{SourceId, Span};
use std::collections::BTreeMap;

/// The type of a custom uniform. In GLSL a `color3` is a `vec3`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CustomUniformType {
    Bool,
    Int,
    Float,
    Vec2,
    Vec3,
    Vec4,
    Color3,
}

impl CustomUniformType {
    pub const ALL: [CustomUniformType; 7] = [
        CustomUniformType::Bool,
        CustomUniformType::Int,
        CustomUniformType::Float,
        CustomUniformType::Vec2,
        CustomUniformType::Vec3,
        CustomUniformType::Vec4,
        CustomUniformType::Color3,
    ];

    /// Returns its spelling in `#iUniform` lines.
    pub fn name(self) -> &'static str {
        match self {
            CustomUniformType::Color3 => "color3",
            other => other.glsl_name(),
        }
    }

    /// Returns its GLSL name.
    pub fn glsl_name(self) -> &'static str {
        match self {
            CustomUniformType::Bool => "bool",
            CustomUniformType::Int => "int",
            CustomUniformType::Float => "float",
            CustomUniformType::Vec2 => "vec2",
            CustomUniformType::Vec3 | CustomUniformType::Color3 => "vec3",
            CustomUniformType::Vec4 => "vec4",
        }
    }

    /// Returns the number of components of a value.
    pub fn components(self) -> usize {
        match self {
            CustomUniformType::Bool | CustomUniformType::Int | CustomUniformType::Float => 1,
            CustomUniformType::Vec2 => 2,
            CustomUniformType::Vec3 | CustomUniformType::Color3 => 3,
            CustomUniformType::Vec4 => 4,
        }
    }
}

/// A value, in the form in which it is saved.
#[derive(Clone, Debug, PartialEq)]
pub enum CustomUniformValue {
    Bool(bool),
    Int(i32),
    Float(f64),
    /// Two to four components.
    Vector(Vec<f64>),
    /// A value for a plain `uniform` declaration only, never for a custom uniform: longer lists of numbers, booleans,
    /// lists of lists.
    List(Vec<CustomUniformValue>),
}

/// Values by the names of their custom uniforms.
pub type CustomUniformValues = BTreeMap<String, CustomUniformValue>;

impl CustomUniformValue {
    /// Builds a value of a type from the type's number of components; a bool is true from 0.5 on.
    pub fn new(ty: CustomUniformType, components: &[f64]) -> CustomUniformValue {
        match ty {
            CustomUniformType::Bool => CustomUniformValue::Bool(components[0] >= 0.5),
            CustomUniformType::Int => CustomUniformValue::Int(components[0].round() as i32),
            CustomUniformType::Float => CustomUniformValue::Float(components[0]),
            _ => CustomUniformValue::Vector(components[..ty.components()].to_vec()),
        }
    }

    /// Returns its components; a bool is 0 or 1.
    pub fn components(&self) -> Vec<f64> {
        match self {
            CustomUniformValue::Bool(on) => vec![f64::from(u8::from(*on))],
            CustomUniformValue::Int(n) => vec![f64::from(*n)],
            CustomUniformValue::Float(x) => vec![*x],
            CustomUniformValue::Vector(all) => all.clone(),
            CustomUniformValue::List(all) => all.iter().flat_map(CustomUniformValue::components).collect(),
        }
    }

    /// Returns the value with each number as the shortest decimal that denotes the same 32-bit float: what a shader reads
    /// is the same, and files have 0.84, not 0.8400000000000001 or 0.8399999737739563.
    pub fn shortest(self) -> CustomUniformValue {
        let short = |x: f64| (x as f32).to_string().parse().unwrap_or(x);
        match self {
            CustomUniformValue::Float(x) => CustomUniformValue::Float(short(x)),
            CustomUniformValue::Vector(all) => CustomUniformValue::Vector(all.into_iter().map(short).collect()),
            other => other,
        }
    }

    /// Returns the value as a GLSL constant of its type `ty`.
    pub fn glsl(&self, ty: CustomUniformType) -> String {
        let float = |x: &f64| format!("{:?}", *x as f32);
        match self {
            CustomUniformValue::Bool(on) => on.to_string(),
            CustomUniformValue::Int(n) => n.to_string(),
            CustomUniformValue::Float(x) => float(x),
            CustomUniformValue::Vector(_) | CustomUniformValue::List(_) => {
                let all: Vec<String> = self.components().iter().map(float).collect();
                format!("{}({})", ty.glsl_name(), all.join(", "))
            }
        }
    }
}

/// The inclusive minimum and maximum of each component; entries beyond the type's components are unused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CustomUniformRange {
    pub min: [f64; 4],
    pub max: [f64; 4],
}

/// A uniform that a text declares.
#[derive(Clone, Debug, PartialEq)]
pub struct CustomUniform {
    pub name: String,
    pub ty: CustomUniformType,
    pub default: CustomUniformValue,
    /// `None`: unlimited. A `color3` without a range has 0 to 1.
    pub range: Option<CustomUniformRange>,
    /// The step of a slider, if the author set one.
    pub step: Option<[f64; 4]>,
    /// The author's description: the `//` comment after the first declaration that has one, else empty.
    pub about: String,
    /// The group in which it is shown: that of the `//@group` line before its first declaration, else empty.
    pub group: String,
    /// The name in its first declaration.
    pub span: Span,
    /// The texts that declare it.
    pub declared_in: Vec<SourceId>,
    /// True if these declare it in GLSL; false for `#iUniform` lines.
    pub is_declared: bool,
}

impl CustomUniform {
    /// Converts the value to the form of this custom uniform's type. If it does not fit, returns the reason as a
    /// sentence that follows the name.
    pub fn fit(&self, value: &CustomUniformValue) -> Result<CustomUniformValue, String> {
        let value = self.shaped(value)?;
        if self.clamped(&value) == value {
            return Ok(value);
        }
        let range = self.range.map_or(String::new(), |r| format!("{:?} to {:?}", r.min[0], r.max[0]));
        let same = |all: &[f64; 4]| all[..self.ty.components()].iter().all(|x| *x == all[0]);
        Err(match self.range {
            Some(r) if same(&r.min) && same(&r.max) => format!("is outside its range, {range}"),
            _ => "is outside its range".to_owned(),
        })
    }

    /// Returns the current value: the one that is set, if it has the right shape, clamped to the range; else the
    /// default.
    pub fn value(&self, values: &CustomUniformValues) -> CustomUniformValue {
        let set = values.get(&self.name).and_then(|v| self.shaped(v).ok());
        set.map_or_else(|| self.default.clone(), |v| self.clamped(&v))
    }

    fn shaped(&self, value: &CustomUniformValue) -> Result<CustomUniformValue, String> {
        let n = self.ty.components();
        let finite = |x: f64| (x as f32).is_finite();
        let shaped = match (self.ty, value) {
            (CustomUniformType::Bool, CustomUniformValue::Bool(_))
            | (CustomUniformType::Int, CustomUniformValue::Int(_)) => Some(value.clone()),
            (CustomUniformType::Int, CustomUniformValue::Float(x)) if x.fract() == 0.0 && x.abs() < 2f64.powi(31) => {
                Some(CustomUniformValue::Int(*x as i32))
            }
            (CustomUniformType::Float, CustomUniformValue::Int(n)) => Some(CustomUniformValue::Float(f64::from(*n))),
            (CustomUniformType::Float, CustomUniformValue::Float(x)) => finite(*x).then(|| value.clone()),
            (_, CustomUniformValue::Vector(all)) if n > 1 && all.len() == n => {
                all.iter().all(|x| finite(*x)).then(|| value.clone())
            }
            _ => None,
        };
        shaped.ok_or_else(|| {
            let wants = match self.ty {
                CustomUniformType::Bool => "true or false".to_owned(),
                CustomUniformType::Int => "a whole number".to_owned(),
                CustomUniformType::Float => "a number".to_owned(),
                _ => format!("{n} numbers"),
            };
            format!("is a {} and takes {wants}", self.ty.name())
        })
    }

    pub(super) fn clamped(&self, value: &CustomUniformValue) -> CustomUniformValue {
        let Some(range) = self.range else { return value.clone() };
        if self.ty == CustomUniformType::Bool {
            return value.clone();
        }
        let mut all = value.components();
        for (i, x) in all.iter_mut().enumerate() {
            *x = x.clamp(range.min[i], range.max[i]);
        }
        CustomUniformValue::new(self.ty, &all)
    }
}
