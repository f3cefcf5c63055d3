//! Actions of time.

/// Says what can be asked of time by a key or by the palette.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeAction {
    /// Opens the menu with the time that is typed.
    GoTo,
    Slower,
    Faster,
    UsualSpeed,
    /// Every frame takes the same time, or no longer.
    FixedStep,
    /// The part that is played again and again begins at the time that is shown.
    LoopFrom,
    LoopTo,
    LoopOff,
    /// New code draws the same frame from the same inputs, or no longer.
    KeepInputs,
}
