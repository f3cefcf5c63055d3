//! Reads `eddy.toml`. Every error is a diagnostic with a span, and all are reported at once.

use super::{
    VERSION, fills, geometry,
    reader::{Reader, silent},
    settings,
};
use crate::{
    Bindings, Body, Channel, Dialect, Filter, Info, Input, InputKind, InputSource, Loaded, MAX_CHANNELS, MAX_TARGETS,
    Media, Origin, Pass, PassName, Project, ProjectError, Role, SLOTS, SamplerRules, Source, Wrap,
    file_names::{self, FileRole},
    files::{Files, MANIFEST},
    includes, limits, listed, nearest,
};
use eddy_diag::{Diagnostic, SourceId, SourceMap};
use std::path::PathBuf;
use toml_edit::{Document, Item, TableLike};

const TOP: [&str; 15] = [
    "eddy",
    "name",
    "description",
    "author",
    "tags",
    "id",
    "period",
    "dialect",
    "sampler_rules",
    "uniforms",
    "controls",
    "common",
    "passes",
    "groups",
    "shadertoy",
];
/// Keys of inputs whose kind the key `kind` sets.
const PLACES: [&str; 2] = ["file", "site"];
const SETTINGS: [&str; 6] = ["filter", "wrap", "vflip", "kind", "site_id", "target"];

/// Builds the project that `text`, an `eddy.toml`, describes, with `files`. Errors of the author's are returned as
/// [`ProjectError::Invalid`].
pub(crate) fn project(
    what: &str,
    folder_name: String,
    text: &str,
    files: &Files<'_>,
    origin: Origin,
) -> Result<Loaded, ProjectError> {
    let mut reader =
        Reader { files, sources: SourceMap::default(), id: SourceId(0), diagnostics: Vec::new(), refused: None };
    // Until the project is complete, this is the only text that spans can point into.
    reader.id = reader.sources.add(MANIFEST, text);
    let project = reader.read(folder_name, text, origin);
    let Reader { mut diagnostics, sources: own, id, refused, .. } = reader;
    if let Some(error) = refused {
        return Err(error.into());
    }
    let Some(project) = project.filter(|_| !diagnostics.iter().any(Diagnostic::is_error)) else {
        return Err(ProjectError::Invalid { what: what.to_owned(), diagnostics, sources: own });
    };
    let mut sources = project.sources();
    let moved = sources.add(MANIFEST, text);
    for span in diagnostics.iter_mut().flat_map(|d| d.span.iter_mut().chain(d.labels.iter_mut().map(|l| &mut l.span))) {
        if span.source == id {
            span.source = moved;
        }
    }
    Ok(Loaded { project, warnings: diagnostics, sources })
}

impl Reader<'_> {
    fn read(&mut self, folder_name: String, text: &str, origin: Origin) -> Option<Project> {
        if limits::toml_values(text) > limits::MANIFEST_VALUES {
            let message = format!("eddy.toml has more than {} values, the limit", limits::MANIFEST_VALUES);
            self.error(None, message, "remove some of them, or move values into files");
            return None;
        }
        let document = match Document::parse(text) {
            Ok(document) => document,
            Err(e) => {
                self.error(e.span(), e.message().trim().replace('\n', ", "), "see https://toml.io for the TOML format");
                return None;
            }
        };
        let root = document.as_table();
        // A newer file may differ in anything: report its version once instead of every unknown key.
        match root.get("eddy") {
            Some(item) if item.as_integer().is_none_or(|v| v < 1) => {
                self.wrong_type("eddy", item, "a whole number from 1")
            }
            Some(item) if item.as_integer().is_some_and(|v| v > VERSION) => {
                self.error(
                    item.span(),
                    format!(
                        "this file has version {}; this version of Eddy reads up to {VERSION}",
                        item.as_integer().unwrap_or(0)
                    ),
                    "open it with a newer version of Eddy",
                );
                return None;
            }
            _ => {}
        }
        self.check_keys("eddy.toml", root, &[&TOP]);
        let name = self.string(root, "name").filter(|n| !n.trim().is_empty()).unwrap_or(folder_name);
        let info = Info {
            id: self.string(root, "id").unwrap_or_default(),
            author: self.string(root, "author").unwrap_or_default(),
            description: self.string(root, "description").unwrap_or_default(),
            tags: self.tags(root),
            period: self.seconds(root, "period"),
            extra: self.extra(root),
        };
        let sampler_rules = match self.one_of(root, "sampler_rules", &["channel", "site"]) {
            Some("site") => SamplerRules::Site,
            _ => SamplerRules::PerChannel,
        };
        let dialect = self.one_of(root, "dialect", &Dialect::ALL.map(Dialect::name)).and_then(Dialect::of);
        let common = self.common(root);
        let passes = self.passes(root);
        let groups = self.groups(root, &passes);
        let custom_uniform_values = self.uniforms(root);
        let controls = self.controls(root);
        let mut project = Project {
            name,
            info,
            dialect: dialect.unwrap_or_default(),
            common,
            passes,
            sampler_rules,
            groups,
            custom_uniform_values,
            controls,
            includes: Vec::new(),
            origin,
        };
        includes::read(&mut project, Some(self.files));
        self.check_uniforms(root, &project);
        self.check_controls(root, &project);
        Some(project)
    }

    fn common(&mut self, root: &dyn TableLike) -> Option<Source> {
        if let Some(item) = root.get("common") {
            if item.as_bool() == Some(false) {
                return None;
            }
            let table = self.table("common", item)?;
            self.check_keys("[common]", table, &[&["file"]]);
            let file = self.string(table, "file").unwrap_or_else(|| self.conventional(&FileRole::Common));
            let at = table.get("file").and_then(Item::span).or_else(|| item.span());
            return self.source(&file, "Common", at);
        }
        let file = self.conventional(&FileRole::Common);
        if self.files.exists(&file) { self.source(&file, "Common", None) } else { None }
    }

    /// The existing file of a role, whatever its case and extension; else the name for a new one.
    fn conventional(&self, role: &FileRole) -> String {
        let key = match role {
            FileRole::Common => "common",
            FileRole::Pass(id) => id.key(),
        };
        let plain = format!("{key}.glsl");
        if self.files.exists(&plain) {
            return plain;
        }
        let names = self.files.names().unwrap_or_default();
        names.into_iter().find(|n| file_names::role_of_file(n).as_ref() == Some(role)).unwrap_or(plain)
    }

    fn passes(&mut self, root: &dyn TableLike) -> Vec<Pass> {
        let mut passes: Vec<Pass> = Vec::new();
        let Some(item) = root.get("passes") else {
            self.error(None, "eddy.toml has no passes", "add a table [passes.image]");
            return passes;
        };
        let Some(table) = self.table("passes", item) else { return passes };
        for (name, item) in table.iter() {
            let at = table.key(name).and_then(toml_edit::Key::span).or_else(|| item.span());
            let Some(id) = file_names::pass_of_stem(name) else {
                let fixed: Vec<&str> =
                    Role::all().rev().map(Role::row).filter(|row| !row.is_named).map(|row| row.key).collect();
                let buffers = ["buffer_a", "buffer_b", "buffer_c", "buffer_d"];
                let hint = match nearest(name, fixed.iter().copied().chain(buffers)) {
                    Some(near) => format!("did you mean {near}?"),
                    None if name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | ' ')) => {
                        format!("a pass is {}, or buffer_ and a name", fixed.join(", "))
                    }
                    None => PassName::NAMES.to_owned(),
                };
                self.error(at, format!("there is no pass {}", name.escape_debug()), hint);
                continue;
            };
            if passes.len() == limits::PASSES {
                let message = format!("the project has more than {} passes, the limit", limits::PASSES);
                self.error(at, message, "split it into two projects");
                break;
            }
            if passes.iter().any(|p| p.id == id) {
                self.error(at, format!("a second pass named {}", id.title()), "rename or remove one of them");
                continue;
            }
            let Some(table) = self.table(name, item) else { continue };
            self.check_keys(
                &format!("[passes.{name}]"),
                table,
                &[&["file", "channels"], &settings::KEYS, &geometry::KEYS, &fills::KEYS],
            );
            let file = self.string(table, "file").or_else(|| geometry::own_file(table));
            let file = file.unwrap_or_else(|| self.conventional(&FileRole::Pass(id.clone())));
            let file_at = table.get("file").and_then(Item::span).or(at);
            let source = self.source(&file, &id.title(), file_at);
            let bindings = self.channels(table);
            let mut settings = self.settings(&id, table);
            let meshes = self.geometry(&id, table, &file, &mut settings);
            let body = meshes.map_or(Body::Screen, Body::Meshes);
            self.fills(&id, table, &body, &mut settings);
            if let Some(source) = source {
                passes.push(Pass { id, source, bindings, settings, body });
            }
        }
        if !table.iter().any(|(name, _)| file_names::pass_of_stem(name).is_some_and(|pass| pass.is_image())) {
            self.error(item.span(), "there is no Image pass", "add a table [passes.image]");
        }
        passes.sort_by(|a, b| a.id.drawing_order(&b.id));
        self.check_reads(table, &passes);
        self.check_targets(table, &passes);
        passes
    }

    /// Warns about channels that read a missing pass: legal, but probably a mistake.
    fn check_reads(&mut self, table: &dyn TableLike, passes: &[Pass]) {
        let mut found = Vec::new();
        for pass in passes {
            for (n, channel) in pass.bindings.iter() {
                let Some((missing, _)) = channel.input.target() else { continue };
                if passes.iter().any(|p| p.id == *missing) {
                    continue;
                }
                let item = table
                    .iter()
                    .find(|(key, _)| file_names::pass_of_stem(key).as_ref() == Some(&pass.id))
                    .and_then(|(_, item)| item.get("channels")?.get(n.to_string()));
                found.push((item.and_then(Item::span), pass.id.title(), n, missing));
            }
        }
        for (at, reader, n, missing) in found {
            let span = self.span(at);
            self.diagnostics.push(
                Diagnostic::warning(
                    span,
                    format!("iChannel{n} of {reader} reads {}, but the project has no such pass", missing.title()),
                )
                .hint(format!("it reads zero; add [passes.{}] or choose another", missing.key())),
            );
        }
    }

    /// Reports channels that read a target their pass does not have.
    fn check_targets(&mut self, table: &dyn TableLike, passes: &[Pass]) {
        for pass in passes {
            for (n, channel) in pass.bindings.iter() {
                let Some((id, index)) = channel.input.target() else { continue };
                let Some(read) = passes.iter().find(|p| p.id == *id) else { continue };
                let count = read.formats().len();
                if index < count {
                    continue;
                }
                let item = table
                    .iter()
                    .find(|(key, _)| file_names::pass_of_stem(key).as_ref() == Some(&pass.id))
                    .and_then(|(_, item)| item.get("channels")?.get(n.to_string())?.get("target"));
                let has = if count == 1 { "only target 0".into() } else { format!("targets 0 to {}", count - 1) };
                self.error(
                    item.and_then(Item::span),
                    format!(
                        "iChannel{n} of {} reads target {index} of {}, which has {has}",
                        pass.id.title(),
                        id.title()
                    ),
                    format!("choose an existing target, or add formats to targets of [passes.{}]", id.key()),
                );
            }
        }
    }

    fn channels(&mut self, pass: &dyn TableLike) -> Bindings {
        let mut channels = Bindings::default();
        let Some(table) = pass.get("channels").and_then(|item| self.table("channels", item)) else { return channels };
        for (number, item) in table.iter() {
            match number.parse::<usize>() {
                Ok(n) if n.to_string() == number && (n < SLOTS || n < MAX_CHANNELS && has_name(item)) => {
                    channels.set(n, self.channel(n, item));
                    let name =
                        item.as_table_like().filter(|_| has_name(item)).and_then(|table| self.string(table, NAME));
                    if let Some(name) = name {
                        channels.set_name(n, &name);
                    }
                }
                _ => {
                    let at = table.key(number).and_then(toml_edit::Key::span).or_else(|| item.span());
                    let hint = "a pass has channels 0 to 3, and with the names of samplers channels 0 to 15";
                    self.error(at, format!("there is no channel {number}"), hint);
                }
            }
        }
        channels
    }

    fn channel(&mut self, n: usize, item: &Item) -> Option<Channel> {
        let table = self.table(&format!("channels.{n}"), item)?;
        let inputs: Vec<&str> = InputKind::all().map(|kind| kind.row().key).chain(PLACES).collect();
        self.check_keys(&format!("channel {n}"), table, &[&inputs, &SETTINGS, &[NAME]]);
        let named: Vec<&str> = table.iter().map(|(k, _)| k).filter(|k| inputs.contains(k)).collect();
        let &[key] = named.as_slice() else {
            let message = if named.is_empty() {
                format!("channel {n} has no input")
            } else {
                format!("channel {n} reads {} at once", listed(&named))
            };
            self.error(item.span(), message, format!("use one of {}", listed(&inputs)));
            return None;
        };
        let media = InputKind::all().map(InputKind::row).filter(|row| row.source == InputSource::Media);
        let kind = self.one_of(table, "kind", &media.map(|row| row.key).collect::<Vec<_>>());
        if kind.is_some() && !PLACES.contains(&key) {
            let at = table.get("kind").and_then(Item::span);
            self.error(at, "kind belongs to file or site only", "remove it");
        }
        if key != "buffer"
            && let Some(item) = table.get("target")
        {
            self.error(item.span(), "target belongs to buffer only", "remove it");
        }
        let kind = kind.filter(|_| PLACES.contains(&key)).unwrap_or(key);
        let kind = InputKind::find(|row| row.key == kind).unwrap_or(InputKind::Texture);
        let input = match (key, kind.row().source) {
            ("file", _) => Input::Media { kind, media: Media::File(PathBuf::from(self.string(table, key)?)) },
            ("site", _) => {
                let path = self.string(table, key)?;
                let id = self.string(table, "site_id").unwrap_or_default();
                Input::Media { kind, media: Media::Site { id, path } }
            }
            (_, InputSource::Media) => Input::Media { kind, media: Media::Builtin(self.string(table, key)?) },
            (_, InputSource::Pass | InputSource::Device) => match kind.unnamed() {
                Some(input) => self.boolean(table, key)?.then_some(input)?,
                None => self.buffer(table, key)?,
            },
        };
        let mut sampler = input.row().sampler;
        match self.one_of(table, "filter", &["nearest", "linear", "mipmap"]) {
            Some("nearest") => sampler.filter = Filter::Nearest,
            Some("linear") => sampler.filter = Filter::Linear,
            Some(_) => sampler.filter = Filter::Mipmap,
            None => {}
        }
        match self.one_of(table, "wrap", &["clamp", "repeat"]) {
            Some("clamp") => sampler.wrap = Wrap::Clamp,
            Some(_) => sampler.wrap = Wrap::Repeat,
            None => {}
        }
        if table.contains_key("vflip") {
            sampler.vflip = self.boolean(table, "vflip")?;
        }
        Some(Channel { input, sampler })
    }

    /// Returns the buffer that a channel names; the cubemap pass may be named the same way.
    fn buffer(&mut self, channel: &dyn TableLike, key: &str) -> Option<Input> {
        let name = self.string(channel, key)?;
        match PassName::parse(&name) {
            Some(id) if id.is_buffer() => Some(Input::Pass { id, target: self.target(channel)? }),
            Some(id) if id.is_readable() => Some(Input::pass(id)),
            _ => {
                let at = channel.get(key).and_then(Item::span);
                self.error(at, format!("\"{name}\" is not a buffer"), "write a buffer pass: buffer = \"A\"");
                None
            }
        }
    }

    /// Returns the target of a buffer that a channel reads. `None` if it is invalid.
    fn target(&mut self, channel: &dyn TableLike) -> Option<usize> {
        let Some(item) = channel.get("target") else { return Some(0) };
        let index = item.as_integer().and_then(|n| usize::try_from(n).ok()).filter(|n| *n < MAX_TARGETS);
        if index.is_none() {
            self.wrong_type("target", item, "a whole number from 0 to 3");
        }
        index
    }

    fn tags(&mut self, root: &dyn TableLike) -> Vec<String> {
        let Some(item) = root.get("tags") else { return Vec::new() };
        let tags: Option<Vec<String>> =
            item.as_array().and_then(|a| a.iter().map(|v| v.as_str().map(str::to_owned)).collect());
        tags.unwrap_or_else(|| {
            self.wrong_type("tags", item, "a list of strings");
            Vec::new()
        })
    }

    /// `[shadertoy] info = '{…}'`: JSON inside TOML, because TOML has no null and different numbers.
    fn extra(&mut self, root: &dyn TableLike) -> serde_json::Map<String, serde_json::Value> {
        let Some(table) = root.get("shadertoy").and_then(|item| self.table("shadertoy", item)) else {
            return serde_json::Map::default();
        };
        self.check_keys("[shadertoy]", table, &[&["info"]]);
        let Some(text) = self.string(table, "info") else { return serde_json::Map::default() };
        if text.len() as u64 > limits::JSON_INFO.bytes {
            let at = table.get("info").and_then(Item::span);
            self.error(at, format!("info is larger than {}", limits::JSON_INFO), "remove the table [shadertoy]");
            return serde_json::Map::default();
        }
        serde_json::from_str(&text).unwrap_or_else(|e| {
            let at = table.get("info").and_then(Item::span);
            self.error(at, format!("info is not a JSON object: {e}"), "fix it, or remove the table [shadertoy]");
            serde_json::Map::default()
        })
    }
}

/// The channel of an entry of `channels`, if the entry is valid.
pub(super) fn channel(item: &Item) -> Option<Channel> {
    silent(|reader| reader.channel(0, item)).flatten()
}

/// The key of a channel with the name that the text gives its sampler.
pub(super) const NAME: &str = "name";

fn has_name(item: &Item) -> bool {
    item.get(NAME).is_some()
}
