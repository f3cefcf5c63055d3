//! Selects one shader of a file that contains several.

use super::form::{Head, HeadInfo, RootContent, Scalar, Shaders, shown};
use crate::listed;
use eddy_diag::Diagnostic;
use serde_json::value::RawValue;
use std::path::{Path, PathBuf};

/// The number of shaders that a message lists.
const SHOWN: usize = 8;

/// Returns the selected shader, or the first if none is selected. Returns a message and its fix on failure.
pub(super) fn choose<'t>(
    list: &Shaders<'t>,
    file: &str,
    wanted: Option<&str>,
    warnings: &mut Vec<Diagnostic>,
) -> Result<&'t RawValue, (String, String)> {
    let Some(first) = list.first.first() else {
        return Err(("not a Shadertoy shader: the list is empty".into(), "export a shader into it".into()));
    };
    let count = list.count;
    let Some(wanted) = wanted else {
        if count > 1 {
            let warning = Diagnostic::warning(None, format!("the file has {count} shaders; the first one is read"));
            warnings.push(warning.hint(others(list, file)));
        }
        return Ok(first);
    };
    let found = list.first.iter().enumerate().find(|(n, one)| is_called(one.get(), n + 1, wanted));
    match found {
        Some((_, one)) => Ok(one),
        None => {
            let message = format!("none of the {count} shaders in the file is named {}", shown(wanted));
            Err((message, others(list, file)))
        }
    }
}

/// Returns whether a selection names a shader, by its id, its number from 1 or its name.
pub(super) fn is_called(shader: &str, number: usize, wanted: &str) -> bool {
    let (id, name) = head(shader);
    id == wanted || wanted == number.to_string() || name.eq_ignore_ascii_case(wanted)
}

fn head(shader: &str) -> (String, String) {
    let inner = serde_json::from_str::<Wrapped<'_>>(shader).ok().and_then(|w| w.0);
    let head: Head = serde_json::from_str(inner.map_or(shader, RawValue::get)).unwrap_or_default();
    let HeadInfo { id, name } = head.info.unwrap_or_default();
    let text = |scalar: Option<Scalar>| scalar.map(|s| s.text()).unwrap_or_default();
    (text(id), text(name))
}

/// Describes how to select the other shaders.
fn others(list: &Shaders<'_>, file: &str) -> String {
    let mut ids: Vec<String> = Vec::new();
    let all: Vec<String> = list
        .first
        .iter()
        .take(SHOWN)
        .enumerate()
        .map(|(n, one)| {
            let (id, name) = head(one.get());
            let is_good = !id.is_empty() && id.chars().all(char::is_alphanumeric) && !ids.contains(&id);
            let call = if is_good { id.clone() } else { (n + 1).to_string() };
            ids.push(id);
            if name.is_empty() { format!("{file}#{call}") } else { format!("{file}#{call} ({})", shown(&name)) }
        })
        .collect();
    let more = if list.count > SHOWN { format!(" and so on to {file}#{}", list.count) } else { String::new() };
    let all = if more.is_empty() { listed(&all) } else { all.join(", ") };
    format!("choose one by its id or number after #: {all}{more}")
}

/// The shader inside the API's wrapper, if it is wrapped.
struct Wrapped<'t>(Option<&'t RawValue>);

impl<'t> serde::Deserialize<'t> for Wrapped<'t> {
    fn deserialize<D: serde::Deserializer<'t>>(deserializer: D) -> Result<Self, D::Error> {
        match RootContent::deserialize(deserializer)? {
            RootContent::Object(object) => Ok(Wrapped(object.shader)),
            _ => Ok(Wrapped(None)),
        }
    }
}

/// The separator between a JSON file and one of its shaders.
const OF_FILE: char = '#';

/// Returns the path that names one of the shaders of a JSON file.
pub(crate) fn one_of(path: &Path, wanted: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(format!("{OF_FILE}{wanted}"));
    name.into()
}

/// Parses a path made by [`one_of`] into the JSON file and the shader.
pub(crate) fn of_several(spec: &str) -> Option<(PathBuf, String)> {
    let is_json = |path: &&str| Path::new(path).extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
    let mut places = spec.match_indices(OF_FILE).map(|(at, _)| at);
    let at = places.find(|&at| is_json(&&spec[..at]) && Path::new(&spec[..at]).is_file())?;
    Some((PathBuf::from(&spec[..at]), spec[at + OF_FILE.len_utf8()..].to_owned()))
}
