//! Renames an item in all programs that share texts.

use super::analysis::Analysis;
use crate::check::taken;
use eddy_diag::{Edit, Fix, SourceId, SourceMap, Span};
use std::collections::{BTreeMap, BTreeSet};

/// A place of a name: text, first byte, end byte.
pub type Place = (SourceId, u32, u32);

/// The places of a name, by text and byte.
pub type Places = BTreeSet<Place>;

/// All programs of a project: its passes and stages, which share Common and included files.
#[derive(Clone, Copy, Debug)]
pub struct Programs<'a> {
    pub analyses: &'a [&'a Analysis],
    /// The names in `#iUniform` lines, with their places; these lines are not part of the GLSL. One name is one uniform
    /// in all texts.
    pub uniforms: &'a [(String, Span)],
    /// The texts as written by the author.
    pub texts: &'a SourceMap,
}

impl Programs<'_> {
    /// Returns every place that refers to the item at a byte of a text, in all programs; none if no text declares it.
    pub fn places(&self, source: SourceId, at: usize) -> Places {
        if let Some(name) = self.uniform_at(source, at) {
            let lines = self.uniforms.iter().filter(|(other, _)| other == name).map(|(_, span)| *span);
            let uses = self.analyses.iter().flat_map(|program| program.uses_of_custom_uniform(name));
            return lines.chain(uses).map(|span| (span.source, span.start, span.end)).collect();
        }
        let mut found = Places::new();
        let mut queue: Vec<(SourceId, usize)> = vec![(source, at)];
        let mut asked: BTreeSet<(SourceId, usize)> = BTreeSet::new();
        while let Some((source, at)) = queue.pop() {
            if !asked.insert((source, at)) {
                continue;
            }
            for program in self.analyses.iter().filter(|program| program.text(source).is_some()) {
                let Some(declared) = program.definition(source, at) else { continue };
                for Span { source, start, end } in program.uses(source, at) {
                    found.insert((source, start, end));
                }
                // A text that several passes include: search the declaration with each of them.
                queue.push((declared.source, declared.start as usize));
            }
        }
        found
    }

    /// Returns the names in the `#iUniform` lines that declare the item at a byte of a text.
    pub fn uniform_lines(&self, source: SourceId, at: usize) -> Vec<Span> {
        let name = self.uniform_at(source, at);
        self.uniforms.iter().filter(|(other, _)| Some(other.as_str()) == name).map(|(_, span)| *span).collect()
    }

    fn uniform_at(&self, source: SourceId, at: usize) -> Option<&str> {
        let is_here = |span: &Span| span.source == source && (span.start as usize..=span.end as usize).contains(&at);
        let here = self.uniforms.iter().find(|(_, span)| is_here(span)).map(|(name, _)| name.as_str());
        here.or_else(|| self.analyses.iter().find_map(|program| program.custom_uniform_at(source, at)))
    }

    /// Returns the name at a byte of a text that can be renamed, with its place, or why it cannot.
    pub fn renamable(&self, source: SourceId, at: usize) -> Result<(String, Span), String> {
        let (name, span, places) = self.named_at(source, at)?;
        match places.is_empty() {
            true => Err(format!("`{name}` is not declared in this project and cannot be renamed")),
            false => Ok((name, span)),
        }
    }

    /// Returns the edits that rename the item at a byte of a text. `analyse` reads the texts with the edits applied and
    /// passes the programs to its second argument. Fails if the name is not the author's, and if the new name would
    /// change the meaning of a program.
    pub fn rename(
        &self,
        (source, at): (SourceId, usize),
        to: &str,
        analyse: impl FnOnce(&Fix, &mut dyn FnMut(&Programs<'_>)),
    ) -> Result<Fix, String> {
        let to = to.trim();
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        if to.is_empty() || !to.chars().all(is_name) || to.starts_with(|c: char| c.is_ascii_digit()) {
            return Err(format!("\"{to}\" is not a name: use letters, digits and _, and start with a letter"));
        }
        if let Some(why) = taken(to) {
            return Err(format!("`{to}` cannot be declared: {why}"));
        }
        self.renamable(source, at)?;
        let (name, _, places) = self.named_at(source, at)?;
        let mut edits = Vec::new();
        for &(source, start, end) in &places {
            let span = Span { source, start, end };
            let here = self.texts.get(source).and_then(|text| text.text.get(span.range()));
            if here != Some(&*name) {
                return Err(format!("`{name}` is used somewhere that cannot be edited here"));
            }
            edits.push(Edit { span, text: to.to_owned() });
        }
        let fix = Fix::new(format!("Rename `{name}` to `{to}`"), edits);
        // The new name must refer to the same item, and nothing else may refer to it.
        let moves = Moves::new(&places, name.len(), to.len());
        let at = moves.place(source, at);
        let wanted: Places = places
            .iter()
            .map(|&(source, start, _)| {
                let start = moves.place(source, start as usize) as u32;
                (source, start, start + to.len() as u32)
            })
            .collect();
        let (mut found, mut is_taken) = (Places::new(), false);
        analyse(&fix, &mut |renamed| {
            found = renamed.places(source, at);
            let is_uniform = renamed.uniforms.iter().any(|(name, _)| name == to);
            is_taken = is_uniform && renamed.analyses.iter().any(|program| program.declares(to));
        });
        if found != wanted || is_taken {
            return Err(format!("`{to}` already has a meaning here: choose another name"));
        }
        Ok(fix)
    }

    /// Returns the word at a byte of a text, and every place that refers to the same item; an error if no text declares
    /// it.
    fn named_at(&self, source: SourceId, at: usize) -> Result<(String, Span, Places), String> {
        let nothing = || "there is no name here".to_owned();
        let text = &self.texts.get(source).ok_or_else(nothing)?.text;
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let (before, after) = (text.get(..at).ok_or_else(nothing)?, text.get(at..).ok_or_else(nothing)?);
        let start = before.len() - before.chars().rev().take_while(|c| is_name(*c)).count();
        let end = at + after.chars().take_while(|c| is_name(*c)).count();
        let name = text[start..end].to_owned();
        if name.is_empty() || name.starts_with(|c: char| c.is_ascii_digit()) {
            return Err(nothing());
        }
        if taken(&name).is_some() {
            return Err(format!("`{name}` is defined by GLSL or Shadertoy and cannot be renamed"));
        }
        let places = self.places(source, start);
        Ok((name, Span::new(source, start..end), places))
    }
}

/// Maps bytes of texts from before to after renaming with a name of another length.
struct Moves {
    starts: BTreeMap<SourceId, Vec<usize>>,
    old: usize,
    new: usize,
}

impl Moves {
    fn new(places: &Places, old: usize, new: usize) -> Self {
        let mut starts: BTreeMap<SourceId, Vec<usize>> = BTreeMap::new();
        for &(source, start, _) in places {
            starts.entry(source).or_default().push(start as usize);
        }
        Self { starts, old, new }
    }

    /// A byte within a name maps to the name's start.
    fn place(&self, source: SourceId, at: usize) -> usize {
        let starts = self.starts.get(&source).map_or(&[][..], Vec::as_slice);
        let before = starts.partition_point(|&start| start < at);
        let inside = before.checked_sub(1).map(|i| starts[i]).filter(|&start| at <= start + self.old);
        match inside {
            Some(start) => start + (before - 1) * self.new - (before - 1) * self.old,
            None => at + before * self.new - before * self.old,
        }
    }
}
