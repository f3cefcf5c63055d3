//! Checks of a pass: the quantity, the range it must keep, and the texel that is furthest outside of it.

use eddy_engine::Pixels;
use eddy_project::PassName;

/// The largest absolute value of a quantity if no better bound is known, and always if a case is expected to leave its
/// own range.
pub(super) const HARD_LIMIT: f64 = 1e4;

/// A number that is computed from a pass's texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Every component of each texel.
    Any,
    /// The first three components of each texel.
    Colour,
    /// A component of each texel.
    Component(usize),
    /// The length of the vector of two components, of each texel.
    Length(usize, usize),
    /// The mean of a component.
    Mean(usize),
    /// Half of the mean square of two components.
    Energy(usize, usize),
    /// The part of a component's variance that alternates from texel to texel: the mean square of a - 2 b + c over 16,
    /// along x and along y together, divided by twice the variance. 1 for a checkerboard, 0.375 for noise, 0.02 for
    /// waves 8 texels long, below 0.01 for longer ones. 0 if the component hardly varies (see [`FLAT`]).
    Roughness(usize),
}

/// The root mean square deviation below which a field counts as flat, relative to the larger of 1 and the absolute
/// value of its mean.
const FLAT: f64 = 2e-3;

const AXES: [char; 4] = ['x', 'y', 'z', 'w'];

impl Quantity {
    pub fn name(self) -> String {
        match self {
            Quantity::Any => "xyzw".into(),
            Quantity::Colour => "rgb".into(),
            Quantity::Component(c) => AXES[c].to_string(),
            Quantity::Length(a, b) => format!("|{}{}|", AXES[a], AXES[b]),
            Quantity::Mean(c) => format!("mean {}", AXES[c]),
            Quantity::Energy(a, b) => format!("energy {}{}", AXES[a], AXES[b]),
            Quantity::Roughness(c) => format!("roughness {}", AXES[c]),
        }
    }
}

/// The texels of a pass that belong to the quantity. The others contain other data, such as a mouse's memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Area {
    All,
    /// Rows starting with this one.
    FromRow(u32),
    /// All texels except (0, 0).
    ButFirst,
    /// All texels except the last one of the last row.
    ButLast,
    Texel(u32, u32),
    /// A block at (x, y) with this width and height.
    Block(u32, u32, u32, u32),
}

impl Area {
    /// Returns a texel in its middle.
    pub fn middle(self, (width, height): (u32, u32)) -> (u32, u32) {
        match self {
            Area::Texel(x, y) => (x, y),
            Area::Block(x, y, w, h) => (x + w / 2, y + h / 2),
            _ => (width / 2, height / 2),
        }
    }

    fn holds(self, x: u32, y: u32, size: (u32, u32)) -> bool {
        match self {
            Area::All => true,
            Area::FromRow(first) => y >= first,
            Area::ButFirst => (x, y) != (0, 0),
            Area::ButLast => (x + 1, y + 1) != size,
            Area::Texel(a, b) => (x, y) == (a, b),
            Area::Block(a, b, w, h) => (a..a + w).contains(&x) && (b..b + h).contains(&y),
        }
    }
}

/// A range, including both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowed {
    pub low: f64,
    pub high: f64,
    /// The reason why theory expects the range to be left in this situation. All values must still be finite and within
    /// [`HARD_LIMIT`].
    pub excuse: Option<&'static str>,
}

impl Allowed {
    pub fn new(low: f64, high: f64) -> Allowed {
        Allowed { low, high, excuse: None }
    }

    #[must_use]
    pub fn unless(mut self, excused: bool, excuse: &'static str) -> Self {
        if excused && self.excuse.is_none() {
            self.excuse = Some(excuse);
        }
        self
    }
}

/// The conditions of a case on which bounds may depend.
#[derive(Clone, Debug)]
pub struct CaseConditions {
    /// The canvas.
    pub size: (u32, u32),
    /// The longest `iTimeDelta` of the case, in seconds.
    pub longest_step: f64,
    /// The mouse drags at some time of the case.
    pub is_dragged: bool,
    /// The components of each slider's value.
    pub sliders: std::collections::BTreeMap<String, Vec<f64>>,
}

impl CaseConditions {
    /// Returns a slider's value, the largest if there are several components. 0 for a missing slider.
    pub fn slider(&self, name: &str) -> f64 {
        let all = self.sliders.get(name).map_or(&[][..], |v| v);
        all.iter().copied().reduce(f64::max).unwrap_or(0.0)
    }
}

/// A range for a quantity of a pass.
#[derive(Clone, Debug)]
pub struct Check {
    pub pass: PassName,
    pub quantity: Quantity,
    pub area: Area,
    pub allowed: Rule,
    /// The justification of the range.
    pub reason: String,
}

/// A range that may depend on the sliders and the time step.
#[derive(Clone, Copy, Debug)]
pub enum Rule {
    Always(Allowed),
    Of(fn(&CaseConditions) -> Allowed),
}

impl Check {
    pub fn name(&self) -> String {
        format!("{} {}", self.pass.key(), self.quantity.name())
    }

    pub fn allowed(&self, conditions: &CaseConditions) -> Allowed {
        match self.allowed {
            Rule::Always(allowed) => allowed,
            Rule::Of(rule) => rule(conditions),
        }
    }
}

/// The result of a check.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found {
    /// The smallest and the largest value; NaN if one is not a number.
    pub low: f64,
    pub high: f64,
    pub rms: f64,
    /// The value that is furthest outside of the range; NaN before all others.
    pub worst: Option<WorstTexel>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstTexel {
    /// `None` if the quantity belongs to the whole picture.
    pub texel: Option<(u32, u32)>,
    pub value: f64,
    /// The number of values outside of the range.
    pub count: u64,
}

/// Finds values outside of `low..=high`.
pub(super) fn find(quantity: Quantity, area: Area, pixels: &Pixels, low: f64, high: f64) -> Found {
    let mut found = Found { low: f64::INFINITY, high: f64::NEG_INFINITY, rms: 0.0, worst: None };
    let (mut squares, mut count, mut furthest) = (0.0, 0u64, f64::NEG_INFINITY);
    let mut take = |value: f64, texel: Option<(u32, u32)>| {
        count += 1;
        squares += value * value;
        let is_number = value.is_finite();
        if !is_number || found.low.is_nan() {
            (found.low, found.high) = (f64::NAN, f64::NAN);
        } else {
            (found.low, found.high) = (found.low.min(value), found.high.max(value));
        }
        let outside = if is_number { (low - value).max(value - high) } else { f64::INFINITY };
        if outside > 0.0 {
            let before = found.worst.map_or(0, |w| w.count);
            let is_worse = outside > furthest;
            furthest = furthest.max(outside);
            let kept = if is_worse {
                WorstTexel { texel, value, count: 0 }
            } else {
                found.worst.unwrap_or(WorstTexel { texel, value, count: 0 })
            };
            found.worst = Some(WorstTexel { count: before + 1, ..kept });
        }
    };
    match quantity {
        Quantity::Any | Quantity::Colour | Quantity::Component(_) | Quantity::Length(..) => {
            for (texel, at) in texels(area, pixels) {
                let of = |c: usize| f64::from(texel[c]);
                match quantity {
                    Quantity::Any => (0..4).for_each(|c| take(of(c), Some(at))),
                    Quantity::Colour => (0..3).for_each(|c| take(of(c), Some(at))),
                    Quantity::Component(c) => take(of(c), Some(at)),
                    Quantity::Length(a, b) => take(of(a).hypot(of(b)), Some(at)),
                    _ => {}
                }
            }
        }
        Quantity::Mean(c) => take(mean(area, pixels, |t| f64::from(t[c])).unwrap_or(low), None),
        Quantity::Energy(a, b) => {
            let energy = |t: &[f32; 4]| 0.5 * (f64::from(t[a]).powi(2) + f64::from(t[b]).powi(2));
            take(mean(area, pixels, energy).unwrap_or(low), None);
        }
        Quantity::Roughness(c) => take(roughness(area, pixels, c), None),
    }
    found.rms = if count > 0 { (squares / count as f64).sqrt() } else { 0.0 };
    if count == 0 {
        (found.low, found.high) = (0.0, 0.0);
    }
    found
}

fn texels(area: Area, pixels: &Pixels) -> impl Iterator<Item = (&[f32; 4], (u32, u32))> {
    let size = (pixels.width, pixels.height);
    let places = (0..size.1).flat_map(move |y| (0..size.0).map(move |x| (x, y)));
    pixels.texels.iter().zip(places).filter(move |(_, (x, y))| area.holds(*x, *y, size))
}

fn mean(area: Area, pixels: &Pixels, of: impl Fn(&[f32; 4]) -> f64) -> Option<f64> {
    let (sum, count) = texels(area, pixels).fold((0.0, 0u64), |(s, n), (t, _)| (s + of(t), n + 1));
    (count > 0).then(|| sum / count as f64)
}

fn roughness(area: Area, pixels: &Pixels, component: usize) -> f64 {
    let (width, height) = (pixels.width as usize, pixels.height as usize);
    // The position of the memory does not matter to a mean over thousands; only rows outside of the field are excluded.
    let first = if let Area::FromRow(row) = area { row as usize } else { 0 };
    let at = |x: usize, y: usize| f64::from(pixels.texels[y * width + x][component]);
    let Some(middle) = mean(area, pixels, |t| f64::from(t[component])) else { return 0.0 };
    let variance = mean(area, pixels, |t| (f64::from(t[component]) - middle).powi(2)).unwrap_or(0.0);
    if variance.sqrt() < FLAT * middle.abs().max(1.0) || width < 8 || height < first + 8 {
        return if variance.is_finite() { 0.0 } else { f64::NAN };
    }
    let (mut sum, mut count) = (0.0, 0.0);
    for y in first + 1..height - 1 {
        for x in 1..width - 1 {
            let twice = 2.0 * at(x, y);
            sum += (at(x - 1, y) + at(x + 1, y) - twice).powi(2) + (at(x, y - 1) + at(x, y + 1) - twice).powi(2);
            count += 2.0;
        }
    }
    sum / count / 16.0 / variance
}

#[cfg(test)]
mod tests;
