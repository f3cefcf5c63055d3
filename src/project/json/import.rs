//! Imports Shadertoy JSON as a [`Project`].
//!
//! There are four formats: Shadertoy's own (`ver`, `info`, `renderpass`), the API's (the same, wrapped in `Shader`), a
//! list of either, and the file that a profile's page exports (`shaders`, a list). The spellings of all are accepted
//! everywhere. A pass is identified by its type and its output's id, never by its name, which is free text.

use super::{
    form::{BoundedList, Object, RenderInput, RenderPass, RenderSampler, RootContent, Scalar, Shader, Shaders, shown},
    ids,
    parsed::readable,
    several,
};
use crate::{
    Bindings, Channel, Filter, Info, Input, InputKind, InputRow, InputSource, Media, Origin, Pass, PassName, Project,
    ProjectError, Role, SLOTS, Sampler, SamplerRules, Source, Wrap, limits, listed,
};
use eddy_diag::{Diagnostic, SourceMap, Span};
use serde_json::{Map, Value, value::RawValue};
use std::{
    collections::{BTreeMap, HashMap, HashSet, VecDeque},
    path::PathBuf,
};

/// The type of the text that precedes every pass.
const COMMON: &str = "common";

/// The `ver` that Shadertoy writes, and the only one that it reads.
const VERSION: &str = "0.1";

/// Imports a project from `text`, whose file is called `name` in messages. The project's origin is [`Origin::Unsaved`].
/// Fails with [`ProjectError::Invalid`] if the text has none of the four formats. Of several shaders the first is read.
pub fn import(text: &str, name: &str) -> Result<(Project, Vec<Diagnostic>), ProjectError> {
    import_one(text, name, None)
}

/// Does the same as [`import`], with the shader that the user selected of several, by its id, its number from 1 or its
/// name.
pub fn import_one(text: &str, name: &str, wanted: Option<&str>) -> Result<(Project, Vec<Diagnostic>), ProjectError> {
    read(text, name, wanted).map_err(|diagnostics| {
        let mut sources = SourceMap::default();
        sources.add(name, text);
        ProjectError::Invalid { what: name.to_owned(), diagnostics, sources }
    })
}

/// Returns whether a file contains more than one shader.
pub fn holds_several(text: &str) -> bool {
    let body = readable(text.strip_prefix('\u{feff}').unwrap_or(text));
    match serde_json::from_str(&body) {
        Ok(RootContent::List(shaders)) => shaders.count > 1,
        Ok(RootContent::Object(Object { renderpass: false, shader: None, shaders: Some(list), .. })) => {
            serde_json::from_str::<Shaders<'_>>(list.get()).is_ok_and(|shaders| shaders.count > 1)
        }
        _ => false,
    }
}

const EXPECTED: &str = "expected a Shadertoy shader: an object with \"ver\", \"info\" and \"renderpass\", the same \
                        inside \"Shader\", or a list of such objects, also inside \"shaders\"";
const NO_SHADER: &str = "not a Shadertoy shader";

fn read(text: &str, name: &str, wanted: Option<&str>) -> Result<(Project, Vec<Diagnostic>), Vec<Diagnostic>> {
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    let skipped = text.len() - body.len();
    let body = &*readable(body);
    let at =
        |offset: usize, length: usize| Span::new(eddy_diag::SourceId(0), skipped + offset..skipped + offset + length);
    // `part` is a slice of `body`.
    let offset_in_body = |part: &str| part.as_ptr() as usize - body.as_ptr() as usize;
    // The offset of the key if it is found, else the start of the part.
    let at_key = |part: &str, key: &str| {
        let part_start = offset_in_body(part);
        part.find(&format!("\"{key}\"")).map_or(at(part_start, 0), |i| at(part_start + i, key.len() + 2))
    };
    let failed = |part: &str, what: &str, e: &serde_json::Error| {
        let message = e.to_string();
        let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(m, _)| m);
        let place = at(offset_in_body(part) + offset_of(part, e.line(), e.column()), 0);
        let hint = if body.trim_start().starts_with('<') {
            "this is a web page; save the export of Shadertoy or the answer of its API"
        } else {
            EXPECTED
        };
        vec![Diagnostic::error(place, format!("{what}: {message}")).hint(hint)]
    };
    let refuse = |place: Span, message: String, hint: &str| Err(vec![Diagnostic::error(place, message).hint(hint)]);
    let mut warnings = Vec::new();
    let mut part: &str = body;
    let mut is_chosen = false;
    // A list may contain API responses, each in its own wrapper.
    let shader = loop {
        let list = match serde_json::from_str::<RootContent<'_>>(part).map_err(|e| failed(part, "not JSON", &e))? {
            RootContent::Object(object) if object.renderpass => {
                break serde_json::from_str::<Shader<'_>>(part).map_err(|e| failed(part, NO_SHADER, &e))?;
            }
            RootContent::Object(Object { shader: Some(shader), .. }) => {
                part = shader.get();
                break serde_json::from_str::<Shader<'_>>(part).map_err(|e| failed(part, NO_SHADER, &e))?;
            }
            RootContent::Object(Object { shaders: Some(list), .. }) if !is_chosen => {
                part = list.get();
                serde_json::from_str::<Shaders<'_>>(part).map_err(|e| failed(part, NO_SHADER, &e))?
            }
            RootContent::List(list) if !is_chosen => list,
            RootContent::Object(Object { error: Some(error), .. }) => {
                let said = serde_json::from_str(error.get()).unwrap_or_else(|_| shown(error.get()));
                let said = if said.trim().is_empty() || said == "null" { "no reason given".to_owned() } else { said };
                let message = format!("this is an error of the API, not a shader: {}", shown(&said));
                return refuse(at_key(part, "Error"), message, "request it again; the shader must be public + API");
            }
            RootContent::Object(Object { keys, .. }) if keys.iter().any(|k| k == "Results") => {
                let message = "this is a list of ids, not a shader".to_owned();
                return refuse(at_key(part, "Results"), message, "request one of them from the API");
            }
            RootContent::Object(Object { keys, .. }) => {
                let keys: Vec<String> = keys.iter().map(|k| format!("\"{}\"", shown(k))).collect();
                let has = if keys.is_empty() { "is empty".into() } else { format!("has {}", crate::listed(&keys)) };
                let message = format!("{NO_SHADER}: the object {has}, and no \"renderpass\"");
                return refuse(at(offset_in_body(part), 0), message, EXPECTED);
            }
            RootContent::List(_) => {
                return refuse(at(offset_in_body(part), 0), format!("{NO_SHADER}: a list within a list"), EXPECTED);
            }
            RootContent::Bare => {
                return refuse(at(offset_in_body(part), 0), format!("{NO_SHADER}: a bare value"), EXPECTED);
            }
        };
        part = match several::choose(&list, name, wanted, &mut warnings) {
            Ok(one) => one.get(),
            Err((message, hint)) => return refuse(at(offset_in_body(part), 0), message, &hint),
        };
        is_chosen = true;
    };
    match shader.ver.as_ref().map(Scalar::text).as_deref() {
        Some(VERSION) => {}
        Some(other) => {
            return refuse(
                at_key(part, "ver"),
                format!("unknown format version \"{}\"", shown(other)),
                &format!("expected \"ver\": \"{VERSION}\""),
            );
        }
        None => warnings.push(
            Diagnostic::warning(None, format!("the shader has no \"ver\"; it is read as version {VERSION}"))
                .hint(format!("Shadertoy itself requires \"ver\": \"{VERSION}\"")),
        ),
    }
    if let (Some(wanted), false) = (wanted, is_chosen)
        && !several::is_called(part, 1, wanted)
    {
        let message = format!("the file has one shader, and it is not {}", shown(wanted));
        return refuse(at(0, 0), message, &format!("use the file name alone: {name}"));
    }
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let info = match shader.info.map(RawValue::get) {
        None => Map::new(),
        Some(text) if text.len() as u64 > limits::JSON_INFO.bytes => {
            let message = format!("\"info\" is larger than {}", limits::JSON_INFO);
            return refuse(at_key(part, "info"), message, "remove what does not belong to the shader");
        }
        Some(text) => members(text, &mut warnings).map_err(|e| failed(text, NO_SHADER, &e))?,
    };
    let Some(BoundedList(passes)) = shader.renderpass else {
        return refuse(at_key(part, "renderpass"), format!("{NO_SHADER}: \"renderpass\" is null"), EXPECTED);
    };
    let project = project(passes, info, stem, &mut warnings).map_err(|mut d| {
        d.span = Some(at_key(part, "renderpass"));
        vec![d]
    })?;
    // Warnings point into the JSON, which is not one of the project's texts: keep the messages, drop the spans.
    for warning in &mut warnings {
        warning.span = None;
    }
    Ok((project, warnings))
}

/// Parses the members of `info`, the metadata of a shader. A member that nests more deeply than serde_json reads is
/// omitted.
fn members(text: &str, warnings: &mut Vec<Diagnostic>) -> Result<Map<String, Value>, serde_json::Error> {
    let raw: BTreeMap<String, &RawValue> = serde_json::from_str(text)?;
    let mut all = Map::new();
    for (key, value) in raw {
        match serde_json::from_str(value.get()) {
            Ok(value) => drop(all.insert(key, value)),
            Err(_) => warnings.push(
                Diagnostic::warning(
                    None,
                    format!("\"{}\" in \"info\" is nested too deeply and is left out", shown(&key)),
                )
                .hint("the picture does not depend on it"),
            ),
        }
    }
    Ok(all)
}

/// The byte offset of serde_json's line and column: both from 1, columns in bytes.
fn offset_of(text: &str, line: usize, column: usize) -> usize {
    let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let mut offset = (start + column.saturating_sub(1)).min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

fn project(
    passes_read: Vec<RenderPass>,
    info: Map<String, Value>,
    stem: &str,
    warnings: &mut Vec<Diagnostic>,
) -> Result<Project, Diagnostic> {
    let mut names = BufferNames::new(&passes_read, warnings);
    let mut common: Option<Source> = None;
    let mut passes: Vec<Pass> = Vec::new();
    // Reads of buffers in the order in which Shadertoy loads them, as (index in `passes`, channel).
    let mut reads: Vec<(usize, usize)> = Vec::new();
    let mut covered = covered_images(&passes_read, warnings);
    for pass in passes_read {
        let kind = kind(&pass)?;
        let Some(code) = pass.code else {
            return Err(Diagnostic::error(None, format!("a pass of type \"{kind}\" has no \"code\""))
                .hint("\"code\" is the GLSL code of the pass"));
        };
        if code.len() as u64 > limits::GLSL_TEXT.bytes {
            let message = format!("the code of a pass is larger than {}", limits::GLSL_TEXT);
            return Err(Diagnostic::error(None, message).hint("shorten it"));
        }
        if kind == COMMON {
            if common.is_some() {
                return Err(Diagnostic::error(None, "the shader has two Common passes").hint("remove one of them"));
            }
            common = Some(Source { name: "Common".into(), path: None, text: code.into() });
            continue;
        }
        let Some(known) = Role::find(|row| row.json_type == kind) else {
            let message = format!("a pass has the unknown type \"{}\"", shown(&kind));
            return Err(Diagnostic::error(None, message).hint(types()));
        };
        let buffer = || PassName::buffer(names.of_passes.pop_front().unwrap_or_default());
        let id = known.only_pass().unwrap_or_else(buffer);
        if id.is_image() && covered > 0 {
            covered -= 1;
            continue;
        }
        if passes.iter().any(|p| p.id == id) {
            return Err(Diagnostic::error(None, format!("the shader has two passes named {}", id.title()))
                .hint("remove one of them"));
        }
        let mut bindings = Bindings::default();
        for input in pass.inputs.iter().flat_map(|inputs| &inputs.0) {
            if let Some((n, channel)) = channel(input, &id, &names, warnings) {
                if channel.input.buffer_name().is_some() {
                    reads.push((passes.len(), n));
                }
                bindings.set(n, Some(channel));
            }
        }
        let source = Source { name: id.title(), path: None, text: code.into() };
        passes.push(Pass { bindings, ..Pass::new(id, source) });
    }
    if !passes.iter().any(|p| p.id.is_image()) {
        return Err(Diagnostic::error(None, "the shader has no Image pass").hint("add a renderpass of type \"image\""));
    }
    settle_wraps(&mut passes, &reads);
    passes.sort_by(|a, b| a.id.drawing_order(&b.id));
    let mut extra = info;
    let mut take = |key: &str| match extra.remove(key) {
        Some(Value::String(text)) => text,
        None | Some(Value::Null) => String::new(),
        Some(other) => other.to_string(),
    };
    let (id, name, author, description) = (take("id"), take("name"), take("username"), take("description"));
    let tags = match extra.remove("tags") {
        Some(Value::Array(tags)) => {
            tags.into_iter().map(|t| t.as_str().map_or_else(|| t.to_string(), str::to_owned)).collect()
        }
        Some(Value::String(tags)) => tags.split(',').map(|t| t.trim().to_owned()).filter(|t| !t.is_empty()).collect(),
        _ => Vec::new(),
    };
    let name = if name.trim().is_empty() { stem.to_owned() } else { name };
    let info = Info { id, author, description, tags, period: None, extra };
    Ok(Project { info, common, sampler_rules: SamplerRules::Site, ..Project::new(name, passes, Origin::Unsaved) })
}

/// Returns the number of Image passes that the last one covers. Shadertoy draws all of them into its canvas, in file
/// order.
fn covered_images(passes: &[RenderPass], warnings: &mut Vec<Diagnostic>) -> usize {
    let is_image = |pass: &&RenderPass| kind(pass).is_ok_and(|kind| kind == Role::Image.row().json_type);
    let count = passes.iter().filter(is_image).count();
    if count > 1 {
        let message = format!("the shader has {count} Image passes; only the last one is read");
        let hint = "on Shadertoy it is drawn over the others; move what you need of them into a buffer";
        warnings.push(Diagnostic::warning(None, message).hint(hint));
    }
    count.saturating_sub(1)
}

/// Returns the type of a pass, in lower case. Without a type it is derived from a name in Shadertoy's form: "Buf A".
fn kind(pass: &RenderPass) -> Result<String, Diagnostic> {
    if let Some(kind) = &pass.r#type {
        return Ok(kind.trim().to_lowercase());
    }
    let name = pass.name.as_ref().map(Scalar::text).unwrap_or_default();
    let is_called_buffer = || name.trim().to_lowercase().starts_with("buf");
    match PassName::parse(&name) {
        _ if name.trim().eq_ignore_ascii_case(COMMON) => Ok(COMMON.to_owned()),
        Some(id) if !id.is_buffer() || is_called_buffer() => Ok(id.row().json_type.to_owned()),
        _ => {
            let message = format!("the pass \"{}\" has no \"type\"", shown(&name));
            Err(Diagnostic::error(None, message).hint(types()))
        }
    }
}

/// Lists the types of passes.
fn types() -> String {
    let types: Vec<&str> = [COMMON].into_iter().chain(Role::all().map(|kind| kind.row().json_type)).collect();
    format!("the types are {}", listed(&types))
}

/// On Shadertoy a buffer has one wrap mode, that of the channel loaded last in the order of the JSON's list. That order
/// is not kept (Image is first in the list and is drawn last), so every channel gets the wrap mode that wins; the
/// pictures are the same on Shadertoy and in Eddy.
fn settle_wraps(passes: &mut [Pass], reads: &[(usize, usize)]) {
    let mut wraps: HashMap<PassName, Wrap> = HashMap::new();
    for &(pass, n) in reads {
        if let Some(Channel { input: Input::Pass { id, .. }, sampler }) = passes[pass].bindings.get(n) {
            wraps.insert(id.clone(), sampler.wrap);
        }
    }
    for channel in passes.iter_mut().flat_map(|p| p.bindings.channels_mut()) {
        if let Input::Pass { id, .. } = &channel.input
            && let Some(wrap) = wraps.get(id)
        {
            channel.sampler.wrap = *wrap;
        }
    }
}

/// The names of the buffers.
struct BufferNames {
    /// The name of each pass of type "buffer", in list order.
    of_passes: VecDeque<String>,
    /// Names by the ids of outputs that Shadertoy does not know.
    of_ids: HashMap<String, String>,
}

impl BufferNames {
    /// Returns the buffer names by output id. A pass whose id does not specify a name, or specifies a name that is
    /// taken, gets the first unused letter; inputs with that id read this pass.
    fn new(passes: &[RenderPass], warnings: &mut Vec<Diagnostic>) -> BufferNames {
        let outputs = |p: &RenderPass| -> Vec<String> {
            p.outputs.iter().flat_map(|o| &o.0).filter_map(|o| o.id.as_ref().map(Scalar::text)).collect()
        };
        let buffers: Vec<(&RenderPass, Vec<String>)> = passes
            .iter()
            .filter(|p| kind(p).is_ok_and(|kind| kind == Role::Buffer.row().json_type))
            .map(|p| (p, outputs(p)))
            .collect();
        let claims: Vec<Option<String>> =
            buffers.iter().map(|(_, ids)| ids.iter().find_map(|i| ids::buffer(i))).collect();
        let claimed: HashSet<&String> = claims.iter().flatten().collect();
        let mut taken: HashSet<String> = HashSet::new();
        let mut names = BufferNames { of_passes: VecDeque::new(), of_ids: HashMap::new() };
        let letters = ('A'..='Z').map(String::from);
        let mut free = letters.chain((1..).map(|n| format!("n{n}"))).filter(|name| !claimed.contains(name));
        for ((pass, outputs), own) in buffers.iter().zip(&claims) {
            let name = match own {
                Some(name) if !taken.contains(name) => name.clone(),
                other => {
                    // The iterator never ends, and never repeats a name.
                    let name = free.next().unwrap_or_default();
                    let said = match (other, outputs.first()) {
                        (Some(other), _) => format!("writes Buffer {other}, as another pass does"),
                        (None, Some(id)) if !id.is_empty() => format!("writes to the unknown id \"{}\"", shown(id)),
                        (None, _) => "has no output buffer".into(),
                    };
                    let message = format!(
                        "the pass \"{}\" {said}; it is read as Buffer {name}",
                        shown(&pass.name.as_ref().map(Scalar::text).unwrap_or_default())
                    );
                    let hint = "give every buffer pass an output id of its own";
                    warnings.push(Diagnostic::warning(None, message).hint(hint));
                    if other.is_none() {
                        names
                            .of_ids
                            .extend(outputs.iter().filter(|i| !i.is_empty()).map(|i| (i.clone(), name.clone())));
                    }
                    name
                }
            };
            taken.insert(name.clone());
            names.of_passes.push_back(name);
        }
        names
    }
}

fn channel(
    input: &RenderInput,
    id: &PassName,
    names: &BufferNames,
    warnings: &mut Vec<Diagnostic>,
) -> Option<(usize, Channel)> {
    let number = input.channel.as_ref().map(Scalar::text).unwrap_or_default();
    let Some(n) = number.parse::<f64>().ok().filter(|n| n.fract() == 0.0 && (0.0..SLOTS as f64).contains(n)) else {
        let message = match &*number {
            "" => format!("{} has an input without a \"channel\"", id.title()),
            _ => format!("{} has an input for iChannel{}, which does not exist", id.title(), shown(&number)),
        };
        warnings
            .push(Diagnostic::warning(None, message).hint("a pass has iChannel0 to iChannel3; the input is left out"));
        return None;
    };
    let n = n as usize;
    let kind = input.r#type.as_deref().or(input.ctype.as_deref()).unwrap_or_default();
    let path = input.filepath.as_deref().or(input.src.as_deref()).unwrap_or_default();
    let input_id = input.id.as_ref().map(Scalar::text).unwrap_or_default();
    let mut unknown = |message: String| {
        warnings.push(Diagnostic::warning(None, message).hint("the channel is left empty and reads black"));
    };
    let Some(found) = input_kind(kind, &input_id, path) else {
        unknown(format!("iChannel{n} of {} has the unknown type \"{}\"", id.title(), shown(kind)));
        return None;
    };
    let buffer = || {
        let of_ids = || names.of_ids.get(&input_id).cloned();
        ids::buffer(&input_id).or_else(of_ids).or_else(|| ids::buffer_of_preview(path)).map(Input::buffer)
    };
    let read = match found.row().source {
        InputSource::Media => Some(Input::Media { kind: found, media: media(&input_id, path) }),
        InputSource::Pass | InputSource::Device => found.unnamed().or_else(buffer),
    };
    let Some(read) = read else {
        unknown(format!("iChannel{n} of {} reads a buffer of the unknown id \"{}\"", id.title(), shown(&input_id)));
        return None;
    };
    let stored = input.sampler.as_ref();
    let word = |get: fn(&RenderSampler) -> Option<&String>| stored.and_then(get).map(|s| s.to_lowercase());
    let sampler = Sampler {
        filter: match word(|s| s.filter.as_ref()).as_deref() {
            Some("nearest") => Filter::Nearest,
            Some("mipmap") => Filter::Mipmap,
            _ => Filter::Linear,
        },
        // Any value other than "clamp" means repeat, on Shadertoy too.
        wrap: match word(|s| s.wrap.as_ref()).as_deref() {
            Some("clamp") | None => Wrap::Clamp,
            Some(_) => Wrap::Repeat,
        },
        vflip: stored.and_then(|s| s.vflip.as_ref()).is_none_or(|v| v.text() != "false"),
    };
    Some((n, Channel { input: read, sampler }))
}

/// Returns the kind of an input. Cubemaps from a file and from a pass have the same type.
fn input_kind(json_type: &str, id: &str, path: &str) -> Option<InputKind> {
    let is_pass = |row: &InputRow| row.json_id.is_none_or(|(own, _)| own == id || path.contains("/previz/cubemap"));
    InputKind::find(|row| {
        let is_type = row.json_type == json_type || row.json_stream_type == Some(json_type);
        is_type && (row.source != InputSource::Pass || is_pass(row))
    })
}

/// A path on Shadertoy, or one that [`super::export`] wrote for a picture that Shadertoy does not have.
fn media(id: &str, path: &str) -> Media {
    if let Some(name) = path.strip_prefix("builtin://").filter(|_| id.is_empty()) {
        Media::Builtin(name.to_owned())
    } else if let Some(file) = path.strip_prefix("file://").filter(|_| id.is_empty()) {
        Media::File(PathBuf::from(file))
    } else {
        Media::Site { id: id.to_owned(), path: path.to_owned() }
    }
}
