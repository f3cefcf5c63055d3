//! Replacement of the open project by another.

use super::{
    Session,
    documents::Documents,
    drawing::{Change, Ticket},
};
use std::mem::replace;

impl Session {
    /// Replaces the project by another, which continues from its time when it was last open.
    pub(super) fn replace(&mut self, documents: Documents) {
        self.open.end_recording();
        self.stop_film();
        self.keep_time();
        let is_overdue = self.overdue().is_some();
        let next = self.open.successor(documents, is_overdue);
        let previous = replace(&mut self.open, next);
        self.services.closing.add(previous.close());
        let is_other_engine = self.services.drawing.switch_project(self.open.host.serial);
        self.open.changes.set_if(is_other_engine, Change::Restart);
        self.services.compiler.cancel();
        self.services.audio.close_project();
        self.services.controls.close_project();
        self.services.sound_pass.silence();
        self.services.recovery.kept = None;
        self.services.last_pictures.ticket = Ticket::default();
        self.open.forget_notices();
        self.restore_run();
        self.open.hold_after_trouble();
        self.open.remember_disk();
        self.open.compile_soon();
        self.open.read_declared_uniforms();
    }
}
