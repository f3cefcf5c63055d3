//! The audit of the shown picture, at the user's request: its input is read from the pass after a frame, it runs on a
//! thread of its own, and its findings are listed with the problems until the next compile.

use super::{
    drawing::{Tasks, Ticket},
    open_project::OpenProject,
    read_back::{Inspect, Inspected},
    view::{About, Level, TabDiagnostic},
};
use eddy_background::{Background, Wake};
use eddy_debugger::{
    audit::{self, Audit, AuditedPixel, Class, Finding},
    trace::STEPS,
};
use eddy_diag::{Diagnostic, Severity};
use eddy_engine::{EngineError, Sources};
use eddy_project::{PassName, Project};
use std::{collections::HashMap, thread::JoinHandle};

/// The number of pixels that are audited, across and up.
const PIXELS: (u32, u32) = (32, 18);
/// The number of pixels that are listed.
const WORST: usize = 5;

/// The result of an audit.
pub(super) struct AuditSummary {
    pub pass: PassName,
    pub pixels: usize,
    /// The largest difference of a component between the device and double precision.
    pub error: f64,
    pub findings: Vec<TabDiagnostic>,
    pub map: AuditMap,
}

/// The errors of a pass's pixels against double precision, by position.
#[derive(Clone, Debug, PartialEq)]
pub struct AuditMap {
    pub pass: PassName,
    /// The pass's picture.
    pub size: (u32, u32),
    pub pixels: usize,
    pub cells: Vec<AuditCell>,
    /// The largest errors in descending order; pixels without an error are left out.
    pub worst: Vec<WorstPixel>,
}

/// The part of a picture that one pixel represents: its corners, from 0 to 1 across and up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AuditCell {
    pub from: [f32; 2],
    pub to: [f32; 2],
    /// The largest difference of a component; infinite if only one of the device and double precision yields a number.
    pub error: f64,
}

/// A pixel, the device's value for it, and the value in double precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorstPixel {
    pub pixel: (u32, u32),
    pub error: f64,
    pub device: [f32; 4],
    pub double: [f64; 4],
}

pub(super) struct PictureAudit {
    background: Background<(Project, Inspected), (), AuditSummary>,
    input: Ticket<Result<Inspected, EngineError>>,
    /// The newest map, shown while its frame is.
    pub map: Option<AuditMap>,
    /// The frame count when the input was read.
    of_frame: u64,
}

impl PictureAudit {
    pub(crate) fn new(wake: Wake) -> Self {
        let work = |(project, inspected): (Project, Inspected), _: &_| audit_pass(&project, inspected);
        let background = Background::lazy("audit", "the CPU interpreter", wake, work);
        Self { background, input: Ticket::default(), map: None, of_frame: 0 }
    }

    pub(crate) fn request_input(&mut self, shown: &PassName, tasks: &mut Tasks) {
        if self.background.take_request() {
            self.input = tasks.add(Inspect(shown.clone()));
        }
    }

    /// Requests the input again: the device that was to deliver it is lost.
    pub(crate) fn renew_request(&mut self) {
        self.background.renew_request();
    }

    /// Cancels the work, and returns its thread.
    pub(crate) fn close(self) -> Option<JoinHandle<()>> {
        self.background.abandon()
    }
}

impl OpenProject {
    /// Returns the errors of the audited pixels ([`ToolCommand::Audit`](super::ToolCommand::Audit)) while its findings
    /// are listed.
    pub(crate) fn audit_map(&self) -> Option<&AuditMap> {
        self.audit.map.as_ref()
    }

    pub(super) fn ask_audit(&mut self) {
        self.dismiss_notices(About::Audit);
        if self.is_playing() {
            self.pause();
        }
        self.audit.background.request();
    }

    /// Submits the input that the audited pass read.
    pub(super) fn audit(&mut self) {
        let Some(input) = self.audit.input.take() else { return };
        match (input.output, self.engine.project().cloned()) {
            (Ok(inspected), Some(project)) => {
                self.audit.of_frame = self.picture.frames_drawn;
                self.audit.background.start((project, inspected));
            }
            (Ok(_), None) => self.audit.background.cancel(),
            (Err(e), _) => {
                self.audit.background.cancel();
                self.not_checked(&e.to_string());
            }
        }
    }

    /// Takes a finished audit.
    pub(super) fn take_audited(&mut self) {
        let Some(result) = self.audit.background.take() else { return };
        self.host.changed = true;
        let AuditSummary { pass, pixels, error, findings, map } = match result {
            Ok(summary) => summary,
            Err(why) => return self.not_checked(&why),
        };
        // A frame of another size was drawn meanwhile, and is shown now.
        let is_shown = self.audit.of_frame == self.picture.frames_drawn;
        if !is_shown && !self.is_playing() {
            self.audit.background.request();
            return;
        }
        let count = match findings.len() {
            0 => "no undefined behaviour and no operation with large errors".to_owned(),
            1 => "one finding is in the list of problems".to_owned(),
            n => format!("{n} findings are in the list of problems"),
        };
        let pass = pass.title();
        let text = format!(
            "largest error of {pass} against double precision: {error:.1e} in {pixels} sampled \
                            pixels; {count}"
        );
        self.notice(Level::Info, text);
        self.compile.diagnostics.extend(findings);
        self.audit.map = Some(map).filter(|_| is_shown);
    }

    /// Drops the map: another picture is shown than the one that was audited.
    pub(super) fn on_picture_changed(&mut self) {
        self.picture.frames_drawn += 1;
        self.audit.map = None;
        self.forget_counted_picture();
    }

    fn not_checked(&mut self, why: &str) {
        self.notice_about(About::Audit, Level::Warning, format!("cannot check the picture: {why}"));
    }
}

fn audit_pass(project: &Project, inspected: Inspected) -> Result<AuditSummary, String> {
    let Inspected { pass, inputs, picture } = inspected;
    let index = project.passes.iter().position(|p| p.id == pass).ok_or("the pass was removed")?;
    let pixels = audit::grid(PIXELS, &project.passes[index].settings, inputs.size);
    let found = audit::audit(&Sources::new(project), index, &inputs, &pixels, STEPS).map_err(|e| e.to_string())?;
    let stored = project.passes[index].formats()[0].components();
    let texel = |(x, y): (u32, u32)| picture.texels.get((y * picture.width + x) as usize).copied().unwrap_or_default();
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
        found.findings.iter().map(|finding| TabDiagnostic::new(&diagnostic(finding, &found), &sources, project));
    Ok(AuditSummary { pass, pixels: found.pixels.len(), error: largest, findings: findings.collect(), map })
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
