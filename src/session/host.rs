//! The window of an open project: its settings and its time, and the notices and questions that it is to show.

use super::{
    SessionOptions,
    command::{PendingAction, Question, Request},
    notices::Notices,
};
use eddy_background::Wake;
use eddy_project::PassName;
use std::{collections::VecDeque, mem::take, sync::Arc, time::Instant};

pub(super) struct Host {
    pub options: Arc<SessionOptions>,
    /// Requests a tick. Any thread may call it.
    pub wake: Wake,
    /// The time of the newest tick, which is the current time until the next one.
    pub now: Instant,
    /// Counts the projects that have replaced another.
    pub serial: u64,
    /// Counts the shaders created by [`FileCommand::New`](super::FileCommand::New).
    pub new_shader_count: u64,
    pub notices: Notices,
    pub dialog: Dialog,
    /// Something that a panel shows has changed since the last tick.
    pub changed: bool,
    /// Counts the times that texts were changed by something else than an editor.
    pub text_generation: u64,
    /// Passes that were renamed, oldest first.
    pub renamed_passes: Vec<(PassName, PassName)>,
}

/// Questions to the user and requests to the front end.
#[derive(Default)]
pub(super) struct Dialog {
    pub questions: VecDeque<Question>,
    pub requests: VecDeque<Request>,
    /// The action that follows a Save As that a question led to.
    pub after_save: Option<PendingAction>,
}

impl Host {
    pub(super) fn new(options: SessionOptions, wake: Wake) -> Self {
        Self {
            options: Arc::new(options),
            wake,
            now: Instant::now(),
            serial: 0,
            new_shader_count: 0,
            notices: Notices::default(),
            dialog: Dialog::default(),
            changed: true,
            text_generation: 0,
            renamed_passes: Vec::new(),
        }
    }

    /// Moves to the next project, all of whose texts are new.
    pub(super) fn hand_over(&mut self) -> Self {
        Self {
            options: self.options.clone(),
            wake: self.wake.clone(),
            now: self.now,
            serial: self.serial + 1,
            new_shader_count: self.new_shader_count,
            notices: take(&mut self.notices),
            dialog: self.dialog.hand_over(),
            changed: true,
            text_generation: self.text_generation + 1,
            renamed_passes: take(&mut self.renamed_passes),
        }
    }
}

impl Dialog {
    /// Moves to the next project what is not about this one.
    fn hand_over(&mut self) -> Self {
        let Dialog { mut questions, mut requests, after_save: _ } = take(self);
        // Recovery questions are about other projects.
        questions.retain(|question| matches!(question, Question::Recover(_)));
        requests.retain(|request| !matches!(request, Request::SaveAs { .. }));
        Self { questions, requests, after_save: None }
    }
}
