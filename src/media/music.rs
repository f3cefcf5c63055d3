//! The music of a project's channels.

use super::MediaSet;
use eddy_audio::Sound;
use eddy_project::{Input, InputKind, Media, Project};
use std::sync::Arc;

/// The music of a channel.
#[derive(Clone, Debug)]
pub struct ChannelSound {
    pub media: Media,
    pub sound: Arc<Sound>,
}

/// Returns the music of the channels of a project, without duplicates.
pub fn sounds(project: &Project, media: &MediaSet) -> Vec<ChannelSound> {
    let mut found: Vec<ChannelSound> = Vec::new();
    let channels = project.passes.iter().filter(|pass| pass.id.is_picture()).flat_map(|pass| pass.bindings.channels());
    for channel in channels {
        let Input::Media { kind: InputKind::Music, media: name } = &channel.input else { continue };
        if let Some(sound) = media.sound(name)
            && found.iter().all(|known| known.media != *name)
        {
            found.push(ChannelSound { media: name.clone(), sound: sound.clone() });
        }
    }
    found
}
