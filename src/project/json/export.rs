//! [`Project`] to the site's own JSON.

use super::ids;
use crate::{
    Channel, CustomUniform, Filter, Input, Media, Pass, PassId, Project, Wrap, custom_uniforms::constants, directives,
};
use eddy_diag::SourceId;
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// The project as the site's own export writes it. A picture that the site does not have (a file, one of Eddy's own) is
/// written as an address of its own kind, which [`super::import`] reads and the site does not; so is a fifth buffer.
/// The author's own uniforms become constants of the value they have, and included files stand in place of their lines.
pub fn export(project: &Project) -> String {
    let mut info: Map<String, Value> = project.info.extra.clone();
    info.insert("id".into(), json!(project.info.id));
    info.insert("name".into(), json!(project.name));
    info.insert("username".into(), json!(project.info.author));
    info.insert("description".into(), json!(project.info.description));
    info.insert("tags".into(), json!(project.info.tags));
    let (custom_uniforms, includes) = (project.custom_uniforms(), project.include_lines());
    let text = |id: SourceId| {
        let (common, own) = (includes.reach(Project::COMMON_ID), includes.reach(id));
        let declared = |custom_uniform: &CustomUniform, within: &BTreeSet<SourceId>| {
            custom_uniform.declared_in.iter().any(|id| within.contains(id))
        };
        let here = custom_uniforms
            .list
            .iter()
            .filter(|k| declared(k, &own) && (id == Project::COMMON_ID || !declared(k, &common)));
        let text = project.inlined(id, &includes);
        constants::text(&directives::commented(&text), here, &project.custom_uniform_values)
    };
    let pass = |(index, pass): (usize, &Pass)| self::pass(pass, text(Project::pass_id(index)));
    // Image first, as the site writes it.
    let image = project.passes.iter().enumerate().filter(|(_, p)| p.id == PassId::Image);
    let others = project.passes.iter().enumerate().filter(|(_, p)| p.id != PassId::Image);
    let mut passes: Vec<Value> = image.map(pass).collect();
    passes.extend(project.common.iter().map(|_| {
        let code = text(Project::COMMON_ID);
        json!({
            "inputs": [], "outputs": [], "code": code, "name": "Common", "description": "", "type": "common"
        })
    }));
    passes.extend(others.map(pass));
    let shader = json!({ "ver": "0.1", "info": info, "renderpass": passes });
    format!("{shader:#}\n")
}

fn pass(pass: &Pass, code: String) -> Value {
    let inputs: Vec<Value> =
        pass.channels.iter().enumerate().filter_map(|(n, c)| Some(input(n, c.as_ref()?))).collect();
    let (kind, output) = match &pass.id {
        PassId::Buffer(name) => ("buffer", ids::of_buffer(name)),
        PassId::Cubemap => ("cubemap", ids::CUBEMAP.to_owned()),
        PassId::Sound => ("sound", ids::SOUND.to_owned()),
        PassId::Image => ("image", ids::IMAGE.to_owned()),
    };
    json!({
        "inputs": inputs,
        "outputs": [{ "id": output, "channel": 0 }],
        "code": code,
        "name": pass.id.title(),
        "description": "",
        "type": kind,
    })
}

fn input(n: usize, channel: &Channel) -> Value {
    let fixed = |kind: &'static str, id: &str, path: &str| (kind, id.to_owned(), path.to_owned());
    let (kind, id, path) = match &channel.input {
        Input::Buffer(name) => ("buffer", ids::of_buffer(name), ids::preview(name)),
        // Only geometry passes have further targets, and a project with one is not exported.
        Input::Target { buffer, .. } => ("buffer", ids::of_buffer(buffer), ids::preview(buffer)),
        Input::CubemapPass => fixed("cubemap", ids::CUBEMAP, "/media/previz/cubemap00.png"),
        Input::Keyboard => fixed("keyboard", ids::KEYBOARD, "/presets/tex00.jpg"),
        Input::Microphone => fixed("mic", ids::MICROPHONE, "/presets/mic.png"),
        Input::Webcam => fixed("webcam", ids::WEBCAM, "/presets/webcam.png"),
        Input::Texture(m) => of_media("texture", m),
        Input::Cubemap(m) => of_media("cubemap", m),
        Input::Volume(m) => of_media("volume", m),
        Input::Video(m) => of_media("video", m),
        Input::Music(m @ Media::Site { path, .. }) if path.starts_with("http") => of_media("musicstream", m),
        Input::Music(m) => of_media("music", m),
    };
    let sampler = channel.sampler;
    json!({
        "id": id,
        "filepath": path,
        "type": kind,
        "channel": n,
        "sampler": {
            "filter": match sampler.filter {
                Filter::Nearest => "nearest",
                Filter::Linear => "linear",
                Filter::Mipmap => "mipmap",
            },
            "wrap": match sampler.wrap {
                Wrap::Clamp => "clamp",
                Wrap::Repeat => "repeat",
            },
            "vflip": if sampler.vflip { "true" } else { "false" },
            "srgb": "false",
            "internal": "byte",
        },
        "published": 1,
    })
}

fn of_media(kind: &'static str, media: &Media) -> (&'static str, String, String) {
    match media {
        Media::Builtin(name) => (kind, String::new(), format!("builtin://{name}")),
        Media::File(path) => (kind, String::new(), format!("file://{}", path.to_string_lossy().replace('\\', "/"))),
        // Where the picture lies on this machine is nobody else's to know.
        Media::Picked(path) => (kind, String::new(), format!("file://{}", file_name(path))),
        Media::Site { id, path } => (kind, id.clone(), path.clone()),
    }
}

fn file_name(path: &std::path::Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
