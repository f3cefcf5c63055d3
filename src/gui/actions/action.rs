//! Everything that a key, a menu or the palette can ask for.

use super::{LayoutAction, PictureAction, TimeAction, TraceAction};
use crate::gui::{dock::Panel, editor::EditorAction, settings::Theme};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    Compile,
    Save,
    SaveAs,
    Open,
    OpenFolder,
    /// A file that another program writes begins time and buffers anew, or no longer.
    ResetOnReload,
    AddCommon,
    /// The next free one.
    AddBuffer,
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
    /// Chooses a recording, whose input is played.
    PlayRecording,
    StopReplay,
    ExportJson,
    SaveMeasures,
    LabReport,
    /// The page with the bookmarklet that saves shaders from the site.
    Bookmarklet,
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
    Theme(Theme),
    ZoomIn,
    ZoomOut,
    ZoomReset,
    Settings,
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
    /// Finds in every text of the project, or in the one in front.
    FindEverywhere,
    GoToLine,
    NextProblem,
    PreviousProblem,
    FontLarger,
    FontSmaller,
    FontReset,
    WordWrap,
    /// Edits are compiled when they are saved, or while one types.
    CompileOnSave,
    /// The value of the expression at the caret instead of the picture, or the picture again.
    Probe,
    /// The next click on the picture says which pixel is traced.
    TracePixel,
    /// Says where the first NaN comes from.
    FindNonfinite,
    Trace(TraceAction),
    Time(TimeAction),
    Picture(PictureAction),
    Layout(LayoutAction),
    Quit,
    /// In the text that has the keyboard, or had it last.
    Code(EditorAction),
}
