//! The names of passes, and the two orders that they stand in.

use super::{PassKind, limits};
use std::cmp::Ordering;

/// Names a pass. Buffers are told apart by name: `A`..`D` as on the site, or any further name a project gives.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PassId {
    Buffer(String),
    Cubemap,
    Sound,
    #[default]
    Image,
}

impl PassId {
    /// Compares by when in a frame passes are drawn. All buffers are equal: a stable sort leaves them in the project's
    /// order, which an author chooses.
    pub fn drawing_order(&self, other: &PassId) -> Ordering {
        self.row().order.cmp(&other.row().order)
    }

    /// Compares by the places of tabs: as passes are drawn, buffers by name.
    pub fn tab_order(&self, other: &PassId) -> Ordering {
        self.drawing_order(other).then_with(|| self.cmp(other))
    }

    /// Returns the title that tabs show: `Buffer A`, `Cube A`, `Sound`, `Image`.
    pub fn title(&self) -> String {
        let title = self.row().title;
        match self {
            PassId::Buffer(name) => format!("{title}{name}"),
            _ => title.into(),
        }
    }

    /// Returns the spelling of file names, `eddy.toml` and `--pass`: `buffer_a`, `cube_a`, `sound`, `image`.
    pub fn key(&self) -> String {
        let key = self.row().key;
        match self {
            PassId::Buffer(name) => format!("{key}{}", name.to_lowercase()),
            _ => key.into(),
        }
    }

    /// The rule for buffers' names, as a message says it.
    pub const NAMES: &str = "use letters, digits, _, - and spaces, at most 64 of them";

    /// Reads either spelling, without regard to case, spaces or underscores; a bare letter is a buffer. Names become
    /// parts of files' names, so `None` for one with anything but letters, digits, blanks, `_` and `-`, or longer than
    /// [`limits::NAME`].
    pub fn parse(text: &str) -> Option<PassId> {
        if text.chars().nth(limits::NAME + "buffer_".len()).is_some() {
            return None;
        }
        let flat: String = text.chars().filter(|c| !matches!(c, ' ' | '_' | '-')).collect::<String>().to_lowercase();
        if let Some(kind) = PassKind::find(|row| row.spellings.contains(&flat.as_str())) {
            return kind.id();
        }
        let name = flat.strip_prefix("buffer").or_else(|| flat.strip_prefix("buf")).unwrap_or(&flat);
        // A site buffer is one capital letter; further names are kept in lower case, as file names fold case.
        let kept = || if name.len() == 1 { name.to_uppercase() } else { name.to_owned() };
        PassId::is_name(name).then(|| PassId::Buffer(kept()))
    }

    /// The buffer that a person calls so: `glow`, `Buffer glow`, `Velocity field`. Names are kept without blanks, `_`
    /// and `-`, and in lower case unless they are one letter.
    pub fn buffer_named(text: &str) -> Option<PassId> {
        let text = text.trim();
        let rest = text.split_once([' ', '_', '-']).filter(|(first, _)| first.eq_ignore_ascii_case("buffer"));
        let name = rest.map_or(text, |(_, rest)| rest);
        PassId::parse(&format!("buffer_{name}")).filter(|id| matches!(id, PassId::Buffer(_)))
    }

    /// Returns whether a buffer may be called so: letters and digits, not too many.
    pub fn is_name(name: &str) -> bool {
        !name.is_empty() && name.chars().count() <= limits::NAME && name.chars().all(char::is_alphanumeric)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_buffer_may_be_called_what_another_pass_is() {
        let named = |text: &str| PassId::buffer_named(text).map(|id| id.title());
        let cases = [("glow", "glow"), ("Buffer glow", "glow"), ("b", "B"), ("Velocity Field", "velocityfield")];
        for (text, name) in cases.into_iter().chain([("image", "image"), ("bufx", "bufx"), ("buffer", "buffer")]) {
            assert_eq!(named(text), Some(format!("Buffer {name}")), "{text}");
            let id = PassId::buffer_named(text).unwrap();
            assert_eq!(PassId::parse(&id.key()), Some(id), "{text}");
        }
        for text in ["", " ", "a/b", "a.b", "a\"b", "buffer -"] {
            assert_eq!(named(text), None, "{text}");
        }
    }
}
