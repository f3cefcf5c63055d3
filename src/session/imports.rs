//! Imports of files that the user drops or picks, and of pasted texts.
//!
//! The project's layer identifies each of them; here it is opened, or added to the open project as a single edit that
//! can be undone.

use super::{
    Session,
    command::{FileCommand, PendingAction},
    open_project::OpenProject,
    scene,
    view::{About, Level},
};
use eddy_media::mesh;
use eddy_project::{self as project, FileKind, Fit, MeshSource, PassName, Project, TextImport, listed};
use std::path::{Path, PathBuf};

/// A model of more bytes is not measured before it is drawn: the window would block.
const MEASURED: u64 = 48 << 20;

impl Session {
    /// Imports a pasted text.
    pub(super) fn paste(&mut self, text: &str) {
        self.open.dismiss_notices(About::Opening);
        match project::import_of_text(text) {
            Ok(TextImport::Project(loaded)) => {
                self.open.report_diagnostics(&loaded.warnings, &loaded.sources);
                self.ask_to_save_then(PendingAction::Keep(Box::new(loaded.project)));
            }
            Ok(TextImport::Place(place)) => {
                let path = Path::new(&place);
                if path.exists() && project::kind_of_file(path) != FileKind::Project {
                    self.bring(vec![path.to_owned()], None);
                } else {
                    self.apply_to_files(FileCommand::Open(place));
                }
            }
            Err(e) => self.open.notice_about(About::Opening, Level::Warning, format!("nothing was pasted: {e}")),
        }
    }

    /// Imports files. `to`: the front pass and the channel that they were dropped on, or `None` if no project is shown:
    /// then a picture or a model creates a new one.
    pub(super) fn bring(&mut self, paths: Vec<PathBuf>, to: Option<(PassName, Option<usize>)>) {
        self.open.dismiss_notices(About::Opening);
        let of = |kind: FileKind| paths.iter().filter(move |p| project::kind_of_file(p) == kind);
        self.open.report_unusable_file(&paths);
        let projects: Vec<&Path> = of(FileKind::Project).map(PathBuf::as_path).collect();
        if let Some(first) = projects.first() {
            let parts = project::folder_of_parts(&projects);
            if projects.len() > 1 && parts.is_none() {
                let text =
                    format!("{} was opened; the other projects were skipped, as only one can be open", name(first));
                self.open.notice(Level::Info, text);
            }
            if let Some(recording) = of(FileKind::Recording).next() {
                let text = format!("drop {} again once the project is open, to play it there", name(recording));
                self.open.notice(Level::Info, text);
            }
            let place = parts.unwrap_or(first).display().to_string();
            return self.apply_to_files(FileCommand::Open(place));
        }
        // Dropped on a channel, a picture is only a picture.
        let is_on_channel = matches!(&to, Some((_, Some(_))));
        if let Some(picture) = of(FileKind::Picture).find(|path| !is_on_channel && scene::holds_project(path)) {
            return self.open_picture(picture);
        }
        if let Some(recording) = of(FileKind::Recording).next() {
            let file = recording.clone();
            return self.open.bring_recording(file, to.is_some());
        }
        let pictures = of(FileKind::Picture).chain(of(FileKind::Video)).chain(of(FileKind::Sound));
        let pictures: Vec<&Path> = pictures.map(PathBuf::as_path).collect();
        let models: Vec<&Path> = of(FileKind::Model).map(PathBuf::as_path).collect();
        let Some(first) = pictures.first().or(models.first()) else { return };
        match to {
            None => {
                let mut project = project::new_for(first, pictures.is_empty());
                let done = self.open.put_in(&mut project, &PassName::image(), None, &pictures, &models);
                self.ask_to_save_then(PendingAction::Keep(Box::new(project)));
                self.open.notice(Level::Info, format!("a new shader: {done}"));
            }
            Some((pass, channel)) => {
                let pass = if pass.is_picture() { pass } else { PassName::image() };
                let before = self.project().clone();
                let mut project = before.clone();
                let done = self.open.put_in(&mut project, &pass, channel, &pictures, &models);
                if project == before {
                    return self.open.notice(Level::Warning, done);
                }
                *self.open.documents.current_mut() = project;
                let names: Vec<String> = pictures.iter().chain(&models).map(|p| name(p)).collect();
                self.open.note_pass_edit(format!("use {}", listed(&names)), before);
                self.open.passes_changed();
                self.open.notice_with_undo(done);
            }
        }
    }
}

impl OpenProject {
    /// Plays a recording in the open project, if one is shown.
    fn bring_recording(&mut self, file: PathBuf, is_project_shown: bool) {
        if is_project_shown {
            return self.play_recording(file);
        }
        let text = format!(
            "{} is a recording of input: open the project that it was recorded in, then drop it on the picture",
            name(&file)
        );
        self.notice_about(About::Opening, Level::Warning, text);
    }

    /// Adds pictures, music and models to a project. Returns sentences about what reads them.
    fn put_in(
        &self,
        project: &mut Project,
        pass: &PassName,
        channel: Option<usize>,
        pictures: &[&Path],
        models: &[&Path],
    ) -> String {
        let folder = eddy_playback::capture::base_folder(project);
        let mut said = Vec::new();
        let mut wanted = channel;
        for picture in pictures {
            let Some(n) = wanted.take().or_else(|| project.free_channel(pass)) else {
                said.push(format!(
                    "all four channels of {} are in use; drop {} on the one to replace",
                    pass.title(),
                    name(picture)
                ));
                continue;
            };
            if is_video(picture) {
                project.read_video(pass, n, picture);
            } else if project::kind_of_file(picture) == FileKind::Sound {
                project.read_sound(pass, n, picture);
            } else {
                project.read_picture(pass, n, picture);
            }
            said.push(reads(project, pass, n, &name(picture)));
        }
        for model in models {
            let Some(id) = project.add_model(model, measured(model)) else {
                said.push(format!("{} was left out: the project has the maximum number of passes", name(model)));
                continue;
            };
            said.push(format!("{} draws {}", id.title(), name(model)));
            match project.free_channel(&PassName::image()) {
                Some(n) => {
                    project.read_buffer(&PassName::image(), n, &id);
                    said.push(reads(project, &PassName::image(), n, &id.title()));
                }
                None => said.push("all four channels of Image are in use".into()),
            }
        }
        project::bring_home(project, folder.as_deref());
        said.join("; ")
    }

    fn report_unusable_file(&mut self, paths: &[PathBuf]) {
        for path in paths {
            let name = name(path);
            match project::kind_of_file(path) {
                FileKind::Unknown => {
                    let known = "a project is a folder, a .glsl file or a Shadertoy .json file; a channel reads an \
                                 image file (png, jpg, webp, bmp, tga, gif, hdr), a video (mp4, webm, mkv, mov) or music \
                                 (mp3, ogg, wav, flac, m4a, aac, aiff), a pass draws a model (glb, gltf, \
                                 obj), a recording of input is a .replay file";
                    self.notice_about(
                        About::Opening,
                        Level::Warning,
                        format!("{name} is not a file Eddy can open: {known}"),
                    );
                }
                FileKind::Project
                | FileKind::Picture
                | FileKind::Video
                | FileKind::Sound
                | FileKind::Model
                | FileKind::Recording => {}
            }
        }
    }
}

/// Returns whether a file has a time axis: a video by its extension, or an image file with more than one frame.
fn is_video(path: &Path) -> bool {
    let is_animated = || {
        let bytes = project::confine::read_own(path, project::limits::MEDIA_FILE);
        bytes.is_ok_and(|bytes| eddy_video::is_animated(&bytes))
    };
    project::kind_of_file(path) == FileKind::Video || is_animated()
}

/// Returns a sentence that says what a channel reads now, and how its text accesses it.
fn reads(project: &Project, pass: &PassName, channel: usize, what: &str) -> String {
    let text = project.pass(pass).map_or("", |p| &p.source.text);
    let hint = if text.contains(&format!("iChannel{channel}")) {
        String::new()
    } else {
        format!(": write texture(iChannel{channel}, uv) to see it")
    };
    format!("iChannel{channel} of {} reads {what}{hint}", pass.title())
}

fn name(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into_owned())
}

/// Returns the position and scale of a model with which the camera sees all of it.
fn measured(model: &Path) -> Fit {
    let plain = Fit { scale: 1.0, position: [0.0; 3] };
    if std::fs::metadata(model).map_or(u64::MAX, |m| m.len()) > MEASURED {
        return plain;
    }
    // Errors in it are reported when it is drawn.
    let Ok(mesh) = mesh::load(&MeshSource::Picked(model.to_owned()), None, None) else { return plain };
    let bound = |pick: fn(f32, f32) -> f32, from: f32| {
        mesh.vertices.iter().fold([from; 3], |b, v| [0, 1, 2].map(|i| pick(b[i], v.position[i])))
    };
    Fit::of_corners(bound(f32::min, f32::INFINITY), bound(f32::max, f32::NEG_INFINITY))
}
