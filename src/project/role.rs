//! Owns the table of the roles of passes and their properties.

use super::{InputKind, PassName, PassSize};
use eddy_texture::{Dimension, TexelFormat};

/// The purpose of a pass. The properties of a role are in its [`RoleRow`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    Buffer,
    Cube,
    Sound,
    Image,
}

/// The properties of a role.
#[derive(Debug)]
pub struct RoleRow {
    pub role: Role,
    /// True if a project may have several passes of it, each with its own name.
    pub is_named: bool,
    /// The title of tabs; for buffers the prefix of the name.
    pub title: &'static str,
    /// The spelling of file names, `eddy.toml` and `--pass`; for buffers the prefix of the name.
    pub key: &'static str,
    /// Its alternative names, in lower case without blanks.
    pub(crate) spellings: &'static [&'static str],
    /// The type in Shadertoy's JSON.
    pub json_type: &'static str,
    /// The id of its output in that JSON.
    pub json_output: &'static str,
    /// Its place in a frame: the lowest is drawn first.
    pub order: u8,
    /// The kind of the input that reads it, if channels can read it.
    pub input: Option<InputKind>,
    /// The dimension of its target; `None`: it has no picture.
    pub target: Option<Dimension>,
    /// The default size of its target. The target of a sound pass stores a block of samples, one per texel.
    pub size: PassSize,
    /// The format of its target; `None`: its settings decide.
    pub format: Option<TexelFormat>,
    /// Its entry point.
    pub entry: &'static str,
    /// Keys of `eddy.toml` that it does not have, and why.
    pub(crate) refused: &'static [(&'static [&'static str], &'static str)],
    /// A sentence for users who look for a missing feature.
    pub note: &'static str,
}

const NO_MESHES: (&[&str], &str) =
    (&["draw"], "draw the meshes in a buffer, and read it here: channels.0 = { buffer = \"scene\" }");
const NO_PICTURE: &[(&[&str], &str)] = &[
    (&["size", "format", "region"], "only buffers have it"),
    (&["initial", "boundary"], "a sound has no texels"),
    (&["when"], "a sound is made once; test the uniform in mainSound"),
    NO_MESHES,
];

const BUFFER: RoleRow = RoleRow {
    role: Role::Buffer,
    is_named: true,
    title: "Buffer ",
    key: "buffer_",
    spellings: &[],
    json_type: "buffer",
    json_output: "",
    order: 0,
    input: Some(InputKind::Buffer),
    target: Some(Dimension::D2),
    size: PassSize::Canvas,
    format: None,
    entry: "mainImage",
    refused: &[],
    note: "",
};

pub(super) const CUBEMAP: RoleRow = RoleRow {
    role: Role::Cube,
    is_named: false,
    title: "Cube A",
    key: "cube_a",
    spellings: &["cubea", "cubemap", "cubemapa"],
    json_type: "cubemap",
    json_output: "4dX3Rr",
    order: 1,
    input: Some(InputKind::CubemapPass),
    target: Some(Dimension::Cube),
    size: PassSize::Fixed(1024, 1024),
    entry: "mainCubemap",
    format: Some(TexelFormat::Rgba16f),
    refused: &[
        (&["size", "format"], "a cubemap has six faces of 1024x1024 texels of 16-bit floats"),
        (&["region"], "all six faces of a cubemap are drawn whole"),
        (&["initial", "boundary"], "only buffers have it: a cubemap begins as zeros, and its faces have no boundary"),
        NO_MESHES,
    ],
    note: "A cubemap has six faces of 1024x1024 texels of 16-bit floats.",
};

const SOUND: RoleRow = RoleRow {
    role: Role::Sound,
    is_named: false,
    title: "Sound",
    key: "sound",
    spellings: &["sound"],
    json_type: "sound",
    json_output: "XsfGRr",
    order: 3,
    input: None,
    target: None,
    size: PassSize::Fixed(512, 512),
    format: Some(TexelFormat::Rgba8),
    entry: "mainSound",
    refused: NO_PICTURE,
    note: "A sound pass makes 180 s of sound once, and not in each frame. It reads image files and cubemaps.",
};

const IMAGE: RoleRow = RoleRow {
    role: Role::Image,
    is_named: false,
    title: "Image",
    key: "image",
    spellings: &["image"],
    json_type: "image",
    json_output: "4dfGRr",
    order: 2,
    input: None,
    refused: &[
        (
            &["size", "format"],
            "Image has the picture's resolution and 32-bit floats; give a buffer this key and show it in Image",
        ),
        (&["initial"], "no pass can read the last frame of Image; give a buffer this key, and show it in Image"),
        (&["when"], "Image is drawn in every frame; give a buffer this key"),
        NO_MESHES,
    ],
    note: "Image has the picture's resolution and 32-bit floats.",
    ..BUFFER
};

/// Every role, in the order of [`Role`].
static ROWS: [RoleRow; 4] = [BUFFER, CUBEMAP, SOUND, IMAGE];

impl Role {
    pub fn all() -> impl DoubleEndedIterator<Item = Role> {
        ROWS.iter().map(|row| row.role)
    }

    pub fn row(self) -> &'static RoleRow {
        &ROWS[self as usize]
    }

    /// Returns the first role whose row satisfies the predicate.
    pub(crate) fn find(is_it: impl Fn(&RoleRow) -> bool) -> Option<Role> {
        ROWS.iter().find(|row| is_it(row)).map(|row| row.role)
    }

    /// Returns the one pass of this role; `None` for buffers, of which there may be many.
    pub fn only_pass(self) -> Option<PassName> {
        (!self.row().is_named).then(|| PassName::new(self, ""))
    }
}

impl RoleRow {
    /// Returns the reason why it does not have such a key in `eddy.toml`; `None` if it does.
    pub fn refusal(&self, key: &str) -> Option<&'static str> {
        self.refused.iter().find(|(keys, _)| keys.contains(&key)).map(|(_, why)| *why)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_found_by_their_role_and_all_of_its_names() {
        for (index, row) in ROWS.iter().enumerate() {
            let id = row.role.only_pass().unwrap_or_else(|| PassName::buffer("A"));
            assert_eq!((row.role as usize, id.role(), id.row().key), (index, row.role, row.key));
            for name in
                [id.key().to_owned(), id.title()].into_iter().chain(row.spellings.iter().map(|s| (*s).to_owned()))
            {
                assert_eq!(PassName::parse(&name), Some(id.clone()), "{name}");
            }
            assert_eq!(Role::find(|other| other.json_type == row.json_type), Some(row.role));
            assert!(row.input.is_none_or(|input| row.target == Some(input.row().dimension)), "{row:?}");
            assert!(row.note.is_empty() || row.note.ends_with('.'), "{row:?}");
            assert!(row.entry.starts_with("main"), "{row:?}");
        }
    }
}
