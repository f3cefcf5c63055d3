//! Selects the program that a file is written for, by its text and its name.

use super::{Dialect, EntryPoint, samplers::declared_uniforms};
use crate::{
    file_names::is_vertex_extension,
    isf,
    words::{all_words, find_word},
};
use std::{collections::HashSet, ffi::OsStr, path::Path};

/// The form of a GLSL file outside a project. All code that reads such files calls [`ShaderForm::of`], so that the
/// command line, the window and editors agree. A Ghostty shader looks like a Shadertoy one: the user marks it with
/// `ghostty:` in [`crate::load`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShaderForm {
    /// A fragment shader, or a text that others include, which is taken for one of Shadertoy's.
    Program(Dialect),
    /// A vertex shader with its own `main` and uniforms, which is checked but not drawn.
    PlainVertex,
}

/// The words by which one dialect is recognised in a text with `void main()`.
struct Marks {
    dialect: Dialect,
    /// One of these words is enough.
    certain: &'static [&'static str],
    /// The names of uniforms of the dialect that other programs have, too: a text that declares one of them is of the
    /// first dialect that lists it.
    likely: &'static [&'static str],
}

/// The dialects with marks; the more certain ones first.
const MARKS: [Marks; 5] = [
    Marks {
        dialect: Dialect::Bonzomatic,
        certain: &["fGlobalTime", "v2Resolution", "texFFT", "texFFTSmoothed", "texFFTIntegrated", "texPreviousFrame"],
        likely: &["fFrameTime", "out_texcoord"],
    },
    Marks {
        dialect: Dialect::GlslViewer,
        certain: &["u_resolution", "u_time", "u_mouse", "u_tex0", "u_buffer0", "u_doubleBuffer0", "u_scene", "u_frame"],
        // The uniforms of its row.
        likely: &[],
    },
    // The inputs of shaders for compositors such as Hyprland, which may have a `time`, too.
    Marks { dialect: Dialect::Plain, certain: &["v_texcoord", "v_texCoord", "vTexCoord"], likely: &[] },
    Marks {
        dialect: Dialect::Twigl,
        certain: &["outColor0", "backbuffer0", "backbuffer1"],
        likely: &["sound", "r", "t", "m", "f", "s", "b"],
    },
    Marks {
        dialect: Dialect::GlslSandbox,
        certain: &["surfacePosition", "surfaceSize"],
        likely: &["time", "resolution", "mouse", "backbuffer"],
    },
];

impl ShaderForm {
    /// Returns the form of a file by its text and its extensions.
    pub fn of(path: &Path, text: &str) -> ShaderForm {
        if isf::json_of(path, text).is_some() {
            return ShaderForm::Program(Dialect::Isf);
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if name.split('.').skip(1).any(|ending| is_vertex_extension(OsStr::new(ending))) {
            return ShaderForm::PlainVertex;
        }
        let words = all_words(text);
        let has = |word: &str| words.contains(word);
        if !has("mainImage") && !has("main") && is_sound(text) {
            return ShaderForm::Program(Dialect::Twigl);
        }
        if ["mainImage", "mainSound", "mainCubemap"].into_iter().any(has) {
            return ShaderForm::Program(Dialect::Shadertoy);
        }
        if has("main") && has("gl_Position") {
            return ShaderForm::PlainVertex;
        }
        ShaderForm::Program(match has("main") {
            true => of_main(text, &words),
            false if is_geekest(text, &words) => Dialect::Twigl,
            false => Dialect::Shadertoy,
        })
    }

    /// Returns the dialect of a complete fragment shader; `None` for other texts.
    pub(crate) fn main_dialect(self) -> Option<Dialect> {
        match self {
            ShaderForm::Program(dialect) if dialect.row().entry == EntryPoint::Main => Some(dialect),
            _ => None,
        }
    }
}

/// Returns the dialect of a text with `void main()`.
fn of_main(text: &str, words: &HashSet<&str>) -> Dialect {
    let has = |word: &str| words.contains(word);
    let has_short_names = has("r") && ["t", "m", "f", "s", "b"].into_iter().any(has);
    if !has("uniform") && has_short_names && ["FC", "gl_FragCoord"].into_iter().any(has) {
        return Dialect::Twigl;
    }
    let declared = declared_uniforms(text);
    let row = Dialect::GlslViewer.row();
    let is_of_row = |name: &str| {
        let is_set = row.uniforms.iter().any(|uniform| uniform.name == name);
        name.starts_with("u_") && (is_set || row.identities.iter().any(|(matrix, _)| *matrix == name))
    };
    if declared.iter().any(|uniform| is_of_row(&uniform.name)) {
        return Dialect::GlslViewer;
    }
    let certain = MARKS.iter().find(|marks| marks.certain.iter().any(|word| words.contains(word)));
    if let Some(marks) = certain {
        return marks.dialect;
    }
    let is_declared = |name: &&str| declared.iter().any(|uniform| uniform.name == **name);
    // GLSL Sandbox runs WebGL 1.
    let is_later = text.lines().any(|line| line.trim_start().starts_with("#version") && !line.contains("100"));
    let is_possible = |marks: &&Marks| marks.dialect != Dialect::GlslSandbox || !is_later;
    let mut possible = MARKS.iter().filter(is_possible);
    let likely = possible.find(|marks| marks.likely.iter().any(&is_declared));
    likely.map_or(Dialect::Plain, |marks| marks.dialect)
}

/// Returns whether a text is a sound shader of twigl: its entry point takes the time, and not the number of the sample.
pub(super) fn is_sound(text: &str) -> bool {
    let Some(at) = find_word(text, "mainSound") else { return false };
    let rest = text[at + "mainSound".len()..].trim_start();
    let parameters = rest.strip_prefix('(').and_then(|rest| rest.split_once(')')).map(|(parameters, _)| parameters);
    parameters.is_some_and(|parameters| parameters.contains("float") && !parameters.contains(','))
}

/// Returns whether a text without `main` is the body of one, as in twigl's mode geekest: it writes the output, and reads
/// the position of the pixel or the short names of the uniforms.
fn is_geekest(text: &str, words: &HashSet<&str>) -> bool {
    let has = |word: &&str| words.contains(*word);
    let has_output = ["o", "o0", "gl_FragColor"].iter().any(&has);
    let has_position = ["FC", "gl_FragCoord"].iter().any(&has);
    // A file of functions for others to include, or a pass of another program.
    let has_function = ["return", "void", "in", "out", "inout", "uniform"].iter().any(has);
    has_output && has_position && !has_function && text.contains('=')
}
