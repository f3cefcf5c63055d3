//! The writer of a texel of a pass: its own programs, its boundary, or nothing.

use eddy_project::{PassSettings, Region};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Writer {
    /// The programs of the pass.
    Programs,
    /// The value of the boundary, which is drawn over their output.
    Boundary,
    /// Nothing: the texel is outside of this region.
    Nothing(Region),
}

impl Writer {
    /// Returns the writer of a texel of a target of a size. A pass whose region contains no texel is not drawn at all,
    /// and neither is its boundary.
    pub(super) fn of(settings: &PassSettings, size: (u32, u32), (x, y): (u32, u32)) -> Self {
        let region = settings.region.unwrap_or(whole(size));
        let Some(drawn) = region.within(size) else { return Writer::Nothing(region) };
        let edge = x.min(y).min(size.0 - 1 - x).min(size.1 - 1 - y);
        let is_inside = (drawn.x..drawn.x + drawn.width).contains(&x) && (drawn.y..drawn.y + drawn.height).contains(&y);
        match &settings.boundary {
            Some(boundary) if edge < boundary.width => Writer::Boundary,
            _ if is_inside => Writer::Programs,
            _ => Writer::Nothing(region),
        }
    }
}

/// Returns the texels of a target of a size that the programs of the pass write; `None` if there are none.
pub(crate) fn own_texels(settings: &PassSettings, size: (u32, u32)) -> Option<Region> {
    let drawn = settings.region.unwrap_or(whole(size)).within(size)?;
    let margin = settings.boundary.as_ref().map_or(0, |boundary| boundary.width);
    let between = |start: u32, count: u32, size: u32| {
        let (first, end) = (start.max(margin), (start + count).min(size.saturating_sub(margin)));
        (first < end).then(|| (first, end - first))
    };
    let (x, width) = between(drawn.x, drawn.width, size.0)?;
    let (y, height) = between(drawn.y, drawn.height, size.1)?;
    Some(Region { x, y, width, height })
}

fn whole((width, height): (u32, u32)) -> Region {
    Region { x: 0, y: 0, width, height }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::{Boundary, Fill};

    #[test]
    fn own_texels_are_written_by_the_programs() {
        let region = |x, y, width, height| Some(Region { x, y, width, height });
        for region in [None, region(2, 1, 3, 2), region(0, 0, 2, 9), region(6, 4, 1, 1), region(7, 0, 1, 1)] {
            for width in [0, 1, 2, 3, 9] {
                let boundary = (width > 0).then(|| Boundary { width, value: Fill::expression("vec4(0)") });
                let (settings, size) = (PassSettings { region, boundary, ..PassSettings::default() }, (7, 5));
                let own = own_texels(&settings, size);
                for (x, y) in (0..size.1).flat_map(|y| (0..size.0).map(move |x| (x, y))) {
                    let is_own =
                        own.is_some_and(|r| (r.x..r.x + r.width).contains(&x) && (r.y..r.y + r.height).contains(&y));
                    let writer = Writer::of(&settings, size, (x, y));
                    assert_eq!(writer == Writer::Programs, is_own, "{region:?} {width}: {x} {y}, {writer:?}");
                }
            }
        }
        // A region outside the target: neither the pass nor its boundary is drawn.
        let settings = PassSettings {
            region: region(7, 0, 1, 1),
            boundary: Some(Boundary { width: 1, value: Fill::expression("vec4(0)") }),
            ..PassSettings::default()
        };
        assert!(matches!(Writer::of(&settings, (7, 5), (0, 0)), Writer::Nothing(_)));
    }
}
