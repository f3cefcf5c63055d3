//! The table of actions.

use super::{
    Action, Entry, Group, LayoutAction, PictureAction, TimeAction, TraceAction,
    action::{SCALES, SIZES},
};
use crate::{
    debugger::trace::travel::{
        Direction::{self, Back, Forward},
        StepKind,
    },
    gui::{
        dock::Side,
        editor::{EditorAction as Code, Motion, Vertical},
        geometry::Shape,
        panels::Panel,
        settings::Theme,
    },
};

impl Action {
    /// Returns its name in the palette, the help and menus.
    pub(crate) fn title(self) -> &'static str {
        ACTIONS.iter().find(|e| e.action == self).map_or("", |e| e.title)
    }
}

const fn row(
    action: Action,
    name: &'static str,
    title: &'static str,
    keys: &'static [&'static str],
    group: Group,
) -> Entry {
    Entry { action, name, title, keys, group, synonyms: "" }
}

const fn code(action: Code, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Code(action), name, title, keys, Group::Code)
}

const fn go_on(
    stride: StepKind,
    way: Direction,
    name: &'static str,
    title: &'static str,
    keys: &'static [&'static str],
) -> Entry {
    row(Action::Trace(TraceAction::Go(stride, way)), name, title, keys, Group::Trace)
}

const fn trace(action: TraceAction, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Trace(action), name, title, keys, Group::Trace)
}

const fn time(action: TimeAction, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Time(action), name, title, keys, Group::Picture)
}

const fn picture(action: PictureAction, name: &'static str, title: &'static str) -> Entry {
    row(Action::Picture(action), name, title, &[], Group::Picture)
}

const fn layout(action: LayoutAction, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Layout(action), name, title, keys, Group::Window)
}

/// Returns the rows of a caret motion: plain, and with Shift, which selects.
const fn go(motion: Motion, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Code(Code::Go(motion)), name, title, keys, Group::Caret)
}

const fn select(motion: Motion, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Code(Code::Select(motion)), name, title, keys, Group::Caret)
}

const fn caret(action: Code, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Code(action), name, title, keys, Group::Caret)
}

/// Returns the keys for this system: a Mac moves by words with Option and to the ends of lines with Command.
const fn or_mac(keys: &'static [&'static str], mac: &'static [&'static str]) -> &'static [&'static str] {
    if cfg!(target_os = "macos") { mac } else { keys }
}

/// Keys are Shadertoy's if it has one, else those of VS Code. In the code, VS Code's take precedence: there Alt+Up
/// moves a line, while F5 plays and pauses everywhere.
pub(crate) const ACTIONS: &[Entry] = &with_panels();

/// Adds the actions that open and close panels, before those of the layout.
const fn with_panels() -> [Entry; OWN.len() + Panel::COUNT] {
    let mut all = [OWN[0]; OWN.len() + Panel::COUNT];
    let (mut own, mut panel) = (0, 0);
    while own + panel < all.len() {
        let is_next = own == OWN.len() || matches!(OWN[own].action, Action::ResetLayout);
        if is_next && panel < Panel::COUNT {
            all[own + panel] = Panel::action(panel);
            panel += 1;
        } else {
            all[own + panel] = OWN[own];
            own += 1;
        }
    }
    all
}

/// All other actions.
const OWN: &[Entry] = &[
    row(Action::Save, "save", "Save", &["Ctrl+S"], Group::Project).found_by("write store"),
    row(Action::SaveAs, "save-as", "Save as", &["Ctrl+Shift+S"], Group::Project).found_by("export copy duplicate"),
    row(Action::ExportJson, "export-json", "Export to Shadertoy JSON", &[], Group::Project)
        .found_by("save share upload file"),
    row(Action::Convert, "convert", "Convert to Shadertoy", &[], Group::Project)
        .found_by("isf glslviewer twigl bonzomatic sandbox mainimage port translate"),
    row(Action::ExportPage, "export-html", "Export to HTML page for browsers", &[], Group::Project)
        .found_by("save share web browser webgl publish site"),
    row(Action::Bookmarklet, "bookmarklet", "Open Shadertoy bookmarklet page", &[], Group::Project)
        .found_by("download import browser save json"),
    row(Action::Open, "open", "Open file", &["Ctrl+O"], Group::Project).found_by("load import project json"),
    row(Action::OpenFolder, "open-folder", "Open folder", &[], Group::Project).found_by("load import project"),
    row(Action::New, "new", "New shader", &["Ctrl+N"], Group::Project).found_by("create project"),
    row(Action::Paste, "paste", "Open from clipboard: Shadertoy JSON, GLSL or a path", &[], Group::Project)
        .found_by("import load"),
    row(Action::Gallery, "gallery", "Open preset gallery", &["Ctrl+Shift+G"], Group::Project)
        .found_by("examples samples templates start presets"),
    row(Action::ResetOnReload, "reset-on-reload", "Toggle reset when a file is reloaded", &[], Group::Project)
        .found_by("hot reload restart"),
    row(Action::AddCommon, "add-common", "Add Common, the code before every pass", &[], Group::Project)
        .found_by("new pass include shared"),
    row(Action::AddBuffer, "add-buffer", "Add buffer", &[], Group::Project).found_by("new pass"),
    row(Action::Quit, "quit", "Quit", &["Ctrl+Q"], Group::Project).found_by("exit close"),
    row(Action::TogglePlay, "play", "Play or pause", &["Alt+Up", "F5"], Group::Picture).found_by("start stop resume"),
    row(Action::Reset, "reset", "Reset time and buffers", &["Alt+Down", "Ctrl+Shift+F5"], Group::Picture)
        .found_by("restart rewind clear"),
    row(Action::StepBack, "step-back", "Step one frame back", &["Alt+,"], Group::Picture).found_by("previous frame"),
    row(Action::Step, "step", "Step one frame forward", &["Alt+."], Group::Picture).found_by("next frame advance"),
    time(TimeAction::GoTo, "go-to-time", "Go to time", &["Alt+G"]).found_by("seek jump"),
    time(TimeAction::Slower, "slower", "Halve playback speed", &[]).found_by("slow motion speed"),
    time(TimeAction::Faster, "faster", "Double playback speed", &[]).found_by("fast speed"),
    time(TimeAction::ResetSpeed, "usual-speed", "Reset playback speed", &[]).found_by("normal 1x"),
    time(TimeAction::FixedStep, "fixed-step", "Toggle fixed time step", &[]).found_by("deterministic fps"),
    time(TimeAction::LoopFrom, "loop-from", "Set loop start", &["Alt+["]).found_by("repeat range in"),
    time(TimeAction::LoopTo, "loop-to", "Set loop end", &["Alt+]"]).found_by("repeat range out"),
    time(TimeAction::LoopOff, "loop-off", "Clear loop", &[]),
    time(TimeAction::KeepInputs, "keep-inputs", "Toggle replay to this frame after an edit", &[]),
    row(Action::Mute, "mute", "Toggle mute", &["Alt+M"], Group::Picture).found_by("sound audio volume silence speaker"),
    row(Action::Microphone, "microphone", "Toggle microphone", &[], Group::Picture)
        .found_by("sound audio record input"),
    row(Action::CompileOnSave, "compile-on-save", "Toggle compile on save only", &[], Group::Picture)
        .found_by("automatic live debounce"),
    row(Action::Compile, "compile", "Compile now", &["Alt+Enter", "Ctrl+Enter"], Group::Picture)
        .found_by("build run recompile reload refresh"),
    row(
        Action::Screenshot,
        "save-picture",
        "Save screenshot of the shown pass (PNG)",
        &["Ctrl+P", "F12"],
        Group::Picture,
    )
    .found_by("picture image export capture video render"),
    row(Action::Audit, "audit", "Check precision, NaN and undefined behaviour", &["Ctrl+Shift+U"], Group::Picture)
        .found_by("debug validate nan accuracy error"),
    row(Action::CountCost, "count-cost", "Toggle cost by pixel and by line", &["Ctrl+Shift+H"], Group::Picture)
        .found_by("heat map hotspot slow lines iterations"),
    row(Action::TraceCostliest, "trace-costliest", "Trace the costliest pixel", &[], Group::Picture)
        .found_by("slow debug hotspot"),
    row(Action::FindNonfinite, "first-nan", "Find first NaN or infinity", &[], Group::Picture).found_by("debug inf"),
    row(Action::Record, "record-input", "Start/stop recording input", &["Ctrl+Shift+R"], Group::Picture)
        .found_by("capture video replay mouse keys recording"),
    row(Action::PlayRecording, "play-recording", "Play recording", &[], Group::Picture)
        .found_by("replay open file mouse keys input"),
    row(Action::StopReplay, "stop-replay", "Stop playing recording", &[], Group::Picture).found_by("replay end cancel"),
    row(Action::SaveMeasures, "save-measurements", "Save measurements (CSV)", &[], Group::Picture)
        .found_by("export probe data table"),
    row(Action::SaveSound, "save-sound", "Save sound pass (WAV)", &[], Group::Picture)
        .found_by("export audio music wave"),
    row(
        Action::SaveTexels,
        "save-texels",
        "Save float texels of the shown pass (.npy)",
        &["Ctrl+Shift+E"],
        Group::Picture,
    )
    .found_by("export npy numpy exr raw"),
    row(Action::Fullscreen, "full-screen", "Toggle full screen", &["F11"], Group::Picture)
        .found_by("fullscreen maximize f11 projector"),
    row(Action::Present, "present", "Toggle code over picture", &["F9"], Group::Picture)
        .found_by("presentation mode overlay zen focus"),
    row(Action::Probe, "probe", "Toggle probe of the expression at the caret", &["Ctrl+Shift+I"], Group::Picture)
        .found_by("debug inspect visualize watch"),
    row(
        Action::TracePixel,
        "trace-pixel",
        "Trace pixel: click it in the picture (or Ctrl+Shift+click)",
        &["Ctrl+T"],
        Group::Picture,
    )
    .found_by("debug debugger inspect pixel"),
    picture(PictureAction::Shape(Shape::Site), "picture-wide", "Aspect ratio: 16:9").found_by("widescreen shape"),
    picture(PictureAction::Shape(Shape::Fill), "picture-fill", "Aspect ratio: fill the panel")
        .found_by("stretch shape view"),
    picture(PictureAction::Scale(SCALES[0]), "picture-2x", "Resolution scale: 2"),
    picture(PictureAction::Scale(SCALES[1]), "picture-usual", "Resolution scale: 1"),
    picture(PictureAction::Scale(SCALES[2]), "picture-three-quarters", "Resolution scale: 3/4"),
    picture(PictureAction::Scale(SCALES[3]), "picture-half", "Resolution scale: 1/2"),
    picture(PictureAction::Scale(SCALES[4]), "picture-quarter", "Resolution scale: 1/4"),
    picture(PictureAction::Scale(SCALES[5]), "picture-eighth", "Resolution scale: 1/8"),
    picture(PictureAction::Size(SIZES[0]), "picture-256x144", "Resolution: 256 × 144"),
    picture(PictureAction::Size(SIZES[1]), "picture-640x360", "Resolution: 640 × 360").found_by("size"),
    picture(PictureAction::Size(SIZES[2]), "picture-800x450", "Resolution: 800 × 450"),
    picture(PictureAction::Size(SIZES[3]), "picture-1280x720", "Resolution: 1280 × 720").found_by("hd size"),
    picture(PictureAction::Size(SIZES[4]), "picture-1920x1080", "Resolution: 1920 × 1080").found_by("full hd size"),
    picture(PictureAction::Size(SIZES[5]), "picture-3840x2160", "Resolution: 3840 × 2160").found_by("4k uhd size"),
    picture(PictureAction::Size(SIZES[6]), "picture-512x512", "Resolution: 512 × 512"),
    picture(PictureAction::Size(SIZES[7]), "picture-1024x1024", "Resolution: 1024 × 1024"),
    picture(PictureAction::TypeSize, "picture-size", "Set resolution")
        .found_by("custom size width height portrait pixels dimensions"),
    picture(PictureAction::ResetUniforms, "reset-uniforms", "Reset all uniforms")
        .found_by("sliders defaults parameters"),
    picture(PictureAction::GoOn, "go-on", "Slow frame: continue").found_by("timeout hang"),
    picture(PictureAction::Smaller, "draw-smaller", "Slow frame: lower the resolution"),
    picture(PictureAction::LastGood, "last-good-code", "Slow frame: draw the last good code"),
    row(Action::Palette, "palette", "Command palette", &["Ctrl+Shift+P"], Group::Window),
    row(Action::Help, "help", "Help and keyboard shortcuts", &["F1"], Group::Window)
        .found_by("manual documentation docs about guide"),
    row(Action::KeyFile, "keys", "Edit keyboard shortcuts", &[], Group::Window)
        .found_by("keybindings hotkeys bindings customize"),
    row(Action::TabLeft, "tab-left", "Go to the tab on the left", &["Alt+Left", "Ctrl+PageUp"], Group::Window),
    row(Action::TabRight, "tab-right", "Go to the tab on the right", &["Alt+Right", "Ctrl+PageDown"], Group::Window),
    row(Action::NextPanel, "next-panel", "Focus next panel", &["F6"], Group::Window).found_by("switch window"),
    row(Action::PreviousPanel, "previous-panel", "Focus previous panel", &["Shift+F6"], Group::Window),
    row(Action::LabReport, "lab-report", "Save lab report", &[], Group::Window).found_by("export html plots tables"),
    row(
        Action::Passes,
        "passes",
        "Edit passes: add, rename, reorder, size, format, steps",
        &["Ctrl+Shift+B"],
        Group::Window,
    )
    .found_by("buffers channels settings textures inputs layers"),
    row(Action::UndoPasses, "undo-passes", "Undo change of passes, channels or uniforms", &["Ctrl+Z"], Group::Window)
        .found_by("revert"),
    row(
        Action::RedoPasses,
        "redo-passes",
        "Redo change of passes, channels or uniforms",
        &["Ctrl+Shift+Z", "Ctrl+Y"],
        Group::Window,
    ),
    row(Action::ResetLayout, "usual-layout", "Reset layout", &[], Group::Window)
        .found_by("default windows workspace panels"),
    layout(LayoutAction::Resize(Side::Left), "panel-narrower", "Make panel narrower", &["Ctrl+Shift+Alt+Left"]),
    layout(LayoutAction::Resize(Side::Right), "panel-wider", "Make panel wider", &["Ctrl+Shift+Alt+Right"]),
    layout(LayoutAction::Resize(Side::Up), "panel-lower", "Make panel lower", &["Ctrl+Shift+Alt+Up"]),
    layout(LayoutAction::Resize(Side::Down), "panel-higher", "Make panel higher", &["Ctrl+Shift+Alt+Down"]),
    layout(LayoutAction::Move(Side::Left), "panel-to-left", "Move panel to the left edge", &[]),
    layout(LayoutAction::Move(Side::Right), "panel-to-right", "Move panel to the right edge", &[]),
    layout(LayoutAction::Move(Side::Up), "panel-to-top", "Move panel to the top", &[]),
    layout(LayoutAction::Move(Side::Down), "panel-to-bottom", "Move panel to the bottom", &[]),
    layout(LayoutAction::Share, "panel-share", "Move panel into the next one, as a tab", &[]),
    layout(LayoutAction::Close, "panel-close", "Close panel", &[]),
    row(Action::NextTheme, "theme", "Switch theme: system, dark or light", &[], Group::Window)
        .found_by("color colour appearance day night"),
    row(Action::Theme(Theme::Dark), "theme-dark", "Theme: dark", &[], Group::Window).found_by("mode night"),
    row(Action::Theme(Theme::Light), "theme-light", "Theme: light", &[], Group::Window).found_by("mode day"),
    row(Action::Theme(Theme::System), "theme-system", "Theme: system", &[], Group::Window),
    row(Action::ZoomIn, "zoom-in", "Zoom in", &["Ctrl+Alt+=", "Ctrl+Alt++"], Group::Window).found_by("ui scale larger"),
    row(Action::ZoomOut, "zoom-out", "Zoom out", &["Ctrl+Alt+-"], Group::Window).found_by("ui scale smaller"),
    row(Action::ZoomReset, "zoom-usual", "Reset zoom", &["Ctrl+Alt+0"], Group::Window),
    row(Action::Settings, "open-settings", "Open settings", &["Ctrl+,"], Group::Window)
        .found_by("preferences options configuration config theme font midi osc controllers gamepad"),
    row(Action::SettingsFile, "settings", "Open settings file", &[], Group::Window)
        .found_by("preferences options configuration config"),
    row(
        Action::FontLarger,
        "code-larger",
        "Increase code size",
        &["Ctrl++", "Ctrl+=", "Alt++", "Alt+="],
        Group::Window,
    )
    .found_by("font text bigger zoom"),
    row(Action::FontSmaller, "code-smaller", "Decrease code size", &["Ctrl+-", "Alt+-"], Group::Window)
        .found_by("font text zoom"),
    row(Action::FontReset, "code-usual-size", "Reset code size", &["Ctrl+0"], Group::Window),
    row(Action::WordWrap, "word-wrap", "Toggle word wrap", &["Alt+Z"], Group::Window).found_by("line soft softwrap"),
    row(Action::Find, "find", "Find", &["Ctrl+F"], Group::Search).found_by("search"),
    row(Action::Replace, "replace", "Find and replace", &["Ctrl+H"], Group::Search).found_by("substitute search"),
    row(Action::FindEverywhere, "find-in-passes", "Find in all passes", &["Ctrl+Shift+F"], Group::Search)
        .found_by("search project files grep"),
    row(Action::FindNext, "find-next", "Find next", &["F3"], Group::Search),
    row(Action::FindPrevious, "find-previous", "Find previous", &["Shift+F3"], Group::Search),
    row(Action::GoToLine, "go-to-line", "Go to line", &["Ctrl+G"], Group::Search),
    row(Action::GoToSymbol, "go-to-symbol", "Go to symbol in outline", &["Ctrl+R"], Group::Search)
        .found_by("symbols functions structure declarations"),
    row(Action::NextProblem, "next-problem", "Go to next problem", &["F8"], Group::Search)
        .found_by("errors warnings diagnostics"),
    row(Action::PreviousProblem, "previous-problem", "Go to previous problem", &["Shift+F8"], Group::Search),
    row(Action::FindCase, "find-case", "Toggle match case", &["Alt+C"], Group::FindBar),
    row(Action::FindRegex, "find-regex", "Toggle regular expression", &["Alt+R"], Group::FindBar),
    row(Action::FindWord, "find-word", "Toggle match whole word", &["Alt+W"], Group::FindBar),
    row(Action::FindInSelection, "find-in-selection", "Toggle find in selection", &["Alt+L"], Group::FindBar),
    row(Action::ReplaceAll, "replace-all", "Replace all matches", &["Ctrl+Alt+Enter"], Group::FindBar),
    trace(TraceAction::Continue(Forward), "continue", "Continue to the next breakpoint", &["F5"])
        .found_by("debug run resume"),
    trace(TraceAction::Continue(Back), "continue-back", "Continue back to the previous breakpoint", &["Alt+F5"]),
    go_on(StepKind::Over, Forward, "step-over", "Step over", &["F10"]),
    go_on(StepKind::Over, Back, "step-over-back", "Step back over", &["Alt+F10"]),
    go_on(StepKind::Into, Forward, "step-into", "Step into", &["F11"]),
    go_on(StepKind::Into, Back, "step-into-back", "Step back into", &["Alt+F11"]),
    go_on(StepKind::Out, Forward, "step-out", "Step out", &["Shift+F11"]),
    go_on(StepKind::Out, Back, "step-out-back", "Step back out", &["Shift+Alt+F11"]),
    trace(TraceAction::ToCursor(Forward), "run-to-cursor", "Run to caret", &["Ctrl+F10"]),
    trace(TraceAction::ToCursor(Back), "run-to-cursor-back", "Run back to caret", &["Ctrl+Alt+F10"]),
    trace(TraceAction::End(Back), "trace-begin", "Go to the start of the trace", &["Ctrl+Alt+Home"]),
    trace(TraceAction::End(Forward), "trace-end", "Go to the end of the trace", &["Ctrl+Alt+End"]),
    trace(TraceAction::Breakpoint, "breakpoint", "Toggle breakpoint", &["F9"]).found_by("debug stop"),
    code(Code::Definition, "go-to-definition", "Go to definition (or Ctrl+click)", &["F12"])
        .found_by("declaration jump"),
    code(Code::Uses, "list-uses", "Find all references", &["Shift+F12"]).found_by("usages occurrences"),
    code(Code::Rename, "rename", "Rename symbol", &["F2"]).found_by("refactor name"),
    code(Code::QuickFix, "quick-fix", "Fix the problem at the caret", &["Ctrl+."]).found_by("repair correct lightbulb"),
    row(Action::FixAll, "fix-all", "Fix all problems that have one fix", &[], Group::Code)
        .found_by("quick repair correct"),
    code(Code::Format, "format", "Format document", &["Shift+Alt+F"]).found_by("clang indent beautify pretty tidy"),
    code(Code::Propose, "propose", "Show suggestions", &["Ctrl+Space"])
        .found_by("autocomplete completion intellisense snippet complete"),
    code(Code::Signature, "signature", "Show parameter hints", &["Ctrl+Shift+Space"]).found_by("arguments"),
    code(Code::ToggleComment, "toggle-comment", "Toggle line comment", &["Ctrl+/"]).found_by("uncomment"),
    code(Code::ToggleBlockComment, "toggle-block-comment", "Toggle block comment", &["Shift+Alt+A"])
        .found_by("uncomment"),
    code(Code::MoveLines(Vertical::Up), "move-lines-up", "Move lines up", &["Alt+Up"]),
    code(Code::MoveLines(Vertical::Down), "move-lines-down", "Move lines down", &["Alt+Down"]),
    code(Code::CopyLines(Vertical::Up), "copy-lines-up", "Copy lines up", &["Shift+Alt+Up"]),
    code(Code::CopyLines(Vertical::Down), "copy-lines-down", "Copy lines down", &["Shift+Alt+Down"])
        .found_by("duplicate clone"),
    code(Code::DeleteLines, "delete-lines", "Delete lines", &["Ctrl+Shift+K"]).found_by("remove cut"),
    code(Code::Indent, "indent", "Indent or insert tab", &["Tab"]),
    code(Code::IndentLines, "indent-lines", "Indent lines", &["Ctrl+]"]),
    code(Code::Unindent, "unindent", "Outdent lines", &["Shift+Tab", "Ctrl+["]),
    code(Code::NewLine, "new-line", "New line", &["Enter", "Shift+Enter"]),
    code(Code::OpenLine(Vertical::Down), "line-below", "Insert line below", &["Ctrl+Enter"]),
    code(Code::OpenLine(Vertical::Up), "line-above", "Insert line above", &["Ctrl+Shift+Enter"]),
    code(Code::Delete(Motion::Left), "delete-left", "Delete left", &["Backspace", "Shift+Backspace"]),
    code(Code::Delete(Motion::Right), "delete-right", "Delete right", &["Delete"]),
    code(
        Code::Delete(Motion::WordLeft),
        "delete-word-left",
        "Delete word left",
        or_mac(&["Ctrl+Backspace"], &["Alt+Backspace"]),
    ),
    code(
        Code::Delete(Motion::WordRight),
        "delete-word-right",
        "Delete word right",
        or_mac(&["Ctrl+Delete"], &["Alt+Delete"]),
    ),
    code(Code::Cut, "cut", "Cut", &[]),
    code(Code::Copy, "copy", "Copy", &[]),
    code(Code::Paste, "paste-code", "Paste", &[]),
    code(Code::Undo, "undo", "Undo", &["Ctrl+Z"]),
    code(Code::Redo, "redo", "Redo", &["Ctrl+Shift+Z", "Ctrl+Y"]),
    code(Code::Fold, "fold", "Fold block", &["Ctrl+Shift+["]).found_by("collapse"),
    code(Code::Unfold, "unfold", "Unfold block", &["Ctrl+Shift+]"]).found_by("expand"),
    code(Code::FoldAll, "fold-all", "Fold all blocks", &[]),
    code(Code::UnfoldAll, "unfold-all", "Unfold all blocks", &[]),
    caret(Code::AddNext, "add-next", "Select word, then add next occurrence", &["Ctrl+D"])
        .found_by("multiple cursors multicursor"),
    caret(Code::AddAll, "add-all", "Select all occurrences", &["Ctrl+Shift+L", "Ctrl+F2"]),
    caret(Code::AddCaret(Vertical::Up), "add-caret-up", "Add caret above", &["Ctrl+Alt+Up"]),
    caret(Code::AddCaret(Vertical::Down), "add-caret-down", "Add caret below", &["Ctrl+Alt+Down"]),
    caret(Code::OneCaret, "one-caret", "Return to one caret", &["Escape"]),
    caret(Code::OtherBracket, "other-bracket", "Go to matching bracket", &["Ctrl+Shift+\\"]),
    caret(Code::SelectAll, "select-all", "Select all", &["Ctrl+A"]),
    caret(Code::SelectLine, "select-line", "Select line", &["Ctrl+L"]),
    go(Motion::Left, "left", "Move left", &["Left"]),
    go(Motion::Right, "right", "Move right", &["Right"]),
    go(Motion::Lines(-1), "up", "Move up", &["Up"]),
    go(Motion::Lines(1), "down", "Move down", &["Down"]),
    go(Motion::WordLeft, "word-left", "Move word left", or_mac(&["Ctrl+Left"], &["Alt+Left"])),
    go(Motion::WordRight, "word-right", "Move word right", or_mac(&["Ctrl+Right"], &["Alt+Right"])),
    go(Motion::Home, "line-start", "Go to line start", or_mac(&["Home"], &["Home", "Ctrl+Left"])),
    go(Motion::End, "line-end", "Go to line end", or_mac(&["End"], &["End", "Ctrl+Right"])),
    go(Motion::Start, "text-start", "Go to text start", or_mac(&["Ctrl+Home"], &["Ctrl+Home", "Ctrl+Up"])),
    go(Motion::Finish, "text-end", "Go to text end", or_mac(&["Ctrl+End"], &["Ctrl+End", "Ctrl+Down"])),
    go(Motion::Pages(-1), "page-up", "Page up", &["PageUp"]),
    go(Motion::Pages(1), "page-down", "Page down", &["PageDown"]),
    select(Motion::Left, "select-left", "Select left", &["Shift+Left"]),
    select(Motion::Right, "select-right", "Select right", &["Shift+Right"]),
    select(Motion::Lines(-1), "select-up", "Select up", &["Shift+Up"]),
    select(Motion::Lines(1), "select-down", "Select down", &["Shift+Down"]),
    select(Motion::WordLeft, "select-word-left", "Select word left", or_mac(&["Ctrl+Shift+Left"], &["Shift+Alt+Left"])),
    select(
        Motion::WordRight,
        "select-word-right",
        "Select word right",
        or_mac(&["Ctrl+Shift+Right"], &["Shift+Alt+Right"]),
    ),
    select(
        Motion::Home,
        "select-line-start",
        "Select to line start",
        or_mac(&["Shift+Home"], &["Shift+Home", "Ctrl+Shift+Left"]),
    ),
    select(
        Motion::End,
        "select-line-end",
        "Select to line end",
        or_mac(&["Shift+End"], &["Shift+End", "Ctrl+Shift+Right"]),
    ),
    select(
        Motion::Start,
        "select-text-start",
        "Select to text start",
        or_mac(&["Ctrl+Shift+Home"], &["Ctrl+Shift+Home", "Ctrl+Shift+Up"]),
    ),
    select(
        Motion::Finish,
        "select-text-end",
        "Select to text end",
        or_mac(&["Ctrl+Shift+End"], &["Ctrl+Shift+End", "Ctrl+Shift+Down"]),
    ),
    select(Motion::Pages(-1), "select-page-up", "Select page up", &["Shift+PageUp"]),
    select(Motion::Pages(1), "select-page-down", "Select page down", &["Shift+PageDown"]),
];
