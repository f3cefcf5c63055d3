//! Commands are what a front end requests of a [`Session`](super::Session); [questions and requests](question) are what the
//! session asks back.

mod question;

pub use question::{Answer, DiffLine, PendingAction, Question, Recovered, RecoveredTab, Request};

use super::{
    buffers::BufferWatch,
    films::FilmOrder,
    playback::TimeRange,
    probe::{ProbeLook, ProbePlace},
    recent::KeptBreakpoint,
    tune::TuneOptions,
    view::Level,
};
use eddy_control::midi::MidiChoice;
use eddy_playback::comparing::Baseline;
use eddy_project::{Channel, ControlTarget, CustomUniformValue, InputKind, PassEdit, PassName, Project, Tab};
use std::{net::SocketAddr, path::PathBuf, time::Duration};

/// An action of the user. Takes effect in [`Session::apply`](super::Session::apply); slow work (compiling, reloading,
/// drawing) happens in later ticks. Each group is applied by the owner of what it changes.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    File(FileCommand),
    Edit(EditCommand),
    Transport(TransportCommand),
    Halt(HaltCommand),
    Canvas(CanvasCommand),
    Input(InputCommand),
    Sound(SoundCommand),
    Control(ControlCommand),
    Camera(CameraCommand),
    Capture(CaptureCommand),
    Film(FilmCommand),
    View(ViewCommand),
    Tool(ToolCommand),
    Notice(NoticeCommand),
}

/// Opening, saving, exporting and closing.
#[derive(Clone, Debug, PartialEq)]
pub enum FileCommand {
    /// Opens what the command line calls PROJECT: a folder, a `.glsl` or `.json` file, or a preset's name.
    Open(String),
    /// Opens a project made in memory with the canvas size that it is made for, until another project is opened. Its
    /// origin is [`Origin::Unsaved`](eddy_project::Origin::Unsaved).
    OpenProject { project: Box<Project>, size: Option<(u32, u32)> },
    /// Opens what a text contains or names: Shadertoy JSON, GLSL, a path.
    Paste(String),
    /// Imports files that the user drops or picks: projects are opened; pictures and models are added to the open
    /// project, in a pass and a channel of it if these are named, or start a new project if none is shown.
    Bring { paths: Vec<PathBuf>, to: Option<(PassName, Option<usize>)> },
    /// Opens a new project of one Image pass.
    New,
    /// Writes the project to where it came from. A project without such a place (new, preset, JSON) leads to
    /// [`Request::SaveAs`].
    Save,
    /// Writes the project into a folder, which becomes its origin. A folder that contains other project files leads to
    /// [`Question::Overwrite`].
    SaveAs(PathBuf),
    /// Writes the project as Shadertoy JSON; its origin stays. Features that JSON cannot express, or an existing file,
    /// lead to [`Question::Export`].
    ExportJson(PathBuf),
    /// Opens a shader of another program as a new project in Shadertoy's form.
    Convert,
    /// Writes the project as an HTML file that plays it in a browser; its origin stays. Features that the page cannot
    /// show, or an existing file, lead to [`Question::Export`].
    ExportPage(PathBuf),
    /// The folder picker of [`Request::SaveAs`] was closed without a choice.
    SaveAsCancelled,
    /// Answers [`Session::question`](super::Session::question). An answer that does not fit the question changes
    /// nothing.
    Answer(Answer),
    /// The user wants to quit. Leads to [`Request::Exit`], after a question if something is unsaved.
    Close,
    /// The system wants the program to quit, at logout for instance. Leads to [`Request::Exit`] at once: unsaved work is
    /// kept, and offered at the next start.
    Terminate,
}

/// Edits of texts, passes, channels and uniforms, and their compilation.
#[derive(Clone, Debug, PartialEq)]
pub enum EditCommand {
    /// Sets the whole text of a tab. It is compiled a while after the last edit, or at once if compiling is fast.
    EditText { tab: Tab, text: String },
    /// Sets the tab that is being edited: its text is analysed after each change, see
    /// [`Session::analysis`](super::Session::analysis).
    BringToFront(Tab),
    /// Compiles edits when they are saved or by [`EditCommand::CompileNow`], instead of a while after typing.
    SetCompileOnSave(bool),
    /// Compiles at once.
    CompileNow,
    /// Reads the included files again: the folders of libraries have changed.
    ReadIncludes,
    /// Sets what `iChannel{index}` of a pass reads, with its sampler.
    SetChannel { pass: PassName, index: usize, channel: Option<Channel> },
    /// Sets one of the author's own uniforms, within its range; `None` is the default. Does not recompile.
    SetCustomUniform { name: String, value: Option<CustomUniformValue> },
    /// The same as text: `viscosity=0.3`. An invalid assignment is reported in a notice.
    AssignCustomUniform(String),
    /// Resets all of them to their defaults.
    ResetCustomUniforms,
    /// Adds Common or a pass with a starting text. An existing one is unchanged.
    AddTab(Tab),
    /// Edits the passes: their names, order, rendering and sampling, and which of them exist. An impossible edit is
    /// reported in a notice.
    EditPasses(PassEdit),
    /// Undoes the newest edit of passes or channels; text typed since then stays.
    UndoPassEdit,
    /// Redoes it.
    RedoPassEdit,
    /// Sets whether a reload from disk resets time and buffers.
    SetResetOnReload(bool),
}

/// Time: playing, pausing, seeking, recording and replaying.
#[derive(Clone, Debug, PartialEq)]
pub enum TransportCommand {
    /// Starts time.
    Play,
    /// Pauses time.
    Pause,
    /// Plays if paused, pauses if playing.
    TogglePlay,
    /// Draws one frame, 1/60 s after the previous one, and pauses.
    Step,
    /// Draws the frame again that is this number of frames before the newest, with the buffers as they were then, and
    /// pauses. A frame that is out of reach is reported in a notice.
    StepBack(usize),
    /// Shows the picture at a time, in seconds. A project with state is drawn again from the recorded inputs of its
    /// frames, or ahead at a fixed step for a later time. Keeps playing or paused.
    Seek(f64),
    /// Sets the seconds of `iTime` per second, above 0.
    SetSpeed(f64),
    /// Makes every frame take the same time, this number of them per second of `iTime`; `None`: the real time.
    SetFixedRate(Option<f64>),
    /// Loops a range of time.
    SetTimeRange(Option<TimeRange>),
    /// Sets whether new code draws all frames since the last reset again from the same inputs, and so shows the same
    /// frame. Not with a different canvas size.
    SetKeepInputs(bool),
    /// Resets time, frame and every buffer to zero. Keyboard toggles and the mouse stay.
    Reset,
    /// Restarts at frame 0 and records the inputs of every frame; the second time, stops and writes them next to the
    /// pictures, for `eddy render --replay`.
    Record,
    /// Plays the input of such a recording in the open project, from frame 0: see
    /// [`Session::replay`](super::Session::replay). A file that cannot be played is reported in a notice.
    PlayRecording(PathBuf),
    /// Stops the replay. The picture continues from the frame that is shown.
    StopReplay,
}

/// Choices for a picture that is too slow, or is not drawn yet.
#[derive(Clone, Debug, PartialEq)]
pub enum HaltCommand {
    /// Draws nothing more of the open project before [`TransportCommand::Play`], [`TransportCommand::Step`] or [`HaltCommand::GoOn`]: right
    /// after [`FileCommand::Open`], nothing at all.
    Hold,
    /// Ends a [`Halt`](super::Halt) and allows the frame to be slow.
    GoOn,
    /// Ends it with fewer pixels.
    DrawSmaller,
    /// Ends it with the newest code that was fast enough. The texts are unchanged.
    DrawLastGood,
    /// Sets the time after which a frame pauses the picture, as in [`frame_limit`](crate::frame_limit).
    SetFrameLimit(Duration),
}

/// The size of the picture, and whether it can be seen.
#[derive(Clone, Debug, PartialEq)]
pub enum CanvasCommand {
    /// Size in physical pixels of the area that the picture may fill.
    SetViewport { width: u32, height: u32 },
    /// Ratio of canvas pixels to viewport pixels: 0.5 draws a quarter as many.
    SetScale(f32),
    /// A canvas size that does not follow the viewport; `None` follows it again.
    SetFixedSize(Option<(u32, u32)>),
    /// Something covers the picture: until it is uncovered, time is stopped without being paused.
    Cover(bool),
    /// The window is not visible: sound stops as well, and time continues from here when the window is visible again.
    Hide(bool),
}

/// The shader's mouse and keyboard.
#[derive(Clone, Debug, PartialEq)]
pub enum InputCommand {
    /// The pointer in canvas pixels from the bottom left: `y = height - py` for a `py` from the top. It is rounded to
    /// whole pixels as Shadertoy does.
    MouseDown { x: f32, y: f32 },
    /// The same while the button is down, or up if the program gives the pointer to the shader at all times.
    MouseMove { x: f32, y: f32 },
    /// The button is released.
    MouseUp,
    /// JavaScript `keyCode`. Auto-repeat may be passed on; it does nothing.
    KeyDown(u8),
    /// JavaScript `keyCode`.
    KeyUp(u8),
    /// The window gained or lost keyboard focus.
    Focus(bool),
}

/// Sound output and the microphone.
#[derive(Clone, Debug, PartialEq)]
pub enum SoundCommand {
    /// The volume, from 0 to 1.
    SetVolume(f32),
    SetMute(bool),
    /// Selects the output device by its name; `None`: the system's default device.
    SetAudioOutput(Option<String>),
    /// Opens the output device although the previous run crashed while opening it.
    OpenSoundAgain,
    /// Selects the input device.
    SetAudioInput(Option<String>),
    /// Lists the audio devices: see [`Session::audio_devices`](super::Session::audio_devices).
    ListAudioDevices,
    /// Records from the microphone for channels that read it, until this is turned off or another project opens. Only
    /// the user enables it.
    UseMicrophone(bool),
}

/// OSC, MIDI and gamepads.
#[derive(Clone, Debug, PartialEq)]
pub enum ControlCommand {
    /// Listens to OSC at an address; `None` stops it. Only the user enables it.
    SetOsc(Option<SocketAddr>),
    /// Listens to MIDI devices. Only the user enables it.
    SetMidi(MidiChoice),
    /// Reads gamepads. Only the user enables it.
    SetGamepads(bool),
    /// Lists the MIDI devices: see [`Session::controls_view`](super::Session::controls_view).
    ListMidiDevices,
    /// Binds the next control that moves to a component of a uniform; `None` cancels it.
    LearnControl(Option<ControlTarget>),
    /// Removes the binding of a uniform's control.
    ForgetControl(ControlTarget),
}

/// Cameras, which are off until the user turns them on for the open project.
#[derive(Clone, Debug, PartialEq)]
pub enum CameraCommand {
    /// Turns a device that channels read on or off: see [`DeviceConsent`](super::DeviceConsent).
    UseDevice { kind: InputKind, on: bool },
    /// Chooses one of [`Session::cameras`](super::Session::cameras) by its id, and turns it on.
    ChooseCamera(String),
}

/// Pictures and sound that are written to new files.
#[derive(Clone, Debug, PartialEq)]
pub enum CaptureCommand {
    /// Writes the shown pass as a PNG at its own size; a notice names the path. See [`capture`](super::capture) for the
    /// folder.
    Screenshot,
    /// Writes the shown pass's float texels as `.npy`, likewise.
    SaveTexels,
    /// Writes the whole sound pass as WAV next to the pictures; a notice names the path.
    SaveSound,
    /// Embeds the project in PNG images, from which it opens again.
    SetProjectInPictures(bool),
}

/// Films: of what is played, and of a range of frames.
#[derive(Clone, Debug, PartialEq)]
pub enum FilmCommand {
    /// Makes a film: of a range of frames, drawn in the background, or of the frames drawn from now on. See
    /// [`Session::film`](super::Session::film).
    MakeFilm(Box<FilmOrder>),
    /// Ends a live recording, and completes its file.
    StopFilm,
    /// Cancels the film in progress and removes its files.
    CancelFilm,
    /// Queries the encoders of ffmpeg: see [`Session::film_facts`](super::Session::film_facts).
    FindEncoders,
}

/// The content of the picture, and the read-backs that panels watch.
#[derive(Clone, Debug, PartialEq)]
pub enum ViewCommand {
    /// Shows a pass; captures are of this pass too.
    ShowPass(PassName),
    /// Draws the value of an expression instead of the picture; `None` shows the picture again. See
    /// [`Session::probe`](super::Session::probe).
    Probe(Option<ProbePlace>),
    /// Changes how probed values are displayed.
    LookAtProbe(ProbeLook),
    /// Sets whether a view shows the cost of each pass: costs are gathered only then. See
    /// [`Session::pass_costs`](super::Session::pass_costs).
    WatchCosts(bool),
    /// Sets the targets whose miniatures are visible: only those are read back. See
    /// [`Session::miniature`](super::Session::miniature).
    WatchTargets(Vec<(PassName, usize)>),
    /// Sets what is inspected: only that is read back, and nothing by default. See
    /// [`Session::buffer`](super::Session::buffer) and [`Session::texels_under`](super::Session::texels_under).
    WatchBuffers(BufferWatch),
    /// Sets the measuring comments whose numbers are visible, by their serials: only those are measured. See
    /// [`Session::measures`](super::Session::measures).
    WatchMeasures(Vec<u64>),
    /// Clears all measured values.
    ClearMeasures,
    /// Writes them as CSV next to the pictures; a notice names the path.
    SaveMeasures,
}

/// Tools that inspect or compare what was drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum ToolCommand {
    /// Compares pixels of the newest frame of the shown pass with double precision and looks for what GLSL leaves
    /// undefined. The findings are in [`Session::diagnostics`](super::Session::diagnostics) until the next compile.
    Audit,
    /// Hides the errors of the audited pixels.
    HideAudit,
    /// Counts what the pixels of the shown pass execute whenever the picture rests, and pauses; `false` ends that. See
    /// [`Session::counts`](super::Session::counts).
    Count(bool),
    /// Traces the pixel of the shown pass at a place of its picture, from 0 to 1 across and up, and pauses; `None` ends
    /// the trace. See [`Session::trace`](super::Session::trace).
    Trace(Option<[f32; 2]>),
    /// Sets the debugger's breakpoints, which are kept until the project is opened again. See
    /// [`Session::kept_breakpoints`](super::Session::kept_breakpoints).
    KeepBreakpoints(Vec<KeptBreakpoint>),
    /// Looks in the background for the first assignment of the traced pixel that differs on the device. See
    /// [`Session::parting`](super::Session::parting).
    FindDivergence,
    /// Searches the kept frames for the first NaN or infinity, in the background; `false` ends that. See
    /// [`Session::search`](super::Session::search).
    FindNonfinite(bool),
    /// Draws the frames since the reset again in the background, by this project and by the baseline, from the same
    /// inputs; `None` ends that. See [`Session::comparison`](super::Session::comparison).
    Compare(Option<Baseline>),
    /// Searches in the background for cheaper settings of the project's quality constants; `None` ends that. See
    /// [`Session::tuning`](super::Session::tuning).
    Tune(Option<TuneOptions>),
}

/// Notices.
#[derive(Clone, Debug, PartialEq)]
pub enum NoticeCommand {
    /// Removes the notice with this number.
    DismissNotice(u64),
    /// Shows a notice of the front end.
    Notify { level: Level, text: String, path: Option<PathBuf> },
}

macro_rules! group {
    ($($name:ident($group:ident)),*) => {
        $(impl From<$group> for Command {
            fn from(command: $group) -> Self {
                Command::$name(command)
            }
        })*
    };
}

group!(
    File(FileCommand),
    Edit(EditCommand),
    Transport(TransportCommand),
    Halt(HaltCommand),
    Canvas(CanvasCommand),
    Input(InputCommand),
    Sound(SoundCommand),
    Control(ControlCommand),
    Camera(CameraCommand),
    Capture(CaptureCommand),
    Film(FilmCommand),
    View(ViewCommand),
    Tool(ToolCommand),
    Notice(NoticeCommand)
);
