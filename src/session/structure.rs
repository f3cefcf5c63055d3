//! The structure of a project is all that is not text: passes, channels, settings, names. It is compared without a
//! copy, as the window asks in each frame.

use crate::project::{Geometry, Pass, PassBody, PassSettings, Project};

/// Returns whether two projects are the same but for their texts and their places on disk.
pub(super) fn is_same(a: &Project, b: &Project) -> bool {
    // Taken apart whole, here and below: a member that is added finds its place here or does not compile.
    let Project { name, info, common, passes, sampler_rules, groups, custom_uniform_values, includes: _, origin: _ } =
        a;
    *name == b.name
        && *info == b.info
        && common.is_some() == b.common.is_some()
        && is_each(passes, &b.passes, is_same_pass)
        && *sampler_rules == b.sampler_rules
        && *groups == b.groups
        && *custom_uniform_values == b.custom_uniform_values
}

/// Returns what two projects differ in besides their texts, in a person's words; nothing where [`is_same`] holds.
pub(super) fn differing(a: &Project, b: &Project) -> Vec<&'static str> {
    let Project { name, info, common, passes, sampler_rules, groups, custom_uniform_values, includes: _, origin: _ } =
        a;
    let has_passes = common.is_some() == b.common.is_some() && is_each(passes, &b.passes, |a, b| a.id == b.id);
    let of_each = |is_same: fn(&Pass, &Pass) -> bool| {
        passes.iter().all(|pass| b.pass(&pass.id).is_none_or(|other| is_same(pass, other)))
    };
    let has_settings = of_each(|a, b| is_same_setting(&a.settings, &b.settings)) && *groups == b.groups;
    let has_channels = of_each(|a, b| a.channels == b.channels) && *sampler_rules == b.sampler_rules;
    let parts = [
        (*name == b.name && *info == b.info, "name and description"),
        (has_passes, "which passes there are"),
        (has_channels, "channels"),
        (has_settings, "settings of passes"),
        (*custom_uniform_values == b.custom_uniform_values, "sliders"),
    ];
    parts.into_iter().filter(|(is_same, _)| !is_same).map(|(_, part)| part).collect()
}

/// Returns whether two projects of one structure have the same texts.
pub(super) fn has_same_texts(a: &Project, b: &Project) -> bool {
    a.tab_sources().map(|s| &s.text).eq(b.tab_sources().map(|s| &s.text))
}

fn is_same_pass(a: &Pass, b: &Pass) -> bool {
    let Pass { id, source: _, channels, settings } = a;
    *id == b.id && *channels == b.channels && is_same_setting(settings, &b.settings)
}

fn is_same_setting(a: &PassSettings, b: &PassSettings) -> bool {
    let PassSettings { size, format, region, initial, boundary, body } = a;
    *size == b.size
        && *format == b.format
        && *region == b.region
        && *initial == b.initial
        && *boundary == b.boundary
        && is_same_body(body, &b.body)
}

fn is_same_body(a: &PassBody, b: &PassBody) -> bool {
    match (a, b) {
        (PassBody::Screen, PassBody::Screen) => true,
        (PassBody::Meshes(a), PassBody::Meshes(b)) => is_same_geometry(a, b),
        (PassBody::Screen | PassBody::Meshes(_), _) => false,
    }
}

fn is_same_geometry(a: &Geometry, b: &Geometry) -> bool {
    let Geometry { draws, more_targets, camera, stages } = a;
    // Which file a draw names is structure.
    *draws == b.draws
        && *more_targets == b.more_targets
        && *camera == b.camera
        && is_each(stages, &b.stages, |a, b| a.name == b.name)
}

fn is_each<T>(a: &[T], b: &[T], is_same: impl Fn(&T, &T) -> bool) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_same(a, b))
}
