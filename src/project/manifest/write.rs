//! Writes `eddy.toml` with minimal changes to the old text, so that the author's comments and order stay.

use super::{
    VERSION, controls,
    edit::{child, key_of, set},
    fills, geometry, read,
    reader::number,
    settings, uniforms,
};
use crate::{
    Bindings, Channel, CustomUniformValue, Dialect, Filter, Input, InputKind, InputRow, MAX_CHANNELS, Media, PassName,
    Project, SamplerRules, Wrap,
    file_names::{FileRole, pass_of_stem, role_of_file},
};
use toml_edit::{DocumentMut, InlineTable, Item, Key, Table, TableLike, Value};

/// The text of `eddy.toml` for a project whose sources are called by their file names. `old` is the previous text; if
/// the project is unchanged, so is the text, byte for byte. `folder_name` is the name of a project that sets none;
/// `has_common_file`: the folder contains a file that would be read as Common by default.
pub fn write(project: &Project, old: Option<&str>, folder_name: &str, has_common_file: bool) -> String {
    let mut document: DocumentMut = old.and_then(|text| text.parse().ok()).unwrap_or_default();
    let is_new = document.is_empty();
    let root = document.as_table_mut();
    if is_new {
        root.insert("eddy", toml_edit::value(VERSION));
    }
    if is_new || root.contains_key("name") || project.name != folder_name {
        set(root, "name", Some(project.name.as_str().into()));
    }
    let text = |t: &str| (!t.is_empty()).then(|| Value::from(t));
    set(root, "description", text(&project.info.description));
    set(root, "author", text(&project.info.author));
    let tags = &project.info.tags;
    set(root, "tags", (!tags.is_empty()).then(|| tags.iter().collect()));
    set(root, "id", text(&project.info.id));
    if root.get("period").and_then(Item::as_value).and_then(number) != project.info.period {
        set(root, "period", project.info.period.map(Value::from));
    }
    set(root, "dialect", (project.dialect != Dialect::Shadertoy).then(|| project.dialect.name().into()));
    set(root, "sampler_rules", (project.sampler_rules == SamplerRules::Site).then(|| "site".into()));
    uniforms(root, project);
    controls::write_controls(root, project);
    common(root, project, has_common_file, is_new);
    passes(root, project);
    settings::write_groups(root, project);
    let extra = &project.info.extra;
    if extra.is_empty() {
        root.remove("shadertoy");
    } else if let Some(table) = child(root, "shadertoy", false) {
        let json = serde_json::Value::Object(extra.clone());
        let same =
            table.get("info").and_then(Item::as_str).and_then(|t| serde_json::from_str(t).ok()).as_ref() == Some(&json);
        if !same {
            set(table, "info", Some(json.to_string().into()));
        }
    }
    document.to_string()
}

fn uniforms(root: &mut Table, project: &Project) {
    let values = &project.custom_uniform_values;
    if values.is_empty() {
        root.remove("uniforms");
        return;
    }
    let Some(table) = child(root, "uniforms", false) else { return };
    let gone: Vec<String> = table.iter().map(|(k, _)| k.to_owned()).filter(|k| !values.contains_key(k)).collect();
    for key in gone {
        table.remove(&key);
    }
    for (name, value) in values {
        if table.get(name).and_then(uniforms::custom_uniform_value).as_ref() == Some(value) {
            continue;
        }
        set(table, name, Some(written(value)));
    }
}

fn written(value: &CustomUniformValue) -> Value {
    match value {
        CustomUniformValue::Bool(on) => Value::from(*on),
        CustomUniformValue::Int(n) => Value::from(i64::from(*n)),
        CustomUniformValue::Float(x) => Value::from(*x),
        CustomUniformValue::Vector(all) => Value::Array(all.iter().copied().collect()),
        CustomUniformValue::List(all) => Value::Array(all.iter().map(written).collect()),
    }
}

/// `is_new`: there was no file. A file that does not mention Common reads its default file.
fn common(root: &mut Table, project: &Project, has_common_file: bool, is_new: bool) {
    match &project.common {
        Some(source) if !is_new && source.name == "common.glsl" && !root.contains_key("common") => {}
        Some(source) => {
            let is_said = root.get("common").is_some_and(Item::is_table_like);
            if let Some(table) = child(root, "common", false)
                && (table.contains_key("file") || !is_said || source.name != "common.glsl")
            {
                set(table, "file", Some(source.name.as_str().into()));
            }
        }
        None if root.get("common").and_then(Item::as_bool) == Some(false) => {}
        None => {
            root.remove("common");
            if has_common_file {
                set(root, "common", Some(false.into()));
            }
        }
    }
}

fn passes(root: &mut Table, project: &Project) {
    let Some(table) = child(root, "passes", true) else { return };
    let gone: Vec<String> = table
        .iter()
        .map(|(key, _)| key.to_owned())
        .filter(|key| pass_of_stem(key).is_none_or(|id| project.pass(&id).is_none()))
        .collect();
    for key in gone {
        table.remove(&key);
    }
    for pass in &project.passes {
        let key = key_of(table, &pass.id);
        let is_old = table.contains_key(&key);
        let Some(entry) = child(table, &key, false) else { continue };
        let implied = geometry::own_file(entry).unwrap_or_else(|| format!("{}.glsl", pass.id.key()));
        let role = FileRole::Pass(pass.id.clone());
        let is_implied = pass.source.name == implied || role_of_file(&pass.source.name) == Some(role);
        if !is_old || entry.contains_key("file") || !is_implied {
            set(entry, "file", Some(pass.source.name.as_str().into()));
        }
        channels(entry, &pass.bindings);
        settings::write_settings(entry, pass);
        fills::write_fills(entry, &pass.settings);
        geometry::write_geometry(entry, pass);
    }
    order(table, project);
}

/// Sorts the pass tables into the project's order if they are not already.
fn order(table: &mut dyn TableLike, project: &Project) {
    let wanted: Vec<String> = project.passes.iter().map(|p| key_of(table, &p.id)).collect();
    let is_buffer = |key: &&str| pass_of_stem(key).is_some_and(|id| id.is_buffer());
    let now: Vec<&str> = table.iter().map(|(key, _)| key).filter(is_buffer).collect();
    // Only buffers have an order.
    if now == wanted.iter().map(String::as_str).filter(is_buffer).collect::<Vec<_>>() {
        return;
    }
    let tables = |item: &Item| item.as_table().and_then(Table::position);
    let mut places: Vec<isize> = wanted.iter().filter_map(|key| tables(table.get(key)?)).collect();
    places.sort_unstable();
    let last = places.last().copied();
    let mut places = places.into_iter();
    for key in &wanted {
        let Some((old_key, item)) = take(table, key) else { continue };
        let mut item = item;
        if let Item::Table(t) = &mut item {
            t.set_position(places.next().or(last));
        }
        table.entry_format(&old_key).or_insert(item);
    }
}

fn take(table: &mut dyn TableLike, key: &str) -> Option<(Key, Item)> {
    let old_key = table.key(key)?.clone();
    Some((old_key, table.remove(key)?))
}

fn channels(pass: &mut dyn TableLike, channels: &Bindings) {
    if channels.is_empty() {
        pass.remove("channels");
        return;
    }
    if pass.get("channels").is_none_or(|item| !item.is_table_like()) {
        let mut dotted = Table::new();
        dotted.set_dotted(true);
        pass.insert("channels", Item::Table(dotted));
    }
    let Some(table) = pass.get_mut("channels").and_then(Item::as_table_like_mut) else { return };
    for n in 0..MAX_CHANNELS {
        let key = n.to_string();
        let name = channels.name(n);
        let is_named_so = |item: &Item| item.get(read::NAME).and_then(Item::as_str) == name;
        match (channels.get(n), table.get(&key)) {
            (None, _) => {
                table.remove(&key);
            }
            (Some(channel), Some(item)) if read::channel(item).as_ref() == Some(channel) && is_named_so(item) => {}
            (Some(channel), old) => {
                let mut entry = entry(channel);
                if let Some(name) = name {
                    entry.insert(read::NAME, name.into());
                }
                let mut value = Value::InlineTable(entry);
                let decor = match old {
                    Some(Item::Value(old)) => Some(old.decor().clone()),
                    _ => None,
                };
                if let Some(decor) = decor {
                    *value.decor_mut() = decor;
                }
                // In place, as the author's comments before it belong to the key.
                match table.get_mut(&key) {
                    Some(item) => *item = Item::Value(value),
                    None => drop(table.insert(&key, Item::Value(value))),
                }
            }
        }
    }
}

fn entry(channel: &Channel) -> InlineTable {
    let mut table = InlineTable::new();
    let row = channel.input.row();
    match &channel.input {
        Input::Pass { id, .. } if id.is_buffer() => {
            let plain = id.buffer_name().filter(|name| PassName::parse(name).as_ref() == Some(id));
            table.insert(row.key, plain.unwrap_or(id.key()).into());
        }
        Input::Pass { .. } | Input::Device(_) => drop(table.insert(row.key, true.into())),
        Input::Media { media, .. } => self::media(&mut table, row, media),
    }
    let (sampler, default) = (channel.sampler, row.sampler);
    if sampler.filter != default.filter {
        let filter = match sampler.filter {
            Filter::Nearest => "nearest",
            Filter::Linear => "linear",
            Filter::Mipmap => "mipmap",
        };
        table.insert("filter", filter.into());
    }
    if sampler.wrap != default.wrap {
        let wrap = match sampler.wrap {
            Wrap::Clamp => "clamp",
            Wrap::Repeat => "repeat",
        };
        table.insert("wrap", wrap.into());
    }
    if sampler.vflip != default.vflip {
        table.insert("vflip", sampler.vflip.into());
    }
    if let Some((_, target)) = channel.input.target().filter(|(_, target)| *target > 0) {
        table.insert("target", (target as i64).into());
    }
    table
}

fn media(table: &mut InlineTable, row: &InputRow, media: &Media) {
    match media {
        Media::Builtin(name) => {
            table.insert(row.key, name.as_str().into());
            return;
        }
        Media::File(path) => {
            // Every system understands forward slashes.
            let path = path.to_string_lossy();
            let path = if cfg!(windows) { path.replace('\\', "/") } else { path.into_owned() };
            table.insert("file", path.into());
        }
        // The name that saving gives the copy, unless it is taken.
        Media::Picked(path) => {
            table.insert("file", path.file_name().unwrap_or_default().to_string_lossy().into_owned().into());
        }
        Media::Site { id, path } => {
            table.insert("site", path.as_str().into());
            if !id.is_empty() {
                table.insert("site_id", id.as_str().into());
            }
        }
    }
    if row.kind != InputKind::Texture {
        table.insert("kind", row.key.into());
    }
}
