//! Commands are what a front end asks of a [`Session`](super::Session); questions and requests are what the session
//! asks back.

use super::{
    buffers::BufferWatch,
    films::FilmOrder,
    playback::TimeRange,
    probe::{ProbeLook, ProbePlace},
    view::Level,
};
use eddy_control::midi::MidiChoice;
use eddy_playback::{comparing::Baseline, scene::Scene};
use eddy_project::{Channel, ControlTarget, CustomUniformValue, InputKind, Origin, PassEdit, PassName, Project, Tab};
use std::{net::SocketAddr, path::PathBuf, sync::Arc, time::Duration};

/// Something the user did. Takes effect in [`Session::apply`](super::Session::apply); what needs time (compiling,
/// reloading, drawing) happens in later ticks.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Opens what the command line calls PROJECT: a folder, a `.glsl` or `.json` file, or a preset's name.
    Open(String),
    /// A project that was made in memory, with the canvas size it is made for, until another project is opened. Its
    /// origin is [`Origin::Unsaved`](eddy_project::Origin::Unsaved).
    OpenProject {
        project: Box<Project>,
        size: Option<(u32, u32)>,
    },
    /// Opens what a text is or names: Shadertoy JSON, GLSL, a path.
    Paste(String),
    /// Takes files that a person brings: projects are opened; pictures and models go into the open one, to a pass and a
    /// channel of it if these are named, or begin a new one where none is shown.
    Bring {
        paths: Vec<PathBuf>,
        to: Option<(PassName, Option<usize>)>,
    },
    /// A new project of one Image pass.
    New,
    /// Writes the project where it came from. What has no such place (new, preset, JSON) leads to
    /// [`Request::SaveAs`].
    Save,
    /// Writes the project into a folder, which becomes its origin. A folder that holds other project files leads to
    /// [`Question::Overwrite`].
    SaveAs(PathBuf),
    /// Writes the project as Shadertoy JSON, and leaves it where it is. What that form cannot say, and a file that is
    /// there, lead to [`Question::Export`].
    ExportJson(PathBuf),
    /// Writes the project as an HTML file that plays it in a browser, and leaves it where it is. What the page cannot show,
    /// and a file that is there, lead to [`Question::Export`].
    ExportPage(PathBuf),
    /// The folder picker of [`Request::SaveAs`] was closed without a choice.
    SaveAsCancelled,
    /// The whole new text of a tab. Compiles a while after the last one, or at once where that is fast.
    EditText {
        tab: Tab,
        text: String,
    },
    /// The tab that is being edited: its text is analysed after each change, see
    /// [`Session::analysis`](super::Session::analysis).
    BringToFront(Tab),
    /// Edits of texts are compiled when they are saved, or by [`Command::CompileNow`], and not a while after they are
    /// typed.
    SetCompileOnSave(bool),
    /// PNG images are saved with the project in them, which opens again from there.
    SetProjectInPictures(bool),
    /// Compiles at once.
    CompileNow,
    /// The person turns a device that channels read on or off: see [`DeviceConsent`](super::DeviceConsent).
    UseDevice {
        kind: InputKind,
        on: bool,
    },
    /// Chooses one of [`Session::cameras`](super::Session::cameras) by its id, and turns it on.
    ChooseCamera(String),
    /// Lets time run.
    Play,
    /// Lets time stand still.
    Pause,
    /// The one or the other.
    TogglePlay,
    /// Something covers the picture: while it does, time stands still though nobody has paused it.
    Cover(bool),
    /// The window cannot be seen: nothing is heard either, and time goes on from here when it can be seen again.
    Hide(bool),
    /// The volume, from 0 to 1.
    SetVolume(f32),
    SetMute(bool),
    /// The device that plays, by its name; `None`: the system's default one.
    SetAudioOutput(Option<String>),
    /// Opens the device that plays although the run before ended while it was being opened.
    OpenSoundAgain,
    /// The device that records.
    SetAudioInput(Option<String>),
    /// Looks which devices there are: see [`Session::audio_devices`](super::Session::audio_devices).
    ListAudioDevices,
    /// Records by the microphone for channels that read it, until this is taken back or another project opens. Nothing but a person
    /// asks for it.
    UseMicrophone(bool),
    /// Listens to OSC at an address; `None`: no longer. Nothing but a person asks for it.
    SetOsc(Option<SocketAddr>),
    /// Listens to MIDI devices. Nothing but a person asks for it.
    SetMidi(MidiChoice),
    /// Reads gamepads. Nothing but a person asks for it.
    SetGamepads(bool),
    /// Looks which devices there are: see [`Session::controls_view`](super::Session::controls_view).
    ListMidiDevices,
    /// Has the control that moves next move a number of a uniform; `None`: waits no longer.
    LearnControl(Option<ControlTarget>),
    /// No control moves it any more.
    ForgetControl(ControlTarget),
    /// Draws nothing more of the open project before [`Command::Play`], [`Command::Step`] or [`Command::GoOn`]: right
    /// after [`Command::Open`], nothing at all.
    Hold,
    /// Ends a [`Halt`](super::Halt): what is drawn now may take its time.
    GoOn,
    /// Ends it with fewer pixels.
    DrawSmaller,
    /// Ends it with the newest code that was fast enough. The texts stay as they are.
    DrawLastGood,
    /// Draws one frame and pauses: 1/60 s later than the one before.
    Step,
    /// Draws the frame again that is so many before the newest, with the buffers as they were then, and pauses. One
    /// that is out of reach is told of in a notice.
    StepBack(usize),
    /// Shows the picture at a time, in seconds. A project with a state is drawn again from the inputs that its frames
    /// had, or on at a fixed step up to a later time. Playing or paused stays as it is.
    Seek(f64),
    /// Seconds of `iTime` in a second, above 0.
    SetSpeed(f64),
    /// Has every frame take the same time, so many in a second of `iTime`; `None`: as long as it really takes.
    SetFixedRate(Option<f64>),
    /// Plays a range of time again and again.
    SetTimeRange(Option<TimeRange>),
    /// Says whether new code draws all frames since the last reset again from the same inputs, and so shows the same
    /// frame. Not across another canvas size.
    SetKeepInputs(bool),
    /// Time, frame and every buffer to zero. Keyboard toggles and the mouse stay.
    Reset,
    /// Size in physical pixels of the area the picture may fill.
    SetViewport {
        width: u32,
        height: u32,
    },
    /// Canvas pixels to viewport pixels: 0.5 draws a quarter as many.
    SetScale(f32),
    /// A canvas size that does not follow the viewport; `None` follows it again.
    SetFixedSize(Option<(u32, u32)>),
    /// Sets what `iChannel{index}` of a pass reads, with its sampler.
    SetChannel {
        pass: PassName,
        index: usize,
        channel: Option<Channel>,
    },
    /// Turns one of the author's own uniforms, within its range; `None` is the default. Compiles nothing.
    SetCustomUniform {
        name: String,
        value: Option<CustomUniformValue>,
    },
    /// The same as a person writes it: `viscosity=0.3`. What cannot be set so is told in a notice.
    AssignCustomUniform(String),
    /// All of them to their defaults.
    ResetCustomUniforms,
    /// Adds Common or a pass with a starting text. One that exists already stays as it is.
    AddTab(Tab),
    /// Edits the passes: their names and order, how they are drawn and read, which of them there are. What cannot be is
    /// told in a notice.
    EditPasses(PassEdit),
    /// Takes back the newest edit of passes or channels; what was typed since stays.
    UndoPassEdit,
    /// Does it again.
    RedoPassEdit,
    /// The pointer in canvas pixels from the bottom left: `y = height - py` for a `py` from the top. Whole pixels are
    /// made of them as the site does.
    MouseDown {
        x: f32,
        y: f32,
    },
    /// The same while the button is down or up.
    MouseMove {
        x: f32,
        y: f32,
    },
    /// The button is released.
    MouseUp,
    /// JavaScript `keyCode`. Auto-repeat may be passed on; it does nothing.
    KeyDown(u8),
    /// JavaScript `keyCode`.
    KeyUp(u8),
    /// The window got or lost the keyboard.
    Focus(bool),
    /// Writes the shown pass as a PNG at its own size; the path comes as a notice. See
    /// [`capture`](super::capture) for where to.
    Screenshot,
    /// Writes the shown pass's float texels as `.npy`, likewise.
    SaveTexels,
    /// Holds pixels of the shown pass, as its newest frame has them, against double precision and looks for what GLSL
    /// leaves undefined. What is found is in [`Session::diagnostics`](super::Session::diagnostics) until the next
    /// compile.
    Audit,
    /// Begins anew at frame 0 and records the inputs of every frame; the second time, ends that and writes them beside
    /// the pictures, for `eddy render --replay`.
    Record,
    /// Makes a film: of a range of frames, drawn beside the picture, or of what is drawn from now on. See
    /// [`Session::film`](super::Session::film).
    MakeFilm(Box<FilmOrder>),
    /// Ends a recording of what is drawn, and completes its file.
    StopFilm,
    /// Ends whatever film is made, and leaves nothing of it.
    CancelFilm,
    /// Looks which encoders ffmpeg has: see [`Session::film_facts`](super::Session::film_facts).
    FindEncoders,
    /// Plays the input of such a file in the open project, from frame 0 on: see
    /// [`Session::replay`](super::Session::replay). A file that cannot be played is told of in a notice.
    PlayRecording(PathBuf),
    /// Ends that. The picture goes on from the frame that is shown.
    StopReplay,
    /// Shows a pass, which is captured then too.
    ShowPass(PassName),
    /// Draws the value of an expression instead of the picture; `None`: the picture again. See
    /// [`Session::probe`](super::Session::probe).
    Probe(Option<ProbePlace>),
    /// Shows its values in another way.
    LookAtProbe(ProbeLook),
    /// Traces the pixel of the shown pass at a place of its picture, from 0 to 1 across and up, and pauses; `None`:
    /// none any more. See [`Session::trace`](super::Session::trace).
    Trace(Option<[f32; 2]>),
    /// Shows the errors of the audited pixels no more.
    HideAudit,
    /// Looks for the first assignment of the traced pixel that comes out otherwise on the device, beside the picture. See
    /// [`Session::parting`](super::Session::parting).
    FindDivergence,
    /// Says whether somebody looks at what each pass costs: only then is it gathered. See
    /// [`Session::pass_costs`](super::Session::pass_costs).
    WatchCosts(bool),
    /// Says which targets of passes somebody sees small: only those are read back. See
    /// [`Session::miniature`](super::Session::miniature).
    WatchTargets(Vec<(PassName, usize)>),
    /// Says what somebody looks at closely: only that is read back, and nothing with the default. See
    /// [`Session::buffer`](super::Session::buffer) and [`Session::texels_under`](super::Session::texels_under).
    WatchBuffers(BufferWatch),
    /// Says which comments that ask for a number somebody looks at, by their serials: only those are measured. See
    /// [`Session::measures`](super::Session::measures).
    WatchMeasures(Vec<u64>),
    /// Forgets what has been measured so far.
    ClearMeasures,
    /// Writes it as CSV beside the pictures; the path comes as a notice.
    SaveMeasures,
    /// Writes the whole sound pass as WAV beside the pictures; the path comes as a notice.
    SaveSound,
    /// Looks through the frames that are kept for the first NaN or infinity, beside the picture, which goes on; `false`
    /// ends that. See [`Session::search`](super::Session::search).
    FindNonfinite(bool),
    /// Draws the frames since the reset once more beside the picture, by this project and by what it is compared with,
    /// from the same inputs; `None` ends that. See [`Session::comparison`](super::Session::comparison).
    Compare(Option<Baseline>),
    /// A frame that takes longer pauses the picture.
    SetFrameLimit(Duration),
    /// Says whether a reload from disk starts time and buffers anew.
    SetResetOnReload(bool),
    /// The answer to [`Session::question`](super::Session::question). One that does not fit it changes nothing.
    Answer(Answer),
    /// Takes away the notice of this number.
    DismissNotice(u64),
    /// Says something of the front end's own in a notice.
    Notify {
        level: Level,
        text: String,
        path: Option<PathBuf>,
    },
    /// The user wants to leave. Leads to [`Request::Exit`], after a question if something is unsaved.
    Close,
}

/// A modal question. The first one stands until it is answered; further ones wait.
#[derive(Clone, Debug, PartialEq)]
pub enum Question {
    /// Unsaved changes stand before `then`. Answers: Save, Discard, Cancel.
    Unsaved { then: PendingAction, tabs: Vec<Tab> },
    /// A text changed on disk while its tab had unsaved edits. Answers: KeepMine, TakeDisk, SaveMineAs, and each keeps
    /// the other text: the one not taken is written beside the file (`image.glsl.mine-0001`, `image.glsl.disk-0001`).
    Conflict {
        /// `None` for `eddy.toml`: channels and passes.
        tab: Option<Tab>,
        file: PathBuf,
        mine: Arc<str>,
        disk: Arc<str>,
        /// Every line from `disk` to `mine`.
        diff: Vec<DiffLine>,
    },
    /// The folder of a Save As already holds these files, which would be replaced: all of them. Answers: Overwrite,
    /// which keeps a copy of each for [`KEPT_DAYS`](super::KEPT_DAYS) days, and Cancel.
    Overwrite { folder: PathBuf, files: Vec<PathBuf> },
    /// A JSON or HTML file that was to be written is there, or cannot say everything of the project: `lost` has a sentence for
    /// each thing. Answers: Export, which keeps a copy of what is replaced for [`KEPT_DAYS`](super::KEPT_DAYS) days, and
    /// Cancel.
    Export { file: PathBuf, exists: bool, lost: Vec<String> },
    /// A film is not complete yet, and the window is to be closed. Answers: Finish, which closes it then, Discard, which
    /// leaves nothing of the film, and Cancel.
    Film {
        /// It is recorded, and not drawn offline.
        is_live: bool,
    },
    /// An Eddy that ended early left unsaved work behind. Answers: Recover, Discard, Cancel, which leaves it for later.
    Recover(Box<Recovered>),
}

/// Unsaved work that was left behind, as a question shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovered {
    /// The recovery file.
    pub file: PathBuf,
    /// The project's name.
    pub name: String,
    /// The place that saving will write to.
    pub origin: Origin,
    /// Day and time of the last change, as people write it.
    pub written: String,
    pub tabs: Vec<RecoveredTab>,
    /// Passes, channels or sliders differ from the disk's.
    pub is_structure_changed: bool,
    /// The reason why the project cannot be read from its place any more. Its work is new and without a place then.
    pub trouble: Option<String>,
}

/// A tab whose text is not the disk's.
#[derive(Clone, Debug, PartialEq)]
pub struct RecoveredTab {
    pub tab: Tab,
    /// Every line from the disk's text to the unsaved one.
    pub diff: Vec<DiffLine>,
}

/// The action that goes on once nothing unsaved stands in the way.
#[derive(Clone, Debug, PartialEq)]
pub enum PendingAction {
    Open(String),
    OpenProject {
        project: Box<Project>,
        size: Option<(u32, u32)>,
    },
    /// The project of a picture, at its frame.
    OpenPicture(Box<Scene>),
    New,
    /// A project that lies nowhere else: it counts as unsaved.
    Keep(Box<Project>),
    /// Takes up the unsaved work in a recovery file.
    Recover(PathBuf),
    Close,
}

/// An answer to a [`Question`].
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    Save,
    Discard,
    Cancel,
    KeepMine,
    TakeDisk,
    /// Writes my text to a new file of this path (never over an existing one), then takes the one on disk.
    SaveMineAs(PathBuf),
    Overwrite,
    Export,
    Recover,
    /// Completes the film first.
    Finish,
}

/// One line of a diff.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DiffLine {
    Both(String),
    /// Only in the text on disk.
    Disk(String),
    /// Only in the tab.
    Mine(String),
}

/// Something only a front end can do; taken with [`Session::take_request`](super::Session::take_request).
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// Ask for a folder and answer with [`Command::SaveAs`] or [`Command::SaveAsCancelled`].
    SaveAs { suggested_name: String },
    /// Close the window: nothing unsaved is left, or the user said to discard it.
    Exit,
}
