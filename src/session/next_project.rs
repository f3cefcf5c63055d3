//! Replacement of the open project by another: all state that belongs to the project is replaced with it.
//!
//! Owns the distinction between state of the project and of the window. Each part of a session that has both is rebuilt
//! here, field by field, so that the compiler requires a decision for a new field. The window's are the device, the
//! watcher of the disk, the folders, counters, and the user's settings for all projects (the frame limit, whether a
//! reload resets, whether an edit keeps the inputs).

use super::{
    Session,
    command::{Question, Request},
    documents::Documents,
    drawing::Ticket,
    state::{Dialog, Picture},
    uniforms::TextUniforms,
};
use eddy_project::PassName;

impl Session {
    /// Replaces the project by another, which continues from its time when it was last open.
    pub(super) fn replace(&mut self, documents: Documents) {
        self.end_recording();
        self.stop_film();
        self.keep_time();
        self.drawing.restart();
        self.documents = documents;
        self.projects_opened += 1;
        self.text_generation += 1;
        self.forget_notices();
        self.unsaved.kept = None;
        self.passes.clear();
        self.canvas.begin_next_project();
        self.compile.begin_next_project();
        self.uniforms = TextUniforms::default();
        self.disk.begin_next_project();
        self.dialog.begin_next_project();
        self.playback.begin_next_project();
        self.devices.begin_next_project();
        self.audio.begin_next_project();
        self.controls.begin_next_project();
        self.picture.begin_next_project();
        self.watched.begin_next_project();
        self.last_pictures.ticket = Ticket::default();
        self.tracing.want(None);
        self.auditing.begin_next_project();
        self.searching.want(false);
        self.comparing.begin_next_project();
        self.sounding.begin_next_project();
        self.take_time_up();
        self.halt_for_new_project();
        self.disk_is_known();
        self.compile_soon();
        self.read_declared_uniforms();
    }
}

impl Dialog {
    fn begin_next_project(&mut self) {
        let Dialog { questions, requests, after_save } = self;
        // Recovery questions are about other projects.
        questions.retain(|question| matches!(question, Question::Recover(_)));
        requests.retain(|request| !matches!(request, Request::SaveAs { .. }));
        *after_save = None;
    }
}

impl Picture {
    fn begin_next_project(&mut self) {
        (self.shown, self.is_program_new) = (PassName::image(), false);
    }
}
