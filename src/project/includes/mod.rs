//! `#include "file"` lines: texts inside texts.
//!
//! A path is relative to the file whose line names it, and stays within the project's folder; an included file may
//! include others. The lines count everywhere outside comments, in conditionals too; only missing files are reported by
//! the preprocessor, when the line is compiled. For a file that is a tab of the project, the tab's text is used;
//! Common, which comes before every pass anyway, is not inserted again.
//!
//! Owns which files are read ([`Project::read_includes`]), the targets of the lines ([`Project::include_lines`]) and
//! the resulting text ([`Project::inlined`]).

use super::{
    FileError, Included, Origin, Project, Source, Tab,
    confine::{self, Reason},
    embedded,
    files::{Files, Read},
    limits,
    lines::{HashLine, hash_lines},
    nearest,
};
use eddy_diag::{Diagnostic, SourceId, Span};
use std::{
    borrow::Cow,
    collections::{BTreeMap, BTreeSet, VecDeque},
    path::Path,
};

/// The reason why a file has no text.
struct IncludeFailure {
    why: String,
    is_limit: bool,
}

impl From<String> for IncludeFailure {
    fn from(why: String) -> Self {
        IncludeFailure { why, is_limit: false }
    }
}

/// The targets of the `#include` lines of a project.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IncludeLines {
    /// Lines with the texts that replace them, without cycles.
    pub lines: Vec<(Span, SourceId)>,
    /// The lines without a text, each with the diagnostic to report if it is compiled; its span is the line.
    pub missing: Vec<Diagnostic>,
    /// Errors that are reported whether or not the lines are compiled.
    pub diagnostics: Vec<Diagnostic>,
}

fn is_include(line: &HashLine<'_>) -> bool {
    line.body.strip_prefix("include").is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
}

/// Returns whether a line names a file, as it must. Any other form is left to the compiler, which skips it in an
/// inactive conditional group, for example in text of another language.
pub(super) fn is_named(line: &HashLine<'_>) -> bool {
    is_include(line) && named(line).is_some()
}

/// The path a line names.
fn named<'t>(line: &HashLine<'t>) -> Option<&'t str> {
    let rest = line.body.strip_prefix("include")?.trim_start().strip_prefix('"')?;
    let (path, after) = rest.split_once('"')?;
    let after = after.trim_start();
    // glslViewer accepts a semicolon.
    let is_end = after.is_empty() || ["//", "/*", ";"].iter().any(|end| after.starts_with(end));
    (!path.trim().is_empty() && is_end).then_some(path)
}

/// Returns the paths that the `#include` lines of a text name, in their order and as they are written.
pub fn include_names(text: &str) -> Vec<&str> {
    if !text.contains("include") {
        return Vec::new();
    }
    hash_lines(text).iter().filter(|l| is_include(l)).filter_map(named).map(str::trim).collect()
}

/// Returns the names that a line may mean, the first choice first. Complete fragment shaders may include files above
/// their folder, and files of libraries from anywhere in it.
fn candidates(project: &Project, from: &str, path: &str) -> Result<Vec<String>, FileError> {
    if !project.dialect.has_main() {
        return Ok(vec![confine::relative(from, path)?]);
    }
    let beside = match &project.origin {
        Origin::File(_) => confine::included(from, path)?,
        _ => confine::relative(from, path)?,
    };
    let from_root = confine::relative("", path).ok().filter(|name| *name != beside);
    Ok([beside].into_iter().chain(from_root).collect())
}

/// Reads every file that texts of the project include, and those that these include.
pub(super) fn read(project: &mut Project, files: Option<&Files<'_>>) {
    let tabs: BTreeSet<String> = tab_sources(project).map(|s| s.name.clone()).collect();
    let mut queue: VecDeque<(String, std::sync::Arc<str>)> =
        tab_sources(project).map(|s| (s.name.clone(), s.text.clone())).collect();
    let mut known = tabs.clone();
    let mut found: Vec<Included> = Vec::new();
    // Edited texts exist only here: they stay, even while no text includes them.
    let edited: BTreeMap<String, Source> =
        project.includes.iter().filter(|i| i.is_edited).map(|i| (i.source.name.clone(), i.source.clone())).collect();
    'texts: while let Some((from, text)) = queue.pop_front() {
        for line in hash_lines(&text).iter().filter(|l| is_include(l)) {
            let Some(path) = named(line) else { continue };
            let names = candidates(project, &from, path.trim()).unwrap_or_default();
            let is_present = |name: &&String| known.contains(*name) || files.is_some_and(|files| files.can_read(name));
            let Some(name) = names.iter().find(is_present).or(names.first()).cloned() else { continue };
            if !known.insert(name.clone()) {
                continue;
            }
            if let Some(source) = edited.get(&name) {
                queue.push_back((name, source.text.clone()));
                found.push(Included { source: source.clone(), trouble: None, is_limit: false, is_edited: true });
                continue;
            }
            let content = match known.len() > limits::TEXTS {
                true => Err(IncludeFailure {
                    why: format!("with {name} the project has more than {} files, the limit", limits::TEXTS),
                    is_limit: true,
                }),
                false => {
                    content(files, &name, found.iter().filter(|i| i.trouble.is_some()).take(HINTS).count() < HINTS)
                }
            };
            let (text, trouble) = match content {
                Ok(text) => (text, None),
                Err(trouble) => (String::new(), Some(trouble)),
            };
            let is_limit = trouble.as_ref().is_some_and(|t| t.is_limit);
            let path = files.and_then(|f| f.path(&name));
            let source = Source { name: name.clone(), path, text: text.into() };
            queue.push_back((name, source.text.clone()));
            found.push(Included { source, trouble: trouble.map(|t| t.why), is_limit, is_edited: false });
            if is_limit {
                break 'texts;
            }
        }
    }
    let is_left = |name: &String| !found.iter().any(|i| i.source.name == *name) && !tabs.contains(name);
    let left: Vec<Source> = edited.into_iter().filter(|(name, _)| is_left(name)).map(|(_, source)| source).collect();
    let left = left.into_iter().map(|source| Included { source, trouble: None, is_limit: false, is_edited: true });
    // If there is a failure of a limit, it is the last entry.
    project.includes = left.chain(found).collect();
}

/// The number of missing files for which a similar name is suggested: each suggestion reads the folder.
const HINTS: usize = 20;

fn content(files: Option<&Files<'_>>, name: &str, with_hint: bool) -> Result<String, IncludeFailure> {
    let Some(files) = files else {
        return Err(format!("{name} cannot be found: the project has no folder yet; save it first").into());
    };
    match files.read_included(name, limits::GLSL_TEXT) {
        Read::Text(text) => Ok(text),
        Read::NotUtf8(at, _) => {
            Err(format!("{name} is not UTF-8 text (byte {at}); save it as UTF-8 in your editor").into())
        }
        Read::Missing => {
            let folder = name.rsplit_once('/').map_or("", |(folder, _)| folder);
            let beside = if folder.is_empty() && with_hint { files.names().unwrap_or_default() } else { Vec::new() };
            let near = nearest(name, beside.iter().map(String::as_str));
            let hint = near.map(|n| format!("; did you mean {n}?")).unwrap_or_default();
            Err(format!("there is no file {name}{hint}").into())
        }
        Read::Refused(e) => {
            Err(IncludeFailure { why: format!("{e}; {}", e.hint()), is_limit: matches!(e.reason, Reason::TooMuch(_)) })
        }
    }
}

fn tab_sources(project: &Project) -> impl Iterator<Item = &Source> {
    project.tab_sources()
}

impl Project {
    /// Reads the files that the texts include, relative to the project's folder. Those of a folder that was moved or
    /// deleted stay as they were read: they are saved with the project.
    pub fn read_includes(&mut self) {
        match &self.origin {
            super::Origin::Preset(name) => {
                let files = embedded::LIBRARY.files(name);
                read(self, files.as_ref());
            }
            other => {
                let base = other.base_dir().map(Path::to_owned);
                let is_gone = base.as_ref().is_some_and(|base| !base.as_os_str().is_empty() && !base.is_dir());
                if is_gone && !self.includes.is_empty() {
                    return;
                }
                read(self, base.as_deref().map(Files::on_disk).as_ref());
            }
        }
    }

    /// Reads files that a text outside this project includes, and adds them to the included files. Unreadable files are
    /// omitted.
    pub fn read_included(&mut self, names: impl IntoIterator<Item = String>) {
        let base = self.origin.base_dir().map(Path::to_owned);
        let files = match &self.origin {
            super::Origin::Preset(name) => embedded::LIBRARY.files(name),
            _ => base.as_deref().map(Files::on_disk),
        };
        let Some(files) = files else { return };
        for name in names {
            self.includes.retain(|i| i.source.name != name || i.trouble.is_none());
            if self.includes.iter().any(|i| i.source.name == name) {
                continue;
            }
            if let Ok(text) = content(Some(&files), &name, false) {
                let source = Source { path: files.path(&name), name, text: text.into() };
                self.includes.insert(0, Included { source, trouble: None, is_limit: false, is_edited: false });
            }
        }
    }

    /// Returns the target of every `#include` line, and diagnostics for those without one. Spans and ids are of
    /// [`Project::sources`].
    pub fn include_lines(&self) -> IncludeLines {
        let mut found = IncludeLines::default();
        let sources = self.texts();
        // If two buffers share a file, the first id is used; their text is the same.
        let mut ids: BTreeMap<&str, SourceId> = BTreeMap::new();
        for (id, source) in sources.iter().filter(|(id, _)| *id != Self::COMMON_ID || self.common.is_some()) {
            ids.entry(&source.name).or_insert(id);
        }
        for (id, source) in sources.iter() {
            for line in hash_lines(&source.text).iter().filter(|l| is_include(l)) {
                let span = Span::new(id, line.range.clone());
                let Some(path) = named(line) else { continue };
                let is_readable = |name: &&String| {
                    let target = ids.get(name.as_str());
                    target.is_some_and(|id| self.included(*id).is_none_or(|included| included.trouble.is_none()))
                };
                let name = match candidates(self, &source.name, path.trim()) {
                    Ok(names) => match names.iter().find(is_readable).or(names.first()) {
                        Some(name) => name.clone(),
                        None => continue,
                    },
                    Err(e) => {
                        let message = format!("#include \"{path}\": {e}");
                        found.missing.push(Diagnostic::error(span, message).hint(e.hint()));
                        continue;
                    }
                };
                match ids.get(name.as_str()) {
                    Some(&target) if target == Self::COMMON_ID && id != Self::COMMON_ID => found.missing.push(
                        Diagnostic::warning(
                            span,
                            format!("{name} is Common, which is inserted before every pass: it is not included again"),
                        )
                        .hint("remove this line"),
                    ),
                    Some(&target) => {
                        let trouble = self.included(target).and_then(|i| Some((i.trouble.as_ref()?, i.is_limit)));
                        let error = |why| Diagnostic::error(span, format!("#include \"{path}\": {why}"));
                        match trouble {
                            Some((why, true)) => found.diagnostics.push(error(why)),
                            Some((why, false)) => found.missing.push(error(why)),
                            None => found.lines.push((span, target)),
                        }
                    }
                    None if self.includes.last().is_some_and(|i| i.is_limit) => {}
                    None => found
                        .missing
                        .push(Diagnostic::error(span, format!("#include \"{path}\": there is no file {name}"))),
                }
            }
        }
        if self.includes.last().is_some_and(|i| i.is_limit) {
            // Discard even the resolved lines: the limit is already reported as an error.
            found.lines.clear();
        }
        self.cut_cycles(&mut found);
        found
    }

    /// Removes lines that form cycles, each with an error that shows the cycle.
    fn cut_cycles(&self, found: &mut IncludeLines) {
        let sources = self.texts();
        let count = sources.iter().count();
        let name = |id: usize| sources.get(SourceId(id as u16)).map_or("", |s| s.name.as_str());
        let mut lines: Vec<Vec<(Span, usize)>> = vec![Vec::new(); count];
        for &(span, target) in &found.lines {
            lines[usize::from(span.source.0)].push((span, usize::from(target.0)));
        }
        let mut cut: BTreeSet<(u16, u32)> = BTreeSet::new();
        // The number of texts inlined into each, itself included, and their total bytes; 0 if not yet computed.
        let mut sizes = vec![0u64; count];
        let mut bytes: Vec<u64> = sources.iter().map(|(_, s)| s.text.len() as u64).collect();
        for root in 0..count {
            // Depth-first, without recursion: chains may be long.
            let mut way: Vec<(usize, usize)> = vec![(root, 0)];
            while let Some(&(at, next)) = way.last() {
                if sizes[at] > 0 {
                    way.pop();
                } else if let Some(&(span, target)) = lines[at].get(next) {
                    if let Some(last) = way.last_mut() {
                        last.1 += 1;
                    }
                    match way.iter().position(|(id, _)| *id == target) {
                        Some(first) => {
                            let chain: Vec<&str> =
                                way[first..].iter().map(|(id, _)| name(*id)).chain([name(target)]).collect();
                            let message = format!("this #include is circular: {}", chain.join(" -> "));
                            found.diagnostics.push(Diagnostic::error(span, message).hint("remove one of these lines"));
                            cut.insert((span.source.0, span.start));
                        }
                        None => way.push((target, 0)),
                    }
                } else {
                    sizes[at] = 1;
                    for (_, target) in lines[at].iter().filter(|(s, _)| !cut.contains(&(s.source.0, s.start))) {
                        sizes[at] = sizes[at].saturating_add(sizes[*target]);
                        bytes[at] = bytes[at].saturating_add(bytes[*target]);
                    }
                    way.pop();
                }
            }
        }
        found.lines.retain(|(s, _)| !cut.contains(&(s.source.0, s.start)));
        let is_too_much = |at: &usize| sizes[*at] > limits::INCLUDED || bytes[*at] > limits::ALL_TEXTS.bytes;
        if let Some(at) = (0..count).find(is_too_much) {
            let most = match sizes[at] > limits::INCLUDED {
                true => format!("{} files", limits::INCLUDED),
                false => limits::in_bytes(limits::ALL_TEXTS.bytes),
            };
            let message =
                format!("{} includes more than {most}, counting each file as often as it is included", name(at));
            found.diagnostics.push(
                Diagnostic::error(
                    found.lines.iter().find(|(s, _)| usize::from(s.source.0) == at).map(|l| l.0),
                    message,
                )
                .hint("include each file once"),
            );
            found.lines.clear();
        }
    }

    /// Returns the tabs whose texts include a file, directly or indirectly: Common, passes, stages.
    pub fn tabs_that_include(&self, included: &Tab) -> Vec<Tab> {
        let Some(id) = self.id_of(included) else { return Vec::new() };
        let lines = self.include_lines();
        let has_it = |tab: &Tab| self.id_of(tab).is_some_and(|of| lines.reach(of).contains(&id));
        self.tabs().into_iter().filter(|tab| !matches!(tab, Tab::Included(_)) && has_it(tab)).collect()
    }

    /// Returns the target tab of the `#include` line at a byte offset of a tab's text.
    pub fn included_at(&self, tab: &Tab, at: usize) -> Option<Tab> {
        let text = &self.source(tab)?.text;
        let line =
            hash_lines(text).into_iter().find(|l| is_include(l) && (l.range.start..=l.range.end).contains(&at))?;
        let names = candidates(self, &self.source(tab)?.name, named(&line)?.trim()).ok()?;
        let of_name =
            |name: &String| self.tabs().into_iter().find(|tab| self.source(tab).is_some_and(|s| s.name == *name));
        names.iter().find_map(of_name)
    }

    /// A text with every `#include` line replaced by the included file.
    pub fn inlined(&self, id: SourceId, lines: &IncludeLines) -> Cow<'_, str> {
        let text = self.source_text(id);
        let mut own = lines.lines.iter().filter(|(span, _)| span.source == id).peekable();
        if own.peek().is_none() {
            return Cow::Borrowed(text);
        }
        let (mut out, mut done) = (String::new(), 0);
        for (span, target) in own {
            out.push_str(&text[done..span.range().start]);
            out.push_str(self.inlined(*target, lines).trim_start_matches('\u{feff}'));
            done = span.range().end;
        }
        out.push_str(&text[done..]);
        Cow::Owned(out)
    }

    fn source_text(&self, id: SourceId) -> &str {
        let source = match usize::from(id.0) {
            0 => self.common.as_ref(),
            i if i < self.first_stage() => self.passes.get(i - 1).map(|pass| &pass.source),
            i if i < self.first_included() => self.stages().nth(i - self.first_stage()).map(|(_, stage)| stage),
            _ => self.included(id).map(|included| &included.source),
        };
        source.map_or("", |source| &source.text)
    }
}

impl IncludeLines {
    /// The text `id` and all texts that it includes.
    pub fn reach(&self, id: SourceId) -> BTreeSet<SourceId> {
        let mut reached = BTreeSet::new();
        let mut todo = vec![id];
        while let Some(id) = todo.pop() {
            if reached.insert(id) {
                todo.extend(self.lines.iter().filter(|(span, _)| span.source == id).map(|(_, target)| *target));
            }
        }
        reached
    }
}

#[cfg(test)]
mod tests;
