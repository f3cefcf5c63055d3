//! The state that the panel keeps from frame to frame.

use crate::session::{Command, ViewCommand, measures::Sample};

/// The horizontal axis of a plot.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Axis {
    #[default]
    Frame,
    Time,
}

impl Axis {
    pub(super) fn of(self, sample: &Sample) -> f64 {
        match self {
            Axis::Frame => f64::from(sample.frame),
            Axis::Time => sample.time_secs,
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Axis::Frame => "iFrame",
            Axis::Time => "iTime",
        }
    }
}

/// The state of the panel.
#[derive(Default)]
pub(crate) struct Measurements {
    pub(super) axis: Axis,
    /// The cards visible in this frame, by the serials of their comments.
    pub(super) seen: Vec<u64>,
    /// Costs of passes are to be gathered: they explain why a pass is not drawn.
    pub(super) wants_costs: bool,
    /// The last request to the session.
    sent: Vec<u64>,
}

impl Measurements {
    /// Returns whether costs of passes were visible in the newest frame. Called once for each frame.
    pub(crate) fn take_costs_request(&mut self) -> bool {
        std::mem::take(&mut self.wants_costs)
    }

    /// Ends a frame of the window: cards that were not visible are no longer measured.
    pub(crate) fn end_frame(&mut self) -> Option<Command> {
        let seen = std::mem::take(&mut self.seen);
        if seen == self.sent {
            return None;
        }
        self.sent.clone_from(&seen);
        Some(Command::View(ViewCommand::WatchMeasures(seen)))
    }
}
