//! Loads an ISF file as a project, and saves it.

use super::{
    header::{self, Header, Kind},
    json_of,
    size::size,
    texts,
};
use crate::{
    Channel, Dialect, Filter, Info, Input, InputKind, Loaded, MAX_CHANNELS, Media, Origin, Pass, PassName, PassSize,
    Project, ProjectError, Sampler, Source, TexelFormat, Wrap, confine,
    files::{Files, Read},
    includes, limits,
    words::all_words,
};
use eddy_diag::{Diagnostic, SourceMap, Span};
use std::{collections::HashSet, path::Path};

/// The number of images that a message lists at most.
const SHOWN: usize = 12;
/// Built-in textures that replace images until the user chooses others, in rotation.
const STAND_INS: [&str; 4] = ["street", "marble", "coral", "pebbles"];
/// The built-in cubemap that replaces others.
const CUBEMAP: &str = "forest";

/// Returns the project of a file's text if it is an ISF file, or the errors in its header.
pub(crate) fn load(path: &Path, (name, text): (&str, &str), files: &Files<'_>) -> Option<Result<Loaded, ProjectError>> {
    let (start, json) = json_of(path, text)?;
    let mut sources = SourceMap::default();
    let id = sources.add(name, text);
    let refuse =
        |diagnostics, sources| Err(ProjectError::Invalid { what: path.display().to_string(), diagnostics, sources });
    let mut header = match header::parse(json, (id, start)) {
        Ok(header) => header,
        Err(found) => return Some(refuse(found, sources)),
    };
    let found = std::mem::take(&mut header.warnings);
    let mut maker =
        Maker { header, name, text, words: all_words(text), at: Span::new(id, start..start + json.len()), found };
    let vertex = path.with_extension("vs").file_name().map(|n| n.to_string_lossy().into_owned());
    let vertex = vertex.filter(|vertex| files.exists(vertex));
    // A file that cannot be read is reported where it is included.
    let vertex_text = vertex.as_deref().map(|vertex| match files.read(vertex, limits::GLSL_TEXT) {
        Read::Text(text) => text,
        _ => String::new(),
    });
    let vertex = vertex.as_deref().zip(vertex_text.as_deref());
    let mut project = maker.project(path, vertex);
    if maker.found.iter().any(Diagnostic::is_error) {
        return Some(refuse(maker.found, sources));
    }
    includes::read(&mut project, Some(files));
    let mut all = project.sources();
    let moved = all.add(name, text);
    for span in maker.found.iter_mut().filter_map(|d| d.span.as_mut()) {
        span.source = moved;
    }
    Some(Ok(Loaded { project, warnings: maker.found, sources: all }))
}

struct Maker<'t> {
    header: Header,
    name: &'t str,
    text: &'t str,
    words: HashSet<&'t str>,
    /// The span of the header.
    at: Span,
    found: Vec<Diagnostic>,
}

impl Maker<'_> {
    fn error(&mut self, message: String, hint: &str) {
        self.found.push(Diagnostic::error(self.at, message).hint(hint));
    }

    fn project(&mut self, path: &Path, vertex: Option<(&str, &str)>) -> Project {
        let targets = self.targets();
        let images = self.images(&targets, vertex);
        let mut passes: Vec<Pass> = self.audio_passes(&images);
        let scaled = self.scaled(&images, &targets, vertex);
        passes.extend(scaled.iter().map(|name| {
            let id = PassName::buffer(buffer_name(name));
            let mut pass = Pass::new(id.clone(), generated(&id, texts::SCALED.to_owned()));
            pass.settings.format = TexelFormat::Rgba8;
            pass.bindings.set(0, Some(self.channel(name, &targets)));
            pass
        }));
        let count = self.header.passes.len().max(1);
        for index in 0..count {
            let isf = self.header.passes.get(index);
            let target = isf.map(|pass| pass.target.clone()).filter(|target| !target.is_empty());
            let is_float = isf.is_some_and(|pass| pass.is_float);
            let is_last = index + 1 == count;
            if target.is_none() && !is_last {
                self.found.push(
                    Diagnostic::warning(
                        self.at,
                        format!("pass {index} has no TARGET and is not the last: nothing shows it"),
                    )
                    .hint("remove it, or give it a TARGET"),
                );
                continue;
            }
            let id = target.as_ref().map_or_else(PassName::image, |target| PassName::buffer(buffer_name(target)));
            let mut pass =
                Pass::new(id.clone(), generated(&id, texts::pass(index, &images, (self.name, &self.words), vertex)));
            if target.is_some() {
                pass.settings.format = if is_float { TexelFormat::Rgba32f } else { TexelFormat::Rgba8 };
                pass.settings.size = self.size_of(index);
            }
            for (slot, name) in images.iter().enumerate() {
                let channel = match scaled.contains(name) {
                    true => linear(Input::buffer(buffer_name(name))),
                    false => self.channel(name, &targets),
                };
                pass.bindings.set(slot, Some(channel));
                pass.bindings.set_name(slot, name);
            }
            passes.push(pass);
            if is_last && let Some(target) = target {
                let mut image = Pass::new(PassName::image(), generated(&PassName::image(), texts::SHOW.to_owned()));
                image.bindings.set(0, Some(linear(Input::buffer(buffer_name(&target)))));
                passes.push(image);
            }
        }
        let origin = Origin::File(path.to_owned());
        let mut project = Project::new(path.file_stem().unwrap_or_default().to_string_lossy(), passes, origin);
        project.dialect = Dialect::Isf;
        project.common = Some(Source { name: "ISF".into(), path: None, text: texts::common(&self.header).into() });
        project.info = Info {
            description: self.header.description.clone(),
            author: self.header.credit.clone(),
            tags: self.header.categories.clone(),
            ..Info::default()
        };
        project
    }

    /// The buffers that passes draw, without duplicates.
    fn targets(&mut self) -> Vec<String> {
        let mut targets: Vec<String> = Vec::new();
        let mut buffers: HashSet<String> = HashSet::new();
        let mut wrong = Vec::new();
        for pass in self.header.passes.iter().filter(|pass| !pass.target.is_empty()) {
            if !header::is_name(&pass.target) {
                wrong.push((format!("\"{}\" is not a name of a buffer", pass.target), "use letters, digits and _"));
            } else if !buffers.insert(buffer_name(&pass.target)) {
                let message =
                    format!("two passes draw the buffer \"{}\": Eddy draws a buffer by one pass", pass.target);
                wrong.push((message, "give each pass a TARGET of its own"));
            } else {
                targets.push(pass.target.clone());
            }
        }
        wrong.into_iter().for_each(|(message, hint)| self.error(message, hint));
        targets
    }

    /// The names of the images that the text reads, in channel order.
    fn images(&mut self, targets: &[String], vertex: Option<(&str, &str)>) -> Vec<String> {
        let inputs = self.header.inputs.iter().filter(|input| input.kind.is_image()).map(|input| &input.name);
        let imported = self.header.imported.iter().map(|image| &image.name);
        let all: Vec<&String> = inputs.chain(imported).chain(targets).collect();
        let is_read = |name: &String| vertex.is_some() || self.words.contains(name.as_str());
        let mut read: Vec<String> = Vec::new();
        let mut seen: HashSet<&String> = HashSet::new();
        for name in all.into_iter().filter(|name| is_read(name)) {
            if seen.insert(name) {
                read.push(name.clone());
            }
        }
        if read.len() > MAX_CHANNELS {
            let message = format!(
                "the shader reads {} images, and a pass of Eddy has {MAX_CHANNELS} channels: {}",
                read.len(),
                read[..read.len().min(SHOWN)].join(", ")
            );
            self.error(message, "read fewer images, buffers among them");
        }
        read.truncate(MAX_CHANNELS);
        read
    }

    fn channel(&self, name: &str, targets: &[String]) -> Channel {
        if targets.iter().any(|target| target == name) {
            return linear(Input::buffer(buffer_name(name)));
        }
        if let Some(image) = self.header.imported.iter().find(|image| image.name == name) {
            let built_in = |kind, name: &str| linear(Input::Media { kind, media: Media::Builtin(name.to_owned()) });
            return match &image.path {
                Some(path) => {
                    let file = confine::relative("", path).unwrap_or_else(|_| path.clone());
                    linear(Input::texture(Media::File(file.into())))
                }
                None if image.is_cube => built_in(InputKind::Cubemap, CUBEMAP),
                None => built_in(InputKind::Texture, STAND_INS[0]),
            };
        }
        if self.header.inputs.iter().any(|input| input.kind == Kind::Cube && input.name == name) {
            let media = Media::Builtin(CUBEMAP.to_owned());
            return linear(Input::Media { kind: InputKind::Cubemap, media });
        }
        let images = self.header.inputs.iter().filter(|input| input.kind == Kind::Image);
        let place = images.clone().position(|input| input.name == name);
        match place {
            Some(place) => linear(Input::texture(Media::Builtin(STAND_INS[place % STAND_INS.len()].to_owned()))),
            None => linear(Input::buffer(buffer_name(name))),
        }
    }

    /// The user's images that are first drawn at the resolution of the picture: hosts give a filter images of the size
    /// that it draws, so texts use pixel coordinates of one for the other. If a text reads no pixel by its coordinates,
    /// this makes no difference.
    fn scaled(&self, images: &[String], targets: &[String], vertex: Option<(&str, &str)>) -> Vec<String> {
        let reads = ["IMG_PIXEL", "IMG_SIZE", "texture2DRect"];
        let has_pixels = |name: &str| {
            vertex.is_some()
                || reads.iter().any(|word| self.words.contains(word))
                || self.text.contains(&format!("_{name}_img"))
        };
        let is_free = |name: &str| targets.iter().all(|target| buffer_name(target) != buffer_name(name));
        let inputs = self.header.inputs.iter().filter(|input| input.kind == Kind::Image).map(|input| &input.name);
        inputs.filter(|name| images.contains(name) && has_pixels(name) && is_free(name)).cloned().collect()
    }

    /// The buffers that convert sounds to images.
    fn audio_passes(&self, images: &[String]) -> Vec<Pass> {
        let inputs = self.header.inputs.iter().filter(|input| matches!(input.kind, Kind::Audio | Kind::AudioFft));
        let read = inputs.filter(|input| images.contains(&input.name));
        let pass = |input: &header::IsfInput| {
            let id = PassName::buffer(buffer_name(&input.name));
            let mut pass = Pass::new(id.clone(), generated(&id, texts::audio(input.kind)));
            let samples = input.max.first().filter(|max| (1.0..=4096.0).contains(*max)).map_or(512, |max| *max as u32);
            pass.settings.size = PassSize::Fixed(samples, 1);
            pass.bindings.set(0, Some(Channel::new(Input::Device(InputKind::Microphone))));
            pass
        };
        read.map(pass).collect()
    }

    fn size_of(&mut self, index: usize) -> PassSize {
        let pass = &self.header.passes[index];
        let inputs = &self.header.inputs;
        let input = |name: &str| {
            let input = inputs.iter().find(|input| input.name == name && !input.kind.is_image())?;
            Some(input.default.first().or(input.min.first()).copied().unwrap_or(0.0))
        };
        let expressions = [&pass.width, &pass.height].map(|side| side.clone());
        let named: HashSet<&str> = (expressions.iter().flatten())
            .flat_map(|text| text.split('$').skip(1))
            .map(|rest| rest.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next().unwrap_or_default())
            .collect();
        let is_moved = inputs.iter().any(|input| named.contains(input.name.as_str()));
        match size((expressions[0].as_deref(), expressions[1].as_deref()), &input) {
            Ok(size) => {
                if is_moved {
                    let message =
                        format!("the size of pass {index} depends on an input: it stays as its default makes it");
                    self.found.push(Diagnostic::warning(self.at, message));
                }
                size
            }
            Err(why) => {
                let hint = "give a number of texels, or a part of $WIDTH or $HEIGHT";
                self.error(format!("the size of pass {index} is not supported: {why}"), hint);
                PassSize::Canvas
            }
        }
    }
}

fn generated(id: &PassName, text: String) -> Source {
    Source { name: id.title(), path: None, text: text.into() }
}

/// Returns the buffer name for a target: buffer names contain only letters and digits.
fn buffer_name(target: &str) -> String {
    let known = PassName::buffer_named(&format!("buffer_{target}"));
    known.as_ref().and_then(PassName::buffer_name).unwrap_or("isf").to_owned()
}

fn linear(input: Input) -> Channel {
    Channel { input, sampler: Sampler { filter: Filter::Linear, wrap: Wrap::Clamp, vflip: true } }
}
