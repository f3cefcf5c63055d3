//! Everything that a key, a menu or the palette can ask for.
//!
//! Actions of one part of the window have an enum of their own.

use crate::{
    debugger::trace::travel::{Direction, Stride},
    gui::{
        dock::{Panel, Side},
        editor::EditorAction,
        geometry::Shape,
        settings::Theme,
    },
};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Action {
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
    Mute,
    /// Switches the microphone on or off for channels that read it.
    Microphone,
    /// Chooses a recording, whose input is played.
    PlayRecording,
    StopReplay,
    ExportJson,
    ExportPage,
    SaveMeasures,
    SaveSound,
    LabReport,
    /// The page with the bookmarklet that saves shaders from the site.
    Bookmarklet,
    /// Single against double precision, and what is undefined.
    Audit,
    Fullscreen,
    /// Code over a picture that fills the window.
    Present,
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

/// Actions of the panel that has the keyboard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LayoutAction {
    /// Narrower, wider, lower, higher: to the left, to the right, up, down.
    Resize(Side),
    /// To an edge of the window.
    Move(Side),
    /// Into the place of the panel that comes next.
    Share,
    Close,
}

/// Actions of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TimeAction {
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

/// Actions of the debugger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TraceAction {
    Go(Stride, Direction),
    /// To the next breakpoint.
    Continue(Direction),
    /// To the line of the caret.
    ToCursor(Direction),
    /// To the start or the end of the trace.
    End(Direction),
    /// Sets a breakpoint at the line of the caret, or takes it away.
    Breakpoint,
}

/// Actions of the picture: its size, its shape, and what to do about a slow frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PictureAction {
    Shape(Shape),
    Scale(Scale),
    /// Always so many pixels.
    Size((u32, u32)),
    /// The field for any size.
    TypeSize,
    ResetUniforms,
    GoOn,
    Smaller,
    LastGood,
}

/// The size of the picture relative to the view, in eighths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scale(u8);

impl Scale {
    pub(crate) fn factor(self) -> f32 {
        f32::from(self.0) / 8.0
    }

    pub(crate) fn name(self) -> &'static str {
        match self.0 {
            16 => "2x",
            8 => "1x",
            6 => "3/4",
            4 => "1/2",
            2 => "1/4",
            _ => "1/8",
        }
    }
}

/// The scales that are offered.
pub(crate) const SCALES: [Scale; 6] = [Scale(16), Scale(8), Scale(6), Scale(4), Scale(2), Scale(1)];
/// The sizes that are offered.
pub(crate) const SIZES: [(u32, u32); 8] =
    [(256, 144), (640, 360), (800, 450), (1280, 720), (1920, 1080), (3840, 2160), (512, 512), (1024, 1024)];
