//! The parts of the window that have changed since it was last painted.
//!
//! Owns a signature of each tile of the window: a hash of all triangles that touch the tile, in order, with the
//! versions of their textures. A tile with the same signature as in the last painting has the same pixels (the scheme
//! is Rendering Elimination of Anglada et al., HPCA 2019). Knows nothing of devices.

use egui::{
    ClippedPrimitive, Rect, TextureId,
    epaint::{Mesh, Primitive, Vertex},
    pos2, vec2,
};
use foldhash::fast::FixedState;
use std::{
    collections::HashMap,
    hash::{BuildHasher, Hash, Hasher},
};

/// The width and height of a tile in physical pixels.
const TILE: u32 = 32;

/// The maximum number of painted rectangles: each costs another pass over the triangles in it.
const AREAS: usize = 16;

/// The maximum number of rectangles that are merged by distance, which takes cubic time.
const MAX_AREAS: usize = 64;

/// A rectangle of the window to repaint, in physical pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Area {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

impl Area {
    pub(super) fn in_points(self, scale: f32) -> Rect {
        let corner = pos2(self.x as f32, self.y as f32) / scale;
        Rect::from_min_size(corner, vec2(self.width as f32, self.height as f32) / scale)
    }
}

/// The version of each changed texture, which is incremented by each change of its texels.
pub(super) type Versions = HashMap<TextureId, u64>;

/// Finds what a painting changes.
#[derive(Clone, Default)]
pub(super) struct Damage {
    size: [u32; 2],
    scale: f32,
    /// One for each tile, row by row; empty before the first painting.
    signatures: Vec<u64>,
}

impl Damage {
    /// Processes the next painting of a window of `size` physical pixels, with `scale` pixels per point. Returns the
    /// areas that differ from the previous painting.
    pub(super) fn of(
        &mut self,
        triangles: &[ClippedPrimitive],
        size: [u32; 2],
        scale: f32,
        versions: &Versions,
    ) -> Vec<Area> {
        let tiles = Tiles::new(size, scale);
        let mut signatures = vec![0; tiles.count()];
        let state = FixedState::default();
        for ClippedPrimitive { clip_rect, primitive } in triangles {
            match primitive {
                Primitive::Mesh(mesh) => {
                    let mut hasher = state.build_hasher();
                    (clip_rect.min.x.to_bits(), clip_rect.min.y.to_bits()).hash(&mut hasher);
                    (clip_rect.max.x.to_bits(), clip_rect.max.y.to_bits()).hash(&mut hasher);
                    (mesh.texture_id, versions.get(&mesh.texture_id)).hash(&mut hasher);
                    tiles.sign(mesh, *clip_rect, hasher.finish(), &mut signatures);
                }
                // What it draws is unknown.
                Primitive::Callback(_) => return self.whole(size),
            }
        }
        if (self.size, self.scale, self.signatures.len()) != (size, scale, signatures.len()) {
            (self.size, self.scale, self.signatures) = (size, scale, signatures);
            return vec![Area { x: 0, y: 0, width: size[0], height: size[1] }];
        }
        let differs: Vec<bool> = signatures.iter().zip(&self.signatures).map(|(new, old)| new != old).collect();
        self.signatures = signatures;
        tiles.areas(differs)
    }

    /// Forgets the last painting, so that the next one changes everything.
    fn whole(&mut self, size: [u32; 2]) -> Vec<Area> {
        self.signatures.clear();
        vec![Area { x: 0, y: 0, width: size[0], height: size[1] }]
    }
}

/// A window cut into tiles.
struct Tiles {
    size: [u32; 2],
    scale: f32,
    columns: usize,
    rows: usize,
}

/// A range of tiles, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Span {
    columns: [usize; 2],
    rows: [usize; 2],
}

impl Span {
    fn one(column: usize, row: usize) -> Self {
        Self { columns: [column; 2], rows: [row; 2] }
    }

    fn with(self, other: Self) -> Self {
        let union = |a: [usize; 2], b: [usize; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        Self { columns: union(self.columns, other.columns), rows: union(self.rows, other.rows) }
    }

    fn tiles(self) -> usize {
        (self.columns[1] - self.columns[0] + 1) * (self.rows[1] - self.rows[0] + 1)
    }

    fn overlaps(self, other: Self) -> bool {
        let meet = |a: [usize; 2], b: [usize; 2]| a[0] <= b[1] && b[0] <= a[1];
        meet(self.columns, other.columns) && meet(self.rows, other.rows)
    }
}

/// Merges the two rectangles whose union adds the fewest tiles.
fn join_nearest(spans: &mut Vec<Span>) {
    let pairs = (0..spans.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    let gain = |&(a, b): &(usize, usize)| {
        let (a, b) = (spans[a], spans[b]);
        // Shared tiles are counted twice, which only makes the two nearer.
        a.with(b).tiles() as i64 - a.tiles() as i64 - b.tiles() as i64
    };
    let Some((a, b)) = pairs.min_by_key(gain) else { return };
    let joined = spans[a].with(spans[b]);
    spans.swap_remove(a);
    spans[b] = joined;
}

impl Tiles {
    fn new(size: [u32; 2], scale: f32) -> Self {
        let [columns, rows] = size.map(|pixels| pixels.div_ceil(TILE) as usize);
        Self { size, scale, columns, rows }
    }

    fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Adds each triangle of a mesh to the signatures of the tiles that it touches.
    fn sign(&self, mesh: &Mesh, clip: Rect, seed: u64, signatures: &mut [u64]) {
        let state = FixedState::with_seed(seed);
        for triangle in mesh.indices.chunks_exact(3) {
            let corners: [Vertex; 3] = std::array::from_fn(|i| mesh.vertices[triangle[i] as usize]);
            let bounds = Rect::from_points(&corners.map(|corner| corner.pos)).intersect(clip);
            let Some(span) = self.span(bounds) else { continue };
            let hash = state.hash_one(bytemuck::bytes_of(&corners));
            for row in span.rows[0]..=span.rows[1] {
                for signature in &mut signatures[row * self.columns..][span.columns[0]..=span.columns[1]] {
                    *signature = state.hash_one((*signature, hash));
                }
            }
        }
    }

    /// Returns the tiles that a rectangle touches, given in points; `None` if it is empty.
    fn span(&self, bounds: Rect) -> Option<Span> {
        // A clip rectangle is rounded to pixels before it clips, which can let one more pixel through.
        let first = |at: f32| ((at * self.scale - 1.0).max(0.0) / TILE as f32) as usize;
        let last = |at: f32| ((at * self.scale + 1.0).max(0.0) / TILE as f32) as usize;
        let columns = [first(bounds.min.x), last(bounds.max.x).min(self.columns.saturating_sub(1))];
        let rows = [first(bounds.min.y), last(bounds.max.y).min(self.rows.saturating_sub(1))];
        // NaN makes every comparison false.
        let has_inside = bounds.min.x <= bounds.max.x && bounds.min.y <= bounds.max.y;
        (has_inside && columns[0] <= columns[1] && rows[0] <= rows[1]).then_some(Span { columns, rows })
    }

    /// Returns rectangles around the tiles that differ: one for each connected component, with overlapping ones
    /// merged.
    fn areas(&self, mut differs: Vec<bool>) -> Vec<Area> {
        let mut spans: Vec<Span> = Vec::new();
        for tile in 0..differs.len() {
            if differs[tile] {
                let mut span = self.component(tile, &mut differs);
                while let Some(other) = spans.iter().position(|other| other.overlaps(span)) {
                    span = span.with(spans.swap_remove(other));
                }
                spans.push(span);
            }
        }
        if spans.len() > MAX_AREAS {
            spans = spans.into_iter().reduce(Span::with).into_iter().collect();
        }
        while spans.len() > AREAS {
            join_nearest(&mut spans);
        }
        spans.into_iter().map(|span| self.area(span)).collect()
    }

    /// Returns the bounds of the connected component of a tile that differs, diagonals included, and clears its tiles.
    fn component(&self, tile: usize, differs: &mut [bool]) -> Span {
        let mut span = Span::one(tile % self.columns, tile / self.columns);
        let mut open = vec![tile];
        differs[tile] = false;
        while let Some(tile) = open.pop() {
            let (column, row) = (tile % self.columns, tile / self.columns);
            span = span.with(Span::one(column, row));
            for row in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
                for column in column.saturating_sub(1)..=(column + 1).min(self.columns - 1) {
                    let next = row * self.columns + column;
                    if std::mem::take(&mut differs[next]) {
                        open.push(next);
                    }
                }
            }
        }
        span
    }

    fn area(&self, span: Span) -> Area {
        let pixels = |[first, last]: [usize; 2], size: u32| {
            let (from, to) = (first as u32 * TILE, ((last as u32 + 1) * TILE).min(size));
            (from, to - from)
        };
        let (x, width) = pixels(span.columns, self.size[0]);
        let (y, height) = pixels(span.rows, self.size[1]);
        Area { x, y, width, height }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::Color32;

    const SIZE: [u32; 2] = [640, 360];
    const WHOLE: Area = Area { x: 0, y: 0, width: 640, height: 360 };

    fn rect(x: f32, y: f32, color: Color32) -> ClippedPrimitive {
        let mut mesh = Mesh::default();
        mesh.add_colored_rect(Rect::from_min_size(pos2(x, y), vec2(20.0, 10.0)), color);
        ClippedPrimitive { clip_rect: Rect::EVERYTHING, primitive: Primitive::Mesh(mesh) }
    }

    fn damage_of(damage: &mut Damage, triangles: &[ClippedPrimitive]) -> Vec<Area> {
        damage.of(triangles, SIZE, 1.0, &Versions::new())
    }

    #[test]
    fn a_moved_shape_repaints_its_old_and_new_place() {
        let mut damage = Damage::default();
        let still = rect(300.0, 200.0, Color32::RED);
        assert_eq!(damage_of(&mut damage, &[rect(40.0, 40.0, Color32::BLUE), still.clone()]), [WHOLE]);
        assert_eq!(damage_of(&mut damage, &[rect(40.0, 40.0, Color32::BLUE), still.clone()]), []);
        let areas = damage_of(&mut damage, &[rect(500.0, 40.0, Color32::BLUE), still.clone()]);
        let at = |x: u32, width: u32| Area { x, y: 32, width, height: 32 };
        assert_eq!(areas, [at(32, 32), at(480, 64)]);
        // A removed shape leaves a hole.
        assert_eq!(damage_of(&mut damage, &[still]), [at(480, 64)]);
    }

    #[test]
    fn changes_of_order_colour_clip_and_texels_are_detected() {
        let (red, blue) = (rect(40.0, 40.0, Color32::RED), rect(50.0, 40.0, Color32::BLUE));
        let around = [Area { x: 32, y: 32, width: 64, height: 32 }];
        let mut damage = Damage::default();
        damage_of(&mut damage, &[red.clone(), blue.clone()]);
        assert_ne!(damage_of(&mut damage, &[blue.clone(), red.clone()]), []);
        assert_ne!(damage_of(&mut damage, &[blue.clone(), rect(40.0, 40.0, Color32::GREEN)]), []);
        let clip_rect = Rect::from_min_max(pos2(0.0, 0.0), pos2(45.0, 45.0));
        damage_of(&mut damage, &[red.clone(), blue.clone()]);
        assert_ne!(damage_of(&mut damage, &[ClippedPrimitive { clip_rect, ..red.clone() }, blue.clone()]), []);
        damage_of(&mut damage, &[red.clone(), blue.clone()]);
        assert_eq!(damage.of(&[red, blue], SIZE, 1.0, &Versions::from([(TextureId::default(), 1)])), around);
    }

    #[test]
    fn a_new_size_or_scale_repaints_everything() {
        let mut damage = Damage::default();
        damage_of(&mut damage, &[]);
        let small = Area { x: 0, y: 0, width: 333, height: 187 };
        assert_eq!(damage.of(&[], [333, 187], 1.0, &Versions::new()), [small]);
        assert_eq!(damage.of(&[], [333, 187], 2.0, &Versions::new()), [small]);
        assert_eq!(damage.of(&[], [333, 187], 2.0, &Versions::new()), []);
    }

    #[test]
    fn nan_and_distant_corners_do_not_panic() {
        let mut damage = Damage::default();
        let wild = [f32::NAN, f32::INFINITY, -1e30, 1e30].map(|x| rect(x, 40.0, Color32::RED));
        damage_of(&mut damage, &wild);
        assert_eq!(damage_of(&mut damage, &wild), []);
    }

    #[test]
    fn nearby_areas_are_merged() {
        let mut damage = Damage::default();
        damage_of(&mut damage, &[]);
        // Two rows far apart with nine places each, every other tile.
        let places = (0..18).map(|i| rect((i % 9 * 64) as f32 + 4.0, (i / 9 * 320) as f32 + 4.0, Color32::RED));
        let areas = damage_of(&mut damage, &places.collect::<Vec<_>>());
        assert_eq!(areas.len(), AREAS);
        assert!(areas.iter().all(|area| area.height <= 40 && area.width <= 160), "{areas:?}");
        let seen = |x: u32, y: u32| {
            areas.iter().any(|a| (a.x..a.x + a.width).contains(&x) && (a.y..a.y + a.height).contains(&y))
        };
        assert!((0..18).all(|i| seen(i % 9 * 64 + 10, i / 9 * 320 + 10)));
    }

    #[test]
    fn very_many_areas_become_one() {
        let mut damage = Damage::default();
        damage.of(&[], [2000, 2000], 1.0, &Versions::new());
        let places: Vec<_> =
            (0..100).map(|i| rect((i % 10 * 150) as f32, (i / 10 * 150) as f32, Color32::RED)).collect();
        let areas = damage.of(&places, [2000, 2000], 1.0, &Versions::new());
        assert!(matches!(areas[..], [Area { x: 0, y: 0, width: 1376.., height: 1376.. }]), "{areas:?}");
    }
}
