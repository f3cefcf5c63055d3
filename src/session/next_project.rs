//! Another project takes the place of the open one: what belongs to a project goes with it as a whole.
//!
//! Owns the line between the two. Each part of a session that has both is made anew here, member by member, so that one
//! that is added is asked about by the compiler: is it the project's, or the window's? The window's are the device, what
//! is watched of the disk, the folders, counters, and what a person has set for all projects (the limit of a frame,
//! whether a reload begins anew, whether an edit keeps the inputs).

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
    /// Another project takes the place of this one, from where its time stood when it was open last.
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
        // What was left behind is of other projects.
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
