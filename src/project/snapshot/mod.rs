//! A snapshot is a whole project in one text, including everything that is not on disk yet.
//!
//! Owns the text's format, for reading and writing: JSON with the project's location, an `eddy.toml` for everything
//! that is not text, and each tab's text under the tab's own name, so that two passes of one file may differ while they
//! are edited. Of the included files it contains the edited ones; of a fill that is only in memory (see
//! [`super::FillValue::InMemory`]) only the name.

use super::{
    Included, Media, MeshSource, Origin, Project, ProjectError, Source, Tab, confine, file_names::pass_of_stem,
    files::Files, json_values::check_json_values, limits, manifest,
};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, path::PathBuf};

/// The version of the format that this build writes, and the only one it reads.
const VERSION: u32 = 1;

/// A text that is not a snapshot.
#[derive(Debug, thiserror::Error)]
pub enum SnapshotError {
    #[error("not a snapshot of a project: {0}")]
    Json(#[from] serde_json::Error),
    #[error("a snapshot of version {0}, which another version of Eddy wrote; this one reads version {VERSION}")]
    Version(u32),
    #[error("not a snapshot of a project: {0}")]
    TooLarge(String),
    #[error(transparent)]
    Project(#[from] ProjectError),
}

#[derive(Serialize, Deserialize)]
struct Form {
    eddy_snapshot: u32,
    name: String,
    origin: SavedOrigin,
    /// The project in the form of `eddy.toml`.
    manifest: String,
    texts: Vec<Text>,
    /// Included files that were edited.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    included: Vec<IncludedText>,
    /// Channels that read a picture from anywhere on this machine, which `eddy.toml` cannot name.
    picked: Vec<Picked>,
    /// Draws of a model from anywhere on this machine, likewise.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    picked_models: Vec<PickedModel>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum SavedOrigin {
    Unsaved,
    Preset(String),
    Folder { path: PathBuf, has_manifest: bool },
    File(PathBuf),
    Json(PathBuf),
}

#[derive(Serialize, Deserialize)]
struct Text {
    /// `None`: Common.
    pass: Option<String>,
    stage: Option<String>,
    name: String,
    path: Option<PathBuf>,
    text: String,
}

#[derive(Serialize, Deserialize)]
struct IncludedText {
    /// Relative to the project's folder.
    name: String,
    path: Option<PathBuf>,
    text: String,
}

#[derive(Serialize, Deserialize)]
struct Picked {
    pass: String,
    channel: usize,
    path: PathBuf,
}

#[derive(Serialize, Deserialize)]
struct PickedModel {
    pass: String,
    draw: usize,
    path: PathBuf,
}

/// Returns the snapshot of a project. Relative paths become absolute: its reader may have another working directory.
pub fn write_snapshot(project: &Project) -> Result<String, SnapshotError> {
    let named = named(project);
    let text = |(tab, source): (Tab, &Source)| Text {
        pass: tab.pass().map(|pass| pass.key().to_owned()),
        stage: if let Tab::Stage(_, file) = tab { Some(file) } else { None },
        name: source.name.clone(),
        path: source.path.clone().map(absolute),
        text: source.text.to_string(),
    };
    let form = Form {
        eddy_snapshot: VERSION,
        name: project.name.clone(),
        origin: SavedOrigin::of(&project.origin),
        manifest: manifest::write(&named, None, &project.name, false),
        texts: project
            .tabs()
            .into_iter()
            .filter(|tab| !matches!(tab, Tab::Included(_)))
            .filter_map(|tab| Some((tab.clone(), project.source(&tab)?)))
            .map(text)
            .collect(),
        included: project
            .includes
            .iter()
            .filter(|i| i.is_edited)
            .map(|i| IncludedText {
                name: i.source.name.clone(),
                path: i.source.path.clone().map(absolute),
                text: i.source.text.to_string(),
            })
            .collect(),
        picked: picked(project),
        picked_models: picked_models(project),
    };
    Ok(serde_json::to_string(&form)?)
}

/// Returns the project that was passed to [`write_snapshot`]. Of the included files it only has the edited ones.
pub fn read_snapshot(text: &str) -> Result<Project, SnapshotError> {
    #[derive(Deserialize)]
    struct Version {
        eddy_snapshot: u32,
    }
    check_json_values(text, limits::PICTURE_VALUES).map_err(SnapshotError::TooLarge)?;
    let Version { eddy_snapshot } = serde_json::from_str(text)?;
    if eddy_snapshot != VERSION {
        return Err(SnapshotError::Version(eddy_snapshot));
    }
    let form: Form = serde_json::from_str(text)?;
    if form.manifest.len() as u64 > limits::MANIFEST.bytes {
        return Err(SnapshotError::TooLarge(format!("its eddy.toml is larger than {}", limits::MANIFEST)));
    }
    // Names made by `named`.
    let file = |text: &Text| match (&text.pass, &text.stage, &text.path) {
        (_, Some(stage), _) => stage.clone(),
        (None, ..) => "common.glsl".to_owned(),
        (Some(_), None, Some(_)) => text.name.clone(),
        (Some(pass), None, None) => format!("{pass}.glsl"),
    };
    let files: BTreeMap<String, Vec<u8>> =
        form.texts.iter().map(|text| (file(text), text.text.clone().into_bytes())).collect();
    let origin = form.origin.into_origin();
    let files = Files::in_memory(&files);
    let mut project = manifest::project("the snapshot", form.name.clone(), &form.manifest, &files, origin)?.project;
    project.name = form.name;
    for text in form.texts {
        let tab = match (text.pass, text.stage) {
            (None, _) => Some(Tab::Common),
            (Some(pass), None) => pass_of_stem(&pass).map(Tab::Pass),
            (Some(pass), Some(stage)) => pass_of_stem(&pass).map(|id| Tab::Stage(id, stage)),
        };
        if let Some(source) = tab.and_then(|tab| project.source_mut(&tab)) {
            *source = Source { name: text.name, path: text.path, text: text.text.into() };
        }
    }
    for Picked { pass, channel, path } in form.picked {
        let slot = pass_of_stem(&pass).and_then(|id| project.pass_mut(&id)?.bindings.get_mut(channel));
        if let Some(media) = slot.and_then(|channel| channel.input.media_mut()) {
            *media = Media::Picked(path);
        }
    }
    for PickedModel { pass, draw, path } in form.picked_models {
        let pass = pass_of_stem(&pass).and_then(|id| project.pass_mut(&id));
        if let Some(draw) = pass.and_then(|p| p.body.draws_mut().get_mut(draw)) {
            draw.mesh = MeshSource::Picked(path);
        }
    }
    // A name may come from an untrusted source.
    let is_inside = |text: &IncludedText| confine::relative("", &text.name).is_ok_and(|name| name == text.name);
    let included = form.included.into_iter().filter(is_inside).map(|text| Included {
        source: Source { name: text.name, path: text.path, text: text.text.into() },
        trouble: None,
        is_limit: false,
        is_edited: true,
    });
    project.includes = included.collect();
    Ok(project)
}

/// Returns the project with file names for its texts.
fn named(project: &Project) -> Project {
    let mut named = project.clone();
    if let Some(common) = &mut named.common {
        common.name = "common.glsl".into();
    }
    for pass in named.passes.iter_mut().filter(|p| p.source.path.is_none()) {
        pass.source.name = format!("{}.glsl", pass.id.key());
    }
    for channel in named.passes.iter_mut().flat_map(|p| p.bindings.channels_mut()) {
        if let Some(media @ Media::Picked(_)) = channel.input.media_mut() {
            // Its own name may be invalid in a project.
            *media = Media::File("picked.png".into());
        }
    }
    for draw in named.passes.iter_mut().flat_map(|p| p.body.draws_mut()) {
        if let mesh @ MeshSource::Picked(_) = &mut draw.mesh {
            *mesh = MeshSource::File("picked.glb".into());
        }
    }
    named
}

fn picked_models(project: &Project) -> Vec<PickedModel> {
    let mut list = Vec::new();
    for pass in &project.passes {
        for (n, draw) in pass.body.draws().iter().enumerate() {
            if let MeshSource::Picked(path) = &draw.mesh {
                list.push(PickedModel { pass: pass.id.key().to_owned(), draw: n, path: absolute(path.clone()) });
            }
        }
    }
    list
}

fn picked(project: &Project) -> Vec<Picked> {
    let mut list = Vec::new();
    for pass in &project.passes {
        for (slot, channel) in pass.bindings.iter() {
            if let Some(Media::Picked(path)) = channel.input.media() {
                list.push(Picked { pass: pass.id.key().to_owned(), channel: slot, path: absolute(path.clone()) });
            }
        }
    }
    list
}

fn absolute(path: PathBuf) -> PathBuf {
    std::path::absolute(&path).unwrap_or(path)
}

impl SavedOrigin {
    fn of(origin: &Origin) -> SavedOrigin {
        match origin.clone() {
            Origin::Unsaved => SavedOrigin::Unsaved,
            Origin::Preset(name) => SavedOrigin::Preset(name),
            Origin::Folder { path, has_manifest } => SavedOrigin::Folder { path: absolute(path), has_manifest },
            Origin::File(path) => SavedOrigin::File(absolute(path)),
            Origin::Json(path) => SavedOrigin::Json(absolute(path)),
        }
    }

    fn into_origin(self) -> Origin {
        match self {
            SavedOrigin::Unsaved => Origin::Unsaved,
            SavedOrigin::Preset(name) => Origin::Preset(name),
            SavedOrigin::Folder { path, has_manifest } => Origin::Folder { path, has_manifest },
            SavedOrigin::File(path) => Origin::File(path),
            SavedOrigin::Json(path) => Origin::Json(path),
        }
    }
}

#[cfg(test)]
mod tests;
