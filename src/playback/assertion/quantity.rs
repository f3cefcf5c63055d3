//! A number computed from a pass's texels.

use super::reader::Reader;
use eddy_engine::Pixels;
use eddy_project::{self as project, PassName};
use std::fmt;

/// The function that reduces numbers to one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    Sum,
    Min,
    Max,
    Mean,
    /// Square root of the mean of the squares.
    Rms,
    /// The number of NaN and infinite ones.
    Nonfinite,
}

impl Reduction {
    pub const ALL: [Reduction; 6] = [Self::Sum, Self::Min, Self::Max, Self::Mean, Self::Rms, Self::Nonfinite];

    pub fn name(self) -> &'static str {
        match self {
            Reduction::Sum => "sum",
            Reduction::Min => "min",
            Reduction::Max => "max",
            Reduction::Mean => "mean",
            Reduction::Rms => "rms",
            Reduction::Nonfinite => "nonfinite",
        }
    }

    /// Reduces numbers in double precision. The result is NaN if one of them is NaN, and NaN or 0 if there are none.
    pub fn of(self, values: impl Iterator<Item = f32>) -> f64 {
        let mut count = 0.0;
        let values = values.map(f64::from).inspect(|_| count += 1.0);
        let extreme = |best: fn(f64, f64) -> f64| move |a: f64, b: f64| if a.is_nan() { a } else { best(a, b) };
        let with_nan =
            |best: fn(f64, f64) -> f64| move |a: f64, b: f64| if b.is_nan() { b } else { extreme(best)(a, b) };
        match self {
            Reduction::Sum => values.sum(),
            Reduction::Min => values.reduce(with_nan(f64::min)).unwrap_or(f64::NAN),
            Reduction::Max => values.reduce(with_nan(f64::max)).unwrap_or(f64::NAN),
            Reduction::Nonfinite => values.filter(|x| !x.is_finite()).count() as f64,
            Reduction::Mean => {
                let sum: f64 = values.sum();
                sum / count
            }
            Reduction::Rms => {
                let squares: f64 = values.map(|x| x * x).sum();
                (squares / count).sqrt()
            }
        }
    }
}

/// A reduction of a component of a pass. Only single components can be reduced: `rms(buffer_b.xy)` is written
/// `rms(buffer_b.x)` and `rms(buffer_b.y)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    pub reduction: Reduction,
    pub pass: PassName,
    /// The index among the pass's targets.
    pub target: usize,
    /// 0 to 3; `None` is all components that the pass stores.
    pub component: Option<usize>,
}

impl Quantity {
    /// Parses `sum(buffer_a.x)`, `max(image)` or `mean(scene:1.w)`. Returns an error message if it is malformed.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut reader = Reader::new(text);
        let quantity = Self::read(&mut reader)?;
        reader.end()?;
        Ok(quantity)
    }

    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Self, String> {
        let word = reader.take(|c| c.is_ascii_alphanumeric() || c == '_');
        let Some(reduction) = Reduction::ALL.into_iter().find(|r| r.name().eq_ignore_ascii_case(word)) else {
            let known = Reduction::ALL.map(Reduction::name);
            return Err(format!(
                "a quantity starts with {}, as in sum(buffer_a.x), not `{word}`",
                project::listed(&known)
            ));
        };
        reader.want("(", "after the reduction")?;
        let name = reader.take(|c| !matches!(c, '.' | ':' | ')'));
        let pass =
            PassName::parse(name.trim()).ok_or_else(|| format!("`{}` is not the name of a pass", name.trim()))?;
        let mut target = 0;
        if reader.has(":") {
            let number = reader.take(|c| c.is_ascii_digit());
            target = number.parse().map_err(|_| format!("a target is a number from 0 on, not `{number}`"))?;
        }
        let mut component = None;
        if reader.has(".") {
            let letters = reader.take(char::is_alphabetic);
            component = match letters {
                "x" | "r" => Some(0),
                "y" | "g" => Some(1),
                "z" | "b" => Some(2),
                "w" | "a" => Some(3),
                _ => return Err(format!("a component is x, y, z or w (r, g, b or a), not `{letters}`")),
            };
        }
        reader.want(")", "after the pass")?;
        Ok(Quantity { reduction, pass, target, component })
    }

    /// Computes the number. `stored` is the number of components that the pass stores, from the first on.
    pub fn of(&self, pixels: &Pixels, stored: usize) -> f64 {
        let components = self.component.map_or(0..stored, |one| one..one + 1);
        self.reduction.of(pixels.texels.iter().flat_map(|texel| texel[components.clone()].iter().copied()))
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}({}", self.reduction.name(), self.pass.key())?;
        if self.target > 0 {
            write!(f, ":{}", self.target)?;
        }
        match self.component {
            Some(component) => write!(f, ".{})", ["x", "y", "z", "w"][component]),
            None => write!(f, ")"),
        }
    }
}
