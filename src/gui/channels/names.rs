//! Display names of inputs and samplers.

use crate::project::{Channel, Filter, Input, InputKind, Media, Wrap};

pub(super) fn input_name(input: &Input) -> String {
    let title = input.row().title;
    match input {
        Input::Pass { id, target: 0 } => id.title(),
        Input::Pass { id, target } => format!("{}, target {target}", id.title()),
        Input::Media { kind: InputKind::Texture, media } => media_name(media),
        Input::Media { media, .. } => format!("{title} {}", media_name(media)),
        Input::Device(_) => title.into(),
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

pub(super) fn filter_name(filter: Filter) -> &'static str {
    match filter {
        Filter::Nearest => "nearest",
        Filter::Linear => "linear",
        Filter::Mipmap => "mipmap",
    }
}

pub(super) fn wrap_name(wrap: Wrap) -> &'static str {
    match wrap {
        Wrap::Clamp => "clamp",
        Wrap::Repeat => "repeat",
    }
}

pub(super) fn sampler_name(channel: &Channel) -> String {
    let sampler = channel.sampler();
    format!("{}, {}", filter_name(sampler.filter), wrap_name(sampler.wrap))
}
