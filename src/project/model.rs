//! A project as pure data: passes in their drawing order, what each channel reads, and where the texts came from.

use super::{
    Bindings, Body, ControlBindings, CustomUniformValues, Dialect, Group, Included, Input, PassName, PassSettings,
    PassSize, Source, ghostty,
};
use eddy_texture::{Dimension, Face, TexelFormat};
use std::{borrow::Cow, collections::BTreeSet, path::PathBuf};

/// Everything the author wrote: enough to compile, plan and draw, and to write it back unchanged.
#[derive(Clone, Debug, PartialEq)]
pub struct Project {
    /// The title in the title bar and the gallery; never empty.
    pub name: String,
    pub info: Info,
    pub dialect: Dialect,
    /// The text that precedes every pass's own.
    pub common: Option<Source>,
    /// Buffers in drawing order, then the cubemap pass, then Image. (Sound passes are in this list too, but are not
    /// drawn.) Exactly one Image.
    pub passes: Vec<Pass>,
    pub sampler_rules: SamplerRules,
    /// Passes that are drawn several times a frame; passes outside a group are drawn once.
    pub groups: Vec<Group>,
    /// Values of the author's own uniforms by name: those of [`Project::custom_uniforms`] that differ from the default,
    /// and those of uniforms that a text declares in plain GLSL.
    pub custom_uniform_values: CustomUniformValues,
    /// Controls of MIDI and OSC devices that move uniforms.
    pub controls: ControlBindings,
    /// The files that the texts include, as [`Project::read_includes`] last found them.
    pub includes: Vec<Included>,
    pub origin: Origin,
}

/// The members of Shadertoy's JSON that describe a shader besides its passes. They are kept so that an export preserves
/// what was imported.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Info {
    pub id: String,
    pub author: String,
    pub description: String,
    pub tags: Vec<String>,
    /// The period in seconds after which the picture repeats. Only in `eddy.toml`.
    pub period: Option<f64>,
    /// Every other member of the JSON's `info` object, as read.
    pub extra: serde_json::Map<String, serde_json::Value>,
}

/// The location that a project was read from, and that saving writes to.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Origin {
    /// Not on disk: new, or a copy of a project that is not written in place.
    #[default]
    Unsaved,
    /// A preset inside the binary. Edits apply to a copy; saving asks for a destination.
    Preset(String),
    /// A folder with `eddy.toml`, or with GLSL files named by convention.
    Folder { path: PathBuf, has_manifest: bool },
    /// A single `.glsl` file: the Image pass.
    File(PathBuf),
    /// A Shadertoy JSON file.
    Json(PathBuf),
}

/// One render pass.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    pub id: PassName,
    pub source: Source,
    /// The inputs of its channels.
    pub bindings: Bindings,
    pub settings: PassSettings,
    pub body: Body,
}

impl Pass {
    /// Returns a pass without inputs that is drawn as on Shadertoy.
    pub fn new(id: PassName, source: Source) -> Pass {
        Pass { id, source, bindings: Default::default(), settings: Default::default(), body: Body::Screen }
    }

    /// Returns the format of each of its targets.
    pub fn formats(&self) -> Vec<TexelFormat> {
        let formats = || [self.settings.format].into_iter().chain(self.body.more_targets().iter().copied()).collect();
        self.id.row().format.map_or_else(formats, |format| vec![format])
    }

    /// Returns the size of its targets.
    pub fn size(&self) -> PassSize {
        if self.settings.size == PassSize::Canvas { self.id.row().size } else { self.settings.size }
    }

    /// Returns the number of pictures that it draws: its targets, or the faces of a cubemap.
    pub fn layers(&self) -> usize {
        match self.id.row().target {
            Some(Dimension::Cube) => Face::ALL.len(),
            _ => self.formats().len(),
        }
    }

    /// Returns the label that distinguishes picture `index` from the pass's others: the number of a target, the name of
    /// a face; empty if there is only one.
    pub fn layer_name(&self, index: usize) -> String {
        match (self.id.row().target, self.layers()) {
            (Some(Dimension::Cube), _) => Face::ALL.get(index).map_or_else(String::new, |face| face.name().to_owned()),
            (_, 0 | 1) => String::new(),
            _ => index.to_string(),
        }
    }
}

/// The input of one `iChannelN`, and how it is sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    pub input: Input,
    pub sampler: Sampler,
}

impl Channel {
    /// Creates a channel with the default sampler of its kind of input on Shadertoy.
    pub fn new(input: Input) -> Channel {
        Channel { sampler: input.row().sampler, input }
    }

    /// Returns the sampler of a channel that does not read a buffer.
    pub fn sampler(&self) -> Sampler {
        let row = self.input.row();
        if row.has_fixed_sampler { row.sampler } else { self.sampler }
    }
}

/// The source of a picture, volume or sound.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Media {
    /// A built-in one, by name (`noise-rgba-256`): see `media::builtin`.
    Builtin(String),
    /// A file of the project, relative to its folder: see [`super::confine`].
    File(PathBuf),
    /// A file that the user picked, by its absolute path, wherever it is. Exists in memory only: saving copies the file
    /// into the project's folder and replaces this by a [`Media::File`], and loading a project never creates one.
    Picked(PathBuf),
    /// A texture of Shadertoy's. Replaced by a built-in one of the same size and kind, or by a file of that name in
    /// `--media`.
    Site { id: String, path: String },
}

/// The interpolation between texels, and the addressing beyond the edges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Sampler {
    pub filter: Filter,
    pub wrap: Wrap,
    /// True if the picture's top row is at v = 1. Only affects pictures, cubemaps and video.
    pub vflip: bool,
}

impl Sampler {
    /// Shadertoy's sampler for a new channel that reads a buffer.
    pub const BUFFER: Sampler = Sampler { filter: Filter::Linear, wrap: Wrap::Clamp, vflip: true };
    /// Shadertoy's sampler for a new channel that reads a picture.
    pub const TEXTURE: Sampler = Sampler { filter: Filter::Mipmap, wrap: Wrap::Repeat, vflip: true };
    /// The sampler of the keyboard, whatever is stored.
    pub const KEYBOARD: Sampler = Sampler { filter: Filter::Nearest, wrap: Wrap::Clamp, vflip: true };
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Filter {
    Nearest,
    #[default]
    Linear,
    /// Linear within and between mip levels.
    Mipmap,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Wrap {
    #[default]
    Clamp,
    Repeat,
}

/// The rule for several channels that read one buffer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SamplerRules {
    /// Every channel has its own (`eddy.toml`, and GLSL files without one).
    #[default]
    PerChannel,
    /// Shadertoy's rules, for projects read from its JSON: the filter belongs to the buffer while a pass draws (the
    /// pass's last channel wins), the wrap mode to the buffer permanently (the last channel of the whole project wins).
    Site,
}

impl Origin {
    /// The folder that relative media paths start from; `None` if it is not on disk.
    pub fn base_dir(&self) -> Option<&std::path::Path> {
        match self {
            Origin::Unsaved | Origin::Preset(_) => None,
            Origin::Folder { path, .. } => Some(path),
            Origin::File(path) | Origin::Json(path) => path.parent(),
        }
    }
}

/// Returns the argument of [`super::load`] that reads a file as a shader of this dialect. Dialects other than Ghostty's
/// are recognised by the text.
pub fn spec_of(path: &std::path::Path, dialect: Dialect) -> String {
    let prefix = if dialect == Dialect::Ghostty { ghostty::PREFIX } else { "" };
    format!("{prefix}{}", path.display())
}

impl Project {
    /// Returns whether `#iChannel` lines of the texts declare the inputs of channels. For an `eddy.toml`, Shadertoy's
    /// JSON, a preset, another dialect and the window, they are declared elsewhere.
    pub fn has_channels_in_texts(&self) -> bool {
        let origin = matches!(self.origin, Origin::File(_) | Origin::Folder { has_manifest: false, .. });
        origin && self.dialect == Dialect::Shadertoy
    }

    /// Returns the argument of [`super::load`] that reads the project of a file or folder again.
    pub fn spec(&self) -> Option<String> {
        match &self.origin {
            Origin::Unsaved | Origin::Preset(_) => None,
            Origin::File(path) => Some(spec_of(path, self.dialect)),
            Origin::Folder { path, .. } | Origin::Json(path) => Some(path.display().to_string()),
        }
    }

    /// Returns the passes whose previous frame some pass reads, itself or one that is drawn before it: the project's
    /// state. A project without any draws the same picture at a given time, whatever it drew before.
    pub fn stateful_passes(&self) -> BTreeSet<PassName> {
        let passes = &self.passes;
        let read = |index: usize| {
            passes[index].bindings.channels().filter_map(|channel| {
                let (id, _) = channel.input.target()?;
                passes.iter().position(|p| p.id == *id)
            })
        };
        // A pass that is drawn later still contains the previous frame.
        let pairs = (0..passes.len()).flat_map(|index| read(index).filter(move |of| *of >= index));
        pairs.map(|of| passes[of].id.clone()).collect()
    }

    /// Returns a project with only these passes.
    pub fn new(name: impl Into<String>, passes: Vec<Pass>, origin: Origin) -> Project {
        Project {
            name: name.into(),
            info: Info::default(),
            dialect: Dialect::default(),
            common: None,
            passes,
            sampler_rules: SamplerRules::PerChannel,
            custom_uniform_values: Default::default(),
            controls: Default::default(),
            groups: Vec::new(),
            includes: Vec::new(),
            origin,
        }
    }

    /// Returns a project of one Image pass that is not on disk.
    pub fn of_image(name: String, text: String) -> Project {
        let id = PassName::image();
        let source = Source { name: id.title(), path: None, text: text.into() };
        Project::new(name, vec![Pass::new(id, source)], Origin::Unsaved)
    }

    /// The pass whose picture the window shows.
    pub fn image(&self) -> Option<&Pass> {
        self.passes.iter().find(|p| p.id.is_image())
    }

    pub fn image_mut(&mut self) -> Option<&mut Pass> {
        self.passes.iter_mut().find(|p| p.id.is_image())
    }

    /// The index of Image in [`Project::passes`].
    pub fn image_index(&self) -> Option<usize> {
        self.passes.iter().position(|p| p.id.is_image())
    }

    /// The pass that produces sound.
    pub fn sound(&self) -> Option<&Pass> {
        self.passes.iter().find(|p| p.id.is_sound())
    }

    /// Returns Image and `shown`, without duplicates: the passes to draw while `shown` is displayed. A pass that the
    /// project lacks is omitted.
    pub fn image_and(&self, shown: &PassName) -> Vec<PassName> {
        let other = Some(shown).filter(|pass| !pass.is_image() && self.pass(pass).is_some());
        [PassName::image()].into_iter().chain(other.cloned()).collect()
    }

    pub fn pass(&self, id: &PassName) -> Option<&Pass> {
        self.passes.iter().find(|p| p.id == *id)
    }

    /// The pass with a name. If the project lacks it, a pass with default settings and no text, which channels read as
    /// zeros.
    pub fn pass_or_empty(&self, id: &PassName) -> Cow<'_, Pass> {
        let empty = || Pass::new(id.clone(), Source { name: id.title(), path: None, text: "".into() });
        self.pass(id).map_or_else(|| Cow::Owned(empty()), Cow::Borrowed)
    }

    pub fn pass_mut(&mut self, id: &PassName) -> Option<&mut Pass> {
        self.passes.iter_mut().find(|p| p.id == *id)
    }
}

/// A text of the project that the editor shows.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Tab {
    Common,
    Pass(PassName),
    /// A stage of a geometry pass that is in its own file, by the file's name.
    Stage(PassName, String),
    /// An included file, by its path from the project's folder.
    Included(String),
}

impl Default for Tab {
    fn default() -> Self {
        Tab::image()
    }
}

impl Tab {
    pub fn image() -> Tab {
        Tab::Pass(PassName::image())
    }

    pub fn sound() -> Tab {
        Tab::Pass(PassName::sound())
    }

    /// Returns whether it is the text of a buffer.
    pub fn is_buffer(&self) -> bool {
        matches!(self, Tab::Pass(pass) if pass.is_buffer())
    }

    pub fn title(&self) -> String {
        match self {
            Tab::Common => "Common".into(),
            Tab::Pass(id) => id.title(),
            Tab::Stage(_, file) | Tab::Included(file) => file.clone(),
        }
    }

    /// The same tab of another pass.
    pub fn of_pass(&self, pass: PassName) -> Tab {
        match self {
            Tab::Common => Tab::Common,
            Tab::Pass(_) => Tab::Pass(pass),
            Tab::Stage(_, file) => Tab::Stage(pass, file.clone()),
            Tab::Included(file) => Tab::Included(file.clone()),
        }
    }

    /// The pass it belongs to.
    pub fn pass(&self) -> Option<&PassName> {
        match self {
            Tab::Common | Tab::Included(_) => None,
            Tab::Pass(id) | Tab::Stage(id, _) => Some(id),
        }
    }
}

/// The texts of a project. `source_ids` assigns their ids.
impl Project {
    /// Every stage in its own file, with the index of its pass.
    pub fn stages(&self) -> impl Iterator<Item = (usize, &Source)> {
        self.passes.iter().enumerate().flat_map(|(index, pass)| pass.body.stages().iter().map(move |s| (index, s)))
    }

    /// Every text that the project itself names: Common, the passes', the stages'. Files that these include are in
    /// [`Project::includes`].
    pub fn tab_sources(&self) -> impl Iterator<Item = &Source> {
        let passes = self.passes.iter().map(|p| &p.source);
        self.common.iter().chain(passes).chain(self.stages().map(|(_, s)| s))
    }

    pub fn tab_sources_mut(&mut self) -> Vec<&mut Source> {
        let mut all: Vec<&mut Source> = self.common.iter_mut().collect();
        for pass in &mut self.passes {
            all.push(&mut pass.source);
            all.extend(pass.body.stages_mut());
        }
        all
    }

    /// Every text of the project, followed by the text that contains each fill (see [`Project::fills`]) and each
    /// condition (see [`Project::conditions`]), once for each.
    pub fn sources(&self) -> eddy_diag::SourceMap {
        let mut map = self.texts();
        for (pass, kind, _) in self.fills() {
            if let Some(text) = self.fill_text(pass, kind) {
                map.add(super::files::MANIFEST, text.text);
            }
        }
        for text in self.condition_texts() {
            map.add(super::files::MANIFEST, text.text);
        }
        map
    }

    /// Returns only the GLSL texts of [`Project::sources`].
    pub fn texts(&self) -> eddy_diag::SourceMap {
        let mut map = eddy_diag::SourceMap::default();
        match &self.common {
            Some(c) => map.add(c.name.clone(), c.text.clone()),
            None => map.add("Common", ""),
        };
        for pass in &self.passes {
            map.add(pass.source.name.clone(), pass.source.text.clone());
        }
        for (_, stage) in self.stages() {
            map.add(stage.name.clone(), stage.text.clone());
        }
        for included in &self.includes {
            map.add(included.source.name.clone(), included.source.text.clone());
        }
        map
    }

    /// The included files that could be read.
    fn readable_includes(&self) -> impl Iterator<Item = &Source> {
        self.includes.iter().filter(|i| i.trouble.is_none()).map(|i| &i.source)
    }

    pub fn source(&self, tab: &Tab) -> Option<&Source> {
        match tab {
            Tab::Common => self.common.as_ref(),
            Tab::Pass(id) => self.pass(id).map(|p| &p.source),
            Tab::Stage(id, file) => self.pass(id)?.body.stages().iter().find(|s| s.name == *file),
            Tab::Included(file) => self.readable_includes().find(|s| s.name == *file),
        }
    }

    pub fn source_mut(&mut self, tab: &Tab) -> Option<&mut Source> {
        match tab {
            Tab::Common => self.common.as_mut(),
            Tab::Pass(id) => self.pass_mut(id).map(|p| &mut p.source),
            Tab::Stage(id, file) => self.pass_mut(id)?.body.stages_mut().iter_mut().find(|s| s.name == *file),
            Tab::Included(file) => {
                let included = self.includes.iter_mut().find(|i| i.trouble.is_none() && i.source.name == *file);
                included.map(|i| &mut i.source)
            }
        }
    }

    /// Returns the project after applying the edits of a fix to its texts.
    pub fn with_edits(&self, fix: &eddy_diag::Fix) -> Project {
        let mut edited = self.clone();
        let mut sources: Vec<_> = fix.edits.iter().map(|edit| edit.span.source).collect();
        sources.dedup();
        for id in sources {
            let text = self.tab_of(id).and_then(|tab| edited.source_mut(&tab));
            if let Some(source) = text {
                source.text = fix.applied(id, &self.texts().get(id).map_or("".into(), |s| s.text.clone())).into();
            }
        }
        edited
    }

    /// Every tab: Common, then passes in drawing order, each followed by its stages. The files that they include come
    /// last.
    pub fn tabs(&self) -> Vec<Tab> {
        let mut ids: Vec<_> = self.passes.iter().map(|p| p.id.clone()).collect();
        ids.sort_by(PassName::drawing_order);
        let mut tabs: Vec<Tab> = self.common.iter().map(|_| Tab::Common).collect();
        for id in ids {
            let stages = self.pass(&id).map_or(&[][..], |p| p.body.stages());
            tabs.push(Tab::Pass(id.clone()));
            tabs.extend(stages.iter().map(|s| Tab::Stage(id.clone(), s.name.clone())));
        }
        tabs.extend(self.readable_includes().map(|s| Tab::Included(s.name.clone())));
        tabs
    }

    /// Returns the editor's initial tab: Image, or the file of a project whose passes are generated around it.
    pub fn main_tab(&self) -> Tab {
        let file = match (&self.origin, self.dialect) {
            (Origin::File(path), dialect) if dialect.has_main() => path.file_name(),
            _ => None,
        };
        let own = self.readable_includes().find(|s| file.is_some_and(|name| name == s.name.as_str()));
        own.map_or(Tab::image(), |s| Tab::Included(s.name.clone()))
    }
}
