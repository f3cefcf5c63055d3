//! Plain shaders: files of one stage with a `main` of their own.

use eddy_glsl::PassKind;
use std::path::Path;

/// Returns which stage of GLSL ES a text is that has `void main()` and none of Shadertoy's entry points; `None` for a
/// text of Shadertoy's, or one of neither.
pub(crate) fn stage(path: &Path, text: &str) -> Option<PassKind> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
    let names: Vec<&str> = name.split('.').skip(1).collect();
    let has = |endings: &[&str]| names.iter().any(|part| endings.contains(part));
    let is_vertex = has(&["vert", "vs", "vertex"]);
    if words(text).any(is_entry) && !is_vertex {
        return None;
    }
    let is_stage = words(text).any(|word| word == "main");
    if is_vertex || (is_stage && words(text).any(|word| word == "gl_Position")) {
        return Some(PassKind::PlainVertex);
    }
    is_stage.then_some(PassKind::PlainFragment)
}

/// Returns whether a text is a pass of its own rather than one that others include.
pub(crate) fn has_entry(text: &str) -> bool {
    words(text).any(|word| is_entry(word) || word == "main")
}

fn is_entry(word: &str) -> bool {
    matches!(word, "mainImage" | "mainSound" | "mainCubemap")
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stage_is_told_by_its_name_and_its_text() {
        let of = |name: &str, text: &str| stage(Path::new(name), text);
        assert_eq!(of("a.glsl", "void mainImage(out vec4 c, in vec2 p) {}"), None);
        assert_eq!(of("a.frag", "void mainImage(out vec4 c, in vec2 p) {}"), None);
        assert_eq!(of("a.frag", "void main() {}"), Some(PassKind::PlainFragment));
        assert_eq!(of("a.glsl", "void main() { gl_Position = vec4(0); }"), Some(PassKind::PlainVertex));
        assert_eq!(of("a.vert.glsl", ""), Some(PassKind::PlainVertex));
        assert_eq!(of("noise.glsl", "float noise(vec2 p) { return p.x; }"), None);
    }
}
