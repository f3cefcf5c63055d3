//! Another project takes the place of the open one: what belongs to a project goes with it as a whole.
//!
//! Owns the line between the two. Each part of a session that has both is made anew here, member by member, so that one
//! that is added is asked about by the compiler: is it the project's, or the window's? The window's are the device, what
//! is watched of the disk, the folders, counters, and what a person has set for all projects (the limit of a frame,
//! whether a reload begins anew, whether an edit keeps the inputs).

use super::{
    Session,
    command::{Question, Request},
    costs::Costs,
    documents::Documents,
    drawing::Ticket,
    read_back::ReadBack,
    state::{Canvas, Dialog, Run},
    uniforms_of_texts::DeclaredUniforms,
};
use eddy_project::PassId;
use std::mem::take;

impl Session {
    /// Another project takes the place of this one, from where its time stood when it was open last.
    pub(super) fn replace(&mut self, documents: Documents) {
        self.end_recording();
        self.keep_time();
        self.drawing.restart();
        self.documents = documents;
        self.projects_opened += 1;
        self.text_generation += 1;
        self.forget_notices();
        self.safekeeping.kept = None;
        self.passes.clear();
        self.canvas = self.canvas.of_next_project();
        self.compile.begin_next_project();
        self.renamed_uniforms.clear();
        self.declared_uniforms = DeclaredUniforms::default();
        self.disk.begin_next_project();
        self.dialog.begin_next_project();
        self.playback.begin_next_project();
        self.run.begin_next_project();
        self.read_backs().into_iter().for_each(ReadBack::begin_next_project);
        self.probing.begin_next_project();
        self.last_pictures.ticket = Ticket::default();
        self.tracing.want(None);
        self.auditing.begin_next_project();
        self.searching.want(false);
        self.comparing.begin_next_project();
        self.take_time_up();
        self.halt_for_new_project();
        self.disk_is_known();
        self.compile_soon();
        self.read_declared_uniforms();
    }
}

impl Canvas {
    fn of_next_project(&self) -> Canvas {
        let Canvas { viewport, asked: _, usual, replayed: _, refused: _ } = *self;
        Canvas { viewport, asked: usual, usual, replayed: None, refused: None }
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

impl Run {
    fn begin_next_project(&mut self) {
        *self = Run {
            shown: PassId::Image,
            is_program_new: false,
            is_picture_new: self.is_picture_new,
            waits_for_painting: self.waits_for_painting,
            cpu_micros: 0.0,
            costs: Costs::watched(self.costs.is_watched()),
            miniatures: take(&mut self.miniatures),
            buffers: take(&mut self.buffers),
            measuring: take(&mut self.measuring),
        };
    }
}
