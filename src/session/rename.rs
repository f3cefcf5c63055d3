//! A name of the author's gets another one, wherever in the project it stands for the same.

use super::{
    Session,
    view::{TabEdit, TabFix},
};
use eddy_diag::{SourceId, Span};
use eddy_engine as engine;
use eddy_glsl::{self as glsl, services::Analysis};
use eddy_project::{FillKind, FillValue, Project, Stage, Tab};
use std::collections::{BTreeMap, BTreeSet};

/// The places of a name: text, first byte, the byte behind the last.
type Places = BTreeSet<(u16, u32, u32)>;

impl Session {
    /// Returns the name at a byte of a tab that can have another one, or why it cannot.
    pub fn renamable(&self, tab: &Tab, at: usize) -> Result<String, String> {
        let (name, places) = self.named_at(tab, at)?;
        if places.is_empty() {
            Err(format!("`{name}` is not declared in this project and cannot be renamed"))
        } else {
            Ok(name)
        }
    }

    /// Returns the edits that give what is named at a byte of a tab another name. Fails where that is not the author's to
    /// name, and where the new name would change what something means.
    pub fn rename(&self, tab: &Tab, at: usize, to: &str) -> Result<TabFix, String> {
        let to = to.trim();
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        if to.is_empty() || !to.chars().all(is_name) || to.starts_with(|c: char| c.is_ascii_digit()) {
            return Err(format!("\"{to}\" is not a name: use letters, digits and _, and start with a letter"));
        }
        if let Some(why) = glsl::taken(to) {
            return Err(format!("`{to}` cannot be declared: {why}"));
        }
        self.renamable(tab, at)?;
        let (name, places) = self.named_at(tab, at)?;
        let project = self.project();
        if let Some(place) = used_in_fill(project, &name) {
            return Err(format!("`{name}` is used in {place} too: write `{to}` there first, then rename it"));
        }
        let mut edits = Vec::new();
        for &(source, start, end) in &places {
            let range = start as usize..end as usize;
            let text =
                project.tab_of(SourceId(source)).and_then(|tab| Some((self.text(&tab).get(range.clone())?, tab)));
            match text {
                Some((here, tab)) if here == name => {
                    edits.push(TabEdit { tab, range, replaced: name.clone(), text: to.to_owned() });
                }
                _ => return Err(format!("`{name}` is used somewhere that cannot be edited here")),
            }
        }
        let mut renamed = project.clone();
        for (tab, text) in applied(project, &edits) {
            if let Some(source) = renamed.source_mut(&tab) {
                source.text = text.into();
            }
        }
        // What the name stands for must be what it was, and nothing else may stand for it.
        let at = moved(&places, project.id_of(tab).map_or(0, |id| id.0), at, name.len(), to.len());
        let wanted: Places = places
            .iter()
            .map(|&(source, start, _)| {
                let start = moved(&places, source, start as usize, name.len(), to.len()) as u32;
                (source, start, start + to.len() as u32)
            })
            .collect();
        let found = renamed.id_of(tab).map(|id| everywhere(&renamed, id, at)).unwrap_or_default();
        let is_taken =
            || renamed.custom_uniforms().get(to).is_some() && programs(&renamed).iter().any(|p| p.declares(to));
        if found != wanted || is_taken() {
            return Err(format!("`{to}` already has a meaning here: choose another name"));
        }
        Ok(TabFix { title: format!("Rename `{name}` to `{to}`"), edits })
    }

    /// The word at a byte of a tab, and every place where it stands for the same; none for what no text declares.
    fn named_at(&self, tab: &Tab, at: usize) -> Result<(String, Places), String> {
        let nothing = || "there is no name here".to_owned();
        let text = self.text(tab);
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let (before, behind) = (text.get(..at).ok_or_else(nothing)?, text.get(at..).ok_or_else(nothing)?);
        let start = before.len() - before.chars().rev().take_while(|c| is_name(*c)).count();
        let end = at + behind.chars().take_while(|c| is_name(*c)).count();
        let name = text[start..end].to_owned();
        if name.is_empty() || name.starts_with(|c: char| c.is_ascii_digit()) {
            return Err(nothing());
        }
        if glsl::taken(&name).is_some() {
            return Err(format!("`{name}` is defined by GLSL or Shadertoy and cannot be renamed"));
        }
        let project = self.project();
        let id = project.id_of(tab).ok_or_else(nothing)?;
        Ok((name, everywhere(project, id, start)))
    }
}

/// Every place where what is named at a byte of a text is named, in all passes; none for what no text declares.
pub(super) fn everywhere(project: &Project, source: SourceId, at: usize) -> Places {
    let programs = programs(project);
    if let Some(found) = of_custom_uniform(project, &programs, source, at) {
        return found;
    }
    let mut found = Places::new();
    let mut queue: Vec<(SourceId, usize)> = vec![(source, at)];
    let mut asked: BTreeSet<(u16, usize)> = BTreeSet::new();
    while let Some((source, at)) = queue.pop() {
        if !asked.insert((source.0, at)) {
            continue;
        }
        for program in programs.iter().filter(|program| program.text(source).is_some()) {
            let Some(declared) = program.definition(source, at) else { continue };
            for Span { source, start, end } in program.uses(source, at) {
                found.insert((source.0, start, end));
            }
            // A text that several passes have in them: what each says of its declaration.
            queue.push((declared.source, declared.start as usize));
        }
    }
    found
}

/// Returns the first expression of `eddy.toml` that uses one of the author's own uniforms: no edit of a tab reaches it.
fn used_in_fill(project: &Project, name: &str) -> Option<String> {
    project.custom_uniforms().get(name)?;
    let is_of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    project.fills().find_map(|(index, kind, fill)| {
        let FillValue::Expression(text) = &fill.value else { return None };
        let is_used = text.split(|c| !is_of_name(c)).any(|word| word == name);
        let what = match kind {
            FillKind::Initial => "initial state",
            FillKind::Boundary => "edges",
        };
        is_used.then(|| format!("the {what} of {}", project.passes[index].id.title()))
    })
}

/// Every stage of every pass.
fn programs(project: &Project) -> Vec<Analysis> {
    let texts = engine::Sources::new(project);
    let mut programs = Vec::new();
    for (index, pass) in project.passes.iter().enumerate() {
        let files = pass.settings.meshes().map_or(0, |g| g.stages.len());
        let stages = [Stage::Own].into_iter().chain((0..files).map(Stage::File));
        programs.extend(stages.map(|stage| texts.analyse_stage(index, stage)));
    }
    programs
}

/// Every place where one of the author's own uniforms is declared or used, if one is named at a byte of a text. One name
/// is one uniform in all texts.
fn of_custom_uniform(project: &Project, programs: &[Analysis], source: SourceId, at: usize) -> Option<Places> {
    let declared = project.custom_uniform_names();
    let is_here = |span: &Span| span.source == source && (span.start as usize..=span.end as usize).contains(&at);
    let here = declared.iter().find(|(_, span)| is_here(span)).map(|(name, _)| name.as_str());
    let name = here.or_else(|| programs.iter().find_map(|program| program.custom_uniform_at(source, at)))?;
    let lines = declared.iter().filter(|(other, _)| other == name).map(|(_, span)| *span);
    let uses = programs.iter().flat_map(|program| program.uses_of_custom_uniform(name));
    Some(lines.chain(uses).map(|Span { source, start, end }| (source.0, start, end)).collect())
}

/// Returns where a byte of a text is once every place has a name of another length.
fn moved(places: &Places, source: u16, at: usize, old: usize, new: usize) -> usize {
    let before = places.iter().filter(|(of, start, _)| *of == source && (*start as usize) < at).count();
    let inside = places.iter().any(|(of, start, end)| *of == source && (*start as usize) < at && at <= *end as usize);
    // Within a name it stays at the name's begin.
    let at = if inside {
        places
            .iter()
            .filter(|(of, start, _)| *of == source && (*start as usize) < at)
            .map(|p| p.1 as usize)
            .max()
            .unwrap_or(at)
    } else {
        at
    };
    let before = before - usize::from(inside);
    at + before * new - before * old
}

/// Returns the texts of tabs with edits made.
fn applied(project: &Project, edits: &[TabEdit]) -> BTreeMap<Tab, String> {
    let mut texts: BTreeMap<Tab, String> = BTreeMap::new();
    let mut ordered: Vec<&TabEdit> = edits.iter().collect();
    ordered.sort_by_key(|edit| std::cmp::Reverse(edit.range.start));
    for edit in ordered {
        let text = texts
            .entry(edit.tab.clone())
            .or_insert_with(|| project.source(&edit.tab).map(|s| s.text.to_string()).unwrap_or_default());
        if text.get(edit.range.clone()).is_some() {
            text.replace_range(edit.range.clone(), &edit.text);
        }
    }
    texts
}
