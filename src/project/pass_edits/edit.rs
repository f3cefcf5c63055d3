//! The edits and their implementation.

use super::groups;
use crate::{
    Boundary, Condition, Fill, FillValue, Filter, Pass, PassName, PassSize, Project, Region, Sampler, Source, Tab,
    TexelFormat, Wrap, confine,
    file_names::{self, FileRole},
    limits,
    settings::draws,
};
use std::path::Path;

/// A change of a project's passes.
#[derive(Clone, Debug, PartialEq)]
pub enum PassEdit {
    /// Renames a buffer, from user input: see [`PassName::buffer_named`]. Its readers read it under the new name.
    Rename { pass: PassName, name: String },
    /// Moves a buffer to an index among the buffers, counted from 0 in drawing order.
    Move { pass: PassName, to: usize },
    /// Sets the size of a buffer's texture.
    Size(PassName, PassSize),
    /// Sets the format of its texels.
    Format(PassName, TexelFormat),
    /// Sets the region that is drawn; `None`: all.
    Region(PassName, Option<Region>),
    /// Sets the condition for drawing, from user input; `None`: drawn in every frame.
    When(PassName, Option<String>),
    /// Sets the contents of a buffer before frame 0; `None`: zeros.
    Initial(PassName, Option<FillValue>),
    /// Sets the outermost texels of a pass, and the width from each edge; `None`: as drawn.
    Boundary(PassName, Option<(u32, FillValue)>),
    /// Sets the number of draws of a buffer per frame, together with the others of its group.
    Steps(PassName, u32),
    /// Adds a buffer to the group of the previous buffer, or starts another group with it.
    WithPrevious(PassName, bool),
    /// Sets the filter of every channel that reads a buffer.
    Filter(PassName, Filter),
    /// Sets the wrap mode of every channel that reads a buffer.
    Wrap(PassName, Wrap),
    /// Removes Common or a pass. Channels that read it stay, and read zeros.
    Remove(Tab),
}

/// The effects of an edit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PassEdited {
    /// True if the project has changed.
    pub is_changed: bool,
    /// The old and the new name of a renamed pass.
    pub renamed: Option<(PassName, PassName)>,
}

/// The reason why an edit of passes is invalid.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PassEditError {
    #[error("there is no {0}")]
    NoSuchPass(String),
    #[error("\"{0}\" is not a valid buffer name: {rule}", rule = PassName::NAMES)]
    BadName(String),
    #[error("there is a {0} already; choose another name")]
    Taken(String),
    #[error("{0} cannot be renamed or moved; only buffers can")]
    NotABuffer(String),
    #[error("Image cannot be removed")]
    Image,
    #[error("{0} is used by a draw; remove it in eddy.toml instead")]
    Stage(String),
    #[error("{0} is included by passes; remove its #include line instead")]
    Included(String),
    #[error("{pass} has no {what}; set it on a buffer and show that buffer")]
    NotHere { pass: String, what: &'static str },
    #[error("a size needs a factor above 0, or at least one texel in each direction")]
    BadSize,
    #[error("a region needs at least one texel in each direction")]
    BadRegion,
    #[error("{0}")]
    BadCondition(String),
    #[error("a boundary is at least one texel wide")]
    BadBoundary,
    #[error("the expression is missing; for example vec4(0.0)")]
    EmptyFill,
    #[error("\"{0}\" is not the name of a file in the project's folder")]
    BadFillFile(String),
    #[error("a buffer is drawn at least once per frame")]
    NoSteps,
    #[error("a frame would draw {0} passes and meshes with all their steps; the limit is {most}", most = limits::DRAWS)]
    TooManyDraws(u64),
    #[error("{0} is the first buffer; there is none before it")]
    First(String),
}

impl PassEdit {
    /// Returns the subject of the edit for a menu, after "Undo".
    pub fn title(&self) -> String {
        let of = |what: &str, pass: &PassName| format!("{what} of {}", pass.title());
        match self {
            PassEdit::Rename { pass, name } => format!("rename {} to {name}", pass.title()),
            PassEdit::Move { pass, .. } => format!("move {}", pass.title()),
            PassEdit::Size(pass, _) => of("size", pass),
            PassEdit::Format(pass, _) => of("format", pass),
            PassEdit::Region(pass, _) => of("region", pass),
            PassEdit::When(pass, _) => of("condition", pass),
            PassEdit::Initial(pass, _) => of("beginning", pass),
            PassEdit::Boundary(pass, _) => of("edges", pass),
            PassEdit::Steps(pass, _) => of("steps", pass),
            PassEdit::WithPrevious(pass, _) => of("group", pass),
            PassEdit::Filter(pass, _) => of("filter", pass),
            PassEdit::Wrap(pass, _) => of("wrap", pass),
            PassEdit::Remove(tab) => format!("remove {}", tab.title()),
        }
    }

    /// Returns whether `next` continues this edit, as when a number is dragged.
    pub fn is_same_kind(&self, next: &PassEdit) -> bool {
        match (self, next) {
            (PassEdit::Size(a, a_size), PassEdit::Size(b, b_size)) => {
                a == b && std::mem::discriminant(a_size) == std::mem::discriminant(b_size)
            }
            (PassEdit::Region(a, Some(_)), PassEdit::Region(b, Some(_))) => a == b,
            (PassEdit::Boundary(a, Some((_, a_value))), PassEdit::Boundary(b, Some((_, b_value)))) => {
                a == b && a_value == b_value
            }
            (PassEdit::Steps(a, _), PassEdit::Steps(b, _)) => a == b,
            _ => false,
        }
    }
}

impl Project {
    /// Edits the passes. On an error nothing changes.
    pub fn edit_passes(&mut self, edit: &PassEdit) -> Result<PassEdited, PassEditError> {
        let mut next = self.clone();
        let renamed = next.edit(edit)?;
        let all = draws(&next.passes, &next.groups);
        if all > limits::DRAWS && all > draws(&self.passes, &self.groups) {
            return Err(PassEditError::TooManyDraws(all));
        }
        let is_changed = next != *self;
        *self = next;
        Ok(PassEdited { is_changed, renamed })
    }

    fn edit(&mut self, edit: &PassEdit) -> Result<Option<(PassName, PassName)>, PassEditError> {
        match edit {
            PassEdit::Rename { pass, name } => return self.rename(pass, name),
            PassEdit::Move { pass, to } => self.move_buffer(pass, *to)?,
            PassEdit::Size(pass, size) => {
                let is_size = match *size {
                    PassSize::Canvas => true,
                    PassSize::Scale(by) => by.is_finite() && by > 0.0,
                    PassSize::Fixed(width, height) => width > 0 && height > 0,
                    PassSize::Sides(width, height) => width.is_valid() && height.is_valid(),
                };
                if !is_size {
                    return Err(PassEditError::BadSize);
                }
                self.buffer(pass, "size")?.settings.size = *size;
            }
            PassEdit::Format(pass, format) => self.buffer(pass, "format")?.settings.format = *format,
            PassEdit::Region(pass, region) => {
                if region.is_some_and(|r| r.width == 0 || r.height == 0) {
                    return Err(PassEditError::BadRegion);
                }
                if pass.row().refusal("region").is_some() {
                    self.buffer(pass, "region")?;
                }
                self.found(pass)?.settings.region = *region;
            }
            PassEdit::When(pass, text) => {
                if pass.row().refusal("when").is_some() {
                    self.buffer(pass, "condition")?;
                }
                let when = text.as_deref().map(Condition::parse).transpose();
                let when = when.map_err(|error| PassEditError::BadCondition(error.to_string()))?;
                let settings = &mut self.found(pass)?.settings;
                if settings.when != when {
                    settings.when = when;
                }
            }
            PassEdit::Initial(pass, value) => {
                self.buffer(pass, "initial state")?;
                let settings = &mut self.filled(pass, "initial state")?.settings;
                settings.initial = fill(value.as_ref(), settings.initial.as_ref())?;
            }
            PassEdit::Boundary(pass, value) => {
                let settings = &mut self.filled(pass, "boundary")?.settings;
                let (width, value) = value.as_ref().map_or((1, None), |(width, value)| (*width, Some(value)));
                if width == 0 {
                    return Err(PassEditError::BadBoundary);
                }
                let value = fill(value, settings.boundary.as_ref().map(|boundary| &boundary.value))?;
                settings.boundary = value.map(|value| Boundary { width, value });
            }
            PassEdit::Steps(pass, steps) => {
                self.buffer(pass, "steps")?;
                groups::set_steps(self, pass, *steps)?;
            }
            PassEdit::WithPrevious(pass, is_joined) => {
                self.buffer(pass, "group")?;
                groups::join(self, pass, *is_joined)?;
            }
            PassEdit::Filter(pass, filter) => self.readers(pass)?.for_each(|sampler| sampler.filter = *filter),
            PassEdit::Wrap(pass, wrap) => self.readers(pass)?.for_each(|sampler| sampler.wrap = *wrap),
            PassEdit::Remove(tab) => self.remove(tab)?,
        }
        Ok(None)
    }

    fn found(&mut self, id: &PassName) -> Result<&mut Pass, PassEditError> {
        self.pass_mut(id).ok_or_else(|| PassEditError::NoSuchPass(id.title()))
    }

    fn buffer(&mut self, id: &PassName, what: &'static str) -> Result<&mut Pass, PassEditError> {
        let is_buffer = id.is_buffer();
        let found = self.found(id)?;
        if is_buffer { Ok(found) } else { Err(PassEditError::NotHere { pass: id.title(), what }) }
    }

    /// Returns a pass whose texels can be filled from outside its own program.
    fn filled(&mut self, id: &PassName, what: &'static str) -> Result<&mut Pass, PassEditError> {
        let found = self.found(id)?;
        // A pass that draws meshes is cleared in every frame.
        if !id.is_picture() || found.body.is_cleared() {
            return Err(PassEditError::NotHere { pass: id.title(), what });
        }
        Ok(found)
    }

    /// The samplers of all channels that read a buffer.
    fn readers<'p>(&'p mut self, id: &'p PassName) -> Result<impl Iterator<Item = &'p mut Sampler>, PassEditError> {
        self.buffer(id, "filter and wrap")?;
        let channels = self.passes.iter_mut().flat_map(|p| p.bindings.channels_mut());
        Ok(channels.filter(move |c| c.input.target().is_some_and(|(of, _)| of == id)).map(|c| &mut c.sampler))
    }

    fn rename(&mut self, from: &PassName, name: &str) -> Result<Option<(PassName, PassName)>, PassEditError> {
        self.found(from)?;
        if !from.is_buffer() {
            return Err(PassEditError::NotABuffer(from.title()));
        }
        let to = PassName::buffer_named(name).ok_or_else(|| PassEditError::BadName(name.trim().to_owned()))?;
        if to == *from {
            return Ok(None);
        }
        if self.pass(&to).is_some() {
            return Err(PassEditError::Taken(to.title()));
        }
        let pass = self.found(from)?;
        pass.id = to.clone();
        pass.source.follow_rename(from, &to);
        for channel in self.passes.iter_mut().flat_map(|p| p.bindings.channels_mut()) {
            if let Some(id) = channel.input.pass_mut().filter(|id| *id == from) {
                id.clone_from(&to);
            }
        }
        for id in self.groups.iter_mut().flat_map(|g| &mut g.passes).filter(|id| *id == from) {
            *id = to.clone();
        }
        Ok(Some((from.clone(), to)))
    }

    fn move_buffer(&mut self, id: &PassName, to: usize) -> Result<(), PassEditError> {
        self.found(id)?;
        if !id.is_buffer() {
            return Err(PassEditError::NotABuffer(id.title()));
        }
        let count = self.passes.iter().filter(|p| p.id.is_buffer()).count();
        // Buffers come first.
        let Some(from) = self.passes.iter().position(|p| p.id == *id) else { return Ok(()) };
        let pass = self.passes.remove(from);
        self.passes.insert(to.min(count - 1), pass);
        groups::settle_moved(self, id);
        Ok(())
    }

    fn remove(&mut self, tab: &Tab) -> Result<(), PassEditError> {
        match tab {
            Tab::Pass(id) if id.is_image() => return Err(PassEditError::Image),
            Tab::Stage(_, file) => return Err(PassEditError::Stage(file.clone())),
            Tab::Included(file) => return Err(PassEditError::Included(file.clone())),
            Tab::Common if self.common.is_none() => return Err(PassEditError::NoSuchPass(tab.title())),
            Tab::Common => self.common = None,
            Tab::Pass(id) => {
                self.found(id)?;
                self.passes.retain(|p| p.id != *id);
                groups::forget(self, id);
            }
        }
        Ok(())
    }
}

/// Returns a fill with a value. An equal one keeps its place in `eddy.toml`.
fn fill(value: Option<&FillValue>, now: Option<&Fill>) -> Result<Option<Fill>, PassEditError> {
    let Some(value) = value else { return Ok(None) };
    match value {
        FillValue::Expression(text) if text.trim().is_empty() => return Err(PassEditError::EmptyFill),
        FillValue::Expression(_) | FillValue::InMemory { .. } => {}
        FillValue::File(path) => {
            let name = path.to_str().and_then(|name| confine::relative("", name).ok());
            if name.is_none() {
                return Err(PassEditError::BadFillFile(path.display().to_string()));
            }
        }
    }
    let kept = now.filter(|now| now.value == *value).cloned();
    Ok(Some(kept.unwrap_or_else(|| Fill { value: value.clone(), written: None })))
}

impl Source {
    /// Renames a text with its pass. A file that is named after the pass gets the new name when it is saved: until then
    /// its path is the existing file, and its name the new one. A file with any other name keeps it.
    pub fn follow_rename(&mut self, from: &PassName, to: &PassName) {
        if self.path.is_none() {
            if self.name == from.title() {
                self.name = to.title();
            }
            return;
        }
        let file = Path::new(&self.name);
        let Some(own) = file.file_name().and_then(|name| name.to_str()) else { return };
        if file_names::role_of_file(own) != Some(FileRole::Pass(from.clone())) {
            return;
        }
        let extension = file.extension().and_then(|e| e.to_str()).unwrap_or("glsl");
        let folder = &self.name[..self.name.len() - own.len()];
        self.name = format!("{folder}{}.{extension}", to.key());
    }
}
