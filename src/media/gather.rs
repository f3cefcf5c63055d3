//! Loads all media of a project.

use super::{MediaKey, MediaSet, MeshKey, film, load::load_within, sound};
use eddy_audio::{SAMPLE_RATE, Sound};
use eddy_diag::Diagnostic;
use eddy_project::{Channel, FillValue, Input, InputKind, Media, Pass, Project, limits};
use eddy_video::Pool;
use std::{collections::HashMap, path::Path, sync::Arc};

/// Loads every picture that a drawn pass of the project names. `media_dir` contains the user's own copies of
/// Shadertoy's textures. A picture that cannot be loaded is omitted, so that its channel reads as an unloaded one on
/// Shadertoy (opaque black, of size 0), and a warning names the pass, the channel and the fix.
pub fn gather(project: &Project, media_dir: Option<&Path>) -> (MediaSet, Vec<Diagnostic>) {
    let mut set = MediaSet::new();
    let mut warnings = pictures(project, media_dir, &mut set, |_| true);
    fills(project, &mut set);
    meshes(project, &mut set);
    warnings.extend(set.mesh_warnings(project));
    (set, warnings)
}

/// Loads only the picture files in the project's own folder, with the warnings of [`gather`].
pub fn files(project: &Project, set: &mut MediaSet) -> Vec<Diagnostic> {
    pictures(project, None, set, |input| matches!(input.media(), Some(Media::File(_))))
}

/// Returns the problems of the files that a project names: pictures of its folder, fills and models.
pub fn diagnose(project: &Project) -> Vec<Diagnostic> {
    let mut set = MediaSet::new();
    let mut found = files(project, &mut set);
    fills(project, &mut set);
    meshes(project, &mut set);
    found.extend(set.fill_errors(project));
    found.extend(set.mesh_errors(project));
    found.extend(set.mesh_warnings(project));
    found
}

/// The text for a channel whose file is missing.
const BLACK: &str = "the channel is black and of size 0";

/// Returns a warning for each channel that reads the microphone, for callers that cannot switch it on.
pub fn unrecorded(project: &Project) -> Vec<Diagnostic> {
    let warning = |(pass, n, _): (&Pass, usize, &Channel)| {
        let place = format!("iChannel{n} of {}", pass.id.title());
        Diagnostic::warning(None, format!("{place}: the microphone is not recorded; a synthetic spectrum is shown"))
            .hint("open the project in the window and switch the microphone on, or read a music file")
    };
    let is_microphone = |channel: &Channel| channel.input.kind() == InputKind::Microphone;
    channels(project).filter(|(.., channel)| is_microphone(channel)).map(warning).collect()
}

fn pictures(
    project: &Project,
    media_dir: Option<&Path>,
    set: &mut MediaSet,
    is_wanted: impl Fn(&Input) -> bool,
) -> Vec<Diagnostic> {
    let mut failed: HashMap<MediaKey, (String, String)> = HashMap::new();
    let mut warnings = Vec::new();
    let base = project.origin.base_dir();
    let pool = Pool::default();
    for (pass, n, channel) in channels(project).filter(|(.., channel)| is_wanted(&channel.input)) {
        let mut warn = |message: String, hint: String| {
            warnings
                .push(Diagnostic::warning(None, format!("iChannel{n} of {}: {message}", pass.id.title())).hint(hint));
        };
        let Some(key) = MediaKey::of_channel(channel) else { continue };
        let (is_music, is_video) = (channel.input.kind() == InputKind::Music, channel.input.kind() == InputKind::Video);
        if let Some((message, hint)) = failed.get(&key) {
            warn(message.clone(), hint.clone());
            continue;
        }
        if match channel.input.kind() {
            InputKind::Music => set.sound(&key.media).is_some(),
            InputKind::Video => set.video(&key.media).is_some(),
            _ => set.get(&key).is_some(),
        } {
            continue;
        }
        let (loaded, instead) = if is_music {
            let sound = sound::load(&key.media, base, media_dir, set.room());
            let instead = match key.media {
                Media::Site { .. } | Media::Builtin(_) => "a synthetic spectrum is shown",
                Media::File(_) | Media::Picked(_) => "the channel is silent",
            };
            (sound.map(|sound| set.insert_sound(key.media.clone(), sound, &mut warn)), instead)
        } else if is_video && set.videos.len() >= limits::VIDEOS {
            let message = format!("the project has more than {} videos, the limit", limits::VIDEOS);
            warn(format!("{message}; the channel is black and of size 0"), "read fewer different videos".into());
            continue;
        } else if is_video {
            let video = film::load(&key.media, base, media_dir, &pool);
            (video.map(|video| drop(set.videos.insert(key.media.clone(), Arc::new(video)))), BLACK)
        } else {
            let texels = load_within(&key, base, media_dir, set.room());
            (texels.map(|texels| set.insert(key.clone(), Arc::new(texels))), BLACK)
        };
        if let Err(error) = loaded {
            let message = format!("{error}; {instead}");
            warn(message.clone(), error.hint());
            failed.insert(key, (message, error.hint()));
        }
    }
    warnings
}

/// Loads every file that fills texels of a drawn pass. Errors are stored: see [`MediaSet::fill_errors`].
pub fn fills(project: &Project, set: &mut MediaSet) {
    let base = project.origin.base_dir();
    for (.., fill) in project.fills() {
        let Some(path) = fill.value.path().filter(|path| set.fill(path).is_none()) else { continue };
        let texels = match &fill.value {
            FillValue::InMemory { npy, .. } => super::npy::read(npy, path, set.room()),
            _ => load_within(&MediaKey::of_fill(path), base, None, set.room()),
        };
        match texels {
            Ok(texels) => set.insert_fill(path, Arc::new(texels)),
            Err(error) => drop(set.missing_fills.insert(path.to_owned(), (error.to_string(), error.hint()))),
        }
    }
}

/// Loads every mesh that a pass of the project draws. An error is stored in place of the mesh: see
/// [`MediaSet::mesh_errors`]. Parts that are not drawn are listed by [`MediaSet::mesh_warnings`].
pub fn meshes(project: &Project, set: &mut MediaSet) {
    let base = project.origin.base_dir();
    for draw in project.passes.iter().flat_map(|p| p.body.draws()) {
        let key = MeshKey::of(draw);
        if !set.meshes.contains_key(&key) {
            let loaded = super::mesh::load_within(&draw.mesh, draw.normals, base, set.room());
            set.insert_mesh(key, loaded);
        }
    }
}

/// The bytes of a frame of sound, left and right.
const SOUND_BYTES: u64 = 8;

/// Returns the seconds of sound that fit into this memory. Resampling needs two copies.
pub(super) fn room_of(bytes: u64) -> u64 {
    bytes / (2 * SOUND_BYTES * u64::from(SAMPLE_RATE))
}

/// Returns the bytes that this many seconds of sound need.
pub(super) fn bytes_of(seconds: u32) -> u64 {
    u64::from(seconds) * 2 * SOUND_BYTES * u64::from(SAMPLE_RATE)
}

impl MediaSet {
    /// Returns the bytes that further pictures and models may take.
    fn room(&self) -> u64 {
        let pictures = self.pictures.values().map(|texels| texels.bytes.len() as u64).sum::<u64>();
        let sounds = self.sounds.values().map(|sound| sound.frames.len() as u64 * SOUND_BYTES).sum::<u64>();
        let meshes = self.meshes.values().flatten().map(|mesh| mesh.bytes()).sum::<u64>();
        limits::MEDIA_BYTES.saturating_sub(pictures + sounds + meshes)
    }

    /// Returns one warning for each channel that reads a webcam while no camera is on.
    pub fn camera_warnings(&self, project: &Project) -> Vec<Diagnostic> {
        let reads = |channel: &Channel| channel.input.kind() == InputKind::Webcam && self.camera.is_none();
        let warning = |(pass, n, _): (&Pass, usize, &Channel)| {
            let message = format!("iChannel{n} of {}: no camera is on; the channel is black", pass.id.title());
            Diagnostic::warning(None, message).hint("name one: --webcam /dev/video0, or --webcam lavfi:testsrc")
        };
        channels(project).filter(|(.., channel)| reads(channel)).map(warning).collect()
    }

    fn insert_sound(&mut self, media: Media, sound: Sound, warn: &mut impl FnMut(String, String)) {
        if sound.truncated {
            let message = format!("only the first {:.0} s of the music are played", sound.seconds());
            warn(message, "cut the file: ffmpeg -i FILE -t 1200 music.ogg".into());
        }
        self.sounds.insert(media, Arc::new(sound));
    }
}

fn channels(project: &Project) -> impl Iterator<Item = (&Pass, usize, &Channel)> {
    project.passes.iter().flat_map(|pass| {
        pass.bindings
            .iter()
            .map(move |(n, channel)| (pass, n, channel))
            .filter(|(.., channel)| channel.input.target().is_none())
            // Channels that a sound pass cannot read are reported by the project's advice.
            .filter(|(pass, _, channel)| pass.id.is_picture() || channel.input.kind().is_in_sound())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::{Origin, PassName, Source};

    fn project(inputs: [Option<Input>; 4]) -> Project {
        let channels = inputs.map(|i| i.map(Channel::new));
        let source = Source { name: "image.glsl".into(), path: None, text: "".into() };
        let image = Pass { bindings: channels.into(), ..Pass::new(PassName::image(), source) };
        Project::new("p", vec![image], Origin::Unsaved)
    }

    #[test]
    fn files_are_loaded_once_and_missing_ones_are_warnings() {
        let missing = Input::texture(Media::Picked("/nowhere/pic.png".into()));
        let noise = || Some(Input::texture(Media::Builtin("noise-rgba-64".into())));
        let (set, warnings) =
            gather(&project([noise(), noise(), Some(missing), Some(Input::Device(InputKind::Webcam))]), None);
        assert_eq!(set.len(), 1);
        let messages: Vec<&str> = warnings.iter().map(|w| w.message.as_str()).collect();
        assert_eq!(warnings.len(), 1, "{messages:?}");
        assert!(messages[0].starts_with("iChannel2 of Image: cannot read /nowhere/pic.png"), "{messages:?}");
        assert!(warnings.iter().all(|w| !w.is_error() && !w.hints.is_empty()));
        let of_camera = set.camera_warnings(&project([None, Some(Input::Device(InputKind::Webcam)), None, None]));
        assert_eq!(of_camera.len(), 1);
        assert!(of_camera[0].message.starts_with("iChannel1 of Image: no camera is on"), "{}", of_camera[0].message);
    }

    #[test]
    fn a_project_without_pictures_has_no_warnings() {
        let p = project([Some(Input::KEYBOARD), Some(Input::buffer("A")), None, Some(Input::pass(PassName::cube()))]);
        assert_eq!(gather(&p, None), (MediaSet::new(), vec![]));
    }
}
