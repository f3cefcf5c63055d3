//! The project of a complete fragment shader: passes that include the file, which Eddy generates around it.

use super::{
    AlphaRule, Dialect, HostTexture, SoundTexture,
    recognise::is_sound,
    regenerate::regenerated,
    samplers::{DeclaredUniform, declared_uniforms},
    twigl,
};
use crate::{
    Channel, Input, InputKind, Loaded, MAX_CHANNELS, Media, Origin, Overwrite, Pass, PassName, PassSize, Project,
    ProjectError, Sampler, Side, Source, TexelFormat,
    atomic::Content,
    confine,
    files::Files,
    includes, limits,
    lines::hash_lines,
    words::{find_word, names_word},
    writes::Writes,
};
use eddy_diag::{Diagnostic, SourceMap, Span};
use eddy_texture::Dimension;
use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// Built-in textures that replace pictures until the user chooses others, in rotation.
const STAND_INS: [&str; 4] = ["street", "marble", "coral", "pebbles"];

/// The buffers that contain the outputs of the previous frame.
const PREVIOUS: [&str; 2] = ["previous", "previous1"];
/// The buffer that keeps the first of several outputs of the previous frame while the others are drawn.
const HELD: &str = "held";
/// The macro that selects the pass after the scene in glslViewer.
const POSTPROCESSING: &str = "POSTPROCESSING";
/// The buffer that contains the picture before `POSTPROCESSING`.
const SCENE: &str = "scene";

/// Returns the project of a complete fragment shader of a dialect.
pub(crate) fn load(
    path: &Path,
    (name, text): (&str, &str),
    files: &Files<'_>,
    dialect: Dialect,
) -> Result<Loaded, ProjectError> {
    let mut uniforms = declared_uniforms(text);
    if dialect == Dialect::Twigl {
        uniforms.extend(twigl::implied_samplers(text, &uniforms));
    }
    let maker = Maker { dialect, name, text, uniforms, files };
    let found = maker.problems();
    if !found.is_empty() {
        let mut sources = SourceMap::default();
        sources.add(name, text);
        return Err(ProjectError::Invalid { what: path.display().to_string(), diagnostics: found, sources });
    }
    let origin = Origin::File(path.to_owned());
    let mut project = Project::new(path.file_stem().unwrap_or_default().to_string_lossy(), maker.passes(), origin);
    project.dialect = dialect;
    includes::read(&mut project, Some(files));
    Ok(Loaded { sources: project.sources(), project, warnings: Vec::new() })
}

struct Maker<'t> {
    dialect: Dialect,
    name: &'t str,
    text: &'t str,
    uniforms: Vec<DeclaredUniform>,
    files: &'t Files<'t>,
}

impl Maker<'_> {
    /// Returns errors for passes that Eddy does not draw, and for too many textures.
    fn problems(&self) -> Vec<Diagnostic> {
        let error = |at: usize, length: usize, message: String, hint: &str| {
            Diagnostic::error(Span::new(eddy_diag::SourceId(0), at..at + length), message).hint(hint)
        };
        let mut found = Vec::new();
        if self.dialect == Dialect::GlslViewer {
            for kind in ["CONVOLUTION_PYRAMID", "PYRAMID", "FLOOD"] {
                if let Some((at, _)) = self.selected(kind).into_values().next() {
                    let message = format!("the {kind} passes of glslViewer are not supported");
                    found.push(error(at, kind.len(), message, "draw the picture in BUFFER_n and DOUBLE_BUFFER_n"));
                    break;
                }
            }
        }
        let buffers = ["BUFFER", "DOUBLE_BUFFER"].map(|kind| self.selected(kind).len()).iter().sum::<usize>();
        if buffers + 2 > limits::PASSES {
            let message = format!("the file has {buffers} buffers, and a project at most {} passes", limits::PASSES);
            found.push(error(0, 0, message, "remove some of them"));
        }
        if self.dialect == Dialect::Bonzomatic
            && let Some(at) = ["uimage2D", "image2D"].iter().find_map(|word| find_word(self.text, word))
        {
            let message = "this is a shader of Bonzomatic Compute, which writes to images".to_owned();
            found.push(error(at, "uimage2D".len(), message, "Eddy draws shaders that only write their colour"));
        }
        if let Some(last) = self.samplers().nth(MAX_CHANNELS) {
            let message = format!("a pass reads at most {MAX_CHANNELS} textures, and this is one more");
            found.push(error(last.at, last.name.len(), message, "declare fewer samplers"));
        }
        found
    }

    fn samplers(&self) -> impl Iterator<Item = &DeclaredUniform> {
        self.uniforms.iter().filter(|uniform| uniform.dimension().is_some())
    }

    /// Returns the numbers of the passes that a text selects by macros `KIND_n`, each with the place of its first line.
    /// glslViewer (`src/core/tools/text.cpp`) takes them from `#ifdef` and from the first term of `#if` and `#elif`.
    fn selected(&self, kind: &str) -> BTreeMap<usize, (usize, usize)> {
        let mut found = BTreeMap::new();
        for line in hash_lines(self.text) {
            let Some(name) = tested_macro(line.body) else { continue };
            let number = name.strip_prefix(kind).and_then(|rest| rest.strip_prefix('_')?.parse::<usize>().ok());
            if let Some(number) = number {
                found.entry(number).or_insert((line.range.start, line.range.len()));
            }
        }
        found
    }

    fn has_postprocessing(&self) -> bool {
        hash_lines(self.text).iter().any(|line| tested_macro(line.body) == Some(POSTPROCESSING))
    }

    fn reads(&self, texture: HostTexture) -> bool {
        self.samplers().any(|sampler| (self.dialect.row().texture)(&sampler.name) == Some(texture))
    }

    fn passes(&self) -> Vec<Pass> {
        if self.dialect == Dialect::Twigl && is_sound(self.text) {
            let image = Pass::new(PassName::image(), generated("Image", twigl::BLACK.to_owned()));
            let text = twigl::sound_text(self.text, &format!("#include \"{}\"\n", self.name));
            return vec![Pass::new(PassName::sound(), generated("Sound", text)), image];
        }
        let mut passes = self.sound_passes();
        if self.dialect == Dialect::GlslViewer {
            // The buffers are numbered from 0 without gaps, however the text numbers them.
            for number in 0..self.selected("BUFFER").len() {
                passes.push(self.buffer(
                    &number.to_string(),
                    &[&format!("BUFFER_{number}")],
                    &format!("u_buffer{number}"),
                ));
            }
            for number in 0..self.selected("DOUBLE_BUFFER").len() {
                let (name, sampler) = (format!("double{number}"), format!("u_doubleBuffer{number}"));
                passes.push(self.buffer(&name, &[&format!("DOUBLE_BUFFER_{number}")], &sampler));
            }
            if self.has_postprocessing() {
                let mut scene = self.pass(PassName::buffer(SCENE), &[]);
                scene.settings.format = TexelFormat::Rgba8;
                passes.push(scene);
                passes.push(self.pass(PassName::image(), &[POSTPROCESSING]));
                return passes;
            }
        }
        let second = self.reads(HostTexture::Previous(1));
        if second || self.reads(HostTexture::Previous(0)) {
            let mut previous = self.pass(PassName::buffer(PREVIOUS[0]), &[]);
            previous.settings.format = self.dialect.row().previous.0;
            let show = |id: PassName| {
                let mut pass = Pass::new(id.clone(), generated(&id.title(), SHOW.to_owned()));
                let channel = Channel { input: Input::buffer(PREVIOUS[0]), sampler: self.dialect.row().previous.1 };
                pass.bindings.set(0, Some(channel));
                pass
            };
            if second {
                // The first output of the previous frame, when the new one is already drawn.
                let mut held = show(PassName::buffer(HELD));
                held.settings.format = previous.settings.format;
                let mut other = self.pass_of_output(PassName::buffer(PREVIOUS[1]), &[], 1);
                other.settings.format = previous.settings.format;
                let first = Input::buffer(PREVIOUS[0]);
                other.bindings.channels_mut().filter(|channel| channel.input == first).for_each(|channel| {
                    channel.input = Input::buffer(HELD);
                });
                passes.extend([held, previous, other]);
            } else {
                passes.push(previous);
            }
            passes.push(show(PassName::image()));
            return passes;
        }
        passes.push(self.pass(PassName::image(), &[]));
        passes
    }

    /// Returns a buffer of glslViewer, whose size is in the comment of its sampler.
    fn buffer(&self, name: &str, defines: &[&str], sampler: &str) -> Pass {
        let mut pass = self.pass(PassName::buffer(name), defines);
        pass.settings.format = TexelFormat::Rgba32f;
        let comment = self.uniforms.iter().find(|uniform| uniform.name == sampler).map(|uniform| &*uniform.comment);
        pass.settings.size = comment.and_then(size_of).unwrap_or_default();
        pass
    }

    /// Returns a pass that draws the file with these macros.
    fn pass(&self, id: PassName, defines: &[&str]) -> Pass {
        self.pass_of_output(id, defines, 0)
    }

    /// Does the same for one of several outputs of the file.
    fn pass_of_output(&self, id: PassName, defines: &[&str], output: usize) -> Pass {
        let mut text =
            format!("// {} of {}: Eddy generates this text, and includes the file.\n", id.title(), self.name);
        if self.dialect == Dialect::GlslViewer {
            text.push_str("#define GLSLVIEWER 340\n#define PLATFORM_LINUX\n#define MODEL_VERTEX_TEXCOORD v_texcoord\n");
        }
        defines.iter().for_each(|define| text.push_str(&format!("#define {define}\n")));
        let include = format!("#include \"{}\"\n", self.name);
        match self.dialect {
            Dialect::Twigl => text.push_str(&twigl::text(self.text, &self.uniforms, &include, output)),
            _ => text.push_str(&include),
        }
        let mut pass = Pass::new(id.clone(), generated(&id.title(), text));
        for (slot, sampler) in self.samplers().take(MAX_CHANNELS).enumerate() {
            pass.bindings.set(slot, Some(self.channel(slot, sampler)));
            pass.bindings.set_name(slot, &sampler.name);
        }
        pass
    }

    fn channel(&self, slot: usize, sampler: &DeclaredUniform) -> Channel {
        let row = self.dialect.row();
        let buffer = |name: String| Channel { input: Input::buffer(name), sampler: row.picture };
        match (row.texture)(&sampler.name) {
            Some(HostTexture::Buffer(number)) => buffer(number.to_string()),
            Some(HostTexture::DoubleBuffer(number)) => buffer(format!("double{number}")),
            Some(HostTexture::Scene) => buffer(SCENE.to_owned()),
            Some(HostTexture::Previous(output)) => {
                Channel { input: Input::buffer(PREVIOUS[output.min(1)]), sampler: row.previous.1 }
            }
            Some(HostTexture::Sound(sound)) => buffer(sound.buffer().to_owned()),
            Some(HostTexture::Picture(number)) => self.picture(number, sampler),
            None => self.picture(slot, sampler),
        }
    }

    /// Returns the picture that the comment of a sampler names, as in glslCanvas, or a built-in one.
    fn picture(&self, number: usize, sampler: &DeclaredUniform) -> Channel {
        let media = |kind, name: &str| Input::Media { kind, media: Media::Builtin(name.to_owned()) };
        let input = match sampler.dimension() {
            Some(Dimension::D3) => media(InputKind::Volume, "noise-rgba-3d"),
            Some(Dimension::Cube) => media(InputKind::Cubemap, "forest"),
            _ => {
                let file = sampler.comment.split_whitespace().next().unwrap_or_default().trim_start_matches('/');
                match confine::relative("", file).ok().filter(|file| is_picture(file) && self.files.exists(file)) {
                    Some(file) => Input::texture(Media::File(file.into())),
                    None => media(InputKind::Texture, STAND_INS[number % STAND_INS.len()]),
                }
            }
        };
        Channel { input, sampler: self.dialect.row().picture }
    }

    /// The buffers that contain the spectrum of a sound, if the text reads it.
    fn sound_passes(&self) -> Vec<Pass> {
        let all = [SoundTexture::Spectrum, SoundTexture::Smoothed, SoundTexture::Integrated];
        let read: Vec<SoundTexture> = all.into_iter().filter(|sound| self.reads(HostTexture::Sound(*sound))).collect();
        if read.is_empty() {
            return Vec::new();
        }
        let pass = |sound: &SoundTexture| {
            let id = PassName::buffer(sound.buffer());
            let mut pass = Pass::new(id.clone(), generated(&id.title(), sound.text()));
            pass.settings.size = PassSize::Fixed(1024, 1);
            pass.settings.format = TexelFormat::Rgba32f;
            pass.bindings.set(0, Some(Channel::new(Input::Device(InputKind::Microphone))));
            pass.bindings.set(1, Some(Channel { input: Input::buffer(sound.buffer()), sampler: Sampler::BUFFER }));
            pass
        };
        read.iter().map(pass).collect()
    }
}

impl SoundTexture {
    /// The name of the buffer that contains it.
    fn buffer(self) -> &'static str {
        match self {
            SoundTexture::Spectrum => "spectrum",
            SoundTexture::Smoothed => "smoothed",
            SoundTexture::Integrated => "integrated",
        }
    }

    /// The text of that buffer. Bonzomatic (`src/platform_common/FFT.cpp`) stores 2 |X| / 1024 for 2048 samples, which
    /// is 4 times the magnitude that the Web Audio API defines ("FFT windowing and smoothing over time"), divided by the
    /// mean 0.42 of its Blackman window. Shadertoy's texture contains the lower 512 bins, from -100 to -30 dB.
    fn text(self) -> String {
        // `before` is the texel of the previous frame, at first 0. The sum is of a smoothed spectrum, in g.
        let value = match self {
            SoundTexture::Spectrum => "x",
            SoundTexture::Smoothed => "mix(x, before.r, 0.9)",
            SoundTexture::Integrated => "before.r, mix(x, before.g, 0.6), 0.0, 1.0",
        };
        let sum = match self {
            SoundTexture::Integrated => "    color.r += color.g;\n    if (color.r > 1024.0) color.r -= 1024.0;\n",
            _ => "",
        };
        format!(
            "// The spectrum of the sound in iChannel0, with the scale of Bonzomatic.\n\
             void mainImage(out vec4 color, in vec2 at) {{\n\
             \x20   float level = at.x < 512.0 ? texelFetch(iChannel0, ivec2(at.x, 0), 0).r : 0.0;\n\
             \x20   float x = level > 0.0 ? 4.0 / 0.42 * pow(10.0, (70.0 * level - 100.0) / 20.0) : 0.0;\n\
             \x20   vec4 before = texelFetch(iChannel1, ivec2(at), 0);\n\
             \x20   color = vec4({value});\n{sum}}}\n"
        )
    }
}

/// The text of an Image pass that shows a buffer in channel 0.
const SHOW: &str = "\
// The picture, which the next frame reads.
void mainImage(out vec4 color, in vec2 at) {
    color = texelFetch(iChannel0, ivec2(at), 0);
}
";

/// Returns the treatment of the alpha that a pass of a complete fragment shader outputs.
pub(crate) fn alpha(dialect: Dialect, pass: &Pass) -> AlphaRule {
    let is = |name: &str| pass.id == PassName::buffer(name);
    match dialect {
        // Blending is off for the pass after the scene.
        Dialect::GlslViewer if pass.id.is_image() && names_word(&pass.source.text, POSTPROCESSING) => AlphaRule::Opaque,
        Dialect::GlslViewer if is(SCENE) => AlphaRule::OverTransparent,
        // The copy of the previous frame has no alpha.
        Dialect::Bonzomatic if is(PREVIOUS[0]) => AlphaRule::Opaque,
        _ if pass.id.is_image() => dialect.row().alpha,
        _ => AlphaRule::Stored,
    }
}

fn generated(name: &str, text: String) -> Source {
    Source { name: name.to_owned(), path: None, text: text.into() }
}

/// Returns the macro that a conditional line tests first.
fn tested_macro(body: &str) -> Option<&str> {
    let word =
        |text: &str| text.trim_start().split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next().map(str::len);
    if let Some(rest) = body.strip_prefix("ifdef") {
        let rest = rest.trim_start();
        return Some(&rest[..word(rest)?]);
    }
    let rest = body.strip_prefix("if").or_else(|| body.strip_prefix("elif"))?.trim_start();
    let rest = rest.strip_prefix("defined")?.trim_start().strip_prefix('(')?.trim_start();
    Some(&rest[..word(rest)?])
}

/// Returns the size in the comment of a buffer's sampler: `512x256`, or a fraction of the picture's.
fn size_of(comment: &str) -> Option<PassSize> {
    let number = |c: char| !c.is_ascii_digit() && c != '.';
    let first = &comment[..comment.find(number).unwrap_or(comment.len())];
    if let Some(rest) = comment[first.len()..].strip_prefix('x') {
        let second = &rest[..rest.find(number).unwrap_or(rest.len())];
        let (width, height) = (first.parse().ok()?, second.parse().ok()?);
        return (width > 0 && height > 0).then_some(PassSize::Fixed(width, height));
    }
    let scale: f64 = first.parse().ok().filter(|scale| *scale > 0.0)?;
    Some(if scale == 1.0 { PassSize::Canvas } else { PassSize::Sides(Side::Floor(scale), Side::Floor(scale)) })
}

fn is_picture(file: &str) -> bool {
    let ending = Path::new(file).extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    ["jpg", "jpeg", "png", "bmp", "gif", "hdr", "exr", "tga", "webp"]
        .iter()
        .any(|known| ending.eq_ignore_ascii_case(known))
}

/// Saves the edits of a file and of the files that it includes; Eddy generates the texts around it.
pub(crate) fn save(project: &Project, target: &Path, overwrite: Overwrite<'_>) -> Result<Project, ProjectError> {
    // As the text is now, or as it is on disk if nothing can be generated from it.
    let fresh = regenerated(project).map_or_else(|| load_again(target), Ok)?;
    let is_drawn_the_same = |a: &Pass, b: &Pass| a.settings == b.settings && a.body == b.body;
    let is_same = |a: &Pass, b: &Pass| a.id == b.id && a.source.text == b.source.text && is_drawn_the_same(a, b);
    let passes = project.passes.len() == fresh.passes.len()
        && project.passes.iter().zip(&fresh.passes).all(|(a, b)| is_same(a, b) && a.bindings == b.bindings);
    let text = |project: &Project| project.common.as_ref().map(|common| common.text.clone());
    let others = text(project) == text(&fresh)
        && project.info == fresh.info
        && project.custom_uniform_values == fresh.custom_uniform_values;
    if !passes || !others || !project.controls.is_empty() {
        let what = format!(
            "more than the text of one file of {}, such as values of sliders, a description, Common or further passes",
            project.dialect.row().title
        );
        return Err(ProjectError::CannotHold { path: target.to_owned(), what });
    }
    let edited: Vec<_> = project.includes.iter().filter(|included| included.is_edited).collect();
    let owned: BTreeSet<String> = edited.iter().map(|included| included.source.name.clone()).collect();
    let mut writes = Writes::into(target.parent().unwrap_or(Path::new("")), owned);
    for included in edited {
        writes.add(&included.source.name, Content::Bytes(included.source.text.as_bytes().to_vec()))?;
    }
    writes.write(overwrite)?;
    load_again(target)
}

fn load_again(path: &Path) -> Result<Project, ProjectError> {
    Ok(crate::load(&path.display().to_string())?.project)
}
