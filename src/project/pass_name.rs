//! The names of passes, and the two orders in which they are listed.

use super::{Role, RoleRow, limits};
use eddy_texture::Dimension;
use std::{cmp::Ordering, fmt, sync::Arc};

/// The name of a pass, unique in its project: channels, settings, files and commands refer to a pass by it. It includes
/// the role, as in file names. Cheap to clone.
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct PassName {
    role: Role,
    /// The spelling in file names.
    key: Arc<str>,
}

impl PassName {
    /// The pass whose picture the window shows and `eddy render` writes.
    pub fn image() -> PassName {
        PassName::new(Role::Image, "")
    }

    pub fn cube() -> PassName {
        PassName::new(Role::Cube, "")
    }

    pub fn sound() -> PassName {
        PassName::new(Role::Sound, "")
    }

    /// A buffer: `A` to `D` as on Shadertoy, or any further name that a project chooses.
    pub fn buffer(name: impl AsRef<str>) -> PassName {
        PassName::new(Role::Buffer, name.as_ref())
    }

    /// A pass of a role. `own` distinguishes the passes of this role; empty if a project has only one.
    pub(crate) fn new(role: Role, own: &str) -> PassName {
        PassName { role, key: format!("{}{}", role.row().key, own.to_lowercase()).into() }
    }

    pub fn role(&self) -> Role {
        self.role
    }

    /// Returns the row of its role.
    pub fn row(&self) -> &'static RoleRow {
        self.role.row()
    }

    /// Returns the spelling of file names, `eddy.toml` and `--pass`: `buffer_a`, `cube_a`, `sound`, `image`.
    pub fn key(&self) -> &str {
        &self.key
    }

    /// Returns the title that tabs show: `Buffer A`, `Cube A`, `Sound`, `Image`.
    pub fn title(&self) -> String {
        format!("{}{}", self.row().title, self.own())
    }

    /// Returns a buffer's name without the word `Buffer`: `A`, `glow`. `None` for other passes.
    pub fn buffer_name(&self) -> Option<&str> {
        self.is_buffer().then(|| self.own())
    }

    /// The part of the name that distinguishes passes of one role. A Shadertoy buffer is one capital letter; other
    /// names are in lower case, as file names fold case.
    fn own(&self) -> &str {
        const LETTERS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";
        let own = self.key.get(self.row().key.len()..).unwrap_or_default();
        match own.as_bytes() {
            [letter @ b'a'..=b'z'] => LETTERS.get(usize::from(letter - b'a')..).and_then(|l| l.get(..1)).unwrap_or(own),
            _ => own,
        }
    }

    /// Returns whether it is one of the project's buffers, which users add, name, order and remove.
    pub fn is_buffer(&self) -> bool {
        self.role == Role::Buffer
    }

    /// Returns whether it is the one pass whose picture is shown.
    pub fn is_image(&self) -> bool {
        self.role == Role::Image
    }

    /// Returns whether it is a sound pass, which is drawn separately from frames.
    pub fn is_sound(&self) -> bool {
        self.role == Role::Sound
    }

    /// Returns whether it has a picture.
    pub fn is_picture(&self) -> bool {
        self.row().target.is_some()
    }

    /// Returns whether its picture has six faces.
    pub fn has_faces(&self) -> bool {
        self.row().target == Some(Dimension::Cube)
    }

    /// Returns whether channels of a picture can read it.
    pub fn is_readable(&self) -> bool {
        self.row().input.is_some()
    }

    /// Compares by drawing order. All buffers are equal: a stable sort leaves them in the project's order, which the
    /// author chooses.
    pub fn drawing_order(&self, other: &PassName) -> Ordering {
        self.row().order.cmp(&other.row().order)
    }

    /// Compares by the order of tabs: drawing order, with buffers by name.
    pub fn tab_order(&self, other: &PassName) -> Ordering {
        self.drawing_order(other).then_with(|| self.cmp(other))
    }

    /// The rule for buffer names, for messages.
    pub const NAMES: &str = "use letters, digits, _, - and spaces, at most 64 of them";

    /// Parses either spelling, ignoring case, spaces and underscores; a bare letter is a buffer. Names become parts of
    /// file names, so this returns `None` for names with characters other than letters, digits, blanks, `_` and `-`, or
    /// longer than [`limits::NAME`].
    pub fn parse(text: &str) -> Option<PassName> {
        if text.chars().nth(limits::NAME + "buffer_".len()).is_some() {
            return None;
        }
        let flat: String = text.chars().filter(|c| !matches!(c, ' ' | '_' | '-')).collect::<String>().to_lowercase();
        if let Some(role) = Role::find(|row| row.spellings.contains(&flat.as_str())) {
            return role.only_pass();
        }
        let name = flat.strip_prefix("buffer").or_else(|| flat.strip_prefix("buf")).unwrap_or(&flat);
        PassName::is_name(name).then(|| PassName::buffer(name))
    }

    /// The buffer with a name in user input: `glow`, `Buffer glow`, `Velocity field`. Names are stored without blanks,
    /// `_` and `-`, and in lower case unless they are one letter.
    pub fn buffer_named(text: &str) -> Option<PassName> {
        let text = text.trim();
        let rest = text.split_once([' ', '_', '-']).filter(|(first, _)| first.eq_ignore_ascii_case("buffer"));
        let name = rest.map_or(text, |(_, rest)| rest);
        PassName::parse(&format!("buffer_{name}")).filter(PassName::is_buffer)
    }

    /// Returns whether a buffer may have this name: letters and digits, within the length limit.
    pub fn is_name(name: &str) -> bool {
        !name.is_empty() && name.chars().count() <= limits::NAME && name.chars().all(char::is_alphanumeric)
    }
}

/// Image, which is shown unless another pass is selected.
impl Default for PassName {
    fn default() -> Self {
        PassName::image()
    }
}

/// Buffers by name, Shadertoy's letters first; then the passes of other roles.
impl Ord for PassName {
    fn cmp(&self, other: &Self) -> Ordering {
        self.role.cmp(&other.role).then_with(|| self.own().cmp(other.own()))
    }
}

impl PartialOrd for PassName {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl fmt::Debug for PassName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_buffer_may_have_the_name_of_another_role() {
        let named = |text: &str| PassName::buffer_named(text).map(|id| id.title());
        let cases = [("glow", "glow"), ("Buffer glow", "glow"), ("b", "B"), ("Velocity Field", "velocityfield")];
        for (text, name) in cases.into_iter().chain([("image", "image"), ("bufx", "bufx"), ("buffer", "buffer")]) {
            assert_eq!(named(text), Some(format!("Buffer {name}")), "{text}");
            let id = PassName::buffer_named(text).unwrap();
            assert_eq!(PassName::parse(id.key()), Some(id), "{text}");
        }
        for text in ["", " ", "a/b", "a.b", "a\"b", "buffer -"] {
            assert_eq!(named(text), None, "{text}");
        }
    }

    #[test]
    fn names_are_ordered_by_role_and_shadertoy_buffers_come_first() {
        let mut names: Vec<PassName> = ["image", "sound", "cube_a", "buffer_aa", "buffer_b", "buffer_1", "buffer_a"]
            .map(|k| PassName::parse(k).unwrap())
            .into();
        names.sort();
        let keys: Vec<&str> = names.iter().map(PassName::key).collect();
        assert_eq!(keys, ["buffer_1", "buffer_a", "buffer_b", "buffer_aa", "cube_a", "sound", "image"]);
        names.sort_by(PassName::tab_order);
        assert_eq!(names[4..].iter().map(PassName::title).collect::<Vec<_>>(), ["Cube A", "Image", "Sound"]);
    }
}
