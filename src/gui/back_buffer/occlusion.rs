//! Skips what a picture covers: nothing is painted below it.

use crate::gui::damage::Area;
use egui::{
    ClippedPrimitive, Color32, Rect, TextureId,
    epaint::{Mesh, Primitive},
};

/// A part of an area, and the first of all triangles that are visible in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Part {
    pub area: Area,
    pub first: usize,
}

/// Splits an area at the edges of the last picture over it. Textures that egui does not own are pictures, and these
/// are opaque.
pub(super) fn parts(triangles: &[ClippedPrimitive], area: Area, scale: f32) -> Vec<Part> {
    let cover = triangles.iter().enumerate().rev().find_map(|(index, ClippedPrimitive { clip_rect, primitive })| {
        let Primitive::Mesh(mesh) = primitive else { return None };
        let cover = common(area, inside(quad(mesh)?.intersect(*clip_rect), scale)?)?;
        Some(Part { area: cover, first: index })
    });
    let Some(cover) = cover else { return vec![Part { area, first: 0 }] };
    let Area { x, y, width, height } = cover.area;
    let (right, bottom) = (x + width, y + height);
    let around = [
        Area { height: y - area.y, ..area },
        Area { y: bottom, height: area.y + area.height - bottom, ..area },
        Area { y, height, width: x - area.x, ..area },
        Area { x: right, y, height, width: area.x + area.width - right },
    ];
    let around = around.into_iter().filter(|area| area.width > 0 && area.height > 0);
    around.map(|area| Part { area, first: 0 }).chain([cover]).collect()
}

/// Returns the place of a picture that is drawn upright and without tint; `None` for any other mesh.
fn quad(mesh: &Mesh) -> Option<Rect> {
    let is_picture = matches!(mesh.texture_id, TextureId::User(_));
    let is_whole = mesh.vertices.len() == 4 && mesh.indices.len() == 6;
    if !is_picture || !is_whole || mesh.vertices.iter().any(|corner| corner.color != Color32::WHITE) {
        return None;
    }
    let bounds = Rect::from_points(&[mesh.vertices[0].pos, mesh.vertices[3].pos]);
    let is_upright = mesh.vertices.iter().all(|corner| {
        let (x, y) = (corner.pos.x, corner.pos.y);
        (x == bounds.min.x || x == bounds.max.x) && (y == bounds.min.y || y == bounds.max.y)
    });
    is_upright.then_some(bounds)
}

/// Returns the pixels entirely inside a rectangle; `None` if there are none. The tolerance of a hundredth of a pixel
/// is for the rounding of points.
fn inside(rect: Rect, scale: f32) -> Option<Area> {
    let first = |at: f32| (at * scale - 0.01).ceil().max(0.0);
    let last = |at: f32| (at * scale + 0.01).floor();
    let (x, y) = (first(rect.min.x), first(rect.min.y));
    let (width, height) = (last(rect.max.x) - x, last(rect.max.y) - y);
    // NaN makes both comparisons false.
    let has_inside = width >= 1.0 && height >= 1.0;
    has_inside.then_some(Area { x: x as u32, y: y as u32, width: width as u32, height: height as u32 })
}

fn common(a: Area, b: Area) -> Option<Area> {
    let (x, y) = (a.x.max(b.x), a.y.max(b.y));
    let width = a.x.saturating_add(a.width).min(b.x.saturating_add(b.width)).checked_sub(x)?;
    let height = a.y.saturating_add(a.height).min(b.y.saturating_add(b.height)).checked_sub(y)?;
    (width > 0 && height > 0).then_some(Area { x, y, width, height })
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{pos2, vec2};

    const AREA: Area = Area { x: 64, y: 32, width: 320, height: 192 };

    fn picture(at: [f32; 4], tint: Color32) -> ClippedPrimitive {
        let mut mesh = Mesh::with_texture(TextureId::User(3));
        let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        mesh.add_rect_with_uv(Rect::from_min_size(pos2(at[0], at[1]), vec2(at[2], at[3])), uv, tint);
        ClippedPrimitive { clip_rect: Rect::EVERYTHING, primitive: Primitive::Mesh(mesh) }
    }

    fn panel() -> ClippedPrimitive {
        let mut mesh = Mesh::default();
        mesh.add_colored_rect(Rect::from_min_size(pos2(0.0, 0.0), vec2(900.0, 600.0)), Color32::RED);
        ClippedPrimitive { clip_rect: Rect::EVERYTHING, primitive: Primitive::Mesh(mesh) }
    }

    #[test]
    fn a_picture_hides_only_what_is_below_it() {
        let triangles = [panel(), picture([70.0, 40.0, 300.0, 170.0], Color32::WHITE), panel()];
        let parts = parts(&triangles, AREA, 1.0);
        let cover = Part { area: Area { x: 70, y: 40, width: 300, height: 170 }, first: 1 };
        assert_eq!(parts.last(), Some(&cover));
        // Every pixel of the area is in exactly one part.
        let mut seen = vec![0; 400 * 300];
        for Part { area, .. } in &parts {
            for y in area.y..area.y + area.height {
                (area.x..area.x + area.width).for_each(|x| seen[(y * 400 + x) as usize] += 1);
            }
        }
        let is_in = |x: u32, y: u32| (64..384).contains(&x) && (32..224).contains(&y);
        assert!((0..300).all(|y| (0..400).all(|x| seen[(y * 400 + x) as usize] == i32::from(is_in(x, y)))));
        assert!(parts[..parts.len() - 1].iter().all(|part| part.first == 0));
    }

    #[test]
    fn transparent_shapes_hide_nothing() {
        let whole = [Part { area: AREA, first: 0 }];
        let tinted = picture([0.0, 0.0, 900.0, 600.0], Color32::from_white_alpha(200));
        let elsewhere = picture([500.0, 0.0, 100.0, 100.0], Color32::WHITE);
        let wild = picture([f32::NAN, 0.0, f32::INFINITY, 10.0], Color32::WHITE);
        for triangles in [vec![panel()], vec![panel(), tinted], vec![panel(), elsewhere], vec![wild]] {
            assert_eq!(parts(&triangles, AREA, 1.0), whole);
        }
    }

    #[test]
    fn partly_covered_pixels_are_not_hidden() {
        let triangles = [picture([0.5, 0.5, 900.0, 600.0], Color32::WHITE)];
        let area = Area { x: 0, y: 0, width: 64, height: 64 };
        let cover = Area { x: 1, y: 1, width: 63, height: 63 };
        assert_eq!(parts(&triangles, area, 1.0).last(), Some(&Part { area: cover, first: 0 }));
        // Points at a scale of 1.25 convert back to their pixels.
        let triangles = [picture([8.0 / 1.25, 16.0 / 1.25, 48.0 / 1.25, 40.0 / 1.25], Color32::WHITE)];
        let cover = Area { x: 8, y: 16, width: 48, height: 40 };
        assert_eq!(parts(&triangles, area, 1.25).last(), Some(&Part { area: cover, first: 0 }));
    }
}
