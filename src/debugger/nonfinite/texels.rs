//! Texels that are not finite, and the operation that produces one.

use crate::{
    audit::{self, Class, Finding},
    trace::TraceError,
};
use eddy_engine::{PassInputs, Pixels, Sources};
use eddy_project::{PassName, Project};

/// Texels of a picture with a stored component that is NaN or infinite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NonfiniteTexels {
    /// The first of them, from the bottom left, row by row.
    pub first: (u32, u32),
    pub count: usize,
}

impl NonfiniteTexels {
    /// Returns `None` if every texel is finite.
    pub fn find(pixels: &Pixels, stored: usize) -> Option<Self> {
        let is_nonfinite = |texel: &&[f32; 4]| texel[..stored.min(4)].iter().any(|x| !x.is_finite());
        let at = pixels.texels.iter().position(|texel| is_nonfinite(&texel))? as u32;
        let count = pixels.texels[at as usize..].iter().filter(is_nonfinite).count();
        Some(Self { first: (at % pixels.width, at / pixels.width), count })
    }
}

/// Returns the passes that draw pictures, in drawing order.
pub fn drawn_passes(project: &Project) -> Vec<PassName> {
    let mut passes: Vec<PassName> = project.passes.iter().map(|pass| pass.id.clone()).collect();
    passes.retain(PassName::is_picture);
    // All buffers are equal there: they keep the order of the project.
    passes.sort_by(PassName::drawing_order);
    passes
}

/// Returns the number of components that a pass stores.
pub fn stored_components(project: &Project, pass: &PassName) -> usize {
    project.pass(pass).and_then(|p| p.formats().first().copied()).unwrap_or_default().components()
}

/// Walks a pass for a texel of its first target. Returns `None` if no operation produces the value: it is too large for
/// the pass's format, or was read from a texture, or comes from a vertex stage.
pub fn find_origin(
    project: &Project,
    pass: &PassName,
    read: &PassInputs,
    texel: (u32, u32),
    limit: u64,
) -> Result<Option<Finding>, TraceError> {
    let Some(index) = project.passes.iter().position(|p| p.id == *pass) else { return Ok(None) };
    let audit = audit::audit_pixel(&Sources::new(project), index, read, texel, limit)?;
    Ok(audit.findings.into_iter().find(|finding| finding.kind.class() == Class::Nonfinite))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unstored_components_are_ignored() {
        let (nan, inf) = (f32::NAN, f32::INFINITY);
        let texels = vec![[0.0, nan, 0.0, 1.0], [1.0; 4], [inf, 0.0, 0.0, 1.0], [nan, 0.0, 0.0, 1.0]];
        let pixels = Pixels { width: 2, height: 2, texels };
        assert_eq!(NonfiniteTexels::find(&pixels, 1), Some(NonfiniteTexels { first: (0, 1), count: 2 }));
        assert_eq!(NonfiniteTexels::find(&pixels, 2), Some(NonfiniteTexels { first: (0, 0), count: 3 }));
        let fine = Pixels { width: 1, height: 1, texels: vec![[0.5, nan, nan, nan]] };
        assert_eq!(NonfiniteTexels::find(&fine, 1), None);
    }
}
