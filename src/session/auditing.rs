//! The audit that a person asks for of the picture that is shown: taken of the pass after a frame, done on a thread of
//! its own, told in the list of problems until the next compile.

use super::{
    audit::{self, Audit, AuditedPixel, Class, Finding},
    trace::STEPS,
    tracing::Taken,
    view::TabDiagnostic,
    worker::{Panicked, Worker},
};
use eddy_diag::{Diagnostic, Severity};
use eddy_engine::Sources;
use eddy_project::{PassId, Project};
use std::{collections::HashMap, sync::Arc};

/// Says how many pixels are looked at, across and up.
const PIXELS: (u32, u32) = (32, 18);
/// Pixels that are listed.
const WORST: usize = 5;

struct Job {
    project: Project,
    pass: PassId,
    taken: Taken,
}

/// Holds what came of it.
pub(super) struct Told {
    pub pass: PassId,
    pub pixels: usize,
    /// The largest difference of a component between the device and double precision.
    pub error: f64,
    pub findings: Vec<TabDiagnostic>,
    pub map: AuditMap,
}

/// Says how far pixels of a pass are off double precision, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct AuditMap {
    pub pass: PassId,
    /// The pass's picture.
    pub size: (u32, u32),
    pub pixels: usize,
    pub cells: Vec<AuditCell>,
    /// The largest errors, the largest first; those without any are left out.
    pub worst: Vec<WorstPixel>,
}

/// A part of a picture that one pixel stands for: its corners, from 0 to 1 across and up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AuditCell {
    pub from: [f32; 2],
    pub to: [f32; 2],
    /// The largest difference of a component; infinite where the device or double precision alone has a number.
    pub error: f64,
}

/// A pixel, what the device has drawn there, and what double precision makes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPixel {
    pub pixel: (u32, u32),
    pub error: f64,
    pub device: [f32; 4],
    pub double: [f64; 4],
}

pub(super) struct Auditing {
    worker: Worker<Job, Result<Told, String>>,
    /// Says whether what the shown pass read is to be taken.
    pub is_due: bool,
    /// The pass of which it is being taken.
    taking: Option<PassId>,
    /// Holds what is shown of the newest one, as long as that frame is.
    pub map: Option<AuditMap>,
    /// The count of frames when it was taken.
    of_frame: u64,
}

impl Auditing {
    pub fn new(wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        Ok(Self { worker: Worker::new("audit", wake, told)?, is_due: false, taking: None, map: None, of_frame: 0 })
    }

    /// The pass whose inputs are to be taken now, if any are.
    pub fn take_due(&mut self, shown: &PassId) -> Option<PassId> {
        if std::mem::take(&mut self.is_due) {
            self.taking = Some(shown.clone());
        }
        self.taking.clone()
    }

    /// The pass of which something was being taken: it is here, or cannot be had.
    pub fn taken(&mut self) -> Option<PassId> {
        self.taking.take()
    }

    /// Another project is open.
    pub fn forget(&mut self) {
        self.worker.forget();
        (self.is_due, self.taking, self.map) = (false, None, None);
    }

    /// The frame that it was taken of, by the count of frames, is shown still.
    pub fn is_of(&self, frames_drawn: u64) -> bool {
        self.of_frame == frames_drawn
    }

    /// `frames_drawn`: the count of frames, of which this is the newest.
    pub fn submit(&mut self, project: Project, pass: PassId, taken: Taken, frames_drawn: u64) {
        self.of_frame = frames_drawn;
        self.worker.submit(Job { project, pass, taken });
    }

    /// Takes an audit that has ended; the error says why it gives nothing.
    pub fn take(&mut self) -> Option<Result<Told, String>> {
        Some(match self.worker.take()? {
            Ok(told) => told,
            Err(Panicked(why)) => Err(format!("this is a bug in Eddy: the CPU interpreter failed ({why})")),
        })
    }
}

fn told(Job { project, pass, taken: (inputs, device) }: Job) -> Result<Told, String> {
    let index = project.passes.iter().position(|p| p.id == pass).ok_or("the pass was removed")?;
    let pixels = audit::grid(PIXELS, &project.passes[index].settings, inputs.size);
    let found = audit::audit(&Sources::new(&project), index, &inputs, &pixels, STEPS).map_err(|e| e.to_string())?;
    let stored = project.passes[index].settings.format.components();
    let texel = |(x, y): (u32, u32)| device.texels.get((y * device.width + x) as usize).copied().unwrap_or_default();
    let error = |pixel: &AuditedPixel| pixel.apart(texel(pixel.pixel), stored).into_iter().fold(0.0, f64::max);
    let mut worst: Vec<WorstPixel> = found
        .pixels
        .iter()
        .map(|pixel| WorstPixel {
            pixel: pixel.pixel,
            error: error(pixel),
            device: texel(pixel.pixel),
            double: pixel.double,
        })
        .collect();
    let known: HashMap<(u32, u32), f64> = worst.iter().map(|worst| (worst.pixel, worst.error)).collect();
    let size = inputs.size;
    let cells = audit::cells(PIXELS, &project.passes[index].settings, size).into_iter().zip(&pixels);
    let cells =
        cells.filter_map(|((from, to), pixel)| Some(AuditCell { from, to, error: *known.get(pixel)? })).collect();
    worst.sort_by(|a, b| b.error.total_cmp(&a.error));
    let largest = worst.first().map_or(0.0, |worst| worst.error);
    worst.retain(|worst| worst.error > 0.0);
    worst.truncate(WORST);
    let map = AuditMap { pass: pass.clone(), size, pixels: found.pixels.len(), cells, worst };
    let sources = project.sources();
    let findings =
        found.findings.iter().map(|finding| TabDiagnostic::new(&diagnostic(finding, &found), &sources, &project));
    Ok(Told { pass, pixels: found.pixels.len(), error: largest, findings: findings.collect(), map })
}

fn diagnostic(finding: &Finding, audit: &Audit) -> Diagnostic {
    let severity = match finding.kind.class() {
        Class::Nonfinite | Class::Undefined => Severity::Warning,
        Class::Rounding | Class::Decided => Severity::Note,
    };
    let ((x, y), count) = (finding.pixel, audit.pixels.len());
    let mut hint = format!("in {} of {count} pixels, for example {x},{y}", finding.pixels);
    if finding.is_constant() {
        hint.clone_from(&finding.numbers);
    } else if !finding.numbers.is_empty() {
        hint = format!("{}, {hint}", finding.numbers);
    }
    if let Some((error, left)) = finding.error {
        hint = format!("{hint}; the error of {error:.1e} would be {left:.1e} if this were exact");
    }
    Diagnostic::new(severity, finding.span, finding.kind.message()).hint(hint)
}
