//! Everything that a key, a menu or the palette can ask for.

use super::{TimeAction, TraceAction};
use crate::gui::{dock::Panel, editor::EditorAction};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    Compile,
    Save,
    SaveAs,
    Open,
    New,
    Gallery,
    TogglePlay,
    Reset,
    Step,
    StepBack,
    TabLeft,
    TabRight,
    NextPanel,
    PreviousPanel,
    Screenshot,
    SaveTexels,
    Record,
    /// Single against double precision, and what is undefined.
    Audit,
    Fullscreen,
    /// Code over a picture that fills the window.
    Present,
    Lab,
    Costs,
    /// Opens or closes a panel.
    Panel(Panel),
    /// Every panel where it is at first.
    UsualLayout,
    NextTheme,
    ZoomIn,
    ZoomOut,
    ZoomReset,
    SettingsFile,
    Passes,
    UndoPasses,
    RedoPasses,
    Paste,
    Help,
    Palette,
    KeyFile,
    Find,
    Replace,
    FindNext,
    FindPrevious,
    FindCase,
    FindRegex,
    ReplaceAll,
    GoToLine,
    NextProblem,
    PreviousProblem,
    FontLarger,
    FontSmaller,
    FontReset,
    WordWrap,
    /// The value of the expression at the caret instead of the picture, or the picture again.
    Probe,
    /// The next click on the picture says which pixel is traced.
    TracePixel,
    /// Where the first NaN comes from.
    FindNonfinite,
    Trace(TraceAction),
    Time(TimeAction),
    Quit,
    /// In the text that has the keyboard, or had it last.
    Code(EditorAction),
}
