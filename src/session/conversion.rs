//! Converts the open project, a shader of another program, to a new one in Shadertoy's form.

use super::{
    Session,
    command::PendingAction,
    view::{About, Level},
};
use eddy_project as project;
use eddy_translate as translate;

impl Session {
    /// Opens the converted project, which is stored nowhere yet.
    pub(super) fn convert(&mut self) {
        self.open.dismiss_notices(About::Opening);
        self.open.settle_includes();
        let mut made = match translate::shadertoy(self.project()) {
            Ok(made) => made,
            Err(why) => {
                return self.open.notice_about(About::Opening, Level::Error, format!("not converted: {why}"));
            }
        };
        if let Some(folder) = self.project().origin.base_dir() {
            project::leave_home(&mut made.project, folder);
        }
        if !made.notes.is_empty() {
            self.open.notice_about(About::Opening, Level::Info, made.notes.join("\n"));
        }
        self.ask_to_save_then(PendingAction::Keep(Box::new(made.project)));
    }
}
