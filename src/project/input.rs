//! Owns the inputs that a channel can read: [`Input`], and the table of its kinds. A kind is a row of [`ROWS`]; code
//! that depends on a property of a kind reads its row.

use super::{Filter, Media, PassName, Role, Sampler, Wrap, role};
use eddy_texture::Dimension;

/// A source of texels.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    /// One of the targets of a pass, counted from 0. A missing pass reads as zeros.
    Pass { id: PassName, target: usize },
    /// Media loaded from a file or another source.
    Media { kind: InputKind, media: Media },
    /// A hardware device.
    Device(InputKind),
}

/// A kind of input. Its properties are in its [`InputRow`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum InputKind {
    Buffer,
    CubemapPass,
    Keyboard,
    Texture,
    Cubemap,
    Volume,
    Video,
    Music,
    Microphone,
    Webcam,
    Gamepad,
}

/// The variant of [`Input`] that a kind belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputSource {
    Pass,
    Media,
    Device,
}

/// The properties of a kind of input.
#[derive(Debug)]
pub struct InputRow {
    pub kind: InputKind,
    pub source: InputSource,
    /// The name for users; a general one for passes and image files, whose own names are specific enough.
    pub title: &'static str,
    /// The glyph that is shown if there is no thumbnail.
    pub glyph: &'static str,
    /// The key of a channel in `eddy.toml`; for media also the value of `kind`.
    pub key: &'static str,
    /// The type in Shadertoy's JSON.
    pub json_type: &'static str,
    /// True if Shadertoy has it.
    pub is_on_shadertoy: bool,
    /// The type in that JSON of media that are streamed from another site.
    pub json_stream_type: Option<&'static str>,
    /// The id and the path in Shadertoy's JSON if there is only one input of this kind.
    pub json_id: Option<(&'static str, &'static str)>,
    /// The word in an `#iChannel` line. Buffers and files are named there by their own names.
    pub directive: Option<&'static str>,
    pub dimension: Dimension,
    /// The sampler of a new channel.
    pub sampler: Sampler,
    /// True if [`InputRow::sampler`] is always used, whatever is stored.
    pub has_fixed_sampler: bool,
    /// True if [`Sampler::vflip`] has an effect.
    pub has_vflip: bool,
    /// The number of files that form one input, 0 if it is not from files.
    pub files: usize,
}

const LINEAR_CLAMP: Sampler = Sampler { filter: Filter::Linear, wrap: Wrap::Clamp, vflip: true };

/// A base row: a single 2D picture that Eddy reads.
const PICTURE: InputRow = InputRow {
    kind: InputKind::Texture,
    source: InputSource::Media,
    title: "image file",
    glyph: "img",
    key: "texture",
    json_type: "texture",
    is_on_shadertoy: true,
    json_stream_type: None,
    json_id: None,
    directive: None,
    dimension: Dimension::D2,
    sampler: LINEAR_CLAMP,
    has_fixed_sampler: false,
    has_vflip: true,
    files: 1,
};
/// The base row of a pass.
const PASS: InputRow = InputRow { source: InputSource::Pass, has_vflip: false, files: 0, ..PICTURE };
/// The base row of a device.
const DEVICE: InputRow = InputRow { source: InputSource::Device, files: 0, ..PICTURE };

/// Every kind, in the order of [`InputKind`], in which messages list them.
static ROWS: [InputRow; 11] = [
    InputRow {
        kind: InputKind::Buffer,
        title: "Buffer",
        glyph: "B",
        key: "buffer",
        json_type: "buffer",
        sampler: Sampler::BUFFER,
        ..PASS
    },
    InputRow {
        kind: InputKind::CubemapPass,
        title: role::CUBEMAP.title,
        glyph: "C",
        key: "cube_a",
        json_type: "cubemap",
        json_id: Some(("4dX3Rr", "/media/previz/cubemap00.png")),
        directive: Some("cube_a"),
        dimension: Dimension::Cube,
        ..PASS
    },
    InputRow {
        kind: InputKind::Keyboard,
        title: "Keyboard",
        glyph: "K",
        key: "keyboard",
        json_type: "keyboard",
        json_id: Some(("4dXGRr", "/presets/tex00.jpg")),
        directive: Some("keyboard"),
        sampler: Sampler::KEYBOARD,
        has_fixed_sampler: true,
        has_vflip: false,
        ..DEVICE
    },
    InputRow { sampler: Sampler::TEXTURE, ..PICTURE },
    InputRow {
        kind: InputKind::Cubemap,
        title: "cubemap",
        glyph: "C",
        key: "cubemap",
        json_type: "cubemap",
        dimension: Dimension::Cube,
        sampler: Sampler { filter: Filter::Mipmap, wrap: Wrap::Clamp, vflip: false },
        files: 6,
        ..PICTURE
    },
    InputRow {
        kind: InputKind::Volume,
        title: "volume",
        glyph: "V",
        key: "volume",
        json_type: "volume",
        dimension: Dimension::D3,
        sampler: Sampler::TEXTURE,
        has_vflip: false,
        ..PICTURE
    },
    InputRow { kind: InputKind::Video, title: "video", glyph: "film", key: "video", json_type: "video", ..PICTURE },
    InputRow {
        kind: InputKind::Music,
        title: "music",
        glyph: "snd",
        key: "music",
        json_type: "music",
        json_stream_type: Some("musicstream"),
        has_fixed_sampler: true,
        has_vflip: false,
        ..PICTURE
    },
    InputRow {
        kind: InputKind::Microphone,
        title: "Microphone",
        glyph: "snd",
        key: "microphone",
        json_type: "mic",
        directive: Some("microphone"),
        json_id: Some(("XdXGRr", "/presets/mic.png")),
        has_fixed_sampler: true,
        has_vflip: false,
        ..DEVICE
    },
    InputRow {
        kind: InputKind::Webcam,
        title: "Webcam",
        glyph: "cam",
        key: "webcam",
        json_type: "webcam",
        json_id: Some(("4sf3zn", "/presets/webcam.png")),
        directive: Some("webcam"),
        ..DEVICE
    },
    InputRow {
        kind: InputKind::Gamepad,
        title: "Gamepad",
        glyph: "G",
        key: "gamepad",
        json_type: "gamepad",
        is_on_shadertoy: false,
        directive: Some("gamepad"),
        sampler: Sampler::KEYBOARD,
        has_fixed_sampler: true,
        has_vflip: false,
        ..DEVICE
    },
];

impl InputKind {
    /// Returns every kind, in the order in which messages list them.
    pub fn all() -> impl Iterator<Item = InputKind> {
        ROWS.iter().map(|row| row.kind)
    }

    pub fn row(self) -> &'static InputRow {
        &ROWS[self as usize]
    }

    /// Returns whether a sound pass can read it, as on Shadertoy: inputs that exist before anything is drawn. Of a
    /// volume it can only read the size, as its channel is declared as a `sampler2D`.
    pub fn is_in_sound(self) -> bool {
        matches!(self, InputKind::Texture | InputKind::Cubemap | InputKind::Volume)
    }

    /// Returns the first kind whose row satisfies the predicate.
    pub(crate) fn find(is_it: impl Fn(&InputRow) -> bool) -> Option<InputKind> {
        ROWS.iter().find(|row| is_it(row)).map(|row| row.kind)
    }

    /// Returns the input of this kind if it needs no name: a device, or the cubemap pass.
    pub(crate) fn unnamed(self) -> Option<Input> {
        match self.row().source {
            InputSource::Device => Some(Input::Device(self)),
            InputSource::Pass => Role::find(|pass| pass.input == Some(self))?.only_pass().map(Input::pass),
            InputSource::Media => None,
        }
    }
}

impl Input {
    pub const KEYBOARD: Input = Input::Device(InputKind::Keyboard);

    /// The first target of a pass.
    pub fn pass(id: PassName) -> Input {
        Input::Pass { id, target: 0 }
    }

    /// The first target of a buffer, by its name.
    pub fn buffer(name: impl AsRef<str>) -> Input {
        Input::pass(PassName::buffer(name))
    }

    /// A 2D picture.
    pub fn texture(media: Media) -> Input {
        Input::Media { kind: InputKind::Texture, media }
    }

    /// Returns the name of the buffer that it reads, without the word `Buffer`.
    pub fn buffer_name(&self) -> Option<&str> {
        self.target()?.0.buffer_name()
    }

    pub fn kind(&self) -> InputKind {
        match self {
            Input::Pass { id, .. } => id.row().input.unwrap_or(InputKind::Buffer),
            Input::Media { kind, .. } | Input::Device(kind) => *kind,
        }
    }

    /// Returns the row of its kind.
    pub fn row(&self) -> &'static InputRow {
        self.kind().row()
    }

    /// Returns the media that it reads, if it is not a pass or a device.
    pub fn media(&self) -> Option<&Media> {
        match self {
            Input::Media { media, .. } => Some(media),
            Input::Pass { .. } | Input::Device(_) => None,
        }
    }

    pub fn media_mut(&mut self) -> Option<&mut Media> {
        match self {
            Input::Media { media, .. } => Some(media),
            Input::Pass { .. } | Input::Device(_) => None,
        }
    }

    /// The pass that it reads, and the index of the target.
    pub fn target(&self) -> Option<(&PassName, usize)> {
        match self {
            Input::Pass { id, target } => Some((id, *target)),
            Input::Media { .. } | Input::Device(_) => None,
        }
    }

    pub fn pass_mut(&mut self) -> Option<&mut PassName> {
        match self {
            Input::Pass { id, .. } => Some(id),
            Input::Media { .. } | Input::Device(_) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Channel, Origin, Pass, Project, Source, files::Files, folder, json, manifest};
    use std::collections::BTreeMap;

    fn project(channel: &Channel) -> Project {
        let source = Source { name: "image.glsl".into(), path: None, text: "".into() };
        let bindings = [Some(channel.clone())].into();
        Project::new("p", vec![Pass { bindings, ..Pass::new(PassName::image(), source) }], Origin::Unsaved)
    }

    /// An input of each kind, for tests.
    fn example(row: &InputRow) -> Input {
        let media = Media::File("a.bin".into());
        match row.source {
            InputSource::Media => Input::Media { kind: row.kind, media },
            InputSource::Pass | InputSource::Device => row.kind.unnamed().unwrap_or_else(|| Input::buffer("A")),
        }
    }

    fn read(project: &Project) -> Option<Channel> {
        project.image()?.bindings.get(0).cloned()
    }

    #[test]
    fn rows_are_complete_and_found_by_their_kind() {
        for (index, row) in ROWS.iter().enumerate() {
            assert_eq!((row.kind as usize, row.kind.row().key, example(row).kind()), (index, row.key, row.kind));
            assert!(![row.title, row.glyph, row.key, row.json_type].contains(&""), "{row:?}");
            assert_eq!(row.files > 0, row.source == InputSource::Media, "{row:?}");
            assert!(row.files != 1 || row.dimension != Dimension::Cube, "a cube has six faces: {row:?}");
        }
    }

    #[test]
    fn every_kind_round_trips_through_every_form_of_a_project() {
        let files = BTreeMap::from([("image.glsl".to_owned(), Vec::new())]);
        for row in &ROWS {
            let channel = Channel::new(example(row));
            let text = manifest::write(&project(&channel), None, "p", false);
            assert!(!text.contains("filter"), "its sampler is that of a new channel: {text}");
            let loaded = manifest::project("p", "p".into(), &text, &Files::in_memory(&files), Origin::Unsaved);
            assert_eq!(read(&loaded.unwrap().project), Some(channel.clone()), "{text}");
            let json = json::export(&project(&channel));
            assert_eq!(read(&json::import(&json, "p").unwrap().0), Some(channel.clone()), "{json}");
            let Some(word) = row.directive else { continue };
            let mut said = Project::of_image("p".into(), format!("#iChannel0 \"{word}\"\n"));
            folder::declare_channels(&mut said);
            assert_eq!(read(&said), Some(channel), "{word}");
        }
    }
}
