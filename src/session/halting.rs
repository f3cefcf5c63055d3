//! A halt of the picture is known by why it stands, and by what it goes on with. What is done about it is in `halt`.

use super::{marker::Marker, pace::Pace, view::Halt};
use eddy_project::Project;
use std::{
    path::PathBuf,
    time::{Duration, Instant},
};

pub(super) struct Halting {
    pub halt: Option<Halt>,
    /// The picture ran when it was halted, and goes on after.
    pub resumes: bool,
    /// The newest code that drew a frame within the limit.
    pub good: Option<Project>,
    pub limit: Duration,
    pub pace: Pace,
    /// The time that the user has let a frame take.
    pub allowed: Option<Duration>,
    /// No frame of the newest program that was handed in has been drawn yet.
    pub is_new: bool,
    pub marker: Marker,
    pub lost_at: Option<Instant>,
}

impl Halting {
    pub fn new(limit: Duration, state_dir: Option<PathBuf>) -> Self {
        Self {
            halt: None,
            resumes: false,
            good: None,
            limit,
            pace: Pace::default(),
            allowed: None,
            is_new: false,
            marker: Marker::new(state_dir.as_deref()),
            lost_at: None,
        }
    }

    /// The time that a frame may take.
    pub fn limit(&self) -> Duration {
        self.allowed.unwrap_or(self.limit)
    }

    /// Nothing of the author's may reach the device yet.
    pub fn is_held(&self) -> bool {
        matches!(self.halt, Some(Halt::Opened { .. }))
    }
}
