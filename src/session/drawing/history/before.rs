//! Owns what is kept to draw the frame again that is shown. How that is done is in `again`.

use eddy_engine::Snapshot;
use std::sync::Arc;

/// Holds what the targets held before a frame, on the canvas that they had then.
pub struct Before {
    /// The frame's number in the run.
    pub number: u64,
    pub size: (u32, u32),
    pub snapshot: Arc<Snapshot>,
}

/// Holds what is needed to draw the frame again that is shown.
#[derive(Default)]
pub struct Again {
    /// The targets hold what they held before this frame, which is the one that is shown.
    pub rewound: Option<u64>,
    pub before: Option<Before>,
}

impl Again {
    /// Another program draws from now on.
    pub fn change_program(&mut self) {
        // Its targets may be others.
        self.before = None;
    }

    /// A frame is drawn that was not drawn before: what follows it is another run.
    pub fn drop_behind(&mut self, number: u64) {
        self.before.take_if(|before| before.number > number);
    }
}
