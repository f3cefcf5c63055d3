//! The structure of a project is everything except texts: passes, channels, settings, names. It is compared without
//! copying, as the window does so in each frame.

use eddy_project::{Body, Geometry, Pass, Project, listed};
use std::collections::BTreeSet;

/// Returns whether two projects differ at most in their texts and their places on disk.
pub(super) fn is_same(a: &Project, b: &Project) -> bool {
    // Destructured completely, here and below: a new field must be handled here or the code does not compile.
    let Project {
        name,
        info,
        dialect,
        common,
        passes,
        sampler_rules,
        groups,
        custom_uniform_values,
        controls,
        includes: _,
        origin: _,
    } = a;
    *name == b.name
        && *info == b.info
        && *dialect == b.dialect
        && common.is_some() == b.common.is_some()
        && is_each(passes, &b.passes, is_same_pass)
        && *sampler_rules == b.sampler_rules
        && *groups == b.groups
        && *custom_uniform_values == b.custom_uniform_values
        && *controls == b.controls
}

/// Returns the differences except texts, in words that follow "Unsaved changes: ".
pub(super) fn differences(now: &Project, saved: &Project) -> Vec<String> {
    let mut found = Vec::new();
    let mut say = |differs: bool, what: &str| {
        if differs {
            found.push(what.to_owned());
        }
    };
    say(now.name != saved.name, "the project's name");
    say(now.info != saved.info, "the project's description");
    say(now.dialect != saved.dialect, "the dialect");
    let ids = |p: &Project| p.passes.iter().map(|pass| pass.id.clone()).collect::<Vec<_>>();
    let is_common_same = now.common.is_some() == saved.common.is_some();
    say(ids(now) != ids(saved) || !is_common_same, "the list of passes");
    say(now.groups != saved.groups, "steps of passes");
    say(now.sampler_rules != saved.sampler_rules, "sampler rules");
    for pass in &now.passes {
        let Some(before) = saved.pass(&pass.id) else { continue };
        say(pass.bindings != before.bindings, &format!("channels of {}", pass.id.title()));
        let is_drawn_the_same = pass.settings == before.settings && is_same_body(&pass.body, &before.body);
        say(!is_drawn_the_same, &format!("settings of {}", pass.id.title()));
    }
    say(now.controls != saved.controls, "controls of uniforms");
    let (values, before) = (&now.custom_uniform_values, &saved.custom_uniform_values);
    let names: BTreeSet<&String> = values.keys().chain(before.keys()).collect();
    let turned: Vec<String> =
        names.into_iter().filter(|name| values.get(*name) != before.get(*name)).cloned().collect();
    match &turned[..] {
        [] => {}
        names if names.len() <= 3 => found.push(format!("uniform {}", listed(names))),
        names => found.push(format!("{} uniforms", names.len())),
    }
    found
}

/// Returns whether two projects of the same structure have the same texts.
pub(super) fn has_same_texts(a: &Project, b: &Project) -> bool {
    a.tab_sources().map(|s| &s.text).eq(b.tab_sources().map(|s| &s.text))
}

fn is_same_pass(a: &Pass, b: &Pass) -> bool {
    let Pass { id, source: _, bindings, settings, body } = a;
    *id == b.id && *bindings == b.bindings && *settings == b.settings && is_same_body(body, &b.body)
}

fn is_same_body(a: &Body, b: &Body) -> bool {
    match (a, b) {
        (Body::Screen, Body::Screen) => true,
        (Body::Meshes(a), Body::Meshes(b)) => is_same_geometry(a, b),
        (Body::Screen | Body::Meshes(_), _) => false,
    }
}

fn is_same_geometry(a: &Geometry, b: &Geometry) -> bool {
    let Geometry { draws, more_targets, camera, stages } = a;
    // The file that a draw names belongs to the structure.
    *draws == b.draws
        && *more_targets == b.more_targets
        && *camera == b.camera
        && is_each(stages, &b.stages, |a, b| a.name == b.name)
}

fn is_each<T>(a: &[T], b: &[T], is_same: impl Fn(&T, &T) -> bool) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_same(a, b))
}
