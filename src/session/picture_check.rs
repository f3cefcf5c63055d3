//! A person asks for an audit of the picture that is shown, and where the device parts from the walker in a pixel.

use super::{
    Session,
    auditing::{AuditMap, AuditSummary},
    tracing::Taken,
    view::{About, Level},
};
use eddy_debugger::divergence::DivergenceView;

impl Session {
    /// Returns how far the audited pixels ([`Command::Audit`](super::Command::Audit)) are off double precision, while
    /// what was found of them is listed.
    pub fn audit_map(&self) -> Option<&AuditMap> {
        self.auditing.map.as_ref()
    }

    /// The search for where the device parts from the walker in the traced pixel
    /// ([`Command::FindDivergence`](super::Command::FindDivergence)); `None`: nobody has asked for it.
    pub fn divergence(&self) -> Option<DivergenceView<'_>> {
        self.tracing.finding.view(self.tracing.view().traced?)
    }

    /// Hands on what the audited pass read. What was taken for something else is given back.
    pub(super) fn audit(&mut self, taken: Taken) -> Option<Taken> {
        let Some(pass) = self.auditing.taken() else { return Some(taken) };
        if let Some(project) = self.drawing.project().cloned() {
            self.auditing.submit(project, pass, taken, self.frames_drawn);
        }
        None
    }

    /// Takes an audit that has ended.
    pub(super) fn take_audited(&mut self) {
        let Some(told) = self.auditing.take() else { return };
        self.changed = true;
        let AuditSummary { pass, pixels, error, findings, map } = match told {
            Ok(told) => told,
            Err(why) => return self.not_checked(&why),
        };
        // A frame of another size was drawn meanwhile, and is the picture that is shown.
        if !self.auditing.is_of(self.frames_drawn) && !self.is_playing() {
            self.auditing.is_due = true;
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
        self.auditing.map = Some(map).filter(|_| self.auditing.is_of(self.frames_drawn));
    }

    /// Looks at the picture that is shown. It stands still, as the map that is laid over it does.
    pub(super) fn ask_audit(&mut self) {
        self.settled(About::Audit);
        if self.is_playing() {
            self.pause();
        }
        self.auditing.is_due = true;
    }

    /// Another picture is shown than the one that the map is of.
    pub(super) fn picture_is_other(&mut self) {
        self.frames_drawn += 1;
        self.auditing.map = None;
    }

    fn not_checked(&mut self, why: &str) {
        self.notice_about(About::Audit, Level::Warning, format!("cannot check the picture: {why}"));
    }

    /// Tells that what was asked of the device for an audit could not be had. Returns whether anything was asked.
    pub(super) fn audit_failed(&mut self, why: &str) -> bool {
        let is_ours = self.auditing.taken().is_some();
        if is_ours {
            self.not_checked(why);
        }
        is_ours
    }
}
