//! A frame draws so many times in all, which has a limit.

use super::{Group, Pass};

/// The passes and meshes that are drawn for one frame: those of a group count as often as the group has steps.
pub(super) fn draws(passes: &[Pass], groups: &[Group]) -> u64 {
    let draws = |pass: &Pass| {
        let steps = groups.iter().find(|g| g.passes.contains(&pass.id)).map_or(1, |g| u64::from(g.steps));
        let meshes = pass.settings.meshes().map_or(1, |g| g.draws.len().max(1) as u64);
        meshes.saturating_mul(steps)
    };
    passes.iter().map(draws).fold(0, u64::saturating_add)
}
