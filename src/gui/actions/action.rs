//! Everything that a key, a menu or the palette can trigger.
//!
//! Actions of one part of the window have an enum of their own.

use crate::{
    debugger::trace::travel::{Direction, StepKind},
    gui::{dock::Side, editor::EditorAction, geometry::Shape, panels::Panel, settings::Theme},
};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Action {
    Compile,
    Save,
    SaveAs,
    Open,
    OpenFolder,
    /// Toggles whether an external change of a file resets time and buffers.
    ResetOnReload,
    AddCommon,
    /// Adds the next free buffer.
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
    /// Toggles the microphone for channels that read it.
    Microphone,
    /// Chooses a recording of input to play.
    PlayRecording,
    StopReplay,
    ExportJson,
    /// Opens a shader of another program as a new project in Shadertoy's form.
    Convert,
    ExportPage,
    SaveMeasures,
    SaveSound,
    LabReport,
    /// Opens the page with the bookmarklet that saves shaders from Shadertoy.
    Bookmarklet,
    /// Compares single with double precision, and finds undefined results.
    Audit,
    /// Shows what pixels and lines cost.
    CountCost,
    TraceCostliest,
    Fullscreen,
    /// Toggles code over a picture that fills the window.
    Present,
    /// Opens or closes a panel.
    Panel(Panel),
    /// Restores the default layout of the panels.
    ResetLayout,
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
    FindWord,
    /// Toggles finding only in the text that is selected.
    FindInSelection,
    ReplaceAll,
    /// Toggles finding in every text of the project instead of the one in front.
    FindEverywhere,
    GoToLine,
    /// Lists the declarations of the project's texts.
    GoToSymbol,
    /// Applies the fixes of all problems that have exactly one.
    FixAll,
    NextProblem,
    PreviousProblem,
    FontLarger,
    FontSmaller,
    FontReset,
    WordWrap,
    /// Toggles whether edits are compiled when they are saved or while typing.
    CompileOnSave,
    /// Toggles between the value of the expression at the caret and the picture.
    Probe,
    /// Lets the next click on the picture choose the pixel to trace.
    TracePixel,
    /// Finds the origin of the first NaN.
    FindNonfinite,
    Trace(TraceAction),
    Time(TimeAction),
    Picture(PictureAction),
    Layout(LayoutAction),
    Quit,
    /// An action of the text that has the keyboard focus, or had it last.
    Code(EditorAction),
}

/// Actions of the panel that has the keyboard focus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LayoutAction {
    /// Resizes the panel: narrower, wider, lower or higher for left, right, up and down.
    Resize(Side),
    /// Moves the panel to an edge of the window.
    Move(Side),
    /// Moves the panel into the place of the next panel.
    Share,
    Close,
}

/// Actions of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TimeAction {
    /// Opens the menu with the field for the time.
    GoTo,
    Slower,
    Faster,
    ResetSpeed,
    /// Toggles a fixed time step.
    FixedStep,
    /// Sets the start of the loop to the current time.
    LoopFrom,
    LoopTo,
    LoopOff,
    /// Toggles whether new code draws the same frame from the same inputs.
    KeepInputs,
}

/// Actions of the debugger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TraceAction {
    Go(StepKind, Direction),
    /// Continues to the next breakpoint.
    Continue(Direction),
    /// Runs to the line of the caret.
    ToCursor(Direction),
    /// Goes to the start or the end of the trace.
    End(Direction),
    /// Toggles a breakpoint at the line of the caret.
    Breakpoint,
}

/// Actions of the picture: its size, its aspect ratio, and how to handle a slow frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PictureAction {
    Shape(Shape),
    Scale(Scale),
    /// Sets a fixed size in pixels.
    Size((u32, u32)),
    /// Opens the field for any size.
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

/// The available scales.
pub(crate) const SCALES: [Scale; 6] = [Scale(16), Scale(8), Scale(6), Scale(4), Scale(2), Scale(1)];
/// The available sizes.
pub(crate) const SIZES: [(u32, u32); 8] =
    [(256, 144), (640, 360), (800, 450), (1280, 720), (1920, 1080), (3840, 2160), (512, 512), (1024, 1024)];
