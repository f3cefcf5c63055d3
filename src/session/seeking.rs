//! A seek is known by where it leads, and by what goes on after it. What is done about it is in `seek`.

/// A frame of the run that is to be shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Goal {
    /// So many frames after the one that is shown; negative: before it.
    By(i64),
    /// The frame of this number, the run's first being 0.
    Frame(u64),
    /// The last frame whose `iTime` is not above so many seconds, or the first that can be shown.
    Time(f64),
    /// The same as `Frame`, by a new program: every frame is drawn again from the run's beginning.
    Anew(u64),
}

/// The frames that one can go to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reach {
    /// The number of frames before the one that is shown, and behind it.
    pub back: u64,
    pub ahead: u64,
    /// `iTime` of the first and the last of them, in seconds.
    pub first_secs: f64,
    pub last_secs: f64,
    /// The number of the frame that is shown, and whether the inputs of all frames since the last reset are kept.
    pub shown: u64,
    pub is_whole: bool,
}

/// A range of `iTime`, in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeRange {
    pub from: f64,
    pub to: f64,
}

impl TimeRange {
    /// Returns the range between two times, whichever is first. `None`: there is none between them.
    pub fn new(a: f64, b: f64) -> Option<TimeRange> {
        let (from, to) = (a.min(b).max(0.0), a.max(b));
        (from.is_finite() && to.is_finite() && from < to).then_some(TimeRange { from, to })
    }
}

#[derive(Default)]
pub(super) struct Seeking {
    /// The frame that the engine is to be asked for.
    pub goal: Option<Goal>,
    /// The engine has been asked.
    pub is_under_way: bool,
    /// The project has just been opened: its first program goes there.
    pub awaits_program: bool,
    /// The frames are drawn that lead to where the project was left.
    pub is_taking_up: bool,
    /// `iTime` up to which frames are drawn at a fixed step, once the goal is reached.
    pub until: Option<f64>,
    /// The picture runs on from there.
    pub resumes: bool,
    /// The part that is played again and again.
    pub range: Option<TimeRange>,
    /// A new program draws all frames since the last reset again, from the same inputs.
    pub keeps_inputs: bool,
}

impl Seeking {
    /// Ends a seek wherever it has come to.
    pub fn cancel(&mut self) {
        (self.goal, self.is_under_way, self.until, self.resumes) = (None, false, None, false);
        (self.awaits_program, self.is_taking_up) = (false, false);
    }

    pub fn is_seeking(&self) -> bool {
        self.goal.is_some() || self.is_under_way || self.until.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_lies_between_two_times_in_any_order() {
        assert_eq!(TimeRange::new(3.0, 1.5), Some(TimeRange { from: 1.5, to: 3.0 }));
        assert_eq!(TimeRange::new(-2.0, 1.0), Some(TimeRange { from: 0.0, to: 1.0 }));
        for (a, b) in [(1.0, 1.0), (-3.0, -1.0), (f64::NAN, 2.0), (0.0, f64::INFINITY)] {
            assert_eq!(TimeRange::new(a, b), None, "{a} to {b}");
        }
    }
}
