//! The keys of `eddy.toml` that set how passes are drawn: `size`, `format`, `region` and `when` of a pass, and
//! `[groups]`.

use super::{
    edit::{child, key_of, set},
    reader::{Reader, number},
};
use crate::{
    Condition, Group, Pass, PassName, PassSettings, PassSize, Project, Region, Side, TexelFormat, Written, file_names,
    limits, listed, nearest, settings::draws,
};
use toml_edit::{Item, Table, TableLike, Value};

/// The keys of a pass's table that this module reads.
pub(super) const KEYS: [&str; 4] = ["size", "format", "region", "when"];

fn whole(value: &Value) -> Option<u32> {
    value.as_integer().and_then(|n| u32::try_from(n).ok())
}

impl Reader<'_> {
    pub(super) fn settings(&mut self, id: &PassName, table: &dyn TableLike) -> PassSettings {
        let mut settings = PassSettings::default();
        for key in KEYS {
            if let (Some(item), Some(why)) = (table.get(key), id.row().refusal(key)) {
                self.error(item.span(), format!("{} has no {key}", id.title()), why);
                return settings;
            }
        }
        if let Some(item) = table.get("size") {
            match size(item) {
                Some(size) => settings.size = size,
                None => self.wrong_type(
                    "size",
                    item,
                    "a factor of the picture's resolution above 0 (0.5), or [width, height] in texels",
                ),
            }
        }
        if let Some(name) = self.one_of(table, "format", &TexelFormat::ALL.map(TexelFormat::name)) {
            settings.format = TexelFormat::ALL.into_iter().find(|f| f.name() == name).unwrap_or_default();
        }
        if let Some(item) = table.get("region") {
            match region(item) {
                Some(region) => settings.region = Some(region),
                None => self.wrong_type(
                    "region",
                    item,
                    "[x, y, width, height] in texels from the bottom left, none of them empty",
                ),
            }
        }
        settings.when = self.condition(table);
        settings
    }

    fn condition(&mut self, table: &dyn TableLike) -> Option<Condition> {
        let item = table.get("when")?;
        let Some(text) = item.as_str() else {
            self.wrong_type("when", item, "a condition in quotes, such as \"quality > 1\"");
            return None;
        };
        let written = self.span_text(item).map(|(manifest, range)| Written { manifest, range });
        match Condition::parse(text) {
            Ok(condition) => Some(condition.at(written)),
            Err(error) => {
                // If the text is written verbatim, the part of it that is wrong.
                let verbatim = written.as_ref().and_then(|w| {
                    let at = w.range.start + w.manifest.get(w.range.clone())?.find(text)?;
                    Some(at + error.range.start..at + error.range.end)
                });
                let at = verbatim.filter(|range| !range.is_empty()).or_else(|| item.span());
                self.error(at, format!("when: {}", error.message), error.hint);
                None
            }
        }
    }

    /// `[groups.NAME]`: passes that are drawn several times a frame.
    pub(super) fn groups(&mut self, root: &dyn TableLike, passes: &[Pass]) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        let table = root.get("groups").and_then(|item| self.table("groups", item));
        let order: Vec<&PassName> = passes.iter().map(|p| &p.id).filter(|id| id.is_buffer()).collect();
        for (name, item) in table.into_iter().flat_map(TableLike::iter) {
            let at = table.and_then(|table| table.key(name)).and_then(toml_edit::Key::span).or_else(|| item.span());
            if !is_group_name(name) {
                let message = format!("a group cannot be named \"{}\"", name.escape_debug());
                let hint = format!("use letters, digits, _, - and spaces, at most {} of them", limits::NAME);
                self.error(at, message, hint);
                continue;
            }
            let Some(table) = self.table(name, item) else { continue };
            self.check_keys(&format!("[groups.{name}]"), table, &[&["passes", "steps"]]);
            let steps = match table.get("steps") {
                None => 1,
                Some(item) => match item.as_value().and_then(whole).filter(|n| *n > 0) {
                    Some(steps) => steps,
                    None => {
                        self.wrong_type("steps", item, "a whole number above 0");
                        continue;
                    }
                },
            };
            let Some(item) = table.get("passes") else {
                self.error(
                    table_span(item),
                    format!("the group {name} has no passes"),
                    "write passes = [\"buffer_a\"]",
                );
                continue;
            };
            let Some(names) = item.as_array().and_then(|a| a.iter().map(Value::as_str).collect::<Option<Vec<_>>>())
            else {
                self.wrong_type("passes", item, "a list of buffers in quotes");
                continue;
            };
            if let Some(passes) = self.group_passes(item, &names, &order, &groups) {
                groups.push(Group { name: name.to_owned(), passes, steps });
            }
        }
        self.check_draws(passes, &groups, table);
        groups
    }

    /// Rejects a project whose frame exceeds the limit of draws.
    fn check_draws(&mut self, passes: &[Pass], groups: &[Group], table: Option<&dyn TableLike>) {
        let all = draws(passes, groups);
        if all > limits::DRAWS {
            let most = groups.iter().max_by_key(|g| g.steps);
            let at = most.and_then(|g| table?.get(&g.name)?.as_table_like()?.get("steps")?.span());
            let message =
                format!("a frame draws {all} passes and meshes with all their steps; the limit is {}", limits::DRAWS);
            self.error(at, message, "take fewer steps, or put fewer passes into groups");
        }
    }

    /// The passes of a group, which must be listed in drawing order.
    fn group_passes(
        &mut self,
        item: &Item,
        names: &[&str],
        order: &[&PassName],
        others: &[Group],
    ) -> Option<Vec<PassName>> {
        let mut places = Vec::new();
        for name in names {
            let Some(place) = file_names::pass_of_stem(name).and_then(|id| order.iter().position(|o| **o == id)) else {
                let known: Vec<&str> = order.iter().map(|id| id.key()).collect();
                let hint = match nearest(name, known.iter().copied()) {
                    Some(near) => format!("did you mean {near}?"),
                    None => format!("there are {}", listed(&known)),
                };
                self.error(item.span(), format!("there is no buffer \"{name}\" to draw several times"), hint);
                return None;
            };
            places.push(place);
        }
        let Some(&first) = places.first() else {
            self.error(item.span(), "a group has no passes", "add some, or remove the group");
            return None;
        };
        if !places.iter().enumerate().all(|(i, place)| *place == first + i) {
            let hint = "list buffers that follow each other in [passes], in that order";
            self.error(item.span(), "the passes of a group are drawn one after the other", hint);
            return None;
        }
        let passes: Vec<PassName> = places.iter().map(|p| order[*p].clone()).collect();
        if let Some(twice) = passes.iter().find(|id| others.iter().any(|g| g.passes.contains(id))) {
            self.error(item.span(), format!("{} is in another group already", twice.title()), "list it once");
            return None;
        }
        Some(passes)
    }
}

fn is_group_name(name: &str) -> bool {
    let is_fit = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | ' ');
    !name.trim().is_empty() && name.chars().count() <= limits::NAME && name.chars().all(is_fit)
}

fn table_span(item: &Item) -> Option<std::ops::Range<usize>> {
    item.span()
}

fn size(item: &Item) -> Option<PassSize> {
    let value = item.as_value()?;
    if let Some(all) = value.as_array() {
        let sides: Vec<Side> = all.iter().map(side).collect::<Option<_>>()?;
        return match sides[..] {
            [Side::Fixed(width), Side::Fixed(height)] => Some(PassSize::Fixed(width, height)),
            [width, height] => Some(PassSize::Sides(width, height)),
            _ => None,
        };
    }
    let factor = number(value)?;
    (factor > 0.0).then_some(if factor == 1.0 { PassSize::Canvas } else { PassSize::Scale(factor) })
}

/// The word before a part of the canvas that is rounded down.
const FLOOR: &str = "floor ";

/// Returns a side: a whole number is one of texels, one with a point a part of the canvas; `"floor 0.25"` rounds down.
fn side(value: &Value) -> Option<Side> {
    if let Some(text) = value.as_str() {
        let by = text.strip_prefix(FLOOR)?.trim().parse().ok()?;
        return Some(Side::Floor(by)).filter(|side| side.is_valid());
    }
    let side = if value.is_float() { Side::Scale(number(value)?) } else { Side::Fixed(whole(value)?) };
    Some(side).filter(|side| side.is_valid())
}

fn region(item: &Item) -> Option<Region> {
    let all: Vec<u32> = item.as_array()?.iter().map(whole).collect::<Option<_>>()?;
    match all[..] {
        [x, y, width, height] if width > 0 && height > 0 => Some(Region { x, y, width, height }),
        _ => None,
    }
}

pub(super) fn write_settings(table: &mut dyn TableLike, pass: &Pass) {
    let settings = &pass.settings;
    if table.get("size").and_then(size).unwrap_or_default() != settings.size {
        set(
            table,
            "size",
            match settings.size {
                PassSize::Canvas => None,
                PassSize::Scale(by) => Some(by.into()),
                PassSize::Fixed(w, h) => Some([w, h].into_iter().map(i64::from).collect()),
                PassSize::Sides(w, h) => {
                    let side = |side| match side {
                        Side::Scale(by) => Value::from(by),
                        Side::Floor(by) => Value::from(format!("{FLOOR}{by:?}")),
                        Side::Fixed(texels) => Value::from(i64::from(texels)),
                    };
                    Some([w, h].into_iter().map(side).collect())
                }
            },
        );
    }
    let written = table.get("format").and_then(Item::as_str).map(str::to_ascii_lowercase);
    // With several targets, `targets` sets it.
    if table.contains_key("targets") || !pass.body.more_targets().is_empty() {
        table.remove("format");
    } else if written.as_deref().unwrap_or(TexelFormat::default().name()) != settings.format.name() {
        set(table, "format", (settings.format != TexelFormat::default()).then(|| settings.format.name().into()));
    }
    if table.get("region").and_then(region) != settings.region {
        let numbers = settings.region.map(|r| [r.x, r.y, r.width, r.height].into_iter().map(i64::from).collect());
        set(table, "region", numbers);
    }
    let when = settings.when.as_ref().map(Condition::text);
    if table.get("when").and_then(Item::as_str) != when {
        set(table, "when", when.map(Value::from));
    }
}

pub(super) fn write_groups(root: &mut Table, project: &Project) {
    if project.groups.is_empty() {
        root.remove("groups");
        return;
    }
    let passes = root.get("passes").and_then(Item::as_table_like);
    let keys: Vec<Vec<String>> = project
        .groups
        .iter()
        .map(|g| g.passes.iter().map(|id| passes.map_or_else(|| id.key().to_owned(), |t| key_of(t, id))).collect())
        .collect();
    let Some(table) = child(root, "groups", true) else { return };
    let is_gone = |key: &str| !project.groups.iter().any(|g| g.name == key);
    let gone: Vec<String> = table.iter().map(|(k, _)| k.to_owned()).filter(|k| is_gone(k)).collect();
    for key in gone {
        table.remove(&key);
    }
    for (group, keys) in project.groups.iter().zip(keys) {
        let Some(entry) = child(table, &group.name, false) else { continue };
        let written: Option<Vec<PassName>> = entry
            .get("passes")
            .and_then(Item::as_array)
            .map(|a| a.iter().filter_map(|v| file_names::pass_of_stem(v.as_str()?)).collect());
        if written.as_ref() != Some(&group.passes) {
            set(entry, "passes", Some(keys.iter().map(String::as_str).collect()));
        }
        let steps = entry.get("steps").and_then(Item::as_value).and_then(whole).unwrap_or(1);
        if steps != group.steps {
            set(entry, "steps", Some(i64::from(group.steps).into()));
        }
    }
}
