//! The session decides what is read behind a frame: pictures, numbers, and what a walk or a comparison needs.

use super::{Session, drawing::Reads};
use eddy_playback::run::ReplayFrom;
use std::mem::take;

impl Session {
    /// Returns what is due to be read now, behind the frame that is due, if one is.
    pub(super) fn due_reads(&mut self, is_frame: bool) -> Reads {
        let is_playing = self.run.clock.is_playing() && !self.run.is_covered;
        // Another project's engine says that it has no program.
        let is_there = self.drawing.has_program() && !self.drawing.is_program_coming();
        let mut reads = Reads::default();
        // A canvas between two pictures has none.
        let is_between = self.drawing.wanted.size.is_some() || self.run.is_again_due;
        if is_between && !is_frame && is_there && self.halting.halt.is_none() {
            return reads;
        }
        if is_frame || is_there || self.drawing.wanted.restart {
            self.read_pictures(is_frame, is_playing, &mut reads);
        }
        if is_there && !self.is_compile_under_way() {
            self.read_inputs(is_playing, &mut reads);
        }
        reads
    }

    /// Adds pictures and numbers, which are of the newest program, after the frame that is due.
    fn read_pictures(&mut self, is_frame: bool, is_playing: bool, reads: &mut Reads) {
        reads.captures = take(&mut self.drawing.captures);
        reads.wants_picture = self.last_pictures.take_due() && self.is_picture_of_project();
        reads.miniatures = self.run.miniatures.take_due(self.now, is_playing);
        reads.buffers = self.run.buffers.take_due(self.now, is_playing);
        let is_busy = is_playing || self.run.seeking.is_seeking();
        reads.measures = self.run.measuring.take_due(self.now, is_frame, is_busy);
        reads.numbers = self.probing.take_due(self.now, is_playing);
    }

    /// Adds what the newest program was drawn with. An audit goes before a trace, which waits until nothing more is to
    /// be drawn.
    fn read_inputs(&mut self, is_playing: bool, reads: &mut Reads) {
        // For one at a time.
        reads.wants_replay = if take(&mut self.searching.is_due) {
            Some(ReplayFrom::Oldest)
        } else {
            self.tracing.finding.take_due().then_some(ReplayFrom::Newest)
        };
        reads.wants_run = take(&mut self.comparing.is_due);
        reads.inspect = self.auditing.take_due(&self.run.shown);
        let is_settled = !is_playing && !self.run.is_frame_due && !self.run.is_again_due && self.run.steps == 0;
        if is_settled && reads.inspect.is_none() && self.tracing.is_due {
            reads.inspect = self.tracing.place().map(|place| place.pass.clone());
            self.tracing.is_due = reads.inspect.is_none();
        }
    }
}
