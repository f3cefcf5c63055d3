//! Finds the knobs of a project, and says of numbers that look like some why they are none.

#[cfg(test)]
mod tests;

use crate::{
    knob::{Kind, Knob, Target, half},
    savings::Place,
    search::Ladder,
};
use eddy_diag::{SourceMap, Span};
use eddy_engine::{Sources, counts::Line};
use eddy_glsl::knobs::{Declared, Number, NumberType, Role, RoleKind};
use eddy_project::{CustomUniformType, Filter, Input, Origin, PassSize, Project};
use serde::Serialize;
use std::collections::BTreeMap;

/// A number that is not tried, and the reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Rejected {
    pub name: String,
    pub place: String,
    pub reason: String,
}

/// The knobs of a project.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// The most promising first.
    pub knobs: Vec<Knob>,
    /// Numbers that [`Found::choose`] can make knobs: they have a name or bound a loop, and are not tried unasked.
    pub others: Vec<(Knob, Rejected)>,
    pub rejected: Vec<Rejected>,
}

/// Bounds of loops in place below this are parts of the method (components, neighbours), not its quality.
const LEAST_LITERAL: f64 = 8.0;

impl Found {
    /// Returns the knobs of a project.
    pub fn new(project: &Project) -> Found {
        let (sources, texts) = (Sources::new(project), project.texts());
        let mut numbers: BTreeMap<(u16, u32, String), (Number, usize)> = BTreeMap::new();
        for index in (0..project.passes.len()).filter(|i| project.passes[*i].id.is_picture()) {
            for number in sources.numbers(index) {
                let key = match number.declared {
                    Declared::Uniform => (u16::MAX, 0, number.name.clone()),
                    _ => (number.span.source.0, number.span.start, String::new()),
                };
                let (known, _) =
                    numbers.entry(key).or_insert_with(|| (Number { roles: Vec::new(), ..number.clone() }, index));
                for role in number.roles {
                    if !known.roles.contains(&role) {
                        known.roles.push(role);
                    }
                }
            }
        }
        let mut found = Found::default();
        let mut used = BTreeMap::new();
        for (number, _) in numbers.into_values() {
            found.number(project, &texts, number, &mut used);
        }
        found.marked_uniforms(project, &texts);
        found.knobs.sort_by_key(rank);
        found.settings(project);
        found
    }

    fn number(&mut self, project: &Project, texts: &SourceMap, number: Number, used: &mut BTreeMap<String, u32>) {
        if number.declared == Declared::Uniform {
            self.uniform(project, texts, &number.name, &number.roles);
            return;
        }
        let place = place(texts, number.span);
        let base = match &number.name[..] {
            "" => place.clone(),
            name => name.to_owned(),
        };
        let count = used.entry(base.clone()).or_insert(0);
        *count += 1;
        let name = if *count == 1 { base } else { format!("{base}#{count}") };
        let refused = |reason: String| Rejected { name: name.clone(), place: place.clone(), reason };
        let first = |kind: RoleKind| number.roles.iter().find(|role| role.kind == kind);
        if let Some(role) = first(RoleKind::ArraySize) {
            self.rejected.push(refused(format!(
                "it sizes an array ({}), whose content belongs to its size",
                self::place(texts, role.at)
            )));
            return;
        }
        let work = || number.roles.iter().filter(|role| role.is_work());
        if let Some(role) = first(RoleKind::Switch) {
            self.rejected
                .push(refused(format!("an #ifdef asks for it ({}): it is a switch", self::place(texts, role.at))));
            return;
        }
        let Some(role) = work().next() else {
            if let Some(role) = first(RoleKind::Condition) {
                let reason =
                    format!("an #if chooses code by it ({}), and no loop depends on it", self::place(texts, role.at));
                self.rejected.push(refused(reason));
            } else if number.value > 0.0 {
                let reason = "no loop depends on it".to_owned();
                let rejected = refused(reason);
                let why = "you chose it with --knob".to_owned();
                self.others.push((knob(name.clone(), &number, Kind::Count, true, (place.clone(), why)), rejected));
            }
            return;
        };
        let kind = match role.kind {
            RoleKind::LoopStep if role.grows => Kind::Count,
            RoleKind::LoopStep => Kind::Step,
            RoleKind::Tolerance => Kind::Tolerance,
            RoleKind::Distance => Kind::Distance,
            _ => Kind::Count,
        };
        let mut why = sentence(texts, role);
        let more = work().count() - 1;
        if more > 0 {
            why += &format!(", and {more} more place{}", if more == 1 { "" } else { "s" });
        }
        let mut knob = knob(name.clone(), &number, kind, role.grows, (place.clone(), why));
        knob.column = texts.line_column(number.span).map(|at| at.column);
        knob.places = places(texts, &number.roles);
        let is_literal = number.declared == Declared::Literal;
        let reason = match () {
            () if number.value <= 0.0 => Some("it is not above 0"),
            () if is_mathematical(&number) => Some("it is a mathematical constant"),
            () if is_literal && kind != Kind::Count => Some("it has no name"),
            () if is_literal && number.value < LEAST_LITERAL => {
                Some("it has no name and is small: a part of the method")
            }
            () => None,
        };
        match reason {
            Some(reason) => self.others.push((knob, refused(format!("{reason}; choose it with --knob")))),
            None => self.knobs.push(knob),
        }
    }

    /// Adds a slider, if it has one component.
    fn uniform(&mut self, project: &Project, texts: &SourceMap, name: &str, roles: &[Role]) {
        let declared = project.custom_uniforms();
        let Some(uniform) = declared.get(name) else { return };
        if self.knobs.iter().any(|knob| knob.name == name) {
            return;
        }
        let place = place(texts, uniform.span);
        if !matches!(uniform.ty, CustomUniformType::Int | CustomUniformType::Float) {
            let reason = format!("a {} has no order of cheaper values", uniform.ty.name());
            self.rejected.push(Rejected { name: name.to_owned(), place, reason });
            return;
        }
        let value = project.custom_uniform_values.get(name).unwrap_or(&uniform.default).components()[0];
        let is_integer = uniform.ty == CustomUniformType::Int;
        let mut knob = Knob {
            name: name.to_owned(),
            target: Target::Uniform,
            kind: Kind::Count,
            value,
            grows: true,
            place,
            column: None,
            why: roles.first().map_or_else(|| "its line is marked //@tune".into(), |role| sentence(texts, role)),
            places: places(texts, roles),
            ladder: Ladder { values: vec![value], is_continuous: true, is_integer },
            finest: None,
        };
        if value <= 0.0 {
            let reason = "its value is not above 0".to_owned();
            self.rejected.push(Rejected { name: knob.name, place: knob.place, reason });
            return;
        }
        knob.set_automatic_range();
        if let Some(range) = uniform.range {
            let (low, high) = (range.min[0], range.max[0]);
            knob.ladder.values.retain(|v| (low..=high).contains(v));
            knob.finest = knob.finest.map(|finest| finest.clamp(low, high));
            if low > 0.0 {
                knob.add_value(low);
            }
        }
        self.knobs.push(knob);
    }

    /// Adds the sliders whose `#iUniform` line the author marks.
    fn marked_uniforms(&mut self, project: &Project, texts: &SourceMap) {
        for uniform in &project.custom_uniforms().list {
            let Some(text) = texts.get(uniform.span.source) else { continue };
            let line = text.text[uniform.span.start as usize..].lines().next().unwrap_or("");
            if line.contains("//@tune") || line.contains("// @tune") {
                self.uniform(project, texts, &uniform.name, &[]);
            }
        }
    }

    /// Adds settings of the project: sizes, bits and mips of buffers, steps of groups.
    fn settings(&mut self, project: &Project) {
        let can_hold = !matches!(project.origin, Origin::File(_) | Origin::Json(_));
        let buffers = || project.passes.iter().filter(|pass| pass.id.is_buffer());
        if !can_hold {
            if buffers().next().is_some() {
                self.rejected.push(Rejected {
                    name: "sizes and formats of buffers".into(),
                    place: "project".into(),
                    reason: "a project of this form has no eddy.toml that could hold them; save it as a folder".into(),
                });
            }
            return;
        }
        let setting = |name: String, target, value: f64, values: &[f64], place: String, why: String| Knob {
            name,
            target,
            kind: Kind::Setting,
            value,
            grows: true,
            place,
            column: None,
            why,
            places: Vec::new(),
            ladder: Ladder { values: values.to_vec(), is_continuous: false, is_integer: false },
            finest: None,
        };
        for pass in buffers() {
            let (key, title) = (pass.id.key(), pass.id.title());
            if matches!(pass.size(), PassSize::Canvas | PassSize::Scale(_)) {
                let why = format!("{title} has as many texels as its size says");
                self.knobs.push(setting(
                    format!("{key}.size"),
                    Target::Size(pass.id.clone()),
                    1.0,
                    &[0.25, 0.5, 0.75, 1.0],
                    format!("eddy.toml: {key}"),
                    why,
                ));
            }
            if half(pass.settings.format) != pass.settings.format {
                let why = format!("{title} stores components of 32 bits");
                self.knobs.push(setting(
                    format!("{key}.bits"),
                    Target::Bits(pass.id.clone()),
                    32.0,
                    &[16.0, 32.0],
                    format!("eddy.toml: {key}"),
                    why,
                ));
            }
        }
        for pass in &project.passes {
            for (slot, channel) in pass.bindings.iter() {
                if channel.sampler.filter == Filter::Mipmap && matches!(&channel.input, Input::Pass { .. }) {
                    let name = format!("{}.mips{slot}", pass.id.key());
                    let why = format!("{} reads mip levels of a buffer, which are made in each frame", pass.id.title());
                    let target = Target::Mips(pass.id.clone(), slot);
                    self.knobs.push(setting(
                        name,
                        target,
                        1.0,
                        &[0.0, 1.0],
                        format!("eddy.toml: {}", pass.id.key()),
                        why,
                    ));
                }
            }
        }
        for group in project.groups.iter().filter(|group| group.steps > 1) {
            let steps = f64::from(group.steps);
            let why = format!("its passes are drawn {} times a frame", group.steps);
            let name = format!("{}.steps", group.name);
            let mut knob = setting(
                name,
                Target::Steps(group.name.clone()),
                steps,
                &[steps],
                format!("eddy.toml: {}", group.name),
                why,
            );
            (knob.kind, knob.ladder.is_integer, knob.ladder.is_continuous) = (Kind::Count, true, true);
            knob.set_automatic_range();
            self.knobs.push(knob);
        }
    }

    /// Keeps the knobs of these names alone, and makes knobs of other numbers that are named.
    pub fn choose(&mut self, names: &[String]) -> Result<(), String> {
        let mut chosen = Vec::new();
        for name in names {
            let known = self.knobs.iter().position(|knob| knob.name == *name);
            let other = self.others.iter().position(|(knob, _)| knob.name == *name);
            chosen.push(match (known, other) {
                (Some(at), _) => self.knobs.remove(at),
                (None, Some(at)) => self.others.remove(at).0,
                (None, None) => return Err(self.unknown(name)),
            });
        }
        self.knobs = chosen;
        Ok(())
    }

    /// Keeps the first knobs, and those that `is_wanted`; the others are listed as rejected.
    pub fn keep_most(&mut self, most: usize, is_wanted: impl Fn(&Knob) -> bool) {
        let mut kept = 0;
        for knob in std::mem::take(&mut self.knobs) {
            if kept < most || is_wanted(&knob) {
                kept += 1;
                self.knobs.push(knob);
            } else {
                let reason = format!("only {most} knobs are tried at once; choose it with --knob");
                self.rejected.push(Rejected { name: knob.name, place: knob.place, reason });
            }
        }
    }

    /// Returns the knob of a name, which [`Found::choose`] may have to choose first.
    pub fn knob_mut(&mut self, name: &str) -> Result<&mut Knob, String> {
        if !self.knobs.iter().any(|knob| knob.name == name)
            && let Some(at) = self.others.iter().position(|(knob, _)| knob.name == name)
        {
            self.knobs.push(self.others.remove(at).0);
        }
        let message = self.unknown(name);
        self.knobs.iter_mut().find(|knob| knob.name == name).ok_or(message)
    }

    fn unknown(&self, name: &str) -> String {
        if let Some(rejected) = self.rejected.iter().find(|rejected| rejected.name == name) {
            return format!("{name} ({}) cannot be a knob: {}", rejected.place, rejected.reason);
        }
        let names: Vec<&str> = self.knobs.iter().map(|knob| &*knob.name).collect();
        let known =
            if names.is_empty() { "it has none".to_owned() } else { format!("the knobs are {}", names.join(", ")) };
        format!("{name} is not a knob of this project; {known} (eddy tune PROJECT --list)")
    }
}

fn knob(name: String, number: &Number, kind: Kind, grows: bool, (place, why): (String, String)) -> Knob {
    let mut knob = Knob {
        name,
        target: Target::Number { span: number.span, ty: number.ty },
        kind,
        value: number.value,
        grows,
        place,
        column: None,
        why,
        places: Vec::new(),
        ladder: Ladder { values: vec![number.value], is_continuous: true, is_integer: false },
        finest: None,
    };
    knob.ladder.is_integer = knob.is_integer();
    knob.set_automatic_range();
    knob
}

/// Returns whether a number is a part of pi, or e, or the golden ratio or angle, written to three digits at least.
fn is_mathematical(number: &Number) -> bool {
    use std::f64::consts::{E, PI};
    let parts = [PI / 4.0, PI / 3.0, PI / 2.0, PI, 2.0 * PI, E, 1.618_034, 0.618_034, 2.399_963];
    number.ty == NumberType::Float && parts.iter().any(|part| (number.value / part - 1.0).abs() < 6e-4)
}

/// Knobs with a name come before those without, counts before tolerances, steps and distances.
fn rank(knob: &Knob) -> (u8, u8) {
    let kind = match knob.kind {
        Kind::Count => 0,
        Kind::Step => 1,
        Kind::Tolerance => 2,
        Kind::Distance => 3,
        Kind::Setting => 4,
    };
    (kind, u8::from(knob.name.contains(':')))
}

fn place(texts: &SourceMap, span: Span) -> String {
    let name = texts.get(span.source).map_or("", |text| &*text.name);
    let line = texts.line_column(span).map_or(0, |at| at.line);
    format!("{name}:{line}")
}

/// Returns the places where the roles decide how often code runs.
fn places(texts: &SourceMap, roles: &[Role]) -> Vec<Place> {
    let place = |role: &Role| {
        let number = u32::try_from(texts.line_column(role.at)?.line).ok()?;
        let line = Line { source: role.at.source, number };
        Some(Place { span: role.at, line, is_bound: role.kind == RoleKind::LoopBound })
    };
    roles.iter().filter(|role| role.is_work()).filter_map(place).collect()
}

fn sentence(texts: &SourceMap, role: &Role) -> String {
    let at = place(texts, role.at);
    match role.kind {
        RoleKind::LoopBound => format!("it bounds the loop at {at}"),
        RoleKind::LoopStep if role.grows => format!("the step of the loop at {at} is divided by it"),
        RoleKind::LoopStep => format!("it is the step of the loop at {at}"),
        RoleKind::Tolerance => format!("the loop at {at} ends below it"),
        RoleKind::Distance => format!("the loop at {at} ends above it"),
        RoleKind::ArraySize => format!("it sizes the array at {at}"),
        RoleKind::Condition | RoleKind::Switch => format!("the condition at {at} depends on it"),
    }
}
