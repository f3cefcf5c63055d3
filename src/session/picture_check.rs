//! A person asks for an audit of the picture that is shown, and where the device parts from the walker in a pixel.

use super::{
    Session,
    auditing::{AuditMap, Told},
    parting::PartingView,
    tracing::Taken,
    view::Level,
};

impl Session {
    /// Returns how far the audited pixels ([`Command::Audit`](super::Command::Audit)) are off double precision, while
    /// what was found of them is listed.
    pub fn audit_map(&self) -> Option<&AuditMap> {
        self.auditing.map.as_ref()
    }

    /// The search for where the device parts from the walker in the traced pixel
    /// ([`Command::FindParting`](super::Command::FindParting)); `None`: nobody has asked for it.
    pub fn parting(&self) -> Option<PartingView<'_>> {
        self.tracing.finding.view(self.tracing.view().traced?)
    }

    /// Hands on what the audited pass read. What was taken for something else is given back.
    pub(super) fn audit(&mut self, taken: Taken) -> Option<Taken> {
        let Some(pass) = self.auditing.taken() else { return Some(taken) };
        if let Some(project) = self.drawing.project().cloned() {
            self.auditing.submit(project, pass, taken);
        }
        None
    }

    /// Takes an audit that has ended.
    pub(super) fn take_audited(&mut self) {
        let Some(told) = self.auditing.take() else { return };
        self.changed = true;
        let Told { pass, pixels, error, findings, map } = match told {
            Ok(told) => told,
            Err(why) => return self.notice(Level::Warning, format!("cannot check the picture: {why}")),
        };
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
        self.auditing.map = Some(map);
    }

    /// Tells that what was asked of the device for an audit could not be had. Returns whether anything was asked.
    pub(super) fn audit_failed(&mut self, why: &str) -> bool {
        let is_ours = self.auditing.taken().is_some();
        if is_ours {
            self.notice(Level::Warning, format!("cannot check the picture: {why}"));
        }
        is_ours
    }
}
