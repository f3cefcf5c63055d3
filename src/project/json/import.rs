//! Shadertoy JSON to [`Project`].
//!
//! Three shapes come by: the site's own (`ver`, `info`, `renderpass`), the API's (that, wrapped in `Shader`), and a
//! list of the first. Spellings of both are read everywhere. A pass is known by its type and its output's id, never by
//! its name, which is free text.

use super::{
    form::{Object, RenderInput, RenderPass, RenderSampler, Scalar, Shader, Top},
    ids,
};
use crate::{
    diag::{Diagnostic, SourceMap, Span},
    project::{
        Channel, Filter, Info, Input, Media, Origin, Pass, PassId, Project, ProjectError, Sampler, SamplerRules,
        Source, Wrap, limits,
    },
};
use serde_json::{Map, Value};
use std::{
    collections::{HashMap, HashSet, VecDeque},
    path::PathBuf,
};

/// The `ver` that the site writes, and the only one that it reads.
const VERSION: &str = "0.1";

/// A project from `text`, whose file is called `name` in messages. The project's origin is [`Origin::Unsaved`].
/// Fails with [`ProjectError::Invalid`] for anything that is none of the three shapes.
pub fn import(text: &str, name: &str) -> Result<(Project, Vec<Diagnostic>), ProjectError> {
    read(text, name).map_err(|diagnostics| {
        let mut sources = SourceMap::default();
        sources.add(name, text);
        ProjectError::Invalid { what: name.to_owned(), diagnostics, sources }
    })
}

const EXPECTED: &str = "expected is a Shadertoy shader: an object with \"ver\", \"info\" and \"renderpass\", the \
    same inside \"Shader\", or a list of such objects";

fn read(text: &str, name: &str) -> Result<(Project, Vec<Diagnostic>), Vec<Diagnostic>> {
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    let skipped = text.len() - body.len();
    let at =
        |offset: usize, length: usize| Span::new(crate::diag::SourceId(0), skipped + offset..skipped + offset + length);
    // The key's place where it is found; the file's start where it is not.
    let at_key = |key: &str| body.find(&format!("\"{key}\"")).map_or(at(0, 0), |i| at(i, key.len() + 2));
    // `part` is a slice of `body`.
    let failed = |part: &str, what: &str, e: &serde_json::Error| {
        let begin = part.as_ptr() as usize - body.as_ptr() as usize;
        let message = e.to_string();
        let message = message.rsplit_once(" at line ").map_or(message.as_str(), |(m, _)| m);
        let place = at(begin + offset_of(part, e.line(), e.column()), 0);
        vec![Diagnostic::error(place, format!("{what}: {message}")).hint(EXPECTED)]
    };
    const NO_SHADER: &str = "not a Shadertoy shader";
    let mut warnings = Vec::new();
    let part: &str = match serde_json::from_str::<Top<'_>>(body).map_err(|e| failed(body, "not JSON", &e))? {
        Top::Object(object) if object.renderpass => body,
        Top::Object(Object { shader: Some(shader), .. }) => shader.get(),
        Top::Object(Object { error: Some(error), .. }) => {
            let said: Option<String> = serde_json::from_str(error.get()).ok();
            let said = said.as_deref().unwrap_or("no reason given");
            return Err(vec![
                Diagnostic::error(at_key("Error"), format!("this is the API's refusal, not a shader: {said}"))
                    .hint("ask the API again; a shader must be public + API to be had"),
            ]);
        }
        Top::Object(Object { keys, .. }) => {
            let keys: Vec<String> = keys.iter().map(|k| format!("\"{k}\"")).collect();
            let has =
                if keys.is_empty() { "is empty".into() } else { format!("has {}", crate::project::listed(&keys)) };
            return Err(vec![
                Diagnostic::error(at(0, 0), format!("{NO_SHADER}: the object {has}, and no \"renderpass\""))
                    .hint(EXPECTED),
            ]);
        }
        Top::List(None, _) => {
            return Err(vec![Diagnostic::error(at(0, 0), format!("{NO_SHADER}: the list is empty")).hint(EXPECTED)]);
        }
        Top::List(Some(first), count) => {
            if count > 1 {
                warnings.push(Diagnostic::warning(
                    at(0, 0),
                    format!("the file holds {count} shaders; the first one is read"),
                ));
            }
            first.get()
        }
        Top::Bare => {
            return Err(vec![Diagnostic::error(at(0, 0), format!("{NO_SHADER}: a bare value")).hint(EXPECTED)]);
        }
    };
    let shader: Shader<'_> = serde_json::from_str(part).map_err(|e| failed(part, NO_SHADER, &e))?;
    match shader.ver.as_ref().map(Scalar::text).as_deref() {
        Some(VERSION) => {}
        Some(other) => {
            return Err(vec![
                Diagnostic::error(at_key("ver"), format!("version \"{other}\" of the form is not known"))
                    .hint(format!("expected is \"ver\": \"{VERSION}\"")),
            ]);
        }
        None => {
            return Err(vec![
                Diagnostic::error(at(0, 0), "the shader has no \"ver\"")
                    .hint(format!("expected is \"ver\": \"{VERSION}\"")),
            ]);
        }
    }
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    let info = match shader.info.map(serde_json::value::RawValue::get) {
        None => Map::new(),
        Some(text) if text.len() as u64 > limits::JSON_INFO.bytes => {
            let message = format!("\"info\" is larger than {}", limits::JSON_INFO);
            return Err(vec![Diagnostic::error(at_key("info"), message).hint("take out what is not of the shader")]);
        }
        Some(text) => serde_json::from_str(text).map_err(|e| failed(text, NO_SHADER, &e))?,
    };
    let project = project(shader.renderpass.0, info, stem, &mut warnings).map_err(|mut d| {
        d.span = Some(at_key("renderpass"));
        vec![d]
    })?;
    // Warnings point into the JSON, which is none of the project's own texts: keep the words, drop the place.
    for warning in &mut warnings {
        warning.span = None;
    }
    Ok((project, warnings))
}

/// Byte offset of serde_json's line and column: both from 1, columns in bytes.
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
    // Reads of buffers in the order the site loads them, as (place in `passes`, channel).
    let mut reads: Vec<(usize, usize)> = Vec::new();
    for pass in passes_read {
        if pass.code.len() as u64 > limits::GLSL_TEXT.bytes {
            let message = format!("the code of a pass is larger than {}", limits::GLSL_TEXT);
            return Err(Diagnostic::error(None, message).hint("make it smaller"));
        }
        let id = match pass.r#type.as_str() {
            "common" => {
                if common.is_some() {
                    return Err(Diagnostic::error(None, "the shader has two Common passes").hint("remove one of them"));
                }
                common = Some(Source { name: "Common".into(), path: None, text: pass.code.into() });
                continue;
            }
            "image" => PassId::Image,
            "sound" => PassId::Sound,
            "cubemap" => PassId::Cubemap,
            "buffer" => PassId::Buffer(names.of_passes.pop_front().unwrap_or_default()),
            other => {
                return Err(Diagnostic::error(None, format!("a pass is of the unknown type \"{other}\""))
                    .hint("known are common, buffer, cubemap, sound and image"));
            }
        };
        if passes.iter().any(|p| p.id == id) {
            return Err(Diagnostic::error(None, format!("the shader has two passes named {}", id.title()))
                .hint("remove one of them"));
        }
        let mut channels: [Option<Channel>; 4] = Default::default();
        for input in pass.inputs.iter().flat_map(|inputs| &inputs.0) {
            if let Some((n, channel)) = channel(input, &id, &names, warnings) {
                if matches!(channel.input, Input::Buffer(_)) {
                    reads.push((passes.len(), n));
                }
                channels[n] = Some(channel);
            }
        }
        let source = Source { name: id.title(), path: None, text: pass.code.into() };
        passes.push(Pass { channels, ..Pass::new(id, source) });
    }
    if !passes.iter().any(|p| p.id == PassId::Image) {
        return Err(Diagnostic::error(None, "the shader has no Image pass")
            .hint("a renderpass of type \"image\" must be there"));
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
    let info = Info { id, author, description, tags, extra };
    Ok(Project { info, common, sampler_rules: SamplerRules::Site, ..Project::new(name, passes, Origin::Unsaved) })
}

/// On the site a buffer has one wrap, that of the channel loaded last in the order of the JSON's list. That order is
/// not kept (Image stands first in the list and is drawn last), so every channel gets the wrap that wins; pictures stay
/// the same, there and here.
fn settle_wraps(passes: &mut [Pass], reads: &[(usize, usize)]) {
    let mut wraps: HashMap<String, Wrap> = HashMap::new();
    for &(pass, n) in reads {
        if let Some(Channel { input: Input::Buffer(name), sampler }) = &passes[pass].channels[n] {
            wraps.insert(name.clone(), sampler.wrap);
        }
    }
    for channel in passes.iter_mut().flat_map(|p| p.channels.iter_mut().flatten()) {
        if let Input::Buffer(name) = &channel.input
            && let Some(wrap) = wraps.get(name)
        {
            channel.sampler.wrap = *wrap;
        }
    }
}

/// The names of the buffers.
struct BufferNames {
    /// The name of each pass of type "buffer", in the list's order.
    of_passes: VecDeque<String>,
    /// By an output's id that means nothing to the site.
    of_ids: HashMap<String, String>,
}

impl BufferNames {
    /// A buffer's name by its output's id. A pass whose id says nothing that is a name, or what another one already
    /// has, gets the first letter that no pass claims; what reads that id reads this pass.
    fn new(passes: &[RenderPass], warnings: &mut Vec<Diagnostic>) -> BufferNames {
        let outputs = |p: &RenderPass| -> Vec<String> {
            p.outputs.iter().flat_map(|o| &o.0).filter_map(|o| o.id.as_ref().map(Scalar::text)).collect()
        };
        let buffers: Vec<(&RenderPass, Vec<String>)> =
            passes.iter().filter(|p| p.r#type == "buffer").map(|p| (p, outputs(p))).collect();
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
                    // Never ends, and never gives one twice.
                    let name = free.next().unwrap_or_default();
                    let said = match (other, outputs.first()) {
                        (Some(other), _) => format!("writes Buffer {other}, as another pass does"),
                        (None, Some(id)) if !id.is_empty() => format!("writes the unknown id \"{}\"", shown(id)),
                        (None, _) => "does not say which buffer it writes".into(),
                    };
                    let message = format!("the pass \"{}\" {said}; it is read as Buffer {name}", shown(&pass.name));
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

/// A text of the file's in a message: not too long, and in one line.
fn shown(text: &str) -> String {
    text.chars().take(80).collect::<String>().escape_debug().to_string()
}

fn channel(
    input: &RenderInput,
    id: &PassId,
    names: &BufferNames,
    warnings: &mut Vec<Diagnostic>,
) -> Option<(usize, Channel)> {
    let number = input.channel.text();
    let Some(n) = number.parse::<usize>().ok().filter(|n| *n < 4) else {
        warnings.push(
            Diagnostic::warning(None, format!("{} has an input for iChannel{number}, which there is not", id.title()))
                .hint("a pass has iChannel0 to iChannel3; the input is left out"),
        );
        return None;
    };
    let kind = input.r#type.as_deref().or(input.ctype.as_deref()).unwrap_or_default();
    let path = input.filepath.as_deref().or(input.src.as_deref()).unwrap_or_default();
    let input_id = input.id.as_ref().map(Scalar::text).unwrap_or_default();
    let media = || media(&input_id, path);
    let read = match kind {
        "buffer" => match ids::buffer(&input_id)
            .or_else(|| names.of_ids.get(&input_id).cloned())
            .or_else(|| ids::buffer_of_preview(path))
        {
            Some(name) => Input::Buffer(name),
            None => {
                warnings.push(
                    Diagnostic::warning(
                        None,
                        format!(
                            "iChannel{n} of {} reads a buffer of the unknown id \"{}\"",
                            id.title(),
                            shown(&input_id)
                        ),
                    )
                    .hint("the channel is left empty and reads black"),
                );
                return None;
            }
        },
        "cubemap" if input_id == ids::CUBEMAP || path.contains("/previz/cubemap") => Input::CubemapPass,
        "cubemap" => Input::Cubemap(media()),
        "texture" => Input::Texture(media()),
        "volume" => Input::Volume(media()),
        "video" => Input::Video(media()),
        "music" | "musicstream" => Input::Music(media()),
        "keyboard" => Input::Keyboard,
        "mic" => Input::Microphone,
        "webcam" => Input::Webcam,
        other => {
            warnings.push(
                Diagnostic::warning(None, format!("iChannel{n} of {} is of the unknown type \"{other}\"", id.title()))
                    .hint("the channel is left empty and reads black"),
            );
            return None;
        }
    };
    let stored = input.sampler.as_ref();
    let word = |get: fn(&RenderSampler) -> Option<&String>| stored.and_then(get).map(|s| s.to_lowercase());
    let sampler = Sampler {
        filter: match word(|s| s.filter.as_ref()).as_deref() {
            Some("nearest") => Filter::Nearest,
            Some("mipmap") => Filter::Mipmap,
            _ => Filter::Linear,
        },
        // Whatever is not "clamp" repeats, on the site too.
        wrap: match word(|s| s.wrap.as_ref()).as_deref() {
            Some("clamp") | None => Wrap::Clamp,
            Some(_) => Wrap::Repeat,
        },
        vflip: stored.and_then(|s| s.vflip.as_ref()).is_none_or(|v| v.text() != "false"),
    };
    Some((n, Channel { input: read, sampler }))
}

/// A path of the site, or one that [`super::export`] wrote for a picture the site does not have.
fn media(id: &str, path: &str) -> Media {
    if let Some(name) = path.strip_prefix("builtin://").filter(|_| id.is_empty()) {
        Media::Builtin(name.to_owned())
    } else if let Some(file) = path.strip_prefix("file://").filter(|_| id.is_empty()) {
        Media::File(PathBuf::from(file))
    } else {
        Media::Site { id: id.to_owned(), path: path.to_owned() }
    }
}
