//! Owns the table of the kinds of passes: what is known of each.

use super::{InputKind, PassId, PassSettings, PassSize};
use eddy_texture::{Dimension, TexelFormat};

/// A kind of pass. What is known of each stands in its [`PassRow`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PassKind {
    Buffer,
    Cubemap,
    Sound,
    Image,
}

/// Everything that is known of a kind of pass.
#[derive(Debug)]
pub struct PassRow {
    pub kind: PassKind,
    /// The title of tabs; of buffers what stands before the name.
    pub title: &'static str,
    /// The spelling of file names, `eddy.toml` and `--pass`; of buffers what stands before the name.
    pub key: &'static str,
    /// Its other names, in lower case without blanks.
    pub(crate) spellings: &'static [&'static str],
    /// The type in the site's JSON.
    pub json_type: &'static str,
    /// The id of its output there.
    pub json_output: &'static str,
    /// Its place in a frame: the least is drawn first.
    pub order: u8,
    /// The kind of the input that reads it, if any can.
    pub input: Option<InputKind>,
    /// The dimension of its target; `None`: it makes no picture.
    pub target: Option<Dimension>,
    /// The size of its target, where it is given no other. That of a sound holds a block of samples, one per texel.
    pub size: PassSize,
    /// The format of its target; `None`: its settings say.
    pub format: Option<TexelFormat>,
    /// The function that it begins with.
    pub entry: &'static str,
    /// Keys of `eddy.toml` that it has not, and why.
    pub(crate) refused: &'static [(&'static [&'static str], &'static str)],
    /// A sentence for people who look for what it has not.
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

const BUFFER: PassRow = PassRow {
    kind: PassKind::Buffer,
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

pub(super) const CUBEMAP: PassRow = PassRow {
    kind: PassKind::Cubemap,
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

const SOUND: PassRow = PassRow {
    kind: PassKind::Sound,
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

const IMAGE: PassRow = PassRow {
    kind: PassKind::Image,
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

/// Every kind, in the order in which [`PassKind`] has them.
static ROWS: [PassRow; 4] = [BUFFER, CUBEMAP, SOUND, IMAGE];

impl PassKind {
    pub fn all() -> impl DoubleEndedIterator<Item = PassKind> {
        ROWS.iter().map(|row| row.kind)
    }

    pub fn row(self) -> &'static PassRow {
        &ROWS[self as usize]
    }

    /// Returns the kind whose row is as asked.
    pub(crate) fn find(is_it: impl Fn(&PassRow) -> bool) -> Option<PassKind> {
        ROWS.iter().find(|row| is_it(row)).map(|row| row.kind)
    }

    /// Returns the one pass of this kind; `None` for buffers, of which there are many.
    pub fn id(self) -> Option<PassId> {
        match self {
            PassKind::Buffer => None,
            PassKind::Cubemap => Some(PassId::Cubemap),
            PassKind::Sound => Some(PassId::Sound),
            PassKind::Image => Some(PassId::Image),
        }
    }
}

impl PassRow {
    /// Returns why it has no such key in `eddy.toml`; `None` if it has.
    pub fn refusal(&self, key: &str) -> Option<&'static str> {
        self.refused.iter().find(|(keys, _)| keys.contains(&key)).map(|(_, why)| *why)
    }
}

impl PassId {
    pub fn kind(&self) -> PassKind {
        match self {
            PassId::Buffer(_) => PassKind::Buffer,
            PassId::Cubemap => PassKind::Cubemap,
            PassId::Sound => PassKind::Sound,
            PassId::Image => PassKind::Image,
        }
    }

    /// Returns what is known of its kind.
    pub fn row(&self) -> &'static PassRow {
        self.kind().row()
    }

    /// Returns the format of each of its targets.
    pub fn formats(&self, settings: &PassSettings) -> Vec<TexelFormat> {
        self.row().format.map_or_else(|| settings.formats(), |format| vec![format])
    }

    /// Returns the size of its targets.
    pub fn size(&self, settings: &PassSettings) -> PassSize {
        if settings.size == PassSize::Canvas { self.row().size } else { settings.size }
    }

    /// Returns whether it has a picture.
    pub fn is_picture(&self) -> bool {
        self.row().target.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_found_by_its_kind_and_by_each_of_its_names() {
        for (index, row) in ROWS.iter().enumerate() {
            let id = row.kind.id().unwrap_or_else(|| PassId::Buffer("A".into()));
            assert_eq!((row.kind as usize, id.kind(), id.row().key), (index, row.kind, row.key));
            for name in [id.key(), id.title()].into_iter().chain(row.spellings.iter().map(|s| (*s).to_owned())) {
                assert_eq!(PassId::parse(&name), Some(id.clone()), "{name}");
            }
            assert_eq!(PassKind::find(|other| other.json_type == row.json_type), Some(row.kind));
            assert!(row.input.is_none_or(|input| row.target == Some(input.row().dimension)), "{row:?}");
            assert!(row.note.is_empty() || row.note.ends_with('.'), "{row:?}");
            assert!(row.entry.starts_with("main"), "{row:?}");
        }
    }
}
