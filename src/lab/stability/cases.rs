//! Lists the test cases of a project, from undisturbed runs to unlikely disturbances.

use super::{
    CheckedProject,
    inputs::{MouseGesture, Steps},
    pairs,
};
use crate::{Extent, stability_record::Kind};
use eddy_project::{CustomUniform, CustomUniformType, CustomUniformValue, CustomUniformValues};
use std::collections::BTreeSet;

/// The seed of the rows of pairs.
const SEED: u64 = 20_240_501;

/// The non-finite value of a broken texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Broken {
    NotANumber,
    Infinite,
}

/// A test case.
#[derive(Clone, Debug, Default)]
pub struct Case {
    pub kind: Kind,
    /// A name that is unique within the project.
    pub name: String,
    pub size: (u32, u32),
    pub frames: u32,
    /// Texels are checked after every this number of frames, and after each frame of a disturbance.
    pub every: u32,
    /// Sliders that are not at their defaults.
    pub values: CustomUniformValues,
    pub hand: MouseGesture,
    pub steps: Steps,
    /// New sizes, each with the frame that it precedes.
    pub resizes: Vec<(u32, (u32, u32))>,
    /// The frame before which a texel of every state is broken, and its new value.
    pub poison: Option<(u32, Broken)>,
    /// The frames of the disturbance, from the first to before the last.
    pub disturbed: Option<(u32, u32)>,
}

impl Case {
    fn new(kind: Kind, name: impl Into<String>, size: (u32, u32), frames: u32, every: u32) -> Case {
        Case { kind, name: name.into(), size, frames, every, ..Case::default() }
    }

    fn disturbed(mut self, from: u32, to: u32) -> Case {
        self.disturbed = Some((from, to));
        self
    }

    /// Returns whether texels are checked after this frame.
    pub fn is_checked(&self, frame: u32) -> bool {
        let is_near = self.disturbed.is_some_and(|(from, to)| (from..to + 2).contains(&frame));
        is_near || (frame + 1).is_multiple_of(self.every) || frame + 1 == self.frames
    }

    /// Returns the sliders as options of the command line.
    pub fn settings(&self) -> String {
        let all: Vec<String> = self.values.iter().map(|(name, value)| format!("{name}={}", written(value))).collect();
        all.join(" ")
    }
}

fn written(value: &CustomUniformValue) -> String {
    let short = |x: &f64| format!("{}", (x * 1e6).round() / 1e6);
    match value {
        CustomUniformValue::Bool(on) => on.to_string(),
        other => other.components().iter().map(short).collect::<Vec<_>>().join(","),
    }
}

/// The length and size of cases.
struct Measure {
    base: (u32, u32),
    untouched: u32,
    /// The frames before a disturbance, and the maximum number of frames to wait for recovery.
    calm: u32,
    recover: u32,
    drag: u32,
    end: u32,
    every: u32,
    courant: &'static [f64],
    sizes: &'static [(u32, u32)],
    size_frames: u32,
    /// The number of sliders that a row of pairs turns.
    most: usize,
    resized: &'static [(u32, u32)],
    large: &'static [((u32, u32), u32)],
    long: Option<((u32, u32), u32)>,
}

const QUICK: Measure = Measure {
    base: (160, 90),
    untouched: 60,
    calm: 6,
    recover: 12,
    drag: 10,
    end: 14,
    every: 7,
    courant: &[4.0],
    sizes: &[(1, 1), (1, 33), (57, 33)],
    size_frames: 8,
    most: usize::MAX,
    resized: &[(83, 47), (1, 1)],
    large: &[],
    long: None,
};

const FULL: Measure = Measure {
    base: (640, 360),
    untouched: 2000,
    calm: 60,
    recover: 240,
    drag: 90,
    end: 240,
    every: 10,
    courant: &[0.5, 1.0, 2.0, 4.0],
    sizes: &[(1, 1), (1, 2), (2, 1), (3, 3), (17, 31), (333, 187), (641, 359), (1, 4096), (4096, 1)],
    size_frames: 120,
    most: 4,
    resized: &[(333, 187), (1280, 720), (1, 1)],
    large: &[((1280, 720), 300), ((1920, 1080), 120)],
    long: Some(((48, 27), 100_000)),
};

/// Returns the canvas of the cases that are not about sizes.
pub fn base(extent: Extent) -> (u32, u32) {
    if extent == Extent::Quick { QUICK.base } else { FULL.base }
}

/// Returns all cases for a project on a canvas of this size, in the order of their execution. A project without a state
/// has neither recovery nor drift: it is drawn for fewer frames, and cases that disturb a state are omitted.
pub fn list(subject: &CheckedProject, extent: Extent, base: (u32, u32)) -> Vec<Case> {
    let mut m = Measure { base, ..if extent == Extent::Quick { QUICK } else { FULL } };
    let has_state = !subject.stateful().is_empty();
    if !has_state {
        (m.untouched, m.end, m.recover, m.long) = (m.end, m.end.min(3 * m.every), m.every, None);
    }
    let m = &m;
    let mut cases = vec![Case::new(Kind::Untouched, "left alone", m.base, m.untouched, m.every)];
    let sliders = subject.sliders();
    courant(subject, &sliders, m, &mut cases);
    let turned = |kind, values: CustomUniformValues, frames| {
        let case = Case { values, ..Case::new(kind, "", m.base, frames, m.every) };
        Case { name: case.settings(), ..case }
    };
    for slider in &sliders {
        for is_high in [false, true] {
            cases.push(turned(Kind::End, [(slider.name.clone(), end(slider, is_high))].into(), m.end));
        }
        for value in between(slider) {
            cases.push(turned(Kind::Inner, [(slider.name.clone(), value)].into(), m.end));
        }
    }
    drags(m, &mut cases);
    if has_state {
        disturbances(m, &mut cases);
    }
    for &size in m.sizes {
        let name = format!("{}x{}, dragged", size.0, size.1);
        let (from, to) = (m.size_frames / 4, m.size_frames / 2);
        let case = Case::new(Kind::Size, name, size, m.size_frames, m.every).disturbed(from, to);
        cases.push(Case { hand: MouseGesture::Across, ..case });
    }
    for row in pairs::rows(sliders.len(), m.most, SEED).into_iter().filter(|row| row.len() > 1) {
        let values = row.iter().map(|(n, is_high)| (sliders[*n].name.clone(), end(&sliders[*n], *is_high))).collect();
        cases.push(turned(Kind::Pairs, values, m.end / 2));
    }
    for extra in &subject.extras {
        let value = |(name, value): &(&str, f64)| {
            let slider = sliders.iter().find(|slider| slider.name == *name)?;
            Some((slider.name.clone(), CustomUniformValue::new(slider.ty, &[*value])))
        };
        let case = turned(extra.kind, extra.values.iter().filter_map(value).collect(), m.end / 2);
        match extra.large {
            None => cases.push(case),
            Some((size, frames)) if extent == Extent::Full => {
                let name = format!("{} on {}x{}", case.name, size.0, size.1);
                cases.push(Case { name, size, frames, ..case });
            }
            Some(_) => {}
        }
    }
    for &(size, frames) in m.large {
        cases.push(Case::new(Kind::Large, format!("{}x{}", size.0, size.1), size, frames, m.every));
    }
    if let Some((size, frames)) = m.long {
        cases.push(Case::new(Kind::Long, format!("{frames} frames"), size, frames, 200));
    }
    cases
}

/// Counts the pairs of slider ends of a project: those that the drawn cases cover, and all.
pub fn coverage(subject: &CheckedProject, drawn: &[Case]) -> (usize, usize) {
    let sliders = subject.sliders();
    let row = |case: &Case| -> Vec<pairs::End> {
        let ends = (0..sliders.len()).flat_map(|n| [(n, false), (n, true)]);
        ends.filter(|(n, is_high)| case.values.get(&sliders[*n].name) == Some(&end(&sliders[*n], *is_high))).collect()
    };
    let seen: BTreeSet<pairs::Pair> = drawn.iter().flat_map(|c| pairs::covered(&row(c)).collect::<Vec<_>>()).collect();
    (seen.len(), pairs::all(sliders.len()).len())
}

fn courant(subject: &CheckedProject, sliders: &[CustomUniform], m: &Measure, cases: &mut Vec<Case>) {
    let Some(courant) = &subject.courant else { return };
    let Some(slider) = sliders.iter().find(|k| k.name == courant.slider) else { return };
    for &cells in m.courant {
        let range = slider.range.map_or((f64::MIN, f64::MAX), |r| (r.min[0], r.max[0]));
        let value = courant.value(cells, m.base).clamp(range.0, range.1);
        let values = CustomUniformValues::from([(slider.name.clone(), CustomUniformValue::Float(value))]);
        cases
            .push(Case { values, ..Case::new(Kind::Courant, format!("{cells} cells a step"), m.base, m.end, m.every) });
    }
}

impl Measure {
    /// Returns a case with a disturbance of this number of frames.
    fn disturbance(&self, kind: Kind, name: &str, lasts: u32) -> Case {
        let frames = self.calm + lasts + self.recover;
        Case::new(kind, name, self.base, frames, self.every).disturbed(self.calm, self.calm + lasts)
    }
}

fn drags(m: &Measure, cases: &mut Vec<Case>) {
    for (hand, name) in MouseGesture::DRAGS {
        cases.push(Case { hand, ..m.disturbance(Kind::Drag, name, m.drag) });
    }
}

/// Adds the disturbances of a state.
fn disturbances(m: &Measure, cases: &mut Vec<Case>) {
    let case = |kind, name: &str, lasts: u32| m.disturbance(kind, name, lasts);
    for (steps, name, lasts) in [
        (Steps::Times(10.0), "frames ten times as long", m.drag / 2),
        (Steps::Seconds(0.25), "a frame of 250 ms", 1),
        (Steps::Seconds(10.0), "a frame of 10 s", 1),
        (Steps::Still, "frames that take no time", m.drag / 2),
        (Steps::Uneven, "uneven frames", m.drag),
    ] {
        cases.push(Case { steps, ..case(Kind::Step, name, lasts) });
    }
    let apart = m.drag / 3;
    let resizes: Vec<(u32, (u32, u32))> =
        (0..).map(|n| m.calm + n * apart).zip(m.resized.iter().copied().chain([m.base])).collect();
    let lasts = apart * (resizes.len() as u32 - 1) + 1;
    cases.push(Case { resizes, ..case(Kind::Resize, "resize on the way", lasts) });
    for (broken, name) in [
        (Broken::NotANumber, "NaN in a texel of every state"),
        (Broken::Infinite, "infinity in a texel of every state"),
    ] {
        cases.push(Case { poison: Some((m.calm, broken)), ..case(Kind::Broken, name, 1) });
    }
}

fn end(slider: &CustomUniform, is_high: bool) -> CustomUniformValue {
    match (slider.range, slider.ty) {
        (None, _) | (_, CustomUniformType::Bool) => CustomUniformValue::Bool(is_high),
        (Some(range), ty) => CustomUniformValue::new(ty, if is_high { &range.max } else { &range.min }),
    }
}

/// The maximum number of integer values of a slider that are all drawn.
const FEW: i32 = 8;

/// Returns the integers between the ends of a slider that has few of them, without its default.
fn between(slider: &CustomUniform) -> Vec<CustomUniformValue> {
    let (Some(range), CustomUniformType::Int) = (slider.range, slider.ty) else { return Vec::new() };
    let (low, high) = (range.min[0].round() as i32, range.max[0].round() as i32);
    if high - low >= FEW {
        return Vec::new();
    }
    (low + 1..high).map(CustomUniformValue::Int).filter(|value| *value != slider.default).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn case_names_are_unique_and_every_slider_is_at_both_ends() {
        for name in super::super::presets::NAMES {
            let subject = CheckedProject::load(name, &[]).unwrap();
            for extent in [Extent::Quick, Extent::Full] {
                let cases = list(&subject, extent, base(extent));
                let names: BTreeSet<&str> = cases.iter().map(|c| c.name.as_str()).collect();
                assert_eq!(names.len(), cases.len(), "{name}");
                let ends = cases.iter().filter(|c| c.kind == Kind::End).count();
                assert_eq!(ends, 2 * subject.sliders().len(), "{name}");
                for case in &cases {
                    let (from, to) = case.disturbed.unwrap_or((0, 0));
                    assert!(from <= to && to < case.frames, "{name}: {}", case.name);
                    assert!(case.is_checked(case.frames - 1));
                }
            }
        }
    }

    #[test]
    fn integers_between_the_ends_are_drawn_if_they_are_few() {
        let inner = |name: &str| -> Vec<String> {
            let subject = CheckedProject::load(name, &[]).unwrap();
            let cases = list(&subject, Extent::Full, base(Extent::Full));
            cases.into_iter().filter(|c| c.kind == Kind::Inner).map(|c| c.name).collect()
        };
        assert_eq!(inner("fluid-accurate"), ["walls=1"]);
        assert_eq!(inner("reaction-diffusion"), ["diffusion=2"], "1 is the default");
        assert_eq!(inner("ssao"), ["method=1"], "64 samples are many");
        assert_eq!(inner("gaussian-blur"), ["variant=1", "variant=2", "variant=3", "variant=4"]);
        assert_eq!(inner("mip-fluid"), Vec::<String>::new());
    }

    #[test]
    fn the_box_with_its_lid_and_viscosities_of_a_large_canvas_are_drawn() {
        let subject = CheckedProject::load("fluid-accurate", &[]).unwrap();
        let cases = list(&subject, Extent::Full, base(Extent::Full));
        let lids = cases.iter().filter(|c| c.name.contains("lid_speed") && c.name.contains("walls=1"));
        assert_eq!(lids.count(), 10);
        let large: Vec<&Case> = cases.iter().filter(|c| c.kind == Kind::Viscosity).collect();
        assert!(large.len() == 18 && large.iter().all(|c| (c.size, c.frames) == ((1920, 1080), 60)));
        let quick = list(&subject, Extent::Quick, base(Extent::Quick));
        assert!(quick.iter().all(|c| !matches!(c.kind, Kind::Viscosity | Kind::Long)));
        let long: Vec<&Case> = cases.iter().filter(|c| c.kind == Kind::Long).collect();
        assert!(long.len() == 1 && (long[0].size, long[0].frames) == ((48, 27), 100_000));
    }

    #[test]
    fn filters_have_no_cases_about_a_state() {
        let subject = CheckedProject::load("gaussian-blur", &[]).unwrap();
        let cases = list(&subject, Extent::Full, base(Extent::Full));
        let has = |kind| cases.iter().any(|c| c.kind == kind);
        assert!(has(Kind::Untouched) && has(Kind::End) && has(Kind::Drag) && has(Kind::Size) && has(Kind::Pairs));
        assert!(!has(Kind::Step) && !has(Kind::Resize) && !has(Kind::Broken) && !has(Kind::Long));
        assert!(cases[0].frames < 2000);
    }

    #[test]
    fn all_pairs_of_ends_are_among_the_cases() {
        let subject = CheckedProject::load("mip-fluid", &[]).unwrap();
        let sliders = subject.sliders();
        for extent in [Extent::Quick, Extent::Full] {
            let cases = list(&subject, extent, base(extent));
            let all = 2 * sliders.len() * (sliders.len() - 1);
            assert_eq!(coverage(&subject, &cases), (all, all));
            let without_last = &cases[..cases.iter().rposition(|c| c.kind == Kind::Pairs).unwrap()];
            assert!(coverage(&subject, without_last).0 < all);
            for (n, a) in sliders.iter().enumerate() {
                for b in &sliders[n + 1..] {
                    for (x, y) in [(false, false), (false, true), (true, false), (true, true)] {
                        let is_there = cases.iter().any(|c| {
                            c.values.get(&a.name) == Some(&end(a, x)) && c.values.get(&b.name) == Some(&end(b, y))
                        });
                        assert!(is_there, "{} and {}", a.name, b.name);
                    }
                }
            }
        }
    }
}
