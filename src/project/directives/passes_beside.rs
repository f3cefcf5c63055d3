//! Passes that directives name by their files, as in the VS Code extension: `#iChannel0 "file://blur.glsl"`.

use super::{around::is_channel, line};
use crate::{
    Pass, PassName, Project, Source, confine, file_names,
    files::{Files, Read},
    limits,
    lines::hash_lines,
    nearest,
};
use eddy_diag::{Diagnostic, Span};
use std::{collections::BTreeMap, ops::Range};

/// Adds a buffer for every GLSL file that a directive names and that is not a pass yet, and for those that these name.
/// Each is drawn before the pass that names it. Returns errors for files that cannot be read.
pub(crate) fn passes_beside(project: &mut Project, files: &Files<'_>) -> Vec<Diagnostic> {
    let known = project.passes.len();
    // By pass: the passes after `known` that it names.
    let mut names: Vec<Vec<usize>> = Vec::new();
    // By the file of the text with the directive.
    let mut troubles: Vec<(String, Range<usize>, Diagnostic)> = Vec::new();
    while let Some(pass) = project.passes.get(names.len()) {
        let (file, text) = (pass.source.name.clone(), pass.source.text.clone());
        let mut of_pass = Vec::new();
        for hash in hash_lines(&text).into_iter().filter(is_channel) {
            let Ok((_, None, value)) = line::parse(&hash) else { continue };
            let Some(path) = line::glsl_path(value) else { continue };
            match find(project, files, &file, path) {
                Ok(found) => of_pass.extend(found.filter(|index| *index >= known)),
                Err(trouble) => troubles.push((file.clone(), hash.range, trouble)),
            }
        }
        names.push(of_pass);
    }
    if project.passes.len() > known {
        draw_first_what_is_named(project, &names);
    }
    let places: BTreeMap<&str, usize> =
        project.passes.iter().enumerate().rev().map(|(i, p)| (p.source.name.as_str(), i)).collect();
    let placed = troubles.into_iter().map(|(file, range, mut diagnostic)| {
        diagnostic.span = places.get(file.as_str()).map(|&index| Span::new(Project::pass_id(index), range));
        diagnostic
    });
    placed.collect()
}

/// Returns the pass for a path in the text of the file `from`, added if necessary; `None` if the path follows the
/// naming convention, which then decides.
fn find(project: &mut Project, files: &Files<'_>, from: &str, path: &str) -> Result<Option<usize>, Diagnostic> {
    let refuse = |message: String, hint: String| Err(Diagnostic::error(None, message).hint(hint));
    let name = match confine::relative(from, path) {
        Ok(name) => name,
        Err(e) => return refuse(e.to_string(), e.hint()),
    };
    if let Some(index) = project.passes.iter().position(|p| p.source.name == name) {
        return Ok(Some(index));
    }
    let stem = std::path::Path::new(&name).file_stem().and_then(|s| s.to_str()).unwrap_or_default();
    let usual = file_names::pass_of_stem(stem);
    if usual.as_ref().is_some_and(|id| project.pass(id).is_some()) && !files.exists(&name) {
        return Ok(None);
    }
    if project.passes.len() == limits::PASSES {
        let message = format!("with {name} the project has more than {} passes, the limit", limits::PASSES);
        return refuse(message, "use fewer lines with files".into());
    }
    let text = match files.read(&name, limits::GLSL_TEXT) {
        Read::Text(text) => text,
        Read::NotUtf8(at, _) => {
            return refuse(format!("{name} is not UTF-8 text (byte {at})"), "save it as UTF-8 in your editor".into());
        }
        Read::Refused(e) => return refuse(e.to_string(), e.hint()),
        // Another spelling of "self".
        Read::Missing if stem.eq_ignore_ascii_case("self") || stem.eq_ignore_ascii_case("keyboard") => return Ok(None),
        Read::Missing => {
            let beside = files.names().unwrap_or_default();
            let near = nearest(&name, beside.iter().map(String::as_str).filter(|n| *n != from));
            let hint = match near {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => "put the file there, or choose another".into(),
            };
            return refuse(format!("there is no file {name}"), hint);
        }
    };
    let id = free_id(project, usual, stem);
    project.passes.push(Pass::new(id, Source { path: files.path(&name), name, text: text.into() }));
    Ok(Some(project.passes.len() - 1))
}

/// Returns an unused name for the pass of a file.
fn free_id(project: &Project, usual: Option<PassName>, stem: &str) -> PassName {
    let is_free = |id: &PassName| project.pass(id).is_none();
    if let Some(id) = usual.filter(|id| id.is_readable() && is_free(id)) {
        return id;
    }
    let letters: String = stem.to_lowercase().chars().filter(|c| c.is_alphanumeric()).take(limits::NAME - 6).collect();
    let letters = if letters.chars().count() > 1 { letters } else { format!("file{letters}") };
    let mut numbered = (2..).map(|n| format!("{letters}{n}"));
    let mut name = letters.clone();
    while !is_free(&PassName::buffer(&name)) {
        name = numbered.next().unwrap_or_default();
    }
    PassName::buffer(name)
}

/// Reorders passes so that the added ones, which are named, are drawn before the passes that name them.
fn draw_first_what_is_named(project: &mut Project, names: &[Vec<usize>]) {
    let mut turns: Vec<Option<usize>> = vec![None; names.len()];
    let mut is_open = vec![false; names.len()];
    let mut next_turn = 0;
    for root in 0..names.len() {
        // Depth-first, without recursion: chains may be long.
        let mut way: Vec<(usize, usize)> = vec![(root, 0)];
        while let Some((at, child)) = way.last_mut() {
            let at = *at;
            is_open[at] = true;
            match names[at].get(*child) {
                Some(&named) => {
                    *child += 1;
                    if !is_open[named] {
                        way.push((named, 0));
                    }
                }
                None => {
                    if turns[at].is_none() {
                        turns[at] = Some(next_turn);
                        next_turn += 1;
                    }
                    way.pop();
                }
            }
        }
    }
    let passes = std::mem::take(&mut project.passes);
    let mut sorted: Vec<(Option<usize>, Pass)> = turns.into_iter().zip(passes).collect();
    sorted.sort_by_key(|(turn, _)| *turn);
    project.passes = sorted.into_iter().map(|(_, pass)| pass).collect();
    project.passes.sort_by(|a, b| a.id.drawing_order(&b.id));
}
