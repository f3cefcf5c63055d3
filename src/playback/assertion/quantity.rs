//! A number that is computed from a pass's texels, or numbers of each texel.

use super::{
    reader::{Reader, check_length},
    region::Region,
};
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
    /// Half of the mean, over texels, of the sum of the squares.
    Energy,
    /// The part of a component's variance that alternates from texel to texel: the mean square of a - 2 b + c over 16,
    /// along x and along y together, divided by twice the variance. 1 for a checkerboard, 0.375 for noise, 0.02 for
    /// waves 8 texels long, below 0.01 for longer ones. 0 if the component hardly varies: by less than 0.002 of the
    /// larger of 1 and the absolute value of its mean, as a root mean square; and on fewer than 8 rows or columns.
    Roughness,
}

impl Reduction {
    const NAMES: [(&str, Reduction); 8] = [
        ("sum", Self::Sum),
        ("min", Self::Min),
        ("max", Self::Max),
        ("mean", Self::Mean),
        ("rms", Self::Rms),
        ("nonfinite", Self::Nonfinite),
        ("energy", Self::Energy),
        ("roughness", Self::Roughness),
    ];

    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, reduction)| *reduction == self).map_or("", |(name, _)| name)
    }
}

/// A number that is computed from a pass's texels, or numbers of each texel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quantity {
    /// `None`: the numbers of each texel.
    pub reduction: Option<Reduction>,
    pub pass: PassName,
    /// The index among the pass's targets.
    pub target: usize,
    /// The indices of the components, 0 to 3 in ascending order; none for all that the pass stores.
    pub components: Vec<usize>,
    /// The number of a texel is the length of the vector of the components, and not each of them.
    pub is_length: bool,
    pub region: Region,
}

impl Quantity {
    /// Returns the four components of each texel of a pass. Those that it does not store are 0, and 1 for the last.
    pub fn each(pass: PassName) -> Quantity {
        let components = vec![0, 1, 2, 3];
        Quantity { reduction: None, pass, target: 0, components, is_length: false, region: Region::All }
    }

    /// Parses a quantity that is one number: `sum(buffer_a.x)`, `max(image)` or `mean(scene:1.w) from row 1`. Returns an
    /// error message if it is malformed.
    pub fn parse(text: &str) -> Result<Self, String> {
        check_length(text)?;
        let mut reader = Reader::new(text);
        let quantity = Self::read(&mut reader, &PassName::parse)?;
        reader.end()?;
        match quantity.reduction {
            Some(_) => Ok(quantity),
            None => Err(format!("{quantity} has numbers for each texel: write for example max({})", quantity.values())),
        }
    }

    /// Reads a quantity. `pass` finds a pass by its name.
    pub(super) fn read(reader: &mut Reader<'_>, pass: &dyn Fn(&str) -> Option<PassName>) -> Result<Self, String> {
        let word = reader.take(|c| c.is_ascii_alphanumeric() || c == '_');
        let reduction = Reduction::NAMES.iter().find(|(name, _)| name.eq_ignore_ascii_case(word)).map(|(_, one)| *one);
        if reduction.is_some() {
            reader.want("(", "after the reduction")?;
        }
        let is_call = reduction.is_some() || reader.has("(");
        let is_length = if reduction.is_some() { reader.has("length (") } else { is_call && word == "length" };
        if reduction.is_none() && (word.is_empty() || is_call && !is_length) {
            let known = project::listed(&Reduction::NAMES.map(|(name, _)| name));
            return Err(format!("a quantity starts with {known}, as in sum(buffer_a.x), not `{word}`"));
        }
        let name = if is_call { reader.take(|c| !matches!(c, '.' | ':' | ')')).trim() } else { word };
        let pass = pass(name).ok_or_else(|| format!("`{name}` is not the name of a pass"))?;
        let mut target = 0;
        if reader.has(":") {
            let number = reader.take(|c| c.is_ascii_digit());
            target = number.parse().map_err(|_| format!("a target is a number from 0 on, not `{number}`"))?;
        }
        let components = if reader.has(".") { components(reader.take(char::is_alphabetic))? } else { Vec::new() };
        for _ in 0..usize::from(reduction.is_some()) + usize::from(is_length) {
            reader.want(")", "after the pass")?;
        }
        let quantity = Quantity { reduction, pass, target, components, is_length, region: Region::read(reader)? };
        if reduction == Some(Reduction::Roughness) {
            quantity.check_roughness()?;
        }
        Ok(quantity)
    }

    fn check_roughness(&self) -> Result<(), String> {
        if self.is_length || self.components.len() != 1 {
            let pass = self.pass.key();
            return Err(format!("roughness is of one component: write for example roughness({pass}.x)"));
        }
        match self.region {
            Region::All | Region::FromRow(_) => Ok(()),
            region => {
                Err(format!("roughness is of whole rows: write `from row N`, or nothing, in place of `{region}`"))
            }
        }
    }

    /// Returns the letters of the components: "rgb" for the first three, else from "xyzw"; empty for all that the pass
    /// stores.
    pub fn letters(&self) -> String {
        match self.components.as_slice() {
            [0, 1, 2] => "rgb".to_owned(),
            some => some.iter().map(|index| ["x", "y", "z", "w"][*index]).collect(),
        }
    }

    /// Returns the part in the parentheses of a reduction.
    pub(super) fn values(&self) -> String {
        let target = if self.target > 0 { format!(":{}", self.target) } else { String::new() };
        let letters = self.letters();
        let values = format!("{}{target}{}{letters}", self.pass.key(), if letters.is_empty() { "" } else { "." });
        if self.is_length { format!("length({values})") } else { values }
    }
}

/// Parses `x`, `xy` or `rgb`: different letters of one set.
fn components(letters: &str) -> Result<Vec<usize>, String> {
    let of = |set: &str| letters.chars().map(|c| set.find(c)).collect::<Option<Vec<usize>>>();
    let mut all = of("xyzw").or_else(|| of("rgba")).unwrap_or_default();
    all.sort_unstable();
    all.dedup();
    if !all.is_empty() && all.len() == letters.len() {
        return Ok(all);
    }
    Err(format!("a component is x, y, z or w (r, g, b or a), and several are different ones, not `{letters}`"))
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.reduction {
            Some(reduction) => write!(f, "{}({}){}", reduction.name(), self.values(), self.region),
            None => write!(f, "{}{}", self.values(), self.region),
        }
    }
}
