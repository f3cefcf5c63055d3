//! The shaders of a Ghostty configuration: its `custom-shader` lines, which are drawn one after the other.
//!
//! Source: `custom-shader` in `src/config/Config.zig` and `RepeatablePath` in `src/config/path.zig` of Ghostty. A path is
//! relative to the file, `~/` is the home folder, a `?` at its start allows the file to be missing, and an empty value
//! removes the shaders of the lines before it.

use super::dress;
use crate::{
    Loaded, Origin, Pass, PassName, Project, ProjectError, Source, confine, expand_home, file_names,
    files::{self, Read},
    limits,
};
use eddy_diag::{Diagnostic, SourceMap, Span};
use std::{
    collections::BTreeSet,
    ops::Range,
    path::{Path, PathBuf},
};

const KEY: &str = "custom-shader";

/// A line of the configuration with a shader.
#[derive(Debug, PartialEq)]
struct Line<'t> {
    path: &'t str,
    /// The place of the path in the text.
    range: Range<usize>,
    may_be_missing: bool,
}

/// Returns the shaders that a configuration names, in the order in which they are drawn.
fn shaders(text: &str) -> Vec<Line<'_>> {
    let mut found = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let at = start;
        start += line.len();
        let Some((key, value)) = line.split_once('=') else { continue };
        if key.trim() != KEY {
            continue;
        }
        let value = value.trim();
        let value = value.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(value);
        let path = value.strip_prefix('?').unwrap_or(value);
        if path.is_empty() {
            found.clear();
            continue;
        }
        let offset = at + (path.as_ptr() as usize - line.as_ptr() as usize);
        found.push(Line { path, range: offset..offset + path.len(), may_be_missing: path.len() != value.len() });
    }
    found
}

/// Loads the shaders of a configuration as one project: each reads the picture of the one before it in `iChannel0`.
pub(crate) fn load(path: &Path) -> Result<Loaded, ProjectError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut sources = SourceMap::default();
    let invalid =
        |diagnostics, sources| Err(ProjectError::Invalid { what: path.display().to_string(), diagnostics, sources });
    let text = match files::decode(confine::read_own(path, limits::MANIFEST)?) {
        Read::Text(text) => text,
        Read::NotUtf8(at, lossy) => {
            let diagnostics = vec![files::not_utf8(&mut sources, &name, at, lossy)];
            return invalid(diagnostics, sources);
        }
        Read::Missing | Read::Refused(_) => unreachable!("decode is given what was read"),
    };
    let id = sources.add(&*name, &*text);
    let lines = shaders(&text);
    if lines.is_empty() {
        let error = Diagnostic::error(None, format!("{name} names no shader"));
        let hint = "write `custom-shader = FILE.glsl`, or open the .glsl file itself";
        return invalid(vec![error.hint(hint)], sources);
    }
    let mut diagnostics = Vec::new();
    let mut found: Vec<(PathBuf, String)> = Vec::new();
    for line in &lines {
        let mut error = |message: String, hint: &str| {
            diagnostics.push(Diagnostic::error(Span::new(id, line.range.clone()), message).hint(hint));
        };
        let file = folder.join(expand_home(line.path));
        if found.len() + 1 == limits::PASSES {
            error(format!("these are more than {} shaders, the limit", found.len()), "remove some of these lines");
            break;
        }
        if !file_names::is_glsl_extension(file.extension().unwrap_or_default()) {
            error(format!("{} is not a GLSL file", line.path), "rename it to end in .glsl");
            continue;
        }
        match confine::read_own(&file, limits::GLSL_TEXT) {
            Ok(bytes) => match String::from_utf8(bytes) {
                Ok(text) => found.push((file, text)),
                Err(_) => error(format!("{} is not UTF-8 text", line.path), "save it as UTF-8 in your editor"),
            },
            Err(e) if e.is_missing() && line.may_be_missing => {}
            Err(e) => error(e.to_string(), "correct the path; it is relative to this file"),
        }
    }
    if !diagnostics.is_empty() {
        return invalid(diagnostics, sources);
    }
    if found.is_empty() {
        let error = Diagnostic::error(None, format!("none of the shaders that {name} names exists"));
        return invalid(vec![error.hint("correct a path of its `custom-shader` lines")], sources);
    }
    let mut project = Project::new(name, passes(folder, found), Origin::File(path.to_owned()));
    dress(&mut project);
    Ok(Loaded { sources: project.sources(), project, warnings: Vec::new() })
}

/// Returns a pass for each shader. The last one is Image.
fn passes(folder: &Path, shaders: Vec<(PathBuf, String)>) -> Vec<Pass> {
    let last = shaders.len() - 1;
    let mut names = BTreeSet::from([super::TERMINAL.to_owned()]);
    let mut passes = Vec::new();
    for (at, (path, text)) in shaders.into_iter().enumerate() {
        let id = match at == last {
            true => PassName::image(),
            false => {
                let stem = path.file_stem().unwrap_or_default().to_string_lossy();
                let letters: String = stem
                    .chars()
                    .map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' })
                    .collect();
                let numbered = (2..).map(|number| format!("{letters}_{number}"));
                let free = std::iter::once(letters.clone()).chain(numbered).find(|name| names.insert(name.clone()));
                PassName::buffer(free.unwrap_or_default())
            }
        };
        let name = path.strip_prefix(folder).unwrap_or(&path).display().to_string();
        passes.push(Pass::new(id, Source { name, path: Some(path), text: text.into() }));
    }
    passes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Input, Overwrite, load, save};
    use std::fs;

    #[test]
    fn lines_are_read_as_ghostty_reads_them() {
        let text = "# custom-shader = a.glsl\nfont-size = 13\ncustom-shader = old.glsl\ncustom-shader =\n\
                    custom-shader = \"my shaders/a.glsl\"\n  custom-shader=?b.glsl  \ncustom-shader-animation = always\n";
        let lines = shaders(text);
        let paths: Vec<(&str, bool)> = lines.iter().map(|line| (line.path, line.may_be_missing)).collect();
        assert_eq!(paths, [("my shaders/a.glsl", false), ("b.glsl", true)]);
        assert!(lines.iter().all(|line| &text[line.range.clone()] == line.path));
    }

    #[test]
    fn each_shader_reads_the_picture_of_the_one_before() {
        let dir = tempfile::tempdir().unwrap();
        let at = |name: &str| dir.path().join(name);
        fs::create_dir(at("shaders")).unwrap();
        let shader = "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p / iResolution.xy); }\n";
        for name in ["glow.glsl", "shaders/glow.glsl", "shaders/last.glsl"] {
            fs::write(at(name), shader).unwrap();
        }
        let text = "custom-shader = glow.glsl\ncustom-shader = shaders/glow.glsl\ncustom-shader = ?none.glsl\n\
                    custom-shader = shaders/last.glsl\n";
        fs::write(at("config"), text).unwrap();
        let spec = format!("ghostty:{}", at("config").display());
        let project = load(&spec).unwrap().project;
        let names: Vec<String> = project.passes.iter().map(|pass| pass.id.title()).collect();
        assert_eq!(names, ["Buffer terminal", "Buffer glow", "Buffer glow_2", "Image"]);
        for pair in project.passes.windows(2) {
            assert_eq!(pair[1].bindings.get(0).map(|channel| &channel.input), Some(&Input::pass(pair[0].id.clone())));
        }
        assert_eq!(crate::spec_of(&at("config"), project.dialect), spec);

        // Saving writes the shaders, each to its own file.
        let mut edited = project;
        edited.passes[2].source.text = shader.replace("c =", "c = 0.5 *").into();
        let saved = save(&edited, &at("config"), Overwrite::Refuse).unwrap();
        assert_eq!(fs::read_to_string(at("shaders/glow.glsl")).unwrap(), &*edited.passes[2].source.text);
        assert_eq!(fs::read_to_string(at("config")).unwrap(), text);
        assert_eq!(saved.passes.len(), 4);
        edited.passes.remove(1);
        assert!(save(&edited, &at("config"), Overwrite::Refuse).is_err());

        for (text, message) in [
            ("font-size = 13\n", "config names no shader"),
            ("custom-shader = ?none.glsl\n", "none of the shaders that config names exists"),
            ("\ncustom-shader = none.glsl\n", "config:2:17"),
            ("custom-shader = config\n", "config is not a GLSL file"),
        ] {
            fs::write(at("config"), text).unwrap();
            let error = load(&spec).unwrap_err().to_string();
            assert!(error.contains(message), "{error}");
        }
    }
}
