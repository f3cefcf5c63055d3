//! Converts external values for the uniforms a text declares to constants of the declared types.

use super::checker::Checker;
use crate::{
    UntypedValue,
    ast::Ident,
    hir::{ConstId, Scalar, Type, TypeId},
};

impl Checker<'_> {
    /// Returns the value that a uniform of a type is set to. `None` if it has no value; `Some(None)` if its value does
    /// not match the type, which is reported.
    pub(super) fn uniform_value(&mut self, name: Ident, ty: TypeId) -> Option<Option<ConstId>> {
        let values = self.settings.values;
        let text = self.name(name.symbol);
        let found = values.iter().find(|v| v.name == text)?;
        if ty == TypeId::ERROR {
            return Some(None);
        }
        let mut words = Vec::new();
        let fits = self.take(ty, &found.value, &mut words);
        Some(match fits {
            Ok(()) => Some(self.module.constant(ty, &words)),
            Err(why) => {
                let is = self.module.type_text(self.names, ty);
                self.error(name, format!("`{text}` is a `{is}`, but its value in eddy.toml is not: {why}"));
                match self.shape(ty) {
                    Some(shape) => self.hint(format!("under [uniforms], write {text} = {shape}")),
                    None => self.hint(format!("remove {text} from [uniforms]")),
                }
                None
            }
        })
    }

    /// Adds a value's scalars in memory order. Returns an error that describes why the value does not match.
    fn take(&self, ty: TypeId, value: &UntypedValue, words: &mut Vec<u32>) -> Result<(), String> {
        let (parts, count) = match self.module.types.get(ty) {
            Type::Scalar(scalar) => {
                words.push(word(scalar, value)?);
                return Ok(());
            }
            Type::Vector { scalar, .. } => {
                let count = self.module.types.components(ty).unwrap_or_default();
                (TypeId::vector(scalar, 1), count)
            }
            Type::Matrix { columns, rows } => (TypeId::vector(Scalar::Float, rows), u32::from(columns)),
            Type::Array { element, len } => (element, len),
            Type::Struct(_) | Type::Sampler { .. } | Type::Void | Type::Error => {
                return Err("only numbers, vectors, matrices and arrays of them can be set".to_owned());
            }
        };
        let UntypedValue::List(all) = value else {
            return Err(format!("found {}, expected {count} in brackets", shown(value)));
        };
        if all.len() != count as usize {
            return Err(format!("{} in brackets, not {count}", all.len()));
        }
        for (n, one) in all.iter().enumerate() {
            self.take(parts, one, words).map_err(|why| format!("[{n}] {why}").replace("] [", "]["))?;
        }
        Ok(())
    }

    /// Formats a value of a type as in eddy.toml, with long lists shortened.
    fn shape(&self, ty: TypeId) -> Option<String> {
        let list = |part: Option<String>, count: u32| {
            let part = part?;
            let shown = vec![part; count.min(4) as usize].join(", ");
            Some(if count > 4 { format!("[{shown}, ...], {count} in all") } else { format!("[{shown}]") })
        };
        match self.module.types.get(ty) {
            Type::Scalar(scalar) => Some(example(scalar).to_owned()),
            Type::Vector { scalar, .. } => list(Some(example(scalar).to_owned()), self.module.types.components(ty)?),
            Type::Matrix { columns, rows } => list(self.shape(TypeId::vector(Scalar::Float, rows)), u32::from(columns)),
            Type::Array { element, len } => list(self.shape(element), len),
            Type::Struct(_) | Type::Sampler { .. } | Type::Void | Type::Error => None,
        }
    }
}

fn example(scalar: Scalar) -> &'static str {
    match scalar {
        Scalar::Bool => "true",
        Scalar::Int | Scalar::Uint => "1",
        Scalar::Float => "1.0",
    }
}

fn shown(value: &UntypedValue) -> String {
    match value {
        UntypedValue::Bool(on) => on.to_string(),
        UntypedValue::Number(x) => x.to_string(),
        UntypedValue::List(all) => format!("a list of {}", all.len()),
    }
}

fn word(scalar: Scalar, value: &UntypedValue) -> Result<u32, String> {
    let is_whole = |x: f64, low: f64, high: f64| x.fract() == 0.0 && (low..=high).contains(&x);
    match (scalar, value) {
        (Scalar::Bool, UntypedValue::Bool(on)) => Ok(u32::from(*on)),
        (Scalar::Float, UntypedValue::Number(x)) if (*x as f32).is_finite() => Ok((*x as f32).to_bits()),
        (Scalar::Int, UntypedValue::Number(x)) if is_whole(*x, i32::MIN.into(), i32::MAX.into()) => {
            Ok(*x as i32 as u32)
        }
        (Scalar::Uint, UntypedValue::Number(x)) if is_whole(*x, 0.0, u32::MAX.into()) => Ok(*x as u32),
        _ => {
            let wants = match scalar {
                Scalar::Bool => "true or false",
                Scalar::Int => "a whole number of 32 bits",
                Scalar::Uint => "a whole number of 32 bits from 0",
                Scalar::Float => "a number in the range of a float",
            };
            Err(format!("{} is not {wants}", shown(value)))
        }
    }
}
