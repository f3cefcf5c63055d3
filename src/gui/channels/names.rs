//! Owns what inputs and samplers are called.

use crate::project::{Channel, Filter, Input, Media, Wrap};

pub fn input_name(input: &Input) -> String {
    match input {
        Input::Buffer(name) => format!("Buffer {name}"),
        Input::Target { buffer, index } => format!("Buffer {buffer}, target {index}"),
        Input::CubemapPass => "Cube A".into(),
        Input::Keyboard => "Keyboard".into(),
        Input::Texture(m) => media_name(m),
        Input::Cubemap(m) => format!("cubemap {}", media_name(m)),
        Input::Volume(m) => format!("volume {}", media_name(m)),
        Input::Video(m) => format!("video {}", media_name(m)),
        Input::Music(m) => format!("music {}", media_name(m)),
        Input::Microphone => "microphone".into(),
        Input::Webcam => "webcam".into(),
    }
}

fn media_name(media: &Media) -> String {
    let last = |path: &str| path.rsplit('/').next().unwrap_or(path).to_owned();
    match media {
        Media::Builtin(name) => name.clone(),
        Media::File(path) | Media::Picked(path) => {
            path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into())
        }
        Media::Site { path, .. } => last(path),
    }
}

pub fn filter_name(filter: Filter) -> &'static str {
    match filter {
        Filter::Nearest => "nearest",
        Filter::Linear => "linear",
        Filter::Mipmap => "mipmap",
    }
}

pub fn wrap_name(wrap: Wrap) -> &'static str {
    match wrap {
        Wrap::Clamp => "clamp",
        Wrap::Repeat => "repeat",
    }
}

pub fn sampler_name(channel: &Channel) -> String {
    if channel.input == Input::Keyboard {
        return "nearest, clamp".into();
    }
    let s = channel.sampler;
    format!("{}, {}", filter_name(s.filter), wrap_name(s.wrap))
}
