//! Keeps groups valid while passes are edited: the passes of a group are consecutive, and no group is empty.

use super::edit::PassEditError;
use crate::{Group, PassName, Project};

/// Sets the number of draws of a buffer per frame, together with the others of its group.
pub(super) fn set_steps(project: &mut Project, id: &PassName, steps: u32) -> Result<(), PassEditError> {
    if steps == 0 {
        return Err(PassEditError::NoSteps);
    }
    match of(project, id) {
        // A group of one pass and one step has no effect.
        Some(at) if steps == 1 && project.groups[at].passes.len() == 1 => drop(project.groups.remove(at)),
        Some(at) => project.groups[at].steps = steps,
        None if steps == 1 => {}
        None => {
            let name = free_name(project, id);
            project.groups.push(Group { name, passes: vec![id.clone()], steps });
        }
    }
    Ok(())
}

/// Merges the group of a buffer into that of the previous buffer, or splits the two.
pub(super) fn join(project: &mut Project, id: &PassName, is_joined: bool) -> Result<(), PassEditError> {
    let before = place(project, id).and_then(|at| project.passes.get(at.checked_sub(1)?)).map(|p| p.id.clone());
    let Some(before) = before else { return Err(PassEditError::First(id.title())) };
    let (above, own) = (of(project, &before), of(project, id));
    match (is_joined, above, own) {
        (true, Some(above), Some(own)) if above == own => {}
        (true, Some(above), Some(own)) => {
            let Group { passes, steps, .. } = project.groups[own].clone();
            let group = &mut project.groups[above];
            group.passes.extend(passes);
            group.steps = group.steps.max(steps);
            project.groups.remove(own);
        }
        (true, Some(above), None) => project.groups[above].passes.push(id.clone()),
        (true, None, Some(own)) => project.groups[own].passes.insert(0, before),
        (true, None, None) => {
            let name = free_name(project, &before);
            project.groups.push(Group { name, passes: vec![before, id.clone()], steps: 1 });
        }
        (false, Some(above), Some(own)) if above == own => {
            let group = &mut project.groups[own];
            let at = group.passes.iter().position(|p| p == id).unwrap_or(group.passes.len());
            let (passes, steps) = (group.passes.split_off(at), group.steps);
            let name = free_name(project, id);
            project.groups.insert(own + 1, Group { name, passes, steps });
            project.groups.retain(|g| g.steps > 1 || g.passes.len() > 1);
        }
        (false, ..) => {}
    }
    Ok(())
}

/// Updates groups after a buffer was moved: between two passes of a group it joins that group, and away from its own
/// group it leaves it.
pub(super) fn settle_moved(project: &mut Project, id: &PassName) {
    let Some(at) = place(project, id) else { return };
    let neighbour = |at: Option<usize>| of(project, &project.passes.get(at?)?.id);
    let (before, after) = (neighbour(at.checked_sub(1)), neighbour(Some(at + 1)));
    let own = of(project, id);
    let is_alone = own.is_some_and(|own| project.groups[own].passes.len() == 1);
    let wanted = match (before, after) {
        (Some(a), Some(b)) if a == b => Some(a),
        _ if is_alone || own.is_some() && (before == own || after == own) => own,
        _ => None,
    };
    if wanted != own {
        if let Some(wanted) = wanted {
            project.groups[wanted].passes.push(id.clone());
        }
        if let Some(own) = own {
            project.groups[own].passes.retain(|p| p != id);
        }
    }
    let order: Vec<PassName> = project.passes.iter().map(|p| p.id.clone()).collect();
    for group in &mut project.groups {
        group.passes.sort_by_key(|id| order.iter().position(|o| o == id));
    }
    project.groups.retain(|g| !g.passes.is_empty());
}

/// Removes a deleted pass from its group.
pub(super) fn forget(project: &mut Project, id: &PassName) {
    project.groups.iter_mut().for_each(|g| g.passes.retain(|p| p != id));
    project.groups.retain(|g| !g.passes.is_empty());
}

/// The index of a pass's group.
fn of(project: &Project, id: &PassName) -> Option<usize> {
    project.groups.iter().position(|g| g.passes.contains(id))
}

fn place(project: &Project, id: &PassName) -> Option<usize> {
    project.passes.iter().position(|p| p.id == *id)
}

/// A name for a new group, after its first pass.
fn free_name(project: &Project, id: &PassName) -> String {
    let stem = id.buffer_name().unwrap_or(id.key()).to_lowercase();
    let is_free = |name: &String| project.groups.iter().all(|g| g.name != *name);
    let numbered = (2..).map(|n| format!("{stem} {n}"));
    std::iter::once(stem.clone()).chain(numbered).find(is_free).unwrap_or(stem)
}
