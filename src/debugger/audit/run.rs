//! Audits pixels, in parallel on all processors.

use super::{
    blame,
    distance::{difference, error_of},
    finding::{CONSTANT, Finding, Kind},
    flow::Shown,
    parts,
    watch::Watch,
};
use crate::{
    fragment::{Fragment, Origin, PassFragments, PixelContent, own_texels},
    trace::TraceError,
};
use eddy_diag::SourceId;
use eddy_engine::{PassInputs, Sources};
use eddy_glsl::{
    walk::{Observer, Shadowed},
    walkable::{Detail, UnsetKind, Walkable},
};
use eddy_project::PassSettings;
use std::{
    collections::BTreeMap,
    sync::atomic::{AtomicUsize, Ordering},
};

/// A pixel of a pass in both precisions. Components that are not stored, and pixels that are not drawn, are 0.
#[derive(Clone, Debug, PartialEq)]
pub struct AuditedPixel {
    pub pixel: (u32, u32),
    pub single: [f32; 4],
    pub double: [f64; 4],
    /// The largest difference of a component; infinite if only one of the two is a number.
    pub error: f64,
}

impl AuditedPixel {
    /// Returns the difference of each component of a device's texel from double precision; 0 for those that are not
    /// stored.
    pub fn apart(&self, device: [f32; 4], stored: usize) -> [f64; 4] {
        let one = |i: usize| difference(Shadowed { single: device[i], double: self.double[i] });
        std::array::from_fn(|i| if i < stored { one(i) } else { 0.0 })
    }
}

/// Returns the pixels at the centres of equal cells, row by row; in a small pass a pixel may occur more than once.
pub fn spread((columns, rows): (u32, u32), (width, height): (u32, u32)) -> Vec<(u32, u32)> {
    let at = |i: u32, n: u32, size: u32| ((u64::from(2 * i + 1) * u64::from(size)) / u64::from(2 * n)) as u32;
    (0..rows).flat_map(|y| (0..columns).map(move |x| (at(x, columns, width), at(y, rows, height)))).collect()
}

/// Returns pixels spread over the texels that the programs of a pass draw: none of its boundary, and none outside its
/// region.
pub fn grid((columns, rows): (u32, u32), settings: &PassSettings, size: (u32, u32)) -> Vec<(u32, u32)> {
    let Some(own) = own_texels(settings, size) else { return Vec::new() };
    let pixels = spread((columns, rows), (own.width, own.height));
    pixels.into_iter().map(|(x, y)| (own.x + x, own.y + y)).collect()
}

/// Returns the parts of a picture that the pixels of [`grid`] represent, in their order: two corners each, from 0 to 1
/// across and up.
pub fn cells(
    (columns, rows): (u32, u32),
    settings: &PassSettings,
    (width, height): (u32, u32),
) -> Vec<([f32; 2], [f32; 2])> {
    let Some(own) = own_texels(settings, (width, height)) else { return Vec::new() };
    let at = |x: u32, y: u32| {
        let part = |start: u32, count: u32, i: u32, n: u32, whole: u32| {
            (start as f32 + count as f32 * i as f32 / n as f32) / whole as f32
        };
        [part(own.x, own.width, x, columns, width), part(own.y, own.height, y, rows, height)]
    };
    (0..rows).flat_map(|y| (0..columns).map(move |x| (at(x, y), at(x + 1, y + 1)))).collect()
}

/// The result of an audit.
#[derive(Clone, Debug, Default)]
pub struct Audit {
    /// In the order of the request.
    pub pixels: Vec<AuditedPixel>,
    /// In order of importance.
    pub findings: Vec<Finding>,
}

/// Audits `project.passes[index]` at some pixels, counted from the bottom left, on all processors. Where no program
/// draws, outside of its region, there is nothing to audit. Faults of operations on constants are found statically, and
/// counted for every pixel.
pub fn audit(
    sources: &Sources<'_>,
    index: usize,
    inputs: &PassInputs,
    pixels: &[(u32, u32)],
    limit: u64,
) -> Result<Audit, TraceError> {
    let pass = PassFragments::new(sources, index, inputs, Detail::Values, limit)?;
    let mut audit = audit_pixels(&pass, &stored(sources, index), inputs.size, pixels)?;
    let Some(first) = audit.pixels.first().map(|audited| audited.pixel) else { return Ok(audit) };
    for (span, is_undefined, what) in pass.programs().flat_map(Walkable::faults) {
        let kind = if is_undefined { Kind::Undefined(what) } else { Kind::Nonfinite(what) };
        let (span, pixels) = ((span.source != SourceId::NONE).then_some(span), audit.pixels.len());
        let finding = Finding { kind, span, pixels, pixel: first, numbers: CONSTANT.into(), error: None };
        if !audit.findings.iter().any(|known| known.is_same_as(&finding)) {
            audit.findings.push(finding);
        }
    }
    audit.findings.sort_by_key(|finding| finding.kind.class());
    Ok(audit)
}

/// Returns the findings at one pixel, by walking it.
pub fn audit_pixel(
    sources: &Sources<'_>,
    index: usize,
    inputs: &PassInputs,
    pixel: (u32, u32),
    limit: u64,
) -> Result<Audit, TraceError> {
    let pass = PassFragments::new(sources, index, inputs, Detail::Values, limit)?;
    audit_pixels(&pass, &stored(sources, index), inputs.size, &[pixel])
}

/// Returns the number of components that each target of a pass stores.
fn stored(sources: &Sources<'_>, index: usize) -> Vec<usize> {
    sources.pass(index).formats().iter().map(|format| format.components()).collect()
}

/// A declaration with undefined values that pixels show.
struct ShownByPixels<'p> {
    walkable: &'p Walkable,
    shown: Shown,
    pixels: usize,
    first: (u32, u32),
}

impl ShownByPixels<'_> {
    fn finding(&self) -> Finding {
        let what = match self.shown.origin.kind {
            UnsetKind::Variable => {
                "the result depends on this variable where it was never written (undefined, 4.3.1): give it a value"
            }
            UnsetKind::Parameter => {
                "the result depends on this `out` parameter where it was never written (undefined, 6.1.1): give it a \
                 value"
            }
            UnsetKind::Result => {
                "the result depends on this function where it ends without a `return` (undefined, 6.1): add one"
            }
        };
        Finding {
            kind: Kind::Undefined(what),
            span: Some(self.shown.origin.span),
            pixels: self.pixels,
            pixel: self.first,
            numbers: parts::names(self.walkable, &self.shown),
            error: None,
        }
    }
}

fn audit_pixels(
    pass: &PassFragments<'_>,
    stored: &[usize],
    size: (u32, u32),
    pixels: &[(u32, u32)],
) -> Result<Audit, TraceError> {
    if let Some(&pixel) = pixels.iter().find(|p| p.0 >= size.0 || p.1 >= size.1) {
        return Err(TraceError::Outside { pixel, size });
    }
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        while let Some(&pixel) = pixels.get(next.fetch_add(1, Ordering::Relaxed)) {
            done.extend(walk_pixel(pass, stored, pixel)?);
        }
        Ok::<_, TraceError>(done)
    };
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get()).min(pixels.len().max(1));
    let done: Result<Vec<_>, TraceError> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        threads.into_iter().map(|t| t.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    });
    let mut found: BTreeMap<(u32, u32), WalkedPixel<'_>> =
        done?.into_iter().flatten().map(|walked| (walked.audited.pixel, walked)).collect();
    let mut by_pixels: Vec<ShownByPixels<'_>> = Vec::new();
    let mut audit = Audit::default();
    let mut all: Vec<Finding> = Vec::new();
    for pixel in pixels {
        // A repeated pixel counts once.
        let Some(WalkedPixel { audited, findings, shown }) = found.remove(pixel) else { continue };
        for (walkable, shown) in shown {
            match by_pixels.iter_mut().find(|known| known.shown.origin.is_same_declaration(&shown.origin)) {
                Some(known) => {
                    known.shown.cells.extend(shown.cells);
                    known.pixels += 1;
                }
                None => by_pixels.push(ShownByPixels { walkable, shown, pixels: 1, first: *pixel }),
            }
        }
        audit.pixels.push(audited);
        for finding in findings {
            match all.iter_mut().find(|known| known.is_same_as(&finding)) {
                Some(known) => known.add(&finding),
                None => all.push(finding),
            }
        }
    }
    all.extend(by_pixels.iter().map(ShownByPixels::finding));
    all.sort_by(|a, b| a.kind.class().cmp(&b.kind.class()).then(b.pixels.cmp(&a.pixels)));
    audit.findings = all;
    Ok(audit)
}

/// The result of auditing a pixel.
struct WalkedPixel<'p> {
    audited: AuditedPixel,
    findings: Vec<Finding>,
    shown: Vec<(&'p Walkable, Shown)>,
}

fn walk_pixel<'p>(
    pass: &'p PassFragments<'_>,
    stored: &[usize],
    pixel: (u32, u32),
) -> Result<Option<WalkedPixel<'p>>, TraceError> {
    let at = match pass.at(pixel)? {
        PixelContent::Fragment(at) => at,
        PixelContent::Undrawn(Origin::Clear) => {
            let audited = AuditedPixel { pixel, single: [0.0; 4], double: [0.0; 4], error: 0.0 };
            return Ok(Some(WalkedPixel { audited, findings: Vec::new(), shown: Vec::new() }));
        }
        PixelContent::Undrawn(_) => return Ok(None),
    };
    let mut watch = Watch::new(at.walkable, &at.world, stored);
    let drawn = walk(&at, &mut watch)?;
    let audited = AuditedPixel {
        pixel,
        single: drawn.map(|x| x.single),
        double: drawn.map(|x| x.double),
        error: error_of(&drawn),
    };
    let blame = blame::find(&drawn, &watch, |observer| walk(&at, observer))?;
    let (findings, shown) = watch.end(pixel, blame);
    let shown = shown.into_iter().map(|shown| (at.walkable, shown)).collect();
    Ok(Some(WalkedPixel { audited, findings, shown }))
}

/// Returns the output of a pixel in both precisions, along the path of single precision; zeros if it draws nothing.
pub(super) fn walk(at: &Fragment<'_>, observer: &mut dyn Observer<Shadowed>) -> Result<[Shadowed; 4], TraceError> {
    let drawn = at.machine::<Shadowed>().run(at.lane, observer)?;
    Ok(at.value(&drawn).unwrap_or([Shadowed { single: 0.0, double: 0.0 }; 4]))
}
