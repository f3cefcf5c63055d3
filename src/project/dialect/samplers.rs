//! Reads the uniforms that a text declares, without parsing its language: `uniform sampler2D u_tex0; // data/moon.jpg`.

use eddy_texture::Dimension;
use std::collections::HashSet;

/// A uniform that a text declares at file scope.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct DeclaredUniform {
    pub ty: String,
    pub name: String,
    pub is_array: bool,
    /// The text of the comment on the same line.
    pub comment: String,
    /// The offset of the name in the text.
    pub at: usize,
}

impl DeclaredUniform {
    /// Returns the dimension of a sampler's texture; `None` for other types. A one-dimensional texture has one row.
    pub(crate) fn dimension(&self) -> Option<Dimension> {
        match self.ty.as_str() {
            _ if self.is_array => None,
            "sampler2D" | "sampler1D" | "sampler2DRect" => Some(Dimension::D2),
            "sampler3D" => Some(Dimension::D3),
            "samplerCube" => Some(Dimension::Cube),
            _ => None,
        }
    }
}

/// Returns the uniforms that a text declares outside comments, without duplicates. Lines of any conditional group count.
pub(crate) fn declared_uniforms(text: &str) -> Vec<DeclaredUniform> {
    let mut found: Vec<DeclaredUniform> = Vec::new();
    let mut seen: HashSet<&str> = HashSet::new();
    let mut words = Words { text, at: 0 };
    while let Some((_, word)) = words.next() {
        if word != "uniform" {
            continue;
        }
        let mut ty = None;
        let mut declared: Vec<(&str, &str, usize, bool)> = Vec::new();
        let mut is_named = false;
        for (at, word) in words.by_ref() {
            match (word, ty) {
                ("highp" | "mediump" | "lowp" | "coherent" | "restrict", _) => {}
                (";" | "{" | "(" | "#", _) => break,
                (",", Some(_)) => is_named = false,
                ("[", Some(_)) if is_named => {
                    if let Some((.., is_array)) = declared.last_mut() {
                        *is_array = true;
                    }
                }
                (_, None) if is_identifier(word) => ty = Some(word),
                (_, Some(ty)) if is_identifier(word) && !is_named => {
                    is_named = true;
                    declared.push((ty, word, at, false));
                }
                _ => {}
            }
        }
        let rest = text[words.at..].lines().next().unwrap_or_default();
        let comment = rest.split_once("//").map_or("", |(_, comment)| comment).trim();
        for (ty, name, at, is_array) in declared {
            if seen.insert(name) {
                let (ty, name, comment) = (ty.to_owned(), name.to_owned(), comment.to_owned());
                found.push(DeclaredUniform { ty, name, is_array, comment, at });
            }
        }
    }
    found
}

fn is_identifier(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

/// The words and the other characters of a text outside comments, with their offsets.
struct Words<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Iterator for Words<'t> {
    type Item = (usize, &'t str);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let rest = &self.text[self.at..];
            let first = rest.chars().next()?;
            if rest.starts_with("//") {
                self.at += rest.find('\n').unwrap_or(rest.len());
            } else if let Some(comment) = rest.strip_prefix("/*") {
                self.at += comment.find("*/").map_or(rest.len(), |end| end + 4);
            } else if first.is_whitespace() {
                self.at += first.len_utf8();
            } else {
                let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
                let length = rest.find(|c| !is_letter(c)).unwrap_or(rest.len()).max(first.len_utf8());
                let at = self.at;
                self.at += length;
                return Some((at, &rest[..length]));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_are_found_with_their_comments() {
        let text = "uniform sampler2D u_tex0; // data/moon.jpg\nuniform highp float a, b[3] , c;\n\
                    /* uniform int no; */ uniform vec2 u_mouse;// uniform int no;\nuniform Block { float d; };\n\
                    #ifdef A\nuniform sampler1D texFFT;\n#endif\nvoid main() { float uniformly; }";
        let found = declared_uniforms(text);
        let shown: Vec<(&str, &str)> = found.iter().map(|u| (&*u.ty, &*u.name)).collect();
        let expected = [
            ("sampler2D", "u_tex0"),
            ("float", "a"),
            ("float", "b"),
            ("float", "c"),
            ("vec2", "u_mouse"),
            ("sampler1D", "texFFT"),
        ];
        assert_eq!(shown, expected);
        assert_eq!(found[0].comment, "data/moon.jpg");
        assert_eq!(&text[found[4].at..][..7], "u_mouse");
        assert_eq!((found[5].dimension(), found[4].dimension()), (Some(Dimension::D2), None));
    }
}
