//! Real shaders in Shadertoy's JSON, from the folders that `EDDY_GLSL_CORPUS` names (separated by `:`): every pass of
//! every file must check without an error.

use super::checked;
use crate::{ChannelKind, PassKind};
use std::{env, fs, path::PathBuf};

fn channel_kind(input: &serde_json::Value) -> ChannelKind {
    let kind = input.get("type").or_else(|| input.get("ctype")).and_then(|k| k.as_str()).unwrap_or("");
    match kind {
        "volume" => ChannelKind::Sampler3D,
        "cubemap" => ChannelKind::SamplerCube,
        _ => ChannelKind::Sampler2D,
    }
}

fn text<'j>(pass: &'j serde_json::Value, key: &str) -> &'j str {
    pass.get(key).and_then(|v| v.as_str()).unwrap_or("")
}

/// Returns the failures in one file: the pass and its messages.
fn failures(json: &serde_json::Value, passes_seen: &mut u32) -> Vec<(String, String)> {
    let json = json.get(0).unwrap_or(json);
    let json = json.get("Shader").unwrap_or(json);
    let passes = json["renderpass"].as_array().map(Vec::as_slice).unwrap_or_default();
    let common: String =
        passes.iter().filter(|p| text(p, "type") == "common").map(|p| text(p, "code").to_owned() + "\n").collect();
    let mut failures = Vec::new();
    for pass in passes {
        let kind = match text(pass, "type") {
            "image" => PassKind::Image,
            "buffer" => PassKind::Buffer,
            "cubemap" => PassKind::Cubemap,
            "sound" => PassKind::Sound,
            _ => continue,
        };
        let mut channels = [ChannelKind::Sampler2D; 4];
        for input in pass["inputs"].as_array().map(Vec::as_slice).unwrap_or_default() {
            let at = input["channel"].as_u64().unwrap_or(0) as usize;
            if let Some(slot) = channels.get_mut(at) {
                *slot = channel_kind(input);
            }
        }
        let common = (!common.is_empty()).then_some(common.as_str());
        *passes_seen += 1;
        let (_, failed, messages) = checked(kind, channels, common, text(pass, "code"));
        if failed {
            failures.push((text(pass, "name").to_owned(), messages));
        }
    }
    failures
}

#[test]
#[ignore = "needs folders of Shadertoy's JSON"]
fn real_shaders_check_without_errors() {
    let folders = env::var_os("EDDY_GLSL_CORPUS").expect("EDDY_GLSL_CORPUS names the folders");
    let mut files: Vec<PathBuf> = env::split_paths(&folders)
        .flat_map(|folder| fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()))
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect();
    files.sort();
    let (mut failed, mut passes) = (0, 0);
    for path in &files {
        let json = serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
        for (pass, messages) in failures(&json, &mut passes) {
            failed += 1;
            println!("==== {} {pass}\n{messages}", path.display());
        }
    }
    println!("{} files, {passes} passes, {failed} fail", files.len());
    assert_eq!(failed, 0);
}
