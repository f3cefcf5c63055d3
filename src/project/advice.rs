//! Warnings about projects that are legal but probably mistaken: channels that read a missing pass, and channels
//! that Shadertoy cannot have.

use super::{Channel, Filter, Input, InputKind, PassName, Project, SamplerRules, Wrap, nearest};
use eddy_diag::{Diagnostic, Span};
use std::{collections::BTreeMap, fmt::Debug};

/// Returns a warning for each. They have no span.
pub fn advice(project: &Project) -> Vec<Diagnostic> {
    let mut warnings = unread(project, |_, _| None);
    warnings.extend(shared_samplers(project));
    warnings.extend(unheard(project));
    warnings
}

/// Returns a warning for each channel of a sound pass that reads black there, as on Shadertoy
/// (`shadertoy.md`, section 8).
fn unheard(project: &Project) -> Vec<Diagnostic> {
    let Some(sound) = project.sound() else { return Vec::new() };
    let mut warnings = Vec::new();
    for (n, Channel { input, .. }) in sound.bindings.iter() {
        let (why, hint) = match input.kind() {
            InputKind::Texture | InputKind::Cubemap => continue,
            InputKind::Volume => (
                "a volume, which is a sampler2D in a sound pass, as on Shadertoy; it reads black",
                format!("only iChannelResolution[{n}] tells of the volume; read an image file instead"),
            ),
            _ => (
                "something that a sound pass cannot read, as its samples are made before any frame; it reads black",
                "a sound pass reads image files and cubemap files, as on Shadertoy".to_owned(),
            ),
        };
        warnings.push(Diagnostic::warning(None, format!("iChannel{n} of Sound is {why}")).hint(hint));
    }
    warnings
}

/// The pass that an input reads, if the project does not have it.
pub fn missing_pass(project: &Project, input: &Input) -> Option<PassName> {
    let (id, _) = input.target()?;
    project.pass(id).is_none().then(|| id.clone())
}

/// Returns a warning for each channel that reads a missing pass. `place` returns the span that declares what a channel
/// of a pass reads, if a text declares it.
pub(super) fn unread(project: &Project, place: impl Fn(usize, usize) -> Option<Span>) -> Vec<Diagnostic> {
    let mut warnings = Vec::new();
    for (index, pass) in project.passes.iter().enumerate() {
        for (n, channel) in pass.bindings.iter() {
            let Some(missing) = missing_pass(project, &channel.input) else { continue };
            let near = near_buffer(project, &missing);
            let near = near.map(|near| format!("; did you mean Buffer {near}?")).unwrap_or_default();
            let reads = format!(
                "iChannel{n} of {} reads {}, but the project has no such pass",
                pass.id.title(),
                missing.title()
            );
            warnings.push(
                Diagnostic::warning(place(index, n), reads).hint(format!(
                    "it reads zero; add {} or choose another input for the channel{near}",
                    missing.title()
                )),
            );
        }
    }
    warnings
}

/// Returns the buffer that was probably meant.
fn near_buffer<'p>(project: &'p Project, missing: &PassName) -> Option<&'p str> {
    let buffers = project.passes.iter().filter_map(|p| p.id.buffer_name());
    // Names of one letter are all equally near to each other.
    missing.buffer_name().filter(|name| name.chars().count() > 1).and_then(|name| nearest(name, buffers))
}

/// Returns a warning where channels with their own samplers read one buffer differently, which Shadertoy cannot do:
/// there a buffer has one wrap mode, and one filter while a pass draws (`shadertoy.md`, section 7).
pub(super) fn shared_samplers(project: &Project) -> Vec<Diagnostic> {
    if project.sampler_rules == SamplerRules::Site {
        return Vec::new();
    }
    let mut warnings = Vec::new();
    let mut wraps: BTreeMap<&str, Vec<(String, Wrap)>> = BTreeMap::new();
    for pass in &project.passes {
        let mut filters: BTreeMap<&str, Vec<(String, Filter)>> = BTreeMap::new();
        for (index, channel) in pass.bindings.iter() {
            let Some((id, 0)) = channel.input.target() else { continue };
            let Some(buffer) = id.buffer_name() else { continue };
            let place = format!("iChannel{index} of {}", pass.id.title());
            filters.entry(buffer).or_default().push((place.clone(), channel.sampler.filter));
            wraps.entry(buffer).or_default().push((place, channel.sampler.wrap));
        }
        warnings
            .extend(filters.iter().filter_map(|(buffer, reads)| differ(buffer, reads, "filter", "while a pass draws")));
    }
    warnings.extend(wraps.iter().filter_map(|(buffer, reads)| differ(buffer, reads, "wrap", "for all passes")));
    warnings
}

fn differ<T: PartialEq + Debug>(buffer: &str, reads: &[(String, T)], what: &str, when: &str) -> Option<Diagnostic> {
    let (last, wins) = reads.last()?;
    let (other, loses) = reads.iter().find(|(_, setting)| setting != wins)?;
    let name = |setting: &T| format!("{setting:?}").to_lowercase();
    Some(
        Diagnostic::warning(
            None,
            format!(
                "{other} reads Buffer {buffer} with {what} {}, {last} with {}: on Shadertoy a buffer has one {what} \
                 {when}, the last one set, so the picture differs",
                name(loses),
                name(wins)
            ),
        )
        .hint(format!("give both the same {what}, or set sampler_rules = \"site\" in eddy.toml to match Shadertoy")),
    )
}
