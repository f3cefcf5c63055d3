//! While time stands still, what changes the picture draws the frame that is shown again, and no other. How is the
//! business of `drawing::history`; here it is said when.

use super::{
    Session,
    view::{About, Level},
};

impl Session {
    /// The frame that is shown is to be drawn again now, once: no other is due.
    pub(super) fn take_again(&mut self) -> bool {
        let wanted = &self.drawing.wanted;
        let is_other_coming = wanted.restart || wanted.program.is_some() || wanted.size.is_some();
        let is_ready = self.drawing.has_program() && !is_other_coming && self.halting.halt.is_none();
        is_ready && self.is_time_still() && std::mem::take(&mut self.run.is_again_due)
    }

    /// Nothing but what is done to the project or the window changes the picture.
    pub(super) fn is_time_still(&self) -> bool {
        let is_running = self.run.clock.is_playing() && !self.run.is_covered;
        !is_running && !self.run.seeking.is_seeking() && self.run.clock.next_frame_number() > 0
    }

    /// A change of the program or the canvas is followed by the frame that is shown, and by no other.
    pub(super) fn stays(&self) -> bool {
        let wanted = &self.drawing.wanted;
        let begins_anew = wanted.restart || wanted.reset || self.compile.reset_when_built || self.draws_all_anew();
        self.is_time_still() && !begins_anew
    }

    /// The frame that is shown cannot be drawn again: the next one shows what has changed.
    pub(super) fn again_is_lost(&mut self) {
        self.run.is_frame_due = true;
        if self.has_state() {
            let text = "the buffers are too large to be kept: a change while paused draws one frame more";
            self.notice_once(About::Again, Level::Info, text);
        }
    }
}
