//! A knob: a number or setting of a project that changes what a frame costs, and its values.

use crate::{
    savings::Place,
    search::{Ladder, rounded},
};
use eddy_diag::{Edit, Fix, Span};
use eddy_glsl::knobs::NumberType;
use eddy_project::{CustomUniformType, CustomUniformValue, Filter, PassName, PassSize, Project, TexelFormat};

/// The part of a project that a knob changes.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A number in a text of the project.
    Number { span: Span, ty: NumberType },
    /// The value of a custom uniform.
    Uniform,
    /// The size of a buffer, as a part of its present width and height.
    Size(PassName),
    /// The bits of a component of a buffer: 32 or 16.
    Bits(PassName),
    /// A channel reads mip levels of a buffer: 1 or 0.
    Mips(PassName, usize),
    /// The number of times that a group of passes is drawn in a frame.
    Steps(String),
}

impl Target {
    /// Returns whether the shader is compiled again for another value.
    pub fn is_text(&self) -> bool {
        matches!(self, Target::Number { .. })
    }
}

/// The meaning of a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Iterations, samples, steps of a method.
    Count,
    /// The length of a step.
    Step,
    /// A difference at which a loop stops.
    Tolerance,
    /// The reach of a loop.
    Distance,
    /// A setting of the project.
    Setting,
}

/// A number or setting that is tried with other values.
#[derive(Clone, Debug, PartialEq)]
pub struct Knob {
    /// The name for `--knob`, `--fix` and `--range`: unique in the project.
    pub name: String,
    pub target: Target,
    pub kind: Kind,
    pub value: f64,
    /// A larger value costs more.
    pub grows: bool,
    /// The file and line, or the key of `eddy.toml`.
    pub place: String,
    /// The column of a number, counted from 1 in characters.
    pub column: Option<usize>,
    /// The reason why it is a knob: a sentence.
    pub why: String,
    /// The places where it decides how often code runs.
    pub places: Vec<Place>,
    /// The values that are tried, in ascending order.
    pub ladder: Ladder,
    /// The values up to which it may be made more exact than it is; `None`: it stays at most as it is.
    pub finest: Option<f64>,
}

/// The range of a knob as `--range` gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    pub low: f64,
    pub high: f64,
    /// Every such step; `None`: powers of two from the present value.
    pub step: Option<f64>,
}

impl Range {
    /// Parses `A..B` or `A..B:STEP`.
    pub fn parse(text: &str) -> Result<Range, String> {
        let shape = || format!("{text}: write a range as LOW..HIGH or LOW..HIGH:STEP, as in 16..256:16");
        let number = |part: &str| part.trim().parse::<f64>().ok().filter(|n| n.is_finite()).ok_or_else(shape);
        let (low, rest) = text.split_once("..").ok_or_else(shape)?;
        let (high, step) = rest.split_once(':').map_or((rest, None), |(high, step)| (high, Some(step)));
        let range = Range { low: number(low)?, high: number(high)?, step: step.map(number).transpose()? };
        match range {
            Range { low, high, .. } if low > high => {
                Err(format!("{text}: the low end {low} is above the high end {high}"))
            }
            Range { step: Some(step), .. } if step <= 0.0 => Err(format!("{text}: a step must be above 0")),
            range => Ok(range),
        }
    }
}

/// The factor of cheaper values in the automatic range, and of more exact ones.
const CHEAPER: f64 = 8.0;
const FINER: f64 = 4.0;

impl Knob {
    /// Sets the values that are tried by the rule for its kind: down to an eighth of the cost, by powers of two.
    pub(crate) fn set_automatic_range(&mut self) {
        if self.kind == Kind::Setting {
            return;
        }
        let is_integer = self.is_integer();
        // A tolerance has to change more before anything is cheaper.
        let factor: f64 = if self.kind == Kind::Tolerance { 4.0 } else { 2.0 };
        let reach = if self.kind == Kind::Tolerance { 4.0 * CHEAPER } else { CHEAPER };
        let mut values = vec![self.value];
        let mut by = factor;
        while by <= reach {
            let value = if self.grows { self.value / by } else { self.value * by };
            values.push(if is_integer { value.round().max(1.0) } else { rounded(value) });
            by *= factor;
        }
        // Between few samples each count matters.
        if is_integer && self.grows && self.value <= 6.0 {
            values.extend((1..=self.value as i32).map(f64::from));
        }
        self.finest = Some(if self.grows { self.value * FINER } else { self.value / FINER });
        self.set_values(values);
    }

    /// Sets the values of a range that the user gives.
    pub fn set_range(&mut self, range: Range) -> Result<(), String> {
        let is_integer = self.is_integer();
        let mut values = Vec::new();
        match range.step {
            Some(step) => {
                let count = ((range.high - range.low) / step + 1e-9).floor();
                if count > 64.0 {
                    return Err(format!("{}: more than 64 values; give a larger step", self.name));
                }
                values.extend((0..=count as u32).map(|k| range.low + f64::from(k) * step));
            }
            None => {
                values.extend([range.low, range.high]);
                for k in -16..=16 {
                    values.extend(Some(self.value * f64::from(k).exp2()).filter(|v| *v > range.low && *v < range.high));
                }
            }
        }
        let values = values.into_iter().map(|v| if is_integer { v.round() } else { rounded(v) }).collect();
        self.finest = Some(if self.grows { range.high.max(self.value) } else { range.low.min(self.value) });
        self.set_values(values);
        self.ladder.is_continuous = range.step.is_none();
        Ok(())
    }

    /// Adds a value to those that are tried.
    pub(crate) fn add_value(&mut self, value: f64) {
        let mut values = self.ladder.values.clone();
        values.push(value);
        self.set_values(values);
    }

    fn set_values(&mut self, mut values: Vec<f64>) {
        values.sort_by(f64::total_cmp);
        values.dedup();
        self.ladder.values = values;
    }

    pub fn is_integer(&self) -> bool {
        match self.target {
            Target::Number { ty, .. } => {
                ty != NumberType::Float || self.kind == Kind::Count && self.value.fract() == 0.0
            }
            Target::Uniform => self.ladder.is_integer,
            _ => self.ladder.is_integer,
        }
    }

    /// Returns a value as it is shown and written.
    pub fn shown(&self, value: f64) -> String {
        match &self.target {
            Target::Number { ty, .. } => ty.literal(value),
            _ => format!("{value}"),
        }
    }
}

/// Returns a project with these values of its knobs, and the edits of its texts.
pub fn applied(project: &Project, knobs: &[Knob], values: &[f64]) -> (Project, Fix) {
    let changed = || knobs.iter().zip(values).filter(|(knob, value)| knob.value != **value);
    let edits = changed().filter_map(|(knob, value)| match knob.target {
        Target::Number { span, ty } => Some(Edit { span, text: ty.literal(*value) }),
        _ => None,
    });
    let mut edits: Vec<Edit> = edits.collect();
    edits.sort_by_key(|edit| (edit.span.source, edit.span.start));
    let fix = Fix::new("Apply the setting", edits);
    let mut project = project.with_edits(&fix);
    for (knob, value) in changed() {
        set(&mut project, knob, *value);
    }
    (project, fix)
}

fn set(project: &mut Project, knob: &Knob, value: f64) {
    match &knob.target {
        Target::Number { .. } => {}
        Target::Uniform => {
            let declared = project.custom_uniforms();
            if let Some(uniform) = declared.get(&knob.name) {
                let value = match uniform.ty {
                    CustomUniformType::Int => CustomUniformValue::Int(value.round() as i32),
                    _ => CustomUniformValue::Float(value),
                };
                project.turn_custom_uniform(uniform, value);
            }
        }
        Target::Size(pass) => {
            if let Some(pass) = project.pass_mut(pass) {
                let before = if let PassSize::Scale(by) = pass.settings.size { by } else { 1.0 };
                pass.settings.size = PassSize::Scale(before * value);
            }
        }
        Target::Bits(pass) => {
            if let Some(pass) = project.pass_mut(pass)
                && value < 32.0
            {
                pass.settings.format = half(pass.settings.format);
            }
        }
        Target::Mips(pass, slot) => {
            let channel = project.pass_mut(pass).and_then(|pass| pass.bindings.get_mut(*slot));
            if let Some(channel) = channel.filter(|_| value < 1.0) {
                channel.sampler.filter = Filter::Linear;
            }
        }
        Target::Steps(group) => {
            if let Some(group) = project.groups.iter_mut().find(|one| one.name == *group) {
                group.steps = value.round().max(1.0) as u32;
            }
        }
    }
}

/// Returns the format of half the bits.
pub(crate) fn half(format: TexelFormat) -> TexelFormat {
    match format {
        TexelFormat::R32f => TexelFormat::R16f,
        TexelFormat::Rg32f => TexelFormat::Rg16f,
        TexelFormat::Rgba32f => TexelFormat::Rgba16f,
        other => other,
    }
}
