//! Conjugate gradients as passes of a project: the chain of sums of a dot product, and a V-cycle as the preconditioner
//! (Saad, Iterative Methods for Sparse Linear Systems, algorithms 6.18 and 9.1; Tatebe 1993).

use super::cycle::{self, Component, Cycle};
use eddy_project::{PassName, PassSize, Project, TexelFormat};

const SUMS: &str = include_str!("../../../assets/lab/poisson_cg/sums.glsl");

/// The texels along each side of a block that a pass sums up.
const BLOCK: u32 = 4;

/// Inserts sums over blocks of 4 x 4 between `dots`, which has a quarter of the `n` texels per side, and the `totals`
/// in one texel.
///
/// # Panics
/// If the project is not that of `poisson_cg`.
pub(super) fn chain(project: &mut Project, n: u32) {
    let (mut side, mut last, mut names, mut passes) = (n / BLOCK, "dots".to_owned(), Vec::new(), Vec::new());
    while side > BLOCK {
        side /= BLOCK;
        let name = format!("sums{side}");
        let mut sums = cycle::pass(&name, SUMS, PassSize::Fixed(side, side), &[&last]);
        sums.settings.format = TexelFormat::Rgba32f;
        names.push(sums.id.clone());
        passes.push(sums);
        last = name;
    }
    cycle::insert(project, passes, "totals").bindings = cycle::channels(&[&last]);
    for group in &mut project.groups {
        let place = group.passes.iter().position(|id| *id == PassName::buffer("totals"));
        if let Some(place) = place {
            group.passes.splice(place..place, names.iter().cloned());
        }
    }
}

/// Does the same as [`chain`], with a symmetric V-cycle of the residual as the preconditioner. A frame is an iteration.
///
/// # Panics
/// If the project is not that of `poisson_cg`.
pub(super) fn preconditioned(project: &mut Project, n: u32) {
    chain(project, n);
    project.groups.clear();
    let end = cycle::pass("cycled", "", PassSize::Canvas, &[]);
    cycle::insert(project, vec![end], "dots");
    Cycle::Symmetric.add(project, n, None, Component { pass: "field", component: 'y' }, "cycled");
    for (name, channel) in [("dots", 1), ("field", 2)] {
        if let Some(pass) = project.pass_mut(&PassName::buffer(name)) {
            pass.bindings.set(channel, cycle::channels(&["cycled"]).get(0).cloned());
        }
    }
}
