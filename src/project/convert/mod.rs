//! Converts a project that is written for another program, as complete fragment shaders, to Shadertoy's form.
//!
//! Each pass becomes one with `mainImage`, with the files that it includes. What the program sets is a variable that
//! `mainImage` sets first, so that names keep their scopes; textures are renamed to `iChannel0` and so on. The text is
//! changed by its words, without parsing: [`groups`] leaves out what other passes compile, [`tokens`] splits it,
//! [`declarations`] finds what it declares at file scope, [`renames`] chooses new names, [`text`] writes a pass.
//! Conversions of whole numbers to floats that GLSL ES does not have are left to the compiler's fixes.

mod declarations;
mod groups;
mod renames;
mod text;
mod tokens;
mod values;
mod words;

#[cfg(test)]
mod tests;

use super::{
    Bindings, Channel, Dialect, Input, Origin, Pass, PassName, Project, Source, limits, lines::hash_lines, listed,
    words::names_word,
};
use eddy_diag::{SourceId, Span};
use renames::{FreeNames, Renames};
use std::collections::{BTreeMap, BTreeSet};
use text::Context;

/// A project in Shadertoy's form.
#[derive(Clone, Debug, PartialEq)]
pub struct Converted {
    /// It is not on disk, and its image files are relative to the folder of the original.
    pub project: Project,
    /// Sentences about what differs from the original.
    pub notes: Vec<String>,
}

/// The reason why a project cannot be converted to Shadertoy's form.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ConversionError {
    #[error("the project is Shadertoy's already")]
    IsShadertoy,
    #[error("a shader for {0} reads uniforms that Shadertoy does not have; its code has Shadertoy's form already")]
    IsOfHost(&'static str),
    #[error(
        "{} reads {} textures, and a pass of Shadertoy at most {}: {}",
        pass.title(), textures.len(), super::SLOTS, listed(textures)
    )]
    TooManyTextures { pass: PassName, textures: Vec<String> },
    #[error("{} draws meshes, and Shadertoy has no such pass", .0.title())]
    Meshes(PassName),
    #[error("with all included files the code has more than {}, the limit", limits::in_bytes(limits::ALL_TEXTS.bytes))]
    TooLarge,
    #[error("{0}")]
    Include(String),
}

/// Converts a project to Shadertoy's form.
pub fn to_shadertoy(project: &Project) -> Result<Converted, ConversionError> {
    match project.dialect {
        Dialect::Shadertoy => return Err(ConversionError::IsShadertoy),
        dialect if !dialect.has_main() => return Err(ConversionError::IsOfHost(dialect.row().title)),
        _ => {}
    }
    if let Some(pass) = project.passes.iter().find(|pass| !pass.body.is_screen()) {
        return Err(ConversionError::Meshes(pass.id.clone()));
    }
    let texts = inlined(project)?;
    let common = project.common.as_ref().map(|common| used_of_common(&common.text, &texts));
    let own: Vec<&str> = common.iter().chain(&texts).map(String::as_str).collect();
    let cx = Context {
        project,
        row: project.dialect.row(),
        free: FreeNames::new(own.iter().copied()),
        sliders: project.custom_uniforms().list,
        version: version(project),
        common: common.iter().flat_map(|text| crate::words::all_words(text)).map(str::to_owned).collect(),
    };
    let names = buffer_names(project);
    let mut notes = Notes::default();
    let mut passes = Vec::new();
    for (pass, text) in project.passes.iter().zip(&texts) {
        passes.push(converted_pass(&cx, pass, text, &names, &mut notes)?);
    }
    let mut made = Project::new(project.name.clone(), passes, Origin::Unsaved);
    made.info = project.info.clone();
    made.common = common
        .as_ref()
        .map(|text| text::common(&cx, text))
        .filter(|text| !text.trim().is_empty())
        .map(|text| Source { name: "Common".into(), path: None, text: text.into() });
    made.groups = project.groups.clone();
    for name in made.groups.iter_mut().flat_map(|group| &mut group.passes) {
        rename(name, &names);
    }
    values(&cx, &mut made);
    notes.passes(&made);
    Ok(Converted { project: made, notes: notes.all })
}

/// Returns the text of each pass with the files that it includes.
fn inlined(project: &Project) -> Result<Vec<String>, ConversionError> {
    let lines = project.include_lines();
    if let Some(error) = lines.diagnostics.first() {
        return Err(ConversionError::Include(error.message.clone()));
    }
    let sources = project.texts();
    let mut all = Vec::new();
    for index in 0..project.passes.len() {
        let id = Project::pass_id(index);
        let mut text = String::new();
        let mut inserted = project.dialect.row().includes_once.then(BTreeSet::new);
        inline(id, &lines.lines, &sources, &mut inserted, &mut text)?;
        let text = if project.dialect == Dialect::GlslViewer { groups::of_pass(&text) } else { text };
        all.push(without_unused_macros(&text, &project.passes[index].source.text));
    }
    Ok(all)
}

/// Returns a text without the macros at its start that nothing names, of those that `generated`, the pass, defines
/// before it includes a file.
fn without_unused_macros(text: &str, generated: &str) -> String {
    let name = |line: &str| line.strip_prefix("#define ")?.split_whitespace().next().map(str::to_owned);
    let before = generated.split("#include").next().unwrap_or_default();
    let own: BTreeSet<String> = before.lines().filter_map(name).collect();
    let mut rest = text.trim_start_matches('\n');
    let mut kept = String::new();
    while let Some((line, after)) = rest.split_once('\n') {
        let Some(name) = name(line).filter(|name| own.contains(name)) else { break };
        if names_word(after, &name) {
            kept.push_str(line);
            kept.push('\n');
        }
        rest = after;
    }
    kept + rest
}

/// Adds a text with the files that it includes; a file whose id is `inserted` already is left out.
fn inline(
    id: SourceId,
    lines: &[(Span, SourceId)],
    sources: &eddy_diag::SourceMap,
    inserted: &mut Option<BTreeSet<SourceId>>,
    out: &mut String,
) -> Result<(), ConversionError> {
    let text = sources.get(id).map_or("", |source| &*source.text);
    // The first line of a pass that Eddy generates says so.
    let generated = text.lines().next().filter(|line| line.starts_with("// ") && line.contains("Eddy "));
    let mut done = generated.map_or(0, str::len);
    let mut own: Vec<&(Span, SourceId)> = lines.iter().filter(|(span, _)| span.source == id).collect();
    own.sort_by_key(|(span, _)| span.start);
    for (span, target) in own {
        out.push_str(&text[done.min(span.range().start)..span.range().start]);
        done = span.range().end;
        if inserted.as_mut().is_none_or(|inserted| inserted.insert(*target)) {
            inline(*target, lines, sources, inserted, out)?;
        }
    }
    out.push_str(text[done..].trim_start_matches('\u{feff}'));
    match out.len() as u64 > limits::ALL_TEXTS.bytes {
        true => Err(ConversionError::TooLarge),
        false => Ok(()),
    }
}

/// Returns the version of GLSL that a text declares, or else that of the program.
fn version(project: &Project) -> (u32, bool) {
    let of = |text: &str| {
        let mut words = text.split_whitespace();
        let number = words.next()?.parse().ok()?;
        Some((number, number == 100 || words.next() == Some("es")))
    };
    let declared = |text: &str| {
        let lines = hash_lines(text);
        let line = lines.first()?.body.strip_prefix("version")?;
        of(line.split("//").next()?)
    };
    let includes = project.includes.iter().map(|included| &included.source);
    let mut texts = project.tab_sources().chain(includes);
    texts.find_map(|source| declared(&source.text)).or(of(project.dialect.row().version)).unwrap_or((120, false))
}

/// Returns Common without the lines of an ISF host's functions that no other text names.
fn used_of_common(common: &str, texts: &[String]) -> String {
    let mut lines: Vec<&str> = common.lines().collect();
    loop {
        let is_used = |line: &str| {
            let Some(name) = function_of_host(line) else { return true };
            let others = lines.iter().filter(|other| function_of_host(other) != Some(name)).copied();
            texts.iter().map(String::as_str).chain(others).any(|text| names_word(text, name))
        };
        let kept: Vec<&str> = lines.iter().filter(|line| is_used(line)).copied().collect();
        if kept.len() == lines.len() {
            break;
        }
        lines = kept;
    }
    if !lines.iter().any(|line| function_of_host(line).is_some()) {
        lines.retain(|line| !line.starts_with("// The functions of an ISF host"));
    }
    lines.join("\n").trim_start().to_owned() + "\n"
}

/// Returns the name of a function or a macro that is defined in one line.
fn function_of_host(line: &str) -> Option<&str> {
    let rest = line.strip_prefix("#define ").or_else(|| line.strip_prefix("vec4 ").filter(|_| line.ends_with('}')))?;
    let (name, _) = rest.split_once('(')?;
    name.chars().all(tokens::is_letter).then_some(name)
}

/// Returns the letters of buffers, in drawing order as on Shadertoy.
fn buffer_names(project: &Project) -> BTreeMap<PassName, PassName> {
    let buffers = project.passes.iter().map(|pass| &pass.id).filter(|id| id.is_buffer());
    let letter = |index: usize| match u8::try_from(index) {
        Ok(index @ 0..26) => PassName::buffer(char::from(b'a' + index).to_string()),
        _ => PassName::buffer(format!("buffer{index}")),
    };
    buffers.enumerate().map(|(index, id)| (id.clone(), letter(index))).collect()
}

fn rename(name: &mut PassName, names: &BTreeMap<PassName, PassName>) {
    if let Some(new) = names.get(name) {
        *name = new.clone();
    }
}

fn converted_pass(
    cx: &Context<'_>,
    pass: &Pass,
    text: &str,
    names: &BTreeMap<PassName, PassName>,
    notes: &mut Notes,
) -> Result<Pass, ConversionError> {
    let mut id = pass.id.clone();
    rename(&mut id, names);
    let (text, slots) = match names_word(&pass.source.text, "mainImage") || !pass.id.is_picture() {
        true => (text.to_owned(), pass.bindings.iter().map(|(slot, _)| slot).collect()),
        false => {
            let written = text::written(cx, pass, text)
                .map_err(|textures| ConversionError::TooManyTextures { pass: pass.id.clone(), textures })?;
            notes.reads_pointer |= written.reads_pointer;
            notes.discards_in_macro |= written.discards_in_macro;
            (written.text, written.slots)
        }
    };
    let is_kept = names_word(&pass.source.text, "mainImage");
    let channels = slots.into_iter().enumerate().filter_map(|(n, slot)| {
        let channel = pass.bindings.get(slot)?;
        Some((if is_kept { slot } else { n }, moved(channel, names)))
    });
    let bindings: Bindings = channels.collect();
    let source = Source { name: id.title(), path: None, text: text.into() };
    Ok(Pass { bindings, settings: pass.settings.clone(), ..Pass::new(id, source) })
}

fn moved(channel: &Channel, names: &BTreeMap<PassName, PassName>) -> Channel {
    let mut channel = channel.clone();
    if let Input::Pass { id, .. } = &mut channel.input {
        rename(id, names);
    }
    channel
}

/// Sets the values of uniforms that are not defaults of `#iUniform` lines, and the controls of devices.
fn values(cx: &Context<'_>, made: &mut Project) {
    let mut renames = Renames::default();
    cx.sliders.iter().for_each(|slider| renames.uniform(&slider.name, &cx.free));
    let is_default = |name: &str| cx.sliders.iter().any(|slider| slider.name == name && slider.is_declared);
    for (name, value) in cx.project.custom_uniform_values.iter().filter(|(name, _)| !is_default(name)) {
        made.custom_uniform_values.insert(renames.new_name(name).to_owned(), value.clone());
    }
    made.controls = cx
        .project
        .controls
        .clone()
        .into_iter()
        .map(|(mut target, address)| {
            target.uniform = renames.new_name(&target.uniform).to_owned();
            (target, address)
        })
        .collect();
}

/// Facts that become notes.
#[derive(Default)]
struct Notes {
    reads_pointer: bool,
    discards_in_macro: bool,
    all: Vec<String>,
}

impl Notes {
    fn passes(&mut self, made: &Project) {
        if self.reads_pointer {
            self.all.push("The pointer moves only while a button is down, as iMouse does.".into());
        }
        if self.discards_in_macro {
            self.all.push("A macro discards pixels: they keep what they were, and are not cleared.".into());
        }
        let canvas = |pass: &&Pass| pass.settings.size != Default::default();
        let sized: Vec<String> = made.passes.iter().filter(canvas).map(|pass| pass.id.title()).collect();
        if self.reads_pointer && !sized.is_empty() {
            let which = if sized.len() == 1 { "has a size of its own" } else { "have sizes of their own" };
            self.all.push(format!("{} {which}, and read the pointer in pixels of the picture.", listed(&sized)));
        }
    }
}
