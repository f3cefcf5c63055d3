//! Lists the parts of a project that Shadertoy's JSON cannot express, so that they are reported before the file is
//! written.

use crate::{Input, Media, Pass, PassName, Project, advice, listed};

/// The buffers that Shadertoy has.
const BUFFERS: [&str; 4] = ["A", "B", "C", "D"];

/// Returns a sentence for each feature that Shadertoy lacks, with what it becomes there. Empty if nothing is lost.
pub fn losses(project: &Project) -> Vec<String> {
    let mut lost = Vec::new();
    let uniforms: Vec<String> = project.custom_uniforms().list.into_iter().map(|uniform| uniform.name).collect();
    match uniforms.as_slice() {
        [] => {}
        [one] => lost.push(format!("The uniform {one} becomes a constant with its current value.")),
        _ => lost.push(format!("The uniforms {} become constants with their current values.", listed(&uniforms))),
    }
    if !project.controls.is_empty() {
        lost.push("The controls of MIDI and OSC devices are left out.".into());
    }
    let included: Vec<&str> =
        project.includes.iter().filter(|i| i.trouble.is_none()).map(|i| i.source.name.as_str()).collect();
    if !included.is_empty() {
        lost.push(format!("Included files are copied into the code: {}.", listed(&included)));
    }
    lost.extend(project.passes.iter().filter_map(settings));
    for group in &project.groups {
        let passes: Vec<String> = group.passes.iter().map(PassName::title).collect();
        lost.push(format!("{} are drawn once per frame, not {} times.", listed(&passes), group.steps));
    }
    let further: Vec<String> =
        project.passes.iter().map(|pass| &pass.id).filter(|id| is_further(id)).map(PassName::title).collect();
    if !further.is_empty() {
        lost.push(format!("Shadertoy has only Buffer A to D and cannot read {}; Eddy can.", listed(&further)));
    }
    for pass in &project.passes {
        for (n, channel) in pass.bindings.iter() {
            let what = picture(&channel.input);
            lost.extend(what.map(|what| format!("iChannel{n} of {} reads {what}", pass.id.title())));
        }
    }
    lost.extend(
        advice::shared_samplers(project).into_iter().map(|warning| format!("{}.", capitalised(&warning.message))),
    );
    lost
}

fn is_further(id: &PassName) -> bool {
    id.buffer_name().is_some_and(|name| !BUFFERS.contains(&name))
}

/// Lists the settings of a pass that are omitted.
fn settings(pass: &Pass) -> Option<String> {
    let (own, usual) = (&pass.settings, crate::PassSettings::default());
    let all = [
        (own.size != usual.size, "size"),
        (own.format != usual.format, "format"),
        (own.region != usual.region, "region"),
        (own.initial != usual.initial, "initial state"),
        (own.boundary != usual.boundary, "boundary"),
        (own.when != usual.when, "condition"),
    ];
    let named: Vec<&str> = all.into_iter().filter(|(is_set, _)| *is_set).map(|(_, name)| name).collect();
    (!named.is_empty())
        .then(|| format!("The {} of {} {} left out.", listed(&named), pass.id.title(), is_or_are(&named)))
}

fn is_or_are(names: &[&str]) -> &'static str {
    if names.len() == 1 { "is" } else { "are" }
}

/// Describes what an input that Shadertoy does not have becomes.
fn picture(input: &Input) -> Option<String> {
    let row = input.row();
    if !row.is_on_shadertoy {
        return Some(format!("the {}, which Shadertoy does not have; the channel is empty there.", row.key));
    }
    match input.media()? {
        Media::Builtin(name) => Some(format!("{name}, a texture of Eddy's; the channel is empty on Shadertoy.")),
        Media::File(path) | Media::Picked(path) => {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            Some(format!(
                "the image file {name}; the channel is empty on Shadertoy, and Eddy looks for the file next to the JSON."
            ))
        }
        Media::Site { .. } => None,
    }
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}
