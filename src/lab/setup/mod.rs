//! A method's project, configured for one point.

use super::LabError;
use eddy_diag::SourceId;
use eddy_engine::BuildOptions;
use eddy_media::{MediaSet, Texels};
use eddy_project::{
    self as project, Channel, CustomUniformType, CustomUniformValue, Fill, Filter, Input, Origin, PassName, Project,
    Sampler, TexelFormat, Wrap, presets::Library,
};
use include_dir::{Dir, include_dir};
use std::{path::PathBuf, sync::Arc};

static METHODS: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/../../assets/lab");

static LIBRARY: Library = Library::new(&METHODS);

/// The storage of the texels of all passes, if specified.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Storage {
    #[default]
    AsWritten,
    /// Every 32-bit float format becomes the 16-bit one with the same number of components.
    Half,
}

/// Replaces `old` by `new` in the text of a pass or of Common.
#[derive(Clone)]
struct Edit {
    /// `None` for Common.
    pass: Option<PassName>,
    old: String,
    new: String,
}

/// A function that adds passes to a project.
type Build = Arc<dyn Fn(&mut Project) + Send + Sync>;

/// A project of `assets/lab` or a preset, at a size and with its settings.
#[derive(Clone, Default)]
pub struct Setup {
    folder: &'static str,
    size: (u32, u32),
    custom_uniforms: Vec<(String, CustomUniformValue)>,
    defines: Vec<(&'static str, String)>,
    steps: Vec<(&'static str, u32)>,
    initial: Vec<(PassName, Fill)>,
    texts: Vec<(PassName, String)>,
    edits: Vec<Edit>,
    states: Vec<(PathBuf, Arc<Texels>)>,
    storage: Storage,
    wanted: Vec<PassName>,
    skip: bool,
    given: Vec<PassName>,
    value: Option<(PassName, &'static str)>,
    built: Option<Build>,
}

impl Setup {
    /// `folder` is a folder of `assets/lab`, or a preset's name. The pass `field` is measured, unless [`Setup::wants`]
    /// specifies another.
    pub fn new(folder: &'static str, size: (u32, u32)) -> Setup {
        Setup { folder, size, wanted: vec![pass("field")], skip: true, ..Setup::default() }
    }

    pub fn folder(&self) -> &'static str {
        self.folder
    }

    pub fn size(&self) -> (u32, u32) {
        self.size
    }

    pub fn wanted(&self) -> &[PassName] {
        &self.wanted
    }

    /// Returns whether passes whose inputs have not changed are skipped.
    pub fn skips(&self) -> bool {
        self.skip
    }

    /// Draws every pass in every frame: the cost of a picture while its camera moves.
    #[must_use]
    pub fn restless(mut self) -> Self {
        self.skip = false;
        self
    }

    /// Sets an `#iUniform` that is a float, an int, or a bool (1 for true). A value that the custom uniform cannot
    /// take, including one outside of its range, is an error of [`Setup::project`].
    #[must_use]
    pub fn uniform(mut self, name: &str, value: f64) -> Self {
        self.custom_uniforms.push((name.into(), CustomUniformValue::Float(value)));
        self
    }

    /// Sets an `#iUniform bool`.
    #[must_use]
    pub fn flag(mut self, name: &str, value: bool) -> Self {
        self.custom_uniforms.push((name.into(), CustomUniformValue::Bool(value)));
        self
    }

    /// Sets an `#iUniform` of several components.
    #[must_use]
    pub fn uniforms(mut self, name: &str, values: &[f64]) -> Self {
        self.custom_uniforms.push((name.into(), CustomUniformValue::Vector(values.to_vec())));
        self
    }

    /// Defines a macro before Common: the difference between methods of one project.
    #[must_use]
    pub fn define(mut self, name: &'static str, value: impl ToString) -> Self {
        self.defines.push((name, value.to_string()));
        self
    }

    /// Sets the steps of a group per frame.
    #[must_use]
    pub fn steps(mut self, group: &'static str, steps: u32) -> Self {
        self.steps.push((group, steps));
        self
    }

    /// Replaces the text of a pass: another scene for a filter that reads it.
    #[must_use]
    pub fn text(mut self, name: &str, text: impl Into<String>) -> Self {
        self.texts.push((pass(name), text.into()));
        self
    }

    /// Replaces `old` by `new` in a pass's text or in `common`, which must contain it. Used for parts of a preset
    /// without a custom uniform: its scene.
    #[must_use]
    pub fn edit(mut self, name: &str, old: &str, new: impl Into<String>) -> Self {
        let pass = (name != "common").then(|| pass(name));
        self.edits.push(Edit { pass, old: old.into(), new: new.into() });
        self
    }

    /// Sets the content of a pass before frame 0 by a GLSL expression, in place of the project's.
    #[must_use]
    pub fn initial(mut self, name: &str, expression: &str) -> Self {
        self.initial.push((pass(name), Fill::expression(expression)));
        self
    }

    /// Sets the content of a pass of the canvas's size before frame 0, texel by texel from the bottom left.
    #[must_use]
    pub fn state(self, name: &str, texels: &[[f32; 4]]) -> Self {
        let size = self.size;
        self.state_sized(name, size, texels)
    }

    /// Does the same as [`Setup::state`] for a pass of any size.
    #[must_use]
    pub fn state_sized(mut self, name: &str, (width, height): (u32, u32), texels: &[[f32; 4]]) -> Self {
        let path = PathBuf::from(format!("{name}.npy"));
        let bytes = bytemuck::cast_slice(texels).to_vec();
        self.states.push((path.clone(), Arc::new(Texels::flat(width, height, TexelFormat::Rgba32f, bytes))));
        self.initial.push((pass(name), Fill::file(path)));
        self
    }

    /// Makes a pass of the canvas's size output these texels in every frame, from the bottom left, in place of its
    /// text: the input for testing a filter. It is drawn in every frame, like a scene.
    #[must_use]
    pub fn given(mut self, name: &str, texels: &[[f32; 4]]) -> Self {
        self.given.push(pass(name));
        self.state(name, texels)
    }

    /// Measures a value of a pass instead of its picture: the first value of the variable that the pass declares with
    /// the words `declaration`, as in `vec3 light`. So the output of a preset is seen before tone mapping, and its text
    /// is unchanged; `eddy probe` does the same for any project.
    #[must_use]
    pub fn wants_value(mut self, name: &str, declaration: &'static str) -> Self {
        self.value = Some((pass(name), declaration));
        self.wanted = vec![BuildOptions::probed()];
        self
    }

    #[must_use]
    pub fn storage(mut self, storage: Storage) -> Self {
        self.storage = storage;
        self
    }

    /// Selects the passes whose texels are measured.
    #[must_use]
    pub fn wants(mut self, passes: &[&str]) -> Self {
        self.wanted = passes.iter().map(|name| pass(name)).collect();
        self
    }

    /// Measures the picture.
    #[must_use]
    pub fn wants_picture(mut self) -> Self {
        self.wanted = vec![PassName::image()];
        self
    }

    /// Adds passes in code that depend on the size or the setting.
    #[must_use]
    pub fn built(mut self, build: impl Fn(&mut Project) + Send + Sync + 'static) -> Self {
        self.built = Some(Arc::new(build));
        self
    }

    /// Returns the project as passed to the engine.
    pub fn project(&self) -> Result<(Project, MediaSet), LabError> {
        let lacks = |what: String| LabError::Setup { method: self.folder.into(), what };
        let mut project = match LIBRARY.has(self.folder) {
            true => project::presets::load_embedded(&LIBRARY, self.folder)?.project,
            false => project::presets::load(self.folder)?.project,
        };
        if let Some(build) = &self.built {
            build(&mut project);
        }
        for (id, text) in &self.texts {
            project.pass_mut(id).ok_or_else(|| lacks(id.title()))?.source.text = text.as_str().into();
        }
        for id in &self.given {
            let pass = project.pass_mut(id).ok_or_else(|| lacks(id.title()))?;
            let sampler = Sampler { filter: Filter::Nearest, wrap: Wrap::Clamp, vflip: true };
            let Some(name) = id.buffer_name() else { return Err(lacks("a buffer to be given".into())) };
            pass.source.text = GIVEN.into();
            pass.bindings = [Some(Channel { input: Input::buffer(name), sampler })].into();
        }
        for Edit { pass, old, new } in &self.edits {
            let source = match pass {
                Some(id) => project.pass_mut(id).map(|p| &mut p.source),
                None => project.common.as_mut(),
            };
            let source = source.filter(|s| s.text.contains(old)).ok_or_else(|| lacks(format!("text `{old}`")))?;
            source.text = source.text.replace(old, new).into();
        }
        if !self.defines.is_empty() {
            let common = project.common.as_mut().ok_or_else(|| lacks("common.glsl to define macros in".into()))?;
            let lines: String = self.defines.iter().map(|(name, value)| format!("#define {name} {value}\n")).collect();
            common.text = (lines + &common.text).into();
        }
        let known = project.custom_uniforms();
        for (name, value) in &self.custom_uniforms {
            let custom_uniform = known.get(name).ok_or_else(|| lacks(format!("uniform {name}")))?;
            let value = match (custom_uniform.ty, value) {
                (CustomUniformType::Bool, CustomUniformValue::Float(number)) => {
                    CustomUniformValue::Bool(*number >= 0.5)
                }
                (_, value) => value.clone(),
            };
            let fitting = custom_uniform
                .fit(&value)
                .map_err(|why| lacks(format!("{value:?} for the uniform {name}, which {why}")))?;
            project.custom_uniform_values.insert(name.clone(), fitting);
        }
        for (name, steps) in &self.steps {
            let group = project.groups.iter_mut().find(|g| g.name == *name);
            group.ok_or_else(|| lacks(format!("group {name}")))?.steps = *steps;
        }
        for (id, fill) in &self.initial {
            let pass = project.pass_mut(id).ok_or_else(|| lacks(id.title()))?;
            pass.settings.initial = Some(fill.clone());
        }
        if self.storage == Storage::Half {
            halve(&mut project);
        }
        project.origin = Origin::Unsaved;
        let mut media = MediaSet::new();
        for (path, texels) in &self.states {
            media.insert_fill(path, texels.clone());
        }
        Ok((project, media))
    }

    /// Returns a fingerprint of everything that determines the result: the texts after all edits, their settings, the
    /// initial texels, the canvas and what is measured.
    pub fn fingerprint(&self) -> Result<String, LabError> {
        let (project, _) = self.project()?;
        let mut print = project::Fingerprint::of(&project);
        for (path, texels) in &self.states {
            print.eat(format!("{} {} {}", path.display(), texels.shape.width, texels.shape.height).as_bytes());
            print.eat(&texels.bytes);
        }
        print.eat(format!("{:?} {:?} {}", self.size, self.wanted, self.skip).as_bytes());
        print.eat(format!("{:?}", self.value).as_bytes());
        Ok(print.text())
    }

    /// Returns the position of the measured value in this setup's project: its pass and its place in a text. `None` if
    /// a picture is measured.
    pub(super) fn value_at(&self, project: &Project) -> Result<Option<(PassName, SourceId, u32)>, LabError> {
        let Some((id, declaration)) = &self.value else { return Ok(None) };
        let lacks = || LabError::Setup { method: self.folder.into(), what: format!("declaration `{declaration}`") };
        let index = project.passes.iter().position(|p| p.id == *id).ok_or_else(lacks)?;
        let text = &project.passes[index].source.text;
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let ends = text.match_indices(*declaration).map(|(at, found)| at + found.len());
        let mut ends = ends.filter(|end| !text[*end..].starts_with(is_word));
        // The last letter of the variable's name.
        let at = ends.next().ok_or_else(lacks)? - 1;
        Ok(Some((id.clone(), Project::pass_id(index), at as u32)))
    }
}

/// The text of a pass that outputs its input.
const GIVEN: &str = "void mainImage(out vec4 texel, in vec2 fragCoord) {
    texel = texelFetch(iChannel0, ivec2(fragCoord), 0);
}
";

/// Returns the buffer with this file name, or `image`.
pub fn pass(name: &str) -> PassName {
    if name == "image" {
        return PassName::image();
    }
    PassName::parse(&format!("buffer_{name}")).unwrap_or_default()
}

/// The text of a pass whose value a 16-bit float cannot represent: 1 and three quarters of its last bit.
pub(super) const PROBE: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0 + 0.75 / 1024.0); }";

/// Replaces every 32-bit float format of a buffer by the 16-bit one with the same number of components. The picture
/// itself is not stored between frames, and is shown in 8 bits.
pub(super) fn halve(project: &mut Project) {
    for pass in project.passes.iter_mut().filter(|p| !p.id.is_image()) {
        pass.settings.format = half(pass.settings.format);
        let more = pass.body.geometry_mut().into_iter().flat_map(|g| &mut g.more_targets);
        more.for_each(|format| *format = half(*format));
    }
}

fn half(format: TexelFormat) -> TexelFormat {
    match format {
        TexelFormat::R32f => TexelFormat::R16f,
        TexelFormat::Rg32f => TexelFormat::Rg16f,
        TexelFormat::Rgba32f => TexelFormat::Rgba16f,
        other => other,
    }
}

/// Splits a number of steps into frames of equal size: (frames, steps per frame), with the largest divisor that is at
/// most `most`.
pub fn frames_of(total: u32, most: u32) -> (u32, u32) {
    let steps = (1..=most.max(1)).rev().find(|n| total.is_multiple_of(*n)).unwrap_or(1);
    (total / steps, steps)
}

#[cfg(test)]
mod tests;
