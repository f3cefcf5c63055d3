//! The programs besides Shadertoy whose shaders Eddy draws unchanged, and the one place that selects a program for a
//! file.

use super::{file_names::is_vertex_extension, isf, words::find_word};
use std::{ffi::OsStr, path::Path};

/// The program that the texts of a project are written for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dialect {
    #[default]
    Shadertoy,
    /// Custom shaders of the terminal Ghostty ([`super::ghostty`]).
    Ghostty,
    /// Interactive Shader Format ([`super::isf`]).
    Isf,
}

impl Dialect {
    pub const ALL: [Dialect; 3] = [Dialect::Shadertoy, Dialect::Ghostty, Dialect::Isf];

    /// The name in `eddy.toml` and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Dialect::Shadertoy => "shadertoy",
            Dialect::Ghostty => "ghostty",
            Dialect::Isf => "isf",
        }
    }

    /// Returns the dialect with a name.
    pub fn of(name: &str) -> Option<Dialect> {
        Self::ALL.into_iter().find(|dialect| dialect.name().eq_ignore_ascii_case(name))
    }
}

/// The form of a GLSL file outside a project. All code that reads such files calls [`ShaderForm::of`], so that the
/// command line, the window and editors agree. A Ghostty shader looks like a Shadertoy one: the user marks it with
/// `ghostty:` in [`super::load`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShaderForm {
    /// A pass of Shadertoy's, and the fallback for other texts: the compiler's messages name the program it is written
    /// for.
    Shadertoy,
    Isf,
    /// A GLSL ES 3.00 vertex shader with its own `main` and uniforms, which is checked but not drawn.
    PlainVertex,
    /// A fragment shader of the same kind.
    PlainFragment,
}

impl ShaderForm {
    /// Returns the form of a file by its text and its extensions.
    pub fn of(path: &Path, text: &str) -> ShaderForm {
        if isf::json_of(path, text).is_some() {
            return ShaderForm::Isf;
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let is_vertex = name.split('.').skip(1).any(|ending| is_vertex_extension(OsStr::new(ending)));
        let has = |word: &str| find_word(text, word).is_some();
        if is_vertex {
            return ShaderForm::PlainVertex;
        }
        if ["mainImage", "mainSound", "mainCubemap"].into_iter().any(has) || !has("main") {
            return ShaderForm::Shadertoy;
        }
        match text.trim_start_matches('\u{feff}').lines().map(str::trim).find(|line| line.starts_with('#')) {
            _ if has("gl_Position") => ShaderForm::PlainVertex,
            // Without this line, or with another version, a fragment shader is in another language.
            Some(line) if line.split_whitespace().eq(["#version", "300", "es"]) => ShaderForm::PlainFragment,
            _ => ShaderForm::Shadertoy,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_form_depends_on_the_name_and_the_text() {
        let of = |name: &str, text: &str| ShaderForm::of(Path::new(name), text);
        let (image, main) = ("void mainImage(out vec4 c, in vec2 p) {}", "#version 300 es\nvoid main() {}");
        assert_eq!(of("a.glsl", image), ShaderForm::Shadertoy);
        assert_eq!(of("a.frag", image), ShaderForm::Shadertoy);
        assert_eq!(of("a.frag", main), ShaderForm::PlainFragment);
        assert_eq!(of("a.glsl", &format!("// A licence.\n\n  {main}")), ShaderForm::PlainFragment);
        for version in ["", "#version 410 core", "#version 100", "#define A"] {
            assert_eq!(of("a.frag", &format!("{version}\nvoid main() {{}}")), ShaderForm::Shadertoy, "{version}");
        }
        assert_eq!(of("a.glsl", "void main() { gl_Position = vec4(0); }"), ShaderForm::PlainVertex);
        assert_eq!(of("a.glsl", "#version 300 es\nvoid main() { /* gl_Position */ }"), ShaderForm::PlainFragment);
        assert_eq!(of("a.vert.glsl", ""), ShaderForm::PlainVertex);
        assert_eq!(of("noise.glsl", "float noise(vec2 p) { return p.x; }"), ShaderForm::Shadertoy);
        assert_eq!(of("a.fs", "/*{}*/ void main() {}"), ShaderForm::Isf);
    }
}
