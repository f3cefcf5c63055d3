//! Exports a [`Project`] as Shadertoy's own JSON.

use super::ids;
use crate::{
    Channel, CustomUniform, Filter, Input, Media, Pass, Project, Wrap, custom_uniforms::constants, directives,
};
use eddy_diag::SourceId;
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// The project in the form of Shadertoy's own export. A picture that Shadertoy does not have (a file, a built-in one)
/// is written as an address of its own kind, which [`super::import`] reads and Shadertoy does not; so is a fifth
/// buffer. The author's own uniforms become constants with their current values, and included files replace their
/// lines.
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
    // Image first, as Shadertoy writes it.
    let image = project.passes.iter().enumerate().filter(|(_, p)| p.id.is_image());
    let others = project.passes.iter().enumerate().filter(|(_, p)| !p.id.is_image());
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
    let inputs: Vec<Value> = pass.bindings.iter().map(|(n, channel)| input(n, channel)).collect();
    let output = pass.id.buffer_name().map_or_else(|| pass.id.row().json_output.to_owned(), ids::of_buffer);
    json!({
        "inputs": inputs,
        "outputs": [{ "id": output, "channel": 0 }],
        "code": code,
        "name": pass.id.title(),
        "description": "",
        "type": pass.id.row().json_type,
    })
}

fn input(n: usize, channel: &Channel) -> Value {
    let row = channel.input.row();
    let of_row = || row.json_id.map(|(id, path)| (id.to_owned(), path.to_owned())).unwrap_or_default();
    let (id, path) = match &channel.input {
        // Only geometry passes have further targets, and projects with one are not exported.
        Input::Pass { id, .. } => {
            id.buffer_name().map_or_else(of_row, |name| (ids::of_buffer(name), ids::preview(name)))
        }
        Input::Device(_) => of_row(),
        Input::Media { media, .. } => of_media(media),
    };
    let kind = match (row.json_stream_type, channel.input.media()) {
        (Some(stream), Some(Media::Site { path, .. })) if path.starts_with("http") => stream,
        _ => row.json_type,
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

/// Returns the id and the path of a picture.
fn of_media(media: &Media) -> (String, String) {
    match media {
        Media::Builtin(name) => (String::new(), format!("builtin://{name}")),
        Media::File(path) => (String::new(), format!("file://{}", path.to_string_lossy().replace('\\', "/"))),
        // The location of the picture on this machine is private.
        Media::Picked(path) => (String::new(), format!("file://{}", file_name(path))),
        Media::Site { id, path } => (id.clone(), path.clone()),
    }
}

fn file_name(path: &std::path::Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
