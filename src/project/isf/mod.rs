//! Interactive Shader Format, version 2: a fragment shader with a JSON object in its first comment, which describes
//! inputs and passes. Source: <https://github.com/mrRay/ISF_Spec>.
//!
//! A file becomes a project whose passes include it: its text is unchanged, and an edit of the included file is an edit
//! of the ISF file. Owns the header ([`header`]), the sizes of passes ([`size`]), the texts around the file ([`texts`])
//! and the project ([`read`]). The conversion back is in the package `translate`.

mod header;
mod read;
mod size;
mod texts;

#[cfg(test)]
mod tests;

pub(super) use read::load;

use super::{
    files::{EditedTexts, Files, Read},
    limits,
};

use super::{lines::trim_start, words::find_word};
use std::path::{Path, PathBuf};

/// Returns the JSON of an ISF file and its offset, if it is in the first comment between `/*` and `*/`, and the text
/// has the entry point of a complete fragment shader. `//` comments may precede it. All keys are optional: an object
/// with none of them counts if the file has the extension of ISF, `.fs`.
pub(super) fn json_of<'t>(path: &Path, text: &'t str) -> Option<(usize, &'t str)> {
    let mut start = trim_start(text.trim_start_matches('\u{feff}'));
    while let Some(line) = start.strip_prefix("//") {
        start = trim_start(line.split_once('\n')?.1);
    }
    let comment = start.strip_prefix("/*")?;
    let end = comment.find("*/")?;
    let json = &comment[..end];
    let keys =
        ["\"ISFVSN\"", "\"INPUTS\"", "\"PASSES\"", "\"IMPORTED\"", "\"CATEGORIES\"", "\"DESCRIPTION\"", "\"CREDIT\""];
    let is_object = || {
        path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("fs"))
            && json.trim_start().strip_prefix('{').is_some_and(|rest| rest.trim() == "}")
    };
    let is_isf = json.trim_start().starts_with('{') && keys.iter().any(|key| json.contains(key)) || is_object();
    let is_whole = find_word(text, "main").is_some() && find_word(text, "mainImage").is_none()
        || find_word(text, "gl_FragColor").is_some();
    (is_isf && is_whole).then(|| (text.len() - comment.len(), json))
}

/// Returns the ISF file that a vertex shader belongs to: `a.fs` next to `a.vs`; texts of an editor override the files
/// on disk.
pub fn isf_of_vertex_shader(path: &Path, edited: &EditedTexts) -> Option<PathBuf> {
    path.extension().filter(|ending| ending.eq_ignore_ascii_case("vs"))?;
    let fragment = path.with_extension("fs");
    let files = Files::edited(path.parent().unwrap_or(Path::new("")), edited);
    match files.read(&fragment.file_name()?.to_string_lossy(), limits::GLSL_TEXT) {
        Read::Text(text) if json_of(&fragment, &text).is_some() => Some(fragment),
        _ => None,
    }
}
